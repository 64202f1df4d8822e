"""The arrival time itself: the viscosity solution of |grad T|_g = s, T(goal) = 0, by factored fast marching.

In isothermal coordinates y (conformal.py) the equation is |dT/dy| = lambda s: an isotropic Eikonal equation on a plain
grid, which `eikonalfm` solves to second order with the point source factored out, T = |y - y_goal| * tau. Where
obstacles meet, the slowness has V-shaped valleys along which the order falls to about one; so the value used is the
Richardson extrapolation 2 T(h) - T(2h). Judge with this, never train with it.
"""

from __future__ import annotations

import hashlib
import json
import math
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
import torch
from rich.console import Console
from torch import Generator, Tensor

from rsrm_gen.errors import UserError
from rsrm_gen.files import cache_folder, write_whole
from rsrm_gen.trainer.conformal import ConformalChart, conformal_chart, random_directions
from rsrm_gen.trainer.scene import Ball, Scene

VERSION = 1  # of the solver: part of the name under which a solution is kept
CELLS = {2: 3072, 3: 160}  # intervals along the longest side of the fine grid
SURROUNDINGS = 1.15  # optimal paths leave a ball domain and come back: measured up to 1.08 of its radius
SAMPLES = 1 << 16
CAP = 0.3  # times 1/sqrt(curvature): what is left out around the point at infinity of a closed manifold
SLOW = 2.0  # times the free slowness: such obstacles are not worth crossing, at least not in the middle
WINDING = 1.8  # times the radius of the cut locus in the chart: how far the second sheet of the cover is solved
RIM = 192  # points of the cap's rim, per dimension of the rim
CHUNK = 1 << 18

Array = np.ndarray[Any, Any]


@dataclass(frozen=True)
class Grid:
    """The nodes low + step * index of a box in the chart; the goal is one of them."""

    low: tuple[float, ...]
    step: float
    shape: tuple[int, ...]
    source: tuple[int, ...]

    def nodes(self, flat: Tensor) -> Tensor:
        """The coordinates (N, d) of the nodes with these flat indices (N)."""
        index = torch.stack(torch.unravel_index(flat, self.shape), -1)
        return torch.tensor(self.low, dtype=torch.float64) + self.step * index

    def coarser(self) -> Grid:
        """Every second node of each axis."""
        shape = tuple((n + 1) // 2 for n in self.shape)
        return Grid(self.low, 2 * self.step, shape, tuple(i // 2 for i in self.source))

    def index(self, y: Tensor) -> Tensor:
        """The fractional index (..., d) of the coordinates y (..., d)."""
        return (y - torch.tensor(self.low, dtype=y.dtype)) / self.step

    def contains(self, y: Tensor) -> Tensor:
        """Which of the coordinates (..., d) lie in the box: (...)."""
        index, last = self.index(y), torch.tensor(self.shape, dtype=y.dtype) - 1
        return ((index >= 0) & (index <= last)).all(-1)


@dataclass(frozen=True)
class Place:
    """A chart, how far along each of its axes to solve, and beyond which radius the metric goes on as it was there."""

    chart: ConformalChart
    reach: Tensor  # (d,)
    edge: float
    note: str


@dataclass(frozen=True)
class Reference:
    """A reference solution and how far it is from the truth, by its own account."""

    scene: Scene
    place: Place
    goal: Tensor  # (d,), its coordinates
    grid: Grid
    coefficients: Array  # of the cubic spline through T / |y - goal| on the grid
    error: float  # RMS over free space of what the last refinement of the grid changed
    max_error: float
    note: str

    def time(self, x: Tensor) -> Tensor:
        """T (N) in float64 at the points x (N, D); NaN outside what was solved."""
        x = x.detach().double().cpu()
        time, _ = self.nearest_sheet(x)
        missing = time.isinf()
        if bool(missing.any()) and self.place.chart.closed_by_a_point:
            time[missing] = self._across_cap(x[missing])
        return torch.where(time.isinf(), torch.nan, time)

    def nearest_sheet(self, x: Tensor) -> tuple[Tensor, Tensor]:
        """The least value (N) at the preimages in the box, `inf` where there is none, and the preimage (N, d)."""
        copies = self.place.chart.preimages(self.place.chart.coordinates(x))
        inside = self.grid.contains(copies)
        times = torch.full(copies.shape[:-1], torch.inf, dtype=torch.float64)
        times[inside] = self.in_chart(copies[inside])
        time, sheet = times.min(0)
        return time, copies[sheet, torch.arange(len(x))]

    def in_chart(self, y: Tensor) -> Tensor:
        """T (N) at coordinates (N, d) in the box."""
        away: Tensor = (y - self.goal).norm(dim=-1)
        return _spline(self.coefficients, self.grid.index(y)) * away

    def _across_cap(self, x: Tensor) -> Tensor:
        """Into the cap that the chart leaves out: along the best geodesic from its rim."""
        y = self.place.chart.coordinates(x)
        nearest = y / y.norm(dim=-1, keepdim=True)
        time = self._from_rim(nearest, x)
        for part in torch.split(torch.arange(len(x)), 64):
            time[part] = torch.minimum(time[part], self._from_rim(_rim(len(self.goal)), x[part, None]).amin(1))
        return time

    def _from_rim(self, direction: Tensor, x: Tensor) -> Tensor:
        """T at the rim in these directions (n, d), and on by geodesics to x (..., D)."""
        y = direction * self.place.reach.min() * (1 - 1e-12)
        return self.in_chart(y) + _geodesic_cost(self.scene, self.place.chart.point(y), x)


def _rim(dim: int) -> Tensor:
    """Directions (n, dim) all around, evenly where that is easy."""
    if dim > 2:
        return random_directions(RIM * (dim - 1), dim)
    angle = 2 * math.pi * torch.arange(RIM, dtype=torch.float64) / RIM
    return torch.stack([angle.cos(), angle.sin()], -1)


def solve_reference(scene: Scene, cells: int | None = None, console: Console | None = None) -> Reference:
    """The reference solution of a scene, from the cache when it was computed before.

    `cells`: intervals along the longest side of the finest grid. A manifold without a conformal chart is a `UserError`.
    """
    if scene.manifold.dim not in CELLS:
        raise UserError(f"reference solutions are computed in 2 and 3 dimensions, not in {scene.manifold.dim}")
    if any(find_spec(name) is None for name in ("eikonalfm", "scipy")):
        raise UserError("the reference solver is not installed", hint="pip install 'rsrm-gen[reference]'")
    scene = scene.in_double()
    place = _place(scene)
    goal = place.chart.coordinates(scene.goal)
    grid = _grid(goal, place.reach, cells or CELLS[scene.manifold.dim])
    path = cache_folder() / f"{_key(scene, grid)}.npz"
    stored = _read(path)
    if stored is None:
        with _progress(console, grid):
            factor, errors = _solve(scene, place, goal, grid)
            write_whole(path, lambda file: np.savez(file, factor=factor, errors=errors))
        stored = _read(path)
        if stored is None:
            raise UserError(f"the cache folder {path.parent} does not give back what was written to it")
    factor, errors = stored
    nodes = " x ".join(str(n) for n in grid.shape)
    note = f"factored fast marching, {nodes} nodes, extrapolated; {place.note}"
    coefficients = _coefficients(factor)
    return Reference(scene, place, goal, grid.coarser(), coefficients, float(errors[0]), float(errors[1]), note)


def _place(scene: Scene) -> Place:
    chart = conformal_chart(scene.manifold, scene.goal)
    if chart.antipodal:
        reach = WINDING * chart.radius(scene.manifold.injectivity_radius)
        return Place(chart, reach.expand(scene.manifold.dim), math.inf, "both sheets of the double cover")
    if len(chart.periods):
        return _place_periodic(scene, chart)
    if scene.domain is not None:
        return _place_ball(scene, scene.domain)
    if chart.closed_by_a_point:
        return _place_closed(scene, chart)
    raise UserError("a reference on a manifold that is not compact needs the scene to have a `domain`")


def _place_periodic(scene: Scene, chart: ConformalChart) -> Place:
    """One period to each side of the goal, in the universal cover."""
    reach = chart.periods.abs().sum(0)
    if scene.domain is not None:
        ball = SURROUNDINGS * scene.domain.radius + scene.manifold.distance(scene.domain.center, scene.goal)
        reach = torch.where(reach > 0, reach, ball)
    if not bool((reach > 0).all()):
        raise UserError("a reference on a manifold that is not compact needs the scene to have a `domain`")
    return Place(chart, reach, math.inf, "one period to each side of the goal")


def _place_ball(scene: Scene, domain: Ball) -> Place:
    chart = conformal_chart(scene.manifold, domain.center)
    largest = scene.manifold.injectivity_radius
    if chart.closed_by_a_point:
        largest -= CAP / math.sqrt(chart.curvature)
    r = min(SURROUNDINGS * domain.radius, largest)
    reach = chart.radius(r)
    # Only where space ends in the chart (negative curvature) must the corners of the box be filled with something.
    edge = float(reach) if chart.curvature < 0 else math.inf
    note = f"the ball of radius {domain.radius:.4g} with its surroundings to {r:.4g}: optimal paths may leave it"
    return Place(chart, reach.expand(scene.manifold.dim), edge, note)


def _place_closed(scene: Scene, chart: ConformalChart) -> Place:
    """The point at infinity goes deepest into an obstacle, where no optimal path between free points passes."""
    manifold, cap = scene.manifold, CAP / math.sqrt(chart.curvature)
    depth = scene.radii - cap
    beyond = manifold.distance(scene.centers, scene.goal) > scene.radii + cap
    usable = torch.where(beyond, depth, -torch.inf) if len(depth) else depth
    note = f"a cap of radius {cap:.2g} opposite the goal is bridged by geodesics"
    if len(depth) and float(usable.max()) > 0 and scene.law.obstacle > SLOW * scene.law.free:
        c = scene.centers[int(usable.argmax())]
        chart = conformal_chart(manifold, manifold.exp(c, manifold.diameter * manifold.frame(c)[0]))
        note = f"a cap of radius {cap:.2g} inside an obstacle is bridged by geodesics"
    reach = chart.radius(manifold.diameter - cap)
    return Place(chart, reach.expand(manifold.dim), math.inf, note)


def _grid(goal: Tensor, reach: Tensor, cells: int) -> Grid:
    """The box from -reach to reach, a little widened so that the goal is a node on three nested levels."""
    step = float(2 * reach.max()) / cells
    below = 4 * torch.ceil((reach + goal) / (4 * step) - 1e-9).long()
    above = 4 * torch.ceil((reach - goal) / (4 * step) - 1e-9).long()
    low = goal - step * below
    return Grid(tuple(low.tolist()), step, tuple((below + above + 1).tolist()), tuple(below.tolist()))


def _solve(scene: Scene, place: Place, goal: Tensor, grid: Grid) -> tuple[Array, Array]:
    """The extrapolated T / |y - goal| on every second node, and its errors by `_errors`."""
    velocity, half, quarter = _velocity(scene, place, grid), grid.coarser(), grid.coarser().coarser()
    fine = _march(velocity, grid)
    middle = _march(_every_second(velocity), half)
    coarse = _march(_every_second(_every_second(velocity)), quarter)
    factor = 2 * _every_second(fine) - middle
    change = _every_second(factor) - (2 * _every_second(middle) - coarse)
    solved = Reference(scene, place, goal, half, _coefficients(factor), 0.0, 0.0, "")
    return factor.astype(np.float32), _errors(solved, change, quarter)


def _velocity(scene: Scene, place: Place, grid: Grid) -> Array:
    """1 / (lambda s) at the nodes."""
    velocity = np.empty(math.prod(grid.shape))
    for start in range(0, velocity.size, CHUNK):
        y = grid.nodes(torch.arange(start, min(start + CHUNK, velocity.size)))
        y = y * (place.edge / y.norm(dim=-1, keepdim=True).clamp_min(1e-300)).clamp_max(1.0)
        cost = place.chart.factor(y) * scene.slowness(place.chart.point(y))
        velocity[start : start + len(y)] = 1 / cost.numpy()
    return velocity.reshape(grid.shape)


def _march(velocity: Array, grid: Grid) -> Array:
    """T / |y - goal| on the grid: first arrivals, second-order differences."""
    import eikonalfm

    tau: Array = eikonalfm.factored_fast_marching(velocity, grid.source, [grid.step] * velocity.ndim, 2)
    return tau


def _every_second(values: Array) -> Array:
    return np.ascontiguousarray(values[(slice(None, None, 2),) * values.ndim])


def _errors(solved: Reference, change: Array, grid: Grid) -> Array:
    """RMS and maximum, over points uniform in free space, of what the last refinement of the grid changed.

    Measured along valleys, the worst case, each refinement changes T by a little more than half of what the one before
    did: so this is about the error that is left, and several times too large where the solution is smooth.
    """
    scene = solved.scene
    x = scene.sample(SAMPLES, Generator().manual_seed(0))
    time, y = solved.nearest_sheet(x[scene.signed_distance(x) >= 0])
    y = y[time.isfinite()]
    error = _spline(_coefficients(change), grid.index(y)) * (y - solved.goal).norm(dim=-1)
    return np.array([error.square().mean().sqrt(), error.abs().max()])


def _coefficients(values: Array) -> Array:
    """Cubic B-spline coefficients of values on a grid."""
    from scipy.ndimage import spline_filter

    coefficients: Array = spline_filter(values, order=3, output=np.float64, mode="mirror")
    return coefficients


def _spline(coefficients: Array, index: Tensor) -> Tensor:
    """The cubic spline at fractional indices (N, d): (N)."""
    from scipy.ndimage import map_coordinates

    return torch.from_numpy(map_coordinates(coefficients, index.numpy().T, order=3, mode="mirror", prefilter=False))


def _geodesic_cost(scene: Scene, start: Tensor, end: Tensor) -> Tensor:
    """The integral of s along the geodesics from start to end (..., D): (...), by Gauss quadrature."""
    node, weight = (torch.from_numpy(a) for a in np.polynomial.legendre.leggauss(12))
    v = scene.manifold.log(start, end)
    way = scene.manifold.exp(start.unsqueeze(-2), (1 + node[:, None]) / 2 * v.unsqueeze(-2))
    return scene.manifold.distance(start, end) * (scene.slowness(way) * weight / 2).sum(-1)


def _key(scene: Scene, grid: Grid) -> str:
    """A hash of all that the solution depends on."""
    said = {"version": VERSION, **scene_key(scene), "grid": [grid.low, grid.step, grid.shape]}
    return hashlib.sha256(json.dumps(said, sort_keys=True).encode()).hexdigest()[:32]


def scene_key(scene: Scene) -> dict[str, Any]:
    """All of a scene that its arrival time depends on, as plain data."""
    return {
        "manifold": [scene.manifold.name, scene.manifold.content_hash],
        "goal": scene.goal.tolist(),
        "obstacles": [scene.centers.tolist(), scene.radii.tolist()],
        "slowness": scene.law.model_dump(),
        "domain": scene.domain and [scene.domain.center.tolist(), scene.domain.radius],
    }


def _read(path: Path) -> tuple[Array, Array] | None:
    """What was kept; None when nothing readable was."""
    try:
        with path.open("rb") as opened, np.load(opened, allow_pickle=False) as file:
            return file["factor"], file["errors"]
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile):
        return None


@contextmanager
def _progress(console: Console | None, grid: Grid) -> Iterator[None]:
    if console is None:
        yield
        return
    nodes = " x ".join(str(n) for n in grid.shape)
    with console.status(f"reference solution on {nodes} nodes (once; it is kept in {cache_folder()})"):
        yield
