"""The Eikonal objective |grad T|_g = s at sampled points (RSRM eq. 8).

A small residual does not make T the arrival time: the equation has many solutions almost everywhere, and only the
viscosity solution is the one. How right a field is, `evaluate.py` says.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import torch
from torch import Tensor

from rsrm_gen.trainer.clock import NO_CLOCK, Clock
from rsrm_gen.trainer.model import ArrivalTime
from rsrm_gen.trainer.scene import Scene
from rsrm_gen.trainer.threads import one_thread

# Below this |grad T| / s the ratio's slope, q^(-3/2), says nothing any more but would drown every other point.
SMALLEST_RATIO = 1e-6


@dataclass(frozen=True)
class Points:
    """N points and what the loss needs to know of them, which does not change with the field."""

    x: Tensor  # (N, D)
    distance: Tensor  # (N,), to the goal
    away: Tensor  # (T, N), its gradient
    slowness: Tensor  # (N,)

    def split(self, counts: Sequence[int]) -> list[Points]:
        """So many points each, one after the other."""
        away = torch.split(self.away, list(counts), 1)
        x, distance, slowness = (torch.split(t, list(counts)) for t in (self.x, self.distance, self.slowness))
        return [Points(*part) for part in zip(x, distance, away, slowness, strict=True)]


@dataclass(frozen=True)
class Eikonal:
    """The mean over points of |1 - sqrt q| + |1 - 1 / sqrt q| (`ratio`), q = |grad T|_g / s, or of
    (|grad T|_g - s)^2 (`squared`)."""

    scene: Scene
    residual: Literal["ratio", "squared"] = "ratio"

    @torch.no_grad()
    def at(self, arrival: ArrivalTime, x: Tensor) -> Points:
        """The points x (N, D)."""
        return Points(x, *arrival.from_goal(x), self.scene.slowness(x))

    @torch.no_grad()
    def loss(self, arrival: ArrivalTime, x: Tensor) -> tuple[Tensor, Tensor]:
        """The mean residual and the residual of each point (N,); x is (N, D)."""
        residual, _, _ = self._differentiated(arrival, self.at(arrival, x), *arrival.field.value_and_gradient(x))
        return residual.mean(), residual

    def loss_and_gradient(self, arrival: ArrivalTime, points: Points, clock: Clock = NO_CLOCK) -> tuple[Tensor, Tensor]:
        """The mean residual and its derivatives in the splats, as `SplatField.gradient` has them."""
        with one_thread():
            splats = arrival.field.splats()
            mu, W, amplitude = inputs = [t.detach().requires_grad_() for t in splats.inputs()]
            widths = splats.widths(len(points.x))
        clock.lap("splat map")
        f, df = arrival.manifold.splats(points.x, mu, W, amplitude, widths)
        clock.lap("kernel forward")
        with one_thread():
            residual, f_bar, df_bar = self._differentiated(arrival, points, f.detach(), df.detach())
            loss = residual.mean()
        clock.lap("loss")
        bars = torch.autograd.grad((f, df), inputs, (f_bar, df_bar))
        clock.lap("kernel backward")
        with one_thread():
            gradient = arrival.field.gradient(splats, *bars)
        clock.lap("splat map")
        return loss, gradient

    @torch.no_grad()
    def _differentiated(
        self, arrival: ArrivalTime, points: Points, f: Tensor, df: Tensor
    ) -> tuple[Tensor, Tensor, Tensor]:
        """The residual of each point (N,), and the derivatives of their mean in f (N,) and in grad f (N, T)."""
        d, away, link = points.distance, points.away, arrival.link
        df = df.T.contiguous()  # points last, where numbers that are treated alike lie side by side
        by_d, by_f, by_df, by_ff = link.derivatives(d, f)
        gradient = by_d * away + by_f * df
        covector = arrival.manifold.flat(points.x, gradient.T).T.contiguous()
        slope = (covector * gradient).sum(0).clamp_min_(0).sqrt_()
        residual, by_slope = self._residual(slope, points.slowness)
        by_gradient = by_slope / (slope.clamp_min(1e-30) * len(f)) * covector
        f_bar = (by_gradient * (by_df * away + by_ff * df)).sum(0)
        return residual, f_bar, (by_f * by_gradient).T

    def _residual(self, slope: Tensor, slowness: Tensor) -> tuple[Tensor, Tensor]:
        """The residual and its derivative in the slope: (N,), (N,)."""
        if self.residual == "squared":
            return (slope - slowness) ** 2, 2 * (slope - slowness)
        q = slope / slowness
        root = q.clamp_min(SMALLEST_RATIO).sqrt_()
        inverse = 1 / root
        # Both terms have one sign: |1 - r| + |1 - 1 / r| = |r - 1 / r|.
        difference = root - inverse
        by_root = difference.sign() * (1 + inverse * inverse)
        return difference.abs(), by_root * inverse / (2 * slowness) * (q > SMALLEST_RATIO)
