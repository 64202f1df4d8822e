"""The run folder: what a training was given and what it made, each file written whole or not at all.

RUN/scene.yaml       the scene as given (a relative path of the manifold rewritten to lead there from RUN)
RUN/settings.json    every training setting as resolved, and the versions that ran
RUN/checkpoint.npz   all that is needed to go on, as plain arrays
RUN/metrics.jsonl    one line every few steps: step, loss, splats, seconds, phase
RUN/summary.json     written at the end: loss, steps, splats, stored parameters, ms per step, seconds
"""

from __future__ import annotations

import json
import os
import platform
import zipfile
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import torch
from pydantic import ValidationError

import rsrm_gen
from rsrm_gen.errors import UserError
from rsrm_gen.files import write_text_whole, write_whole
from rsrm_gen.manifold import Manifold
from rsrm_gen.trainer.base import Distance, smooth_base
from rsrm_gen.trainer.link import make_link
from rsrm_gen.trainer.model import ArrivalTime, SplatField
from rsrm_gen.trainer.scene import Scene, read_scene
from rsrm_gen.trainer.settings import BasedLink, training_of

Arrays = dict[str, npt.NDArray[Any]]


@dataclass(frozen=True)
class Metric:
    """One line of metrics.jsonl; the loss is that of this step's points, the seconds are those of training so far."""

    step: int
    loss: float
    splats: int
    seconds: float
    phase: str = "descent"


@dataclass(frozen=True)
class Summary:
    """What came out of a training; the loss is that of the final field at many fresh points."""

    loss: float
    steps: int
    splats: int
    parameters: int
    ms_per_step: float
    seconds: float


@dataclass(frozen=True)
class Run:
    """A trained field with its scene."""

    path: Path
    scene: Scene
    arrival: ArrivalTime
    step: int  # of the checkpoint
    summary: Summary | None  # None while the training is not finished


class RunFolder:
    """Reads and writes the files of one run."""

    def __init__(self, path: Path) -> None:
        """The folder need not exist yet."""
        self.path = path
        self.checkpoint = path / "checkpoint.npz"
        self.metrics = path / "metrics.jsonl"
        self.summary = path / "summary.json"

    def create(self, scene: Scene, force: bool = False) -> None:
        """Make the folder for a new training; one that holds a checkpoint is only replaced by `force`."""
        self.clear(force)
        write_text_whole(self.path / "scene.yaml", _scene_text(scene, self.path))
        self.write_settings(scene)

    def clear(self, force: bool) -> None:
        """Make the folder, without a checkpoint, metrics and results; one that holds a checkpoint only by `force`."""
        if self.checkpoint.exists() and not force:
            hint = f"go on with `--resume {self.path}`, write elsewhere with `-o`, or replace it with `--force`"
            raise UserError(f"{self.path} already holds a training", hint=hint)
        try:
            self.path.mkdir(parents=True, exist_ok=True)
            self.checkpoint.unlink(missing_ok=True)
            self.forget_results()
            self.metrics.write_text("")
        except OSError as error:
            raise UserError(f"cannot write to {self.path}: {error.strerror}") from None

    def forget_results(self) -> None:
        """Remove what was said and drawn of a field that is about to change."""
        for name in ("summary.json", "evaluation.json", "field.png", "field.pdf", "report.html"):
            (self.path / name).unlink(missing_ok=True)

    def write_settings(self, scene: Scene) -> None:
        """Keep the resolved settings and the versions that run."""
        settings = {
            "manifold": scene.manifold.name,
            "content_hash": scene.manifold.content_hash,
            "training": scene.training.model_dump(mode="json"),
            "versions": versions(),
        }
        write_text_whole(self.path / "settings.json", json.dumps(settings, indent=2) + "\n")

    def read_scene(self, manifold: Manifold | None = None) -> Scene:
        """The scene of the run with the settings it is trained with."""
        if not (self.path / "scene.yaml").is_file():
            raise UserError(f"{self.path} is not a run folder: it has no scene.yaml", hint="make one with `rsrm train`")
        scene = read_scene(self.path / "scene.yaml", manifold)
        try:
            settings = json.loads((self.path / "settings.json").read_text(encoding="utf-8"))
            trained_on = settings["content_hash"]
            prepared = replace(scene, training=training_of(settings["training"]))
        except (OSError, ValueError, KeyError, TypeError, ValidationError) as error:
            raise UserError(f"{self.path / 'settings.json'} cannot be read: {_first_line(error)}") from None
        if trained_on != scene.manifold.content_hash:
            raise UserError(
                f"`{scene.manifold.name}` is not the manifold any more on which {self.path} was trained",
                scene.manifold_span,
                "bring the old manifold file back, or train again with --force",
            )
        return prepared

    def save(self, arrays: Arrays) -> None:
        """Write the checkpoint; whoever reads meanwhile sees the old one or the new one."""
        write_whole(self.checkpoint, lambda file: np.savez(file, allow_pickle=False, **arrays))

    def restore(self) -> Arrays:
        """Read the checkpoint."""
        if not self.checkpoint.is_file():
            raise UserError(f"{self.path} holds no checkpoint", hint="train it with `rsrm train`")
        try:
            with self.checkpoint.open("rb") as raw, np.load(raw, allow_pickle=False) as file:
                return {name: file[name] for name in file.files}
        except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile) as error:
            raise UserError(f"{self.checkpoint} cannot be read: {_first_line(error)}") from None

    def record(self, metric: Metric) -> None:
        """Append a line to the metrics."""
        try:
            with self.metrics.open("a") as file:
                file.write(json.dumps(asdict(metric)) + "\n")
        except OSError as error:
            raise UserError(f"cannot write to {self.metrics}: {error.strerror}") from None

    def read_metrics(self) -> list[Metric]:
        """All lines of the metrics; one that was cut off in the writing is left out."""
        metrics = []
        for line in self.metrics.read_text().splitlines() if self.metrics.exists() else []:
            try:
                metrics.append(Metric(**json.loads(line)))
            except (ValueError, TypeError):
                continue
        return metrics

    def drop_metrics_after(self, step: int) -> None:
        """Forget what was recorded past the checkpoint: those steps are made again."""
        kept = [metric for metric in self.read_metrics() if metric.step <= step]
        write_text_whole(self.path / "metrics.jsonl", "".join(json.dumps(asdict(metric)) + "\n" for metric in kept))

    def write_summary(self, summary: Summary) -> None:
        """Say what came out."""
        write_text_whole(self.path / "summary.json", json.dumps(asdict(summary), indent=2) + "\n")

    def read_summary(self) -> Summary | None:
        """What came out; None when the training is not finished."""
        if not self.summary.exists():
            return None
        try:
            return Summary(**json.loads(self.summary.read_text()))
        except (OSError, ValueError, TypeError) as error:
            raise UserError(f"{self.summary} cannot be read: {_first_line(error)}") from None


def new_arrival(scene: Scene, capacity: int) -> ArrivalTime:
    """The arrival time of a scene with no splats yet."""
    field = SplatField(scene.manifold, capacity, scene.goal.dtype)
    link = scene.training.link
    smooth = isinstance(link, BasedLink) and link.base == "smooth"
    base = smooth_base(scene.manifold, scene.goal) if smooth else Distance(scene.manifold, scene.goal)
    return ArrivalTime(field, make_link(link), scene.manifold, scene.goal, base)


def versions() -> dict[str, str]:
    """Of what runs."""
    return {
        "rsrm-gen": rsrm_gen.__version__,
        "torch": str(torch.__version__),
        "numpy": np.__version__,
        "python": platform.python_version(),
    }


def first_rows(buffers: dict[str, torch.Tensor], count: int) -> Arrays:
    """Copies of so many rows at the front of buffers, for a checkpoint."""
    return {name: rows[:count].numpy().copy() for name, rows in buffers.items()}


def fill_rows(buffers: dict[str, torch.Tensor], arrays: Arrays, path: Path) -> int:
    """Copy a checkpoint's rows to the front of the buffers of the same names; how many rows there are."""
    count = len(arrays.get("v", ()))
    for name, rows in buffers.items():
        stored = arrays.get(name)
        if stored is None or stored.shape != (count, *rows.shape[1:]) or count > len(rows):
            raise UserError(f"{path} does not fit the scene beside it: `{name}` has another shape")
        rows[:count] = torch.from_numpy(stored)
    return count


def load_run(path: Path, manifold: Manifold | None = None) -> Run:
    """The scene and the field of a run folder; `manifold` stands in for the one its scene names."""
    folder = RunFolder(path)
    scene = folder.read_scene(manifold)
    arrays = folder.restore()
    arrival = new_arrival(scene, max(len(arrays.get("v", ())), 1))
    arrival.field.count = fill_rows(arrival.field.buffers_of_splats(), arrays, folder.checkpoint)
    return Run(path, scene, arrival, int(arrays["step"]), folder.read_summary())


def _scene_text(scene: Scene, folder: Path) -> str:
    """The scene file's text, with a relative path to the manifold's file rewritten to lead there from the folder."""
    text, choice = scene.source.text, scene.manifold_choice
    if not choice.is_path or Path(choice.spec).is_absolute():
        return text
    span = scene.manifold_span
    leads = os.path.relpath(Path(scene.source.name).parent / choice.spec, folder)
    lines = text.splitlines(keepends=True)
    line = lines[span.line - 1]
    lines[span.line - 1] = line[: span.column - 1] + leads + line[span.column - 1 + span.length :]
    return "".join(lines)


def _first_line(error: Exception) -> str:
    return (str(error).splitlines() or [type(error).__name__])[0]
