"""Stage 2: `Spec` -> `Geometry`. The mathematics: nothing here knows of precisions or target languages."""

from __future__ import annotations

import itertools
import random
from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property
from typing import Any

import mpmath as mp
import sympy as sp

from rsrm_gen.compiler.budget import blamed
from rsrm_gen.compiler.derive.closed_form import closed_form
from rsrm_gen.compiler.derive.determinant import StagedJacobian, staged_jacobian, staged_log_det
from rsrm_gen.compiler.derive.geometry import (
    Argument,
    Assignment,
    ChooseSafe,
    Function,
    Geometry,
    Wrap,
    argument,
    renamed,
)
from rsrm_gen.compiler.derive.numeric import DIGITS, TINY, Values, is_positive_definite, largest, run, value
from rsrm_gen.compiler.derive.operators import Operators
from rsrm_gen.compiler.derive.product import product, scaled
from rsrm_gen.compiler.derive.radial import radial
from rsrm_gen.compiler.derive.sampling import Sampler, is_free, reach_of, truth
from rsrm_gen.compiler.derive.scalarise import Reading, constraint_of, number, scalarised
from rsrm_gen.compiler.derive.singularities import Ray, exp_ray, guarded, log_ray, remove, smooth_squares
from rsrm_gen.compiler.derive.trace import Trace
from rsrm_gen.compiler.derive.values import Truth
from rsrm_gen.compiler.spec import ManifoldSpec, Map, Spec
from rsrm_gen.errors import UserError

__all__ = ["Geometry", "derive", "derive_as_written"]


def derive(spec: Spec) -> Geometry:
    """Derive every function of the manifold from its spec; raises `UserError` where a formula cannot be mended."""
    if isinstance(spec, ManifoldSpec):
        with mp.workdps(DIGITS):  # whatever precision the caller works in: the same input gives the same bytes
            geometry = _Derivation(spec).geometry()
            geometry = replace(geometry, radial=radial(geometry))
    else:
        geometry = product(spec, {factor.spec.content_hash: derive(factor.spec) for factor in spec.distinct()})
    return scaled(geometry, number(spec, spec.scale)) if spec.scale else geometry


def derive_as_written(spec: ManifoldSpec) -> Geometry:
    """The formulas of a spec as they stand, no 0/0 removed and log |det D Log| left at 0: for finding what is wrong in them."""
    with mp.workdps(DIGITS):
        geometry = _AsWritten(spec).geometry()
    return scaled(geometry, number(spec, spec.scale)) if spec.scale else geometry


class _Derivation:
    """The derivation of one spec, its steps named as properties in the order in which they build on one another."""

    def __init__(self, spec: ManifoldSpec) -> None:
        self.spec = spec
        self.p, self.q = argument("p", spec.point_size), argument("q", spec.point_size)
        self.v = argument("v", spec.tangent_size)
        self.rng = random.Random(0)

    def geometry(self) -> Geometry:
        """Everything, under the names of the `Manifold` protocol."""
        spec, operators = self.spec, self.operators
        with blamed(spec.exp.value.span):
            exp = self.exp  # first: what is wrong with it is not to be blamed on Log
            self.check_symmetric(*self.plain_exp)
        with blamed(spec.log.value.span):
            self.check_symmetric(*self.plain_log)
            log_det, origin = self.log_abs_det
        functions = (
            self.project, operators.to_tangent(), operators.inner(), operators.norm(), operators.flat(), exp, self.log,
            self.distance, log_det, operators.riemannian_gradient(), operators.gradient_norm(), *self.given,
        )  # fmt: skip
        periods = spec.periods and tuple(self.length(p, "period") if p else None for p in spec.periods)
        return Geometry(
            spec,
            functions,
            origin,
            self.length(spec.injectivity_radius, "injectivity_radius"),
            self.length(spec.diameter, "diameter"),
            periods if periods and any(periods) else None,
            self.domain,
        )

    def length(self, formula: Map | None, name: str) -> sp.Expr:
        """The value of a formula of nothing that says a length; infinity where there is none."""
        length = number(self.spec, formula)
        if formula is not None and not value(length, {}) > TINY:
            shown = mp.nstr(value(length, {}), 5)
            raise UserError(f"`{name}` must be positive, this is {shown}", formula.value.span)
        return length

    @cached_property
    def project(self) -> Function:
        """The author's projection; in a chart, coordinates brought into their period."""
        spec = self.spec
        x = replace(self.p, name="x", symbols=argument("x", spec.point_size).symbols)
        if spec.project is not None:
            function = scalarised(spec, "project", spec.project, (self.p,), (spec.point_size,))
            names = dict(zip(self.p.symbols, x.symbols, strict=True))
            return replace(renamed(function, names), arguments=(x,))
        periods = [number(spec, period) if period else None for period in spec.periods or ()]
        results = tuple(Wrap(c, period) if period else c for c, period in zip(x.symbols, periods, strict=True))
        return Function(
            "project", (x,), (), results, (spec.point_size,), "x, periodic coordinates wrapped" if any(periods) else "x"
        )

    @cached_property
    def operators(self) -> Operators:
        """The linear algebra of the tangent spaces."""
        size = self.spec.point_size
        vectors = ([mp.mpf(self.rng.gauss(0, 1)) for _ in range(size)] for _ in range(400))
        points = (run(self.project, x)[0] if self.spec.embedded else x for x in vectors)
        found = list(itertools.islice(filter(self.is_valid, points), 4))
        self.check_on_manifold(found)
        return Operators(self.spec, found)

    def check_on_manifold(self, points: Sequence[Sequence[Any]]) -> None:
        """Refuse a `project` whose points do not satisfy the constraint: everything is derived from such points."""
        spec = self.spec
        if not points and spec.domain is not None:
            raise UserError("no point satisfies `domain`", spec.domain.value.span)
        if spec.constraint is None or spec.project is None:
            return
        constraint = constraint_of(spec)
        errors = [abs(c) for p in points for c in run(constraint, p)[0]]
        if not all(e < TINY for e in errors):
            message = "`project` does not map onto the manifold: its points do not satisfy `constraint`"
            if self.maps_agree(points):
                hint = "look at `constraint`: on the points of `project`, Exp undoes Log"
                raise UserError(message, spec.constraint.value.span, hint)
            raise UserError(message, spec.project.value.span)

    def maps_agree(self, points: Sequence[Sequence[Any]]) -> bool:
        """Whether Exp, Log and `project` fit one another: Exp_p(Log_p(q)) = q between some points."""
        exp = scalarised(self.spec, "exp", self.spec.exp, (self.p, self.v), (self.spec.point_size,))
        log = scalarised(self.spec, "log", self.spec.log, (self.p, self.q), (self.spec.tangent_size,))
        pairs = itertools.pairwise(points)
        return all(
            abs(x - c) < TINY for p, q in pairs for x, c in zip(run(exp, p, run(log, p, q)[0])[0], q, strict=True)
        )

    def is_valid(self, p: Sequence[Any]) -> bool:
        """Whether the domain of the spec, if it has one, holds at p."""
        return self.domain is None or bool(value(self.domain, dict(zip(self.p.symbols, p, strict=True))) == 1)

    def check_symmetric(self, function: Function, trace: Trace) -> None:
        """Refuse a function of symmetric matrices of a matrix that is not symmetric."""
        if not trace.symmetries:
            return
        rng = random.Random(6)
        p, q = self.sampler.pair(rng)
        given = {"p": p, "q": q, "v": self.sampler.direction(rng, p)}
        values = run(function, *(given[a.name] for a in function.arguments))[1]
        for symmetry in trace.symmetries:
            entries = [[value(e, values) for e in pair] for pair in symmetry.pairs]
            if not largest(a - b for a, b in entries) <= TINY * largest(a for a, _ in entries):
                hint = "the symmetric part of A is (A + transpose(A)) / 2"
                raise UserError(
                    "this is a function of symmetric matrices; here the matrix is none", symmetry.span, hint
                )

    @cached_property
    def domain(self) -> sp.Expr | None:
        """1 where a point is valid."""
        if self.spec.domain is None:
            return None
        trace = Trace([self.p])
        comparison = Reading(self.spec, trace).read(self.spec.domain)
        assert isinstance(comparison, Truth)
        a, b = (trace.unfolded(side, self.spec.domain.value.span) for side in (comparison.a, comparison.b))
        return truth(comparison.kind, a, b)

    @cached_property
    def sampler(self) -> Sampler:
        """Where points come from while formulas are looked at."""
        spec = self.spec
        reach = reach_of(self.length(spec.injectivity_radius, "injectivity_radius"))
        project = self.project if spec.embedded else None
        to_tangent, norm = self.operators.to_tangent(), self.operators.norm()
        exp, free = self.plain_exp[0], is_free(spec)
        bounded = spec.injectivity_radius is not None
        written_at = (spec.norm or spec.metric).value.span
        sampler = Sampler(
            project, self.domain, to_tangent, norm, exp, spec.point_size, reach, free, bounded, written_at
        )
        self.check_positive(sampler)
        return sampler

    def check_positive(self, sampler: Sampler) -> None:
        """Refuse a metric that is not positive on tangent vectors."""
        inner = self.operators.inner()
        for _ in range(3):
            p = sampler.point(self.rng)
            size = range(self.spec.dim)
            basis = [run(sampler.to_tangent, p, sampler.gaussian(self.rng, self.spec.point_size))[0] for _ in size]
            with mp.workdps(DIGITS):
                gram = mp.matrix([[run(inner, p, u, v)[0][0] for v in basis] for u in basis])
            if not is_positive_definite(gram):
                span = self.spec.metric.value.span
                raise UserError("the metric is not positive: <v, v> <= 0 for a tangent vector v", span)
            if self.spec.norm is not None and not run(sampler.norm, p, basis[0])[0][0] > 0:
                raise UserError("`norm` is not positive for a tangent vector v", self.spec.norm.value.span)

    @cached_property
    def plain_exp(self) -> tuple[Function, Trace]:
        """Exp as the author wrote it, traced with the zero vector as a probe."""
        spec = self.spec
        base = run(self.project, [mp.mpf(k + 2) / (k + 3) for k in range(spec.point_size)])[0]
        probe = self.probe((self.p, base), (self.v, [mp.mpf(0)] * spec.tangent_size))
        return self.traced("exp", spec.exp, (self.p, self.v), probe, (spec.point_size,))

    @cached_property
    def exp(self) -> Function:
        """Exp with its 0/0 at the zero vector removed."""
        function, trace = self.plain_exp
        self.check_finite(function, self.spec.exp)
        return self.mended(function, trace, exp_ray(function, self.sampler), spec_map=self.spec.exp).pruned()

    @cached_property
    def plain_log(self) -> tuple[Function, Trace]:
        """Log as the author wrote it, traced with coincident points as a probe."""
        point = self.sampler.point(self.rng)
        return self.traced(
            "log",
            self.spec.log,
            (self.p, self.q),
            self.probe((self.p, point), (self.q, point)),
            (self.spec.tangent_size,),
        )

    @cached_property
    def mended_log(self) -> Function:
        """Log with its 0/0 at coincident points removed, before the cut locus is looked at."""
        function, trace = self.plain_log
        self.check_finite(function, self.spec.log)
        return self.mended(function, trace, self.ray, spec_map=self.spec.log)

    def check_finite(self, function: Function, spec_map: Map) -> None:
        """Refuse an Exp or a Log that has no value where it is asked for one."""
        p, q = self.sampler.pair(random.Random(4))
        where = q if function.name == "log" else self.sampler.direction(random.Random(4), p)
        if not mp.isfinite(largest(run(function, p, where)[0])):
            name = "Log_p(q)" if function.name == "log" else "Exp_p(v)"
            raise UserError(f"{name} is no finite real vector at some points", spec_map.value.span)

    @cached_property
    def log(self) -> Function:
        """Log, with the declared value on the cut locus."""
        cut = self.spec.cut_locus
        return self.with_cut(self.mended_log, cut.log if cut else None).pruned()

    def with_cut(self, regular: Function, declared: Map | None) -> Function:
        """A function of p and q with a declared value where the cut locus is; there, the formula is given p for q."""
        cut = self.spec.cut_locus
        if cut is None or declared is None:
            return regular
        trace = Trace((self.p, self.q))
        reading = Reading(self.spec, trace)
        condition = reading.read(cut.where)
        values = reading.entries(declared)
        assert isinstance(condition, Truth)

        def choose(there: sp.Expr, elsewhere: sp.Expr) -> sp.Expr:
            return ChooseSafe(condition.kind, condition.a, condition.b, there, elsewhere)

        safe = {q: sp.Symbol(f"{q}_off_cut", real=True) for q in self.q.symbols}
        elsewhere = renamed(
            regular,
            {**safe, **{a.symbol: sp.Symbol(trace.fresh(str(a.symbol)), real=True) for a in regular.assignments}},
        )
        inputs = tuple(Assignment(safe[q], choose(p, q)) for p, q in zip(self.p.symbols, self.q.symbols, strict=True))
        results = tuple(choose(there, e) for there, e in zip(values, elsewhere.results, strict=True))
        return replace(regular, assignments=(*trace.assignments, *inputs, *elsewhere.assignments), results=results)

    @cached_property
    def ray(self) -> Ray:
        """Rays along which quantities of Log are looked at near coincident points."""
        return log_ray(self.plain_log[0], self.sampler)

    @cached_property
    def jacobian(self) -> StagedJacobian:
        """d Log_p(q) / d q, away from the cut locus."""
        return staged_jacobian(self.mended_log.pruned())

    @cached_property
    def distance(self) -> Function:
        """The author's closed form, or the length of Log."""
        spec = self.spec
        if spec.distance is not None:
            return self.with_log_names("distance", spec.distance)
        trace = Trace(self.log.arguments)
        trace.taken |= {str(a.symbol) for a in self.log.assignments}
        vector = [trace.define(f"log{i}", e) for i, e in enumerate(self.log.results)]
        length = self.operators.length_of(vector, trace)
        return Function(
            "distance", self.log.arguments, (*self.log.assignments, *trace.assignments), (length,), (), "|Log_p(q)|_p"
        )

    @property
    def given(self) -> tuple[Function, ...]:
        """What only the author can know: other names of points, transport, and a uniform distribution."""
        spec = self.spec
        if spec.transport is not None and spec.maps == "retraction":
            raise UserError("transport is along geodesics, which a retraction does not know", spec.transport.value.span)
        if spec.sample is not None and spec.diameter is None:
            raise UserError(
                "there is no uniform distribution on the whole of a manifold without a `diameter`",
                spec.sample.value.span,
            )
        functions = []
        if spec.equivalent is not None:
            functions.append(scalarised(spec, "other_name", spec.equivalent, (self.p,), (spec.point_size,)))
        if spec.transport is not None:
            functions.append(self.with_log_names("transport", spec.transport, self.v))
        if spec.sample is not None:
            numbers = argument("normal", self.spec.point_size), argument("uniform", self.spec.point_size)
            functions.append(scalarised(spec, "sample", spec.sample, numbers, (self.spec.point_size,)))
        return tuple(functions)

    @cached_property
    def log_abs_det(self) -> tuple[Function, str]:
        """log |det D Log|, with the declared value on the cut locus, and where the formula is from."""
        cut = self.spec.cut_locus
        function, origin = self.regular_log_abs_det
        return self.with_cut(function, cut.log_det if cut else None).pruned(), origin

    @cached_property
    def regular_log_abs_det(self) -> tuple[Function, str]:
        """log |det D Log| away from the cut locus."""
        spec = self.spec
        if spec.log_det is not None:
            function = self.with_log_names("log_abs_det", spec.log_det)
            return self.smooth_log_det(function, function.results[0]), "author"
        _, trace = self.plain_log
        named = {name for name, _ in spec.log.lets}
        scalars = sorted(
            trace.scalars, key=lambda s: str(s) not in named
        )  # the author's own names first: people read them
        found = closed_form(self.jacobian, self.mended_log, scalars, self.operators, self.sampler)
        if found is None:
            return staged_log_det(self.jacobian, self.operators).pruned(), "staged"
        expression = found.log()
        function = replace(
            self.mended_log, name="log_abs_det", results=(expression,), shape=(), formula=str(expression)
        )
        return self.smooth_log_det(function, expression), "closed form"

    def smooth_log_det(self, function: Function, expression: sp.Expr) -> Function:
        """A closed form that is log(0/0) at coincident points, mended there: it vanishes like the distance squared."""
        point = self.sampler.point(self.rng)
        at_zero = run(function, point, point)[1]
        there = value(expression, at_zero)
        if expression.is_number or (mp.isfinite(there) and abs(there) > TINY):
            return function.pruned()
        place = {s: at_zero[s] for s in function.symbols()}
        ray = log_ray(function, self.sampler)
        guard = remove(expression, smooth_squares(function, at_zero), ray, self.reach(), place, order=1)
        if guard is None and mp.isfinite(there):
            return function.pruned()
        if guard is None:
            raise UserError(
                "log |det D Log| is not finite where the points coincide, and no smooth quantity mends it",
                (self.spec.log_det or self.spec.log).value.span,
            )
        symbol = sp.Symbol("log_det", real=True)
        return replace(
            function, assignments=(*function.assignments, Assignment(symbol, expression, guard)), results=(symbol,)
        ).pruned()

    def with_log_names(self, name: str, chart_map: Map, *more: Argument) -> Function:
        """A formula that may use the names of Log, on top of the mended assignments of Log."""
        trace = self.plain_log[1].extended(*more)
        result = Reading(self.spec, trace).entries(chart_map)
        arguments, shape, text = (self.p, self.q, *more), chart_map.value.shape, chart_map.value.text
        self.check_symmetric(Function(name, arguments, tuple(trace.assignments), result, shape, text), trace)
        mended = {a.symbol: a for a in self.mended_log.assignments}
        assignments = tuple(mended.get(a.symbol, a) for a in trace.assignments)
        return Function(name, arguments, assignments, result, shape, text).pruned()

    def traced(
        self, name: str, chart_map: Map, arguments: Sequence[Argument], probe: Values, shape: tuple[int, ...]
    ) -> tuple[Function, Trace]:
        """A map of the spec, and the trace of how it was read."""
        trace = Trace(arguments, probe)
        results = Reading(self.spec, trace).entries(chart_map)
        return Function(name, tuple(arguments), tuple(trace.assignments), results, shape, chart_map.value.text), trace

    def mended(self, function: Function, trace: Trace, ray: Ray, spec_map: Map) -> Function:
        """The function with guards; an error at the formula where a 0/0 stays."""
        if not trace.quotients:
            return function
        result, failed = guarded(function, trace.quotients, trace.probe or {}, ray, self.reach())
        if failed:
            self.check_radius(function, trace, ray)
            place = "Exp at the zero vector" if function.name == "exp" else "Log at coincident points"
            raise UserError(
                f"{place} is 0/0 in `{failed[0]}`, and no smooth quantity under a square root mends it",
                spec_map.value.span,
                "divide by a norm only what vanishes with it and is a function of it alone: t * w / norm(w), sinc(x), sinhc(x)",
            )
        return result

    def check_radius(self, function: Function, trace: Trace, ray: Ray) -> None:
        """Blame the injectivity radius for a 0/0 that can be removed when no more than a part of it is looked at."""
        if self.spec.injectivity_radius is None:
            return
        nearer: Ray = lambda rng: (lambda at: lambda r: at(r / 4))(ray(rng))  # noqa: E731
        if not guarded(function, trace.quotients, trace.probe or {}, nearer, self.reach())[1]:
            raise UserError(
                "`injectivity_radius` is too large: Log has a second singularity within it",
                self.spec.injectivity_radius.value.span,
            )

    def reach(self) -> mp.mpf:
        """How far a polynomial near a singular place is asked to reach, at first."""
        return self.sampler.reach * 2 / 3

    def probe(self, *pairs: tuple[Argument, Sequence[mp.mpf]]) -> Values:
        """Values for the arguments of a trace."""
        return {s: x for a, values in pairs for s, x in zip(a.symbols, values, strict=True)}


class _AsWritten(_Derivation):
    """A derivation that mends nothing."""

    def mended(self, function: Function, trace: Trace, ray: Ray, spec_map: Map) -> Function:
        return function

    @cached_property
    def regular_log_abs_det(self) -> tuple[Function, str]:
        return Function("log_abs_det", (self.p, self.q), (), (sp.Integer(0),), (), "0"), "staged"
