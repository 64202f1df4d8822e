"""What geometry demands of the formulas, tried in 50 digits at random places.

Derivatives are central differences with a step of 1e-16: their error is of the order 1e-32, far below the tolerances.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import mpmath as mp

from rsrm_gen.compiler.audit.report import Check
from rsrm_gen.compiler.derive import Geometry
from rsrm_gen.compiler.derive.geometry import Function, argument
from rsrm_gen.compiler.derive.numeric import largest, run, value
from rsrm_gen.compiler.derive.sampling import Sampler, sampler_of
from rsrm_gen.compiler.derive.scalarise import scalarised
from rsrm_gen.compiler.lower import Program, interpret
from rsrm_gen.compiler.spec import ManifoldSpec, Map
from rsrm_gen.errors import Span

DIGITS = 50
STEP = mp.mpf(10) ** -16
EXACT = 1e-12  # series are exact to 1e-17 and derivatives to 1e-32, but conditions and cancellation cost some
PAIRS = 16
DIRECTIONS = 4  # at each of them, in which the splat is differentiated
FAR = (
    3,
    6,
    10,
    20,
)  # where there is no injectivity radius to end at; beyond, 50 digits begin to run out on some manifolds

Numbers = list[Any]


@dataclass(frozen=True)
class Worst:
    """The largest error so far and where it was."""

    error: float = 0.0
    where: str = ""

    def with_error(self, error: Any, where: str) -> Worst:
        """This, or the new error if it is larger or not a number."""
        number = float(error) if mp.isfinite(error) else float("inf")
        return Worst(number, where) if number > self.error else self


class Laws:
    """All checks of one manifold; each method is one law."""

    def __init__(self, geometry: Geometry, program: Program) -> None:
        self.geometry = geometry
        self.program = program
        self.spec: ManifoldSpec = geometry.spec  # type: ignore[assignment]  # of a product, only what it has is asked for
        self.sampler: Sampler = sampler_of(geometry)
        rng = random.Random(7)
        self.rng = rng
        with mp.workdps(DIGITS):
            self.pairs = [self.sampler.pair(rng, reach) for reach in self.reaches()]

    def reaches(self) -> list[Any]:
        """Distances of the pairs tried: from close by to almost the injectivity radius, or to far away."""
        whole = self.sampler.reach * 2
        last = (
            [whole * mp.mpf("0.99")]
            if self.geometry.injectivity_radius.is_finite
            else [self.sampler.reach * r for r in FAR]
        )
        steps = PAIRS - len(last)
        return [whole * mp.mpf(k + 1) / (steps + 2) for k in range(steps)] + last

    def checks(self) -> list[Check]:
        """Every law, in the order in which a failure explains the later ones."""
        with mp.workdps(DIGITS):
            laws: list[Callable[[], Check | None]] = [
                self.norm_is_the_length,
                self.metric_is_an_inner_product, self.projection_lands_on_the_manifold, self.frame_is_tangent,
                self.exp_stays_on_the_manifold, self.log_is_tangent, self.exp_inverts_log, self.log_inverts_exp,
                self.equivalent_points_are_one,
                self.periods_do_not_matter,
                self.cut_locus_is_reached,
 self.distance_is_the_length_of_log, self.distance_is_symmetric,
                self.distance_has_gradient_one, self.log_is_the_gradient_of_half_squared_distance,
                self.diameter_is_not_exceeded,
                self.log_det_is_the_determinant, self.splat_gradient_is_its_derivative,
            ]  # fmt: skip
            if self.spec.maps == "retraction":  # right to first order; it promises no more
                of_geodesics: list[Callable[[], Check | None]] = [
                    self.distance_is_symmetric, self.distance_has_gradient_one,
                    self.log_is_the_gradient_of_half_squared_distance, self.diameter_is_not_exceeded,
                ]  # fmt: skip
                laws = [law for law in laws if law not in of_geodesics] + [self.maps_are_right_to_first_order]
            return [check for check in (law() for law in laws) if check is not None]

    def call(self, name: str, *arguments: Sequence[Any]) -> Numbers:
        """A routine of the program, in high precision."""
        return interpret(self.program[name], *arguments, digits=DIGITS)[0]

    def check(
        self, name: str, promise: str, worst: Worst, blamed: Map | None, tolerance: float = EXACT, points: int = PAIRS
    ) -> Check:
        """A check that blames a formula of the file."""
        span: Span | None = blamed.value.span if blamed else None
        return Check(name, promise, worst.error, tolerance, points, worst.where, span)

    def metric_is_an_inner_product(self) -> Check:
        """<u, v> = u^T G v is linear in both, symmetric, and positive on tangent vectors."""
        worst = Worst()
        for p, _ in self.pairs:
            u, v = self.sampler.direction(self.rng, p), self.sampler.direction(self.rng, p)
            a, b = mp.mpf("0.37"), mp.mpf("-1.9")
            mixed = [a * x + b * y for x, y in zip(u, v, strict=True)]
            expected = [a * x + b * y for x, y in zip(self.call("flat", p, u), self.call("flat", p, v), strict=True)]
            linear = self.call("inner", p, mixed, v)[0] - _dot(expected, v)
            symmetric = self.call("inner", p, u, v)[0] - self.call("inner", p, v, u)[0]
            positive = self.call("inner", p, u, u)[0] - 1  # directions are normalised
            worst = worst.with_error(largest((linear, symmetric, positive)), _at("p", p))
        return self.check(
            "metric", "<u, v>_p is bilinear, symmetric and positive on tangent vectors", worst, self.spec.metric
        )

    def norm_is_the_length(self) -> Check | None:
        """|v|_p = sqrt(<v, v>_p), where the author gave a closed form."""
        if self.spec.norm is None:
            return None
        worst = Worst()
        for p, _ in self.pairs:
            v = self.call("to_tangent", p, self.sampler.gaussian(self.rng, self.spec.point_size))
            length = mp.sqrt(self.call("inner", p, v, v)[0])
            worst = worst.with_error(abs(self.call("norm", p, v)[0] / length - 1), _at("p", p, "v", v))
        return self.check("norm", "`norm` is the length of v in the metric", worst, self.spec.norm)

    def projection_lands_on_the_manifold(self) -> Check | None:
        """c(project(x)) = 0, and project(p) = p."""
        if self.spec.project is None:
            return None
        worst = Worst()
        for p, _ in self.pairs:
            off = mp.mpf("0.05") * largest(p)
            x = [c + off * e for c, e in zip(p, self.sampler.gaussian(self.rng, len(p)), strict=True)]
            moved = _relative(_difference(self.call("project", p), p), p)
            worst = worst.with_error(largest([self.off_manifold(self.call("project", x)), moved]), _at("x", x))
        return self.check(
            "projection", "`project` maps onto the manifold and leaves its points alone", worst, self.spec.project
        )

    def frame_is_tangent(self) -> Check | None:
        """The vectors of a frame are tangent to the constraint."""
        if self.spec.frame is None:
            return None
        frame = scalarised(
            self.spec, "frame", self.spec.frame, (argument("p", self.spec.point_size),), self.spec.frame.value.shape
        )
        worst = Worst()
        for p, _ in self.pairs:
            entries = run(frame, p)[0]
            for i in range(self.spec.tangent_size):
                e = entries[i * len(p) : (i + 1) * len(p)]
                worst = worst.with_error(self.off_tangent(p, e), _at("p", p))
        return self.check("frame", "the vectors of `frame` are tangent to the manifold", worst, self.spec.frame)

    def exp_stays_on_the_manifold(self) -> Check | None:
        """c(Exp_p(v)) = 0."""
        if not self.spec.embedded:
            return None
        worst = Worst()
        for p, _ in self.pairs:
            length = self.sampler.reach * mp.mpf("1.3")
            q = self.call("exp", p, [length * c for c in self.sampler.direction(self.rng, p)])
            worst = worst.with_error(self.off_manifold(q), _at("p", p))
        return self.check("exp on manifold", "Exp_p(v) satisfies the constraint", worst, self.spec.exp)

    def log_is_tangent(self) -> Check | None:
        """dc(p) Log_p(q) = 0."""
        if not self.spec.ambient_tangents:
            return None
        worst = Worst()
        for p, q in self.pairs:
            v = self.call("log", p, q)
            worst = worst.with_error(self.off_tangent(p, v), _at("p", p, "q", q))
        return self.check("log tangent", "Log_p(q) is tangent to the manifold at p", worst, self.spec.log)

    def exp_inverts_log(self) -> Check:
        """Exp_p(Log_p(q)) = q, or another name of q."""
        worst = Worst()
        for p, q in self.pairs:
            worst = worst.with_error(self.apart(self.call("exp", p, self.call("log", p, q)), q), _at("p", p, "q", q))
        return self.check("exp(log)", "Exp_p(Log_p(q)) = q", worst, self.spec.exp)

    def log_inverts_exp(self) -> Check:
        """Log_p(Exp_p(v)) = v for |v| below the injectivity radius."""
        worst = Worst()
        for (p, _), r in zip(self.pairs, self.reaches(), strict=True):
            v = [r * c for c in self.sampler.direction(self.rng, p)]
            back = self.call("log", p, self.call("exp", p, v))
            worst = worst.with_error(_relative(_difference(back, v), v), _at("p", p, "v", v))
        return self.check("log(exp)", "Log_p(Exp_p(v)) = v inside the injectivity radius", worst, self.spec.log)

    def maps_are_right_to_first_order(self) -> Check:
        """Exp_p(0) = p and D Exp_p(0) = identity."""
        worst = Worst()
        for p, _ in self.pairs:
            v = self.sampler.direction(self.rng, p)
            velocity = self.call("to_tangent", p, self.along(lambda x: x, p, v))
            stays = self.apart(self.call("exp", p, [mp.mpf(0)] * len(v)), p)
            worst = worst.with_error(largest([stays, _relative(_difference(velocity, v), v)]), _at("p", p, "v", v))
        return self.check("first order", "Exp_p(0) = p, and d/dt Exp_p(t v) = v at t = 0", worst, self.spec.exp)

    def equivalent_points_are_one(self) -> Check | None:
        """Log does not see which name a point has."""
        other = self.spec.equivalent
        if other is None:
            return None
        worst = Worst()
        for p, q in self.pairs:
            named = self.other_name(q)
            v = self.call("log", p, q)
            difference = _relative(_difference(self.call("log", p, named), v), v)
            worst = worst.with_error(largest([difference, self.off_manifold(named)]), _at("p", p, "q", q))
        return self.check("quotient", "Log_p(q) is the same for every name of q", worst, other)

    def periods_do_not_matter(self) -> Check | None:
        """Log does not see a coordinate's full turn."""
        if self.geometry.periods is None:
            return None
        worst, blamed = Worst(), None
        for i, period in enumerate(self.geometry.periods):
            if period is None:
                continue
            assert self.spec.periods is not None
            blamed = blamed or self.spec.periods[i]
            for p, q in self.pairs:
                turned = [c + (value(period, {}) if k == i else 0) for k, c in enumerate(q)]
                v = self.call("log", p, q)
                worst = worst.with_error(_relative(_difference(self.call("log", p, turned), v), v), _at("p", p, "q", q))
        return self.check(
            "period", "Log_p(q) is the same when a coordinate of q goes through its period", worst, blamed
        )

    def diameter_is_not_exceeded(self) -> Check | None:
        """No two points are farther apart than the diameter."""
        if self.spec.diameter is None:
            return None
        worst, count = Worst(), 8 * PAIRS
        diameter = value(self.geometry.diameter, {})
        for _ in range(count):
            p, q = self.anywhere(), self.anywhere()
            excess = self.call("distance", p, q)[0] / diameter - 1
            worst = worst.with_error(max(excess, mp.mpf(0)), _at("p", p, "q", q))
        return self.check(
            "diameter", "no distance is larger than the diameter", worst, self.spec.diameter, points=count
        )

    def anywhere(self) -> Numbers:
        """A point that can be anywhere: in a period, or around the manifold."""
        p = self.sampler.point(self.rng)
        periods = self.geometry.periods or (None,) * len(p)
        turns = [value(period, {}) * mp.mpf(self.rng.random()) if period is not None else 0 for period in periods]
        return [c + turn for c, turn in zip(p, turns, strict=True)]

    def cut_locus_is_reached(self) -> Check | None:
        """Where the author declares Log: Exp of it is the point, and it is as long as the injectivity radius."""
        cut = self.spec.cut_locus
        if cut is None or cut.log is None or self.spec.injectivity_radius is None:
            return None
        worst, radius = Worst(), value(self.geometry.injectivity_radius, {})
        for p, _ in self.pairs:
            q = self.sampler.along(p, self.sampler.direction(self.rng, p), radius)
            v = self.call("log", p, q)
            errors = [self.apart(self.call("exp", p, v), q), self.call("norm", p, v)[0] / radius - 1]
            worst = worst.with_error(largest(errors), _at("p", p, "q", q))
        return self.check("cut locus", "Log on the cut locus leads there, over the injectivity radius", worst, cut.log)

    def distance_is_the_length_of_log(self) -> Check:
        """distance(p, q) = |Log_p(q)|_p."""
        worst = Worst()
        for p, q in self.pairs:
            length = self.call("norm", p, self.call("log", p, q))[0]
            worst = worst.with_error(abs(self.call("distance", p, q)[0] / length - 1), _at("p", p, "q", q))
        return self.check(
            "distance", "the distance is the length of Log", worst, self.spec.distance or self.spec.metric
        )

    def distance_is_symmetric(self) -> Check:
        """distance(p, q) = distance(q, p)."""
        worst = Worst()
        for p, q in self.pairs:
            there, back = self.call("distance", p, q)[0], self.call("distance", q, p)[0]
            worst = worst.with_error(abs(there / back - 1), _at("p", p, "q", q))
        return self.check("symmetry", "distance(p, q) = distance(q, p)", worst, self.spec.distance or self.spec.log)

    def distance_has_gradient_one(self) -> Check:
        """|grad_q distance(p, q)| = 1: the Eikonal equation, which holds only if Exp runs along geodesics of the metric."""
        worst = Worst()
        for p, q in self.pairs:
            partials = self.partials(lambda x, p=p: self.call("distance", p, x), q)  # type: ignore[misc]
            worst = worst.with_error(abs(self.call("gradient_norm", q, partials)[0] - 1), _at("p", p, "q", q))
        return self.check("eikonal", "|grad distance| = 1 in the metric", worst, self.spec.metric)

    def log_is_the_gradient_of_half_squared_distance(self) -> Check:
        """grad_q distance(p, q)^2 / 2 = -Log_q(p) (Gauss's lemma)."""
        worst = Worst()
        for p, q in self.pairs:
            partials = self.partials(lambda x, p=p: [self.call("distance", p, x)[0] ** 2 / 2], q)  # type: ignore[misc]
            gradient = self.call("riemannian_gradient", q, partials)
            back = self.call("log", q, p)
            total = [g + v for g, v in zip(gradient, back, strict=True)]
            worst = worst.with_error(_relative(total, back), _at("p", p, "q", q))
        return self.check("gauss", "the gradient of distance(p, q)^2 / 2 in q is -Log_q(p)", worst, self.spec.log)

    def log_det_is_the_determinant(self) -> Check:
        """log |det D Log_p(q)| against differences of Log along geodesics out of q."""
        worst = Worst()
        for p, q in self.pairs:
            basis = self.basis(q)
            image = [self.along(lambda x, p=p: self.call("log", p, x), q, e) for e in basis]  # type: ignore[misc]
            volumes = [self.gram(p, image), self.gram(q, basis)]
            expected = mp.log(abs(volumes[0] / volumes[1])) / 2
            worst = worst.with_error(abs(self.call("log_abs_det", p, q)[0] - expected), _at("p", p, "q", q))
        return self.check(
            "log det",
            "log |det D Log| is the determinant of the differences of Log",
            worst,
            self.spec.log_det or self.spec.log,
        )

    def splat_gradient_is_its_derivative(self) -> Check:
        """<gradient of the splat, e> against its differences along e."""
        worst = Worst()
        for p, q in self.pairs:
            distance = self.call("distance", p, q)[0]  # splats as wide as the points are apart
            W = [c / distance for c in self.sampler.gaussian(self.rng, self.spec.dim * self.spec.tangent_size)]

            def splat(x: Sequence[Any], p: Sequence[Any] = p, W: Sequence[Any] = W) -> list[Numbers]:
                return interpret(self.program["splat"], x, p, W, [1], digits=DIGITS)

            gradient, scale = splat(q)[1], abs(splat(q)[0][0]) + mp.mpf(10) ** -20
            for e in self.basis(q)[:DIRECTIONS]:
                slope = self.along(lambda x: splat(x)[0], q, e)[0]
                worst = worst.with_error(
                    abs(self.call("inner", q, gradient, e)[0] - slope) * distance / scale, _at("x", q, "mu", p)
                )
        return self.check(
            "splat gradient", "the gradient of the splat is the derivative of its value", worst, self.spec.metric
        )

    def constraint(self, p: Sequence[Any]) -> Numbers:
        """c(p)."""
        return run(self.constraint_function, p)[0]

    @cached_property
    def constraint_function(self) -> Function:
        """The constraint as a staged function, read once."""
        assert self.spec.constraint is not None
        return scalarised(self.spec, "constraint", self.spec.constraint, (argument("p", self.spec.point_size),), ())

    def other_name(self, q: Sequence[Any]) -> Numbers:
        """The equivalent point."""
        assert self.spec.equivalent is not None
        function = scalarised(
            self.spec,
            "equivalent",
            self.spec.equivalent,
            (argument("p", self.spec.point_size),),
            (self.spec.point_size,),
        )
        return run(function, q)[0]

    def apart(self, x: Sequence[Any], q: Sequence[Any]) -> Any:
        """How far x is from q, or from another name of q, as a part of the largest entry."""
        names = [list(q)] + ([self.other_name(q)] if self.spec.equivalent else [])
        return min(_relative(self.modulo_periods(_difference(x, name)), q) for name in names)

    def off_manifold(self, p: Sequence[Any]) -> Any:
        """How far the constraint is from zero, beside how much it changes when p is stretched."""
        return _relative(self.constraint(p), self.directional(self.constraint, p, p))

    def off_tangent(self, p: Sequence[Any], v: Sequence[Any]) -> Any:
        """How much the constraint changes along v, beside how much along a vector as long as v that stretches p."""
        stretch = [c * largest(v) / largest(p) for c in p]
        return _relative(self.directional(self.constraint, p, v), self.directional(self.constraint, p, stretch))

    def modulo_periods(self, difference: Numbers) -> Numbers:
        """A difference of coordinates, the nearest multiple of each period taken away."""
        periods = self.geometry.periods or (None,) * len(difference)
        lengths = [value(period, {}) if period is not None else None for period in periods]
        return [
            d - length * mp.nint(d / length) if length else d for d, length in zip(difference, lengths, strict=True)
        ]

    def basis(self, q: Sequence[Any]) -> list[Numbers]:
        """d independent unit tangent vectors at q."""
        return [self.sampler.direction(self.rng, q) for _ in range(self.spec.dim)]

    def gram(self, at: Sequence[Any], vectors: Sequence[Numbers]) -> Any:
        """The determinant of the inner products."""
        lowered = [self.call("flat", at, v) for v in vectors]
        return mp.det(mp.matrix([[_dot(covector, v) for v in vectors] for covector in lowered]))

    def along(self, function: Callable[[Numbers], Numbers], q: Sequence[Any], e: Sequence[Any]) -> Numbers:
        """The derivative along the geodesic out of q in the direction e."""
        ahead, behind = (function(self.call("exp", q, [sign * STEP * c for c in e])) for sign in (1, -1))
        return [(a - b) / (2 * STEP) for a, b in zip(ahead, behind, strict=True)]

    def directional(self, function: Callable[[Numbers], Numbers], p: Sequence[Any], e: Sequence[Any]) -> Numbers:
        """The derivative along the straight line p + h e in stored coordinates."""
        ahead, behind = (function([x + sign * STEP * c for x, c in zip(p, e, strict=True)]) for sign in (1, -1))
        return [(a - b) / (2 * STEP) for a, b in zip(ahead, behind, strict=True)]

    def partials(self, function: Callable[[Numbers], Numbers], q: Sequence[Any]) -> Numbers:
        """The partial derivatives of a scalar function in stored coordinates."""
        unit = [[mp.mpf(int(i == j)) for j in range(len(q))] for i in range(len(q))]
        return [self.directional(function, q, e)[0] for e in unit]


def _difference(x: Sequence[Any], y: Sequence[Any]) -> Numbers:
    return [a - b for a, b in zip(x, y, strict=True)]


def _relative(errors: Sequence[Any], scale: Sequence[Any]) -> Any:
    """The largest error as a part of the largest of some numbers of the same unit."""
    return largest(errors) / largest(scale)


def _dot(x: Sequence[Any], y: Sequence[Any]) -> Any:
    return mp.fsum(a * b for a, b in zip(x, y, strict=True))


def _at(*named: Any) -> str:
    """Places in words: `at p = (0.1, 0.2)`."""
    pairs = zip(named[::2], named[1::2], strict=True)
    return "at " + ", ".join(f"{name} = ({', '.join(mp.nstr(c, 4) for c in x)})" for name, x in pairs)
