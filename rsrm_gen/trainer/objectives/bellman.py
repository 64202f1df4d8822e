"""`objective: bellman`, the principle of dynamic programming, from values alone and the generated Exp:

    T(x) = min over u of T(Exp_x(u)) + the cost of the geodesic there,    T(goal) = 0.

Its fixed point is the arrival time. A sweep asks at every point for the best of a fan of steps, of the step down the field's
own slope and of the geodesic to the goal itself, and solves the splats' weights to the answers by linear least squares; now
and then Gauss-Newton moves and reshapes them. It begins with the costs of the geodesics to the goal, which are upper bounds. What
a sweep gets wrong the next one builds on; so the last steps fit the costs of the paths that the field itself leads to the goal.
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import torch
from torch import Tensor

from rsrm_gen.trainer.fit import Fit, Schedule, Targets
from rsrm_gen.trainer.objectives.objective import Tell, random_numbers, width_bounds
from rsrm_gen.trainer.plan import plan, segments
from rsrm_gen.trainer.response import Arrival
from rsrm_gen.trainer.run import Arrays, new_arrival
from rsrm_gen.trainer.scene import Scene
from rsrm_gen.trainer.settings import BellmanTraining

RINGS = (1.0, 0.5)  # of the longest step: the lengths of the fan's steps
DIRECTIONS = 24  # of the fan in the plane
CHUNK = 4096  # points whose fans are looked at together
SHAPES_EVERY = 5  # sweeps between two iterations of Gauss-Newton
ROLLOUTS = 6  # the last part of the steps fits paths of the field: one in so many
ROLLOUTS_EVERY = 5  # of these steps have the same paths
STEP = 0.05  # of a descent


class Bellman:
    """The field, its points with their fans, and a sweep."""

    def __init__(self, scene: Scene, tell: Tell) -> None:
        """At step 0 and without splats: `begin`, or restore a checkpoint."""
        assert isinstance(scene.training, BellmanTraining)
        self.scene = scene
        self.settings = scene.training
        self.tell = tell
        self.step, self.steps = 0, scene.training.steps
        self.phase = "sweeps"
        self.arrival = new_arrival(scene, scene.training.capacity)
        self.x = self._points()
        self.ends = self._fan()
        self.costs = self._cost(self.ends)
        self.direct = self._cost(scene.goal.expand_as(self.x)[:, None])[:, 0]
        weight = (scene.law.free / scene.slowness(self.x)).square()
        schedule = Schedule(iterations=self.steps, bounds=width_bounds(scene.manifold, scene.training.splats, self.x))
        self.fit = Fit(self.arrival.field, Arrival(self.arrival), Targets(self.x, self.direct, weight), schedule)
        # The least cost of a path on which the field has led to the goal.
        self.paid = torch.full_like(self.direct, math.inf)

    def begin(self) -> None:
        """Splats that give the costs of the geodesics to the goal."""
        self.fit.place(self.settings.splats.count)

    def advance(self) -> float:
        """One sweep, or an iteration on the costs of the field's own paths: what the field was wrong by, RMS."""
        sweeps = self.steps - self.steps // ROLLOUTS
        if self.step < sweeps:
            self.phase = "sweeps"
            loss = self._sweep()
        else:
            self.phase = "paths"
            if (self.step - sweeps) % ROLLOUTS_EVERY == 0:
                self._pay()
            loss = self.fit.advance().free_rms
        self.step += 1
        return loss

    def _sweep(self) -> float:
        best = self._best()
        self.fit.revalue(best)
        loss = self.fit.errors()[1]
        if not math.isfinite(loss):
            raise FloatingPointError(f"the error of the principle is {loss}")
        self.fit.solve_amplitudes()
        if self.step % SHAPES_EVERY == SHAPES_EVERY - 1:
            self.fit.advance()
        return loss

    def _best(self) -> Tensor:
        """The least of: T after a step of the fan and the step's cost; the same down the slope; the geodesic's cost. (N,)."""
        after = torch.cat(
            [self._time(part.flatten(0, 1)).view(part.shape[:2]) for part in torch.split(self.ends, CHUNK)]
        )
        best = torch.minimum((self.costs + after).amin(1), self.direct)
        slope = self.arrival.evaluate(self.x)[1]
        M = self.scene.manifold
        length = M.norm(self.x, slope)[:, None]
        step = self.settings.reach / 2 / torch.where(length > 0, length, math.inf)
        down = self.scene.into_domain(M.exp(self.x, -step * slope))
        return torch.minimum(best, self._cost(down[:, None])[:, 0] + self._time(down))

    def _time(self, x: Tensor) -> Tensor:
        """T (N,) at x (N, D), without its gradient."""
        return self.fit.response.value(self.fit.response.at(x), self.fit.values(x))

    def _pay(self) -> None:
        """Fit what the paths cost on which the field leads to the goal, and the principle's answer where it does not."""
        self.tell("paths of the field", 0.0)
        paths = plan(self.arrival, self.scene, self.x, STEP)
        self.paid = torch.minimum(self.paid, torch.minimum(paths.cost, self.direct))
        self.fit.revalue(torch.where(self.paid.isfinite() & paths.reached, self.paid, self._best()))

    def final_loss(self) -> float:
        """The RMS error of the principle at the points, those deep in obstacles left out."""
        self.fit.revalue(self._best())
        return self.fit.errors()[1]

    def arrays(self) -> Arrays:
        """The splats, the damping, the values aimed at; points and fans follow from the seed."""
        return {
            **self.fit.arrays(),
            "step": np.array(self.step),
            "value": self.fit.targets.value.numpy(),
            "paid": self.paid.numpy(),
        }

    def restore(self, arrays: Arrays, path: Path) -> None:
        """Go back to what `arrays` gave; it was read from `path`."""
        self.fit.restore(arrays, path)
        self.fit.revalue(torch.from_numpy(arrays["value"]))
        self.paid = torch.from_numpy(arrays["paid"])
        self.step = int(arrays["step"])

    def _points(self) -> Tensor:
        x = self.scene.sample(self.settings.points, random_numbers(self.settings.seed, 0))
        return x[self.scene.manifold.distance(x, self.scene.goal.expand_as(x)) > 0]

    def _fan(self) -> Tensor:
        """Where the fixed steps from each point end, within the domain: (N, U, D)."""
        x, M = self.x, self.scene.manifold
        directions = fan(M.dim, random_numbers(self.settings.seed, 1)).to(x.dtype)
        steps = torch.cat([ring * self.settings.reach * directions for ring in RINGS])
        return self.scene.into_domain(M.exp(x[:, None], torch.einsum("ud,ndt->nut", steps, M.frame(x))))

    def _cost(self, ends: Tensor) -> Tensor:
        """The costs (N, U) of the geodesics from the points to ends (N, U, D)."""
        return segments(self.scene, self.x[:, None].expand_as(ends), ends).cost


def fan(dim: int, generator: torch.Generator) -> Tensor:
    """Unit vectors (U, d) in many directions: equally spaced in the plane, else the axes of random frames."""
    if dim == 2:
        angle = 2 * math.pi / DIRECTIONS * torch.arange(DIRECTIONS, dtype=torch.float64)
        return torch.stack([angle.cos(), angle.sin()], 1)
    frames = torch.randn(1 if dim == 1 else 2 * dim, dim, dim, generator=generator, dtype=torch.float64)
    axes = torch.linalg.qr(frames)[0].flatten(0, 1)
    return torch.cat([axes, -axes])
