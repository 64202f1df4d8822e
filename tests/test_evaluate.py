"""Errors are counted where and as the module says they are."""

from __future__ import annotations

import io
import json
import math
from dataclasses import asdict, replace
from pathlib import Path

import pytest
import torch
from plain_manifolds import PLAIN, FlatTorus, Rotations
from rich.console import Console
from scenes import generated, small_scene
from torch import Tensor

from rsrm_gen.errors import UserError
from rsrm_gen.trainer.evaluate import (
    error_row,
    evaluate,
    evaluate_all,
    evaluate_run,
    evaluation_cells,
    free_cells,
    print_evaluation,
)
from rsrm_gen.trainer.reference import solve_reference
from rsrm_gen.trainer.run import RunFolder
from rsrm_gen.trainer.scene import Scene
from rsrm_gen.trainer.settings import Evaluation as Grid
from rsrm_gen.trainer.train import train


@pytest.fixture(autouse=True)
def _own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("RSRM_GEN_CACHE", str(tmp_path / "cache"))


def whole(scene: Scene, cells: int = 60) -> Scene:
    """The scene on the whole manifold, judged on that many cells a side."""
    return replace(scene, domain=None, evaluation=Grid(cells=cells))


def mean(scene: Scene, height: Tensor) -> float:
    cells = evaluation_cells(scene)
    return float((cells.volumes * height).sum() / cells.volumes.sum())


def test_the_measures_of_an_error() -> None:
    row = error_row("field", torch.tensor([3.0, -1.0, 0.0, 1.0]), torch.tensor([0.02, 0.49, 0.0, 0.49]))
    assert row.paper == pytest.approx(math.sqrt(11 / 4))
    assert row.rms == pytest.approx(math.sqrt(0.02 * 9 + 0.98))
    assert row.p95 == 1
    assert row.maximum == 3


def test_volumes_of_a_polar_grid_are_riemannian(tmp_path: Path) -> None:
    """Means over the cells are those of the manifold: of a coordinate 0 all over, of cosh r as integrated."""
    scene = whole(small_scene(tmp_path, "S2"))
    x = evaluation_cells(scene).points
    for axis in range(3):
        assert mean(scene, x[:, axis]) == pytest.approx(0, abs=1e-3)
        assert mean(scene, x[:, axis] ** 2) == pytest.approx(1 / 3, abs=1e-3)
    ball = replace(small_scene(tmp_path, "H2"), evaluation=Grid(cells=60))
    cosh = torch.cosh(ball.manifold.distance(evaluation_cells(ball).points, ball.goal))
    assert mean(ball, cosh) == pytest.approx((math.cosh(2) + 1) / 2, rel=1e-3)


class Sheared(FlatTorus):
    """A flat chart with the metric diag(1, (2 + sin y)^2), as far as volumes are concerned."""

    def frame(self, p: Tensor) -> Tensor:
        return torch.diag_embed(torch.stack([torch.ones_like(p[..., 1]), 1 / (2 + torch.sin(p[..., 1]))], -1))


def test_volumes_of_a_chart_are_riemannian(tmp_path: Path) -> None:
    scene = whole(replace(small_scene(tmp_path, "T2"), manifold=Sheared(2)))
    # The mean of sin y with the density 2 + sin y is 1/2 / 2.
    assert mean(scene, torch.sin(evaluation_cells(scene).points[:, 1])) == pytest.approx(0.25, abs=1e-3)


def test_a_chart_grid_covers_one_period(tmp_path: Path) -> None:
    x = evaluation_cells(whole(small_scene(tmp_path, "T2"), 12)).points
    assert len(x) == 144
    assert PLAIN["T2"].distance(x[:, None], x[None, :]).add(9 * torch.eye(144)).min() > 0.5


def test_only_free_cells_in_the_domain_count(tmp_path: Path) -> None:
    for name in ("R2", "T2", "S2", "H2"):
        scene = replace(small_scene(tmp_path, name), evaluation=Grid(cells=40))
        x = free_cells(scene).points
        assert (scene.manifold.distance(x, scene.centers[0]) >= 0.4).all()
        assert (scene.manifold.distance(x, scene.goal) <= 2).all()
        assert 400 < len(x) < 1600


def test_three_dimensions_are_sampled_uniformly(tmp_path: Path) -> None:
    scene = whole(small_scene(tmp_path, "SO3"), 100)
    cells = evaluation_cells(scene)
    assert len(cells.points) == 10_000
    angle = Rotations().distance(cells.points, scene.goal)
    # The angle of a uniform rotation has the density (1 - cos t) / pi.
    assert float(angle.mean()) == pytest.approx(math.pi / 2 + 2 / math.pi, abs=0.03)


def test_a_grid_that_the_manifold_has_not_is_refused(tmp_path: Path) -> None:
    scene = replace(small_scene(tmp_path, "S2"), evaluation=Grid(grid="chart"))
    with pytest.raises(UserError, match="all periodic"):
        evaluation_cells(scene)


def test_an_error_is_that_against_the_reference(tmp_path: Path) -> None:
    scene = whole(small_scene(tmp_path, "T2"), 20)
    reference = solve_reference(scene, 128)
    row = evaluate(scene, lambda x: reference.time(x) + 0.25, reference)
    for measure in (row.paper, row.rms, row.p95, row.maximum):
        assert measure == pytest.approx(0.25, abs=1e-9)


def test_no_training_at_all_is_a_row_of_its_own(tmp_path: Path) -> None:
    scene = whole(small_scene(tmp_path, "T2"), 20)
    reference = solve_reference(scene, 256)
    by_field, by_distance = evaluate_all(scene, {"field": reference.time}, reference).rows
    assert by_field.maximum == 0
    assert by_distance.name == "T = d"
    assert by_distance.maximum > 0.1  # in the shadow of the obstacle
    free = replace(scene, law=scene.law.model_copy(update={"obstacle": 1.0}))
    (by_distance,) = evaluate_all(free, {}, solve_reference(free, 256)).rows
    assert by_distance.maximum < 2e-3


def test_a_run_is_judged_and_the_verdict_kept(tmp_path: Path) -> None:
    training = "{steps: 3, points: 32, splats: {initial: 4}}"
    folder = RunFolder(tmp_path / "run")
    scene = small_scene(tmp_path, "H2", training, manifold=generated("H2"))
    folder.create(scene)
    train(scene, folder)
    evaluation = evaluate_run(folder.path, manifold=scene.manifold, cells=64)
    field, fitted, distance = evaluation.rows
    assert fitted.rms < min(field.rms, distance.rms) / 2
    assert json.loads((folder.path / "evaluation.json").read_text()) == json.loads(json.dumps(asdict(evaluation)))
    assert not [file for file in folder.path.iterdir() if file.name.startswith(".")]
    console = Console(file=io.StringIO(), width=100)
    print_evaluation(evaluation, console)
    said = console.file.getvalue()
    assert f"{evaluation.rows[0].paper:.5f}" in said
    for line in ("small H2", "field", "fitted to the reference", "T = d", "reference's own error"):
        assert line in said
