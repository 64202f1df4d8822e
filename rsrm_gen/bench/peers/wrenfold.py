"""wrenfold: its own quaternions; elsewhere the formulas of our manifold files, by its code generator for numpy.

It has true conditionals, so that 0/0 is kept away as in its own geometry: `where` a norm is above 1e-16, the value that
its examples use, the formula, and the limit below. The determinant is numpy's, of the Jacobian that wrenfold
differentiates. Its generated code takes one row at a time.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from wrenfold import code_generation as generation
from wrenfold import sym
from wrenfold.geometry import Quaternion
from wrenfold.type_info import MatrixType

from rsrm_gen.bench.peers import Evaluate, bundled_name
from rsrm_gen.compiler.spec import Spec
from rsrm_gen.files import imported

EPSILON = 1e-16
WIDTHS = {
    "float64": generation.PythonGeneratorFloatWidth.Float64,
    "float32": generation.PythonGeneratorFloatWidth.Float32,
}

Formula = Callable[[Any, Any], Any]  # two column vectors of symbols -> a matrix of expressions


def functions(spec: Spec, precision: str) -> Mapping[str, Evaluate]:
    """Exp, Log, the distance and the determinant of spheres, hyperbolic spaces in two models, tori and SO(3)."""
    manifold = bundled_name(spec)
    if manifold not in FORMULAS:
        return {}
    found = {}
    for name in FORMULAS[manifold]:
        right = spec.tangent_size if name == "exp" else spec.point_size
        found[name] = _by_rows(_generated(manifold, name, spec.point_size, right, precision), name, precision)
    return found


@cache
def _generated(manifold: str, name: str, left: int, right: int, precision: str) -> Callable[..., Any]:
    """The generated numpy function of a formula."""
    description = generation.FunctionDescription(name)
    p = description.add_input_argument("p", MatrixType(left, 1))
    x = description.add_input_argument("x", MatrixType(right, 1))
    result = FORMULAS[manifold][name](p, x)
    description.add_output_argument("result", False, result)
    generator = generation.PythonGenerator(generation.PythonGeneratorTarget.NumPy, WIDTHS[precision])
    code = generator.generate(generation.transpile(description))
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"{name}.py"
        path.write_text(f"import numpy as np\n\n{code}", encoding="utf-8")
        function: Callable[..., Any] = getattr(imported(path, keep=False), name)
    return function


def _by_rows(function: Callable[..., Any], name: str, precision: str) -> Evaluate:
    def evaluate(a: Any, b: Any) -> Any:
        results = np.array([function(x, y) for x, y in zip(a, b, strict=True)])
        results = results.reshape(len(a), *results.shape[-2:])
        assert results.dtype == precision
        return np.linalg.slogdet(results)[1] if name == "log_abs_det" else results.reshape(len(a), -1)

    return evaluate


def _sphere() -> dict[str, Formula]:
    def exp(p: Any, v: Any) -> Any:
        t = v.norm()
        return sym.cos(t) * p + _unless_zero(t, sym.sin(t) / t, 1) * v

    def distance(p: Any, q: Any) -> Any:
        return sym.vector(2 * sym.atan2((q - p).norm(), (q + p).norm()))

    def log(p: Any, q: Any) -> Any:
        e = q + sym.where(_dot(p, q) < 0, 1, -1) * p
        w = e - p * _dot(p, e)
        return _unless_zero(w.norm(), distance(p, q)[0] / w.norm(), 1) * w

    def completed_jacobian(p: Any, q: Any) -> Any:
        return log(p, q).jacobian(q) * (sym.eye(q.shape[0]) - q * q.T) + p * q.T

    return {"exp": exp, "log": log, "distance": distance, "log_abs_det": completed_jacobian}


def _hyperbolic() -> dict[str, Formula]:
    def exp(p: Any, v: Any) -> Any:
        s, h = p[1:], v[1:]
        ss, sh = _dot(s, s), _dot(s, h)
        a = sym.sqrt(1 + ss)
        k = sym.where(ss < 1, 0, sh / ss)
        rest = h - k * s
        r = sym.sqrt(sym.where(ss < 1, _dot(h, h) - (sh / a) ** 2, _dot(rest, rest) + k * sh / a**2))
        return sym.cosh(r) * _stacked(a, s) + _unless_zero(r, sym.sinh(r) / r, 1) * _stacked(sh / a, h)

    def half_chord(p: Any, q: Any) -> tuple[Any, Any, Any, Any, Any]:
        s, x = p[1:], q[1:]
        a, b = sym.sqrt(1 + _dot(s, s)), sym.sqrt(1 + _dot(x, x))
        D, S = x - s, x + s
        DS, SS = _dot(D, S), _dot(S, S)
        e = DS / (a + b)
        k = sym.where(SS < 1, 0, DS / SS)
        rest = D - k * S
        c = 2 * (1 + a * b - _dot(s, x)) / (a + b) ** 2
        ww = sym.where(SS < 1, _dot(D, D) - e**2, _dot(rest, rest) + k * DS * c)
        return ww, e, D, a, s

    def distance(p: Any, q: Any) -> Any:
        return sym.vector(2 * sym.asinh(sym.sqrt(half_chord(p, q)[0]) / 2))

    def log(p: Any, q: Any) -> Any:
        ww, e, D, a, s = half_chord(p, q)
        sinh_r = sym.sqrt(ww * (1 + ww / 4))
        scale = _unless_zero(sinh_r, distance(p, q)[0] / sinh_r, 1)
        return scale * (_stacked(e, D) - ww / 2 * _stacked(a, s))

    def chart_jacobian(p: Any, q: Any) -> Any:
        # In the coordinates p[1:] the volume is 1 / p[0]: the first row carries the ratio of the two volumes.
        J = log(p, q)[1:].jacobian(q[1:])
        time = [sym.sqrt(1 + _dot(x[1:], x[1:])) for x in (p, q)]
        return sym.diag([time[1] / time[0], *[1] * (J.shape[0] - 1)]) * J

    return {"exp": exp, "log": log, "distance": distance, "log_abs_det": chart_jacobian}


def _poincare() -> dict[str, Formula]:
    def exp(p: Any, v: Any) -> Any:
        a = 1 - _dot(p, p)
        w = v / a
        r = w.norm()
        s = p + _unless_zero(r, sym.tanh(r) / r, 1) * w
        ss = _dot(s, s)
        return (ss * p + a * s) / (ss + a / sym.cosh(r) ** 2)

    def angle(p: Any, q: Any) -> tuple[Any, Any, Any, Any]:
        a, b, d = 1 - _dot(p, p), 1 - _dot(q, q), q - p
        return (d / sym.sqrt(a * b)).norm(), a, b, d

    def distance(p: Any, q: Any) -> Any:
        return sym.vector(2 * sym.asinh(angle(p, q)[0]))

    def log(p: Any, q: Any) -> Any:
        h, a, b, d = angle(p, q)
        return _unless_zero(h, sym.asinh(h) / (h * sym.sqrt(1 + h**2)), 1) / b * (a * d - _dot(d, d) * p)

    def jacobian(p: Any, q: Any) -> Any:
        _, a, b, _ = angle(p, q)
        return log(p, q).jacobian(q) * (b / a)  # the lengths of the metric at p and q

    return {"exp": exp, "log": log, "distance": distance, "log_abs_det": jacobian}


def _torus() -> dict[str, Formula]:
    def wrapped(x: Any) -> Any:
        return sym.vector(
            *(e - 2 * sym.pi * sym.floor(e / (2 * sym.pi) + sym.rational(1, 2)) for e in x.to_flat_list())
        )

    def log(p: Any, q: Any) -> Any:
        return wrapped(q - p)

    return {
        "exp": lambda p, v: wrapped(p + v),
        "log": log,
        "distance": lambda p, q: sym.vector(log(p, q).norm()),
        "log_abs_det": lambda p, q: log(p, q).jacobian(q),
    }


def _rotations() -> dict[str, Formula]:
    """Its own quaternions; both store (w, x, y, z) here, and both have body-frame rotation vectors."""

    def rotation(q: Any) -> Any:
        return Quaternion.from_wxyz(q)

    def exp(p: Any, v: Any) -> Any:
        return (rotation(p) * Quaternion.from_rotation_vector(v, epsilon=EPSILON)).to_vector_wxyz()

    def log(p: Any, q: Any) -> Any:
        return (rotation(p).conjugate() * rotation(q)).to_rotation_vector(epsilon=EPSILON)

    def distance(p: Any, q: Any) -> Any:
        return sym.vector(log(p, q).norm())

    def jacobian(p: Any, q: Any) -> Any:
        return log(p, q).jacobian(q) * rotation(q).right_retract_derivative()

    return {"exp": exp, "log": log, "distance": distance, "log_abs_det": jacobian}


def _unless_zero(length: Any, formula: Any, limit: Any) -> Any:
    return sym.where(length > EPSILON, formula, limit)


def _dot(a: Any, b: Any) -> Any:
    (product,) = a.T * b
    return product


def _stacked(first: Any, rest: Any) -> Any:
    return sym.vstack([sym.vector(first), rest])


FORMULAS: dict[str, dict[str, Formula]] = {
    "sphere": _sphere(),
    "hyperbolic": _hyperbolic(),
    "poincare": _poincare(),
    "torus": _torus(),
    "so3": _rotations(),
}
