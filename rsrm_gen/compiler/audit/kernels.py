"""Every emitted function against the interpreter, and the C sums of splats that train against sums of exact splats.

`numbers.py` asks how exact the four maps are at extreme places; here every other function is run at middling ones, in
both back ends and precisions.
"""

from __future__ import annotations

import ctypes
from collections.abc import Mapping, Sequence
from typing import Any

import mpmath as mp
import numpy as np

from rsrm_gen.compiler.audit.blame import span_of
from rsrm_gen.compiler.audit.numbers import PRECISIONS, Batch, Code, Rows
from rsrm_gen.compiler.audit.report import Check
from rsrm_gen.compiler.derive import Geometry
from rsrm_gen.compiler.derive.numeric import largest
from rsrm_gen.compiler.emit.c_splats import CULLED
from rsrm_gen.compiler.emit.promises import public
from rsrm_gen.compiler.lower import Program, Routine, interpret
from rsrm_gen.compiler.native import TRIED, compiled, compiler, pointer, scratch

TOLERANCE = {"float64": 1e-10, "float32": 1e-2}  # relative to the largest entry; places and splats are middling
POINTS, SPLATS = 7, 4


def check_kernels(code: Code) -> list[Check]:
    """One check a back end and precision of all functions, and one a precision of the fused sums."""
    geometry, program, rows = code.geometry, code.program, code.middling
    checks = [
        _functions_check(geometry, program, backend, batch, precision, rows[precision])
        for precision in PRECISIONS
        for backend, batch in code.backends.items()
    ]
    if compiler() is not None:
        checks += [_sums_check(geometry, program, code.files, precision, rows[precision]) for precision in PRECISIONS]
    return checks


def _functions_check(
    geometry: Geometry, program: Program, backend: str, batch: Batch, precision: str, rows: Rows
) -> Check:
    worst, culprit = 0.0, "exp"
    for routine in public(program):
        inputs = _inputs(routine, rows, precision)
        exact = [[entry for result in interpret(routine, *row) for entry in result] for row in _as_floats(inputs)]
        error = _relative(_as_numbers(batch(routine.name, inputs, precision)), exact)
        if not error <= worst:
            worst, culprit = error, routine.name
    promise = f"every function of the {backend} code in {precision} computes what its formula says"
    name = f"functions {backend} {precision}"
    span = span_of(geometry.spec, culprit)
    return Check(name, promise, worst, TOLERANCE[precision], len(rows.p), f"(in {culprit})", span)


def _sums_check(geometry: Geometry, program: Program, files: Mapping[str, str], precision: str, rows: Rows) -> Check:
    """The fused C sums, forward and backward, with the arithmetic and the vector functions with which they train."""
    dtype = PRECISIONS[precision][0]
    x, mu = rows.q[:POINTS], rows.p[:SPLATS]
    rng = np.random.default_rng(23)
    wide = float(np.linalg.norm(rows.v, axis=-1).mean())
    W = (rng.normal(size=(SPLATS, geometry.spec.dim * geometry.spec.tangent_size)) / (2 * wide)).astype(dtype)
    amplitude = rng.normal(size=(SPLATS, 1)).astype(dtype)
    value_bar = rng.normal(size=(POINTS, 1)).astype(dtype)
    gradient_bar = rng.normal(size=(POINTS, geometry.spec.tangent_size)).astype(dtype)
    library = compiled(files, f"{program.name}_splats.c", TRIED)
    arrays = [np.ascontiguousarray(a) for a in (x, mu, W, amplitude, value_bar, gradient_bar)]
    forward, backward = _exact_pairs(program["splat"], arrays[:4]), _exact_pairs(program["splat_vjp"], arrays)
    expected = {
        "splats": [_over_splats(result) for result in forward],
        "splats_value": [_over_splats(forward[0])],
        "splats_vjp": [_over_points(backward[name]) for name in (0, 1, 2)],
        "splats_rows": [_each(backward[:3])],
    }
    errors = []
    for function, exact in expected.items():
        inputs = arrays if function in ("splats_vjp", "splats_rows") else arrays[:4]
        outputs = [np.empty((len(result), len(result[0])), dtype=dtype) for result in exact]
        _call(library, program.name, function, precision, inputs, outputs)
        found = [_as_numbers(output) for output in outputs]
        if function in ("splats_vjp", "splats_rows"):
            found[0], exact[0] = (_tangent(program, mu, result) for result in (found[0], exact[0]))
        errors += [_relative(a, b) for a, b in zip(found, exact, strict=True)]
    promise = f"the C sums of splats in {precision}, forward and backward, are sums of exact splats"
    worst = float(largest(map(mp.mpf, errors)))
    span = span_of(geometry.spec, "splat")
    return Check(f"sums C {precision}", promise, worst, TOLERANCE[precision], POINTS * SPLATS, "", span)


def _call(
    library: ctypes.CDLL, name: str, function: str, precision: str, inputs: Sequence[Any], outputs: Sequence[Any]
) -> None:
    c_function = getattr(library, f"{name}_{function}" + ("_f" if precision == "float32" else ""))
    work = scratch(library, name, POINTS, SPLATS, 1, PRECISIONS[precision][0])
    width = [None] if function in CULLED else []  # nothing is left out
    pointers = map(pointer, (*inputs[:4], *width, *inputs[4:], *outputs, work))
    c_function(ctypes.c_size_t(POINTS), ctypes.c_size_t(SPLATS), *pointers, ctypes.c_int(1))


Pairs = list[list[list[Any]]]  # of a result: its entries, by point and by splat


def _exact_pairs(routine: Routine, arrays: Sequence[Any]) -> list[Pairs]:
    """Every result of a routine (x, mu, W, amplitude, and adjoints by point) for every point and splat."""
    results: list[Pairs] = [[] for _ in routine.results]
    for n in range(POINTS):
        by_splat = []
        for k in range(SPLATS):
            arguments = (arrays[0][n], *(a[k] for a in arrays[1:4]), *(a[n] for a in arrays[4:]))
            by_splat.append(interpret(routine, *([float(c) for c in a] for a in arguments)))
        for i, result in enumerate(results):
            result.append([entries[i] for entries in by_splat])
    return results


def _over_splats(pairs: Pairs) -> list[list[Any]]:
    return [[mp.fsum(entries) for entries in zip(*by_splat, strict=True)] for by_splat in pairs]


def _over_points(pairs: Pairs) -> list[list[Any]]:
    return [[mp.fsum(entries) for entries in zip(*by_point, strict=True)] for by_point in zip(*pairs, strict=True)]


def _tangent(program: Program, mu: Any, bars: Any) -> list[list[Any]]:
    """The derivatives in mu that the first entries of each row are, as Riemannian gradients: what is normal is free."""
    rows, D = [], len(mu[0])
    for i, bar in enumerate(bars):
        at = [float(c) for c in mu[i % len(mu)]]
        rows.append([*interpret(program["riemannian_gradient"], at, bar[:D])[0], *bar[D:]])
    return rows


def _each(results: Sequence[Pairs]) -> list[list[Any]]:
    """The entries of all results of a pair in one row, points first."""
    return [
        [entry for part in parts for entry in part]
        for by_point in zip(*results, strict=True)
        for parts in zip(*by_point, strict=True)
    ]


def _inputs(routine: Routine, rows: Rows, precision: str) -> list[Any]:
    """Arguments by their names: points, tangent vectors, and random numbers for the rest."""
    rng = np.random.default_rng(29)
    given = {"p": rows.p, "mu": rows.p, "q": rows.q, "x": rows.q, "u": rows.v, "v": rows.v}
    scale = float(np.linalg.norm(rows.v, axis=-1).mean())
    inputs = []
    for parameter in routine.parameters:
        noise = rng.normal(size=(len(rows.p), len(parameter.nodes))) / (2 * scale if parameter.name == "W" else 1)
        inputs.append(given.get(parameter.name, noise).astype(PRECISIONS[precision][0]))
    return inputs


def _as_numbers(array: Any) -> list[list[Any]]:
    return [[mp.mpf(float(a)) for a in row] for row in array]


def _as_floats(inputs: Sequence[Any]) -> list[list[list[float]]]:
    return [[[float(c) for c in x] for x in row] for row in zip(*inputs, strict=True)]


def _relative(found: Any, exact: Sequence[Sequence[Any]]) -> float:
    """The largest error beside the largest exact entry; infinite where the code's result is not finite."""
    if not all(mp.isfinite(a) for row in found for a in row):
        return float("inf")
    pairs = [(mp.mpf(a), b) for row, truth in zip(found, exact, strict=True) for a, b in zip(row, truth, strict=True)]
    scale = largest(b for _, b in pairs)
    error = largest(a - b for a, b in pairs)
    return float(error / scale) if scale > 0 else float(error)
