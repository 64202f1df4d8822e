"""What is drawn of a field, apart from how: T over flat views, level lines, obstacles, paths with their cost, splats."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import torch
from contourpy import FillType, contour_generator
from matplotlib.ticker import MaxNLocator
from torch import Generator, Tensor

from rsrm_gen.errors import UserError
from rsrm_gen.trainer.evaluate import TimeFunction, values
from rsrm_gen.trainer.model import SplatField
from rsrm_gen.trainer.plan import Paths
from rsrm_gen.trainer.scene import Scene
from rsrm_gen.trainer.views.hidden import Eye, best_eye
from rsrm_gen.trainer.views.mesh import Mesh, mesh_of
from rsrm_gen.trainer.views.plane import Array, planes
from rsrm_gen.trainer.views.shape import Shape, graph_shape, natural_shape

LEVELS = 16
ROUGH = 36  # steps of the mesh that is looked at from all sides
FROM_ABOVE = (0.95,)  # the elevation from which an open surface is looked into
FROM_THE_SIDE = (0.6, 0.9)  # from which a closed one is looked at
BESIDE = 0.15  # of an obstacle, a length


@dataclass(frozen=True)
class Sheet:
    """A flat view with what is known at its points; R x C as its mesh."""

    mesh: Mesh
    time: Tensor  # (R, C), NaN outside the domain
    distance: Tensor  # (R, C), the signed distance from the obstacles

    def level_lines(self, scene: Scene, levels: Array) -> list[Array]:
        """Level lines of T in free space: pieces (k, 2) in the plane."""
        pieces = []
        for line in self.mesh.level_lines(self.time, levels.tolist()):
            free = scene.signed_distance(self.mesh.plane.point(torch.from_numpy(line))) >= 0
            pieces += runs(line, free.numpy())
        return pieces

    def outlines(self) -> list[Array]:
        """The boundaries of the obstacles: lines (k, 2) in the plane."""
        if not bool((self.distance < 0).any()):
            return []
        return self.mesh.level_lines(self.distance.clamp_max(1e6), [0.0])

    def areas(self) -> list[Array]:
        """The obstacles: polygons (k, 2) in the plane, holes among them, to be filled by the even-odd rule."""
        if not bool((self.distance < 0).any()):
            return []
        across, up = self.mesh.y.unbind(-1)
        distance = self.distance.clamp_max(1e6)
        found = contour_generator(across.numpy(), up.numpy(), distance.numpy(), fill_type=FillType.OuterOffset)
        polygons: Any = found.filled(-1e6, 0.0)
        return [
            part
            for polygon, starts in zip(*polygons, strict=True)
            for part in np.split(np.asarray(polygon), starts[1:-1].astype(int))
        ]


@dataclass(frozen=True)
class Drawing:
    """All that is drawn of the field of a scene, which is in double precision."""

    scene: Scene
    given: TimeFunction  # of points in the scene's own precision
    paths: Paths | None
    sheets: tuple[Sheet, ...]
    top: float  # the largest T in free space that is shown

    def time(self, x: Tensor) -> Tensor:
        """T (N) at points (N, D), in double precision."""
        return values(self.given, x, self.scene)

    @property
    def levels(self) -> Array:
        """Round, evenly spaced values of T, about as many as LEVELS."""
        return level_values(self.top)

    @cached_property
    def own_shape(self) -> tuple[Shape, Eye] | None:
        """The surface as it is in space, with the eye on it; None where there is no such shape."""
        shape = natural_shape(self.sheets[0].mesh, self.scene.manifold, self.scene.goal) if self.sheets else None
        return (shape, self._eye(shape)) if shape is not None else None

    @cached_property
    def shapes(self) -> tuple[tuple[Shape, Eye], ...]:
        """All shapes of a surface in space: its own first, and the graph of T."""
        if not self.sheets or self.sheets[0].mesh.plane.section:
            return ()
        graph = graph_shape(self.sheets[0].mesh, self.time, self.top)
        return (*([self.own_shape] if self.own_shape else []), (graph, self._eye(graph)))

    def _eye(self, shape: Shape) -> Eye:
        """From where the goal is well in sight, and of the obstacles as much as can be."""
        mesh = mesh_of(self.sheets[0].mesh.plane, ROUGH)
        points = mesh.points.reshape(-1, mesh.points.shape[-1])
        beside = points[self.scene.signed_distance(points).abs() < BESIDE]
        wanted = torch.cat([self.scene.goal[None], beside])
        elevations = FROM_THE_SIDE if shape.closed else FROM_ABOVE
        return best_eye(shape.embed(points).numpy(), mesh.triangles, shape.embed(wanted).numpy(), elevations)


def drawing_of(scene: Scene, time: TimeFunction, paths: Paths | None, fineness: int) -> Drawing:
    """The field on meshes of that many steps; `time` takes points (N, D) of the scene's dtype to T (N)."""
    exact, low = scene.in_double(), scene.goal.dtype
    sheets = tuple(_sheet(exact, lambda x: time(x.to(low)), mesh_of(plane, fineness)) for plane in planes(exact))
    free = torch.cat([sheet.time[(sheet.distance >= 0) & sheet.time.isfinite()] for sheet in sheets] or [torch.ones(1)])
    if not len(free):
        raise UserError(f"there is nothing to draw of {scene.title}: no finite T in free space")
    return Drawing(exact, lambda x: time(x.to(low)), paths, sheets, float(free.max()))


def _sheet(scene: Scene, time: TimeFunction, mesh: Mesh) -> Sheet:
    shape = mesh.points.shape[:2]
    found = values(time, mesh.points.reshape(-1, mesh.points.shape[-1]), scene).reshape(shape)
    if mesh.plane.section:  # which may leave the domain
        found = torch.where(scene.inside_domain(mesh.points), found, torch.nan)
    return Sheet(mesh, found, scene.signed_distance(mesh.points))


def level_values(top: float) -> Array:
    """Round, evenly spaced values between 0 and `top`."""
    levels = np.asarray(MaxNLocator(LEVELS, steps=[1, 2, 2.5, 5, 10]).tick_values(0, top))
    inner: Array = levels[(levels > 0) & (levels < top)]
    return inner


def runs(line: Array, kept: Array) -> list[Array]:
    """The pieces of a line (k, n) whose points are kept, of two points or more."""
    ends = np.flatnonzero(np.diff(kept.astype(int))) + 1
    pieces = zip(np.split(line, ends), np.split(kept, ends), strict=True)
    return [piece for piece, keep in pieces if len(piece) > 1 and keep[0]]


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


@torch.no_grad()
def splat_outlines(field: SplatField, count: int = 24) -> Tensor:
    """Where splats have fallen to exp(-1/2) of their height, along the planes of their axes: (K, d (d - 1) / 2, n, D)."""
    manifold, k, d = field.manifold, field.count, field.manifold.dim
    mu, frame = manifold.project(field.mu[:k].double()), field.frame[:k].double()
    axes, lengths, _ = torch.linalg.svd(field.A[:k].double())
    half_axes = axes * lengths[:, None]  # columns
    angle = torch.linspace(0, 2 * torch.pi, count + 1, dtype=torch.float64)
    around = torch.stack([angle.cos(), angle.sin()], -1)
    pairs = [(i, j) for i in range(d) for j in range(i + 1, d)]
    if not pairs or not k:
        return mu.new_zeros(k, len(pairs), count + 1, mu.shape[-1])
    components = torch.stack([around @ half_axes[:, :, pair].mT for pair in pairs], 1)  # (K, pairs, n, d)
    return manifold.exp(mu[:, None, None], components @ frame[:, None])
