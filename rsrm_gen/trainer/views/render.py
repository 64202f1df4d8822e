"""The shaded surface as pixels: colours of T, one colour in obstacles, light from above, and smooth edges."""

from __future__ import annotations

from dataclasses import dataclass

import matplotlib
import numpy as np
from matplotlib.colors import to_rgb

from rsrm_gen.trainer.views.drawing import Drawing, Sheet
from rsrm_gen.trainer.views.hidden import Eye, Sight, look
from rsrm_gen.trainer.views.plane import Array
from rsrm_gen.trainer.views.shape import Shape, normals

COLOURS = "viridis"
OBSTACLE = "#e9e5dd"
SAMPLES = 2  # a pixel's side, in samples


@dataclass(frozen=True)
class Rendering:
    """An image and what it shows."""

    image: Array  # (H, W, 4) in [0, 1], the first row below
    sight: Sight
    extent: tuple[float, float, float, float]  # left, right, bottom, top


def colours(time: Array, distance: Array, top: float) -> Array:
    """The colour map over T, and that of obstacles where the signed distance is negative: (..., 3) in [0, 1]."""
    shares = np.clip(np.nan_to_num(time / top, nan=1.0, posinf=1.0), 0, 1)
    rgb: Array = matplotlib.colormaps[COLOURS](shares)[..., :3]
    return np.where((distance < 0)[..., None], to_rgb(OBSTACLE), rgb)


def render(sheet: Sheet, shape: Shape, eye: Eye, top: float, pixels: int) -> Rendering:
    """A surface as it is seen, `pixels` on its longer side."""
    triangles = sheet.mesh.triangles
    positions = shape.embed(sheet.mesh.points).reshape(-1, 3).numpy()
    sight = look(eye, positions, triangles, SAMPLES * pixels)
    time = sight.interpolate(sheet.time.reshape(-1).numpy(), triangles)
    distance = sight.interpolate(sheet.distance.reshape(-1).clamp_max(1e6).numpy(), triangles)
    normal = sight.interpolate(normals(positions, triangles), triangles)
    rgb = colours(time, distance, top) * _light(normal, eye)[..., None]
    there = (sight.triangle >= 0)[..., None].astype(float)
    image = _shrunk(np.concatenate([np.clip(rgb, 0, 1) * there, there], -1))
    image[..., :3] /= np.maximum(image[..., 3:], 1e-9)
    height, width = image.shape[:2]
    side = SAMPLES * sight.pixel
    left, bottom = sight.low
    return Rendering(image, sight, (left, left + width * side, bottom, bottom + height * side))


def flat_image(drawing: Drawing, sheet: Sheet, pixels: int) -> Array:
    """T over the rectangle of a plane in colours, the first row below: (H, W, 4); transparent outside the domain."""
    plane = sheet.mesh.plane
    y = plane.pixels(pixels)
    x = plane.point(plane.into(y))
    time = drawing.time(x.reshape(-1, x.shape[-1])).reshape(x.shape[:2])
    # Beside the boundary of an obstacle, which is drawn by its line, the colours go on.
    image = colours(time.numpy(), np.ones(time.shape), drawing.top)
    outside = plane.section & ~drawing.scene.inside_domain(x)[..., None].numpy()
    return np.concatenate([image, np.where(outside, 0.0, 1.0)], -1)


def _light(normal: Array, eye: Eye) -> Array:
    """How bright surfaces with normals (..., 3) are, the same from both sides: from ambient and one lamp."""
    normal = normal / np.maximum(np.linalg.norm(normal, axis=-1, keepdims=True), 1e-12)
    facing = np.sign(normal @ eye.toward)
    lamp = eye.toward + 0.7 * eye.up - 0.5 * eye.right
    lambert = np.clip(facing * (normal @ (lamp / np.linalg.norm(lamp))), 0, 1)
    light: Array = 0.62 + 0.42 * lambert
    return light


def _shrunk(image: Array) -> Array:
    """Means of SAMPLES x SAMPLES samples; a row or column that is left over goes."""
    height, width = (size // SAMPLES * SAMPLES for size in image.shape[:2])
    blocks = image[:height, :width].reshape(height // SAMPLES, SAMPLES, width // SAMPLES, SAMPLES, -1)
    shrunk: Array = blocks.mean((1, 3))
    return shrunk
