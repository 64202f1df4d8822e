"""What the page's viewer turns: surfaces with T, or clouds of points, and the lines and dots on them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import torch
from torch import Generator, Tensor

from rsrm_gen.trainer.model import SplatField
from rsrm_gen.trainer.report.packed import packed, packed_lines
from rsrm_gen.trainer.scene import Scene
from rsrm_gen.trainer.views.drawing import Drawing, splat_outlines
from rsrm_gen.trainer.views.hidden import Eye
from rsrm_gen.trainer.views.plane import Array, PointMap, goal_frame, goal_radius
from rsrm_gen.trainer.views.shape import Shape, normals

CLOUD = 40_000  # points
TORN = 0.3  # of the shape's radius: a longer step of a line leads over the edge of the chart


def viewed(drawing: Drawing, field: SplatField) -> dict[str, Any]:
    """All that the viewer needs, as JSON; empty where a manifold has only one dimension."""
    if drawing.scene.manifold.dim == 1:
        return {}
    surface = drawing.scene.manifold.dim == 2
    return _surfaces(drawing, field) if surface else _cloud(drawing, field)


def _surfaces(drawing: Drawing, field: SplatField) -> dict[str, Any]:
    sheet = drawing.sheets[0]
    rows, columns = sheet.mesh.y.shape[:2]
    return {
        "kind": "surface",
        "rows": rows,
        "columns": columns,
        "time": packed(sheet.time.numpy()),
        "distance": packed(sheet.distance.clamp_max(1e6).numpy()),
        "shapes": [_shape(drawing, shape, eye, field) for shape, eye in drawing.shapes],
    }


def _shape(drawing: Drawing, shape: Shape, eye: Eye, field: SplatField) -> dict[str, Any]:
    mesh, plane = drawing.sheets[0].mesh, drawing.sheets[0].mesh.plane
    positions = shape.embed(mesh.points).reshape(-1, 3).numpy()
    rim = [] if shape.closed else [plane.point(torch.from_numpy(plane.rim * (1 - 1e-6)))]
    return {
        "title": shape.title,
        "closed": shape.closed,
        "positions": packed(positions),
        "normals": packed(normals(positions, mesh.triangles)),
        "toward": eye.toward.tolist(),
        "rim": _lines(rim, shape.embed, shape.torn),
        **_marks(drawing, field, shape.embed, shape.torn),
    }


def _cloud(drawing: Drawing, field: SplatField) -> dict[str, Any]:
    """Points of the scene in normal coordinates at the goal; the three directions in which most obstacles are."""
    scene = drawing.scene
    x = _cloud_points(scene)
    scale = 1 / goal_radius(scene)
    frame, goal = goal_frame(scene)[:3], scene.goal

    def embed(points: Tensor) -> Tensor:
        return scale * scene.manifold.inner(goal, scene.manifold.log(goal, points).unsqueeze(-2), frame)

    shape = {
        "title": "normal coordinates at the goal: distance and direction",
        "closed": False,
        "positions": packed(embed(x).numpy()),
        "toward": [0.55, -0.65, 0.52],
        "rim": _lines(_obstacle_outlines(scene), embed, True),
        **_marks(drawing, field, embed, True),
    }
    distance = scene.signed_distance(x)
    time = drawing.time(x)
    return {
        "kind": "cloud",
        "time": packed(time.numpy()),
        "distance": packed(distance.clamp_max(1e6).numpy()),
        "shapes": [shape],
    }


def _cloud_points(scene: Scene) -> Tensor:
    """In three dimensions of the whole domain, in more of the section through the goal: (N, D)."""
    if scene.manifold.dim == 3:
        return scene.sample(CLOUD, Generator().manual_seed(0))
    direction = torch.randn(CLOUD, 3, generator=Generator().manual_seed(0), dtype=torch.float64)
    direction = torch.nn.functional.normalize(direction, dim=-1)
    r = goal_radius(scene) * torch.rand(CLOUD, 1, generator=Generator().manual_seed(1), dtype=torch.float64) ** (1 / 3)
    x = scene.manifold.exp(scene.goal, (r * direction) @ goal_frame(scene)[:3])
    return x[scene.inside_domain(x)]


def _obstacle_outlines(scene: Scene) -> list[Tensor]:
    """Of each ball, where planes of three orthonormal directions at its centre cut its surface: (n, D) each.

    In more dimensions these would lie beside the section that is shown; the points in obstacles show them there.
    """
    if scene.manifold.dim > 3:
        return []
    angle = torch.linspace(0, 2 * torch.pi, 73, dtype=torch.float64)
    around = torch.stack([angle.cos(), angle.sin()], -1)
    found = []
    for center, radius in zip(scene.centers, scene.radii, strict=True):
        frame = scene.manifold.frame(center)[:3]
        found += [scene.manifold.exp(center, radius * around @ frame[[i, j]]) for i, j in ((0, 1), (0, 2), (1, 2))]
    return found


def _marks(drawing: Drawing, field: SplatField, embed: PointMap, torn: bool) -> dict[str, Any]:
    """Paths, the goal, splats: their outlines by the sign of their weights, a line each."""
    outlines = splat_outlines(field)
    weights, centers = field.v[: field.count].double(), field.mu[: field.count].double()
    of_planes = outlines.shape[1] if field.manifold.dim <= 3 else 0  # in a section they would be elsewhere
    signed = {"raise": weights > 0, "lower": weights <= 0}
    return {
        "paths": _lines(drawing.paths.points if drawing.paths else (), embed, torn),
        "goal": embed(drawing.scene.goal[None]).numpy()[0].tolist(),
        "centers": packed(embed(centers).numpy()) if len(centers) else packed(np.zeros((0, 3))),
        **{name: _lines(list(outlines[of, :of_planes].flatten(0, 1)), embed, torn) for name, of in signed.items()},
    }


def _lines(lines: Sequence[Tensor], embed: PointMap, torn: bool) -> dict[str, Any]:
    if not lines:
        return packed_lines([])
    positions = embed(torch.cat([line.double() for line in lines])).numpy()
    pieces = np.split(positions, np.cumsum([len(line) for line in lines])[:-1])
    return packed_lines([part for piece in pieces for part in (_untorn(piece) if torn else [piece])])


def _untorn(line: Array) -> list[Array]:
    jumps = np.flatnonzero(np.linalg.norm(np.diff(line, axis=0), axis=1) > TORN) + 1
    return [piece for piece in np.split(line, jumps) if len(piece) > 1]
