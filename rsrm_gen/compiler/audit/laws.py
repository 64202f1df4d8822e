"""What geometry demands of the formulas, tried in 50 digits at random places.

Derivatives are central differences with a step of 1e-20: their error is of the order 1e-30, far below the tolerances.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Sequence
from functools import cached_property, partial
from typing import Any

import mpmath as mp

from rsrm_gen.compiler.audit import geodesics, whole
from rsrm_gen.compiler.audit.blame import blamed
from rsrm_gen.compiler.audit.report import Check
from rsrm_gen.compiler.audit.worst import Worst, at, difference, ratio, relative
from rsrm_gen.compiler.derive import Geometry
from rsrm_gen.compiler.derive.geometry import Function, argument
from rsrm_gen.compiler.derive.numeric import determinant, largest, run, value
from rsrm_gen.compiler.derive.sampling import Sampler, sampler_of
from rsrm_gen.compiler.derive.scalarise import constraint_of, scalarised
from rsrm_gen.compiler.lower import Program, interpret
from rsrm_gen.compiler.spec import ManifoldSpec, Map
from rsrm_gen.errors import Span

DIGITS = 50
STEP = mp.mpf(10) ** -20
EXACT = 1e-12  # series are exact to 1e-17 and derivatives to 1e-32, but conditions and cancellation cost some
PAIRS, STRAYS = 16, 4
DIRECTIONS = 4  # at each pair, in which the splat is differentiated
# Where there is no injectivity radius to end at; beyond, 50 digits begin to run out on some manifolds.
FAR = (3, 6, 10, 20)

Numbers = list[Any]


class Laws:
    """All checks of one manifold; each method is one law."""

    def __init__(self, geometry: Geometry, program: Program, as_written: bool = False) -> None:
        """`as_written`: the geometry has no determinant, and asks for none."""
        self.as_written = as_written
        self.geometry = geometry
        self.program = program
        self.spec: ManifoldSpec = geometry.spec  # type: ignore[assignment]  # of a product, only what it has is asked for
        self.sampler: Sampler = sampler_of(geometry)
        self.rng = random.Random(7)
        with mp.workdps(DIGITS):
            apart = [self.pair_at(reach) for reach in self.distances()]
        self.pairs = [pair for pair, _ in apart]
        self.reaches = [reach for _, reach in apart]

    @cached_property
    def strays(self) -> list[tuple[Numbers, Numbers]]:
        """Pairs that may be farther apart than the injectivity radius; none where Exp is only a retraction, or a product's."""
        near = not self.geometry.injectivity_radius.is_finite or self.geometry.spec.maps == "retraction"
        if near or self.geometry.factors:
            return []
        return [(whole.anywhere(self), whole.anywhere(self)) for _ in range(STRAYS)]

    @cached_property
    def curves(self) -> list[tuple[geodesics.Curve, Any]]:
        """Curves of Exp, each with a time; their points are computed once for all laws of geodesics."""
        return geodesics.curves(self)

    def pair_at(self, reach: Any) -> tuple[tuple[Numbers, Numbers], Any]:
        """A pair of points at a distance, and that distance: less where differences would be too coarse so far out."""
        pair = self.sampler.pair(self.rng, reach)
        while reach > 2 * self.sampler.reach and self.is_too_far(*pair):
            reach /= 2
            pair = self.sampler.pair(self.rng, reach)
        return pair, reach

    def is_too_far(self, p: Numbers, q: Numbers) -> bool:
        """Whether differences say nothing at q, as near the edge of a strongly curved chart: they depend on their step."""
        try:
            if not mp.isfinite(self.call("distance", p, q)[0]):
                return False  # a formula without a value there: the laws will say so
            slopes = [self.partials(lambda x: self.call("distance", p, x), q, step) for step in (STEP, 8 * STEP)]
            found, other = (self.call("gradient_norm", q, partials)[0] for partials in slopes)
        except (ZeroDivisionError, OverflowError, ValueError):
            return False
        return not abs(found - other) <= EXACT / 10 * abs(found)

    def distances(self) -> list[Any]:
        """Distances of the pairs tried: from close by to almost the injectivity radius, or to far away."""
        across = self.sampler.reach * 2
        last = (
            [across * mp.mpf("0.99")]
            if self.geometry.injectivity_radius.is_finite
            else [self.sampler.reach * r for r in FAR]
        )
        steps = PAIRS - len(last)
        return [across * mp.mpf(k + 1) / (steps + 2) for k in range(steps)] + last

    def checks(self) -> list[Check]:
        """Every law, in the order in which a failure explains the later ones; the first failure names its culprit."""
        return blamed(list(self.each()), self.spec, partial(geodesics.continues_itself, self))

    def each(self) -> Iterator[Check]:
        """The laws one by one, so that a caller may stop at the first that is broken."""
        retraction = self.spec.maps == "retraction"
        unbroken = True
        for law in self.laws_of_a_retraction() if retraction else self.laws_of_geodesics():
            check = self.tried(law)
            if check is not None:
                unbroken = unbroken and check.passed
                yield check
        if (
            unbroken and not self.as_written
        ):  # it is made of the others, and says nothing new where one of them is broken
            check = self.tried(self.splat_gradient_is_its_derivative)
            assert check is not None
            yield check

    def tried(self, law: Callable[[], Check | None]) -> Check | None:
        """The check of a law; a failed one where its formulas have no value at all."""
        try:
            with mp.workdps(DIGITS):
                return law()
        except (ZeroDivisionError, OverflowError, ValueError):
            function = getattr(law, "func", law)
            promise = str(function.__doc__).splitlines()[0].rstrip(".")
            return Check(function.__name__, promise, float("inf"), EXACT, PAIRS, "", self.spec.log.value.span)

    def laws_of_geodesics(self) -> list[Callable[[], Check | None]]:
        """What geometry demands where Exp is geodesic and Log its inverse."""
        return [
            *self.laws_of_storage(),
            partial(geodesics.speed, self), partial(geodesics.acceleration, self),
            self.log_is_tangent, self.exp_inverts_log, self.log_inverts_exp,
            partial(whole.log_reaches_every_point, self),
            partial(whole.equivalent_points_are_one, self), partial(whole.periods_do_not_matter, self),
            partial(whole.cut_locus_is_reached, self), partial(whole.cut_locus_is_where_it_is_declared, self),
            self.distance_is_the_length_of_log, self.distance_is_symmetric, self.distance_has_gradient_one,
            self.log_is_the_gradient_of_half_squared_distance,
            partial(whole.triangles_close, self), partial(whole.diameter_is_the_largest_distance, self),
            *self.laws_of_the_determinant(),
        ]  # fmt: skip

    def laws_of_a_retraction(self) -> list[Callable[[], Check | None]]:
        """What a retraction and its inverse promise: first order at p, and to undo one another; no geodesics."""
        return [
            *self.laws_of_storage(),
            self.log_is_tangent, self.exp_inverts_log, self.log_inverts_exp,
            partial(whole.equivalent_points_are_one, self), partial(whole.periods_do_not_matter, self),
            self.distance_is_the_length_of_log,
            *self.laws_of_the_determinant(),
        ]  # fmt: skip

    def laws_of_the_determinant(self) -> list[Callable[[], Check | None]]:
        """log |det D Log|, and what is declared of it."""
        if self.as_written:
            return []
        return [self.log_det_is_the_determinant, partial(whole.log_det_continues_onto_the_cut, self)]

    def laws_of_storage(self) -> list[Callable[[], Check | None]]:
        """How points and tangent vectors are stored and measured, and that Exp starts as it should."""
        return [
            self.norm_is_the_length, self.metric_is_an_inner_product, self.projection_lands_on_the_manifold,
            self.frame_is_tangent, self.exp_stays_on_the_manifold, partial(geodesics.first_order, self),
        ]  # fmt: skip

    def call(self, name: str, *arguments: Sequence[Any], digits: int = DIGITS) -> Numbers:
        """A routine of the program, in high precision."""
        return interpret(self.program[name], *arguments, digits=digits)[0]

    def check(
        self,
        name: str,
        promise: str,
        worst: Worst,
        suspect: Map | None,
        tolerance: float = EXACT,
        hint: str | None = None,
    ) -> Check:
        """A check that points to a formula of the file."""
        span: Span | None = suspect.value.span if suspect else None
        return Check(name, promise, worst.error, tolerance, worst.points, worst.where, span, hint)

    def exactly(self, name: str, promise: str, suspect: Map) -> Check:
        """A promise that was seen to hold everywhere, by symbols and not by numbers."""
        return Check(name, promise, 0.0, EXACT, 0, "", suspect.value.span, exact=True)

    def stored(self, p: Sequence[Any], x: Sequence[Any], scale: Any = 1) -> Numbers:
        """The tangent vector x / scale at p as the manifold stores it: as it is, or by its components in the frame."""
        vector = [c / scale for c in x]
        return self.call("to_tangent", p, vector, digits=geodesics.DIGITS) if self.spec.frame is not None else vector

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
            worst = worst.with_error(largest((linear, symmetric, positive)), at("p", p))
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
            found = ratio(self.call("norm", p, v)[0], length)
            worst = worst.with_error(abs(found - 1), at("p", p, "v", v), found)
        hint = worst.same_ratio("it is {} times sqrt(<v, v>_p)")
        return self.check("norm", "`norm` is the length of v in the metric", worst, self.spec.norm, hint=hint)

    def projection_lands_on_the_manifold(self) -> Check | None:
        """c(project(x)) = 0, and project(p) = p."""
        if self.spec.project is None:
            return None
        worst = Worst()
        for p, _ in self.pairs:
            off = mp.mpf("0.05") * largest(p)
            x = [c + off * e for c, e in zip(p, self.sampler.gaussian(self.rng, len(p)), strict=True)]
            moved = relative(difference(self.call("project", p), p), p)
            worst = worst.with_error(largest([self.off_manifold(self.call("project", x)), moved]), at("x", x))
        return self.check(
            "projection", "`project` maps onto the manifold and leaves its points alone", worst, self.spec.project
        )

    def frame_is_tangent(self) -> Check | None:
        """The vectors of a frame are tangent to the constraint."""
        if self.spec.frame is None:
            return None
        size = self.spec.tangent_size
        arguments = argument("p", self.spec.point_size), argument("v", size)
        frame = scalarised(self.spec, "frame", self.spec.frame, arguments, self.spec.point_shape)
        worst = Worst()
        for p, _ in self.pairs:
            for i in range(size):
                e = run(frame, p, [mp.mpf(int(i == j)) for j in range(size)])[0]
                worst = worst.with_error(self.off_tangent(p, e), at("p", p))
        return self.check("frame", "the vectors of `frame` are tangent to the manifold", worst, self.spec.frame)

    def exp_stays_on_the_manifold(self) -> Check | None:
        """c(Exp_p(v)) = 0."""
        if not self.spec.embedded:
            return None
        worst = Worst()
        for p, _ in self.pairs:
            length = self.sampler.reach * mp.mpf("1.3")
            q = self.call("exp", p, [length * c for c in self.sampler.direction(self.rng, p)])
            worst = worst.with_error(self.off_manifold(q), at("p", p))
        return self.check("exp on manifold", "Exp_p(v) satisfies the constraint", worst, self.spec.exp)

    def log_is_tangent(self) -> Check | None:
        """dc(p) Log_p(q) = 0."""
        if not self.spec.ambient_tangents:
            return None
        worst = Worst()
        for p, q in self.pairs:
            v = self.call("log", p, q)
            worst = worst.with_error(self.off_tangent(p, v), at("p", p, "q", q))
        return self.check("log tangent", "Log_p(q) is tangent to the manifold at p", worst, self.spec.log)

    def exp_inverts_log(self) -> Check:
        """Exp_p(Log_p(q)) = q, or another name of q."""
        worst = Worst()
        for p, q in self.pairs:
            worst = worst.with_error(self.apart(self.call("exp", p, self.call("log", p, q)), q), at("p", p, "q", q))
        return self.check("exp(log)", "Exp_p(Log_p(q)) = q", worst, self.spec.exp)

    def log_inverts_exp(self) -> Check:
        """Log_p(Exp_p(v)) = v for |v| below the injectivity radius."""
        worst = Worst()
        for (p, _), r in zip(self.pairs, self.reaches, strict=True):
            v = [r * c for c in self.sampler.direction(self.rng, p)]
            back = self.call("log", p, self.call("exp", p, v))
            worst = worst.with_error(relative(difference(back, v), v), at("p", p, "v", v))
        return self.check("log(exp)", "Log_p(Exp_p(v)) = v inside the injectivity radius", worst, self.spec.log)

    def distance_is_the_length_of_log(self) -> Check:
        """distance(p, q) = |Log_p(q)|_p."""
        worst = Worst()
        for p, q in [*self.pairs, *self.strays]:
            length = self.call("norm", p, self.call("log", p, q))[0]
            found = ratio(self.call("distance", p, q)[0], length)
            worst = worst.with_error(abs(found - 1), at("p", p, "q", q), found)
        suspect, hint = self.spec.distance or self.spec.log, worst.same_ratio("the distance is {} times |Log_p(q)|_p")
        return self.check("distance", "the distance is the length of Log", worst, suspect, hint=hint)

    def distance_is_symmetric(self) -> Check:
        """distance(p, q) = distance(q, p)."""
        worst = Worst()
        for p, q in self.pairs:
            there, back = self.call("distance", p, q)[0], self.call("distance", q, p)[0]
            worst = worst.with_error(abs(ratio(there, back) - 1), at("p", p, "q", q))
        return self.check("symmetry", "distance(p, q) = distance(q, p)", worst, self.spec.distance or self.spec.log)

    def distance_has_gradient_one(self) -> Check:
        """|grad_q distance(p, q)| = 1: the Eikonal equation, which holds only if Exp runs along geodesics of the metric."""
        worst = Worst()
        for p, q in [*self.pairs, *self.strays]:
            partials = self.partials(lambda x, p=p: self.call("distance", p, x), q)  # type: ignore[misc]
            found = self.call("gradient_norm", q, partials)[0]
            worst = worst.with_error(abs(found - 1), at("p", p, "q", q), found)
        hint = worst.same_ratio("|grad distance| is {}")
        return self.check("eikonal", "|grad distance| = 1 in the metric", worst, self.spec.metric, hint=hint)

    def log_is_the_gradient_of_half_squared_distance(self) -> Check:
        """grad_q distance(p, q)^2 / 2 = -Log_q(p) (Gauss's lemma)."""
        worst = Worst()
        for p, q in [*self.pairs, *self.strays]:
            partials = self.partials(lambda x, p=p: [self.call("distance", p, x)[0] ** 2 / 2], q)  # type: ignore[misc]
            gradient = self.call("riemannian_gradient", q, partials)
            back = self.call("log", q, p)
            total = [g + v for g, v in zip(gradient, back, strict=True)]
            worst = worst.with_error(relative(total, back), at("p", p, "q", q))
        return self.check("gauss", "the gradient of distance(p, q)^2 / 2 in q is -Log_q(p)", worst, self.spec.log)

    def log_det_is_the_determinant(self) -> Check:
        """log |det D Log_p(q)| against differences of Log along geodesics out of q."""
        worst = Worst()
        for p, q in [*self.pairs, *self.strays]:
            basis = self.basis(q)
            image = [self.along(lambda x, p=p: self.call("log", p, x), q, e) for e in basis]  # type: ignore[misc]
            volumes = [self.gram(p, image), self.gram(q, basis)]
            expected = mp.log(abs(ratio(*volumes))) / 2 if volumes[0] else mp.ninf
            worst = worst.with_error(abs(self.call("log_abs_det", p, q)[0] - expected), at("p", p, "q", q))
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
                    abs(self.call("inner", q, gradient, e)[0] - slope) * distance / scale, at("x", q, "mu", p)
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
        return constraint_of(self.spec)

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
        return min(relative(self.modulo_periods(difference(x, name)), q) for name in names)

    def off_manifold(self, p: Sequence[Any]) -> Any:
        """How far the constraint is from zero, beside how much it changes along a vector as long as p."""
        return relative(self.constraint(p), self.steepness(p, largest(p)))

    def off_tangent(self, p: Sequence[Any], v: Sequence[Any]) -> Any:
        """How much the constraint changes along v, beside how much along a vector as long as v."""
        return relative(self.directional(self.constraint, p, v), self.steepness(p, largest(v)))

    def steepness(self, p: Sequence[Any], size: Any) -> Numbers:
        """The change of the constraint along a vector of a size: one that stretches p, or any where that stays on it."""
        stretched = self.directional(self.constraint, p, [c * size / largest(p) for c in p])
        if largest(stretched) > 0:
            return stretched
        return self.directional(self.constraint, p, [size * mp.mpf((7 * k + 3) % 11 - 5) / 5 for k in range(len(p))])

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
        return determinant(mp.matrix([[_dot(covector, v) for v in vectors] for covector in lowered]))

    def along(self, function: Callable[[Numbers], Numbers], q: Sequence[Any], e: Sequence[Any]) -> Numbers:
        """The derivative along the geodesic out of q in the direction e."""
        ahead, behind = (function(self.call("exp", q, [sign * STEP * c for c in e])) for sign in (1, -1))
        return [(a - b) / (2 * STEP) for a, b in zip(ahead, behind, strict=True)]

    def directional(
        self, function: Callable[[Numbers], Numbers], p: Sequence[Any], e: Sequence[Any], step: Any = STEP
    ) -> Numbers:
        """The derivative along the straight line p + h e in stored coordinates."""
        ahead, behind = (function([x + sign * step * c for x, c in zip(p, e, strict=True)]) for sign in (1, -1))
        return [(a - b) / (2 * step) for a, b in zip(ahead, behind, strict=True)]

    def partials(self, function: Callable[[Numbers], Numbers], q: Sequence[Any], step: Any = STEP) -> Numbers:
        """The partial derivatives of a scalar function in stored coordinates."""
        unit = [[mp.mpf(int(i == j)) for j in range(len(q))] for i in range(len(q))]
        return [self.directional(function, q, e, step)[0] for e in unit]


def _dot(x: Sequence[Any], y: Sequence[Any]) -> Any:
    return mp.fsum(a * b for a, b in zip(x, y, strict=True))
