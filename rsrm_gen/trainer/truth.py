"""The arrival time by minimisation over curves: what fields are judged by; nothing that trains imports it.

Where obstacles meet, the slowness has V-shaped valleys, along which optimal paths slide and grid solvers converge like h^0.8.
A curve has no grid: its cost is an integral, an upper bound of the arrival time. So from every point a curve follows the grid's
solution (reference.py) back to the goal and is relaxed (curves.py), its neighbours' curves are tried, and the least cost is the
truth. The grid is then its independent check. Where there is no grid solution, the curves begin as those of a roadmap.
"""

from __future__ import annotations

import hashlib
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace

import numpy as np
import torch
from rich.console import Console
from torch import Tensor

from rsrm_gen.errors import UserError
from rsrm_gen.files import cache_folder, write_whole
from rsrm_gen.trainer.curves import Curves, Terrain, offsets_of
from rsrm_gen.trainer.labels import Labels, Progress, exchanged, extended, label, labels_of, offered
from rsrm_gen.trainer.reference import Reference, scene_key, solve_reference
from rsrm_gen.trainer.sampling import sample_points
from rsrm_gen.trainer.scene import Scene

VERSION = 1  # of the method: part of the name under which results are kept
STEP = 0.05  # of following the grid's solution back, in units of the scene's smallest length
DIFFERENCE = 0.02  # of the grid's solution, for its slope; the same unit
TOO_LONG = 1.5  # times the longest path that T could pay for, after which a trail is given up
FINER = 0.5  # times the usual spacing of nodes
SUPPORT = 8192  # points of a roadmap, at least
SAMPLE = 512  # curves whose nodes are doubled again, for the error


def solve_truth(scene: Scene, cells: int | None = None, console: Console | None = None) -> Truth | Reference:
    """What fields of a scene are judged by: curves, or, where no C compiler can relax them, the grid's solution alone."""
    try:
        terrain = Terrain(scene)
    except UserError:
        return solve_reference(scene, cells, console)
    return Truth(terrain, cells, console)


@dataclass(frozen=True)
class Check:
    """How far the curves' costs are from the grid's solution, over free points."""

    rms: float
    maximum: float


class Truth:
    """The arrival time of a scene at points that are asked for, each set of them computed once and kept."""

    def __init__(self, terrain: Terrain, cells: int | None = None, console: Console | None = None) -> None:
        """`cells`: of the grid, see `solve_reference`. Where no grid solution can be had, `why_no_grid` says why."""
        self.scene = terrain.scene
        self.console = console
        self.terrain = terrain
        self.terrain.usual = replace(self.terrain.usual, spacing=FINER * self.terrain.usual.spacing)
        self.grid, self.why_no_grid = None, ""
        try:
            self.grid = solve_reference(self.scene, cells, console)
        except UserError as error:
            self.why_no_grid = error.message
        self.known: Labels | None = None  # of the points that were asked for first
        self.asked: Tensor | None = None  # these points
        self.error = self.max_error = 0.0  # what twice as many nodes change, RMS and at most
        self.check: Check | None = None

    def time(self, x: Tensor) -> Tensor:
        """The arrival times (N) in float64 at points (N, D)."""
        x = self.scene.manifold.project(x.detach().double().cpu()).contiguous()
        if self.known is not None and self.asked is not None and torch.equal(x, self.asked):
            return torch.from_numpy(self.known.time)
        labels = self._kept(x)
        if self.known is None:
            self.known, self.asked = labels, x
            self._look_at(labels)
        return torch.from_numpy(labels.time)

    @property
    def note(self) -> str:
        """What the truth is, and what it was checked with."""
        made = "the least costs of curves"
        if self.grid is None:
            return f"{made} from a roadmap; no grid solution to check with: {self.why_no_grid}"
        found = self.check
        compared = f"; they differ from it by {found.rms:.1e} RMS, {found.maximum:.1e} at most" if found else ""
        own = f"{self.grid.error:.1e} RMS, {self.grid.max_error:.1e} at most"
        return f"{made}, begun along the solution by {self.grid.note}, whose own error is about {own}{compared}"

    def _kept(self, x: Tensor) -> Labels:
        path = cache_folder() / f"{self._key(x)}.npz"
        try:
            with path.open("rb") as opened, np.load(opened, allow_pickle=False) as file:
                return Labels.from_arrays(file)
        except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile):
            pass
        labels = self._solved(x)
        write_whole(path, lambda file: np.savez(file, allow_pickle=False, **labels.arrays()))
        return labels

    def _solved(self, x: Tensor) -> Labels:
        with _shown(self.console, len(x)) as progress:
            unit = self.terrain.unit
            traced = back_traced(self.grid, x, STEP * unit, DIFFERENCE * unit) if self.grid else None
            if self.known is not None:
                labels = extended(self.terrain, self.known, x, progress)
                rows = np.arange(len(self.known), len(labels))
                if traced is not None:
                    labels = offered(self.terrain, labels, rows, traced, progress)
                return labels.take(rows)
            if traced is None:
                return self._by_roadmap(x, progress)
            labels = labels_of(self.terrain, traced, "relax", progress)
            return exchanged(self.terrain, labels, np.ones(len(x), bool), progress)

    def _by_roadmap(self, x: Tensor, progress: Progress) -> Labels:
        """Labels of x (N, D), among so many points that their roadmap is no coarse one."""
        more = sample_points(self.scene, max(SUPPORT - len(x), 0), torch.Generator().manual_seed(0))
        return label(self.terrain, torch.cat([x, more]), progress).take(np.arange(len(x)))

    def _look_at(self, labels: Labels) -> None:
        """Measure the error, and compare with the grid."""
        some = np.linspace(0, len(labels) - 1, min(SAMPLE, len(labels))).astype(np.int64)
        finer = replace(self.terrain.usual, spacing=self.terrain.usual.spacing / 2)
        change = self.terrain.relaxed(labels.curves.take(some), finer).cost - labels.time[some]
        self.error, self.max_error = float(np.sqrt(np.mean(change**2))), float(np.abs(change).max())
        if self.grid is not None:
            difference = self.grid.time(torch.from_numpy(labels.x)).numpy() - labels.time
            difference = difference[np.isfinite(difference)]
            rms, largest = float(np.sqrt(np.mean(difference**2))), float(np.abs(difference).max(initial=0.0))
            self.check = Check(rms, largest)

    def _key(self, x: Tensor) -> str:
        """A hash of all that the labels depend on."""
        said = [
            VERSION,
            scene_key(self.scene),
            self.terrain.usual,
            self.grid.grid if self.grid else SUPPORT,
            self.known is not None,
        ]
        return hashlib.sha256(repr(said).encode() + x.numpy().tobytes()).hexdigest()[:32]


@contextmanager
def _shown(console: Console | None, count: int) -> Iterator[Progress]:
    if console is None:
        yield lambda what, done, whole: None
        return
    with console.status(f"least costs of curves from {count} points") as status:
        yield lambda what, done, whole: status.update(
            f"least costs of curves from {count} points: {what}, {done} of {whole}"
        )


def back_traced(grid: Reference, x: Tensor, step: float, difference: float) -> Curves:
    """From each point (N, D) down the slope of the grid's solution to the goal: a node each `step`, geodesically at the end.

    In the grid's own isothermal chart, where the steepest way is that of the plain gradient.
    """
    chart, goal = grid.place.chart, grid.goal
    time, y = grid.nearest_sheet(x)
    scene = grid.scene
    finite = time[time.isfinite()]
    if not len(finite):
        return Curves.between(x.numpy(), scene.goal.numpy())
    limit = int(TOO_LONG * float(finite.amax()) / (min(scene.law.free, scene.law.obstacle) * step)) + 8
    active = torch.nonzero(time.isfinite())[:, 0]
    trails, rows = [x], [torch.arange(len(x))]
    for _ in range(limit):
        away = (y[active] - goal).norm(dim=1)
        active = active[chart.factor(y[active]) * away > 1.5 * step]
        if not len(active):
            break
        here = y[active]
        scale = 1 / chart.factor(here)[:, None]
        there = here + step * scale * _downhill(grid, here, difference * scale)
        inside = grid.grid.contains(there)
        active, there = active[inside], there[inside]
        later = grid.in_chart(there)
        falls = later < time[active]
        active, there = active[falls], there[falls]
        y[active], time[active] = there, later[falls]
        trails.append(chart.point(there))
        rows.append(active)
    rows.append(torch.arange(len(x)))
    trails.append(scene.goal.expand_as(x))
    row = torch.cat(rows)
    order = row.argsort(stable=True)
    return Curves(torch.cat(trails)[order].numpy(), offsets_of(np.bincount(row.numpy(), minlength=len(x))))


def _downhill(grid: Reference, y: Tensor, difference: Tensor) -> Tensor:
    """Unit vectors (N, d) down the slope of the grid's solution in the chart, by central differences (N, 1)."""
    sides = [y[:, None] + sign * difference[:, None] * torch.eye(y.shape[1], dtype=y.dtype) for sign in (1, -1)]
    ahead, behind = (grid.in_chart(side.flatten(0, 1)).view(y.shape) for side in sides)
    slope = ahead - behind
    norm = slope.norm(dim=1, keepdim=True)
    return torch.where(norm > 0, -slope / torch.where(norm > 0, norm, 1.0), 0.0)
