"""Is Exp what it says it is: a curve out of p with velocity v, and a geodesic of the metric?

One formula serves charts, ambient vectors and frames, for it needs no connection: let Gamma(t, e) be a variation of the
curve gamma(t) = Gamma(t, 0), with Z = d Gamma / d e. Then <D_t gamma', Z> = d/dt <gamma', Z> - 1/2 d/de |d Gamma / dt|^2
at e = 0. Derivatives are central differences with a step of 1e-20 in 100 digits: their errors are of the order 1e-40.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import mpmath as mp
import sympy as sp

from rsrm_gen.compiler.audit.report import Check
from rsrm_gen.compiler.audit.worst import Worst, at, difference, relative
from rsrm_gen.compiler.derive import Geometry
from rsrm_gen.compiler.derive.geometry import Wrap

if TYPE_CHECKING:
    from rsrm_gen.compiler.audit.laws import Laws, Numbers

DIGITS = 100
STEP = mp.mpf(10) ** -20
BEYOND = 4  # times the injectivity radius, nearly, are the longest curves
SMALL = 400  # operations of an Exp that is looked at symbolically: the look is to cost nothing


class Curve:
    """t -> Exp_p(t v), its velocity, and its variations, in 100 digits."""

    def __init__(self, laws: Laws, p: Sequence[Any], v: Sequence[Any]) -> None:
        self.laws = laws
        self.p, self.v = p, v
        self.points: dict[Any, Numbers] = {}  # those computed so far: differences meet again and again

    def __call__(self, t: Any) -> Numbers:
        """gamma(t), in stored coordinates."""
        if t not in self.points:
            self.points[t] = self.laws.call("exp", self.p, [t * c for c in self.v], digits=DIGITS)
        return self.points[t]

    def velocity(self, t: Any) -> Numbers:
        """gamma'(t) as a stored tangent vector."""
        return self.laws.stored(self(t), self.laws.modulo_periods(difference(self(t + STEP), self(t - STEP))), 2 * STEP)

    def varied(self, t: Any, z: Sequence[Any], e: Any) -> Numbers:
        """Gamma(t, e): gamma(t) moved by e z, and brought back onto the manifold where that is not a chart."""
        moved = [c + e * dz for c, dz in zip(self(t), z, strict=True)]
        return self.laws.call("project", moved, digits=DIGITS) if self.laws.spec.embedded else moved

    def variation(self, t: Any, z: Sequence[Any]) -> Numbers:
        """Z(t) = d Gamma / d e at e = 0."""
        return self.laws.stored(self(t), difference(self.varied(t, z, STEP), self.varied(t, z, -STEP)), 2 * STEP)

    def energy(self, t: Any, z: Sequence[Any], e: Any) -> Any:
        """|d Gamma / dt|^2 at (t, e)."""
        ahead, behind = self.varied(t + STEP, z, e), self.varied(t - STEP, z, e)
        here = self.varied(t, z, e)
        u = self.laws.stored(here, self.laws.modulo_periods(difference(ahead, behind)), 2 * STEP)
        return self.inner(here, u, u)

    def momentum(self, t: Any, z: Sequence[Any]) -> Any:
        """<gamma', Z> at t."""
        return self.inner(self(t), self.velocity(t), self.variation(t, z))

    def acceleration(self, t: Any, z: Sequence[Any]) -> Any:
        """<D_t gamma', Z> beside |gamma'| |Z|."""
        change = (self.momentum(t + STEP, z) - self.momentum(t - STEP, z)) / (2 * STEP)
        slope = (self.energy(t, z, STEP) - self.energy(t, z, -STEP)) / (2 * STEP)
        u, w, here = self.velocity(t), self.variation(t, z), self(t)
        return (change - slope / 2) / mp.sqrt(abs(self.inner(here, u, u) * self.inner(here, w, w)))

    def inner(self, p: Sequence[Any], u: Sequence[Any], v: Sequence[Any]) -> Any:
        """The metric in as many digits."""
        return self.laws.call("inner", p, u, v, digits=DIGITS)[0]


def first_order(laws: Laws) -> Check:
    """Exp_p(0) = p and D Exp_p(0) = identity: what a retraction promises too."""
    worst = Worst()
    with mp.workdps(DIGITS):
        for curve, _ in laws.curves:
            found = curve.velocity(2 * STEP)  # not at 0 itself, where Exp as written may be 0/0
            begins = laws.apart(curve(2 * STEP if laws.as_written else mp.mpf(0)), curve.p)
            error = relative(difference(found, curve.v), curve.v) + begins
            worst = worst.with_error(error, at("p", curve.p, "v", curve.v), _ratio(found, curve.v))
    promise = "Exp_p(t v) leaves p with the velocity v"
    return laws.check("first order", promise, worst, laws.spec.exp, hint=worst.same_ratio("its velocity is {} times v"))


def speed(laws: Laws) -> Check:
    """|d/dt Exp_p(t v)| = |v|."""
    promise = "t -> Exp_p(t v) has the constant speed |v|"
    if is_straight(laws.geometry):
        return laws.exactly("speed", promise, laws.spec.exp)
    worst = Worst()
    with mp.workdps(DIGITS):
        for curve, t in laws.curves:
            u = curve.velocity(t)
            ratio = curve.inner(curve(t), u, u) / curve.inner(curve.p, curve.v, curve.v)
            error = abs(mp.sqrt(ratio) - 1) if ratio >= 0 else mp.inf
            worst = worst.with_error(error, at("p", curve.p, "v", curve.v), abs(mp.sqrt(ratio)))
    return laws.check("speed", promise, worst, laws.spec.exp, hint=worst.same_ratio("its speed is {} times |v|"))


def acceleration(laws: Laws) -> Check:
    """D_t d/dt Exp_p(t v) = 0."""
    promise = "t -> Exp_p(t v) is a geodesic of the metric: its covariant acceleration vanishes"
    if is_straight(laws.geometry):
        return laws.exactly("geodesic", promise, laws.spec.exp)
    worst = Worst()
    with mp.workdps(DIGITS):
        for curve, t in laws.curves:
            z = laws.sampler.gaussian(laws.rng, laws.spec.point_size)
            worst = worst.with_error(abs(curve.acceleration(t, z)), at("p", curve.p, "v", curve.v))
    return laws.check("geodesic", promise, worst, laws.spec.exp)


def continues_itself(laws: Laws) -> bool:
    """Whether Exp_{gamma(s)}(t gamma'(s)) = gamma(s + t): then the curves are geodesics of some connection.

    Retractions are no flow, so where Exp is no geodesic of the metric this tells which of the two to doubt.
    """
    s, t = mp.mpf("0.31"), mp.mpf("0.42")
    with mp.workdps(DIGITS):
        for curve, _ in laws.curves[::-3]:
            onward = Curve(laws, curve(s), curve.velocity(s))
            if not laws.apart(onward(t), curve(s + t)) < mp.mpf(10) ** -12:
                return False
    return True


def curves(laws: Laws) -> list[tuple[Curve, Any]]:
    """Curves out of the base points of all pairs, each with a time between 0 and 1.

    They are as long as the reaches, and some run on beyond the injectivity radius: geodesics do not end there.
    """
    finite = laws.geometry.injectivity_radius.is_finite
    found = []
    for k, ((p, _), r) in enumerate(zip(laws.pairs, laws.reaches, strict=True)):
        length = BEYOND * r if finite and k % 4 == 3 else r
        v = [length * c for c in laws.sampler.direction(laws.rng, p)]
        found.append((Curve(laws, p, v), mp.mpf(2 * k + 1) / (2 * len(laws.pairs))))
    return found


def is_straight(geometry: Geometry) -> bool:
    """Whether it is plain to see: a chart with a constant metric, and an Exp that is affine in v with D Exp = identity."""
    spec, exp = geometry.spec, geometry["exp"]
    if spec.embedded or geometry["flat"].assignments or exp.assignments:
        return False
    size = sum(sp.count_ops(e) for e in (*exp.results, *geometry["flat"].results))
    p, v = (argument.symbols for argument in exp.arguments)
    if size > SMALL or any(e.free_symbols & set(p) for e in geometry["flat"].results):
        return False
    unwrapped = [e.replace(Wrap, lambda x, period: x) for e in exp.results]
    unit = sp.eye(len(v))
    return all(sp.expand(sp.diff(e, c) - unit[i, j]) == 0 for i, e in enumerate(unwrapped) for j, c in enumerate(v))


def _ratio(found: Sequence[Any], expected: Sequence[Any]) -> Any:
    """found / expected where they are parallel, else NaN."""
    k = max(range(len(expected)), key=lambda i: abs(expected[i]))
    ratio = found[k] / expected[k]
    parallel = relative([a - ratio * b for a, b in zip(found, expected, strict=True)], expected) < mp.mpf(10) ** -12
    return ratio if parallel else mp.nan
