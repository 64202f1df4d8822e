"""The laws of the whole manifold: the names of points, periods, the cut locus, triangles, the diameter.

Those of `laws.py` look at pairs inside the injectivity radius; these at points that may be anywhere.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import mpmath as mp

from rsrm_gen.compiler.audit.report import Check
from rsrm_gen.compiler.audit.worst import Worst, at, difference, ratio, relative
from rsrm_gen.compiler.derive.geometry import EQUAL, Function, argument
from rsrm_gen.compiler.derive.numeric import DIGITS, largest, run, value
from rsrm_gen.compiler.derive.scalarise import Reading
from rsrm_gen.compiler.derive.trace import Trace
from rsrm_gen.compiler.derive.values import Truth

if TYPE_CHECKING:
    from rsrm_gen.compiler.audit.laws import Laws, Numbers

PAIRS, WALKS = 16, 3
DIRECTIONS = 2  # in which the cut locus is looked for
HALVINGS, FINE = 42, 90  # the finer for the edge of a region of the size of eps
NEARLY = mp.mpf(10) ** -6  # a condition that holds to this is reached: it may meet the cut locus like a square root
COARSE = 15  # digits where only the size of a distance counts
LEVELS = (11, 3)  # of ever smaller steps, for one end and then for the other
REACHED = 0.98  # of the diameter by the pair found to be farthest apart, at least
FACTOR = 10  # between the determinant declared on the cut locus and the one beside it, at most


def log_reaches_every_point(laws: Laws) -> Check:
    """Exp_p(Log_p(q)) = q wherever p and q are."""
    worst, mirrored = Worst(), True
    for _ in range(PAIRS):
        p, q = anywhere(laws), anywhere(laws)
        there = laws.call("exp", p, laws.call("log", p, q))
        error = laws.apart(there, q)
        mirrored = mirrored and (error < NEARLY or relative([a + b for a, b in zip(there, q, strict=True)], q) < NEARLY)
        worst = worst.with_error(error, at("p", p, "q", q))
    hint = "it is -q there: if q and -q are the same point, say so: `equivalent: -p`"
    embedded = laws.spec.embedded and laws.spec.equivalent is None
    promise = "Exp_p(Log_p(q)) = q wherever p and q are"
    return laws.check("exp(log) anywhere", promise, worst, laws.spec.log, hint=hint if mirrored and embedded else None)


def equivalent_points_are_one(laws: Laws) -> Check | None:
    """Log does not see which name a point has, and the other name of the other name is the first."""
    other = laws.spec.equivalent
    if other is None:
        return None
    worst = Worst()
    for p, q in laws.pairs:
        named = laws.other_name(q)
        v = laws.call("log", p, q)
        moved = relative(difference(laws.call("log", p, named), v), v)
        again = relative(difference(laws.other_name(named), q), q)
        worst = worst.with_error(largest([moved, again, laws.off_manifold(named)]), at("p", p, "q", q))
    return laws.check("quotient", "Log_p(q) is the same for every name of q", worst, other)


def periods_do_not_matter(laws: Laws) -> Check | None:
    """Log does not see a coordinate's full turn."""
    if laws.geometry.periods is None:
        return None
    worst, blamed = Worst(), None
    for i, period in enumerate(laws.geometry.periods):
        if period is None:
            continue
        assert laws.spec.periods is not None
        blamed = blamed or laws.spec.periods[i]
        for p, q in laws.pairs:
            turned = [c + (value(period, {}) if k == i else 0) for k, c in enumerate(q)]
            v = laws.call("log", p, q)
            worst = worst.with_error(relative(difference(laws.call("log", p, turned), v), v), at("p", p, "q", q))
    return laws.check("period", "Log_p(q) is the same when a coordinate of q goes through its period", worst, blamed)


def cut_locus_is_reached(laws: Laws) -> Check | None:
    """Where the author declares Log: Exp of it is the point, and it is as long as the injectivity radius."""
    cut = laws.spec.cut_locus
    if cut is None or cut.log is None or laws.spec.injectivity_radius is None:
        return None
    worst, radius = Worst(), value(laws.geometry.injectivity_radius, {})
    for p, q in pairs_on_the_cut(laws):
        v = laws.call("log", p, q)
        length = ratio(laws.call("norm", p, v)[0], radius)
        worst = worst.with_error(
            largest([laws.apart(laws.call("exp", p, v), q), length - 1]), at("p", p, "q", q), length
        )
    hint = worst.same_ratio("its length is {} times the injectivity radius")
    promise = "Log on the cut locus leads there, over the injectivity radius"
    return laws.check("cut locus", promise, worst, cut.log, hint=hint)


def pairs_on_the_cut(laws: Laws) -> list[tuple[Numbers, Numbers]]:
    """Pairs whose Log the author declares: as far apart as the injectivity radius."""
    cut = laws.spec.cut_locus
    if cut is None or cut.log is None or laws.spec.injectivity_radius is None:
        return []
    radius = value(laws.geometry.injectivity_radius, {})
    return [(p, laws.sampler.along(p, laws.sampler.direction(laws.rng, p), radius)) for p, _ in laws.pairs[::4]]


def cut_locus_is_where_it_is_declared(laws: Laws) -> Check | None:
    """`where` does not hold inside the injectivity radius, and holds where Log ceases to undo Exp."""
    cut = laws.spec.cut_locus
    if cut is None or laws.spec.injectivity_radius is None:
        return None
    condition = _Condition(laws)
    radius = value(laws.geometry.injectivity_radius, {})
    worst = Worst()
    for p, _ in laws.pairs[:DIRECTIONS]:
        u = laws.sampler.direction(laws.rng, p)
        for part in ("0.3", "0.6", "0.9", "0.999"):
            q = laws.sampler.along(p, u, radius * mp.mpf(part))
            worst = worst.with_error(int(condition.holds(p, q)), at("p", p, "q", q))
        end = cut_time(laws, p, u, radius)
        if end is not None:
            q = laws.sampler.along(p, u, end)
            worst = worst.with_error(int(not condition.nearly(p, q)), at("p", p, "q", q))
    promise = "`where` holds on the cut locus and not before it (error 1: it is otherwise)"
    return replace(laws.check("cut locus place", promise, worst, cut.where), unit=None)


def log_det_continues_onto_the_cut(laws: Laws) -> Check | None:
    """The log det declared in a small region around the cut locus is about what it is just outside."""
    cut = laws.spec.cut_locus
    if cut is None or cut.log_det is None or laws.spec.injectivity_radius is None:
        return None
    condition, radius = _Condition(laws), value(laws.geometry.injectivity_radius, {})
    if condition.kind == EQUAL:
        return None  # no region, no edge
    worst = Worst()
    for p, _ in laws.pairs[:DIRECTIONS]:
        u = laws.sampler.direction(laws.rng, p)
        end = laws.sampler.along(p, u, radius)
        edge = _last(lambda t, p=p, u=u: not condition.holds(p, laws.sampler.along(p, u, t)), radius / 2, radius, FINE)  # type: ignore[misc]
        outside = laws.sampler.along(p, u, edge - (radius - edge) / 1000)
        jump = laws.call("log_abs_det", p, end)[0] - laws.call("log_abs_det", p, outside)[0]
        worst = worst.with_error(abs(jump), at("p", p, "q", end))
    promise = f"the log det on the cut locus is the one beside it, to a factor of {FACTOR} in the determinant"
    return laws.check("cut locus log det", promise, worst, cut.log_det, float(mp.log(FACTOR)))


def triangles_close(laws: Laws) -> Check:
    """distance(p, q) <= distance(p, m) + distance(m, q): otherwise Log does not lead the shortest way.

    Tried at triples, and step by step along geodesics that cross the cut locus of p, where a wrong distance jumps.
    """
    worst = Worst()
    for _ in range(PAIRS):
        p, q, m = (anywhere(laws) for _ in range(3))
        direct, first, second = (laws.call("distance", *ends)[0] for ends in ((p, q), (p, m), (m, q)))
        worst = worst.with_error(_excess(direct, first + second), at("p", p, "q", q, "m", m))
    step = laws.sampler.reach * mp.mpf("0.8")
    for _ in range(WALKS):
        p, m = anywhere(laws), anywhere(laws)
        u = laws.sampler.direction(laws.rng, m)
        last = laws.call("distance", p, m)[0]
        for k in range(1, PAIRS):
            q = laws.sampler.along(m, u, k * step)
            here = laws.call("distance", p, q)[0]
            worst = worst.with_error(max(_excess(here, last + step), _excess(last, here + step)), at("p", p, "q", q))
            last = here
    suspect = laws.spec.distance or laws.spec.log
    return laws.check("triangle", "no way over a third point is shorter than the distance", worst, suspect)


def _excess(distance: Any, detour: Any) -> Any:
    """By which part the distance is longer than a detour."""
    excess = ratio(distance, detour) - 1
    return max(excess, mp.mpf(0)) if mp.isfinite(excess) else mp.inf


def diameter_is_the_largest_distance(laws: Laws) -> Check | None:
    """No Log is longer than the diameter, and some are nearly as long."""
    if laws.spec.diameter is None:
        return None
    worst, diameter = Worst(), value(laws.geometry.diameter, {})
    pairs = [(anywhere(laws), anywhere(laws)) for _ in range(2 * PAIRS)]
    pairs.append(_farther(laws, max(pairs, key=lambda pair: _length(laws, pair[0], pair[1], COARSE)), diameter))
    found = mp.mpf(0)
    for p, q in pairs:
        part = _length(laws, p, q) / diameter
        found = max(found, part)
        worst = worst.with_error(_excess(part, 1), at("p", p, "q", q))
    if worst.error == 0 and found < REACHED:
        worst = worst.with_error(1 - found, at("p", pairs[-1][0], "q", pairs[-1][1]))
    hint = f"the farthest points found are {mp.nstr(found, 4)} diameters apart: `diameter`, or the scale of `metric`, is off"
    return laws.check("diameter", "the diameter is the largest distance", worst, laws.spec.diameter, hint=hint)


def _length(laws: Laws, p: Sequence[Any], q: Sequence[Any], digits: int = DIGITS) -> Any:
    """|Log_p(q)|_p."""
    return laws.call("norm", p, laws.call("log", p, q, digits=digits), digits=digits)[0]


def anywhere(laws: Laws) -> Numbers:
    """A point that can be anywhere: in a period, or around the manifold."""
    p = laws.sampler.point(laws.rng)
    periods = laws.geometry.periods or (None,) * len(p)
    turns = [value(period, {}) * mp.mpf(laws.rng.random()) if period is not None else 0 for period in periods]
    return [c + turn for c, turn in zip(p, turns, strict=True)]


def cut_time(laws: Laws, p: Sequence[Any], u: Sequence[Any], radius: Any) -> Any:
    """The last t at which Log_p(Exp_p(t u)) = t u; None where that holds to the end of what is looked at, or never."""

    def undone(t: Any) -> bool:
        v = [t * c for c in u]
        return bool(relative(difference(laws.call("log", p, laws.call("exp", p, v)), v), v) < NEARLY)

    far = value(laws.geometry.diameter, {}) * mp.mpf("1.01") if laws.spec.diameter else 4 * radius
    near = radius * mp.mpf("0.7")
    return _last(undone, near, far) if undone(near) and not undone(far) else None


def _last(holds: Callable[[Any], bool], low: Any, high: Any, halvings: int = HALVINGS) -> Any:
    """Where a condition ends that holds at `low` and not at `high`."""
    for _ in range(halvings):
        middle = (low + high) / 2
        low, high = (middle, high) if holds(middle) else (low, middle)
    return low


def _farther(laws: Laws, pair: tuple[Numbers, Numbers], diameter: Any) -> tuple[Numbers, Numbers]:
    """A pair farther apart: each end moved in turn along the axes, by ever smaller steps, while that helps."""
    p, q = pair
    for levels in LEVELS:
        step = diameter / 8
        for _ in range(levels):
            q = _pushed(laws, p, q, step)
            step /= 2
        p, q = q, p
    return p, q


def _pushed(laws: Laws, p: Numbers, q: Numbers, step: Any) -> Numbers:
    """q moved along each axis, forth or back, where that takes it farther from p."""
    best = _length(laws, p, q, digits=COARSE)
    for k in range(laws.spec.point_size):
        axis = [mp.mpf(int(i == k)) for i in range(laws.spec.point_size)]
        v = laws.call("to_tangent", q, axis, digits=COARSE)
        length = laws.call("norm", q, v, digits=COARSE)[0]
        for sign in (1, -1):
            if not length > mp.mpf(10) ** -6:
                continue
            moved = laws.call("exp", q, [sign * step * c / length for c in v], digits=COARSE)
            distance = _length(laws, p, moved, digits=COARSE)
            if distance > best:
                q, best = moved, distance
                break
    return q


class _Condition:
    """`cut_locus: where:` as a comparison of two numbers."""

    def __init__(self, laws: Laws) -> None:
        assert laws.spec.cut_locus is not None
        p, q = (argument(name, laws.spec.point_size) for name in "pq")
        trace = Trace((p, q))
        comparison = Reading(laws.spec, trace).read(laws.spec.cut_locus.where)
        assert isinstance(comparison, Truth)
        self.kind = comparison.kind
        sides = (comparison.a, comparison.b)
        self.sides = Function("where", (p, q), tuple(trace.assignments), sides, (2,), "").pruned()

    def holds(self, p: Sequence[Any], q: Sequence[Any]) -> bool:
        """Whether q is declared to be on the cut locus of p."""
        a, b = run(self.sides, p, q)[0]
        return bool((a < b, a <= b, a == b)[int(self.kind)])

    def nearly(self, p: Sequence[Any], q: Sequence[Any]) -> bool:
        """Whether it holds but for a small error in q."""
        a, b = run(self.sides, p, q)[0]
        small = NEARLY * (1 + abs(b))
        return bool(abs(a - b) < small if self.kind == EQUAL else a < b + small)
