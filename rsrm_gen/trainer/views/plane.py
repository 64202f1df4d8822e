"""Flat views: a plane whose positions y (..., 2) stand for points x (..., D), and back.

A periodic chart is one period of each coordinate. A disc is a geodesic ball in isothermal coordinates, or in normal ones where
there are none or they run away. In more than two dimensions planes are sections: normal coordinates at the goal, two at a time.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
import torch
from torch import Tensor

from rsrm_gen.errors import UserError
from rsrm_gen.manifold import Manifold
from rsrm_gen.trainer.conformal import conformal_chart
from rsrm_gen.trainer.scene import Ball, Scene

Array = np.ndarray[Any, Any]
PointMap = Callable[[Tensor], Tensor]
Kind = Literal["chart", "disk"]

NEAR_RIM = 0.85  # of the way there; texts are written outside a disc, and inside a rectangle
AHEAD = 10  # points of a path that tell where it goes
RUNS_AWAY = 4.0  # isothermal coordinates this much larger than distances show the middle as a dot


@dataclass(frozen=True)
class Plane:
    """A rectangle around the origin, or the disc in it, that shows a manifold of two dimensions or a section of a larger one."""

    title: str
    point: PointMap  # y (..., 2) to points (..., D)
    coordinates: PointMap  # points (..., D) to y (..., 2)
    half: tuple[float, float]  # half the width and half the height
    round: bool  # a disc of radius half[0]; else the whole rectangle
    periods: tuple[float, float] | None  # of y
    section: bool  # points beside the section have coordinates too: those of their projection

    @property
    def rim(self) -> Array:
        """The outline (n, 2), closed."""
        if self.round:
            angle = np.linspace(0, 2 * np.pi, 361)
            return self.half[0] * np.stack([np.cos(angle), np.sin(angle)], -1)
        a, b = self.half
        return np.array([[-a, -b], [a, -b], [a, b], [-a, b], [-a, -b]])

    def pixels(self, count: int) -> Tensor:
        """The middles of pixels, `count` on the longer side, the first row below: (H, W, 2)."""
        size = 2 * max(self.half) / count
        across, up = (torch.arange(round(2 * side / size)) for side in self.half)
        grid = torch.stack(torch.meshgrid(across, up, indexing="xy"), -1)
        return (grid + 0.5) * size - torch.tensor(self.half, dtype=torch.float64)

    def into(self, y: Tensor) -> Tensor:
        """Positions (..., 2) as they are in the disc, else at its rim."""
        if not self.round:
            return y
        inside: Tensor = y * (self.half[0] / y.norm(dim=-1, keepdim=True).clamp_min(self.half[0]))
        return inside

    def beside(self, path: Tensor) -> tuple[Array, Array]:
        """Where a path (m, D) starts, and the unit vector from there to where a text is not in its way: (2,) each."""
        y = self.lines(path)[0]
        start, away = y[0], y[0] - y[min(AHEAD, len(y) - 1)]
        place = start / np.array(self.half)
        if self.round and np.linalg.norm(place) > NEAR_RIM:
            away = start
        elif not self.round:
            away = np.where((np.abs(place) > NEAR_RIM) & (away * place > 0), -away, away)
        length = float(np.linalg.norm(away))
        return start, away / length if length else np.array([1.0, 0.0])

    def lines(self, points: Tensor) -> list[Array]:
        """A curve through points (m, D) as pieces (k, 2), cut where it leaves one side to come in at another."""
        if not len(points):
            return []
        y = self.coordinates(points).numpy()
        reach = np.array(self.periods or (2 * self.half[0], 2 * self.half[1])) / 2
        jumps = np.flatnonzero((np.abs(np.diff(y, axis=0)) > reach).any(1)) + 1
        return [piece for piece in np.split(y, jumps) if np.isfinite(piece).all()]


def planes(scene: Scene) -> list[Plane]:
    """The flat views of a scene in double precision: one in two dimensions, three sections in more, none in one."""
    if scene.manifold.dim == 1:
        return []
    if scene.manifold.dim > 2:
        return _sections(scene)
    wanted = scene.picture.view
    kind: Kind = wanted if wanted in ("chart", "disk") else default_kind(scene)
    return [_chart(scene.manifold) if kind == "chart" else _disk(scene)]


def default_kind(scene: Scene) -> Kind:
    """The chart where every coordinate is periodic and all of the manifold is trained on, else a disc."""
    periods = scene.manifold.periods
    return "chart" if scene.domain is None and periods is not None and None not in periods else "disk"


def _chart(manifold: Manifold) -> Plane:
    periods = [period for period in manifold.periods or () if period is not None]
    if len(periods) != 2:
        raise UserError("a `chart` view needs two coordinates that are both periodic")
    a, b = periods

    def coordinates(x: Tensor) -> Tensor:
        turn = x.new_tensor([a, b])
        return x - turn * torch.round(x / turn)

    return Plane("one period of each coordinate", manifold.project, coordinates, (a / 2, b / 2), False, (a, b), False)


def _disk(scene: Scene) -> Plane:
    manifold = scene.manifold
    ball = scene.domain or Ball(scene.goal, manifold.injectivity_radius)
    try:
        chart = conformal_chart(manifold, ball.center)
        radius = float(chart.radius(ball.radius))
    except UserError:
        radius = math.inf
    if radius < RUNS_AWAY * ball.radius:
        return Plane("isothermal coordinates", chart.point, chart.coordinates, (radius,) * 2, True, None, False)
    frame = manifold.frame(ball.center)
    return _normal(manifold, ball, frame, "normal coordinates: distance and direction from the middle", False)


def _normal(manifold: Manifold, ball: Ball, frame: Tensor, title: str, section: bool) -> Plane:
    """Components of Log at the centre along two orthonormal tangent vectors (2, T)."""
    center = ball.center
    return Plane(
        title,
        lambda y: manifold.exp(center, y @ frame),
        lambda x: manifold.inner(center, manifold.log(center, x).unsqueeze(-2), frame),
        (ball.radius, ball.radius),
        True,
        None,
        section,
    )


def _sections(scene: Scene) -> list[Plane]:
    frame, radius = goal_frame(scene), goal_radius(scene)
    ball = Ball(scene.goal, radius)
    return [
        _normal(scene.manifold, ball, frame[[i, j]], f"section through the goal, directions {i + 1} and {j + 1}", True)
        for i, j in ((0, 1), (0, 2), (1, 2))
    ]


def goal_frame(scene: Scene) -> Tensor:
    """An orthonormal basis (d, T) at the goal, the first vectors in the directions where most obstacles are."""
    manifold, goal = scene.manifold, scene.goal
    frame = manifold.frame(goal)
    if not len(scene.centers):
        return frame
    toward = manifold.inner(goal, manifold.log(goal.expand_as(scene.centers), scene.centers).unsqueeze(-2), frame)
    axes = torch.linalg.svd(toward, full_matrices=True)[2]
    turned: Tensor = axes @ frame
    return turned


def goal_radius(scene: Scene) -> float:
    """How far around the goal a scene is shown."""
    manifold = scene.manifold
    if scene.domain is None:
        return manifold.injectivity_radius
    beyond = float(manifold.distance(scene.goal, scene.domain.center))
    return min(manifold.injectivity_radius, scene.domain.radius + beyond)
