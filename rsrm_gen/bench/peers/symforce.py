"""SymForce: its own Rot3; elsewhere the formulas of our manifold files, by its code generator for PyTorch.

Singularities are kept away by its `epsilon`, as its documentation has it: a symbol that the generated functions take,
ten times the rounding unit of the precision. It has no conditionals; where a file says `where`, both sides are computed
and one is multiplied by zero. The determinant is numpy's, of the Jacobian that SymForce differentiates.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import symforce
import torch

symforce.set_epsilon_to_symbol()  # before anything else of it is imported

import symforce.symbolic as sf  # noqa: E402
from symforce.codegen import Codegen  # noqa: E402
from symforce.codegen.backends.pytorch import PyTorchConfig  # noqa: E402
from symforce.values import Values  # noqa: E402

from rsrm_gen.bench.peers import Evaluate, bundled_name  # noqa: E402
from rsrm_gen.compiler.spec import Spec  # noqa: E402
from rsrm_gen.files import imported  # noqa: E402

Formula = Callable[[Any, Any], Any]  # two column vectors of symbols -> a matrix of expressions


def functions(spec: Spec, precision: str) -> Mapping[str, Evaluate]:
    """Exp, Log, the distance and the determinant of spheres, hyperbolic spaces in two models, tori and SO(3)."""
    manifold = bundled_name(spec)
    if manifold not in FORMULAS:
        return {}
    found = {}
    for name in FORMULAS[manifold]:
        right = spec.tangent_size if name == "exp" else spec.point_size
        found[name] = _evaluate(_generated(manifold, name, spec.point_size, right), name, precision)
    return found


@cache
def _generated(manifold: str, name: str, left: int, right: int) -> Callable[..., Any]:
    """The generated PyTorch function of a formula."""
    p, x = sf.Matrix(left, 1).symbolic("p"), sf.Matrix(right, 1).symbolic("x")
    outputs = Values(result=FORMULAS[manifold][name](p, x))
    inputs = Values(p=p, x=x, epsilon=sf.Symbol("epsilon"))
    codegen = Codegen(inputs, outputs, PyTorchConfig(), name=name)
    with tempfile.TemporaryDirectory() as folder:
        codegen.generate_function(Path(folder), skip_directory_nesting=True)
        function: Callable[..., Any] = getattr(imported(Path(folder) / f"{name}.py", keep=False), name)
    return function


def _evaluate(function: Callable[..., Any], name: str, precision: str) -> Evaluate:
    dtype = getattr(torch, precision)
    epsilon = torch.tensor(10 * torch.finfo(dtype).eps, dtype=dtype)

    def evaluate(a: Any, b: Any) -> Any:
        kwargs = {"device": torch.device("cpu"), "dtype": dtype}
        result = function(torch.as_tensor(a), torch.as_tensor(b), epsilon, tensor_kwargs=kwargs).numpy()
        if name == "log_abs_det":
            log_abs_det = np.linalg.slogdet(result)[1]
            return np.broadcast_to(log_abs_det, len(a))  # a constant Jacobian has no rows
        return result.reshape(len(a), -1)

    return evaluate


def _sphere() -> dict[str, Formula]:
    def exp(p: Any, v: Any) -> Any:
        return sf.cos(v.norm()) * p + sf.sin(v.norm()) / v.norm() * v

    def distance(p: Any, q: Any) -> Any:
        return sf.Matrix([2 * sf.atan2((q - p).norm(), (q + p).norm())])

    def log(p: Any, q: Any) -> Any:
        e = q + (2 * sf.less(p.dot(q), 0) - 1) * p
        w = e - p.dot(e) * p
        return distance(p, q)[0] * w.normalized()

    def completed_jacobian(p: Any, q: Any) -> Any:
        return log(p, q).jacobian(q) * (sf.Matrix.eye(len(q)) - q * q.T) + p * q.T

    return {"exp": exp, "log": log, "distance": distance, "log_abs_det": completed_jacobian}


def _hyperbolic() -> dict[str, Formula]:
    def exp(p: Any, v: Any) -> Any:
        s, h = p[1:, :], v[1:, :]
        a = sf.sqrt(1 + s.squared_norm())
        k = _where(s.squared_norm(), 0, s.dot(h) / (s.squared_norm() + sf.epsilon()))
        rest = h - k * s
        close = h.squared_norm() - (s.dot(h) / a) ** 2
        r = sf.sqrt(_where(s.squared_norm(), close, rest.squared_norm() + k * s.dot(h) / a**2) + sf.epsilon())
        return sf.cosh(r) * _stacked(a, s) + sf.sinh(r) / r * _stacked(s.dot(h) / a, h)

    def half_chord(p: Any, q: Any) -> tuple[Any, Any, Any, Any, Any]:
        s, x = p[1:, :], q[1:, :]
        a, b = sf.sqrt(1 + s.squared_norm()), sf.sqrt(1 + x.squared_norm())
        D, S = x - s, x + s
        e = D.dot(S) / (a + b)
        k = _where(S.squared_norm(), 0, D.dot(S) / (S.squared_norm() + sf.epsilon()))
        rest = D - k * S
        c = 2 * (1 + a * b - s.dot(x)) / (a + b) ** 2
        ww = _where(S.squared_norm(), D.squared_norm() - e**2, rest.squared_norm() + k * D.dot(S) * c)
        return ww + sf.epsilon(), e, D, a, s

    def distance(p: Any, q: Any) -> Any:
        return sf.Matrix([2 * sf.asinh(sf.sqrt(half_chord(p, q)[0]) / 2)])

    def log(p: Any, q: Any) -> Any:
        ww, e, D, a, s = half_chord(p, q)
        return distance(p, q)[0] / sf.sqrt(ww * (1 + ww / 4)) * (_stacked(e, D) - ww / 2 * _stacked(a, s))

    def chart_jacobian(p: Any, q: Any) -> Any:
        # In the coordinates p[1:] the volume is 1 / p[0]: the first row carries the ratio of the two volumes.
        J = log(p, q)[1:, :].jacobian(q[1:, :])
        time = [sf.sqrt(1 + x[1:, :].squared_norm()) for x in (p, q)]
        return sf.Matrix.diag([time[1] / time[0], *[1] * (J.rows - 1)]) * J

    return {"exp": exp, "log": log, "distance": distance, "log_abs_det": chart_jacobian}


def _poincare() -> dict[str, Formula]:
    def exp(p: Any, v: Any) -> Any:
        a = 1 - p.squared_norm()
        w = v / a
        r = w.norm()
        s = p + sf.tanh(r) / r * w
        ss = s.squared_norm()
        return (ss * p + a * s) / (ss + a / sf.cosh(r) ** 2)

    def angle(p: Any, q: Any) -> tuple[Any, Any, Any, Any]:
        a, b, d = 1 - p.squared_norm(), 1 - q.squared_norm(), q - p
        return (d / sf.sqrt(a * b)).norm(), a, b, d

    def distance(p: Any, q: Any) -> Any:
        return sf.Matrix([2 * sf.asinh(angle(p, q)[0])])

    def log(p: Any, q: Any) -> Any:
        h, a, b, d = angle(p, q)
        return 2 * sf.asinh(h) / (2 * h * sf.sqrt(1 + h**2)) / b * (a * d - d.squared_norm() * p)

    def jacobian(p: Any, q: Any) -> Any:
        _, a, b, _ = angle(p, q)
        return b / a * log(p, q).jacobian(q)  # the lengths of the metric at p and q

    return {"exp": exp, "log": log, "distance": distance, "log_abs_det": jacobian}


def _torus() -> dict[str, Formula]:
    def wrapped(x: Any) -> Any:
        return sf.Matrix([e - 2 * sf.pi * sf.floor(e / (2 * sf.pi) + sf.S(1) / 2) for e in x])

    def log(p: Any, q: Any) -> Any:
        return wrapped(q - p)

    return {
        "exp": lambda p, v: wrapped(p + v),
        "log": log,
        "distance": lambda p, q: sf.Matrix([log(p, q).norm()]),
        "log_abs_det": lambda p, q: log(p, q).jacobian(q),
    }


def _rotations() -> dict[str, Formula]:
    """Its own group, which stores (x, y, z, w) where we store (w, x, y, z); both have body-frame rotation vectors."""

    def rotation(q: Any) -> Any:
        return sf.Rot3(sf.Quaternion(xyz=sf.V3(*q[1:, :]), w=q[0]))

    def exp(p: Any, v: Any) -> Any:
        q = rotation(p).retract(list(v)).q
        return sf.Matrix([q.w, *q.xyz])

    def log(p: Any, q: Any) -> Any:
        return sf.Matrix(rotation(p).local_coordinates(rotation(q)))

    def distance(p: Any, q: Any) -> Any:
        return sf.Matrix([rotation(p).angle_between(rotation(q))])

    def jacobian(p: Any, q: Any) -> Any:
        return log(p, q).jacobian(rotation(q))

    return {"exp": exp, "log": log, "distance": distance, "log_abs_det": jacobian}


def _where(x: Any, small: Any, large: Any) -> Any:
    """`small` where x < 1, else `large`, by multiplication."""
    is_small = sf.less(x, 1)
    return is_small * small + (1 - is_small) * large


def _stacked(first: Any, rest: Any) -> Any:
    return sf.Matrix([first, *rest])


FORMULAS: dict[str, dict[str, Formula]] = {
    "sphere": _sphere(),
    "hyperbolic": _hyperbolic(),
    "poincare": _poincare(),
    "torus": _torus(),
    "so3": _rotations(),
}
