"""What fields are judged by: exact where the answer is known, never far from the grid's solution, kept, and there without one."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import torch
from compiled import needs_compiler
from curve_scenes import curve_scene
from scenes import seeded
from torch import Tensor

from rsrm_gen.trainer import curves, truth
from rsrm_gen.trainer.curves import Terrain
from rsrm_gen.trainer.labels import Labels, Progress, label
from rsrm_gen.trainer.reference import Reference
from rsrm_gen.trainer.truth import Truth, back_traced, solve_truth

pytestmark = needs_compiler
BALL = "[{center: [0.5, 0.5], radius: 1.0}]"


@pytest.fixture(autouse=True)
def _own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("RSRM_GEN_CACHE", str(tmp_path / "cache"))


@pytest.mark.parametrize("name", ["torus", "sphere", "hyperbolic"])
def test_without_obstacles_it_is_the_distance(name: str, tmp_path: Path) -> None:
    scene = curve_scene(tmp_path, name)
    x = scene.sample(200, seeded())
    found = Truth(Terrain(scene), cells=64)
    distance = scene.manifold.distance(x, scene.goal.expand_as(x))
    torch.testing.assert_close(found.time(x), distance, rtol=1e-6, atol=1e-6)
    assert found.error < 1e-6


def test_two_methods_agree_and_each_states_its_error(tmp_path: Path) -> None:
    scene = curve_scene(tmp_path, "torus", BALL)
    x = scene.sample(400, seeded())
    x = x[scene.signed_distance(x) >= 0]
    found = Truth(Terrain(scene), cells=256)
    time = found.time(x)
    assert found.grid is not None
    assert found.check is not None
    assert found.check.rms < 3 * found.grid.error + 1e-3
    assert found.error < 1e-3
    # Real paths are never cheaper than the cheapest.
    assert float((found.grid.time(x) - time).min()) > -5 * found.grid.max_error - 1e-3
    assert f"{found.check.rms:.1e}" in found.note
    assert found.grid.note in found.note


def test_what_was_computed_is_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    scene = curve_scene(tmp_path, "torus", BALL)
    x = scene.sample(100, seeded())
    first, more = x[:60], x[60:]
    found = Truth(Terrain(scene), cells=64)
    times = found.time(first), found.time(more)

    def again(*_: object) -> None:
        raise AssertionError("computed again")

    monkeypatch.setattr(Truth, "_solved", again)
    assert torch.equal(found.time(first), times[0])
    kept = Truth(Terrain(scene), cells=64)
    assert torch.equal(kept.time(first), times[0])
    assert torch.equal(kept.time(more), times[1])
    assert kept.note == found.note
    with pytest.raises(AssertionError, match="computed again"):
        kept.time(x[5:])


def test_where_there_is_no_grid_it_begins_with_a_roadmap_that_is_dense_enough(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(truth, "SUPPORT", 300)
    sizes: list[int] = []

    def counted(terrain: Terrain, x: Tensor, progress: Progress) -> Labels:
        sizes.append(len(x))
        return label(terrain, x, progress)

    monkeypatch.setattr(truth, "label", counted)
    scene = curve_scene(tmp_path, "se3")
    found = Truth(Terrain(scene))
    x = scene.sample(8, seeded())
    times = found.time(x)
    assert found.grid is None
    assert found.why_no_grid in found.note
    assert sizes == [300]
    torch.testing.assert_close(times, scene.manifold.distance(x, scene.goal.expand_as(x)), rtol=1e-5, atol=1e-5)


def test_without_a_c_compiler_it_is_the_grids_solution(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(curves, "compiler", lambda: None)
    assert isinstance(solve_truth(curve_scene(tmp_path, "torus"), 64), Reference)


def test_the_way_back_down_the_grid_costs_what_the_grid_says(tmp_path: Path) -> None:
    scene = curve_scene(tmp_path, "torus", BALL)
    terrain = Terrain(scene)
    found = Truth(terrain, cells=512)
    assert found.grid is not None
    x = scene.sample(60, seeded())
    x = x[scene.signed_distance(x) >= 0]
    ways = back_traced(found.grid, x, 0.05, 0.02)
    cost, time = terrain.cost(ways), found.grid.time(x).numpy()
    assert np.median(np.abs(cost / time - 1)) < 5e-3
    assert (cost > 0.99 * time).all()
