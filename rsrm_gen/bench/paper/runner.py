"""Trains and judges every job that is not finished yet; Ctrl-C keeps all that was made, and the next run goes on."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import torch
from rich.console import Console

from rsrm_gen.bench.paper.descent import NetworkDescent
from rsrm_gen.bench.paper.euclidean import PlaneJob, PlaneRow
from rsrm_gen.bench.paper.jobs import Job, scene_files
from rsrm_gen.bench.paper.judge import judged
from rsrm_gen.bench.paper.methods import BY_KEY
from rsrm_gen.bench.paper.rows import Row
from rsrm_gen.bench.quiet import busy_cores
from rsrm_gen.errors import UserError
from rsrm_gen.trainer.clock import Clock
from rsrm_gen.trainer.objectives import Objective, Tell, make_objective
from rsrm_gen.trainer.run import Metric, Summary
from rsrm_gen.trainer.scene import Scene
from rsrm_gen.trainer.train import Progress, train

Say = Callable[[str], None]
PAUSE = 10  # seconds, at least, between two reports of a training


@dataclass(frozen=True)
class Result:
    """What there is after a run of the benchmark."""

    rows: tuple[Row, ...]
    plane: tuple[PlaneRow, ...] = ()
    failures: tuple[str, ...] = ()  # jobs that could not be trained, and why
    missing: int = 0  # jobs that are not finished
    interrupted: bool = False


def selected(
    output: Path,
    scenes: Path | None,
    methods: Sequence[str],
    manifolds: Sequence[str],
    seeds: Sequence[int],
    quick: bool,
) -> list[Job]:
    """The jobs that are asked for, scene by scene; none of `manifolds` or `seeds` means all, but one seed when quick."""
    files = scene_files(scenes, manifolds, seeds)
    if quick and not seeds:  # they come sorted
        files = list({file.manifold: file for file in reversed(files)}.values())[::-1]
    return [Job(BY_KEY[key], file, output, quick) for file in files for key in methods]


def finished(jobs: Sequence[Job], plane: Sequence[PlaneJob] = ()) -> Result:
    """What earlier runs have left; nothing is trained."""
    rows = tuple(row for job in jobs if (row := job.kept()))
    fits = tuple(fit for job in plane if (fit := job.kept()))
    return Result(rows, fits, missing=len(jobs) + len(plane) - len(rows) - len(fits))


def run(jobs: Sequence[Job], say: Say, console: Console | None = None, plane: Sequence[PlaneJob] = ()) -> Result:
    """Do what is not done, in order; Ctrl-C ends it, and what was done is kept."""
    failures: dict[str, str] = {}
    interrupted = False
    try:
        for number, job in enumerate(jobs, 1):
            _do(job, partial(_say_of, say, f"{job.name} ({number} of {len(jobs)})"), failures, console)
        for fit in plane:
            if not fit.kept():
                say(f"{fit.count} splats in the Euclidean plane by {fit.method}, seed {fit.seed}")
                fit.made()
    except KeyboardInterrupt:
        interrupted = True
    # What an older run has left of a job that failed now is not its result.
    done = [job for job in jobs if job.name not in failures]
    found = finished(done, plane)
    words = tuple(f"{name}: {why}" for name, why in failures.items())
    return replace(found, failures=words, missing=found.missing + len(failures), interrupted=interrupted)


def _do(job: Job, say: Say, failures: dict[str, str], console: Console | None) -> None:
    try:
        if not job.finished():
            _make(job, say, console)
    except UserError as error:
        failures[job.name] = error.message
        say(error.message)


def _say_of(say: Say, label: str, words: str) -> None:
    say(f"{label}: {words}")


def _make(job: Job, say: Say, console: Console | None) -> None:
    """Train, or go on training, then judge; `KeyboardInterrupt` when the training ended before its time."""
    others = busy_cores()
    summary = _trained(job, say)
    if summary is None:
        raise KeyboardInterrupt
    say("judged")
    job.keep(judged(job, summary, others, console))


def _trained(job: Job, say: Say) -> Summary | None:
    scene, folder = job.scene, job.folder
    if scene.training.threads:
        torch.set_num_threads(scene.training.threads)
    asked = job.is_asked_for()
    if asked and (summary := folder.read_summary()):
        return summary
    resume = asked and folder.checkpoint.exists()
    if not resume:
        job.row_file.unlink(missing_ok=True)
        folder.create(scene, force=True)
        job.note_asked()
    say("trained further" if resume else "trained")
    seldom = _seldom(say)
    return train(scene, folder, resume, _progress(seldom), _tell(seldom), make=_objective_of(job)).summary


def _objective_of(job: Job) -> Callable[[Scene, Clock, Tell], Objective]:
    shape = job.network
    if shape is None:
        return make_objective
    return lambda scene, clock, tell: NetworkDescent(scene, shape, clock)


def _seldom(say: Say) -> Say:
    """Says what it is told when there was a pause before."""
    last = time.monotonic()

    def now_and_then(words: str) -> None:
        nonlocal last
        if time.monotonic() > last + PAUSE:
            last = time.monotonic()
            say(words)

    return now_and_then


def _progress(say: Say) -> Progress:
    def update(metric: Metric) -> None:
        say(f"step {metric.step}, {metric.phase}, loss {metric.loss:.4g}, {metric.seconds:.0f} s")

    return update


def _tell(say: Say) -> Tell:
    return lambda what, part: say(f"{what}, {100 * part:.0f} %")
