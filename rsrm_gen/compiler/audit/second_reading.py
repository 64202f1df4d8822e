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
from rsrm_gen.compiler.spec.shapes import bounds, constant, unit_size

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
        frame = ca.jacobian(self.read(spec.frame, p=p, v=v), v).T if spec.frame else ca.SX.eye(D)
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
        """The expression of a map, a column; a matrix row by row."""
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
    """A scalar, or a column; a matrix, but for that of a metric, row by row."""
    scope = {name: _shaped(x, spec.argument_shapes[name]) for name, x in arguments.items()}
    trees = {name: formula.tree for name, formula in chart_map.lets}
    evaluator = _Evaluator(dict(spec.parameters), scope, trees)
    for name in trees:  # in their order: each may stand on hundreds of others
        evaluator.name(name)
    value = evaluator.value(chart_map.value.tree)
    return ca.vec(value.T) if len(chart_map.value.shape) == 2 and chart_map is not spec.metric else value


def _shaped(x: Any, shape: tuple[int, ...]) -> Any:
    """A column as a matrix, filled row by row."""
    return ca.reshape(x, shape[1], shape[0]).T if len(shape) == 2 else x


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
            case f.Call() if tree.function == "eye":
                return ca.SX.eye(unit_size(tree, self.parameters))
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
        if tree.operator == "*" and left.shape[1] > 1 and not right.is_scalar():
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


def _above(A: Any, diagonal: int) -> Any:
    n = A.shape[0]
    return ca.vertcat(*(A[i, j] for i in range(n) for j in range(i + diagonal, n)))


def _svec(A: Any) -> Any:
    n = A.shape[0]
    return ca.vertcat(*(A[i, j] * (1 if i == j else np.sqrt(2)) for i in range(n) for j in range(i, n)))


def _smat(a: Any) -> Any:
    n = int((np.sqrt(8 * a.shape[0] + 1) - 1) / 2)
    A = ca.SX.zeros(n, n)
    places = [(i, j) for i in range(n) for j in range(i, n)]
    for entry, (i, j) in zip(ca.vertsplit(a), places, strict=True):
        A[i, j] = A[j, i] = entry / (1 if i == j else np.sqrt(2))
    return A


def _rotation(q: Any) -> Any:
    return (q[0] ** 2 - ca.dot(q[1:], q[1:])) * ca.SX.eye(3) + 2 * q[1:] @ q[1:].T + 2 * q[0] * ca.skew(q[1:])


def _quaternion(R: Any) -> Any:
    """From the largest of the four entries, each with its own formula."""
    twist = ca.vertcat(R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1])
    squares = [1 + ca.trace(R)] + [1 - ca.trace(R) + 2 * R[i, i] for i in range(3)]
    found = [ca.vertcat(squares[0], twist) / ca.sqrt(squares[0]) / 2]
    for i in range(3):
        vector = R[:, i] + R[i, :].T
        vector[i] = squares[i + 1]
        found.append(ca.vertcat(twist[i], vector) / ca.sqrt(squares[i + 1]) / 2)
    best, most = found[0], squares[0]
    for candidate, square in zip(found[1:], squares[1:], strict=True):
        best = ca.if_else(square > most, candidate, best)
        most = ca.fmax(square, most)
    return best


def _jacobi(A: Any) -> tuple[Any, Any]:
    """Eigenvalues and eigenvectors by Jacobi's rotations, written out; not differentiable where two eigenvalues meet."""
    n, A, V = A.shape[0], (A + A.T) / 2, ca.SX.eye(A.shape[0])
    for _ in range(1 if n == 2 else n + 2):
        for p in range(n):
            for q in range(p + 1, n):
                angle = ca.atan2(2 * A[p, q], A[q, q] - A[p, p]) / 2
                J = ca.SX.eye(n)
                J[p, p] = J[q, q] = ca.cos(angle)
                J[p, q], J[q, p] = ca.sin(angle), -ca.sin(angle)
                A, V = J.T @ A @ J, V @ J
    return ca.diag(A), V


def _of_symmetric(function: Callable[[Any], Any]) -> Callable[[Any], Any]:
    def applied(A: Any) -> Any:
        values, V = _jacobi(A)
        return V @ ca.diag(function(values)) @ V.T

    return applied


def _eigenvalues(A: Any) -> Any:
    """Ascending, by exchanges."""
    values = ca.vertsplit(_jacobi(A)[0])
    for end in range(len(values), 1, -1):
        for i in range(end - 1):
            values[i], values[i + 1] = ca.fmin(values[i], values[i + 1]), ca.fmax(values[i], values[i + 1])
    return ca.vertcat(*values)


def _ad_squared(A: Any) -> Any:
    """[A, [A, X]] of each skew-symmetric unit, its entries above the diagonal."""
    n, columns = A.shape[0], []
    for i in range(n):
        for j in range(i + 1, n):
            X = ca.SX.zeros(n, n)
            X[i, j], X[j, i] = 1, -1
            inner = A @ X - X @ A
            columns.append(_above(A @ inner - inner @ A, 1))
    return ca.horzcat(*columns)


def _log_sinhc_sqrt(x: Any) -> Any:
    root = ca.sqrt(ca.fmax(x, 1e-300))
    return ca.log(ca.sinh(root) / root)


WORDS: dict[str, Callable[..., Any]] = {
    "dot": ca.dot, "norm": ca.norm_fro, "sum": ca.sum1, "max": ca.mmax,
    "min": ca.mmin, "cross": ca.cross, "outer": lambda a, b: a @ b.T,
    "qmul": _quaternion_product, "conj": lambda a: ca.vertcat(a[0], -a[1:]), "transpose": lambda A: A.T, "det": ca.det,
    "inv": ca.inv, "orthogonal": _orthogonal, "where": ca.if_else, "wrap": _wrap, "atan2": ca.atan2, "sqrt": ca.sqrt,
    "exp": ca.exp, "log": ca.log, "sin": ca.sin, "cos": ca.cos, "tan": ca.tan, "sinh": ca.sinh, "cosh": ca.cosh,
    "tanh": ca.tanh, "asinh": ca.asinh, "acos": ca.acos, "acosh": ca.acosh, "atanh": ca.atanh, "abs": ca.fabs,
    "trace": ca.trace, "above": lambda A: _above(A, 1), "upper": lambda A: _above(A, 0), "svec": _svec, "smat": _smat,
    "hat": ca.skew, "vee": ca.inv_skew, "rotation": _rotation, "quaternion": _quaternion, "expm": _of_symmetric(ca.exp),
    "logm": _of_symmetric(ca.log), "sqrtm": _of_symmetric(ca.sqrt), "invsqrtm": _of_symmetric(lambda x: 1 / ca.sqrt(x)),
    "log_sinhc_sqrtm": _of_symmetric(_log_sinhc_sqrt), "eigh": _eigenvalues, "ad_squared": _ad_squared,
    "sign": lambda x: ca.if_else(x < 0, -1, 1), "sinc": _cardinal(ca.sin), "sinhc": _cardinal(ca.sinh),
}  # fmt: skip
