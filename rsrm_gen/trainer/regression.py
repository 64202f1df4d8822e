"""Learn any function on a manifold from samples: a sum of splats fitted to them, judged on samples that were kept back.

    samples, settings = read_samples(path, manifold), Regression(...)
    report = regress(samples, manifold, settings, folder)
    function = load_function("runs/mine"); function(x)

RUN/fit.json          which manifold, which samples (path and hash), every setting, the versions that ran
RUN/checkpoint.npz    the splats and all that is needed to go on
RUN/metrics.jsonl     one line an iteration
RUN/summary.json      written at the end: errors on the samples learnt from and on those kept back
"""

from __future__ import annotations

import hashlib
import json
import math
import time
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import Generator, Tensor

from rsrm_gen.errors import UserError
from rsrm_gen.files import write_text_whole
from rsrm_gen.load import load_in_rows
from rsrm_gen.manifold import Manifold
from rsrm_gen.trainer.fit import Fit, Schedule, Targets, shape_bounds
from rsrm_gen.trainer.gauss_newton import effective_count
from rsrm_gen.trainer.model import SplatField
from rsrm_gen.trainer.response import Affine
from rsrm_gen.trainer.run import Metric, RunFolder, fill_rows, versions
from rsrm_gen.trainer.samples import Samples, read_samples, spread
from rsrm_gen.trainer.train import Progress

MOST_SPLATS = 500  # by default
SAMPLES_A_NUMBER = 4  # by default there are so many samples for each number that is fitted


@dataclass(frozen=True)
class Regression:
    """What is to be learnt, and how."""

    manifold: str  # the name of a bundled one or the path of a manifold file
    data: str  # the path of the samples
    parameters: dict[str, str] = field(default_factory=dict)
    splats: int | None = None  # None: as many as the samples can tell apart
    iterations: int = 30
    held_out: float = 0.2  # the share of the samples that is kept back
    seed: int = 1
    dtype: str = "float32"

    def load(self) -> Manifold:
        """The manifold."""
        return load_in_rows(self.manifold, **self.parameters)


@dataclass(frozen=True)
class Report:
    """What came out: errors in the units of the values, on samples learnt from and on those kept back."""

    samples: int
    rms: float
    held_out: int
    held_out_rms: float | None  # None where nothing was kept back
    held_out_max: float | None
    r_squared: float | None  # 1 - squared error over variance, of those kept back
    splats: int
    parameters: int
    iterations: int
    seconds: float


@dataclass(frozen=True)
class Function:
    """A function that was learnt."""

    manifold: Manifold
    field: SplatField
    response: Affine

    @torch.no_grad()
    def __call__(self, x: Tensor) -> Tensor:
        """The values (N,) at points x (N, D)."""
        x = self.manifold.project(x.to(self.field.mu.dtype))
        known = self.response.at(x)
        return self.response.value(known, self.manifold.splats_value(x, *self.field.splats().inputs()))


def regress(
    samples: Samples,
    manifold: Manifold,
    settings: Regression,
    folder: RunFolder,
    resume: bool = False,
    progress: Progress = lambda metric: None,
) -> Report:
    """Fit splats to samples with values, into a run folder that `create` has made; `resume` goes on in one."""
    learnt, kept_back = _split(samples, settings)
    fit, response = _new_fit(learnt, manifold, settings)
    before = 0.0
    if resume:
        arrays = folder.restore()
        fit.restore(arrays, folder.checkpoint)
        before = float(arrays["seconds"])
        folder.drop_metrics_after(fit.iteration)
    else:
        fit.place(_splat_count(len(learnt.x), manifold, settings))
    start = time.perf_counter() - before
    while not fit.done:
        record = fit.advance()
        seconds = round(time.perf_counter() - start, 3)
        metric = Metric(record.iteration, record.rms, fit.field.count, seconds)
        scale = {"offset": np.array(response.offset), "scale": np.array(response.scale)}
        folder.save({**fit.arrays(), **scale, "step": np.array(fit.iteration), "seconds": np.array(seconds)})
        folder.record(metric)
        progress(metric)
    report = _report(fit, Function(manifold, fit.field, response), kept_back, time.perf_counter() - start)
    write_text_whole(folder.summary, json.dumps(asdict(report), indent=2) + "\n")
    return report


def create(folder: RunFolder, settings: Regression, manifold: Manifold, force: bool = False) -> None:
    """Make the run folder of a new fit; one that holds a checkpoint is only replaced by `force`."""
    folder.clear(force)
    kept = {
        "settings": asdict(settings),
        "content_hash": manifold.content_hash,
        "data_hash": _hash(Path(settings.data)),
        "versions": versions(),
    }
    write_text_whole(folder.path / "fit.json", json.dumps(kept, indent=2) + "\n")


def stored(folder: RunFolder, with_data: bool) -> tuple[Regression, Manifold]:
    """The settings and the manifold of a run folder; that the samples are still the same, if they are wanted."""
    file = folder.path / "fit.json"
    if not file.is_file():
        raise UserError(f"{folder.path} is not a fit's folder: it has no fit.json", hint="make one with `rsrm fit`")
    try:
        kept: dict[str, Any] = json.loads(file.read_text(encoding="utf-8"))
        settings = Regression(**kept["settings"])
        content_hash, data_hash = kept["content_hash"], kept["data_hash"]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise UserError(f"{file} cannot be read: {error}") from None
    manifold = settings.load()
    if manifold.content_hash != content_hash:
        hint = "bring the old manifold file back, or fit again with --force"
        raise UserError(f"`{manifold.name}` is not the manifold any more on which {folder.path} was fitted", hint=hint)
    if with_data and _hash(Path(settings.data)) != data_hash:
        hint = "bring the old samples back, or fit again with --force"
        raise UserError(f"{settings.data} is not what {folder.path} was fitted to any more", hint=hint)
    return settings, manifold


def load_function(path: Path) -> Function:
    """The function that a run folder of `rsrm fit` holds."""
    folder = RunFolder(path)
    settings, manifold = stored(folder, with_data=False)
    arrays = folder.restore()
    splats = SplatField(manifold, max(len(arrays.get("v", ())), 1), getattr(torch, settings.dtype))
    splats.count = fill_rows(splats.buffers_of_splats(), arrays, folder.checkpoint)
    return Function(manifold, splats, Affine(float(arrays["offset"]), float(arrays["scale"])))


def predict(run: Path, points: Path, output: Path) -> int:
    """Write the points of a file with the values of a fitted function as a table; how many."""
    function = load_function(run)
    samples = read_samples(points, function.manifold, points_only=True)
    value = function(samples.x).double()
    names = [f"x{i + 1}" for i in range(function.manifold.point_size)]
    rows = torch.cat([samples.x, value[:, None]], 1).tolist()
    lines = [",".join([*names, "value"]), *(",".join(f"{number:.9g}" for number in row) for row in rows)]
    write_text_whole(output, "\n".join(lines) + "\n")
    return len(rows)


def _hash(path: Path) -> str:
    try:
        return hashlib.sha256(path.read_bytes()).hexdigest()
    except OSError as error:
        raise UserError(f"cannot read {path}: {error.strerror}") from None


def _split(samples: Samples, settings: Regression) -> tuple[Targets, Targets]:
    """What is learnt from, and what is kept back: drawn by the seed."""
    assert samples.value is not None
    dtype = getattr(torch, settings.dtype)
    count = len(samples.x)
    order = torch.randperm(count, generator=Generator().manual_seed(settings.seed))
    back = round(settings.held_out * count)
    if count - back < 8:
        raise UserError(f"{settings.data} has {count} samples: too few to learn from")
    weight = torch.ones_like(samples.value) if samples.weight is None else samples.weight
    columns = [rows.to(dtype) for rows in (samples.x, samples.value, weight)]
    learnt, kept_back = (Targets(*(rows[part] for rows in columns)) for part in (order[back:], order[:back]))
    if not bool(learnt.weight.any()):
        raise UserError(f"{settings.data}: every weight is zero")
    return learnt, kept_back


def _new_fit(learnt: Targets, manifold: Manifold, settings: Regression) -> tuple[Fit, Affine]:
    """A fit without splats."""
    field = SplatField(manifold, _splat_count(len(learnt.x), manifold, settings), learnt.x.dtype)
    response = Affine(*spread(learnt.value.double(), learnt.weight.double()))
    moves = range(2, settings.iterations * 3 // 5 + 1, 2)
    schedule = Schedule(settings.iterations, dict.fromkeys(moves, 0.05), shape_bounds(manifold, learnt.x))
    return Fit(field, response, learnt, schedule), response


def _splat_count(samples: int, manifold: Manifold, settings: Regression) -> int:
    if settings.splats is not None:
        return min(settings.splats, samples)
    return max(1, min(MOST_SPLATS, samples // (SAMPLES_A_NUMBER * effective_count(manifold.dim))))


def _report(fit: Fit, function: Function, kept_back: Targets, seconds: float) -> Report:
    rms = largest = r_squared = None
    if len(kept_back.x) and bool(kept_back.weight.any()):
        weight, value = kept_back.weight.double(), kept_back.value.double()
        error = function(kept_back.x).double() - value
        square = float((weight * error.square()).sum() / weight.sum())
        rms, largest = math.sqrt(square), float(error.abs().max())
        r_squared = 1 - square / spread(value, weight)[1] ** 2
    return Report(
        samples=len(fit.targets.x),
        rms=fit.errors()[0],
        held_out=len(kept_back.x),
        held_out_rms=rms,
        held_out_max=largest,
        r_squared=r_squared,
        splats=fit.field.count,
        parameters=fit.field.parameter_count,
        iterations=fit.iteration,
        seconds=round(seconds, 3),
    )
