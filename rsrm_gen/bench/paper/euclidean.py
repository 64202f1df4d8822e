"""Splats in the plane, where curvature plays no part: the regression case of the authors of splat regression models.

f(x, y) = sin(3 pi sqrt x) cos(3 pi y) on the unit square from 1000 uniform samples with noise of deviation 0.01, tested at 200
others as noisy: their released experiment, with its recipe (A = 0.1 I, uniform centres, no weights at first; Adam, 20 000
steps of all samples, rate 1e-4), and beside it our fit by Gauss-Newton. No figure of theirs stands beside ours, because their
results are not known here in numbers: what says how good a fit is, is the noise, a mean square of 1e-4. A model that is
below it at the samples begins to learn them by heart; near x = 0, where f is infinitely steep, few samples say how it goes on.
"""

from __future__ import annotations

import itertools
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
from rsrm_gen.trainer.fit import Fit, Schedule, Targets
from rsrm_gen.trainer.model import SplatField
from rsrm_gen.trainer.optimise import AdamW
from rsrm_gen.trainer.response import Affine

SAMPLES, TESTS, NOISE = 1000, 200, 0.01
STEPS, RATE, SHAPE = 20_000, 1e-4, 0.1
DENSE = 10_000  # points without noise, for the error against f itself
METHODS = ("recipe", "ours")
ITERATIONS = 60  # of Gauss-Newton
RELOCATED = {2: 0.1, 4: 0.1, 6: 0.1, 8: 0.06, 10: 0.06, 15: 0.04, 20: 0.04}  # shares of the splats, after iterations
WIDTHS = (0.01, 1.0)  # singular values of A: the square has the side 1
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

    method: str
    count: int  # splats
    seed: int
    steps: int
    parameters: int
    train_error: float  # mean square, at the samples
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


def fitted(method: str, count: int, seed: int, steps: int) -> PlaneRow:
    """Fit so many splats by the authors' `recipe`, in so many steps, or as `ours`, in so many iterations."""
    given, start = data(seed), time.perf_counter()
    field = SplatField(load("euclidean", n=2), count, torch.float64)
    (_by_recipe if method == "recipe" else _by_gauss_newton)(field, given, seed, steps)
    seconds = time.perf_counter() - start
    pairs = ((given.x, given.value), (given.test_x, given.test_value), (given.dense_x, given.dense_value))
    train, test, dense = (float((field.value_and_gradient(x)[0] - y).square().mean()) for x, y in pairs)
    return PlaneRow(
        method=method,
        count=count,
        seed=seed,
        steps=steps,
        parameters=field.parameter_count,
        train_error=train,
        test_error=test,
        rms=math.sqrt(dense),
        seconds=round(seconds, 3),
    )


def _by_recipe(field: SplatField, given: Data, seed: int, steps: int) -> None:
    centers = torch.rand(field.capacity, 2, generator=Generator().manual_seed(seed + 1000), dtype=torch.float64)
    field.append(centers, SHAPE)
    adam = AdamW(field, weight_decay=0.0, gradient_clip=math.inf)
    for _ in range(steps):
        adam.step(_gradient(field, given), RATE)


def _by_gauss_newton(field: SplatField, given: Data, seed: int, steps: int) -> None:
    targets = Targets(given.x, given.value, torch.ones_like(given.value))
    fit = Fit(field, Affine(), targets, Schedule(steps, RELOCATED, WIDTHS))
    fit.place(field.capacity)
    while not fit.done:
        fit.advance()


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
    method: str
    count: int
    seed: int
    steps: int

    @property
    def file(self) -> Path:
        """Where its row is."""
        return self.output / "euclidean" / f"{self.method}-{self.count}-{self.seed}.json"

    def kept(self) -> PlaneRow | None:
        """The row of an earlier run, where it is of as many steps."""
        if not self.file.exists():
            return None
        row = _read(self.file)
        return row if row.steps == self.steps else None

    def made(self) -> PlaneRow:
        """Fit, and keep the row."""
        row = fitted(self.method, self.count, self.seed, self.steps)
        write_text_whole(self.file, json.dumps(asdict(row), indent=1) + "\n")
        return row


def plane_jobs(output: Path, seeds: Sequence[int], quick: bool) -> list[PlaneJob]:
    """Both methods with every number of splats and every seed; of no `seeds` all, but one when quick."""
    seeds = seeds or (SEEDS[:1] if quick else SEEDS)
    counts = QUICK_COUNTS if quick else COUNTS
    steps = {"recipe": QUICK_STEPS if quick else STEPS, "ours": ITERATIONS}
    chosen = itertools.product(METHODS, counts, seeds)
    return [PlaneJob(output, method, count, seed, steps[method]) for method, count, seed in chosen]


def collected_plane(output: Path) -> list[PlaneRow]:
    """Every row in the folder of a benchmark."""
    rows = [_read(path) for path in (output / "euclidean").glob("*.json")]
    return sorted(rows, key=lambda row: (METHODS.index(row.method), row.count, row.seed))


def _read(path: Path) -> PlaneRow:
    try:
        return PlaneRow(**json.loads(path.read_text(encoding="utf-8")))
    except (OSError, ValueError, TypeError) as error:
        raise UserError(f"{path} is no row of this benchmark: {error}", hint="remove it to fit again") from None


def plane_table(rows: Iterable[PlaneRow]) -> Table:
    """Mean and deviation over the seeds, for each method and number of splats."""
    groups: dict[tuple[str, int], list[PlaneRow]] = {}
    for row in rows:
        groups.setdefault((row.method, row.count), []).append(row)
    headings = (
        "Euclidean plane",
        "parameters",
        "steps",
        "at the samples",
        "at test points",
        "RMS of f itself",
        "training s",
    )
    titles = {"recipe": "its authors' recipe", "ours": "ours"}
    cells = []
    for (method, count), members in groups.items():
        found: list[Spread | None] = [
            spread(row.train_error for row in members),
            spread(row.test_error for row in members),
            spread(row.rms for row in members),
            spread(row.seconds for row in members),
        ]
        name = f"{count} splats, {titles[method]}"
        cells.append((name, str(members[0].parameters), str(members[0].steps), *map(str, found)))
    title = f"sin(3 pi sqrt x) cos(3 pi y) from {SAMPLES} noisy samples: mean squares (of the noise: {NOISE**2:g})"
    return Table(title, headings, tuple(cells))
