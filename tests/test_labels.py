"""Labels: the arrival time from above, lower with every path that is offered, and the same for the same points."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
import torch
from curve_scenes import around, curve_scene
from scenes import seeded

from rsrm_gen.trainer.curves import Curves, Terrain
from rsrm_gen.trainer.labels import Labels, exchanged, extended, label, offered, weighed

OBSTACLES = "[{center: [-0.3, -0.6], radius: 0.5}, {center: [0.2, -1.7], radius: 0.4}]"


@pytest.fixture
def terrain(tmp_path: Path) -> Terrain:
    return Terrain(curve_scene(tmp_path, "torus", OBSTACLES))


@pytest.fixture
def labels(terrain: Terrain) -> Labels:
    return label(terrain, around(terrain.scene, 2.8, 400))


@pytest.mark.parametrize("name", ["torus", "sphere", "hyperbolic", "so3"])
def test_where_the_slowness_is_constant_labels_are_distances(name: str, tmp_path: Path) -> None:
    terrain = Terrain(curve_scene(tmp_path, name, slowness="{free: 2}"))
    M, goal = terrain.manifold, terrain.scene.goal
    x = around(terrain.scene, 2.0, 300)
    found = label(terrain, x)
    distance = M.distance(x, goal)
    assert found.x == pytest.approx(x.numpy(), abs=1e-15)
    assert found.time == pytest.approx(2 * distance.numpy(), rel=1e-5)
    assert (found.time + found.error >= 2 * distance.numpy() * (1 - 1e-9)).all()
    away = -2 * M.log(x, goal) / distance[:, None]
    off = M.norm(x, torch.from_numpy(found.gradient) - away)
    assert float(off.median()) < 1e-3
    assert float(off.max()) < 0.05


def test_labels_are_lipschitz_where_the_field_is(terrain: Terrain, labels: Labels) -> None:
    """|T(x) - T(y)| is at most what the segment from x to y costs: every neighbour's way is worse, or it was taken."""
    i, j = (torch.randint(len(labels), (2000,), generator=seeded(k)).numpy() for k in (0, 1))
    between, _ = terrain.segments(labels.x[i], labels.x[j])
    slack = labels.error[i] + labels.error[j] + 1e-3
    assert (np.abs(labels.time[i] - labels.time[j]) <= between + slack).mean() > 0.999


def test_the_gradient_is_as_long_as_the_slowness(terrain: Terrain, labels: Labels) -> None:
    x = torch.from_numpy(labels.x)
    length = terrain.manifold.norm(x, torch.from_numpy(labels.gradient))
    assert torch.allclose(length, terrain.scene.slowness(x), rtol=1e-12)


def test_the_gradient_tells_the_change_to_near_points(terrain: Terrain, labels: Labels) -> None:
    M, x, g = terrain.manifold, torch.from_numpy(labels.x), torch.from_numpy(labels.gradient)
    step = 0.02 * M.frame(x)[:, 0]
    ahead, behind = (label_near(terrain, labels, M.exp(x, sign * step)) for sign in (1, -1))
    change = (ahead - behind) / 0.04
    off = np.abs(change - M.inner(x, g, step).numpy() / 0.02)
    assert np.median(off) < 2e-3
    assert np.quantile(off, 0.9) < 0.05  # at the rest the field has its kinks


def label_near(terrain: Terrain, labels: Labels, x: torch.Tensor) -> np.ndarray:
    return extended(terrain, labels, x).time[len(labels) :]


def the_wrong_way(terrain: Terrain, labels: Labels, rows: np.ndarray) -> Labels:
    """The same labels, those of some points from curves over a place on the other side of an obstacle."""
    over = np.array([0.5, -0.2]) + np.zeros((len(rows), 2))
    curves = Curves.between(over, terrain.scene.goal.numpy()).from_(labels.x[rows])
    relaxed = terrain.relaxed(curves)
    time, error = labels.time.copy(), labels.error.copy()
    time[rows], error[rows] = relaxed.cost, relaxed.error
    return Labels(labels.x, time, labels.gradient, error, labels.curves.replaced(rows, relaxed.curves))


def test_exchange_repairs_ways_round_the_wrong_side(terrain: Terrain, labels: Labels) -> None:
    near = terrain.manifold.distance(torch.from_numpy(labels.x), torch.tensor([0.9, -1.9]).double()).numpy()
    rows = np.flatnonzero(near < 0.8)
    wrong = the_wrong_way(terrain, labels, rows)
    worse = wrong.time[rows] > labels.time[rows] + 0.05
    assert worse.sum() > 5
    repaired = exchanged(terrain, wrong, np.ones(len(labels), bool))
    assert np.abs(repaired.time - labels.time).max() < 2e-3
    assert (repaired.time <= wrong.time).all()


def test_labels_never_rise_whatever_is_offered(terrain: Terrain, labels: Labels) -> None:
    rows = torch.randperm(len(labels), generator=seeded())[:100].numpy()
    strange = 3 * torch.randn(100, 4, 2, generator=seeded(1), dtype=torch.float64)
    ends = torch.from_numpy(labels.x[rows])
    nodes = torch.cat([ends[:, None], terrain.manifold.project(strange), terrain.scene.goal.expand(100, 1, 2)], 1)
    nodes[7, 2] = math.nan
    after = offered(terrain, labels, rows, Curves.of(list(nodes.numpy())))
    assert (after.time <= labels.time).all()
    assert np.isfinite(after.time).all()
    assert np.isfinite(after.curves.nodes).all()
    assert np.array_equal(after.x, labels.x)


def test_what_is_offered_and_cheaper_is_taken_with_its_curve(terrain: Terrain, labels: Labels) -> None:
    rows = np.flatnonzero(labels.x[:, 0] > -0.5)[:40]
    wrong = the_wrong_way(terrain, labels, rows)
    after = offered(terrain, wrong, rows, labels.curves.take(rows))
    assert np.abs(after.time - labels.time).max() < 1e-4
    assert terrain.cost(after.curves) == pytest.approx(after.time + after.error, rel=1e-9)


def test_more_points_get_labels_as_good_and_the_old_ones_do_not_rise(terrain: Terrain, labels: Labels) -> None:
    more = around(terrain.scene, 2.8, 200, seed=5)
    together = extended(terrain, labels, more)
    assert len(together) == 600
    assert np.array_equal(together.x[400:], more.numpy())
    assert (together.time[:400] <= labels.time).all()
    alone = label(terrain, torch.cat([torch.from_numpy(labels.x), more]))
    assert np.abs(together.time - alone.time).mean() < 1e-4
    assert np.quantile(np.abs(together.time - alone.time), 0.99) < 2e-3


def test_labels_go_into_arrays_and_back(labels: Labels, tmp_path: Path) -> None:
    np.savez(tmp_path / "labels.npz", **labels.arrays())
    with np.load(tmp_path / "labels.npz") as arrays:
        again = Labels.from_arrays(arrays)
    for name, array in labels.arrays().items():
        assert np.array_equal(array, again.arrays()[name])


def test_the_same_points_give_the_same_labels_on_any_number_of_threads(terrain: Terrain) -> None:
    x = around(terrain.scene, 2.8, 150)
    one = label(terrain, x)
    terrain.threads = 2
    two = label(terrain, x)
    for name, array in one.arrays().items():
        assert np.array_equal(array, two.arrays()[name])


def test_progress_is_told_to_the_end(terrain: Terrain) -> None:
    told: list[tuple[str, int, int]] = []
    label(terrain, around(terrain.scene, 2.0, 50), lambda *said: told.append(said))
    assert told[0] == ("relax", 0, 50)
    assert ("relax", 50, 50) in told
    assert all(done <= whole for _, done, whole in told)


def test_points_in_obstacles_matter_little(terrain: Terrain) -> None:
    center, radius = terrain.scene.centers[0], float(terrain.scene.radii[0])
    away = torch.tensor([[radius + 0.1], [radius], [radius - 0.05], [0.0]]).double()
    x = center + away * torch.tensor([-1.0, 0.0]).double()
    assert weighed(terrain, x).tolist() == [1.0, 1.0, 0.1, 0.01]
