"""The residual of |grad T|_g = s at sampled points (RSRM eq. 8) and its derivative in the splats, around the kernel.

A small residual does not make T the arrival time: the equation has many solutions almost everywhere, and only the
viscosity solution is the one. How right a field is, `evaluate.py` says.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

import torch
from torch import Tensor

from rsrm_gen.trainer.arithmetic import Loss, Points
from rsrm_gen.trainer.clock import NO_CLOCK, Clock
from rsrm_gen.trainer.model import ArrivalTime
from rsrm_gen.trainer.scene import Scene


@dataclass(frozen=True)
class Residual:
    """The mean over points of |1 - sqrt q| + |1 - 1 / sqrt q| (`ratio`), q = |grad T|_g / s, or of
    (|grad T|_g - s)^2 (`squared`)."""

    scene: Scene
    kind: Literal["ratio", "squared"] = "ratio"
    rows: dict[int, Tensor] = field(default_factory=dict, repr=False, compare=False)  # what `_centers` last gave

    def at(self, arrival: ArrivalTime, x: Tensor) -> Points:
        """The points x (N, D)."""
        return self.at_each(arrival, x, 1)[0]

    def at_each(self, arrival: ArrivalTime, x: Tensor, parts: int, exclusion: float = -1.0) -> list[Points]:
        """The points x (N, D) in so many equal parts, without those nearer to the goal than the exclusion."""
        manifold, arithmetic, law = arrival.manifold, arrival.field.arithmetic, self.scene.law
        goal, *centers = self._centers(len(x))
        distances = x.new_empty(len(centers), len(x))
        for center, distance in zip(centers, distances, strict=True):
            distance.copy_(manifold.distance(x, center))
        slowness = arithmetic.slowness(distances, self.scene.radii, law.free, law.obstacle, law.width)
        points = Points(x, *arrival.base.value_and_gradient(x), slowness)
        return arithmetic.far(parts, exclusion, manifold.distance(x, goal), points)

    def _centers(self, count: int) -> Tensor:
        """The goal and the obstacles' centres, each as so many rows: (1 + m, N, D)."""
        if count not in self.rows:
            self.rows.clear()
            centers = torch.cat((self.scene.goal[None], self.scene.centers))
            self.rows[count] = centers[:, None].expand(-1, count, -1).contiguous()
        return self.rows[count]

    def loss(self, arrival: ArrivalTime, x: Tensor) -> tuple[float, Tensor]:
        """The mean residual and the residual of each point (N,); x is (N, D)."""
        loss = self.given(arrival, self.at(arrival, x), *arrival.field.value_and_gradient(x))
        return loss.mean, loss.residual

    def loss_and_gradient(self, arrival: ArrivalTime, points: Points, clock: Clock = NO_CLOCK) -> tuple[float, Tensor]:
        """The mean residual and its derivatives in the splats, as `SplatField.gradient` has them."""
        splats = arrival.field.splats()
        mu, W, amplitude = inputs = [t.detach().requires_grad_() for t in splats.inputs()]
        width = arrival.field.widths(len(points.x))
        clock.lap("splat map")
        f, df = arrival.manifold.splats(points.x, mu, W, amplitude, width)
        clock.lap("kernel forward")
        loss = self.given(arrival, points, f.detach(), df.detach())
        clock.lap("loss")
        bars = torch.autograd.grad((f, df), inputs, (loss.f_bar, loss.df_bar))
        clock.lap("kernel backward")
        gradient = arrival.field.gradient(splats, *bars)
        clock.lap("splat map")
        return loss.mean, gradient

    def given(self, arrival: ArrivalTime, points: Points, f: Tensor, df: Tensor) -> Loss:
        """The loss, from f (N,) and grad f (N, T), whatever they come from."""
        arithmetic, df = arrival.field.arithmetic, df.contiguous()
        slope = arithmetic.slope(arrival.link, points, f, df)
        covector = arrival.field.flat(points.x, slope.gradient)
        return arithmetic.eikonal(self.kind == "squared", points, slope, covector, df)
