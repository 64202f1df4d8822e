"""Scenes on generated manifolds, for the tests of curves and of what is made of them."""

from __future__ import annotations

from pathlib import Path

import torch
from scenes import seeded

from rsrm_gen.trainer.scene import Scene, read_scene

GOALS = {
    "euclidean": [0.3, -0.4],
    "torus": [-1.5, -1.5],
    "sphere": [0.0, 0.6, 0.8],
    "hyperbolic": [1.25, 0.75, 0.0],
    "so3": [0.8, 0.0, 0.6, 0.0],
    "se3": [0.3, -0.2, 0.1, 0.8, 0.0, 0.6, 0.0],
    "arm2": [0.3, 0.5],
    "circle": [1.0, 0.0],
}
PARAMETERS = {"euclidean": "{n: 2}"}


def curve_scene(
    folder: Path, name: str, obstacles: str = "[]", slowness: str = "{}", goal: list[float] | None = None
) -> Scene:
    """A scene in float64; obstacles and slowness are YAML in flow style."""
    parameters = PARAMETERS.get(name)
    lines = [
        f"scene: {name}",
        f"manifold: {{spec: {name}, parameters: {parameters}}}" if parameters else f"manifold: {name}",
        f"goal: {goal or GOALS[name]}",
        f"obstacles: {obstacles}",
        f"slowness: {slowness}",
        "training: {dtype: float64}",
    ]
    if name in ("euclidean", "hyperbolic", "se3", "arm2"):
        lines.append(f"domain: {{center: {goal or GOALS[name]}, radius: {0.75 if name == 'arm2' else 3}}}")
    path = folder / "scene.yaml"
    path.write_text("\n".join(lines) + "\n")
    return read_scene(path).in_double()


def around(scene: Scene, radius: float, count: int, seed: int = 0) -> torch.Tensor:
    """Points (count, D) within a radius of the goal."""
    M = scene.manifold
    components = torch.randn(count, M.dim, generator=seeded(seed), dtype=torch.float64)
    reach = radius * torch.rand(count, 1, generator=seeded(seed + 1), dtype=torch.float64) ** (1 / M.dim)
    v = (reach * components / components.norm(dim=1, keepdim=True))[:, None] @ M.frame(scene.goal)
    return M.project(M.exp(scene.goal.expand(count, -1), v[:, 0]))
