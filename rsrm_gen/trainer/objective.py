"""The Eikonal objective |grad T|_g = s at sampled points (RSRM eq. 8).

A small residual does not make T the arrival time: the equation has many solutions almost everywhere, and only the
viscosity solution is the one. How right a field is, `evaluate.py` says.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import torch
from torch import Tensor

from rsrm_gen.trainer.model import ArrivalTime
from rsrm_gen.trainer.scene import Scene

# Below this |grad T| / s the ratio's slope, q^(-3/2), says nothing any more but would drown every other point.
SMALLEST_RATIO = 1e-6


@dataclass(frozen=True)
class Eikonal:
    """The mean over points of |1 - sqrt q| + |1 - 1 / sqrt q| (`ratio`), q = |grad T|_g / s, or of
    (|grad T|_g - s)^2 (`squared`)."""

    scene: Scene
    residual: Literal["ratio", "squared"] = "ratio"

    def loss(self, arrival: ArrivalTime, x: Tensor) -> tuple[Tensor, Tensor]:
        """The mean residual, to be differentiated once, and the residual of each point (N,), detached; x is (N, D)."""
        _, gradient = arrival.time_and_gradient(x)
        residual = self._residual(self.scene.manifold.norm(x, gradient), self.scene.slowness(x))
        return residual.mean(), residual.detach()

    def _residual(self, slope: Tensor, slowness: Tensor) -> Tensor:
        if self.residual == "squared":
            return (slope - slowness) ** 2
        root = (slope / slowness).clamp_min(SMALLEST_RATIO).sqrt()
        return torch.abs(1 - root) + torch.abs(1 - 1 / root)
