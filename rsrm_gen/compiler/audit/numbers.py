"""The numbers of the generated code against the formulas in 60 digits.

The unit of an error is what no code can avoid: how far the result moves when the inputs are rounded, and the rounding
of the result itself. A row passes if its error is at most 64 such units.
"""

from __future__ import annotations

import ctypes
import itertools
import random
import tempfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from pathlib import Path
from typing import Any

import mpmath as mp
import numpy as np
import torch

from rsrm_gen.compiler.audit.blame import span_of
from rsrm_gen.compiler.audit.digits import NEAR_CUT, UNITS, digits_lost, distances
from rsrm_gen.compiler.audit.report import Check
from rsrm_gen.compiler.derive import Geometry
from rsrm_gen.compiler.derive.geometry import Function
from rsrm_gen.compiler.derive.numeric import DIGITS, largest, run
from rsrm_gen.compiler.derive.sampling import Sampler, sampler_of
from rsrm_gen.compiler.emit import Measurement
from rsrm_gen.compiler.lower import Program, Routine, interpret
from rsrm_gen.compiler.native import EXACT, compiled, compiler, pointer
from rsrm_gen.compiler.spec import ManifoldSpec, Spec
from rsrm_gen.files import imported

SHAKES = ((1, 1), (1, 1), (1, 0), (0, 1))  # which inputs are rounded: both, or one, for close points may move together
ARGUMENTS = {"exp": ("p", "v"), "log": ("p", "q"), "distance": ("p", "q"), "log_abs_det": ("p", "q")}
ROUTINES = tuple(ARGUMENTS)
PRECISIONS: dict[str, tuple[Any, torch.dtype, float]] = {
    "float64": (np.float64, torch.float64, 2.0**-53),
    "float32": (np.float32, torch.float32, 2.0**-24),
}

Batch = Callable[[str, Sequence[Any], str], Any]  # (routine, arrays of rows, precision) -> rows of all results


@dataclass(frozen=True)
class Rows:
    """Pairs of points in one precision (N, D), and the tangent vectors from the first to the second."""

    p: Any
    q: Any
    v: Any
    kinds: tuple[str, ...]


@dataclass(frozen=True)
class Code:
    """The generated files of a manifold, loaded once, and the rows at which they are tried."""

    geometry: Geometry
    program: Program
    files: Mapping[str, str]

    @cached_property
    def manifold(self) -> Any:
        """The object of the generated torch module."""
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / f"{self.program.name}.py"
            path.write_text(self.files[path.name], encoding="utf-8")
            return imported(path, keep=False).manifold

    @cached_property
    def backends(self) -> Mapping[str, Batch]:
        """The functions in torch, and in C where there is a compiler, on arrays of rows."""
        native = {"C": _native_batch(self.program, self.files)} if compiler() is not None else {}
        return {"torch": _torch_batch(self.manifold, self.program), **native}

    @cached_property
    def rows(self) -> Mapping[str, Rows]:
        """The rows of each precision."""
        return {precision: sample_rows(self.geometry, precision) for precision in PRECISIONS}

    @cached_property
    def middling(self) -> Mapping[str, Rows]:
        """Some of the rows that are neither close nor far, of each precision."""
        return {precision: _middling(rows) for precision, rows in self.rows.items()}


def check_numbers(code: Code) -> tuple[list[Check], tuple[Measurement, ...]]:
    """Checks of torch and C in both precisions; the worst of both back ends is the measurement."""
    geometry, program, backends = code.geometry, code.program, code.backends
    checks, measured = [], []
    for precision, rows in code.rows.items():
        where = {names: places(geometry, names, rows, precision) for names in set(ARGUMENTS.values())}
        for name in ROUTINES:
            truth, unit = truths(geometry[name], program[name], where[ARGUMENTS[name]], precision)
            errors = {
                backend: _errors(
                    batch(name, [getattr(rows, argument) for argument in ARGUMENTS[name]], precision), truth, unit
                )
                for backend, batch in backends.items()
            }
            checks += [_check(geometry, program, name, backend, precision, e, rows) for backend, e in errors.items()]
            worst = max(float(e.max()) for e in errors.values())
            measured.append(Measurement(name, precision, _power_of_two(worst), len(rows.kinds)))
    return checks, tuple(measured)


def _check(
    geometry: Geometry, program: Program, name: str, backend: str, precision: str, errors: Any, rows: Rows
) -> Check:
    worst = int(np.argmax(errors))
    kind = rows.kinds[worst]
    promise = f"{name} of the {backend} code in {precision} is as exact as its inputs allow"
    hint = None
    if kind == NEAR_CUT and geometry.spec.cut_locus is not None and not np.isfinite(errors[worst]):
        hint = "say under `cut_locus:` what `log:` and `log_det:` are there, as manifolds/sphere.yaml does"
    span, unit = span_of(geometry.spec, name), PRECISIONS[precision][2]
    title, error = f"{name} {backend} {precision}", float(errors[worst])
    lost = digits_lost(geometry, name, program[name]) if not error <= UNITS else None
    if lost is not None:
        span, hint = lost.span, lost.advice
    return Check(title, promise, error, UNITS, len(errors), f"({kind})", span, hint, unit)


def _torch_batch(manifold: Any, program: Program) -> Batch:
    """The generated torch class on arrays of rows."""

    def batch(name: str, rows: Sequence[Any], precision: str) -> Any:
        shapes = [parameter.shape for parameter in program[name].parameters]
        tensors = [
            torch.as_tensor(r, dtype=PRECISIONS[precision][1]).reshape(len(r), *s)
            for r, s in zip(rows, shapes, strict=True)
        ]
        result = getattr(manifold, "_sample" if name == "sample" else name)(*tensors)
        results = result if isinstance(result, tuple) else (result,)
        return np.concatenate([part.numpy().reshape(len(rows[0]), -1) for part in results], -1)

    return batch


def _native_batch(program: Program, files: Mapping[str, str]) -> Batch:
    """The `_batch` functions of the generated C on arrays of rows."""
    library = compiled(files, f"{program.name}.c", EXACT)

    def batch(name: str, rows: Sequence[Any], precision: str) -> Any:
        dtype = PRECISIONS[precision][0]
        function = getattr(library, f"{program.name}_{name}_batch" + ("_f" if precision == "float32" else ""))
        inputs = [np.ascontiguousarray(r, dtype=dtype) for r in rows]
        outputs = [np.empty((len(inputs[0]), len(result.nodes)), dtype=dtype) for result in program[name].results]
        function(ctypes.c_size_t(len(inputs[0])), *map(pointer, (*inputs, *outputs)))
        return np.concatenate(outputs, -1)

    return batch


def sample_rows(geometry: Geometry, precision: str) -> Rows:
    """Close by (1e-12 .. 1e-2), in the middle, and near the cut locus or far away; rounded to the precision."""
    sampler: Sampler = sampler_of(geometry)
    rng = random.Random(11)
    kinds, rows = [], []
    for kind, r in distances(geometry):
        p = sampler.point(rng)
        v = [r * c for c in sampler.direction(rng, p)]
        row = [rounded(x, precision) for x in (p, sampler.along(p, v, mp.mpf(1)), v)]
        if all(well_inside(sampler, x, precision) for x in row[:2]):  # far points may round out of the domain
            kinds.append(kind)
            rows.append(row)
    stacked = [np.stack(column) for column in zip(*rows, strict=True)]
    return Rows(stacked[0], stacked[1], stacked[2], tuple(kinds))


MIDDLING = 14  # rows, for what is not asked to be exact to the last bits


def _middling(rows: Rows) -> Rows:
    """Some of the rows that are neither close nor far."""
    keep = [i for i, kind in enumerate(rows.kinds) if kind == "middle"][:MIDDLING]
    return Rows(rows.p[keep], rows.q[keep], rows.v[keep], tuple(rows.kinds[i] for i in keep))


def well_inside(sampler: Sampler, x: Sequence[Any], precision: str, whole: Sequence[slice] = ()) -> bool:
    """Whether a point satisfies the condition of the domain, and does so when shaken by as much as an error may be.

    The entries in `whole` are a matrix, and shaken as one: by parts of its largest entry.
    """
    if sampler.domain is None:
        return True
    rng, eps = random.Random(17), UNITS * PRECISIONS[precision][2]
    with mp.workdps(DIGITS):
        point = [mp.mpf(float(c)) for c in x]
        neighbours = [shaken(point, grain(point, whole), eps, rng) for _ in range(4)]
    return all(sampler.inside(y) for y in (point, *neighbours))


def shaken(x: Sequence[Any], sizes: Sequence[Any], eps: float, rng: random.Random) -> list[Any]:
    """Numbers that are larger or smaller than those of x by eps of some sizes."""
    return [c + (size if c >= 0 else -size) * eps * rng.choice((-1, 1)) for c, size in zip(x, sizes, strict=True)]


def rounded(x: Sequence[Any], precision: str) -> Any:
    """Numbers in one of the two precisions."""
    return np.array([float(c) for c in x]).astype(PRECISIONS[precision][0])


def matrices(spec: Spec, start: int = 0) -> list[slice]:
    """Which entries of a point are a matrix."""
    if isinstance(spec, ManifoldSpec):
        return [slice(start, start + spec.point_size)] if len(spec.point_shape) == 2 else []
    found = []
    for factor in spec.factors:
        found += matrices(factor.spec, start)
        start += factor.spec.point_size
    return found


@dataclass(frozen=True)
class Place:
    """The inputs that a row's rounded numbers stand for, in high precision, and those of its neighbours."""

    inputs: Sequence[Sequence[Any]]
    neighbours: Sequence[tuple[int, Sequence[Sequence[Any]]]]  # with how many roundings they are away


def places(geometry: Geometry, names: Sequence[str], rows: Rows, precision: str) -> list[Place]:
    """What the rows stand for, as arguments of these names ("p", "q" or "v"), and what they would if rounded otherwise.

    Rounding moves a point off the manifold; what it stands for is its projection. A matrix is rounded as one: to parts of
    its largest entry.
    """
    eps, whole = PRECISIONS[precision][2], matrices(geometry.spec)
    project = geometry["project"] if geometry.spec.embedded else None
    shakers = [random.Random(name) for name in names]  # so that a point is shaken alike whatever comes with it
    found = []
    for kind, *inputs in zip(rows.kinds, *(getattr(rows, name) for name in names), strict=True):
        given = [[mp.mpf(float(c)) for c in x] for x in inputs]
        entries = [grain(x, whole if name != "v" else ()) for name, x in zip(names, given, strict=True)]
        neighbours = []
        far = 4 if kind == NEAR_CUT else 1  # the cut locus may run between a row and its neighbours
        for away, shake in itertools.product(range(1, far + 1), SHAKES):
            with mp.workdps(DIGITS):
                near = [
                    [c + s * away * eps * size * rng.choice((-1, 1)) for c, size in zip(x, sizes, strict=True)]
                    for x, sizes, s, rng in zip(given, entries, shake, shakers, strict=True)
                ]
            neighbours.append((away, _meant(project, names, near)))
        found.append(Place(_meant(project, names, given), neighbours))
    return found


def truths(function: Function, routine: Routine, where: Sequence[Place], precision: str) -> tuple[list[list[Any]], Any]:
    """The exact results (N, entries), and the unavoidable error of each row (N,)."""
    eps, tiny = PRECISIONS[precision][2], np.finfo(PRECISIONS[precision][0]).tiny
    results, units = [], []
    for place in where:
        exact = _exact(function, routine, place.inputs, eps)
        there = [(away, _exact(function, routine, inputs, eps)) for away, inputs in place.neighbours]
        moved = max(_largest(a - b for a, b in zip(result, exact, strict=True)) / away for away, result in there)
        results.append(exact)
        units.append(moved + 2 * eps * _largest(exact) + tiny)
    return results, np.array(units)


def _meant(project: Function | None, names: Sequence[str], inputs: Sequence[Sequence[Any]]) -> Sequence[Sequence[Any]]:
    """The same inputs with their points on the manifold."""
    if project is None:
        return inputs
    return [x if name == "v" else _projected(project, tuple(x)) for name, x in zip(names, inputs, strict=True)]


@lru_cache(maxsize=1024)
def _projected(project: Function, x: tuple[Any, ...]) -> Sequence[Any]:
    """A point on the manifold; asked for again wherever only the other input of a row was shaken."""
    return run(project, x)[0]


def grain(x: Sequence[Any], whole: Sequence[slice]) -> list[Any]:
    """The size of what every entry is a part of: itself, or a matrix."""
    sizes = [abs(c) for c in x]
    for part in whole:
        sizes[part] = [largest(x[part])] * len(x[part])
    return sizes


def _exact(function: Function, routine: Routine, inputs: Sequence[Sequence[Any]], eps: float) -> list[Any]:
    """The formula in 60 digits; where close points rounded to one and it is 0/0, the routine with its series."""
    with mp.workdps(DIGITS):
        exact = run(function, *inputs, eps=2 * eps)[0]
    return exact if mp.isfinite(largest(exact)) else interpret(routine, *inputs, digits=DIGITS)[0]


def _largest(numbers: Any) -> float:
    return float(largest(numbers))


def _errors(found: Any, truth: Sequence[Sequence[Any]], unit: Any) -> Any:
    """The largest error of each row in its unit; infinite where the code's result, or the unit itself, is not finite."""
    worst = []
    for row, exact, u in zip(found, truth, unit, strict=True):
        finite = np.all(np.isfinite(row)) and np.isfinite(u)
        worst.append(_largest(mp.mpf(float(a)) - b for a, b in zip(row, exact, strict=True)) / u if finite else np.inf)
    return np.array(worst)


def _power_of_two(x: float) -> int:
    bound = 1
    while bound < x and bound < 2**40:
        bound *= 2
    return bound
