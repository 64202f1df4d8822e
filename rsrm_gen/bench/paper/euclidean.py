"""Splats in the plane, where curvature plays no part: the regression case of the authors of splat regression models.

f(x, y) = sin(3 pi sqrt x) cos(3 pi y) on the unit square from 1000 uniform samples with noise of deviation 0.01, tested at 200
others as noisy: their released experiment, with its recipe (A = 0.1 I, uniform centres, no weights at first; Adam, 20 000
steps of all samples, rate 1e-4). Their paper shows its results as curves alone, so no figure of theirs stands beside ours:
what says how good a fit is, is the noise, a mean square of 1e-4 that no model goes below at the test points.
"""

from __future__ import annotations

import json
import math
import time
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

import torch
from torch import Generator, Tensor

from rsrm_gen.bench.paper.rows import Spread, spread
from rsrm_gen.bench.table import Table
from rsrm_gen.errors import UserError
from rsrm_gen.files import write_text_whole
from rsrm_gen.load import load
from rsrm_gen.trainer.model import SplatField
from rsrm_gen.trainer.optimise import AdamW

SAMPLES, TESTS, NOISE = 1000, 200, 0.01
STEPS, RATE, SHAPE = 20_000, 1e-4, 0.1
DENSE = 10_000  # points without noise, for the error against f itself
COUNTS, QUICK_COUNTS, QUICK_STEPS = (10, 50, 100, 200), (50,), 2000
SEEDS = (1, 2, 3, 4, 5)


@dataclass(frozen=True)
class Data:
    """What is learnt from and what is tested on: points (N, 2) and values (N,)."""

    x: Tensor
    value: Tensor
    test_x: Tensor
    test_value: Tensor
    dense_x: Tensor
    dense_value: Tensor


@dataclass(frozen=True)
class PlaneRow:
    """What one fit gave."""

    count: int  # splats
    seed: int
    steps: int
    parameters: int
    test_error: float  # mean square, at noisy test points
    rms: float  # against f itself, at many points
    seconds: float


def target(x: Tensor) -> Tensor:
    """f (N,) at x (N, 2)."""
    return torch.sin(3 * math.pi * x[:, 0].sqrt()) * torch.cos(3 * math.pi * x[:, 1])


def data(seed: int) -> Data:
    """Fresh samples."""
    generator = Generator().manual_seed(seed)

    def noisy(count: int, noise: float) -> tuple[Tensor, Tensor]:
        x = torch.rand(count, 2, generator=generator, dtype=torch.float64)
        return x, target(x) + noise * torch.randn(count, generator=generator, dtype=torch.float64)

    return Data(*noisy(SAMPLES, NOISE), *noisy(TESTS, NOISE), *noisy(DENSE, 0.0))


def fitted(count: int, seed: int, steps: int) -> PlaneRow:
    """Fit so many splats by the authors' recipe."""
    given, plane = data(seed), load("euclidean", n=2)
    field = SplatField(plane, count, torch.float64)
    field.append(torch.rand(count, 2, generator=Generator().manual_seed(seed + 1000), dtype=torch.float64), SHAPE)
    adam, start = AdamW(field, weight_decay=0.0, gradient_clip=math.inf), time.perf_counter()
    for _ in range(steps):
        adam.step(_gradient(field, given), RATE)
    seconds = time.perf_counter() - start
    test, dense = (field.value_and_gradient(x)[0] for x in (given.test_x, given.dense_x))
    return PlaneRow(
        count=count,
        seed=seed,
        steps=steps,
        parameters=field.parameter_count,
        test_error=float((test - given.test_value).square().mean()),
        rms=float((dense - given.dense_value).square().mean().sqrt()),
        seconds=round(seconds, 3),
    )


def _gradient(field: SplatField, given: Data) -> Tensor:
    """Of the mean square error, in all that a splat has."""
    splats = field.splats()
    inputs = [t.detach().requires_grad_() for t in splats.inputs()]
    f, _ = field.manifold.splats(given.x, *inputs)
    bars = torch.autograd.grad(f, inputs, 2 * (f.detach() - given.value) / len(given.value))
    return field.gradient(splats, *bars)


@dataclass(frozen=True)
class PlaneJob:
    """One fit, whose row is kept in OUT/euclidean."""

    output: Path
    count: int
    seed: int
    steps: int

    @property
    def file(self) -> Path:
        """Where its row is."""
        return self.output / "euclidean" / f"{self.count}-{self.seed}.json"

    def kept(self) -> PlaneRow | None:
        """The row of an earlier run, where it is of as many steps."""
        if not self.file.exists():
            return None
        row = _read(self.file)
        return row if row.steps == self.steps else None

    def made(self) -> PlaneRow:
        """Fit, and keep the row."""
        row = fitted(self.count, self.seed, self.steps)
        write_text_whole(self.file, json.dumps(asdict(row), indent=1) + "\n")
        return row


def plane_jobs(output: Path, seeds: Sequence[int], quick: bool) -> list[PlaneJob]:
    """Every number of splats with every seed; of no `seeds` all, but one when quick."""
    seeds = seeds or (SEEDS[:1] if quick else SEEDS)
    counts, steps = (QUICK_COUNTS, QUICK_STEPS) if quick else (COUNTS, STEPS)
    return [PlaneJob(output, count, seed, steps) for count in counts for seed in seeds]


def collected_plane(output: Path) -> list[PlaneRow]:
    """Every row in the folder of a benchmark."""
    rows = [_read(path) for path in (output / "euclidean").glob("*.json")]
    return sorted(rows, key=lambda row: (row.count, row.seed))


def _read(path: Path) -> PlaneRow:
    try:
        return PlaneRow(**json.loads(path.read_text(encoding="utf-8")))
    except (OSError, ValueError, TypeError) as error:
        raise UserError(f"{path} is no row of this benchmark: {error}", hint="remove it to fit again") from None


def plane_table(rows: Iterable[PlaneRow]) -> Table:
    """Mean and deviation over the seeds, for each number of splats."""
    by_count: dict[int, list[PlaneRow]] = {}
    for row in rows:
        by_count.setdefault(row.count, []).append(row)
    cells = []
    for count, members in sorted(by_count.items()):
        found: list[Spread | None] = [
            spread(row.test_error for row in members),
            spread(row.rms for row in members),
            spread(row.seconds for row in members),
        ]
        cells.append((f"{count} splats", str(members[0].parameters), str(members[0].steps), *map(str, found)))
    noise = f"{NOISE**2:g}"
    headings = (
        "Euclidean plane",
        "parameters",
        "steps",
        f"test mean square (noise: {noise})",
        "RMS of f itself",
        "training s",
    )
    return Table("sin(3 pi sqrt x) cos(3 pi y) from 1000 noisy samples", headings, tuple(cells))
