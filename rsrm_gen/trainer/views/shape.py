"""Shapes in space: how points (..., D) of a manifold of two dimensions are drawn in R^3, the third axis up.

An embedded surface with three coordinates is drawn as it is. A chart with periods is rolled up along them; rolling up two keeps
neither lengths nor angles, which a flat surface in R^3 that is closed cannot. What has no shape of its own is drawn as the
graph of T over its plane, and that can be done with everything.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor

from rsrm_gen.manifold import Manifold
from rsrm_gen.trainer.evaluate import TimeFunction
from rsrm_gen.trainer.views.mesh import Mesh
from rsrm_gen.trainer.views.plane import Array, PointMap

TUBE = 0.45  # radius of the tube that a doubly periodic chart is rolled up to; its middle line has radius 1
GOAL_UP = 0.9  # the goal's angle around that tube, from outside up
HEIGHT = 0.8  # of the graph of T, in units of half the plane's width


@dataclass(frozen=True)
class Shape:
    """A drawing of a surface in space, in the ball of radius 1 about the origin."""

    title: str
    embed: PointMap  # points (..., D) to positions (..., 3)
    torn: bool  # neighbours may be drawn apart, where the plane ends
    closed: bool  # has no inside that could be seen


def natural_shape(mesh: Mesh, manifold: Manifold, goal: Tensor) -> Shape | None:
    """The manifold itself, or its chart rolled up, the goal (D,) in front; None where it has no shape in space."""
    if manifold.dim != 2:
        return None
    if manifold.point_size == 3 and manifold.periods is None:
        closed = math.isfinite(manifold.diameter)
        turn = torch.eye(3, dtype=torch.float64) if closed else _upright(mesh, manifold)
        return _fitted("the surface itself, in the coordinates of its points", lambda x: x @ turn.T, mesh, closed)
    periods = manifold.periods or ()
    if len(periods) == 2 and None not in periods:
        return _fitted(
            "the chart, rolled up along both periods (not to scale)", _rolled_twice(manifold, goal), mesh, True
        )
    if len(periods) == 2 and periods != (None, None):
        return _fitted("the chart, rolled up along its period", _rolled_once(manifold), mesh, False)
    return None


def graph_shape(mesh: Mesh, time: TimeFunction, top: float) -> Shape:
    """T as height over the plane; `top` is the largest one drawn. `time` takes points (N, D) to T (N), both in float64."""
    plane = mesh.plane

    def embed(x: Tensor) -> Tensor:
        height = time(x.reshape(-1, x.shape[-1])).reshape(x.shape[:-1]).clamp(0, top)
        height = torch.where(height.isfinite(), height, top)
        return torch.cat([plane.coordinates(x), HEIGHT * max(plane.half) / top * height[..., None]], -1)

    return _fitted("T as height over the chart", embed, mesh, False, torn=True)


def _fitted(title: str, embed: PointMap, mesh: Mesh, closed: bool, torn: bool = False) -> Shape:
    """The same, moved and scaled into the unit ball."""
    positions = embed(mesh.points).reshape(-1, 3)
    low, high = positions.amin(0), positions.amax(0)
    middle = (low + high) / 2
    scale = 1 / float((positions - middle).norm(dim=-1).max())
    return Shape(title, lambda x: (embed(x) - middle) * scale, torn, closed)


def _upright(mesh: Mesh, manifold: Manifold) -> Tensor:
    """A rotation (3, 3) that makes an open surface a bowl: its normal in the middle points up, and so does its rim."""
    middle = mesh.points[0, 0]
    frame = manifold.frame(middle)
    up = torch.nn.functional.normalize(torch.linalg.cross(frame[0], frame[1]), dim=0)
    if float((mesh.points.reshape(-1, 3).mean(0) - middle) @ up) < 0:
        up = -up
    right = torch.nn.functional.normalize(frame[0] - (frame[0] @ up) * up, dim=0)
    return torch.stack([right, torch.linalg.cross(up, right), up])


def _rolled_twice(manifold: Manifold, goal: Tensor) -> PointMap:
    periods = torch.tensor([period for period in manifold.periods or () if period is not None], dtype=torch.float64)

    def embed(x: Tensor) -> Tensor:
        long, short = (2 * math.pi * (x - goal) / periods).unbind(-1)
        short = short + GOAL_UP
        away = 1 + TUBE * short.cos()
        return torch.stack([away * long.cos(), away * long.sin(), TUBE * short.sin()], -1)

    return embed


def _rolled_once(manifold: Manifold) -> PointMap:
    around, period = next((i, p) for i, p in enumerate(manifold.periods or ()) if p is not None)
    radius = period / (2 * math.pi)

    def embed(x: Tensor) -> Tensor:
        angle, along = x[..., around] / radius, x[..., 1 - around]
        return torch.stack([radius * angle.cos(), radius * angle.sin(), along], -1)

    return embed


def normals(positions: Array, triangles: Array) -> Array:
    """Unit normals (n, 3) of a mesh at its vertices (n, 3), which count as one where they lie at the same place."""
    corners = positions[triangles]
    flat = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    same = np.unique(np.round(positions, 5), axis=0, return_inverse=True)[1].reshape(-1)
    total = np.zeros((same.max() + 1, 3))
    for corner in range(3):
        np.add.at(total, same[triangles[:, corner]], flat)
    total = total[same]
    unit: Array = total / np.maximum(np.linalg.norm(total, axis=1, keepdims=True), 1e-300)
    return unit
