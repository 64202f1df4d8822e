"""The second opinion: the same manifold file read by CasADi, with its own automatic differentiation.

Nothing here uses what `derive` and `lower` made of the file; only the parsed formulas are shared.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import casadi as ca
import numpy as np

from rsrm_gen.compiler.spec import ManifoldSpec, Map, ProductSpec, Spec
from rsrm_gen.compiler.spec import formula as f
from rsrm_gen.compiler.spec.shapes import bounds, constant

EPS = 2.0**-52


def read_again(spec: Spec) -> SecondReading | ProductReading:
    """The second reading of a manifold or of a product."""
    return SecondReading(spec) if isinstance(spec, ManifoldSpec) else ProductReading(spec)


class SecondReading:
    """Exp, Log, distance, log |det D Log| and the Riemannian gradient of a spec, in double precision."""

    def __init__(self, spec: ManifoldSpec) -> None:
        self.spec = spec
        D, T = spec.point_size, spec.tangent_size
        p, q, u, v = (ca.SX.sym(name, n) for name, n in (("p", D), ("q", D), ("u", T), ("v", T)))
        length = _constant(spec, spec.scale)
        inner = length**2 * self.metric(p, u, v)
        log = self.read(spec.log, p=p, q=q)
        distance = self.read(spec.distance, p=p, q=q) if spec.distance else ca.sqrt(self.metric(p, log, log))
        constraint = self.read(spec.constraint, p=p) if spec.constraint else ca.SX.zeros(0, 1)
        frame = self.read(spec.frame, p=p) if spec.frame else ca.SX.eye(D)
        self.exp = ca.Function("exp", [p, v], [self.read(spec.exp, p=p, v=v)])
        self.log = ca.Function("log", [p, q], [log])
        self.distance = ca.Function("distance", [p, q], [length * distance])
        self.log_jacobian = ca.Function("log_jacobian", [p, q], [ca.jacobian(log, q)])
        self.metric_matrix = ca.Function("metric", [p], [ca.jacobian(ca.jacobian(inner, u).T, v)])
        self.constraint_jacobian = ca.Function("normals", [p], [ca.jacobian(constraint, p)])
        self.frame = ca.Function("frame", [p], [frame])

    def log_abs_det(self, p: Sequence[float], q: Sequence[float]) -> float:
        """log |det D Log_p(q)| from an orthonormal basis at q and volumes in the metric at p."""
        basis, stored = self.tangent_basis(q)
        image = _dense(self.log_jacobian(p, q)) @ basis
        at_p, at_q = (_dense(self.metric_matrix(x)) for x in (p, q))
        return float(np.linalg.slogdet(image.T @ at_p @ image)[1] - np.linalg.slogdet(stored.T @ at_q @ stored)[1]) / 2

    def riemannian_gradient(self, p: Sequence[float], df: Sequence[float]) -> Any:
        """The solution of <grad f, w> = df(w) for all tangent w."""
        basis, stored = self.tangent_basis(p)
        gram = stored.T @ _dense(self.metric_matrix(p)) @ stored
        return stored @ np.linalg.solve(gram, basis.T @ np.asarray(df))

    def tangent_basis(self, p: Sequence[float]) -> tuple[Any, Any]:
        """Columns that span T_p M, as ambient vectors and as stored tangent vectors."""
        if self.spec.frame is not None:
            return _dense(self.frame(p)).T, np.eye(self.spec.dim)
        if not self.spec.embedded:
            return np.eye(self.spec.dim), np.eye(self.spec.dim)
        rows = _dense(self.constraint_jacobian(p))
        null = np.linalg.svd(rows)[2][rows.shape[0] :].T
        return null, null

    def metric(self, p: Any, u: Any, v: Any) -> Any:
        """<u, v>_p as an expression."""
        if self.spec.metric.value.shape:
            return u.T @ self.read(self.spec.metric, p=p, u=u, v=v) @ v
        return self.read(self.spec.metric, p=p, u=u, v=v)

    def read(self, chart_map: Map | None, **arguments: Any) -> Any:
        """The expression of a map."""
        assert chart_map is not None
        return _read(self.spec, chart_map, **arguments)


class ProductReading:
    """The second readings of the factors, put together."""

    def __init__(self, spec: ProductSpec) -> None:
        self.spec = spec
        self.length = _constant(spec, spec.scale)
        self.factors = [(read_again(f.spec), self.length * _constant(spec, f.weight), f.spec) for f in spec.factors]

    def parts(self, point: Sequence[float], tangent: bool = False) -> list[Any]:
        """The parts of a point or of a tangent vector that belong to the factors."""
        sizes = [spec.tangent_size if tangent else spec.point_size for _, _, spec in self.factors]
        return np.split(np.asarray(point), np.cumsum(sizes)[:-1])

    def exp(self, p: Sequence[float], v: Sequence[float]) -> Any:
        """Exp, factor by factor."""
        pairs = zip(self.factors, self.parts(p), self.parts(v, tangent=True), strict=True)
        return np.concatenate([np.asarray(reading.exp(a, b)).ravel() for (reading, _, _), a, b in pairs])

    def log(self, p: Sequence[float], q: Sequence[float]) -> Any:
        """Log, factor by factor."""
        pairs = zip(self.factors, self.parts(p), self.parts(q), strict=True)
        return np.concatenate([np.asarray(reading.log(a, b)).ravel() for (reading, _, _), a, b in pairs])

    def distance(self, p: Sequence[float], q: Sequence[float]) -> float:
        """The root of the sum of squares."""
        pairs = zip(self.factors, self.parts(p), self.parts(q), strict=True)
        return float(np.sqrt(sum((w * float(reading.distance(a, b))) ** 2 for (reading, w, _), a, b in pairs)))

    def log_abs_det(self, p: Sequence[float], q: Sequence[float]) -> float:
        """The sum."""
        pairs = zip(self.factors, self.parts(p), self.parts(q), strict=True)
        return sum(reading.log_abs_det(a, b) for (reading, _, _), a, b in pairs)

    def riemannian_gradient(self, p: Sequence[float], df: Sequence[float]) -> Any:
        """The gradients, divided by the squares of the weights."""
        pairs = zip(self.factors, self.parts(p), self.parts(df), strict=True)
        gradients = [np.asarray(reading.riemannian_gradient(a, b)).ravel() / w**2 for (reading, w, _), a, b in pairs]
        return np.concatenate(gradients)


def _read(spec: Spec, chart_map: Map, **arguments: Any) -> Any:
    trees = {name: formula.tree for name, formula in chart_map.lets}
    evaluator = _Evaluator(dict(spec.parameters), arguments, trees)
    for name in trees:  # in their order: each may stand on hundreds of others
        evaluator.name(name)
    return evaluator.value(chart_map.value.tree)


def _constant(spec: Spec, chart_map: Map | None) -> float:
    """The value of a map of nothing; 1 where there is none."""
    return 1.0 if chart_map is None else float(ca.evalf(_read(spec, chart_map)))


def _dense(x: Any) -> Any:
    return np.asarray(ca.DM(x).full())


class _Evaluator:
    """Formulas to CasADi expressions: scalars 1 x 1, vectors columns."""

    def __init__(self, parameters: dict[str, Any], scope: dict[str, Any], lets: dict[str, f.Tree]) -> None:
        self.parameters = parameters
        self.scope = scope
        self.lets = lets

    def value(self, tree: f.Tree) -> Any:
        match tree:
            case f.Number():
                return ca.SX(float(tree.value))
            case f.Name():
                return self.name(tree.name)
            case f.Negate():
                return -self.value(tree.operand)
            case f.Binary():
                return self.binary(tree)
            case f.Compare():
                a, b = self.value(tree.left), self.value(tree.right)
                return {"=": ca.eq, "<": ca.lt, "<=": ca.le, ">": ca.gt, ">=": ca.ge}[tree.operator](a, b)
            case f.Stack():
                return ca.vertcat(*(self.value(item) for item in tree.items))
            case f.Rows():
                return ca.vertcat(*(self.value(item).T for item in tree.items))
            case f.Index():
                base = self.value(tree.base)
                start, stop = bounds(tree, base.shape[0], self.parameters)
                rows = base[start:stop, :]
                return rows.T if base.shape[1] > 1 and not tree.slice else rows
            case f.Call():
                return WORDS[tree.function](*(self.value(a) for a in tree.arguments))

    def name(self, name: str) -> Any:
        if name not in self.scope and name in self.lets:
            self.scope[name] = self.value(self.lets[name])
        if name in self.scope:
            return self.scope[name]
        return ca.SX(float({"pi": np.pi, "eps": EPS, **self.parameters}[name]))

    def binary(self, tree: f.Binary) -> Any:
        left = self.value(tree.left)
        if tree.operator == "^":
            return left ** float(constant(tree.right, self.parameters))
        right = self.value(tree.right)
        if tree.operator == "*" and left.shape[1] > 1:
            return left @ right
        return {
            "+": lambda: left + right,
            "-": lambda: left - right,
            "*": lambda: left * right,
            "/": lambda: left / right,
        }[tree.operator]()


def _quaternion_product(a: Any, b: Any) -> Any:
    scalar = a[0] * b[0] - ca.dot(a[1:], b[1:])
    return ca.vertcat(scalar, a[0] * b[1:] + b[0] * a[1:] + ca.cross(a[1:], b[1:]))


def _orthogonal(a: Any) -> Any:
    axes = [ca.DM.eye(a.shape[0])[:, i] for i in (0, 1)]
    parts = [(axis - a[i] * a) / ca.norm_2(axis - a[i] * a) for i, axis in enumerate(axes)]
    return ca.if_else(a[0] ** 2 < 0.5, parts[0], parts[1])


def _wrap(x: Any, period: Any = 2 * np.pi) -> Any:
    return x - period * ca.floor(x / period + 0.5)


def _cardinal(function: Callable[[Any], Any]) -> Callable[[Any], Any]:
    # Scalar by scalar: CasADi's if_else wants a scalar condition.
    return lambda x: ca.vertcat(
        *(ca.if_else(e == 0, 1, function(e) / ca.if_else(e == 0, 1, e)) for e in ca.vertsplit(x))
    )


WORDS: dict[str, Callable[..., Any]] = {
    "dot": ca.dot, "norm": ca.norm_2, "sum": ca.sum1, "max": ca.mmax,
    "min": ca.mmin, "cross": ca.cross, "outer": lambda a, b: a @ b.T,
    "qmul": _quaternion_product, "conj": lambda a: ca.vertcat(a[0], -a[1:]), "transpose": lambda A: A.T, "det": ca.det,
    "inv": ca.inv, "orthogonal": _orthogonal, "where": ca.if_else, "wrap": _wrap, "atan2": ca.atan2, "sqrt": ca.sqrt,
    "exp": ca.exp, "log": ca.log, "sin": ca.sin, "cos": ca.cos, "tan": ca.tan, "sinh": ca.sinh, "cosh": ca.cosh,
    "tanh": ca.tanh, "asinh": ca.asinh, "acos": ca.acos, "acosh": ca.acosh, "atanh": ca.atanh, "abs": ca.fabs,
    "sign": lambda x: ca.if_else(x < 0, -1, 1), "sinc": _cardinal(ca.sin), "sinhc": _cardinal(ca.sinh),
}  # fmt: skip
