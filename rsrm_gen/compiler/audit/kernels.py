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
from rsrm_gen.compiler.emit.promises import public
from rsrm_gen.compiler.lower import Program, Routine, interpret
from rsrm_gen.compiler.native import TRIED, compiled, compiler, pointer

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
        error = _relative(batch(routine.name, inputs, precision), exact)
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
    errors = []
    for routine, bars in ((program["splat"], ()), (program["splat_vjp"], (value_bar, gradient_bar))):
        by_point = routine.name == "splat"
        sizes = [len(result.nodes) for result in routine.results]
        found = [np.empty((POINTS if by_point else SPLATS, size), dtype=dtype) for size in sizes]
        _call(library, program.name, routine.name, precision, (x, mu, W, amplitude, *bars), found)
        exact = _exact_sums(routine, x, (mu, W, amplitude), bars, by_point)
        errors += [_relative(a, b) for a, b in zip(found, exact, strict=True)]
    promise = f"the C sums of splats in {precision}, forward and backward, are sums of exact splats"
    worst = float(largest(map(mp.mpf, errors)))
    span = span_of(geometry.spec, "splat")
    return Check(f"sums C {precision}", promise, worst, TOLERANCE[precision], POINTS * SPLATS, "", span)


def _call(
    library: ctypes.CDLL, name: str, routine: str, precision: str, inputs: Sequence[Any], outputs: Sequence[Any]
) -> None:
    suffix = "_f" if precision == "float32" else ""
    function = getattr(library, f"{name}_{routine.replace('splat', 'splats', 1)}{suffix}")
    arrays = [np.ascontiguousarray(a) for a in inputs]
    function(ctypes.c_size_t(POINTS), ctypes.c_size_t(SPLATS), *map(pointer, (*arrays, *outputs)))


def _exact_sums(
    routine: Routine, x: Any, splats: Sequence[Any], bars: Sequence[Any], by_point: bool
) -> list[list[list[Any]]]:
    """Every result summed over the splats for each point, or over the points for each splat."""
    outer, inner = (range(POINTS), range(SPLATS)) if by_point else (range(SPLATS), range(POINTS))
    totals: list[list[list[Any]]] = [[] for _ in routine.results]
    for i in outer:
        parts = []
        for j in inner:
            n, k = (i, j) if by_point else (j, i)
            arguments = (x[n], *(a[k] for a in splats), *(b[n] for b in bars))
            parts.append(interpret(routine, *([float(c) for c in a] for a in arguments)))
        for result, total in enumerate(totals):
            total.append([mp.fsum(entries) for entries in zip(*(part[result] for part in parts), strict=True)])
    return totals


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


def _as_floats(inputs: Sequence[Any]) -> list[list[list[float]]]:
    return [[[float(c) for c in x] for x in row] for row in zip(*inputs, strict=True)]


def _relative(found: Any, exact: Sequence[Sequence[Any]]) -> float:
    """The largest error beside the largest exact entry; infinite where the code's result is not finite."""
    if not np.all(np.isfinite(found)):
        return float("inf")
    pairs = [
        (mp.mpf(float(a)), b) for row, truth in zip(found, exact, strict=True) for a, b in zip(row, truth, strict=True)
    ]
    scale = largest(b for _, b in pairs)
    error = largest(a - b for a, b in pairs)
    return float(error / scale) if scale > 0 else float(error)
