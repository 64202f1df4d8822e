"""Fit a field to values at points, or an arrival time to labels: all that shapes its splats, by damped Gauss-Newton.

    first splats    well spread over the points, round, as wide as their neighbours are far; weights by linear least squares
    every iteration a step of Gauss-Newton (gauss_newton.py), damped as Marquardt has it; one that does not lower the cost is
                    refused and damped more
    now and then    the splats that are needed least go to where the residuals are largest, and all weights are solved again

What is minimised is sum_n w_n (y(x_n) - value_n)^2, y the field or the arrival time made of it (response.py). Everything
runs over blocks of points: a million of them need no more memory than their own numbers.
"""

from __future__ import annotations

import math
import time
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
import torch
from torch import Tensor

from rsrm_gen.manifold import Manifold
from rsrm_gen.trainer.density import pick_apart, pick_spread
from rsrm_gen.trainer.gauss_newton import (
    WHOLE,
    NormalEquations,
    Sample,
    amplitudes,
    amplitudes_alone,
    apply,
    bounded,
    curvature,
    effective_map,
    gradient,
    sample,
    set_amplitudes,
)
from rsrm_gen.trainer.model import SplatField
from rsrm_gen.trainer.response import Response
from rsrm_gen.trainer.run import Arrays, fill_rows, first_rows

CANDIDATES = 16  # points looked at for each centre that is chosen
OVERLAP = 1.24  # standard deviations of a first splat for each distance to a neighbour
RIDGE = 1e-7  # of the mean square of the rows, on amplitudes of about 1
NEAREST = 0.5  # of the distance to the next point: narrower splats would follow single points
WIDEST = 0.22  # of the injectivity radius, on a compact manifold: little is left of a splat at its cut locus
SMALLEST = 1e-30  # where no row says anything
FIRST_DAMPING, EASE, RAISE = 1e-2, 0.4, 4.0
LEAST_DAMPING, LARGEST_DAMPING = 1e-7, 1e6
WORSE = 2.0  # times the cost before
FREE = 0.999  # of the largest weight: what counts as free space in the report


@dataclass(frozen=True)
class Targets:
    """What a field is to give: N points, the values there, and how much each counts."""

    x: Tensor  # (N, D)
    value: Tensor  # (N,)
    weight: Tensor  # (N,), not negative


@dataclass(frozen=True)
class Schedule:
    """How long, and after which iterations (from 1) what share of the splats is moved to where it is needed more."""

    iterations: int = 30
    relocate: dict[int, float] = field(default_factory=dict)
    bounds: tuple[float, float] = (1e-3, math.inf)  # of the singular values of A


# A long fit is in two parts, the first on fewer points: this part of the iterations; and in each, after which of its
# iterations, as parts of it, what share of the splats is moved.
FIRST = 0.4
MOVED = (
    {0.14: 0.1, 0.28: 0.08, 0.42: 0.07, 0.56: 0.06, 0.7: 0.05, 0.85: 0.04},
    {0.1: 0.04, 0.3: 0.03, 0.5: 0.02},
)


def two_parts(iterations: int) -> tuple[tuple[int, dict[int, float]], tuple[int, dict[int, float]]]:
    """Of each part of a fit: how many iterations, and after which of them (from 1) what share of the splats is moved."""
    first = math.ceil(FIRST * iterations)
    early, late = (
        (count, {max(round(part * count), 1): share for part, share in moved.items()})
        for count, moved in zip((first, iterations - first), MOVED, strict=True)
    )
    return early, late


def shape_bounds(manifold: Manifold, x: Tensor) -> tuple[float, float]:
    """How narrow and how wide splats may be that are fitted to values at points x (N, D)."""
    some = x[:: max(len(x) // 512, 1)][:512]
    distance = manifold.distance(some[:, None], x[None, : 1 << 14])
    largest = float(distance.amax())
    apart = torch.where(distance > 0, distance, torch.inf).amin(1)
    least = NEAREST * float(apart[apart.isfinite()].median()) if bool(apart.isfinite().any()) else 1e-3
    if math.isfinite(manifold.diameter):
        largest = min(largest, WIDEST * manifold.injectivity_radius)
    return min(least, largest), max(largest, least)


@dataclass(frozen=True)
class Record:
    """One iteration: RMS of the residuals by weight, and where the weight is largest; seconds of this iteration."""

    iteration: int
    rms: float
    free_rms: float
    damping: float
    accepted: bool
    relocated: int
    seconds: float


class Fit:
    """A field on its way to its targets. Deterministic; `arrays` is all that is needed to go on."""

    def __init__(self, field: SplatField, response: Response, targets: Targets, schedule: Schedule) -> None:
        """A field without splats gets its first ones from `place`; targets in the field's dtype."""
        self.field = field
        self.response = response
        self.iteration = 0
        self.damping = FIRST_DAMPING
        self.aim(targets, schedule)

    def aim(self, targets: Targets, schedule: Schedule) -> None:
        """Take other targets and begin a new phase; the splats and the damping stay."""
        x = targets.x
        self.targets = targets
        self.schedule = schedule
        self.sample: Sample = sample(self.field, x)
        self.known = self.response.at(x)
        self.weight = targets.weight.sqrt()
        self.phase_start = self.iteration

    def revalue(self, value: Tensor) -> None:
        """Take other values (N,) at the same points; the phase goes on."""
        self.targets = replace(self.targets, value=value)

    @property
    def done(self) -> bool:
        """Whether the schedule is at its end, or no step helps any more."""
        return self.iteration - self.phase_start >= self.schedule.iterations or self.damping > LARGEST_DAMPING

    def place(self, count: int) -> None:
        """The first splats, at so many of the points, well spread; their weights solved."""
        targets, manifold = self.targets, self.field.manifold
        x = targets.x[targets.weight > 0.05 * targets.weight.amax()]
        stride = max(len(x) // (CANDIDATES * count), 1)
        centers = pick_spread(manifold, x[::stride], min(count, len(x)))
        self.field.append(centers, 1.0)
        self.field.A[: len(centers)] *= self._spacing(centers)[:, None, None] * OVERLAP
        self._bound()
        self.solve_amplitudes()

    def _spacing(self, centers: Tensor, others: Tensor | None = None) -> Tensor:
        """The mean distance of each centre (k, D) to its nearest neighbours among the others (K, D): (k,)."""
        manifold = self.field.manifold
        among = centers if others is None else others
        distance = manifold.distance(centers[:, None], among[None])
        count = min(2 * (manifold.dim + 1) + (others is None), len(among))
        nearest = distance.topk(count, dim=1, largest=False).values
        return nearest.sum(1) / max(count - (others is None), 1)

    def _bound(self) -> None:
        A = self.field.A[: self.field.count]
        A.copy_(bounded(A, *self.schedule.bounds))

    def solve_amplitudes(self) -> None:
        """All weights by linear least squares, to f = what gives the values, in the metric of y: rows times dy/df there."""
        wanted = self.response.field(self.known, self.targets.value)
        row = self.weight * self.response.slope(self.known, wanted)
        usable = wanted.isfinite() & row.isfinite()
        wanted, row = torch.where(usable, wanted, 0.0), torch.where(usable, row, 0.0)
        alone = amplitudes_alone(self.field)
        matrix = self._ridged(curvature(self.field, self.sample, row, alone, torch.float64, WHOLE), row)
        right = gradient(self.field, self.targets.x, row, row * wanted, alone)
        solution = torch.cholesky_solve(right[:, None], torch.linalg.cholesky(matrix))[:, 0]
        set_amplitudes(self.field, solution.to(self.field.v.dtype))

    def _ridged(self, matrix: Tensor, row: Tensor) -> Tensor:
        matrix.diagonal().add_(max(RIDGE * float(row.double().square().sum()), SMALLEST))
        return matrix

    def advance(self) -> Record:
        """One iteration."""
        start = time.perf_counter()
        f = self.values(self.targets.x)
        cost = self._cost(f)
        row = self.weight * self.response.slope(self.known, f)
        residual = self._residual(f)
        to_effective = effective_map(self.field, self.field.splats())
        matrix = curvature(self.field, self.sample, row, to_effective, row.dtype)
        right = gradient(self.field, self.targets.x, row, residual, to_effective)
        accepted = self._step(NormalEquations.of(matrix, right), cost)
        self.iteration += 1
        relocated = self._relocate(self.schedule.relocate.get(self.iteration - self.phase_start, 0.0))
        rms, free = self.errors()
        seconds = time.perf_counter() - start
        return Record(self.iteration, rms, free, self.damping, accepted, relocated, seconds)

    def _step(self, equations: NormalEquations, cost: float) -> bool:
        """Try steps, each damped more than the last, until one lowers the cost."""
        before = self._rows()
        for _ in range(6):
            step = equations.step(self.damping)
            if step is not None:
                apply(self.field, step, self.schedule.bounds)
                if self._cost(self.values(self.targets.x)) < cost:  # false where it is not a number
                    self.damping = max(self.damping * EASE, LEAST_DAMPING)
                    return True
                self._restore_rows(before)
            self.damping *= RAISE
        return False

    def _rows(self) -> dict[str, Tensor]:
        return {name: rows.clone() for name, rows in self.field.buffers_of_splats().items()}

    def _restore_rows(self, kept: dict[str, Tensor]) -> None:
        for name, rows in self.field.buffers_of_splats().items():
            rows.copy_(kept[name])

    def values(self, x: Tensor) -> Tensor:
        """f (N,) at x (N, D)."""
        mu, W, amplitude = self.field.splats().inputs()
        return self.field.manifold.splats_value(x, mu, W, amplitude)

    def _residual(self, f: Tensor) -> Tensor:
        """The weighted residuals (N,)."""
        return self.weight * (self.response.value(self.known, f) - self.targets.value)

    def _cost(self, f: Tensor) -> float:
        return float(self._residual(f).double().square().sum())

    def errors(self) -> tuple[float, float]:
        """RMS of the residuals by weight, and of those whose weight is the largest."""
        residual = self._residual(self.values(self.targets.x)).double().square()
        weight = self.targets.weight.double()
        free = weight >= FREE * weight.amax()
        return math.sqrt(residual.sum() / weight.sum()), math.sqrt(residual[free].sum() / weight[free].sum())

    def _relocate(self, share: float) -> int:
        """Move that share of the splats, those that could be missed best, to the largest residuals; how many. What makes
        the fit much worse (the weights are solved for f, and T is not linear in it) is taken back."""
        count = int(share * self.field.count)
        if count == 0:
            return 0
        f = self.values(self.targets.x)
        row = self.weight * self.response.slope(self.known, f)
        # What the cost would rise by if a splat went and the weights of the others made up for it: a^2 / (G^-1)_kk.
        matrix = curvature(self.field, self.sample, row, amplitudes_alone(self.field), torch.float64)
        inverse = torch.cholesky_inverse(torch.linalg.cholesky(self._ridged(matrix, row))).diagonal()
        missed = amplitudes(self.field).double().square() / inverse
        centers, cost, before = self._worst(f, count), self._cost(f), self._rows()
        gone = missed.argsort(stable=True)[: len(centers)]
        kept = torch.ones(self.field.count, dtype=torch.bool)
        kept[gone] = False
        self.field.keep(torch.nonzero(kept)[:, 0])
        first = self.field.count
        spacing = self._spacing(centers, self.field.mu[:first])
        self.field.append(centers, 1.0)
        self.field.A[first : self.field.count] *= spacing[:, None, None] * (OVERLAP / 2)
        self._bound()
        self.solve_amplitudes()
        if not self._cost(self.values(self.targets.x)) < WORSE * cost:
            self._restore_rows(before)
            return 0
        return len(centers)

    def worst(self, count: int) -> Tensor:
        """Where more targets would help most: points of the largest weighted residuals, apart from one another (k, D)."""
        return self._worst(self.values(self.targets.x), count)

    def _worst(self, f: Tensor, count: int) -> Tensor:
        mu = self.field.mu[: self.field.count]
        apart = float(self._spacing(mu).median()) / 2
        return pick_apart(self.field.manifold, self.targets.x, self._residual(f).abs(), count, apart)

    def arrays(self) -> Arrays:
        """All that changes, as plain arrays."""
        arrays = first_rows(self.field.buffers_of_splats(), self.field.count)
        numbers = {"iteration": self.iteration, "phase_start": self.phase_start, "damping": self.damping}
        return {**arrays, **{name: np.array(number) for name, number in numbers.items()}}

    def restore(self, arrays: Arrays, path: Path) -> None:
        """Go back to what `arrays` gave, after `aim` at the targets of its phase; `path` is where they were kept."""
        self.field.count = fill_rows(self.field.buffers_of_splats(), arrays, path)
        self.iteration, self.phase_start = int(arrays["iteration"]), int(arrays["phase_start"])
        self.damping = float(arrays["damping"])
