"""The principle of dynamic programming: its fan, its fixed point, its answers."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
import torch
from plain_manifolds import PLAIN
from scenes import generated, seeded, small_scene

from rsrm_gen.trainer.objectives.bellman import Bellman, fan

SHORT = "{objective: bellman, dtype: float64, steps: 12, points: 400, splats: 30}"


def bellman(folder: Path, name: str, training: str = SHORT, obstacles: bool = True) -> Bellman:
    scene = small_scene(folder, name, training, obstacles, generated(name))
    made = Bellman(scene, lambda what, part: None)
    made.begin()
    return made


@pytest.mark.parametrize("dim", [1, 2, 3, 6])
def test_a_fan_has_unit_directions_that_cancel(dim: int) -> None:
    directions = fan(dim, seeded())
    assert torch.allclose(directions.norm(dim=1), torch.ones(len(directions), dtype=torch.float64))
    assert float(directions.sum(0).norm()) < 1e-9
    assert len(directions) >= 2 * dim


@pytest.mark.parametrize("name", PLAIN)
def test_the_distance_is_its_own_best_answer_in_free_space(tmp_path: Path, name: str) -> None:
    training = SHORT.replace("splats: 30", "splats: 30, link: {base: distance}")
    made = bellman(tmp_path, name, training, obstacles=False)
    assert made.advance() < 1e-6
    x = made.scene.sample(200, seeded(1))
    error = made.arrival.time(x) - made.scene.manifold.distance(x, made.scene.goal)
    assert float(error.abs().max()) < 1e-4


@pytest.mark.parametrize("name", PLAIN)
def test_sweeps_lower_what_geodesics_through_an_obstacle_cost(tmp_path: Path, name: str) -> None:
    """Behind the obstacle the way round is cheaper than the geodesic, and its cost is what the path down the field takes."""
    made = bellman(tmp_path, name)
    losses = [made.advance() for _ in range(made.steps)]
    assert all(map(math.isfinite, losses))
    behind = made.direct > 1.5 * made.scene.manifold.distance(made.x, made.scene.goal)
    assert int(behind.sum()) > 5
    assert float((made.arrival.time(made.x) / made.direct)[behind].mean()) < 0.9
    assert bool((made.paid <= made.direct).all())
