"""Sample points: as many as asked for, evenly spread, few deep in obstacles, a little beyond the rim, the same for a seed."""

from __future__ import annotations

from pathlib import Path

import pytest
import torch
from curve_scenes import curve_scene
from scenes import seeded

from rsrm_gen.trainer.roadmap import Neighbourhood
from rsrm_gen.trainer.sampling import sample_points

DOMAIN_RADIUS = 3.0


@pytest.mark.parametrize("name", ["torus", "sphere", "hyperbolic", "so3", "circle"])
def test_there_are_as_many_as_asked_for_on_the_manifold_and_the_same_for_a_seed(name: str, tmp_path: Path) -> None:
    scene = curve_scene(tmp_path, name)
    x = sample_points(scene, 500, seeded())
    assert x.shape == (500, scene.manifold.point_size)
    assert x.dtype == torch.float64
    assert torch.allclose(scene.manifold.project(x), x, atol=1e-12)
    assert torch.equal(x, sample_points(scene, 500, seeded()))
    assert not torch.equal(x, sample_points(scene, 500, seeded(1)))


@pytest.mark.parametrize("name", ["torus", "sphere", "so3"])
def test_they_are_more_evenly_spread_than_by_chance(name: str, tmp_path: Path) -> None:
    scene = curve_scene(tmp_path, name)
    chance = Neighbourhood(scene.manifold, scene.sample(1500, seeded())).nearest_others(1)[1]
    ours = Neighbourhood(scene.manifold, sample_points(scene, 1500, seeded())).nearest_others(1)[1]
    assert ours.mean() > 1.2 * chance.mean()
    assert ours.std() / ours.mean() < 0.7 * chance.std() / chance.mean()


def test_volumes_get_their_share(tmp_path: Path) -> None:
    x = sample_points(curve_scene(tmp_path, "sphere"), 2000, seeded())
    for axis in x.T:  # Archimedes: each coordinate of a uniform point is uniform
        assert float(((axis.sort().values + 1) / 2 - torch.linspace(0, 1, 2000)).abs().max()) < 0.02


def test_few_lie_deep_in_obstacles_and_many_in_their_shell(tmp_path: Path) -> None:
    scene = curve_scene(tmp_path, "torus", "[{center: [0.5, 0.5], radius: 1.0}]")
    depth = -scene.signed_distance(sample_points(scene, 3000, seeded()))
    in_the_open = float((depth <= 0).sum()) / ((2 * torch.pi) ** 2 - torch.pi)
    density = [
        float(((depth > low) & (depth <= high)).sum()) / (torch.pi * (outer**2 - inner**2)) / in_the_open
        for low, high, outer, inner in ((0.0, 0.1, 1.0, 0.9), (0.1, 1.0, 0.9, 0.0))
    ]
    assert density[0] == pytest.approx(1.0, abs=0.3)  # at the edge of emptier space fewer are in a crowd
    assert density[1] == pytest.approx(0.1, abs=0.05)


def test_a_domain_is_filled_a_little_beyond_its_rim(tmp_path: Path) -> None:
    scene = curve_scene(tmp_path, "hyperbolic")
    assert scene.domain is not None
    r = scene.manifold.distance(scene.domain.center, sample_points(scene, 1000, seeded()))
    assert DOMAIN_RADIUS < float(r.max()) < 1.1 * DOMAIN_RADIUS
