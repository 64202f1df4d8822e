"""The training loop: fresh points, one backward pass, a step, now and then other splats; kept so that it can go on.

A training that was interrupted goes on exactly as if it had not been: the splats, the moments and the step are kept, and
what random numbers are drawn at a step follows from the seed and the step alone.
"""

from __future__ import annotations

import math
import signal
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from types import FrameType
from typing import Literal, get_args

import numpy as np
import torch
from torch import Tensor

from rsrm_gen.errors import UserError
from rsrm_gen.manifold import not_finite
from rsrm_gen.trainer.arithmetic import Points
from rsrm_gen.trainer.clock import NO_CLOCK, Clock
from rsrm_gen.trainer.density import make_density, pick_apart, pick_spread
from rsrm_gen.trainer.objective import Eikonal
from rsrm_gen.trainer.optimise import AdamW
from rsrm_gen.trainer.run import Arrays, Metric, RunFolder, Summary, fill_rows, new_arrival
from rsrm_gen.trainer.scene import Scene
from rsrm_gen.trainer.threads import one_thread

BLOCK = 16  # steps whose points are drawn together
RECORD_EVERY = 10  # steps between two lines of metrics
POOL = 4096  # points at which the residual is looked at for new splats
FINAL_POINTS = 16384  # points of the final loss

Progress = Callable[[Metric], None]
Purpose = Literal["points", "splats", "final loss"]
PURPOSES = get_args(Purpose)


@dataclass(frozen=True)
class Outcome:
    """How a training ended: `summary` is None when it was interrupted after `step` steps."""

    step: int
    splats: int
    summary: Summary | None


class Trainer:
    """All that changes during a training, and one step of it."""

    def __init__(self, scene: Scene, clock: Clock = NO_CLOCK) -> None:
        """At step 0 and without splats: place the first ones, or restore a checkpoint."""
        settings = scene.training
        self.scene = scene
        self.settings = settings
        self.arrival = new_arrival(scene, settings.capacity)
        self.field = self.arrival.field
        self.objective = Eikonal(scene, settings.objective.residual)
        self.density = make_density(settings)
        self.adam = AdamW(self.field, settings.weight_decay, settings.gradient_clip)
        self.clock = clock
        self.step = 0
        self._points: list[Points] = []  # of the steps to come in this block

    def place_first_splats(self) -> None:
        """Well spread over the domain."""
        count = self.settings.splats.initial
        candidates = self.scene.sample(8 * count, self.generator("splats"))
        self.field.append(pick_spread(self.scene.manifold, candidates, count), self.settings.splats.shape)

    def advance(self) -> float:
        """One step: its loss. A loss or gradient that is not finite is a `FloatingPointError`, and nothing moved."""
        if not self._points:
            self._points = self._block()
        loss, gradient = self.objective.loss_and_gradient(self.arrival, self._points[0], self.clock)
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
            points = self.objective.at_each(self.arrival, x, BLOCK, self.settings.goal_exclusion)
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
        residual = self.objective.loss(self.arrival, x)[1]
        return pick_apart(self.scene.manifold, x, residual, count, self.settings.splats.shape / 2)

    def learning_rate(self) -> float:
        """Of the step to come: constant, or a half cosine down to the final one."""
        first, final = self.settings.learning_rate, self.settings.final_learning_rate
        if final is None:
            return first
        return final + (first - final) * (1 + math.cos(math.pi * self.step / self.settings.steps)) / 2

    def final_loss(self) -> float:
        """The mean residual at many fresh points."""
        x = self.points(FINAL_POINTS, "final loss")
        return float(torch.cat([self.objective.loss(self.arrival, part)[1] for part in torch.split(x, POOL)]).mean())

    def arrays(self, seconds: float) -> Arrays:
        """Everything that changes, as plain arrays: active rows only."""
        buffers = {**self.field.buffers_of_splats(), **self.adam.buffers_of_splats()}
        arrays: Arrays = {name: rows[: self.field.count].numpy() for name, rows in buffers.items()}
        return {**arrays, "step": np.array(self.step), "seconds": np.array(seconds)}

    def restore(self, arrays: Arrays, folder: RunFolder) -> None:
        """Go back to what `arrays` gave."""
        buffers = {**self.field.buffers_of_splats(), **self.adam.buffers_of_splats()}
        self.field.count = fill_rows(buffers, arrays, folder.checkpoint)
        self.step = int(arrays["step"])
        self._points = []


def train(
    scene: Scene,
    folder: RunFolder,
    resume: bool = False,
    progress: Progress = lambda metric: None,
    clock: Clock = NO_CLOCK,
) -> Outcome:
    """Train a scene's field into a run folder that `create` has made; `resume` goes on from its checkpoint.

    Ctrl-C ends the training after the step it is in, with a checkpoint; `progress` is called after every step.
    """
    trainer, before = Trainer(scene, clock), 0.0
    if resume:
        arrays = folder.restore()
        trainer.restore(arrays, folder)
        before = float(arrays["seconds"])
        folder.drop_metrics_after(trainer.step)
        folder.forget_results()  # of a training that is now made longer
    else:
        trainer.place_first_splats()
    start = time.perf_counter() - before
    with _ctrl_c_noted() as stopped:
        while trainer.step < scene.training.steps and not stopped.is_set():
            loss = _advance(trainer, folder)
            metric = Metric(trainer.step, loss, trainer.field.count, round(time.perf_counter() - start, 3))
            _keep(trainer, folder, metric)
            progress(metric)
            clock.lap("logging")
            clock.step()
    seconds = time.perf_counter() - start
    folder.save(trainer.arrays(seconds))
    return Outcome(trainer.step, trainer.field.count, _finish(trainer, folder, seconds))


def _advance(trainer: Trainer, folder: RunFolder) -> float:
    try:
        return trainer.advance()
    except FloatingPointError as error:
        kept = f"the checkpoint in {folder.path} is from before" if folder.checkpoint.exists() else "nothing was kept"
        message = f"step {trainer.step + 1}: {error}; {kept}"
        raise UserError(message, hint="try a smaller learning_rate, or dtype: float64") from None


def _keep(trainer: Trainer, folder: RunFolder, metric: Metric) -> None:
    last = metric.step == trainer.settings.steps
    if metric.step % RECORD_EVERY == 0 or last:
        folder.record(metric)
    if metric.step % trainer.settings.checkpoint_every == 0 and not last:
        folder.save(trainer.arrays(metric.seconds))


def _finish(trainer: Trainer, folder: RunFolder, seconds: float) -> Summary | None:
    steps = trainer.settings.steps
    if trainer.step < steps:
        return None
    summary = Summary(
        loss=trainer.final_loss(),
        steps=trainer.step,
        splats=trainer.field.count,
        parameters=trainer.field.parameter_count,
        ms_per_step=round(1000 * seconds / trainer.step, 3),
        seconds=round(seconds, 3),
    )
    folder.write_summary(summary)
    return summary


@contextmanager
def _ctrl_c_noted() -> Iterator[threading.Event]:
    """Ctrl-C sets an event instead of tearing a step apart; a second one interrupts as usual."""
    stopped = threading.Event()

    def note(signum: int, frame: FrameType | None) -> None:
        stopped.set()
        signal.signal(signal.SIGINT, before)

    if threading.current_thread() is not threading.main_thread():
        yield stopped  # only the main thread may set handlers
        return
    before = signal.signal(signal.SIGINT, note)
    try:
        yield stopped
    finally:
        signal.signal(signal.SIGINT, before)
