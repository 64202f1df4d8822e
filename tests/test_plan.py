"""Paths: where they lead, what they truly cost, and when they say that they failed."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import pytest
import torch
from plain_manifolds import PLAIN
from scenes import random_field, seeded, small_scene
from torch import Tensor

from rsrm_gen.trainer.link import Exponential
from rsrm_gen.trainer.model import ArrivalTime, SplatField
from rsrm_gen.trainer.plan import plan
from rsrm_gen.trainer.scene import Scene


def free_arrival(scene: Scene) -> ArrivalTime:
    """T = d: every path is a geodesic."""
    field = SplatField(scene.manifold, 1, scene.goal.dtype)
    field.append(scene.goal[None], 0.5)
    return ArrivalTime(field, Exponential(), scene.manifold, scene.goal)


@pytest.mark.parametrize("name", PLAIN)
def test_in_free_space_a_path_is_the_geodesic_to_the_goal(tmp_path: Path, name: str) -> None:
    scene = small_scene(tmp_path, name, obstacles=False)
    starts = scene.sample(12, seeded())
    paths = plan(free_arrival(scene), scene, starts, step=0.05)
    d = scene.manifold.distance(starts, scene.goal)
    assert paths.reached.all()
    assert torch.allclose(paths.length, d, atol=1e-9)
    assert torch.allclose(paths.cost, d, atol=1e-9)
    assert torch.allclose(paths.value, d, atol=1e-9)
    assert not paths.entered.any()
    for start, points in zip(starts, paths.points, strict=True):
        assert torch.equal(points[0], start)
        assert torch.equal(points[-1], scene.goal)
        assert scene.manifold.distance(points[:-1], points[1:]).max() < 0.05 + 1e-9


def test_a_path_through_an_obstacle_costs_the_integral_of_the_slowness(tmp_path: Path) -> None:
    """On a line through the ball of radius 0.4 around c, s = 1 + 9 sigmoid((0.4 - |x - c|) / w) has an antiderivative:
    that of sigmoid is softplus."""
    scene = small_scene(tmp_path, "R2")
    c = scene.centers[0]
    start = 2 * c / c.norm() * 0.95
    paths = plan(free_arrival(scene), scene, start[None])

    def antiderivative(u: float) -> float:  # of sigmoid((0.4 - u) / w) in u
        return -scene.law.width * math.log1p(math.exp((0.4 - u) / scene.law.width))

    ends = (float((start - c).norm()), float(c.norm()))
    slow = sum(antiderivative(end) - antiderivative(0.0) for end in ends)
    assert float(paths.cost[0]) == pytest.approx(1.9 + 9 * slow, abs=1e-3)
    assert paths.entered.all()
    assert float(paths.clearance[0]) == pytest.approx(-0.4, abs=5e-3)


def test_a_path_through_an_obstacle_is_refused_where_the_scene_forbids_it(tmp_path: Path) -> None:
    scene = replace(small_scene(tmp_path, "R2"), forbid_obstacles=True)
    c = scene.centers[0]
    starts = torch.stack([1.9 * c / c.norm(), scene.goal.new_tensor([-1.5, 0.2])])
    assert plan(free_arrival(scene), scene, starts).refused.tolist() == [True, False]


def test_paths_that_pass_an_obstacle_by_do_not_enter_it(tmp_path: Path) -> None:
    scene = small_scene(tmp_path, "R2")
    starts = torch.tensor([[-1.5, 0.2], [0.0, 0.0]], dtype=torch.float64)
    paths = plan(free_arrival(scene), scene, starts)
    assert not paths.entered.any()
    assert float(paths.clearance[0]) == pytest.approx(float(scene.signed_distance(scene.goal)), abs=1e-9)
    assert paths.cost[1] == 0


@pytest.mark.parametrize("name", ["R2", "S2", "H2", "SO3"])
def test_descent_is_of_second_order_in_the_step(tmp_path: Path, name: str) -> None:
    scene = small_scene(tmp_path, name)
    field = random_field(scene.manifold, scene.sample(6, seeded()), seeded(1))
    with torch.no_grad():
        field.v.mul_(0.3)
    arrival = ArrivalTime(field, Exponential(), scene.manifold, scene.goal)
    start = scene.manifold.exp(scene.goal, 1.3 * scene.manifold.frame(scene.goal)[0])[None]
    at = 0.64  # so far along the path, in any of these steps

    def passed(step: float) -> Tensor:
        return plan(arrival, scene, start, step).points[0][round(at / step)]

    truth = passed(0.01)
    errors = [float(scene.manifold.distance(passed(step), truth)) for step in (0.16, 0.08, 0.04)]
    assert errors[0] > 3 * errors[1] > 9 * errors[2] > 0


def test_a_valley_away_from_the_goal_stalls_the_descent(tmp_path: Path) -> None:
    scene = small_scene(tmp_path, "R2", obstacles=False)
    trap = torch.tensor([[1.5, 0.0]], dtype=torch.float64)
    field = SplatField(scene.manifold, 1, torch.float64)
    field.append(trap, 0.3)
    with torch.no_grad():
        field.v[0] = -2.0
    arrival = ArrivalTime(field, Exponential(), scene.manifold, scene.goal)
    starts = torch.tensor([[1.7, 0.1], [-1.5, 0.0]], dtype=torch.float64)
    paths = plan(arrival, scene, starts)
    assert paths.reached.tolist() == [False, True]
    assert paths.cost[0] == math.inf
    assert scene.manifold.distance(paths.points[0][-1], trap[0]) < 0.1


def test_a_field_that_is_not_finite_reaches_nothing_and_ends(tmp_path: Path) -> None:
    scene = small_scene(tmp_path, "R2", obstacles=False)
    arrival = free_arrival(scene)
    with torch.no_grad():
        arrival.field.v[0] = float("nan")
    paths = plan(arrival, scene, torch.tensor([[1.0, 1.0]], dtype=torch.float64))
    assert not paths.reached.any()


def test_paths_stay_in_the_domain(tmp_path: Path) -> None:
    """Behind the ridge that a splat makes, T falls outwards."""
    scene = small_scene(tmp_path, "H2", obstacles=False)
    M = scene.manifold
    ridge = M.exp(scene.goal, 1.5 * M.frame(scene.goal)[0])[None]
    field = SplatField(M, 1, torch.float64)
    field.append(ridge, 0.3)
    with torch.no_grad():
        field.v[0] = 1.0
    arrival = ArrivalTime(field, Exponential(), M, scene.goal)
    start = M.exp(scene.goal, 1.8 * M.frame(scene.goal)[0])[None]
    paths = plan(arrival, scene, start)
    assert M.distance(paths.points[0], scene.goal).max() < 2 + 1e-9
    assert M.distance(paths.points[0], scene.goal).max() > 1.99


def test_no_starts_give_no_paths(tmp_path: Path) -> None:
    scene = small_scene(tmp_path, "S2")
    paths = plan(free_arrival(scene), scene, scene.goal.new_zeros(0, 3))
    assert paths.points == ()
    assert paths.cost.shape == (0,)
