"""The results: a row for each training, kept as JSON; mean and deviation over the seeds."""

from __future__ import annotations

import json
import statistics
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

from rsrm_gen.errors import UserError

VERSION = 1  # of what a row holds


@dataclass(frozen=True)
class Row:
    """What one training gave. Errors are in units of T, costs of paths are ratios to the reference's."""

    method: str
    manifold: str
    seed: int
    loss: float  # mean Eikonal residual |1 - sqrt q| + |1 - 1 / sqrt q| at fresh points, whatever was trained for
    milliseconds: float  # a step
    seconds: float  # of training
    parameters: int
    splats: int  # 0: a network
    steps: int
    error: float  # RMS over the free cells of the paper's grid
    rms: float  # by volume, as the next two
    p95: float
    maximum: float
    distance_error: float  # of T = d, by the paper's measure
    reference_error: float  # RMS of the reference itself
    reached: float | None  # share of descents that reach the goal
    cost_mean: float | None
    cost_p95: float | None
    microseconds: float | None  # of T and its gradient at one point
    threads: int
    others: float | None  # cores that other programs used when it began; None where the system does not say


def read_row(path: Path) -> Row:
    """A row that `Job.keep` wrote."""
    try:
        return Row(**json.loads(path.read_text(encoding="utf-8")))
    except (OSError, ValueError, TypeError) as error:
        raise UserError(f"{path} is no row of this benchmark: {error}", hint="remove it to train again") from None


@dataclass(frozen=True)
class Spread:
    """Mean and standard deviation (of a sample) over the seeds."""

    mean: float
    deviation: float | None  # None for one seed

    def __str__(self) -> str:
        """Three digits of the mean, and the deviation to the same place."""
        places = max(0, 2 - int(f"{self.mean:.2e}".split("e")[1])) if self.mean else 0
        text = f"{self.mean:.{places}f}"
        return text if self.deviation is None else f"{text} ± {self.deviation:.{places}f}"


def spread(values: Iterable[float | None]) -> Spread | None:
    """Of the values that there are; None where there is none."""
    known = [value for value in values if value is not None]
    if not known:
        return None
    return Spread(statistics.fmean(known), statistics.stdev(known) if len(known) > 1 else None)


@dataclass(frozen=True)
class Group:
    """The rows of one method on one manifold, a row a seed."""

    method: str
    manifold: str
    rows: tuple[Row, ...]

    def spread(self, figure: Callable[[Row], float | None]) -> Spread | None:
        """Of one figure of the rows."""
        return spread(figure(row) for row in self.rows)


def grouped(rows: Iterable[Row]) -> list[Group]:
    """By manifold and method, in the order in which they come."""
    groups: dict[tuple[str, str], list[Row]] = {}
    for row in rows:
        groups.setdefault((row.manifold, row.method), []).append(row)
    return [Group(method, manifold, tuple(members)) for (manifold, method), members in groups.items()]


def collected(output: Path) -> list[Row]:
    """Every row in the folder of a benchmark."""
    return [read_row(path) for path in sorted(output.glob("*/*/row.json"))]
