"""The points at which a residual is brought down: fresh at every step, uniform in volume, not too near to the goal.

What random numbers are drawn at a step follows from the seed and the step alone, so that going on exactly needs no state
of a generator, and so that every model that is trained with a seed is trained at the same points.
"""

from __future__ import annotations

import math
from typing import Literal, get_args

import torch
from torch import Tensor

from rsrm_gen.errors import UserError
from rsrm_gen.trainer.arithmetic import Points
from rsrm_gen.trainer.clock import NO_CLOCK, Clock
from rsrm_gen.trainer.model import ArrivalTime
from rsrm_gen.trainer.objectives.objective import random_numbers
from rsrm_gen.trainer.objectives.residual import Residual
from rsrm_gen.trainer.scene import Scene
from rsrm_gen.trainer.settings import EikonalTraining
from rsrm_gen.trainer.threads import one_thread

BLOCK = 16  # steps whose points are drawn together

Purpose = Literal["points", "splats", "final loss"]
PURPOSES = get_args(Purpose)


class Collocation:
    """The points of a training on a scene."""

    def __init__(self, scene: Scene, settings: EikonalTraining, residual: Residual, clock: Clock = NO_CLOCK) -> None:
        """The residual knows what the loss needs of a point."""
        self.scene = scene
        self.settings = settings
        self.residual = residual
        self.clock = clock
        self._steps: dict[int, Points] = {}  # of the block that was drawn last

    def at_step(self, arrival: ArrivalTime, step: int) -> Points:
        """What this step learns from; at most `points` of them."""
        if step not in self._steps:
            self._draw(arrival, step - step % BLOCK)
        return self._steps[step]

    def _draw(self, arrival: ArrivalTime, first: int) -> None:
        with one_thread():
            x = self.scene.sample(BLOCK * self.settings.points, generator(self.settings.seed, "points", first))
            self.clock.lap("sampling")
            points = self.residual.at_each(arrival, x, BLOCK, self.settings.goal_exclusion)
        self.clock.lap("geometry of the points")
        if not any(len(part.x) for part in points):
            raise self._nothing_is_far()
        self._steps = dict(enumerate(points, first))

    def fresh(self, count: int, purpose: Purpose, step: int) -> Tensor:
        """Points of the domain, uniform in volume, without those near the goal: (at most `count`, D)."""
        x = self.scene.sample(count, generator(self.settings.seed, purpose, step))
        far = self.scene.manifold.distance(x, self.scene.goal) > self.settings.goal_exclusion
        if not far.any():
            raise self._nothing_is_far()
        return x[far]

    def _nothing_is_far(self) -> UserError:
        limit = self.settings.goal_exclusion
        return UserError(f"no point of the domain is farther than {limit:g} from the goal")


def generator(seed: int, purpose: Purpose, step: int = 0) -> torch.Generator:
    """The random numbers of a training with this seed for one purpose at one step."""
    return random_numbers(seed, step, PURPOSES.index(purpose))


def learning_rate(settings: EikonalTraining, step: int) -> float:
    """Of the step to come: constant, or a half cosine down to the final one."""
    first, final = settings.learning_rate, settings.final_learning_rate
    if final is None:
        return first
    return final + (first - final) * (1 + math.cos(math.pi * step / settings.steps)) / 2
