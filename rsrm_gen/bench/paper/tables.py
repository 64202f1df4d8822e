"""The tables of `rsrm bench paper`: the paper's, its own figures beside ours, and what it does not report."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from rsrm_gen.bench.paper.euclidean import PlaneRow, collected_plane, plane_table
from rsrm_gen.bench.paper.methods import BY_KEY, METHODS
from rsrm_gen.bench.paper.published import Published, place, published
from rsrm_gen.bench.paper.rows import VERSION, Group, Row, Spread, collected, grouped
from rsrm_gen.bench.quiet import LOUD
from rsrm_gen.bench.table import Table, machine, write_json, write_latex
from rsrm_gen.errors import UserError
from rsrm_gen.files import write_text_whole

NONE = "-"
PAPER_STEPS = 4000
ORDER = {method.key: i for i, method in enumerate(METHODS)}


def tables(rows: Sequence[Row], plane: Sequence[PlaneRow] = ()) -> list[Table]:
    """Two for each manifold: the paper's table, then errors by volume and what planning with the field is worth; one
    for the plane."""
    groups: dict[str, list[Group]] = {}
    for group in grouped(rows):
        groups.setdefault(group.manifold, []).append(group)
    made: list[Table] = []
    for manifold in sorted(groups, key=place):
        members = groups[manifold]
        members.sort(key=lambda group: ORDER.get(group.method, len(ORDER)))
        made += [_paper(manifold, members), _beyond(manifold, members)]
    return [*made, *([plane_table(plane)] if plane else [])]


def _paper(manifold: str, groups: list[Group]) -> Table:
    headings = ("method", "final loss", "paper", "ms a step", "paper", "training s", "paper")
    known = published().get(manifold)
    rows = [_paper_row(group, known) for group in groups]
    distance = _shown(_first_of_each_seed(groups).spread(lambda row: row.distance_error))
    rows.append(("T = d", *[NONE] * 6, distance, str(Spread(known.distance_error, None)) if known else NONE, "0", NONE))
    return Table(
        f"{manifold}, {_seeds(groups)}", (*headings, "final error", "paper", "parameters", "paper"), tuple(rows)
    )


def _paper_row(group: Group, known: Published | None) -> tuple[str, ...]:
    kind = BY_KEY[group.method].published
    figures = {"rsrm": known.rsrm, "mlp": known.mlp}[kind] if known and kind else None
    cells = [BY_KEY[group.method].title]
    ours: list[Callable[[Row], float]] = [
        lambda row: row.loss,
        lambda row: row.milliseconds,
        lambda row: row.seconds,
        lambda row: row.error,
    ]
    theirs = [figures.loss, figures.milliseconds, figures.seconds, figures.error] if figures else [None] * 4
    for figure, paper in zip(ours, theirs, strict=True):
        cells += [_shown(group.spread(figure)), NONE if paper is None else str(Spread(paper, None))]
    parameters = group.spread(lambda row: row.parameters)
    return (*cells, f"{parameters.mean:.0f}" if parameters else NONE, str(figures.parameters) if figures else NONE)


def _beyond(manifold: str, groups: list[Group]) -> Table:
    headings = ("method", "RMS by volume", "p95", "max", "reach the goal", "path cost", "its p95", "us a query")
    figures: list[Callable[[Row], float | None]] = [
        lambda row: row.rms,
        lambda row: row.p95,
        lambda row: row.maximum,
    ]
    rows = []
    for group in groups:
        reached = group.spread(lambda row: row.reached)
        costs = (group.spread(lambda row: row.cost_mean), group.spread(lambda row: row.cost_p95))
        query = group.spread(lambda row: row.microseconds)
        cells = [_shown(group.spread(figure)) for figure in figures]
        cells.append(f"{100 * reached.mean:.1f} %" if reached else NONE)
        cells += [f"{cost.mean:.4f}" if cost else NONE for cost in costs]
        rows.append((BY_KEY[group.method].title, *cells, f"{query.mean:.0f}" if query else NONE))
    own = _shown(_first_of_each_seed(groups).spread(lambda row: row.reference_error))
    rows.append(("the reference's own error", own, *[NONE] * 6))
    return Table(f"{manifold}: errors by volume, and descents from 200 free starts", headings, tuple(rows))


def _first_of_each_seed(groups: list[Group]) -> Group:
    """One row a seed, for what does not depend on the method."""
    rows = {row.seed: row for group in reversed(groups) for row in group.rows}
    return Group("", "", tuple(rows.values()))


def _shown(spread: Spread | None) -> str:
    return NONE if spread is None else str(spread)


def _seeds(groups: list[Group]) -> str:
    """Of all groups; a group that lacks some is said in the foot."""
    seeds = sorted({row.seed for group in groups for row in group.rows})
    if len(seeds) == 1:
        return f"seed {seeds[0]}"
    whole = seeds == list(range(seeds[0], seeds[-1] + 1))
    return f"seeds {seeds[0]} to {seeds[-1]}" if whole else f"seeds {', '.join(map(str, seeds))}"


def write_all(output: Path, command: str) -> None:
    """All rows in the folder of a benchmark as JSON there, and their tables as Markdown and LaTeX."""
    rows, plane = collected(output), collected_plane(output)
    shown, words = tables(rows, plane), notes(rows, (), 0, command)
    write_json(output / "paper.json", document(rows, plane))
    write_page(output / "paper.md", shown, words)
    write_latex(output / "paper.tex", shown, " ".join(words))


def document(rows: Sequence[Row], plane: Sequence[PlaneRow]) -> dict[str, Any]:
    """All figures; `read_rows` reads them."""
    return {"version": VERSION, "rows": [asdict(row) for row in rows], "plane": [asdict(row) for row in plane]}


def read_rows(path: Path) -> tuple[list[Row], list[PlaneRow]]:
    """The rows of a JSON file that the benchmark wrote."""
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
        return [Row(**row) for row in found["rows"]], [PlaneRow(**row) for row in found["plane"]]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise UserError(f"{path} holds no rows of this benchmark: {error}") from None


def notes(rows: Sequence[Row], failures: Iterable[str], missing: int, command: str) -> list[str]:
    """What stands below the tables: how to make them again, where, what they are, and what they are not."""
    threads = " or ".join(map(str, sorted({row.threads for row in rows})))
    words = [f"`{command}`; {machine()}{f', {threads} threads of torch' if threads else ''}."]
    words += READING if rows else ()
    words += _shortcomings(rows)
    if missing:
        words.append(f"NOT FINISHED: {missing} trainings are missing; the same command goes on.")
    return [*words, *(f"Failed: {failure}." for failure in failures)]


READING = (
    "Mean and standard deviation over the seeds; the paper's columns are its means over five, on a GPU.",
    "Final loss: the mean of |1 - sqrt q| + |1 - 1 / sqrt q|, q = |grad T| / s, at 16384 fresh points, for every method,"
    " also for ours, which does not minimise it.",
    "Final error: RMS of T over the free cells of the paper's grid, against our reference (the paper's own was wrong by"
    " 0.065, 0.035 and 0.118 on torus, sphere and hyperbolic plane).",
    "Ours is trained by few long steps (labels, then Gauss-Newton); training seconds include the labels.",
    "The networks are the paper's in size; what the paper does not say of them (rate, features, first weights) is what"
    " served them best on other scenes.",
    "Path cost: true cost of the descents that reach the goal, over the reference's.",
)


def _shortcomings(rows: Sequence[Row]) -> list[str]:
    """What is wrong with these rows."""
    words = []
    counts = {group: len(group.rows) for group in grouped(rows)}
    most = max(counts.values(), default=0)
    short = [f"{group.method} on {group.manifold} ({count})" for group, count in counts.items() if count < most]
    if short:
        words.append(f"Fewer seeds than {most}: {', '.join(short)}.")
    if any(row.steps < PAPER_STEPS for row in rows if BY_KEY[row.method].recipe):
        words.append(f"SHORTENED: some of the paper's trainings are shorter than its {PAPER_STEPS} steps.")
    loudest = max((row.others for row in rows if row.others is not None), default=0.0)
    if loudest > LOUD:
        busy = f"other programs used up to {loudest:.1f} cores when trainings began"
        words.append(f"DISTURBED: {busy}; times are too long.")
    return words


def write_page(file: Path, shown: Sequence[Table], words: Iterable[str]) -> None:
    """The tables as a page in Markdown."""
    text = "\n".join(["# The experiments of the RSRM paper, made again", "", *(table.markdown() for table in shown)])
    write_text_whole(file, text + "\n## Notes\n\n" + "".join(f"- {word}\n" for word in words))
