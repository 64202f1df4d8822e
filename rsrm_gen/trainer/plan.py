"""Paths to the goal: descent of the arrival time by Exp, and what such a path really costs.

The field's T is a claim; the cost of a path is the integral of the slowness along it, whatever the field says.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor

from rsrm_gen.manifold import Manifold
from rsrm_gen.trainer.model import ArrivalTime
from rsrm_gen.trainer.scene import Scene

PATIENCE = 100  # steps without a smaller T after which a descent has stalled
TOO_LONG = 3.0  # times the longest path that T(start) could pay for
MOST_STEPS = 20_000


@dataclass(frozen=True)
class Paths:
    """B paths: what each was promised and what it costs."""

    points: tuple[Tensor, ...]  # of each path, (m, D), joined by geodesics; the last is the goal when it was reached
    cost: Tensor  # (B,) the integral of s along the path; inf when the goal was not reached
    value: Tensor  # (B,) T(start), what the field says it costs
    reached: Tensor  # (B,) bool
    entered: Tensor  # (B,) bool: whether the path goes through an obstacle
    refused: Tensor  # (B,) bool: those that do, where the scene forbids it
    clearance: Tensor  # (B,) the least signed distance along the path; a length
    length: Tensor  # (B,) of the path


def plan(arrival: ArrivalTime, scene: Scene, starts: Tensor, step: float = 0.02) -> Paths:
    """Descend T from starts (B, D) in steps of that length until within one step of the goal."""
    value, _ = arrival.evaluate(starts)
    trails, reached = _descend(arrival, scene, starts, value, step)
    points = []
    for trail, arrived in zip(trails, reached.tolist(), strict=True):
        points.append(torch.cat([trail, scene.goal[None]]) if arrived else trail)
    measured = torch.stack([_measure(scene, path) for path in points]) if points else starts.new_zeros(0, 3)
    cost, length, clearance = measured.unbind(1)
    cost = torch.where(reached, cost, math.inf)
    entered = clearance < 0
    return Paths(tuple(points), cost, value, reached, entered, entered & scene.forbid_obstacles, clearance, length)


@torch.no_grad()
def _descend(
    arrival: ArrivalTime, scene: Scene, starts: Tensor, value: Tensor, step: float
) -> tuple[list[Tensor], Tensor]:
    """The points passed from each start, and which of them came within one step of the goal."""
    goal_distance = scene.manifold.distance(starts, scene.goal)
    reached = goal_distance <= step
    active = torch.nonzero(~reached)[:, 0]
    x, best = starts[active], value[active]
    since = torch.zeros(len(active), dtype=torch.int64)
    trails = [[start[None]] for start in starts]
    for _ in range(_most_steps(scene, value, step)):
        if not len(active):
            break
        x = scene.into_domain(_midpoint_step(arrival, x, step))
        for i, point in zip(active.tolist(), x, strict=True):
            trails[i].append(point[None])
        t, _ = arrival.evaluate(x)
        since = torch.where(t < best, 0, since + 1)
        best = torch.minimum(best, t)
        arrived = scene.manifold.distance(x, scene.goal) <= step
        reached[active[arrived]] = True
        going = ~arrived & (since < PATIENCE) & torch.isfinite(t)
        active, x, best, since = active[going], x[going], best[going], since[going]
    return [torch.cat(trail) for trail in trails], reached


def _most_steps(scene: Scene, value: Tensor, step: float) -> int:
    """A path cannot be longer than T(start) over the least slowness; three times that is no path any more."""
    finite = value[torch.isfinite(value)]
    longest = float(finite.max()) / min(scene.law.free, scene.law.obstacle) if len(finite) else 0.0
    return min(int(TOO_LONG * longest / step) + PATIENCE, MOST_STEPS)


def _midpoint_step(arrival: ArrivalTime, x: Tensor, step: float) -> Tensor:
    """A step of second order along -grad T: (B, D) to (B, D).

    The direction is that at the midpoint. It comes to x without a parallel transport: what leads from x to the end of
    a step from the midpoint, less the half step to the midpoint.
    """
    manifold = arrival.manifold
    half = step / 2 * _downhill(arrival, x)
    middle = manifold.exp(x, half)
    beyond = manifold.exp(middle, step * _downhill(arrival, middle))
    return manifold.project(manifold.exp(x, manifold.log(x, beyond) - half))


def _downhill(arrival: ArrivalTime, x: Tensor) -> Tensor:
    """The unit vector along -grad T; zero where there is no gradient."""
    gradient = arrival.evaluate(x)[1]
    norm = arrival.manifold.norm(x, gradient)[:, None]
    usable = torch.isfinite(norm) & (norm > 0)
    return torch.where(usable, -gradient / torch.where(usable, norm, 1.0), 0.0)


def _lengths(manifold: Manifold, p: Tensor, q: Tensor, v: Tensor) -> Tensor:
    """The lengths (...) of the segments t -> Exp_p(t v) from p to q (..., D); of a retraction by its middle, where the metric
    is what it is on average, wrong by the third order."""
    if manifold.maps == "geodesic":
        return manifold.norm(p, v)
    middle = manifold.exp(p, v / 2)
    return manifold.norm(middle, manifold.log(middle, q) - manifold.log(middle, p))


@dataclass(frozen=True)
class Segments:
    """Segments t -> Exp_p(t Log_p(q)) and what they cost."""

    cost: Tensor  # (...) the integral of the slowness
    length: Tensor  # (...)
    points: Tensor  # (..., n, D) where the slowness was asked for


@torch.no_grad()
def segments(scene: Scene, p: Tensor, q: Tensor) -> Segments:
    """From p to q, (..., D), by Gauss's quadrature with five points."""
    v = scene.manifold.log(p, q)
    nodes, weights = np.polynomial.legendre.leggauss(5)
    at = p.new_tensor((nodes + 1) / 2)
    points = scene.manifold.exp(p[..., None, :], at[:, None] * v[..., None, :])
    lengths = _lengths(scene.manifold, p, q, v)
    return Segments(lengths * (scene.slowness(points) @ p.new_tensor(weights / 2)), lengths, points)


@torch.no_grad()
def _measure(scene: Scene, path: Tensor) -> Tensor:
    """Cost, length and least signed distance of the geodesics that join the points (m, D): (3,)."""
    if len(path) < 2:
        return torch.stack([path.new_zeros(()), path.new_zeros(()), scene.signed_distance(path).amin()])
    way = segments(scene, path[:-1], path[1:])
    clearance = torch.minimum(scene.signed_distance(way.points).amin(), scene.signed_distance(path).amin())
    return torch.stack([way.cost.sum(), way.length.sum(), clearance])
