"""How well a field plans: descents from many free starts, judged by what their paths truly cost.

Starts are of three kinds: in the `shadow`, from where the shortest way to the goal leads through an obstacle; `near`, almost as
close to an obstacle as the slowness takes to change; and `open`, the others.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass

import torch
from torch import Generator, Tensor

from rsrm_gen.errors import UserError
from rsrm_gen.trainer.model import ArrivalTime
from rsrm_gen.trainer.plan import Paths, plan
from rsrm_gen.trainer.scene import Scene

STARTS = 200  # uniform in the free space
OF_A_KIND = 80  # at most, for the rows of each kind
POOL = 20  # times as many candidates
NEAR = 2.0  # times the width of the slowness' transition
APART = 0.1  # ends of descents that failed are one valley when they are closer; a length
ALONG = 64  # points of the shortest way that are looked at
REPEATS = 50  # of a query, for its time
BATCH = 4096  # points of a query in batches
KINDS = ("open", "near", "shadow")


@dataclass(frozen=True)
class PlanningRow:
    """Descents from one kind of starts; costs are ratios to the reference's, of those that reached the goal."""

    kind: str
    starts: int
    reached: float  # share
    entered: float  # share of paths through an obstacle
    mean: float | None  # None where no descent reached it
    median: float | None
    p95: float | None
    worst: float | None


@dataclass(frozen=True)
class Planning:
    """What planning with a field is worth."""

    rows: tuple[PlanningRow, ...]  # "all", of uniform starts, then by kind
    valleys: int  # places where descents ended that did not reach the goal
    microseconds: float  # of T and its gradient at one point
    microseconds_in_batches: float  # for each of many points


def planning(arrival: ArrivalTime, scene: Scene, reference: Callable[[Tensor], Tensor], step: float = 0.02) -> Planning:
    """Descend from fresh starts; `reference` takes points (N, D) in float64 to the least cost (N)."""
    x, kinds = starts(scene, Generator().manual_seed(1))
    picked = sorted({*range(min(STARTS, len(x))), *(i for kind in KINDS for i in _of_kind(kinds, kind))})
    paths = plan(arrival, scene, x[picked], step)
    ratio = paths.cost.double() / reference(x[picked].double())
    places = {index: place for place, index in enumerate(picked)}
    rows = [_row("all", paths, ratio, [places[i] for i in range(min(STARTS, len(x)))])]
    rows += [_row(kind, paths, ratio, [places[i] for i in _of_kind(kinds, kind)]) for kind in KINDS]
    one, many = (_microseconds(arrival, x[:count]) for count in (1, BATCH))
    return Planning(tuple(row for row in rows if row.starts), _valleys(scene, paths), one, many)


def starts(scene: Scene, generator: Generator) -> tuple[Tensor, list[str]]:
    """Points (N, D) uniform in the free space, and the kind of each."""
    x = scene.sample(POOL * STARTS, generator)
    x = x[(scene.signed_distance(x) >= 0) & (scene.manifold.distance(x, scene.goal) > 0)]
    if not len(x):
        raise UserError(f"no start was found in the free space of {scene.title}")
    manifold, at = scene.manifold, torch.linspace(0, 1, ALONG, dtype=x.dtype)
    way = manifold.exp(x[:, None], at[:, None] * manifold.log(x, scene.goal.expand_as(x))[:, None])
    shadow = scene.signed_distance(way).amin(1) < 0
    near = scene.signed_distance(x) < NEAR * scene.law.width
    return x, [KINDS[2] if s else KINDS[1] if n else KINDS[0] for s, n in zip(shadow, near, strict=True)]


def _of_kind(kinds: list[str], kind: str) -> list[int]:
    return [i for i, k in enumerate(kinds) if k == kind][:OF_A_KIND]


def _row(kind: str, paths: Paths, ratio: Tensor, rows: list[int]) -> PlanningRow:
    reached, entered, ratio = (paths.reached & ~paths.refused)[rows], paths.entered[rows], ratio[rows]
    ratio = ratio[reached & ratio.isfinite()].sort().values
    if not len(ratio):
        return PlanningRow(kind, len(rows), 0.0, 0.0, None, None, None, None)
    reach, through = (float(flags.double().mean()) for flags in (reached, entered & reached))
    median, p95 = (float(ratio[int(part * (len(ratio) - 1) + 0.5)]) for part in (0.5, 0.95))
    return PlanningRow(kind, len(rows), reach, through, float(ratio.mean()), median, p95, float(ratio[-1]))


def _valleys(scene: Scene, paths: Paths) -> int:
    """How many places there are in which descents ended that did not reach the goal."""
    found: list[Tensor] = []
    for points, reached in zip(paths.points, paths.reached.tolist(), strict=True):
        end = points[-1]
        if not reached and all(float(scene.manifold.distance(end, valley)) > APART for valley in found):
            found.append(end)
    return len(found)


def _microseconds(arrival: ArrivalTime, x: Tensor) -> float:
    """The median time of T and its gradient, for each point of x."""
    arrival.time_and_gradient(x)
    seconds = []
    for _ in range(REPEATS):
        begun = time.perf_counter()
        arrival.time_and_gradient(x)
        seconds.append(time.perf_counter() - begun)
    return 1e6 * statistics.median(seconds) / len(x)
