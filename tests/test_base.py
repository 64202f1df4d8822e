"""What stands for the distance to the goal: near it the distance, positive elsewhere, smooth where geometry allows."""

from __future__ import annotations

import math

import pytest
import torch
from scenes import seeded
from torch import Tensor

import rsrm_gen
from rsrm_gen.manifold import Manifold
from rsrm_gen.trainer.base import Chord, Distance, PeriodicChord, smooth_base

KINDS = {
    "torus": PeriodicChord,
    "cylinder": PeriodicChord,
    "se2": PeriodicChord,
    "mobile_manipulator": PeriodicChord,
    "so2": PeriodicChord,
    "circle": Chord,
    "sphere": Chord,
    "so3": Chord,
    "so3_matrix": Chord,
    "euclidean": Distance,
    "hyperbolic": Distance,
    "poincare": Distance,
    "arm2": Distance,
    "se3": Distance,
}
NAMES = sorted(KINDS)


def goal_of(manifold: Manifold) -> Tensor:
    goal = torch.full((manifold.point_size,), 0.1, dtype=torch.float64)
    goal[0] = goal[-1] = 0.7
    return manifold.project(goal)


def around(manifold: Manifold, goal: Tensor, lengths: Tensor) -> Tensor:
    """Points at these distances from the goal, each in a direction of its own."""
    directions = torch.randn(len(lengths), manifold.dim, generator=seeded(3), dtype=torch.float64)
    directions = directions / directions.norm(dim=1, keepdim=True)
    return manifold.exp(goal.expand(len(lengths), -1), lengths[:, None] * (directions @ manifold.frame(goal)))


@pytest.mark.parametrize("name", NAMES)
def test_the_geometry_chooses(name: str) -> None:
    manifold = rsrm_gen.load(name)
    assert type(smooth_base(manifold, goal_of(manifold))) is KINDS[name]


@pytest.mark.parametrize("name", NAMES)
def test_near_the_goal_it_is_the_distance_and_nowhere_else_zero(name: str) -> None:
    manifold = rsrm_gen.load(name)
    goal = goal_of(manifold)
    base = smooth_base(manifold, goal)
    lengths = torch.logspace(-6, -2, 20, dtype=torch.float64)
    x = around(manifold, goal, lengths)
    torch.testing.assert_close(base.value(x), manifold.distance(x, goal.expand_as(x)), rtol=5e-5, atol=1e-12)
    far = around(manifold, goal, torch.full((200,), 0.9 * min(manifold.injectivity_radius, 2.0), dtype=torch.float64))
    assert float(base.value(far).min()) > 0.1
    value, gradient = base.value_and_gradient(goal[None])
    assert float(value) == 0
    assert not gradient.any()


@pytest.mark.parametrize("name", NAMES)
def test_its_gradient_is_that_of_its_value(name: str) -> None:
    manifold = rsrm_gen.load(name)
    goal = goal_of(manifold)
    base = smooth_base(manifold, goal)
    x = around(manifold, goal, torch.linspace(0.05, 0.9 * min(manifold.injectivity_radius, 2.0), 30).double())
    value, gradient = base.value_and_gradient(x)
    assert torch.equal(value, base.value(x))
    h = 1e-5
    for E in manifold.frame(x).unbind(1):
        slope = (base.value(manifold.exp(x, h * E)) - base.value(manifold.exp(x, -h * E))) / (2 * h)
        torch.testing.assert_close(manifold.inner(x, gradient, E), slope, rtol=1e-6, atol=1e-7)


@pytest.mark.parametrize("name", ["torus", "cylinder", "so2", "circle", "sphere", "so3"])
def test_it_has_no_kink_where_shortest_geodesics_meet(name: str) -> None:
    """Along a geodesic through the cut locus the slope jumps for the distance and does not for this."""
    manifold = rsrm_gen.load(name)
    goal = goal_of(manifold)
    across = manifold.exp(goal, manifold.injectivity_radius * manifold.frame(goal)[0])
    direction = manifold.frame(goal)[0] if manifold.periods else -manifold.to_tangent(across, _toward(manifold, goal))
    direction = direction / manifold.norm(across, direction)
    h = 1e-3
    s = torch.tensor([-h, 0.0, h], dtype=torch.float64)
    x = manifold.exp(across.expand(3, -1), s[:, None] * direction)

    def jump(values: Tensor) -> float:
        return abs(float(values[0] - 2 * values[1] + values[2])) / h

    assert jump(manifold.distance(x, goal.expand_as(x))) > 1
    assert jump(smooth_base(manifold, goal).value(x)) < 10 * h * math.pi


def _toward(manifold: Manifold, goal: Tensor) -> Tensor:
    """The ambient direction in which a geodesic from the goal arrives after the injectivity radius, turned around."""
    last = manifold.exp(goal, (manifold.injectivity_radius - 1e-6) * manifold.frame(goal)[0])
    before = manifold.exp(goal, (manifold.injectivity_radius - 2e-6) * manifold.frame(goal)[0])
    return before - last
