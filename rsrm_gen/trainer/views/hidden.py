"""A mesh in space as the eye sees it, in parallel projection: which triangle a pixel shows, and what hides a line."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rsrm_gen.trainer.views.plane import Array

BEHIND = (
    0.012  # of the shape's radius: a line on the surface is hidden when it lies deeper than this behind what is seen
)
TRIED = 400_000  # pixels at a time that may lie in a triangle
EDGE = 1e-9  # of a triangle's weights: a pixel on the edge of two belongs to both
AROUND = 18  # directions
NEAR = 0.65  # of the shape's radius: as much toward the eye as is asked of the first position


@dataclass(frozen=True)
class Eye:
    """Where one looks from: an orthonormal basis, to the right, up, and toward the eye."""

    right: Array  # (3,)
    up: Array
    toward: Array

    @classmethod
    def at(cls, azimuth: float, elevation: float) -> Eye:
        """The eye in that direction, angles in radians; the third axis of space points up on the screen."""
        ca, sa, ce, se = np.cos(azimuth), np.sin(azimuth), np.cos(elevation), np.sin(elevation)
        return cls(np.array([-sa, ca, 0]), np.array([-se * ca, -se * sa, ce]), np.array([ce * ca, ce * sa, se]))

    def screen(self, positions: Array) -> Array:
        """Positions (..., 3) as (to the right, up, toward the eye)."""
        seen: Array = positions @ np.stack([self.right, self.up, self.toward], -1)
        return seen


@dataclass(frozen=True)
class Sight:
    """H x W pixels of a mesh, the first row below."""

    triangle: Array  # (H, W) the one that is seen; -1: none
    weights: Array  # (H, W, 3) of its corners
    depth: Array  # (H, W) toward the eye; -inf where there is nothing
    low: Array  # (2,) the screen's lower left corner
    pixel: float  # the side of a pixel

    def interpolate(self, values: Array, triangles: Array) -> Array:
        """What the pixels show of values (n, ...) at the vertices: (H, W, ...); of no meaning where there is nothing."""
        corners = values[triangles[self.triangle]]
        found: Array = np.einsum("hwc,hwc...->hw...", self.weights, corners)
        return found

    def shows(self, seen: Array) -> Array:
        """Whether positions (..., 3) on the screen are in sight: (...) of bool."""
        cell = np.floor((seen[..., :2] - self.low) / self.pixel).astype(np.int64)
        height, width = self.depth.shape
        # Where the surface turns away, depth changes much from a pixel to the next: the deepest of the neighbours counts.
        steps = [np.array([i, j]) for i in (-1, 0, 1) for j in (-1, 0, 1)]
        around = [np.clip(cell + step, 0, [width - 1, height - 1]) for step in steps]
        there = np.where(np.isfinite(self.depth), self.depth, np.inf)
        deepest = np.min([there[at[..., 1], at[..., 0]] for at in around], axis=0)
        visible: Array = seen[..., 2] >= deepest - BEHIND
        return visible


def look(eye: Eye, positions: Array, triangles: Array, pixels: int) -> Sight:
    """What is seen of a mesh with vertices (n, 3), on a screen of `pixels` on its longer side, by a depth buffer."""
    seen = eye.screen(positions)
    low, high = seen[:, :2].min(0), seen[:, :2].max(0)
    pixel = float((high - low).max()) / (pixels - 4)
    low = low - 2 * pixel
    width, height = (np.ceil((high - low) / pixel) + 2).astype(int)
    at, which, weights = _covered(seen, triangles, low, pixel, int(width))
    depth = np.einsum("fc,fc->f", weights, seen[triangles[which], 2])
    order = np.argsort(depth, kind="stable")  # the nearest is written last
    at, which, weights, depth = at[order], which[order], weights[order], depth[order]
    sight = Sight(
        np.full(height * width, -1), np.zeros((height * width, 3)), np.full(height * width, -np.inf), low, pixel
    )
    sight.triangle[at], sight.weights[at], sight.depth[at] = which, weights, depth
    return Sight(
        sight.triangle.reshape(height, width),
        sight.weights.reshape(height, width, 3),
        sight.depth.reshape(height, width),
        low,
        pixel,
    )


def _covered(seen: Array, triangles: Array, low: Array, pixel: float, width: int) -> tuple[Array, Array, Array]:
    """All pairs of a pixel and a triangle over its middle: index of the pixel, of the triangle, weights (f, 3)."""
    corners = (seen[triangles, :2] - low) / pixel - 0.5
    first = np.ceil(corners.min(1)).astype(np.int64)
    size = np.floor(corners.max(1)).astype(np.int64) - first + 1
    area = _cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    tried = size.prod(1) * (np.abs(area) > 1e-12)  # the pixels of the bounding box
    ends = np.cumsum(tried)
    parts = np.split(np.arange(len(triangles)), np.searchsorted(ends, np.arange(TRIED, int(ends[-1]), TRIED)))
    found = [
        _covered_by(part, corners[part], area[part], first[part], size[part], tried[part], width) for part in parts
    ]
    at, which, weights = (np.concatenate(results) for results in zip(*found, strict=True))
    return at, which, weights


def _covered_by(
    which: Array, corners: Array, area: Array, first: Array, size: Array, tried: Array, width: int
) -> tuple[Array, Array, Array]:
    """The same for some of the triangles."""
    of = np.repeat(np.arange(len(which)), tried)
    step = np.arange(len(of)) - np.repeat(np.cumsum(tried) - tried, tried)
    at = first[of] + np.stack([step % size[of, 0], step // size[of, 0]], -1)
    a, b, c = (corners[of, i] for i in range(3))
    by_b, by_c = _cross(at - a, c - a) / area[of], _cross(b - a, at - a) / area[of]
    inside = np.flatnonzero((by_b >= -EDGE) & (by_c >= -EDGE) & (by_b + by_c <= 1 + EDGE))
    by_b, by_c = by_b[inside], by_c[inside]
    weights = np.stack([1 - by_b - by_c, by_b, by_c], -1)
    return at[inside, 1] * width + at[inside, 0], which[of[inside]], weights


def _cross(u: Array, v: Array) -> Array:
    product: Array = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    return product


def best_eye(positions: Array, triangles: Array, wanted: Array, elevations: tuple[float, ...]) -> Eye:
    """Of directions all around, the one from which most of the positions (n, 3) are seen, the first one above all."""
    best, most = Eye.at(0.0, elevations[0]), -1.0
    for elevation in elevations:
        for azimuth in np.linspace(0, 2 * np.pi, AROUND, endpoint=False):
            eye = Eye.at(float(azimuth), elevation)
            seen = eye.screen(wanted)
            shown = look(eye, positions, triangles, 72).shows(seen)
            # The first one not at the rim, where one sees it from the side.
            others = float(shown[1:].mean()) if len(shown) > 1 else 0.0
            score = others + float(shown[0]) + min(float(seen[0, 2]), NEAR)
            if score > most:
                best, most = eye, score
    return best
