"""Points and tangent vectors of a manifold in 60 digits, made from its own formulas and a seed."""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import mpmath as mp
import sympy as sp
from mpmath import libmp

from rsrm_gen.compiler.derive.geometry import Choose, Function, Geometry
from rsrm_gen.compiler.derive.numeric import DIGITS, PRECISION, run, value
from rsrm_gen.compiler.spec import ManifoldSpec, Spec
from rsrm_gen.errors import Span, UserError

Numbers = list[Any]


@dataclass(frozen=True)
class Sampler:
    """Draws points by `project` (or from the chart's domain) and tangent vectors by `to_tangent`.

    `norm` measures them; `reach` bounds how far apart two sampled points are: half the injectivity radius, or 1.
    """

    project: Function | None
    domain: sp.Expr | None  # positive inside
    to_tangent: Function
    norm: Function
    exp: Function
    point_size: int
    reach: Any
    free: bool = False  # whether any numbers are a tangent vector, as components in a chart or a frame are
    bounded: bool = False  # whether there is a finite injectivity radius, twice the reach
    norm_written_at: Span | None = None

    def gaussian(self, rng: random.Random, size: int) -> Numbers:
        """`size` numbers, each of three doubles' worth of random digits."""
        return [_long_number(rng) for _ in range(size)]

    def point(self, rng: random.Random) -> Numbers:
        """A point of the manifold."""
        for attempt in range(1000):
            scale = mp.mpf(2) ** -(attempt // 50)  # a small domain is found by smaller vectors
            x = [scale * c for c in self.gaussian(rng, self.point_size)]
            p = run(self.project, x)[0] if self.project else x
            if all(mp.isfinite(c) for c in p) and self.inside(p):
                return p
        raise UserError("no point found: `project` or `domain` refuses every vector that was tried")

    def inside(self, p: Sequence[Any]) -> bool:
        """Whether the domain of the spec holds at p."""
        if self.domain is None:
            return True
        arguments = self.to_tangent.arguments[0].symbols
        return bool(value(self.domain, dict(zip(arguments, p, strict=True))) == 1)

    def direction(self, rng: random.Random, p: Sequence[Any]) -> Numbers:
        """A tangent vector at p of length 1 in the metric."""
        with mp.workdps(DIGITS):
            if self.free:
                v = self.gaussian(rng, len(self.to_tangent.results))
            else:
                v = run(self.to_tangent, p, self.gaussian(rng, self.point_size))[0]
            length = run(self.norm, p, v)[0][0]
            if length == 0:
                raise UserError("`norm` is not positive for a tangent vector v", self.norm_written_at)
            return [c / length for c in v]

    def along(self, p: Sequence[Any], u: Sequence[Any], r: Any) -> Numbers:
        """Exp_p(r u)."""
        with mp.workdps(DIGITS):
            return run(self.exp, p, [r * c for c in u])[0]

    def pair(self, rng: random.Random, distance: Any = None) -> tuple[Numbers, Numbers]:
        """Two points; at a distance that is neither small nor close to the cut locus, unless one is given."""
        p = self.point(rng)
        r = distance or self.reach * (mp.mpf(rng.random()) * mp.mpf("0.8") + mp.mpf("0.2"))
        return p, self.along(p, self.direction(rng, p), r)


def _long_number(rng: random.Random) -> Any:
    """A normal variate, then 100 more random bits."""
    parts = libmp.from_float(rng.gauss(0, 1)), libmp.from_float(rng.random()), libmp.from_float(rng.random())
    tail = libmp.mpf_add(libmp.mpf_shift(parts[1], -50), libmp.mpf_shift(parts[2], -100))
    return mp.make_mpf(libmp.mpf_add(parts[0], tail, PRECISION, "n"))


def reach_of(injectivity_radius: sp.Expr, unit: sp.Expr = sp.S.One) -> Any:
    """Half the injectivity radius, or a natural unit of length where there is none."""
    return value(unit, {}) if injectivity_radius == sp.oo else value(injectivity_radius, {}) / 2


def sampler_of(geometry: Geometry) -> Sampler:
    """The sampler of a derived manifold."""
    spec = geometry.spec
    project = geometry["project"] if spec.embedded else None
    reach = reach_of(geometry.injectivity_radius, geometry.unit)
    functions = geometry["to_tangent"], geometry["norm"], geometry["exp"]
    bounded = geometry.injectivity_radius != sp.oo
    return Sampler(project, geometry.domain, *functions, spec.point_size, reach, is_free(spec), bounded)


def is_free(spec: Spec) -> bool:
    """Whether tangent vectors are components that obey no condition; of a product it is not asked."""
    return isinstance(spec, ManifoldSpec) and not spec.ambient_tangents


def truth(kind: sp.Expr, a: sp.Expr, b: sp.Expr) -> sp.Expr:
    """1 where a comparison holds, else 0."""
    return Choose(kind, a, b, 1, 0)
