"""How wrong a field is: its errors against the reference on a fixed grid, beside those of T = d.

Two measures of T - T_ref over the free cells (signed distance >= 0): the RSRM paper's plain RMS over the cells of its
grid, and RMS, 95th percentile and maximum by Riemannian volume, which no choice of coordinates can flatter.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Sequence
from contextlib import nullcontext
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Protocol

import torch
from rich.console import Console
from rich.table import Table
from torch import Generator, Tensor

from rsrm_gen.errors import UserError
from rsrm_gen.files import write_text_whole
from rsrm_gen.manifold import Manifold
from rsrm_gen.trainer.fitted import can_be_fitted, fitted
from rsrm_gen.trainer.model import ArrivalTime
from rsrm_gen.trainer.planning import Planning, planning
from rsrm_gen.trainer.run import Run, load_run
from rsrm_gen.trainer.scene import Scene
from rsrm_gen.trainer.truth import solve_truth

BATCH = 2048
FITTED = "fitted to the reference"

TimeFunction = Callable[[Tensor], Tensor]


@dataclass(frozen=True)
class Cells:
    """Evaluation points (N, D) with the Riemannian volume (N) of their cells, up to a common factor."""

    points: Tensor
    volumes: Tensor


@dataclass(frozen=True)
class ErrorRow:
    """Errors of one field, in units of T."""

    name: str
    paper: float  # RMS, every free cell counted once
    rms: float  # by volume, as the next one
    p95: float
    maximum: float


@dataclass(frozen=True)
class Evaluation:
    """What a run's field was found to be worth."""

    title: str
    cells: int
    rows: tuple[ErrorRow, ...]
    reference_rms: float
    reference_maximum: float
    reference: str
    planning: Planning | None = None


def evaluate_run(
    path: Path,
    console: Console | None = None,
    manifold: Manifold | None = None,
    cells: int | None = None,
    with_fitted: bool = True,
) -> Evaluation:
    """Judge the trained field of a run folder, and keep the verdict there as evaluation.json.

    `manifold` stands in for the one the scene names, `cells` for the reference's resolution. `with_fitted`: also judge the
    same model fitted to the reference, where that takes seconds (fitted.py).
    """
    run = load_run(path, manifold)
    truth = solve_truth(run.scene, cells, console)
    fields: dict[str, TimeFunction] = {"field": run.arrival.time}
    if with_fitted and (model := _fitted(run, truth, console)):
        fields[FITTED] = model.time
    evaluation = evaluate_all(run.scene, fields, truth)
    evaluation = replace(evaluation, planning=planning(run.arrival, run.scene, truth.time))
    write_text_whole(path / "evaluation.json", json.dumps(asdict(evaluation), indent=2) + "\n")
    return evaluation


def _fitted(run: Run, truth: Solution, console: Console | None) -> ArrivalTime | None:
    cells = free_cells(run.scene).points
    if not can_be_fitted(run.arrival, len(cells)):
        return None
    with console.status(FITTED) if console else nullcontext() as status:

        def tell(done: int, whole: int) -> None:
            if status:
                status.update(f"{FITTED}: {done} of {whole} iterations")

        return fitted(run.arrival, cells, truth.time(cells), tell)


class Solution(Protocol):
    """What fields are judged by: `truth.Truth`, or a grid's solution alone."""

    @property
    def error(self) -> float:
        """RMS of its own error over free space, by its own account."""
        ...

    @property
    def max_error(self) -> float:
        """The largest of these errors."""
        ...

    @property
    def note(self) -> str:
        """What it is."""
        ...

    def time(self, x: Tensor) -> Tensor:
        """T (N) in float64 at points (N, D)."""
        ...


def evaluate(scene: Scene, time: TimeFunction, reference: Solution, name: str = "field") -> ErrorRow:
    """The errors of one field: `time` takes points (N, D) of the scene's dtype to T (N)."""
    return evaluate_all(scene, {name: time}, reference).rows[0]


def evaluate_all(scene: Scene, fields: dict[str, TimeFunction], reference: Solution) -> Evaluation:
    """The errors of several fields on the same cells, and of T = d after them."""
    cells = free_cells(scene)
    truth = reference.time(cells.points)
    goal = scene.in_double().goal
    fields = {**fields, "T = d": lambda x: scene.manifold.distance(x.double(), goal)}
    rows = [error_row(name, values(time, cells.points, scene) - truth, cells.volumes) for name, time in fields.items()]
    return Evaluation(scene.title, len(truth), tuple(rows), reference.error, reference.max_error, reference.note)


def values(time: TimeFunction, x: Tensor, scene: Scene) -> Tensor:
    """T (N) in float64, computed in the scene's dtype and in batches."""
    with torch.no_grad():
        return torch.cat([time(part).double().cpu() for part in torch.split(x.to(scene.goal.dtype), BATCH)])


def error_row(name: str, error: Tensor, volumes: Tensor) -> ErrorRow:
    """The measures of the errors (N) in cells of these volumes (N)."""
    weights = volumes / volumes.sum()
    size, order = error.abs().sort()
    covered = weights[order].cumsum(0)
    p95 = size[int((covered < 0.95).sum().clamp_max(len(size) - 1))]
    rms = (weights * error.square()).sum().sqrt()
    return ErrorRow(name, float(error.square().mean().sqrt()), float(rms), float(p95), float(size[-1]))


def free_cells(scene: Scene) -> Cells:
    """The cells of the scene's evaluation grid whose middle is in the domain and not in an obstacle."""
    cells, exact = evaluation_cells(scene), scene.in_double()
    free = (exact.signed_distance(cells.points) >= 0) & exact.inside_domain(cells.points)
    if not bool(free.any()):
        raise UserError(f"every cell of the evaluation grid of {scene.title} lies in an obstacle")
    return Cells(cells.points[free], cells.volumes[free])


def evaluation_cells(scene: Scene) -> Cells:
    """The grid that the scene asks for: `chart`, `polar`, or volume-uniform samples where there is no polar grid."""
    scene, count = scene.in_double(), scene.evaluation.cells
    periods = scene.manifold.periods
    periodic = periods is not None and None not in periods
    grid = scene.evaluation.grid or ("chart" if periodic else "polar")
    if grid == "chart":
        return _chart_cells(scene, count)
    return _polar_cells(scene, count) if scene.manifold.dim == 2 else _samples(scene, count**2)


def _chart_cells(scene: Scene, count: int) -> Cells:
    """A uniform grid over one period of each coordinate, of about count^2 cells in any dimension."""
    periods = [period for period in scene.manifold.periods or () if period is not None]
    if len(periods) != scene.manifold.point_size:
        raise UserError("`evaluation.grid: chart` needs a manifold whose coordinates are all periodic")
    per_axis = round(count ** (2 / len(periods)))
    axes = [period * (torch.arange(per_axis, dtype=torch.float64) / per_axis - 0.5) for period in periods]
    x = scene.manifold.project(torch.cartesian_prod(*axes).reshape(-1, len(periods)))
    # An orthonormal basis in coordinates has the determinant 1 / sqrt(det G).
    return Cells(x, 1 / torch.linalg.det(scene.manifold.frame(x)).abs())


def _polar_cells(scene: Scene, count: int) -> Cells:
    """Distance, in the middle of its cell, times direction: around the domain's centre, else around the goal."""
    manifold = scene.manifold
    center = scene.goal if scene.domain is None else scene.domain.center
    radius = manifold.injectivity_radius if scene.domain is None else scene.domain.radius
    r = radius * (torch.arange(count, dtype=torch.float64) + 0.5) / count
    angle = 2 * math.pi * torch.arange(count, dtype=torch.float64) / count
    direction = torch.stack([angle.cos(), angle.sin()], -1) @ manifold.frame(center)
    x = manifold.exp(center, r[:, None, None] * direction).reshape(-1, manifold.point_size)
    return Cells(x, r.repeat_interleave(count) * torch.exp(-manifold.log_abs_det(center, x)))


def _samples(scene: Scene, count: int) -> Cells:
    x = scene.sample(count, Generator().manual_seed(0))
    return Cells(x, torch.ones(len(x), dtype=torch.float64))


def print_evaluation(evaluation: Evaluation, console: Console) -> None:
    """Two quiet tables."""
    title = f"{evaluation.title}: error of T in {evaluation.cells} free cells"
    table = _table(title, ("RMS (paper)", "RMS (volume)", "p95", "max"))
    for row in evaluation.rows:
        table.add_row(row.name, *(f"{value:.5f}" for value in (row.paper, row.rms, row.p95, row.maximum)))
    own = f"{evaluation.reference_rms:.5f}", "", f"{evaluation.reference_maximum:.5f}"
    table.add_row("reference's own error", "", *own, style="dim")
    console.print(table)
    console.print(f"[dim]reference: {evaluation.reference}[/dim]", highlight=False)
    if evaluation.planning:
        _print_planning(evaluation.planning, console)


def _table(title: str, headings: Sequence[str]) -> Table:
    """Without lines; the first column names its rows."""
    table = Table(title=title, title_justify="left", box=None, pad_edge=False, header_style="dim", title_style="")
    table.add_column("", no_wrap=True)
    for heading in headings:
        table.add_column(heading, justify="right", no_wrap=True)
    return table


def _print_planning(found: Planning, console: Console) -> None:
    title = "descent of T from free starts; cost of the paths over the reference's"
    table = _table(title, ("starts", "arrive", "hit an obstacle", "mean", "median", "p95", "worst"))
    for row in found.rows:
        shares = (f"{100 * share:.1f} %" for share in (row.reached, row.entered))
        ratios = ("-" if r is None else f"{r:.4f}" for r in (row.mean, row.median, row.p95, row.worst))
        table.add_row(row.kind, str(row.starts), *shares, *ratios)
    console.print(table)
    times = f"{found.microseconds:.0f} us for one point, {found.microseconds_in_batches:.2f} us in batches"
    console.print(
        f"[dim]valleys without the goal: {found.valleys}; T and its gradient take {times}[/dim]", highlight=False
    )
