"""Small scenes and fields on the plain manifolds, for the tests of the trainer."""

from __future__ import annotations

from pathlib import Path

import torch
from plain_manifolds import PLAIN
from torch import Generator, Tensor

from rsrm_gen.load import load_in_rows
from rsrm_gen.manifold import Manifold
from rsrm_gen.trainer.model import SplatField
from rsrm_gen.trainer.scene import Scene, read_scene

# Tensors here are small: threads would only get into each other's way.
torch.set_num_threads(1)

ORIGIN = {
    "R2": [0.0, 0.0],
    "T2": [0.5, -1.0],
    "S2": [0.0, 0.6, 0.8],
    "H2": [1.25, 0.75, 0.0],
    "SO3": [0.8, 0.0, 0.6, 0.0],
}
GENERATED: dict[str, tuple[str, dict[str, int]]] = {
    "R2": ("euclidean", {"n": 2}),
    "T2": ("torus", {}),
    "S2": ("sphere", {}),
    "H2": ("hyperbolic", {}),
    "SO3": ("so3", {}),
}
CENTER = {
    "R2": [1.0, 0.3],
    "T2": [1.4, -0.2],
    "S2": [0.8, 0.0, 0.6],
    "H2": [1.25, 0.0, 0.75],
    "SO3": [0.8, 0.6, 0.0, 0.0],
}


def generated(name: str) -> Manifold:
    """The bundled manifold that a plain one stands for."""
    spec, parameters = GENERATED[name]
    return load_in_rows(spec, None, **parameters)


def small_scene(
    folder: Path,
    name: str,
    training: str = "{dtype: float64}",
    obstacles: bool = True,
    manifold: Manifold | None = None,
) -> Scene:
    """One obstacle near the goal, a ball of radius 2 as domain; `training` is YAML in flow style, of `eikonal` unless it says."""
    if "objective" not in training:
        training = training.replace("{", "{objective: eikonal, ", 1)
    path = folder / "scene.yaml"
    lines = [
        f"scene: small {name}",
        f"manifold: {name}",
        f"goal: {ORIGIN[name]}",
        f"obstacles: [{{center: {CENTER[name]}, radius: 0.4}}]" if obstacles else "obstacles: []",
        f"domain: {{center: {ORIGIN[name]}, radius: 2}}",
        f"training: {training}",
    ]
    path.write_text("\n".join(lines) + "\n")
    return read_scene(path, manifold or PLAIN[name])


def random_field(manifold: Manifold, centers: Tensor, generator: Generator) -> SplatField:
    """Anisotropic splats of random weight at the centres (K, D), with two rows to spare."""
    count, d = len(centers), manifold.dim
    field = SplatField(manifold, count + 2, centers.dtype)
    field.append(centers, 0.5)
    noise = torch.randn(count, d, d, generator=generator, dtype=centers.dtype)
    weights = torch.randn(count, generator=generator, dtype=centers.dtype)
    with torch.no_grad():
        field.v[:count] = 0.3 * weights
        field.A[:count] += 0.1 * noise
    return field


def seeded(seed: int = 0) -> Generator:
    """A generator of its own for each test."""
    return torch.Generator().manual_seed(seed)
