"""`objective: eikonal`, the RSRM paper's: the residual of |grad T|_g = s at fresh points, AdamW, splats that come and go."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import torch
from torch import Tensor

from rsrm_gen.manifold import not_finite
from rsrm_gen.trainer.clock import NO_CLOCK, Clock
from rsrm_gen.trainer.density import make_density, pick_apart, pick_spread
from rsrm_gen.trainer.objectives.collocation import BLOCK, Collocation, Purpose, generator, learning_rate
from rsrm_gen.trainer.objectives.residual import Residual
from rsrm_gen.trainer.optimise import AdamW
from rsrm_gen.trainer.run import Arrays, fill_rows, first_rows, new_arrival
from rsrm_gen.trainer.scene import Scene
from rsrm_gen.trainer.settings import EikonalTraining

POOL = 4096  # points at which the residual is looked at for new splats
FINAL_POINTS = 16384  # points of the final loss


class Eikonal:
    """All that changes while the residual is brought down, and one step of it."""

    def __init__(self, scene: Scene, clock: Clock = NO_CLOCK) -> None:
        """At step 0 and without splats: place the first ones, or restore a checkpoint."""
        assert isinstance(scene.training, EikonalTraining)
        settings = scene.training
        self.scene = scene
        self.settings = settings
        self.arrival = new_arrival(scene, settings.capacity)
        self.field = self.arrival.field
        self.residual = Residual(scene, settings.objective.residual)
        self.density = make_density(settings)
        self.adam = AdamW(self.field, settings.weight_decay, settings.gradient_clip)
        self.clock = clock
        self.step, self.steps = 0, settings.steps
        self.phase = "descent"
        self.collocation = Collocation(scene, settings, self.residual, clock)

    def begin(self) -> None:
        """The first splats, well spread over the domain."""
        count = self.settings.splats.initial
        candidates = self.scene.sample(8 * count, generator(self.settings.seed, "splats"))
        self.field.append(pick_spread(self.scene.manifold, candidates, count), self.settings.splats.shape)

    def advance(self) -> float:
        """One step: its loss. A loss or gradient that is not finite is a `FloatingPointError`, and nothing moved."""
        points = self.collocation.at_step(self.arrival, self.step)
        loss, gradient = self.residual.loss_and_gradient(self.arrival, points, self.clock)
        if not math.isfinite(loss):
            splats = {name: rows[: self.field.count] for name, rows in self.field.buffers_of_splats().items()}
            culprit = not_finite(points=points.x, **splats)
            raise FloatingPointError(f"the loss is {loss}" + (f", and {culprit}" if culprit else ""))
        self.adam.step(gradient, self.learning_rate(), self.clock)
        self.field.clamp_shapes(self.settings.splats.min_singular)
        self.clock.lap("clamp")
        if (self.step + 1) % BLOCK == 0:
            self.field.project_centers()
        self.step += 1
        change = self.density.update(self.step, self.field, self.propose)
        if change:
            self.adam.follow(change)
            self.clock.lap("density control")
        return loss

    def points(self, count: int, purpose: Purpose) -> Tensor:
        """Fresh points of the domain, uniform in volume, without those near the goal: (at most `count`, D)."""
        return self.collocation.fresh(count, purpose, self.step)

    def propose(self, count: int) -> Tensor:
        """Centres for new splats where the residual is largest, not closer to each other than half a shape: (k, D)."""
        x = self.points(POOL, "splats")
        loss = self.residual.loss(self.arrival, x)[1]
        return pick_apart(self.scene.manifold, x, loss, count, self.settings.splats.shape / 2)

    def learning_rate(self) -> float:
        """Of the step to come: constant, or a half cosine down to the final one."""
        return learning_rate(self.settings, self.step)

    def final_loss(self) -> float:
        """The mean residual at many fresh points."""
        x = self.points(FINAL_POINTS, "final loss")
        return float(torch.cat([self.residual.loss(self.arrival, part)[1] for part in torch.split(x, POOL)]).mean())

    def arrays(self) -> Arrays:
        """Everything that changes, as plain arrays: active rows only."""
        buffers = {**self.field.buffers_of_splats(), **self.adam.buffers_of_splats()}
        return {**first_rows(buffers, self.field.count), "step": np.array(self.step)}

    def restore(self, arrays: Arrays, path: Path) -> None:
        """Go back to what `arrays` gave; it was read from `path`."""
        buffers = {**self.field.buffers_of_splats(), **self.adam.buffers_of_splats()}
        self.field.count = fill_rows(buffers, arrays, path)
        self.step = int(arrays["step"])
