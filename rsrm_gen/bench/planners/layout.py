"""How a planner that knows no manifold stores points: numbers that it can compare and interpolate, and how they become points.

A planner needs near neighbours and ways between them; only for these it uses the numbers. What a motion costs is computed on the
manifold, along its own geodesics. Layouts are chosen by what a manifold says of itself:

NormalCoordinates   where the scene has a domain: d numbers, Log at the domain's centre in an orthonormal frame
Angles              coordinates that are all periodic: one angle each, compared around the circle
Quaternions         unit quaternions, q and -q the same: rotations, compared by their angle
Ambient             any other compact manifold: D numbers, projected onto the manifold
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import torch
from torch import Generator, Tensor

from rsrm_gen.errors import UserError
from rsrm_gen.trainer.scene import Scene

MARGIN = 1.05  # of the box of ambient coordinates around the points sampled in it
SAMPLED = 4096


@dataclass(frozen=True)
class NormalCoordinates:
    """d numbers: the components of Log_c(x) in an orthonormal frame at the domain's centre c."""

    scene: Scene
    center: Tensor  # (D,)
    frame: Tensor  # (d, T)
    radius: float

    def point(self, numbers: Sequence[float]) -> Tensor:
        """The point (D,) that d numbers stand for."""
        M, y = self.scene.manifold, self.center.new_tensor(numbers)
        return M.project(M.exp(self.center, y @ self.frame))

    def numbers(self, x: Tensor) -> list[float]:
        """The numbers of a point (D,)."""
        M = self.scene.manifold
        v = M.log(self.center, x)
        y = M.inner(self.center, v.expand_as(self.frame), self.frame)
        outside = float(y.norm()) / self.radius  # by rounding, of a point on the rim
        return [float(c) for c in y / max(outside, 1.0)]


@dataclass(frozen=True)
class Angles:
    """One angle in [-pi, pi] for each coordinate; the lengths of the coordinates are the weights of their circles."""

    scene: Scene
    periods: tuple[float, ...]
    weights: tuple[float, ...]  # length of a radian, at the goal

    def point(self, numbers: Sequence[float]) -> Tensor:
        """The point (D,) that D angles stand for."""
        scaled = [angle * period / (2 * math.pi) for angle, period in zip(numbers, self.periods, strict=True)]
        return self.scene.manifold.project(self.scene.goal.new_tensor(scaled))

    def numbers(self, x: Tensor) -> list[float]:
        """The angles of a point (D,)."""
        turns = [float(c) * 2 * math.pi / period for c, period in zip(x, self.periods, strict=True)]
        return [math.remainder(turn, 2 * math.pi) for turn in turns]


@dataclass(frozen=True)
class Quaternions:
    """The four numbers of a unit quaternion."""

    scene: Scene

    def point(self, numbers: Sequence[float]) -> Tensor:
        """The point (4,)."""
        return self.scene.manifold.project(self.scene.goal.new_tensor(numbers))

    def numbers(self, x: Tensor) -> list[float]:
        """The numbers as they are."""
        return [float(c) for c in x]


@dataclass(frozen=True)
class Ambient:
    """The D numbers of a point, in a box; what a planner makes of them is projected onto the manifold."""

    scene: Scene
    low: tuple[float, ...]
    high: tuple[float, ...]

    def point(self, numbers: Sequence[float]) -> Tensor:
        """The point (D,)."""
        return self.scene.manifold.project(self.scene.goal.new_tensor(numbers))

    def numbers(self, x: Tensor) -> list[float]:
        """The numbers as they are."""
        return [float(c) for c in x]


Layout = NormalCoordinates | Angles | Quaternions | Ambient


def layout_of(scene: Scene) -> Layout:
    """How planners store the points of a scene, in float64."""
    scene = scene.in_double()
    if scene.domain is not None:
        center = scene.domain.center
        return NormalCoordinates(scene, center, scene.manifold.frame(center), scene.domain.radius)
    periods = [period for period in scene.manifold.periods or () if period is not None]
    if len(periods) == scene.manifold.point_size:
        return Angles(scene, tuple(periods), _weights(scene, periods))
    return Quaternions(scene) if _rotations(scene) else _ambient(scene)


def _weights(scene: Scene, periods: Sequence[float]) -> tuple[float, ...]:
    """The length of a radian of each angle, by the metric at the goal."""
    steps = torch.diag(scene.goal.new_tensor(periods)) / (2 * math.pi)
    return tuple(scene.manifold.norm(scene.goal.expand_as(steps), steps).tolist())


def _rotations(scene: Scene) -> bool:
    """Whether points are unit quaternions and opposite ones the same."""
    if (scene.manifold.dim, scene.manifold.point_size) != (3, 4):
        return False
    x = _sampled(scene)
    unit = torch.allclose(x.norm(dim=1), torch.ones(len(x), dtype=x.dtype))
    return unit and bool((scene.manifold.distance(x, -x).abs() < 1e-6).all())


def _ambient(scene: Scene) -> Ambient:
    x = _sampled(scene)
    middle, half = (x.amax(0) + x.amin(0)) / 2, MARGIN * (x.amax(0) - x.amin(0)) / 2
    return Ambient(scene, tuple((middle - half).tolist()), tuple((middle + half).tolist()))


def _sampled(scene: Scene) -> Tensor:
    x = scene.sample(SAMPLED, Generator().manual_seed(0))
    if not bool(x.isfinite().all()):
        raise UserError(f"points of {scene.manifold.name} cannot be sampled")
    return x
