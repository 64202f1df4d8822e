"""Closed forms that only an author can give: parallel transport, in high precision, and a uniform distribution, by counting."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import mpmath as mp
import torch

from rsrm_gen.compiler.audit.laws import Laws
from rsrm_gen.compiler.audit.numbers import Code
from rsrm_gen.compiler.audit.report import Check
from rsrm_gen.compiler.audit.whole import pairs_on_the_cut
from rsrm_gen.compiler.audit.worst import Worst, at, difference, relative
from rsrm_gen.compiler.derive import Geometry
from rsrm_gen.compiler.derive.numeric import largest, run, value
from rsrm_gen.compiler.derive.sampling import sampler_of
from rsrm_gen.compiler.emit import emit
from rsrm_gen.compiler.lower import lower
from rsrm_gen.compiler.spec import ManifoldSpec

RUNG = mp.mpf(10) ** -14  # of the ladder: its error is of the order of its square
SAMPLES, WAVES = 20_000, 12
STEP = 1e-3  # of second differences
DEVIATIONS = 5.0
PLACES, ROUNDED = 32, 1e-12  # samples whose place is looked at, and how exact they are in double precision


def transport_checks(laws: Laws) -> list[Check]:
    """Transport keeps inner products, takes Log_p(q) to -Log_q(p), does not see stops, and is the ladder's limit."""
    spec = laws.spec
    if "transport" not in laws.geometry:
        return []
    worst = Worst()
    for p, q in [*laws.pairs, *pairs_on_the_cut(laws)]:
        u, v = (laws.sampler.direction(laws.rng, p) for _ in range(2))
        moved = [laws.call("transport", p, q, w) for w in (u, v)]
        kept = laws.call("inner", q, *moved)[0] - laws.call("inner", p, u, v)[0]
        log, back = laws.call("log", p, q), laws.call("log", q, p)
        along = [a + b for a, b in zip(laws.call("transport", p, q, log), back, strict=True)]
        middle = laws.call("exp", p, [c / 2 for c in log])
        stopped = laws.call("transport", middle, q, laws.call("transport", p, middle, v))
        errors = [
            kept,
            relative(along, back),
            relative(difference(stopped, moved[1]), moved[1]),
            _ladder(laws, p, v),
        ]
        worst = worst.with_error(largest(errors), at("p", p, "q", q))
    promise = "`transport` carries v in parallel along the geodesic from p to q"
    return [laws.check("transport", promise, worst, spec.transport)]


def _ladder(laws: Laws, p: list[Any], v: list[Any]) -> Any:
    """How far transport is from the pole ladder over a short way, as a part of that way.

    The ladder needs only Exp and Log; here they are the formulas themselves, whose series near coincident points would be
    too coarse for so short a way.
    """
    exp, log = (laws.geometry[name] for name in ("exp", "log"))
    u = laws.sampler.direction(laws.rng, p)
    q = laws.sampler.along(p, u, RUNG)
    middle = laws.sampler.along(p, u, RUNG / 2)
    tip = laws.sampler.along(p, v, RUNG)
    reflected = run(exp, middle, [-c for c in run(log, middle, tip)[0]])[0]
    carried = [-c / RUNG for c in run(log, q, reflected)[0]]
    return relative(difference(carried, laws.call("transport", p, q, v)), v) / RUNG


def sample_checks(code: Code) -> list[Check]:
    """`sample` draws points of the manifold, uniformly: on a closed one, mean Laplacians of smooth functions vanish."""
    geometry, manifold = code.geometry, code.manifold
    if geometry.factors:
        return [check for name, factor in geometry.factors for check in _sample_checks_of_factor(name, factor)]
    if "sample" not in geometry:
        return []
    generator = torch.Generator().manual_seed(31)
    count = SAMPLES if geometry.spec.dim <= 4 else SAMPLES // 4  # frames cost the cube of the dimension
    points = manifold.sample(count, generator, torch.zeros((), dtype=torch.float64))
    place = _sample_place(geometry, points[:PLACES].tolist())
    if not place.passed:
        return [place]
    waves = _Waves(geometry, generator, getattr(manifold, "other_name", None))
    laplacian = torch.zeros(count, WAVES, dtype=torch.float64)
    frame = manifold.frame(points)
    for e in frame.unbind(-2):
        ahead, behind = (waves(manifold.exp(points, sign * STEP * e)) for sign in (1, -1))
        laplacian += (ahead - 2 * waves(points) + behind) / STEP**2
    means, deviations = laplacian.mean(0), laplacian.std(0) / count**0.5
    worst = float((means / deviations).abs().max())
    promise = "`sample` is uniform in volume: mean Laplacians vanish (in standard deviations)"
    spec = geometry.spec
    span = spec.sample.value.span if isinstance(spec, ManifoldSpec) and spec.sample else None
    return [place, Check("sample", promise, worst, DEVIATIONS, count, "", span, unit=None)]


def _sample_place(geometry: Geometry, points: list[list[float]]) -> Check:
    """Whether sampled points are those of the manifold: in its domain, and left alone by `project`."""
    spec, sampler, worst = geometry.spec, sampler_of(geometry), Worst()
    for p in points:
        moved = difference(run(sampler.project, p)[0], p) if sampler.project else [0]
        worst = worst.with_error(relative(moved, p) if sampler.inside(p) else mp.inf, at("p", p))
    promise = "`sample` draws points of the manifold, inside its `domain`"
    span = spec.sample.value.span if isinstance(spec, ManifoldSpec) and spec.sample else None
    return Check("sample place", promise, worst.error, ROUNDED, worst.points, worst.where, span)


def _sample_checks_of_factor(name: str, factor: Geometry) -> list[Check]:
    program = lower(factor)
    checks = sample_checks(Code(factor, program, emit(factor, program)))
    return [replace(check, name=f"{name}: {check.name}") for check in checks]


class _Waves:
    """Some random cosines of the stored numbers, whole in every period and the same for both names of a point."""

    def __init__(self, geometry: Geometry, generator: torch.Generator, other_name: Callable[[Any], Any] | None) -> None:
        self.other_name = other_name
        size = geometry.spec.point_size
        periods = [float(value(L, {})) if L is not None else None for L in geometry.periods or (None,) * size]
        rough = 2 * torch.randn(size, WAVES, generator=generator, dtype=torch.float64)
        whole = torch.randint(1, 4, (size, WAVES), generator=generator).double()
        rows = [rough[i] if L is None else 2 * torch.pi / L * whole[i] for i, L in enumerate(periods)]
        self.frequencies = torch.stack(rows)
        self.phases = 6 * torch.rand(WAVES, generator=generator, dtype=torch.float64)

    def __call__(self, points: Any) -> Any:
        waves = torch.cos(points @ self.frequencies + self.phases)
        return (
            waves
            if self.other_name is None
            else waves + torch.cos(self.other_name(points) @ self.frequencies + self.phases)
        )
