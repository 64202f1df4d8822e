"""Where a formula itself loses digits, how many, and what to write instead.

A formula loses digits when what it computes is far more exact than how: acos(dot(p, q)) knows the angle of two close
points only to 1e-8, for a cosine near 1 hardly changes. The loss is measured, in double precision against 60 digits; the
part of the formula to blame is one of a table of well-known patterns, the one whose own value is the worst.
"""

from __future__ import annotations

import math
import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import mpmath as mp

from rsrm_gen.compiler.audit.blame import map_of
from rsrm_gen.compiler.derive import Geometry
from rsrm_gen.compiler.derive.geometry import argument
from rsrm_gen.compiler.derive.numeric import DIGITS, largest, run
from rsrm_gen.compiler.derive.sampling import Numbers, sampler_of
from rsrm_gen.compiler.derive.scalarise import scalarised
from rsrm_gen.compiler.lower import Routine, interpret
from rsrm_gen.compiler.lower.lower import routine_of
from rsrm_gen.compiler.spec import ManifoldSpec, Map
from rsrm_gen.compiler.spec import formula as f
from rsrm_gen.compiler.spec.model import Formula
from rsrm_gen.compiler.spec.unparse import written
from rsrm_gen.errors import Span

DOUBLE = 15  # mpmath's name for 53 bits
HALF_LOST = 2.0**-40  # relative: what a part may be wrong by without being remarkable
WHOLE = 16  # digits of a double
EPS = mp.mpf(2) ** -53
UNITS = 64.0  # of error pass
NEAR_CUT = "near the cut locus"
PLACES = {"near": "near coincident points", "middle": "at middling distances", "far": "far away"}


@dataclass(frozen=True)
class Part:
    """A part of a formula that is known to lose digits, and what to write instead."""

    tree: f.Tree
    better: str


@dataclass(frozen=True)
class Lost:
    """So many units of error where the exact points are of a kind, and the part of the formula that makes it."""

    units: float
    kind: str
    part: Part

    @property
    def span(self) -> Span:
        """Where the part stands."""
        return self.part.tree.span

    @property
    def advice(self) -> str:
        """What is lost, where, and what to write."""
        lost = min(WHOLE, round(math.log10(self.units))) if math.isfinite(self.units) else WHOLE
        place = PLACES.get(self.kind, self.kind)
        return f"`{written(self.part.tree)}` loses {lost} of {WHOLE} digits {place}: write {self.part.better} instead"


def digits_lost(geometry: Geometry, name: str, routine: Routine) -> Lost | None:
    """The worst loss of exp, log, distance or log_abs_det in double precision, if a part of its formula explains it.

    Points are exact and on the manifold, and are rounded only for the double precision: close by, the exact formula may
    have no value at rounded points. The unit is how far the result moves when the points move on the manifold by as much.
    """
    spec, sampler, rng = geometry.spec, sampler_of(geometry), random.Random(17)
    if not isinstance(spec, ManifoldSpec):
        return None
    worst: tuple[float, str, list[Numbers]] = (0.0, "", [])
    for kind, r in distances(geometry):
        p = sampler.point(rng)
        v = [r * c for c in sampler.direction(rng, p)]
        inputs = [p, v if name == "exp" else sampler.along(p, v, mp.mpf(1))]
        units = _units(geometry, name, routine, inputs, rng)
        if worst[0] < units < math.inf:  # no number at all says less than a number that is wrong
            worst = (units, kind, inputs)
    part = lossy_part(spec, map_of(spec, name), worst[2]) if worst[0] > UNITS else None
    return Lost(worst[0], worst[1], part) if part else None


def _units(geometry: Geometry, name: str, routine: Routine, inputs: list[Numbers], rng: random.Random) -> float:
    """The error of double precision at some points, in units; infinite where it gives no number."""
    exact = interpret(routine, *inputs)[0]
    found = interpret(routine, *([float(c) for c in x] for x in inputs), digits=DOUBLE)[0]
    with mp.workdps(DIGITS):
        shaken = [[c * (1 + EPS * rng.choice((-1, 1))) for c in x] for x in inputs]
        if geometry.spec.embedded:
            points = 1 if name == "exp" else 2
            shaken[:points] = [run(geometry["project"], x)[0] for x in shaken[:points]]
        moved = largest(a - b for a, b in zip(interpret(routine, *shaken)[0], exact, strict=True))
        error = largest(a - b for a, b in zip(found, exact, strict=True))
        return float(error / (moved + 2 * EPS * largest(exact) + EPS * EPS)) if mp.isfinite(error) else math.inf


def lossy_part(spec: ManifoldSpec, chart_map: Map, inputs: Sequence[Sequence[Any]]) -> Part | None:
    """The part of a map, of those that are known to lose digits, whose value is the worst in double precision there."""
    errors = [(_relative_error(spec, chart_map, part.tree, inputs), k, part) for k, part in enumerate(parts(chart_map))]
    worst = max(errors, default=None)
    return worst[2] if worst is not None and worst[0] > HALF_LOST else None


def parts(chart_map: Map) -> Iterator[Part]:
    """The parts of a map, its `let`s included, that the table knows."""
    for formula in (*(formula for _, formula in chart_map.lets), chart_map.value):
        for tree in _walk(formula.tree):
            better = advice(tree)
            if better is not None:
                yield Part(tree, better)


def advice(tree: f.Tree) -> str | None:
    """What to write instead of a formula that loses digits to cancellation; None if it is not in the table."""
    match tree:
        case f.Call("acos", (f.Call("dot", (a, b), _),), _):
            a_, b_ = written(a), written(b)
            return f"`2 * atan2(norm({b_} - {a_}), norm({b_} + {a_}))`, exact at 0 and at pi"
        case f.Call("acos", (x,), _):
            return f"`atan2(s, {written(x)})` with a sine s that is computed from differences"
        case f.Call("acosh", (x,), _):
            return (
                "`2 * asinh(sqrt(c) / 2)` with the squared chord c computed from q - p, as in manifolds/hyperbolic.yaml"
            )
        case f.Call(
            "sqrt", (f.Binary("-", f.Number(value=one), f.Binary("^", f.Call("dot", (a, b), _), _, _), _),), _
        ) if one == 1:
            a_, b_ = written(a), written(b)
            return f"`norm(d - dot({a_}, d) * {a_})` with d = {b_} - {a_}"
        case f.Call(
            "sqrt", (f.Binary("-", _, f.Number(value=one), _) | f.Binary("-", f.Number(value=one), _, _),), _
        ) if one == 1:
            return "a norm of differences, or `sinh(r)` or `sin(t)` of an angle that is known"
        case f.Call(
            "log", (f.Binary("+", f.Number(value=one), x, _) | f.Binary("+", x, f.Number(value=one), _),), _
        ) if one == 1:
            return f"`2 * atanh(x / (2 + x))` with x = {written(x)}"
        case f.Binary("-", f.Call("cosh", (x,), _), f.Number(value=one), _) if one == 1:
            return f"`2 * sinh({_half(x)})^2`"
        case f.Binary("-", f.Number(value=one), f.Call("cos", (x,), _), _) if one == 1:
            return f"`2 * sin({_half(x)})^2`"
        case f.Binary("-", f.Call("exp", (x,), _), f.Number(value=one), _) if one == 1:
            return f"`2 * exp({_half(x)}) * sinh({_half(x)})`"
        case f.Binary("-", f.Number(value=one), f.Call("dot", (a, b), _), _) if one == 1:
            return f"`dot(d, d) / 2` with d = {written(b)} - {written(a)}, for unit vectors"
        case f.Binary("-", f.Name() as b, f.Binary("*", f.Call("dot", _, _), f.Name() as a, _), _):
            return f"`d - dot({written(a)}, d) * {written(a)}` with d = {written(b)} - {written(a)}"
    return None


def _half(tree: f.Tree) -> str:
    text = written(tree)
    return f"({text}) / 2" if isinstance(tree, f.Binary) else f"{text} / 2"


def _walk(tree: f.Tree) -> Iterator[f.Tree]:
    """A tree and all its branches."""
    yield tree
    match tree:
        case f.Negate():
            children: tuple[f.Tree | None, ...] = (tree.operand,)
        case f.Binary() | f.Compare():
            children = (tree.left, tree.right)
        case f.Call():
            children = tree.arguments
        case f.Stack() | f.Rows():
            children = tree.items
        case f.Index():
            children = (tree.base,)
        case _:
            children = ()
    for child in children:
        if child is not None:
            yield from _walk(child)


def _relative_error(spec: ManifoldSpec, chart_map: Map, tree: f.Tree, inputs: Sequence[Sequence[Any]]) -> float:
    """How wrong a part of a map is in double precision, relative to itself."""
    sizes = {"p": spec.point_size, "q": spec.point_size, "v": spec.tangent_size}
    arguments = tuple(argument(name, sizes[name]) for name in chart_map.arguments)
    part = Map(chart_map.arguments, chart_map.lets, Formula(written(tree), tree, (), tree.span))
    entries = scalarised(spec, "part", part, arguments, ())
    routine = routine_of(entries)
    exact, double = (interpret(routine, *inputs, digits=digits)[0] for digits in (DIGITS, DOUBLE))
    with mp.workdps(DIGITS):
        size = largest(exact)
        error = largest(a - b for a, b in zip(exact, double, strict=True))
        return float(error / size) if size > 0 and mp.isfinite(size) else math.inf if error > 0 else 0.0


def distances(geometry: Geometry) -> list[tuple[str, Any]]:
    """How far apart the points are at which numbers are tried, in kinds: close by, middling, and at the end or far away."""
    reach = sampler_of(geometry).reach
    whole = reach * 2
    near = [("near", whole * mp.mpf(10) ** -k) for k in range(2, 13)]
    middle = [("middle", whole * mp.mpf(k) / 17) for k in range(1, 17)]
    if geometry.injectivity_radius.is_finite:
        return near + middle + [(NEAR_CUT, whole * (1 - mp.mpf(10) ** -k)) for k in range(1, 10)]
    return near + middle + [("far", reach * k) for k in (3, 6, 10, 15, 20, 30)]
