"""The same queries for every method: sampling planners after some seconds, and the descent of a trained field.

Seconds are those of one thread of a processor, so that other programs cost nobody anything.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import zip_longest
from pathlib import Path

import torch
from torch import Generator, Tensor

from rsrm_gen.bench.planners.layout import Layout, layout_of
from rsrm_gen.bench.planners.motion import Motions
from rsrm_gen.errors import UserError
from rsrm_gen.trainer.curves import Array
from rsrm_gen.trainer.plan import plan
from rsrm_gen.trainer.planning import starts
from rsrm_gen.trainer.run import Run, load_run
from rsrm_gen.trainer.truth import solve_truth

SEED = 2  # of the starts; `rsrm eval` has others
COMPANY = 2000  # other points whose least costs are found together with the starts': neighbours show each other ways
FIELD = "field"
Say = Callable[[str], None]


@dataclass(frozen=True)
class Found:
    """What a planner has after some time; `path` is empty while there is none."""

    seconds: float  # of a processor that it had
    path: tuple[Array, ...]  # points (D,) of the manifold, from the start to the goal
    points: int  # that it looked at


Search = Callable[
    [str, Layout, Array, Sequence[float]], list[Found]
]  # planner, where, start (D,), seconds: one for each


@dataclass(frozen=True)
class Query:
    """What one method made of one start."""

    start: int
    kind: str  # open, near or shadow
    method: str
    budget: float | None  # seconds that it was given; None: as many as it takes
    seconds: float  # that it took
    cost: float | None  # exact; None where it found no path
    ratio: float | None  # to the least cost
    points: int | None  # that a planner looked at


@dataclass(frozen=True)
class Contest:
    """All queries in the scene of one run."""

    run: str
    title: str
    manifold: str
    dim: int
    layout: str  # how planners stored points
    splats: int
    training_seconds: float | None
    reference: str  # how least costs were found
    queries: tuple[Query, ...]


def sampling_planners() -> Search:
    """The planners of OMPL; a `UserError` where it is not installed."""
    try:
        from rsrm_gen.bench.planners.search import search
    except ImportError as error:
        hint = "pip install 'rsrm-gen[ompl]'"
        raise UserError(f"sampling planners need OMPL's Python package: {error}", hint=hint) from None
    return search


def contest(
    path: Path, search: Search, planners: Sequence[str], budgets: Sequence[float], count: int, say: Say
) -> Contest:
    """Ask the field of a run folder and the planners for ways to the goal from `count` free starts."""
    torch.set_num_threads(1)
    run = load_run(path)
    scene = run.scene
    layout = layout_of(scene)
    motions = Motions(layout)
    pool, kinds_of = starts(scene, Generator().manual_seed(SEED))
    rows = _mixed(kinds_of, count)
    pool = scene.manifold.project(pool.double())
    x, kinds = pool[rows], [kinds_of[i] for i in rows]
    say(f"{scene.title}: least costs")
    truth = solve_truth(scene)
    least = truth.time(torch.cat([x, pool[:COMPANY]]))[: len(x)]
    queries: list[Query] = []
    for i, (start, kind, best) in enumerate(zip(x, kinds, least.tolist(), strict=True)):
        say(f"{scene.title}: start {i + 1} of {len(x)}")
        answers: list[tuple[str, float | None, Found]] = [(FIELD, None, _descended(run, start))]
        for planner in planners:
            found = search(planner, layout, start.numpy(), budgets)
            answers += [(planner, budget, each) for budget, each in zip(budgets, found, strict=True)]
        queries += [_judged(motions, i, kind, *answer, best) for answer in answers]
    summary = run.summary
    return Contest(
        run=str(path),
        title=scene.title,
        manifold=scene.manifold.name,
        dim=scene.manifold.dim,
        layout=type(layout).__name__,
        splats=run.arrival.field.count,
        training_seconds=None if summary is None else summary.seconds,
        reference=truth.note,
        queries=tuple(queries),
    )


def contests(
    paths: Iterable[Path],
    search: Search,
    planners: Sequence[str],
    budgets: Sequence[float],
    count: int,
    say: Say = lambda words: None,
) -> list[Contest]:
    """One for each run folder."""
    return [contest(path, search, planners, sorted(budgets), count, say) for path in paths]


def _mixed(kinds: Sequence[str], count: int) -> list[int]:
    """The indices of so many points, as evenly of every kind as there are."""
    by_kind = [[i for i, k in enumerate(kinds) if k == kind] for kind in dict.fromkeys(kinds)]
    return [i for turn in zip_longest(*by_kind) for i in turn if i is not None][:count]


def _descended(run: Run, start: Tensor) -> Found:
    """The way down T."""
    begun = time.thread_time()
    paths = plan(run.arrival, run.scene, start[None].to(run.scene.goal.dtype))
    seconds = time.thread_time() - begun
    M = run.scene.manifold
    whole = [start, *M.project(paths.points[0][1:].double())] if bool(paths.reached[0]) else []
    return Found(seconds, tuple(point.numpy() for point in whole), 0)


def _judged(
    motions: Motions, start: int, kind: str, method: str, budget: float | None, found: Found, least: float
) -> Query:
    """By the exact cost of the path; one through an obstacle is none where the scene forbids that."""
    scene, path = motions.layout.scene, found.path
    if path and scene.forbid_obstacles and motions.clearance(path) < 0:
        path = ()
    cost = motions.path_cost(path) if path else None
    ratio = None if cost is None else cost / least
    return Query(start, kind, method, budget, found.seconds, cost, ratio, found.points or None)
