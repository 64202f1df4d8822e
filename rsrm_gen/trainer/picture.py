"""The picture of a field: colours and level lines of T, obstacles, the goal, and paths to it.

A view is a grid of pixels, each with the point of the manifold it shows: a periodic chart, the disc of a ball domain in
isothermal coordinates, or a closed surface in space seen from two opposite sides. What is drawn on it is the same
for all.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import matplotlib
import numpy as np
import torch
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Colormap, Normalize, to_rgb
from matplotlib.figure import Figure
from matplotlib.patches import Polygon
from matplotlib.ticker import FuncFormatter, MaxNLocator, MultipleLocator
from matplotlib.tri import LinearTriInterpolator, Triangulation
from torch import Generator, Tensor

from rsrm_gen.errors import UserError
from rsrm_gen.files import write_whole
from rsrm_gen.manifold import Manifold
from rsrm_gen.trainer.conformal import conformal_chart
from rsrm_gen.trainer.evaluate import TimeFunction, values
from rsrm_gen.trainer.plan import plan
from rsrm_gen.trainer.run import load_run
from rsrm_gen.trainer.scene import Ball, Scene

View = Literal["chart", "disk", "surface"]
Array = np.ndarray[Any, Any]
PointMap = Callable[[Tensor], Tensor]

PIXELS = 321
LEVELS = 16
INK = "#1b1b1e"
PATH = "#ff5a36"
OBSTACLE = "#f4f2ee"
HATCH = "#8f8a80"
STYLE: Any = {
    "font.family": "STIXGeneral",
    "mathtext.fontset": "stix",
    "font.size": 9,
    "axes.linewidth": 0.6,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "hatch.linewidth": 0.4,
}


@dataclass(frozen=True)
class Canvas:
    """One view: H x W pixels that show points, and where points of the manifold are drawn."""

    points: Tensor  # (H, W, D)
    extent: tuple[float, float, float, float]  # of the pixels' centres: left, right, bottom, top
    plane: PointMap  # points (N, D) to the plane (N, 2); NaN where they are hidden
    outline: Array | None  # (n, 2), the polygon beyond which nothing is drawn; None: the frame of the axes
    shade: Array | None  # (H, W) in [0, 1], the light on the surface
    periods: tuple[float, float] | None  # of the plane, to break lines at the seam


def draw_run(path: Path, paths_from: int = 6, manifold: Manifold | None = None) -> Path:
    """Draw a trained field with paths from that many starts: RUN/field.pdf, and RUN/field.png, which is returned."""
    run = load_run(path, manifold)
    starts = path_starts(run.scene, paths_from)
    paths = plan(run.arrival, run.scene, starts).points if paths_from else ()
    figure = draw_scene_field(run.scene, run.arrival.time, paths)
    for name in ("field.pdf", "field.png"):
        _save(figure, path / name)
    return path / "field.png"


def draw_scene_field(
    scene: Scene, time: TimeFunction, paths: Sequence[Tensor] = (), view: View | None = None
) -> Figure:
    """The picture of T as a figure: `time` takes points (N, D) to T (N), each path is (m, D)."""
    exact = scene.in_double()
    canvases = _canvases(exact, view or scene.picture.view or default_view(scene))
    shown = [canvas.points.reshape(-1, scene.manifold.point_size) for canvas in canvases]
    fields = [
        values(time, x, scene).reshape(canvas.points.shape[:2]) for x, canvas in zip(shown, canvases, strict=True)
    ]
    free = [exact.signed_distance(canvas.points) >= 0 for canvas in canvases]
    top = max(float(field[where & field.isfinite()].max()) for field, where in zip(fields, free, strict=True))
    with matplotlib.rc_context(STYLE):
        figure, axes = _figure(canvases)
        for ax, canvas, field in zip(axes, canvases, fields, strict=True):
            _paint(ax, exact, canvas, field.numpy(), top)
            _draw_paths(ax, canvas, [path.double() for path in paths])
            _draw_goal(ax, canvas, exact.goal)
        _draw_bar(figure, axes, top)
    return figure


def default_view(scene: Scene) -> View:
    """The view that fits the manifold and the domain."""
    periods = scene.manifold.periods
    if scene.domain is not None:
        return "disk"
    return "chart" if periods is not None and None not in periods else "surface"


def path_starts(scene: Scene, count: int) -> Tensor:
    """Free points (count, D), each as far as possible from the goal and from those before it."""
    x = scene.sample(4096, Generator().manual_seed(0))
    x = x[scene.signed_distance(x) > scene.law.width]
    away = scene.manifold.distance(x, scene.goal)
    starts: list[Tensor] = []
    for _ in range(count if len(x) else 0):
        starts.append(x[int(away.argmax())])
        away = torch.minimum(away, scene.manifold.distance(x, starts[-1]))
    return torch.stack(starts) if starts else x[:0]


def _canvases(scene: Scene, view: View) -> list[Canvas]:
    manifold = scene.manifold
    if manifold.dim != 2:
        raise UserError(f"pictures are drawn in two dimensions; {manifold.name} has {manifold.dim}")
    if view == "chart":
        return [_chart_canvas(scene)]
    if view == "disk":
        ball = scene.domain or Ball(scene.goal, manifold.injectivity_radius)
        return [_disk_canvas(manifold, ball)]
    if manifold.point_size != 3 or not math.isfinite(manifold.diameter):
        raise UserError(f"a `surface` view needs a closed surface in space; {manifold.name} is none")
    toward = _view_direction(scene)
    return [_surface_canvas(manifold, scene.goal, direction) for direction in (toward, -toward)]


def _pixels(left: float, right: float, bottom: float, top: float) -> Tensor:
    """Positions in the plane: (H, W, 2)."""
    x = torch.linspace(left, right, PIXELS, dtype=torch.float64)
    y = torch.linspace(bottom, top, PIXELS, dtype=torch.float64)
    return torch.stack(torch.meshgrid(x, y, indexing="xy"), -1)


def _chart_canvas(scene: Scene) -> Canvas:
    """One period of each coordinate, around zero."""
    periods = [period for period in scene.manifold.periods or () if period is not None]
    if len(periods) != 2:
        raise UserError("a `chart` view needs two coordinates that are both periodic")
    a, b = periods
    extent = (-a / 2, a / 2, -b / 2, b / 2)
    points = scene.manifold.project(_pixels(*extent))
    return Canvas(points, extent, lambda x: x, None, None, (a, b))


def _disk_canvas(manifold: Manifold, ball: Ball) -> Canvas:
    """The ball in isothermal coordinates around its centre; in normal coordinates where there are none."""
    point, plane, radius = _coordinates(manifold, ball)
    y = _pixels(-radius, radius, -radius, radius)
    inside = y * (radius / y.norm(dim=-1, keepdim=True).clamp_min(radius))
    angle = np.linspace(0, 2 * np.pi, 721)
    rim = radius * np.stack([np.cos(angle), np.sin(angle)], -1)
    return Canvas(point(inside), (-radius, radius, -radius, radius), plane, rim, None, None)


def _coordinates(manifold: Manifold, ball: Ball) -> tuple[PointMap, PointMap, float]:
    """From the plane to the ball, back, and the ball's radius in the plane."""
    center, frame = ball.center, manifold.frame(ball.center)
    try:
        chart = conformal_chart(manifold, center)
    except UserError:
        return (
            lambda y: manifold.exp(center, y @ frame),
            lambda x: manifold.inner(center, manifold.log(center, x).unsqueeze(-2), frame),
            ball.radius,
        )
    return chart.point, chart.coordinates, float(chart.radius(ball.radius))


def _view_direction(scene: Scene) -> Tensor:
    """A unit vector (3) toward the eye: the goal is well in sight, and of the obstacles as much as can be."""
    middle = _surface_mesh(scene.manifold, scene.goal, 24).mean(0)
    goal = torch.nn.functional.normalize(scene.goal - middle, dim=0)
    others = torch.nn.functional.normalize(scene.centers - middle, dim=-1).sum(0)
    sideways = others - (others @ goal) * goal
    if float(sideways.norm()) < 1e-6:
        sideways = scene.manifold.frame(scene.goal)[0]
    return math.cos(0.8) * goal + math.sin(0.8) * torch.nn.functional.normalize(sideways, dim=0)


def _surface_mesh(manifold: Manifold, pole: Tensor, rings: int) -> Tensor:
    """Points (n, 3) all over a closed surface: geodesic circles around the pole."""
    r = torch.linspace(0, manifold.injectivity_radius, rings + 1, dtype=torch.float64)[1:, None, None]
    angle = torch.linspace(0, 2 * math.pi, 4 * rings + 1, dtype=torch.float64)[:-1]
    directions = torch.stack([angle.cos(), angle.sin()], -1) @ manifold.frame(pole)
    return torch.cat([pole[None], manifold.exp(pole, r * directions).reshape(-1, 3)])


def _surface_canvas(manifold: Manifold, goal: Tensor, toward: Tensor) -> Canvas:
    """The side of a closed surface that faces the eye, in parallel projection."""
    coarse = _surface_mesh(manifold, goal, 24)
    middle = coarse.mean(0)
    mesh = _surface_mesh(manifold, coarse[int((coarse @ toward).argmax())], 80)
    screen = _screen(toward)
    front = mesh[_normals(manifold, mesh, middle) @ toward >= -1e-9]
    outline = _outline((front @ screen.T).numpy())
    low, high = outline.min(0), outline.max(0)
    extent = (float(low[0]), float(high[0]), float(low[1]), float(high[1]))
    points = manifold.project(_lift(front, screen, _clamp(_pixels(*extent).numpy(), outline)))
    normals = _normals(manifold, points, middle)

    def plane(x: Tensor) -> Tensor:
        hidden = _normals(manifold, x, middle) @ toward < 0
        return torch.where(hidden[:, None], torch.nan, x @ screen.T)

    light = torch.nn.functional.normalize(toward + 0.6 * screen[1] - 0.45 * screen[0], dim=0)
    shade = (normals @ light).clamp(0, 1).numpy()
    return Canvas(points, extent, plane, outline, shade, None)


def _screen(toward: Tensor) -> Tensor:
    """Unit vectors (2, 3) to the right and up on the screen; the third axis of space points up."""
    up = torch.eye(3, dtype=torch.float64)[2 if abs(float(toward[2])) < 0.99 else 1]
    right = torch.nn.functional.normalize(torch.linalg.cross(up, toward), dim=0)
    return torch.stack([right, torch.linalg.cross(toward, right)])


def _normals(manifold: Manifold, x: Tensor, middle: Tensor) -> Tensor:
    """Unit normals (..., 3) that point away from the middle."""
    frame = manifold.frame(x)
    normal = torch.nn.functional.normalize(torch.linalg.cross(frame[..., 0, :], frame[..., 1, :]), dim=-1)
    outward = ((x - middle) * normal).sum(-1, keepdim=True) >= 0
    return torch.where(outward, normal, -normal)


def _outline(seen: Array) -> Array:
    """The convex outline (n, 2) of points in the plane: the farthest one in each direction."""
    angle = np.linspace(0, 2 * np.pi, 721)
    farthest = np.argmax(seen @ np.stack([np.cos(angle), np.sin(angle)]), axis=0)
    outline: Array = seen[farthest]
    return outline


def _clamp(pixels: Array, outline: Array) -> Array:
    """Pixels (H, W, 2) outside the outline moved onto it, so that every pixel shows a point."""
    middle = outline.mean(0)
    away, rim = pixels - middle, outline - middle
    limit = np.interp(
        np.arctan2(away[..., 1], away[..., 0]),
        *_by_angle(np.arctan2(rim[:, 1], rim[:, 0]), np.linalg.norm(rim, axis=1)),
        period=2 * np.pi,
    )
    scale = np.minimum(1, 0.9995 * limit / np.maximum(np.linalg.norm(away, axis=-1), 1e-12))
    clamped: Array = middle + away * scale[..., None]
    return clamped


def _by_angle(angle: Array, radius: Array) -> tuple[Array, Array]:
    order = np.unique(angle, return_index=True)[1]
    return angle[order], radius[order]


def _lift(front: Tensor, screen: Tensor, pixels: Array) -> Tensor:
    """The points of the surface that the pixels show, interpolated between those of the front side: (H, W, 3)."""
    seen = (front @ screen.T).numpy()
    mesh = Triangulation(seen[:, 0], seen[:, 1])
    found = [LinearTriInterpolator(mesh, axis)(pixels[..., 0], pixels[..., 1]) for axis in front.T.numpy()]
    return torch.from_numpy(np.stack([np.ma.filled(part, np.nan) for part in found], -1))


def _figure(canvases: list[Canvas]) -> tuple[Figure, list[Axes]]:
    count = len(canvases)
    figure = Figure(figsize=(4.6, 3.9) if count == 1 else (7.2, 3.5), layout="constrained")
    axes = [figure.add_subplot(1, count, i + 1) for i in range(count)]
    for ax, canvas in zip(axes, canvases, strict=True):
        _frame(ax, canvas)
    return figure, axes


def _frame(ax: Axes, canvas: Canvas) -> None:
    left, right, bottom, top = canvas.extent
    ax.set_aspect("equal")
    if canvas.outline is not None:
        margin = 0.02 * (right - left)
        ax.set_xlim(left - margin, right + margin)
        ax.set_ylim(bottom - margin, top + margin)
        ax.set_axis_off()
        return
    ax.set_xlim(left, right)
    ax.set_ylim(bottom, top)
    for axis, period in ((ax.xaxis, right - left), (ax.yaxis, top - bottom)):
        axis.set_major_locator(MultipleLocator(period / 4))
        axis.set_major_formatter(FuncFormatter(_multiple_of_pi))


def _multiple_of_pi(value: float, _: object = None) -> str:
    """`pi / 2` where a value is that; the number where it is no simple multiple."""
    for denominator in (1, 2, 3, 4):
        numerator = value / math.pi * denominator
        if abs(numerator - round(numerator)) < 1e-9:
            return _fraction_of_pi(round(numerator), denominator)
    return f"{value:.3g}".replace("-", "\N{MINUS SIGN}")


def _fraction_of_pi(numerator: int, denominator: int) -> str:
    if numerator == 0:
        return "$0$"
    sign, size = "-" if numerator < 0 else "", abs(numerator)
    top = r"\pi" if size == 1 else rf"{size}\pi"
    return f"${sign}{top}$" if denominator == 1 else f"${sign}{top}/{denominator}$"


def _paint(ax: Axes, scene: Scene, canvas: Canvas, field: Array, top: float) -> None:
    """Colours, level lines and obstacles, clipped to the outline."""
    left, right, bottom, upper = canvas.extent
    x, y = np.linspace(left, right, PIXELS), np.linspace(bottom, upper, PIXELS)
    sdf = scene.signed_distance(canvas.points).numpy()
    half_x, half_y = (x[1] - x[0]) / 2, (y[1] - y[0]) / 2
    extent = (left - half_x, right + half_x, bottom - half_y, upper + half_y)
    image = ax.imshow(_colours(canvas, field, sdf, top), extent=extent, origin="lower", interpolation="bilinear")
    free = np.ma.masked_where(~np.isfinite(field) | (sdf < 0), field)
    lines = ax.contour(x, y, free, _levels(top), colors="white", linewidths=0.45, alpha=0.75, zorder=2)
    drawn: list[Any] = [image, lines]
    if sdf.min() < 0:
        drawn += _draw_obstacles(ax, x, y, np.minimum(sdf, 1e6))
    if canvas.outline is not None:
        rim = ax.add_patch(Polygon(canvas.outline, closed=True, fill=False, edgecolor=INK, linewidth=0.8, zorder=4))
        for artist in drawn:
            artist.set_clip_path(rim)


def _draw_obstacles(ax: Axes, x: Array, y: Array, sdf: Array) -> list[Any]:
    """Hatching, and the zero level of the signed distance."""
    hatch = ax.contourf(x, y, sdf, [sdf.min() - 1, 0], colors="none", hatches=["/////"], zorder=3)
    hatch.set_edgecolor(HATCH)
    hatch.set_linewidth(0)
    edge = ax.contour(x, y, sdf, [0.0], colors=INK, linewidths=0.9, zorder=4)
    return [hatch, edge]


def _levels(top: float) -> Array:
    """Round, evenly spaced values of T, about as many as LEVELS."""
    levels = np.asarray(MaxNLocator(LEVELS, steps=[1, 2, 2.5, 5, 10]).tick_values(0, top))
    inner: Array = levels[(levels > 0) & (levels < top)]
    return inner


def _colour_map() -> Colormap:
    return matplotlib.colormaps["viridis"]


def _colours(canvas: Canvas, field: Array, sdf: Array, top: float) -> Array:
    """The pixels' colours (H, W, 3): T in free space, one colour in obstacles, in the light where there is one."""
    colours = _colour_map()(Normalize(0, top)(np.nan_to_num(field, nan=top, posinf=top)))[..., :3]
    colours = np.where(sdf[..., None] < 0, to_rgb(OBSTACLE), colours)
    if canvas.shade is None:
        return colours
    lit: Array = np.clip(colours * (0.8 + 0.22 * canvas.shade[..., None]), 0, 1)
    return lit


def _draw_paths(ax: Axes, canvas: Canvas, paths: Sequence[Tensor]) -> None:
    for path in paths:
        line = _broken_at_seams(canvas.plane(path).numpy(), canvas.periods)
        ax.plot(*line.T, color="white", linewidth=2.4, alpha=0.85, solid_capstyle="round", zorder=5)
        ax.plot(*line.T, color=PATH, linewidth=1.3, solid_capstyle="round", zorder=5)
        start = canvas.plane(path[:1]).numpy()
        ax.plot(*start.T, "o", color=PATH, markersize=4, markeredgecolor="white", markeredgewidth=0.7, zorder=6)


def _broken_at_seams(line: Array, periods: tuple[float, float] | None) -> Array:
    """A line (m, 2) with a gap wherever it jumps by a period."""
    if periods is None:
        return line
    jumps = np.flatnonzero((np.abs(np.diff(line, axis=0)) > np.array(periods) / 2).any(1)) + 1
    return np.insert(line, jumps, np.nan, axis=0)


def _draw_goal(ax: Axes, canvas: Canvas, goal: Tensor) -> None:
    at = canvas.plane(goal[None]).numpy()
    ax.plot(*at.T, "*", color="white", markersize=11, markeredgecolor=INK, markeredgewidth=0.8, zorder=7)


def _draw_bar(figure: Figure, axes: list[Axes], top: float) -> None:
    colours = ScalarMappable(Normalize(0, top), _colour_map())
    bar = figure.colorbar(colours, ax=axes, shrink=0.86, aspect=30, pad=0.025)
    bar.set_label("arrival time $T$")
    bar.outline.set_linewidth(0.6)
    bar.ax.tick_params(width=0.6, length=2.5)


def _save(figure: Figure, path: Path) -> None:
    with matplotlib.rc_context(STYLE):
        write_whole(path, lambda file: figure.savefig(file, format=path.suffix[1:], dpi=200))
