"""The tables of `rsrm bench planners`: one a scene, its rows the methods and the times that they were given."""

from __future__ import annotations

import statistics
from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

from rsrm_gen.bench.planners.contest import Contest, Query
from rsrm_gen.bench.table import Table, machine

CLOSE = 1.01  # times the least cost
NONE = "-"
HEADINGS = (
    "",
    "CPU s a query",
    "reach the goal",
    "within 1 %",
    "cost / least: mean",
    "median",
    "p95",
    "worst",
    "points",
)


def tables(found: Sequence[Contest]) -> list[Table]:
    """One a scene."""
    return [_table(contest) for contest in found]


def _table(contest: Contest) -> Table:
    groups: dict[tuple[str, float | None], list[Query]] = {}
    for query in contest.queries:
        groups.setdefault((query.method, query.budget), []).append(query)
    kinds = Counter(query.kind for query in {query.start: query for query in contest.queries}.values())
    starts = ", ".join(f"{count} {kind}" for kind, count in sorted(kinds.items()))
    title = f"{contest.title}: {contest.manifold}, d = {contest.dim}; starts: {starts}"
    return Table(title, HEADINGS, tuple(_row(contest, *key, queries) for key, queries in groups.items()))


def _row(contest: Contest, method: str, budget: float | None, queries: list[Query]) -> tuple[str, ...]:
    name = f"{method}, {budget:g} s" if budget is not None else _field(contest)
    ratios = sorted(query.ratio for query in queries if query.ratio is not None)
    points = [query.points for query in queries if query.points is not None]
    seconds = statistics.median(query.seconds for query in queries)
    shares = (len(ratios), sum(ratio <= CLOSE for ratio in ratios))
    figures = [statistics.fmean(ratios), statistics.median(ratios), _p95(ratios), ratios[-1]] if ratios else []
    return (
        name,
        f"{seconds:.3g}",
        *(f"{100 * share / len(queries):.0f} %" for share in shares),
        *([f"{figure:.4f}" for figure in figures] or [NONE] * 4),
        f"{statistics.median(points):.0f}" if points else NONE,
    )


def _field(contest: Contest) -> str:
    trained = "" if contest.training_seconds is None else f", trained in {contest.training_seconds:.0f} s"
    return f"descent of the field, {contest.splats} splats{trained}"


def _p95(ratios: list[float]) -> float:
    return ratios[int(0.95 * (len(ratios) - 1) + 0.5)]


def foot(found: Sequence[Contest], command: str) -> str:
    """What stands below the tables: how to make them again, where, and what they are not."""
    references = dict.fromkeys(contest.reference for contest in found)
    return " ".join(
        [
            f"`{command}`; {machine()}, one thread.",
            "Seconds are those of one thread of the processor; the field's training counts once for all queries.",
            "Costs are exact integrals of the slowness along the paths, by one quadrature for all methods, over the least"
            " cost; means and quantiles are over the paths that were found.",
            "Points: median number of points that a planner looked at. It calls Python for every cost, which takes up to two"
            " and a half times as long as the integral alone; one that is C++ throughout would look at more.",
            "Nothing is smoothed afterwards.",
            *(f"Least cost: {reference}." for reference in references),
        ]
    )


def document(found: Sequence[Contest]) -> list[dict[str, Any]]:
    """All figures, a query a row."""
    return [asdict(contest) for contest in found]
