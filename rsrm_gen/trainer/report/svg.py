"""Vector drawings of the page: the flat view of the field, and curves."""

from __future__ import annotations

import base64
import io
import math
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

import matplotlib.image
import numpy as np
from matplotlib.ticker import LogLocator, MaxNLocator

from rsrm_gen.trainer.model import SplatField
from rsrm_gen.trainer.views.drawing import Drawing, Sheet, splat_outlines
from rsrm_gen.trainer.views.plane import Array
from rsrm_gen.trainer.views.render import flat_image

SIZE = 520.0  # of a flat view's longer side
MARGIN = 30  # around a disc, for what is written at its rim
PIXELS = 360  # of the colours below it
WIDTH, HEIGHT = 380, 240  # of curves
LEFT, RIGHT, BOTTOM, ABOVE = 52, 12, 40, 10  # margins around curves


@dataclass(frozen=True)
class Curve:
    """A line through (x, y), with a text for each point that is shown when one asks for it."""

    name: str
    x: Sequence[float]
    y: Sequence[float]
    notes: Sequence[str]


def png(image: Array) -> str:
    """An image (H, W, 3 or 4) in [0, 1], the first row below, as a data address."""
    file = io.BytesIO()
    matplotlib.image.imsave(file, np.ascontiguousarray(np.clip(image, 0, 1)), origin="lower", format="png")
    return "data:image/png;base64," + base64.b64encode(file.getvalue()).decode()


def flat_view(drawing: Drawing, number: int, field: SplatField) -> str:
    """A flat view of the field: colours, level lines, obstacles, splats, paths, goal."""
    sheet = drawing.sheets[number]
    plane = sheet.mesh.plane
    frame = _Frame(plane.half)
    margin = MARGIN if plane.round and not plane.section else 8
    box = f"{-margin} {-margin} {frame.width + 2 * margin:.0f} {frame.height + 2 * margin:.0f}"
    clip = f"clip{number}"
    parts = [
        f'<svg class="flat" viewBox="{box}" data-sheet="{number}" role="img" aria-label="{escape(plane.title)}">',
        f'<defs><clipPath id="{clip}"><path d="{frame.path([plane.rim])}Z"/></clipPath>',
        '<pattern id="hatch" width="7" height="7" patternUnits="userSpaceOnUse" patternTransform="rotate(45)">'
        '<rect width="7" height="7" class="stone"/><path d="M0 0V7" class="hatching"/></pattern></defs>',
        f'<g clip-path="url(#{clip})">',
        f'<image width="{frame.width:.1f}" height="{frame.height:.1f}" preserveAspectRatio="none" '
        f'href="{png(flat_image(drawing, sheet, PIXELS))}"/>',
        f'<path class="levels" d="{frame.path(sheet.level_lines(drawing.scene, drawing.levels))}"/>',
        f'<path class="obstacle" d="{frame.path(sheet.areas())}"/>',
        f'<path class="edge" d="{frame.path(sheet.outlines())}"/>',
    ]
    if not plane.section:
        parts.append(_splats(drawing, sheet, field, frame))
        paths = drawing.paths.points if drawing.paths else ()
        pieces = [piece for path in paths for piece in plane.lines(path.double())]
        parts.append(f'<g class="paths"><path class="halo" d="{frame.path(pieces)}"/>')
        parts.append(f'<path class="way" d="{frame.path(pieces)}"/></g>')
    x, y = frame.at(plane.coordinates(drawing.scene.goal[None]).numpy())[0]
    parts.append(f'</g><path class="rim" d="{frame.path([plane.rim])}Z"/>')
    parts.append(
        f'<path class="goal" d="{_star(x, y)}"/>{"" if plane.section else _starts(drawing, sheet, frame)}</svg>'
    )
    return "".join(parts)


class _Frame:
    """From the plane to the drawing, whose second axis points down."""

    def __init__(self, half: tuple[float, float]) -> None:
        self.half = np.array(half)
        self.scale = SIZE / (2 * max(half))
        self.width, self.height = 2 * self.half * self.scale

    def at(self, y: Array) -> Array:
        placed: Array = (y * (1, -1) + self.half) * self.scale
        return placed

    def path(self, lines: Sequence[Array]) -> str:
        """The data of an SVG path through all lines."""
        return "".join("M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in self.at(line)) for line in lines)


def _splats(drawing: Drawing, sheet: Sheet, field: SplatField, frame: _Frame) -> str:
    """Outlines of splats and their centres, fainter the smaller their weight."""
    outlines = splat_outlines(field)[:, 0]
    weights = field.v[: field.count].double()
    strength = (weights.abs() / weights.abs().max().clamp_min(1e-300)).sqrt().tolist() if field.count else []
    plane = sheet.mesh.plane
    drawn = []
    for line, weight, share in zip(outlines, weights.tolist(), strength, strict=True):
        kind = "raise" if weight > 0 else "lower"
        path = frame.path(plane.lines(line))
        drawn.append(f'<path class="{kind}" d="{path}" opacity="{0.15 + 0.85 * share:.2f}"/>')
    return f'<g class="splats">{"".join(drawn)}</g>'


def _starts(drawing: Drawing, sheet: Sheet, frame: _Frame) -> str:
    """Where paths start, and beside it what they cost."""
    paths, plane = drawing.paths, sheet.mesh.plane
    if paths is None:
        return ""
    marks = []
    for points, cost, reached in zip(paths.points, paths.cost.tolist(), paths.reached.tolist(), strict=True):
        y, away = plane.beside(points.double())
        at = frame.at(y)
        x, down = at + np.array([10 * away[0], -12 * away[1] + 4])
        anchor = "start" if away[0] > 0.35 else "end" if away[0] < -0.35 else "middle"
        said = f"{cost:.2f}" if reached else "stuck"
        marks.append(f'<path class="start" d="M{at[0]:.1f} {at[1]:.1f}h.01"/>')
        marks.append(f'<text class="cost" x="{x:.1f}" y="{down:.1f}" text-anchor="{anchor}">{said}</text>')
    return f'<g class="paths">{"".join(marks)}</g>'


def _star(x: float, y: float, size: float = 9.0) -> str:
    corners = [
        (x + r * math.sin(i * math.pi / 5), y - r * math.cos(i * math.pi / 5))
        for i, r in enumerate([size, 0.42 * size] * 5)
    ]
    return "M" + "L".join(f"{a:.1f} {b:.1f}" for a, b in corners) + "Z"


def plot(curves: Sequence[Curve], across: str, up: str, log: bool = False) -> str:
    """Curves over one another, with axes; each point's note is shown when the pointer is near."""
    xs = np.concatenate([np.asarray(curve.x, float) for curve in curves])
    ys = np.concatenate([np.asarray(curve.y, float) for curve in curves])
    log = log and bool((ys > 0).all())
    scale = _Axes(xs, np.log10(ys) if log else ys)
    parts = [
        f'<svg class="plot" viewBox="0 0 {WIDTH} {HEIGHT}" role="img" aria-label="{escape(up)} against {escape(across)}">'
    ]
    for tick in scale.ticks_across:
        x = scale.across(tick)
        parts.append(f'<path class="grid" d="M{x:.1f} {ABOVE}V{HEIGHT - BOTTOM}"/>')
        parts.append(f'<text class="tick" x="{x:.1f}" y="{HEIGHT - BOTTOM + 15}" text-anchor="middle">{tick:g}</text>')
    for tick in _log_ticks(ys) if log else scale.ticks_up:
        y = scale.up(math.log10(tick) if log else tick)
        parts.append(f'<path class="grid" d="M{LEFT} {y:.1f}H{WIDTH - RIGHT}"/>')
        parts.append(f'<text class="tick" x="{LEFT - 6}" y="{y + 3.5:.1f}" text-anchor="end">{tick:g}</text>')
    for number, curve in enumerate(curves):
        at = [(scale.across(x), scale.up(math.log10(y) if log else y)) for x, y in zip(curve.x, curve.y, strict=True)]
        line = "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in at)
        notes = escape("\n".join(curve.notes), quote=True)
        parts.append(
            f'<path class="curve curve{number}" d="{line}" data-notes="{notes}"><title>{escape(curve.name)}</title></path>'
        )
    parts.append(
        f'<text class="axis" x="{(LEFT + WIDTH - RIGHT) / 2}" y="{HEIGHT - 6}" text-anchor="middle">{escape(across)}</text>'
    )
    middle = (ABOVE + HEIGHT - BOTTOM) / 2
    parts.append(
        f'<text class="axis" transform="translate(13 {middle}) rotate(-90)" text-anchor="middle">{escape(up)}</text></svg>'
    )
    return "".join(parts)


class _Axes:
    """From numbers to the drawing."""

    def __init__(self, x: Array, y: Array) -> None:
        self.x, self.y = _range(x), _range(y, 0.06)
        self.ticks_across = [t for t in MaxNLocator(5).tick_values(*self.x) if self.x[0] <= t <= self.x[1]]
        whole = bool((y == np.round(y)).all())
        self.ticks_up = [t for t in MaxNLocator(5, integer=whole).tick_values(*self.y) if self.y[0] <= t <= self.y[1]]

    def across(self, x: float) -> float:
        return LEFT + (x - self.x[0]) / (self.x[1] - self.x[0]) * (WIDTH - LEFT - RIGHT)

    def up(self, y: float) -> float:
        return HEIGHT - BOTTOM - (y - self.y[0]) / (self.y[1] - self.y[0]) * (HEIGHT - BOTTOM - ABOVE)


def _range(values: Array, margin: float = 0.0) -> tuple[float, float]:
    low, high = float(values.min()), float(values.max())
    beyond = margin * (high - low) or 0.0
    return (low - beyond, high + beyond) if high > low else (low - 1, high + 1)


def _log_ticks(y: Array) -> list[float]:
    low, high = _range(np.log10(y), 0.06)
    for subs in ((1.0,), (1.0, 3.0), (1.0, 2.0, 5.0), tuple(range(1, 10))):
        ticks = [float(t) for t in LogLocator(subs=subs).tick_values(10**low, 10**high) if low <= math.log10(t) <= high]
        if len(ticks) >= 3:
            return ticks
    return [float(f"{10**v:.3g}") for v in np.linspace(low, high, 5)[1:-1]]
