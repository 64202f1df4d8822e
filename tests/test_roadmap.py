"""The roadmap: true neighbours on any manifold, costs that its ways really have, and a way to the goal from everywhere."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import torch
from curve_scenes import around, curve_scene
from scenes import seeded

from rsrm_gen.trainer.curves import Terrain
from rsrm_gen.trainer.roadmap import Neighbourhood, roadmap


@pytest.mark.parametrize("name", ["torus", "sphere", "hyperbolic", "so3", "se3", "arm2", "circle"])
def test_neighbours_are_the_nearest_points(name: str, tmp_path: Path) -> None:
    scene = curve_scene(tmp_path, name)
    x = around(scene, 2.0, 400)
    index, distance = Neighbourhood(scene.manifold, x).nearest_others(6)
    exact = scene.manifold.distance(x[:, None], x)
    assert torch.equal(exact.gather(1, torch.from_numpy(index)), torch.from_numpy(distance))
    exact.fill_diagonal_(torch.inf)
    best = exact.sort(dim=1).values[:, :6].numpy()
    assert (index != np.arange(400)[:, None]).all()
    assert (np.diff(distance, axis=1) >= 0).all()
    exactly_so = distance <= best + 1e-12
    assert exactly_so.mean() > (0.75 if scene.manifold.maps == "retraction" else 0.9)  # its distance is no metric
    assert distance.mean() < 1.1 * best.mean()


def test_twins_are_neighbours_but_no_point_is_its_own(tmp_path: Path) -> None:
    scene = curve_scene(tmp_path, "torus")
    x = around(scene, 1.0, 5).repeat_interleave(10, 0)
    index, distance = Neighbourhood(scene.manifold, x).nearest_others(4)
    assert (index != np.arange(50)[:, None]).all()
    assert index.shape == distance.shape == (50, 4)
    assert not distance.any()
    assert np.isfinite(roadmap(Terrain(scene), x, 4).cost).all()


@pytest.mark.parametrize("name", ["torus", "sphere", "hyperbolic", "so3", "arm2"])
def test_ways_lead_from_every_point_to_the_goal_at_the_cost_that_is_said(name: str, tmp_path: Path) -> None:
    plain = curve_scene(tmp_path, name)
    center = plain.manifold.exp(plain.goal, 0.7 * plain.manifold.frame(plain.goal)[0])
    terrain = Terrain(curve_scene(tmp_path, name, f"[{{center: {center.tolist()}, radius: 0.3}}]"))
    x = around(plain, 2.0, 500)
    found = roadmap(terrain, x, 12)
    points, goal = x.numpy(), plain.goal.numpy()
    assert sorted(np.concatenate(list(found.levels())).tolist()) == list(range(500))
    costs = np.append(found.cost, 0.0)
    step, length = terrain.segments(points, np.concatenate([points, goal[None]])[found.next])
    assert found.cost == pytest.approx(step + costs[found.next], rel=2e-3)
    lengths = np.zeros(501)
    for rows in found.levels():
        lengths[rows] = length[rows] + lengths[found.next[rows]]
    lengths = lengths[:500]
    assert (found.cost > lengths * (1 - 1e-9)).all()  # the free slowness is 1, the least there is
    if name != "arm2":
        assert (lengths >= plain.manifold.distance(x, plain.goal).numpy() - 1e-12).all()
    direct, _ = terrain.segments(x.numpy(), plain.goal.numpy()[None])
    assert found.cost.sum() < direct.sum()


def test_points_that_no_neighbour_joins_to_the_goal_reach_it_by_geodesics(tmp_path: Path) -> None:
    scene = curve_scene(tmp_path, "sphere")
    M = scene.manifold
    far = M.exp(scene.goal, 3.0 * M.frame(scene.goal)[0])
    island = M.project(far + 0.01 * torch.randn(30, 3, generator=seeded(), dtype=torch.float64))
    x = torch.cat([around(scene, 0.5, 200), island])
    found = roadmap(Terrain(scene), x, 5)
    assert np.isfinite(found.cost).all()
    assert found.cost[200:] == pytest.approx(M.distance(island, scene.goal).numpy(), abs=1e-9)


def test_the_same_points_give_the_same_roadmap(tmp_path: Path) -> None:
    terrain = Terrain(curve_scene(tmp_path, "torus", f"[{{center: {[0.0, -1.5]}, radius: 0.5}}]"))
    x = around(terrain.scene, 2.5, 300)
    one, two = roadmap(terrain, x), roadmap(terrain, x)
    assert np.array_equal(one.cost, two.cost)
    assert np.array_equal(one.next, two.next)
