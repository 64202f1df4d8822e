"""The training loop: steps of an objective, kept so that they can go on.

A training that was interrupted goes on exactly as if it had not been: an objective gives everything that changes as arrays.
"""

from __future__ import annotations

import signal
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from types import FrameType

import numpy as np

from rsrm_gen.errors import UserError
from rsrm_gen.trainer.clock import NO_CLOCK, Clock
from rsrm_gen.trainer.objectives import Objective, Tell, make_objective
from rsrm_gen.trainer.run import Metric, RunFolder, Summary
from rsrm_gen.trainer.scene import Scene

RECORD_EVERY = 10  # steps between two lines of metrics

Progress = Callable[[Metric], None]
MakeObjective = Callable[[Scene, Clock, Tell], Objective]


@dataclass(frozen=True)
class Outcome:
    """How a training ended: `summary` is None when it was interrupted after `step` steps."""

    step: int
    splats: int
    summary: Summary | None


class _InterruptedError(Exception):
    """Ctrl-C in the middle of a long step, of which nothing is kept."""


def train(
    scene: Scene,
    folder: RunFolder,
    resume: bool = False,
    progress: Progress = lambda metric: None,
    tell: Tell = lambda what, part: None,
    clock: Clock = NO_CLOCK,
    make: MakeObjective = make_objective,
) -> Outcome:
    """Train a scene's field into a run folder that `create` has made; `resume` goes on from its checkpoint.

    `progress` is called after every step, `tell` within long ones. Ctrl-C ends the training after the step it is in, or, where
    that step is a long one, before it; with a checkpoint. `make` gives another objective than the one that the settings name.
    """
    with _ctrl_c_noted() as stopped:

        def tell_or_stop(what: str, part: float) -> None:
            if stopped.is_set():
                raise _InterruptedError
            tell(what, part)

        objective, before = make(scene, clock, tell_or_stop), 0.0
        if resume:
            arrays = folder.restore()
            objective.restore(arrays, folder.checkpoint)
            before = float(arrays["seconds"])
            folder.drop_metrics_after(objective.step)
            folder.forget_results()  # of a training that is now made longer
        else:
            objective.begin()
        start = time.perf_counter() - before
        while objective.step < objective.steps and not stopped.is_set():
            try:
                loss = _advance(objective, folder)
            except _InterruptedError:
                break
            splats, seconds = objective.arrival.field.count, round(time.perf_counter() - start, 3)
            metric = Metric(objective.step, loss, splats, seconds, objective.phase)
            _keep(objective, scene, folder, metric)
            progress(metric)
            clock.lap("logging")
            clock.step()
    seconds = time.perf_counter() - start
    _save(objective, folder, seconds)
    return Outcome(objective.step, objective.arrival.field.count, _finish(objective, folder, seconds))


def _advance(objective: Objective, folder: RunFolder) -> float:
    try:
        return objective.advance()
    except FloatingPointError as error:
        kept = f"the checkpoint in {folder.path} is from before" if folder.checkpoint.exists() else "nothing was kept"
        message = f"step {objective.step + 1}: {error}; {kept}"
        raise UserError(message, hint="try a smaller learning_rate, or dtype: float64") from None


def _keep(objective: Objective, scene: Scene, folder: RunFolder, metric: Metric) -> None:
    last = metric.step == objective.steps
    if metric.step % min(RECORD_EVERY, scene.training.checkpoint_every) == 0 or last:
        folder.record(metric)
    if metric.step % scene.training.checkpoint_every == 0 and not last:
        _save(objective, folder, metric.seconds)


def _save(objective: Objective, folder: RunFolder, seconds: float) -> None:
    folder.save({**objective.arrays(), "seconds": np.array(seconds)})


def _finish(objective: Objective, folder: RunFolder, seconds: float) -> Summary | None:
    if objective.step < objective.steps:
        return None
    field = objective.arrival.field
    summary = Summary(
        loss=objective.final_loss(),
        steps=objective.step,
        splats=field.count,
        parameters=field.parameter_count,
        ms_per_step=round(1000 * seconds / objective.step, 3),
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
