"""Structured meshes over a plane: what is drawn as a surface, and what level lines are found on."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import contourpy
import numpy as np
import torch
from torch import Tensor

from rsrm_gen.trainer.views.plane import Array, Plane


@dataclass(frozen=True)
class Mesh:
    """R x C points of a manifold over a plane, neighbours side by side; a disc's rows are its rings, its columns angles."""

    plane: Plane
    y: Tensor  # (R, C, 2)
    points: Tensor  # (R, C, D)

    @property
    def triangles(self) -> Array:
        """Indices (m, 3) into the points taken row by row."""
        rows, columns = self.y.shape[:2]
        corner = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
        lower = np.stack([corner, corner + columns, corner + columns + 1], -1)
        upper = np.stack([corner, corner + columns + 1, corner + 1], -1)
        return np.concatenate([lower, upper])

    def level_lines(self, values: Tensor, levels: Sequence[float]) -> list[Array]:
        """Where values (R, C) pass through the levels: lines (k, 2) in the plane."""
        z = np.ma.masked_invalid(values.numpy())
        found = contourpy.contour_generator(self.y[..., 0].numpy(), self.y[..., 1].numpy(), z)
        return [np.asarray(line) for level in levels for line in found.lines(level) if len(line) > 1]


def mesh_of(plane: Plane, count: int) -> Mesh:
    """`count` steps from one side of the plane to the other."""
    y = _rings(plane.half[0], count) if plane.round else _rectangle(plane.half, count)
    return Mesh(plane, y, plane.point(y))


def _rings(radius: float, count: int) -> Tensor:
    # Not quite to the rim: what lies there may be one point that is reached from all directions.
    r = torch.linspace(0, 1 - 1e-6, count // 2 + 1, dtype=torch.float64)[:, None, None] * radius
    angle = torch.linspace(0, 2 * math.pi, 3 * count // 2 + 1, dtype=torch.float64)
    return r * torch.stack([angle.cos(), angle.sin()], -1)


def _rectangle(half: tuple[float, float], count: int) -> Tensor:
    a, b = (torch.linspace(-side, side, count + 1, dtype=torch.float64) for side in half)
    return torch.stack(torch.meshgrid(a, b, indexing="xy"), -1)
