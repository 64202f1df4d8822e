"""The figure of a field: the surface in space beside the flat view, with level lines, obstacles, paths and their cost.

What is shaded is pixels; all lines are vectors, hidden where the surface hides them. In more than two dimensions there are three
sections through the goal instead.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
import torch
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch, Polygon
from matplotlib.path import Path as Outline
from matplotlib.patheffects import withStroke
from matplotlib.ticker import FuncFormatter, MultipleLocator
from torch import Tensor

from rsrm_gen.errors import UserError
from rsrm_gen.files import write_whole
from rsrm_gen.manifold import Manifold
from rsrm_gen.trainer.evaluate import TimeFunction
from rsrm_gen.trainer.plan import Paths, plan
from rsrm_gen.trainer.run import load_run
from rsrm_gen.trainer.scene import Scene
from rsrm_gen.trainer.views.drawing import Drawing, Sheet, drawing_of, path_starts, runs
from rsrm_gen.trainer.views.hidden import Eye, Sight
from rsrm_gen.trainer.views.plane import Array, Plane
from rsrm_gen.trainer.views.render import COLOURS, OBSTACLE, flat_image, render
from rsrm_gen.trainer.views.shape import Shape

FINENESS = 240  # steps of the meshes
PIXELS = 640  # of what is shaded, on its longer side
PANEL = 2.9  # inches
INK = "#1b1b1e"
PATH = "#ff5a36"
HATCH = "#8f8a80"
FORMATS = (".pdf", ".png", ".svg")
STYLE: Any = {
    "font.family": "STIXGeneral",
    "mathtext.fontset": "stix",
    "font.size": 8.5,
    "axes.linewidth": 0.6,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "hatch.linewidth": 0.4,
    "pdf.fonttype": 42,  # TrueType, whole: what journals ask for
    "svg.fonttype": "none",
}


def draw_run(path: Path, output: Path | None = None, paths_from: int = 6, manifold: Manifold | None = None) -> Path:
    """Draw a trained field with paths from that many starts into `output`, or RUN/field.pdf and RUN/field.png.

    The file is returned, the PNG of the two; `manifold` stands in for the one the run's scene names.
    """
    if output is not None and output.suffix not in FORMATS:
        raise UserError(f"{output}: a figure is written as {', '.join(FORMATS)}", hint="give a name that ends so")
    run = load_run(path, manifold)
    starts = path_starts(run.scene, paths_from)
    paths = plan(run.arrival, run.scene, starts) if len(starts) else None
    figure = draw_field(run.scene, run.arrival.time, paths)
    files = [output] if output else [path / "field.pdf", path / "field.png"]
    for file in files:
        _save(figure, file)
    return files[-1]


def draw_field(scene: Scene, time: TimeFunction, paths: Paths | None = None) -> Figure:
    """The figure of T: `time` takes points (N, D) to T (N)."""
    drawing = drawing_of(scene, time, paths, FINENESS)
    if not drawing.sheets:
        raise UserError(f"figures need two dimensions or more; {scene.manifold.name} has {scene.manifold.dim}")
    with matplotlib.rc_context(STYLE):
        return _figure(drawing)


def _figure(drawing: Drawing) -> Figure:
    view = drawing.scene.picture.view
    natural = [drawing.own_shape] if drawing.own_shape and view in (None, "surface") else []
    if view == "surface" and not natural:
        raise UserError(f"a `surface` view needs a surface in space; {drawing.scene.manifold.name} has none")
    sheets = () if view == "surface" else drawing.sheets
    count = len(natural) + len(sheets)
    figure = Figure(figsize=(PANEL * count + 0.7, PANEL), layout="constrained")
    axes = [figure.add_subplot(1, count, i + 1) for i in range(count)]
    for ax, (shape, eye) in zip(axes, natural, strict=False):
        _draw_surface(ax, drawing, shape, eye)
    for ax, sheet in zip(axes[len(natural) :], sheets, strict=True):
        _draw_sheet(ax, drawing, sheet)
    _draw_bar(figure, axes, drawing.top)
    return figure


def _draw_surface(ax: Axes, drawing: Drawing, shape: Shape, eye: Eye) -> None:
    """The surface in space: shaded pixels, and on them the lines that are in sight."""
    sheet, scene = drawing.sheets[0], drawing.scene
    plane = sheet.mesh.plane
    rendering = render(sheet, shape, eye, drawing.top, PIXELS)
    ax.imshow(rendering.image, extent=rendering.extent, origin="lower", interpolation="bilinear", zorder=1)

    def seen(lines: Sequence[Tensor]) -> list[Array]:
        return [piece for line in lines for piece in _in_sight(eye, rendering.sight, shape.embed(line).numpy())]

    def on_surface(lines: Sequence[Array]) -> list[Array]:
        return seen([plane.point(plane.into(torch.from_numpy(line))) for line in lines])

    _lines(ax, on_surface(sheet.level_lines(scene, drawing.levels)), "white", 0.5, 2, alpha=0.75)
    _lines(ax, on_surface(sheet.outlines()), INK, 0.8, 3)
    if shape.closed:
        height, width = rendering.image.shape[:2]
        left, right, bottom, top = rendering.extent
        x, y = (np.arange(n) + 0.5 for n in (width, height))
        edge = rendering.image[..., 3]
        ax.contour(
            left + x * (right - left) / width,
            bottom + y * (top - bottom) / height,
            edge,
            [0.5],
            colors=INK,
            linewidths=0.6,
        )
    else:
        _lines(ax, on_surface([_fine(plane.rim * (1 - 1e-6))]), INK, 0.7, 3)
    paths = [path.double() for path in drawing.paths.points] if drawing.paths else []
    _draw_ways(ax, seen(paths))
    for start in paths:
        _mark(ax, seen([start[:1].expand(2, -1)]), "o", PATH, "white", 3.6)
    _mark(ax, seen([scene.goal.expand(2, -1)]), "*", "white", INK, 9)
    ax.set_aspect("equal")
    ax.set_axis_off()


def _in_sight(eye: Eye, sight: Sight, line: Array) -> list[Array]:
    """The pieces of a line (k, 3) in space that nothing hides, on the screen: (m, 2) each."""
    on_screen = eye.screen(line)
    return runs(on_screen[:, :2], sight.shows(on_screen))


def _fine(line: Array) -> Array:
    """A polygon's corners with points between them, so that it can bend: (k, 2)."""
    steps = np.linspace(0, 1, 8, endpoint=False)[:, None]
    return np.concatenate([line[:-1, None] * (1 - steps) + line[1:, None] * steps]).reshape(-1, 2)


def _draw_sheet(ax: Axes, drawing: Drawing, sheet: Sheet) -> None:
    """The flat view: colours, level lines, obstacles, paths with their cost."""
    plane = sheet.mesh.plane
    a, b = plane.half
    image = ax.imshow(
        flat_image(drawing, sheet, PIXELS), extent=(-a, a, -b, b), origin="lower", interpolation="bilinear"
    )
    drawn: list[Any] = [
        image,
        _lines(ax, sheet.level_lines(drawing.scene, drawing.levels), "white", 0.5, 2, alpha=0.75),
    ]
    drawn += _draw_obstacles(ax, sheet)
    paths = drawing.paths if not plane.section else None
    ways = [piece for path in (paths.points if paths else ()) for piece in plane.lines(path.double())]
    drawn += _draw_ways(ax, ways)
    if plane.round:
        rim = ax.add_patch(Polygon(plane.rim, closed=True, fill=False, edgecolor=INK, linewidth=0.8, zorder=4))
        for artist in drawn:
            artist.set_clip_path(rim)
    _frame(ax, plane)
    if paths:
        _draw_costs(ax, plane, paths)
    _mark(ax, [plane.coordinates(drawing.scene.goal[None]).numpy()], "*", "white", INK, 9)


def _draw_obstacles(ax: Axes, sheet: Sheet) -> list[Any]:
    """Areas with hatching, and their outlines."""
    areas = sheet.areas()
    if not areas:
        return []
    outline = Outline.make_compound_path(*(Outline(area, closed=False) for area in areas))
    patch = PathPatch(outline, facecolor=OBSTACLE, edgecolor=HATCH, hatch="/////", linewidth=0, zorder=3)
    return [ax.add_patch(patch), _lines(ax, sheet.outlines(), INK, 0.8, 4)]


def _draw_ways(ax: Axes, pieces: Sequence[Array]) -> list[Any]:
    return [_lines(ax, pieces, "white", 2.2, 5, alpha=0.85), _lines(ax, pieces, PATH, 1.2, 6)]


def _draw_costs(ax: Axes, plane: Plane, paths: Paths) -> None:
    """Where paths start, and beside it what they truly cost."""
    for points, cost, reached in zip(paths.points, paths.cost.tolist(), paths.reached.tolist(), strict=True):
        y, away = plane.beside(points.double())
        _mark(ax, [y[None]], "o", PATH, "white", 3.6)
        side = "left" if away[0] > 0.35 else "right" if away[0] < -0.35 else "center"
        level = "bottom" if away[1] > 0.35 else "top" if away[1] < -0.35 else "center"
        said = ax.annotate(
            f"{cost:.2f}" if reached else "stuck",
            (y[0], y[1]),
            xytext=(4.5 * away[0], 4.5 * away[1]),
            textcoords="offset points",
            ha=side,
            va=level,
            fontsize=7,
            color=INK,
            zorder=8,
            annotation_clip=False,
        )
        said.set_path_effects([withStroke(linewidth=1.6, foreground="white")])


def _lines(
    ax: Axes, pieces: Sequence[Array], colour: str, width: float, order: int, alpha: float = 1.0
) -> LineCollection:
    lines = LineCollection(list(pieces), colors=colour, linewidths=width, alpha=alpha, zorder=order, capstyle="round")
    ax.add_collection(lines, autolim=False)
    return lines


def _mark(ax: Axes, pieces: Sequence[Array], marker: str, colour: str, edge: str, size: float) -> None:
    """A symbol where the first piece starts; none where there is no piece."""
    for piece in pieces[:1]:
        ax.plot(
            *piece[:1].T,
            marker,
            color=colour,
            markersize=size,
            markeredgecolor=edge,
            markeredgewidth=0.7,
            zorder=7,
            clip_on=False,
        )


def _frame(ax: Axes, plane: Plane) -> None:
    a, b = plane.half
    ax.set_aspect("equal")
    margin = 0.02 if plane.round else 0.0
    ax.set_xlim(-a * (1 + margin), a * (1 + margin))
    ax.set_ylim(-b * (1 + margin), b * (1 + margin))
    if plane.round:
        ax.set_axis_off()
        if plane.section:
            ax.set_title(plane.title, fontsize=8)
        return
    for axis, side in ((ax.xaxis, a), (ax.yaxis, b)):
        axis.set_major_locator(MultipleLocator(side / 2))
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


def _draw_bar(figure: Figure, axes: list[Axes], top: float) -> None:
    colours = ScalarMappable(Normalize(0, top), matplotlib.colormaps[COLOURS])
    bar = figure.colorbar(colours, ax=axes, shrink=0.86, aspect=30, pad=0.02)
    bar.set_label("arrival time $T$ (slowness $\\times$ length)")
    bar.outline.set_linewidth(0.6)
    bar.ax.tick_params(width=0.6, length=2.5)


def _save(figure: Figure, path: Path) -> None:
    """Write a figure; the same field gives the same bytes."""
    kind = path.suffix[1:]
    dates: Any = {"pdf": {"CreationDate": None}, "svg": {"Date": None}}.get(kind)
    with matplotlib.rc_context({**STYLE, "svg.hashsalt": "field"}):
        write_whole(path, lambda file: figure.savefig(file, format=kind, dpi=300, metadata=dates))
