"""Pairs of points where codes go wrong, with what is true there in 60 digits and the error that nobody can avoid.

A pair is rounded to the precision before any code sees it. The truth is the formula of the manifold file at the points
that the rounded numbers stand for: a code may read numbers beside the manifold in its own way. The unit of error is how
far the truth moves when the numbers are rounded once more, plus the rounding of the result; a matrix is rounded as one,
to parts of its largest entry. A pair with a point that is no further than 64 roundings from the border of the manifold's
domain is left out for every code alike, as in the audit: the rounded numbers do not say which point is meant, or mean one
that does not exist.
"""

from __future__ import annotations

import math
import random
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import mpmath as mp
import numpy as np

from rsrm_gen.compiler.audit.numbers import PRECISIONS, ROUTINES, grain, matrices, rounded, shaken, well_inside
from rsrm_gen.compiler.derive import Geometry
from rsrm_gen.compiler.derive.numeric import DIGITS, TINY, largest, run, value
from rsrm_gen.compiler.derive.sampling import Sampler, sampler_of
from rsrm_gen.compiler.lower import Program, interpret
from rsrm_gen.compiler.spec import ManifoldSpec, Spec

COINCIDENT, NEAR, MIDDLE, FAR = "coincident", "1e-12..1e-2 apart", "middle", "far away, 3..30"
NEAR_RADIUS, AT_RADIUS = "near the injectivity radius", "at the injectivity radius"  # where the cut locus begins
FEWER = 4  # so many times fewer coincident pairs: they are all alike
TRIES = 20  # for pairs that round out of the domain
SHAKES = 6  # roundings of the inputs, of which the worst is the unit

Row = tuple[Any, Any, Any]  # two points and the tangent vector from the first to the second


@dataclass(frozen=True)
class Truth:
    """The exact results of one function at rows (N, entries), and the unit of error of each row (N,)."""

    values: Sequence[Sequence[Any]]
    units: Any


@dataclass(frozen=True)
class Band:
    """Pairs of one kind in one precision: points p and q (N, D), v = Log_p(q) (N, T), and the truth of functions there.

    `left_out` more were asked for, of which in every attempt a point rounded to the border of the domain.
    """

    name: str
    precision: str
    p: Any
    q: Any
    v: Any
    truths: Mapping[str, Truth]
    left_out: int = 0

    def inputs(self, function: str) -> tuple[Any, Any]:
        """The two arguments of a function: a base point and a tangent vector, or two points."""
        return (self.p, self.v) if function == "exp" else (self.p, self.q)


def bands(geometry: Geometry, program: Program, precision: str, count: int) -> Iterator[Band]:
    """All bands of a manifold with `count` pairs each, from a seed: always the same."""
    rng = random.Random(17)
    sampler, whole = sampler_of(geometry), matrices(geometry.spec)
    for name, lengths in _distances(geometry, float(2 * sampler.reach), precision, count).items():
        found = [row for r in lengths if (row := _row(sampler, rng, r, precision, whole)) is not None]
        if found:
            chosen = band(geometry, program, name, precision, found)
            yield replace(chosen, left_out=len(lengths) - len(found))
    if _ties(geometry.spec):
        radius = value(geometry.injectivity_radius, {})
        pairs = range(max(count // FEWER, 1))
        opposite = [_opposite(sampler, rng, radius, k, precision, bool(whole)) for k in pairs]
        yield band(geometry, program, AT_RADIUS, precision, opposite, ("distance", "log_abs_det"))


def band(
    geometry: Geometry,
    program: Program,
    name: str,
    precision: str,
    rows: Sequence[Row],
    functions: Sequence[str] = ROUTINES,
) -> Band:
    """Rows of one kind, already rounded to the precision, with the truth of some functions."""
    p, q, v = (np.stack(column) for column in zip(*rows, strict=True))
    truths = {f: _Exact(geometry, program, f).truth(p, v if f == "exp" else q, precision) for f in functions}
    return Band(name, precision, p, q, v, truths)


class _Exact:
    """One function of a manifold in 60 digits, at the points that numbers stand for."""

    def __init__(self, geometry: Geometry, program: Program, name: str) -> None:
        self.function, self.routine = geometry[name], program[name]
        spec = geometry.spec
        self.project = geometry["project"] if spec.embedded else None
        ambient = isinstance(spec, ManifoldSpec) and spec.ambient_tangents
        self.to_tangent = geometry["to_tangent"] if ambient and name == "exp" else None
        self.second_is_point = name != "exp"
        self.whole = matrices(spec)

    def truth(self, a: Any, b: Any, precision: str) -> Truth:
        """The values at rows of arguments, and what rounding the arguments and the result alone costs."""
        eps = PRECISIONS[precision][2]
        rng = random.Random(13)
        values, units = [], []
        for row in zip(a, b, strict=True):
            given = [[mp.mpf(float(c)) for c in x] for x in row]
            exact = self.at(given, eps)
            sizes = [
                grain(x, self.whole if point else ())
                for x, point in zip(given, (True, self.second_is_point), strict=True)
            ]
            moved = mp.mpf(0)
            for _ in range(SHAKES):
                with mp.workdps(DIGITS):
                    near = [shaken(x, entries, eps, rng) for x, entries in zip(given, sizes, strict=True)]
                there = self.at(near, eps)
                moved = max(moved, largest(x - y for x, y in zip(there, exact, strict=True)))
            values.append(exact)
            units.append(float(moved) + 2 * eps * float(largest(exact)) + np.finfo(precision).tiny)
        return Truth(values, np.array(units))

    def at(self, given: Sequence[Sequence[Any]], eps: float) -> list[Any]:
        """The formula; where it is 0/0, because the points are one, the routine with its series."""
        with mp.workdps(DIGITS):
            p, x = given
            if self.project is not None:
                p = run(self.project, p)[0]
                x = run(self.project, x)[0] if self.second_is_point else x
            if self.to_tangent is not None:
                x = run(self.to_tangent, p, x)[0]
            exact = run(self.function, p, x, eps=2 * eps)[0]
            return exact if mp.isfinite(largest(exact)) else interpret(self.routine, p, x, digits=DIGITS)[0]


def _distances(geometry: Geometry, whole: float, precision: str, count: int) -> dict[str, list[float]]:
    """How far apart the points of every band are; `whole` is the injectivity radius, or two units where there is none."""
    steps = [k / max(count - 1, 1) for k in range(count)]
    # Nearer to the injectivity radius than this, rounding alone would carry a point across the cut locus.
    closest = 9.0 if precision == "float64" else 4.0
    last = (
        {NEAR_RADIUS: [whole * (1 - 10.0 ** -(1 + (closest - 1) * s)) for s in steps]}
        if geometry.injectivity_radius.is_finite
        else {FAR: [whole / 2 * (3 + 27 * s) for s in steps]}
    )
    return {
        COINCIDENT: [0.0] * max(count // FEWER, 1),
        NEAR: [10.0 ** -(2 + 10 * s) for s in steps],
        MIDDLE: [whole * (k + 0.5) / (count + 0.5) for k in range(count)],
        **last,
    }


def _ties(spec: Spec) -> bool:
    """Whether on the cut locus only Log is in doubt, between ways of one length: the determinant is the same of all."""
    cut = spec.cut_locus if isinstance(spec, ManifoldSpec) and spec.embedded else None
    return cut is not None and cut.log is None and cut.log_det is None


def _row(sampler: Sampler, rng: random.Random, r: float, precision: str, whole: Sequence[slice]) -> Row | None:
    """Two points at a distance and the vector between them, rounded; None if they always round out of the domain."""
    for _ in range(TRIES):
        p = sampler.point(rng)
        v = [mp.mpf(r) * c for c in sampler.direction(rng, p)]
        q = sampler.along(p, v, mp.mpf(1)) if r else p
        p, q, v = (rounded(x, precision) for x in (p, q, v))
        if all(well_inside(sampler, x, precision, whole) for x in (p, q)):
            return p, q, v
    return None


def _opposite(sampler: Sampler, rng: random.Random, radius: Any, k: int, precision: str, matrix: bool) -> Row:
    """A coordinate axis, or the unit matrix, and a point at the injectivity radius from it, with the zeros that are exact."""
    assert sampler.project is not None
    size = sampler.point_size
    with mp.workdps(DIGITS):
        start = np.eye(math.isqrt(size)).ravel() if matrix else np.eye(size)[k % size]
        p = run(sampler.project, [mp.mpf(c) for c in start])[0]
        v = [radius * c for c in sampler.direction(rng, p)]
        q = [c if abs(c) > TINY else mp.mpf(0) for c in sampler.along(p, v, mp.mpf(1))]
    return rounded(p, precision), rounded(q, precision), rounded(v, precision)
