"""`objective: eikonal`, the RSRM paper's: the residual of |grad T|_g = s at fresh points, AdamW, splats that come and go.

What random numbers are drawn at a step follows from the seed and the step alone, so that going on exactly needs no state
of a generator.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Literal, get_args

import numpy as np
import torch
from torch import Tensor

from rsrm_gen.errors import UserError
from rsrm_gen.manifold import not_finite
from rsrm_gen.trainer.arithmetic import Points
from rsrm_gen.trainer.clock import NO_CLOCK, Clock
from rsrm_gen.trainer.density import make_density, pick_apart, pick_spread
from rsrm_gen.trainer.objectives.residual import Residual
from rsrm_gen.trainer.optimise import AdamW
from rsrm_gen.trainer.run import Arrays, fill_rows, new_arrival
from rsrm_gen.trainer.scene import Scene
from rsrm_gen.trainer.settings import EikonalTraining
from rsrm_gen.trainer.threads import one_thread

BLOCK = 16  # steps whose points are drawn together
POOL = 4096  # points at which the residual is looked at for new splats
FINAL_POINTS = 16384  # points of the final loss

Purpose = Literal["points", "splats", "final loss"]
PURPOSES = get_args(Purpose)


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
        self._points: list[Points] = []  # of the steps to come in this block

    def begin(self) -> None:
        """The first splats, well spread over the domain."""
        count = self.settings.splats.initial
        candidates = self.scene.sample(8 * count, self.generator("splats"))
        self.field.append(pick_spread(self.scene.manifold, candidates, count), self.settings.splats.shape)

    def advance(self) -> float:
        """One step: its loss. A loss or gradient that is not finite is a `FloatingPointError`, and nothing moved."""
        if not self._points:
            self._points = self._block()
        loss, gradient = self.residual.loss_and_gradient(self.arrival, self._points[0], self.clock)
        if not math.isfinite(loss):
            splats = {name: rows[: self.field.count] for name, rows in self.field.buffers_of_splats().items()}
            culprit = not_finite(points=self._points[0].x, **splats)
            raise FloatingPointError(f"the loss is {loss}" + (f", and {culprit}" if culprit else ""))
        self.adam.step(gradient, self.learning_rate(), self.clock)
        self.field.clamp_shapes(self.settings.splats.min_singular)
        self.clock.lap("clamp")
        if (self.step + 1) % BLOCK == 0:
            self.field.project_centers()
        del self._points[0]
        self.step += 1
        change = self.density.update(self.step, self.field, self.propose)
        if change:
            self.adam.follow(change)
            self.clock.lap("density control")
        return loss

    def _block(self) -> list[Points]:
        """What the steps of this block that are still to come learn from; the same wherever in it one begins."""
        begun = self.step % BLOCK
        with one_thread():
            x = self.scene.sample(BLOCK * self.settings.points, self.generator("points", self.step - begun))
            self.clock.lap("sampling")
            points = self.residual.at_each(self.arrival, x, BLOCK, self.settings.goal_exclusion)
        self.clock.lap("geometry of the points")
        if not any(len(part.x) for part in points):
            raise self._nothing_is_far()
        return points[begun:]

    def points(self, count: int, purpose: Purpose) -> Tensor:
        """Fresh points of the domain, uniform in volume, without those near the goal: (at most `count`, D)."""
        x = self.scene.sample(count, self.generator(purpose, self.step))
        far = self.scene.manifold.distance(x, self.scene.goal) > self.settings.goal_exclusion
        if not far.any():
            raise self._nothing_is_far()
        return x[far]

    def _nothing_is_far(self) -> UserError:
        limit = self.settings.goal_exclusion
        return UserError(f"no point of the domain is farther than {limit:g} from the goal")

    def generator(self, purpose: Purpose, step: int = 0) -> torch.Generator:
        """The random numbers of this training for one purpose at one step."""
        entropy = (self.settings.seed, step, PURPOSES.index(purpose))
        state = np.random.SeedSequence(entropy).generate_state(1, np.uint64)
        return torch.Generator().manual_seed(int(state[0]))

    def propose(self, count: int) -> Tensor:
        """Centres for new splats where the residual is largest, not closer to each other than half a shape: (k, D)."""
        x = self.points(POOL, "splats")
        loss = self.residual.loss(self.arrival, x)[1]
        return pick_apart(self.scene.manifold, x, loss, count, self.settings.splats.shape / 2)

    def learning_rate(self) -> float:
        """Of the step to come: constant, or a half cosine down to the final one."""
        first, final = self.settings.learning_rate, self.settings.final_learning_rate
        if final is None:
            return first
        return final + (first - final) * (1 + math.cos(math.pi * self.step / self.settings.steps)) / 2

    def final_loss(self) -> float:
        """The mean residual at many fresh points."""
        x = self.points(FINAL_POINTS, "final loss")
        return float(torch.cat([self.residual.loss(self.arrival, part)[1] for part in torch.split(x, POOL)]).mean())

    def arrays(self) -> Arrays:
        """Everything that changes, as plain arrays: active rows only."""
        buffers = {**self.field.buffers_of_splats(), **self.adam.buffers_of_splats()}
        arrays: Arrays = {name: rows[: self.field.count].numpy() for name, rows in buffers.items()}
        return {**arrays, "step": np.array(self.step)}

    def restore(self, arrays: Arrays, path: Path) -> None:
        """Go back to what `arrays` gave; it was read from `path`."""
        buffers = {**self.field.buffers_of_splats(), **self.adam.buffers_of_splats()}
        self.field.count = fill_rows(buffers, arrays, path)
        self.step = int(arrays["step"])
        self._points = []
