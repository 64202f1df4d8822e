"""Every objective behind the one interface: that it trains, repeats, goes on exactly, and says what it is at."""

from __future__ import annotations

import json
import signal
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from compiled import needs_compiler
from scenes import GENERATED, generated, seeded, small_scene
from small_runs import interrupted_after, new_run, same

from rsrm_gen.trainer.evaluate import free_cells
from rsrm_gen.trainer.objectives import make_objective
from rsrm_gen.trainer.run import load_run
from rsrm_gen.trainer.scene import Scene, read_scene
from rsrm_gen.trainer.settings import training_of
from rsrm_gen.trainer.train import train

SETTINGS = {
    "paths": "{objective: paths, steps: 8, points: 600, splats: 30, checkpoint_every: 2}",
    "bellman": "{objective: bellman, steps: 12, points: 200, splats: 12, checkpoint_every: 4}",
    "eikonal": "{objective: eikonal, steps: 12, points: 64, splats: {initial: 12, add: 0}, checkpoint_every: 4}",
}


def scene_of(folder: Path, name: str, objective: str) -> Scene:
    return small_scene(folder, name, SETTINGS[objective], manifold=generated(name))


@pytest.mark.parametrize("objective", SETTINGS)
@pytest.mark.parametrize("step", [3, 4, 7])  # before, at and after the refinement of the labels
def test_what_was_interrupted_goes_on_exactly(tmp_path: Path, objective: str, step: int) -> None:
    scene = scene_of(tmp_path, "S2", objective)
    straight, broken = new_run(scene, tmp_path / "straight"), new_run(scene, tmp_path / "broken")
    train(scene, straight)
    assert interrupted_after(step, scene, broken).step == step
    assert train(scene, broken, resume=True).summary is not None
    assert same(straight.restore(), broken.restore())
    losses = [[(m.step, m.loss, m.phase) for m in folder.read_metrics()] for folder in (straight, broken)]
    assert losses[0] == losses[1]


def test_ctrl_c_within_the_labels_keeps_what_there_is(tmp_path: Path) -> None:
    scene = scene_of(tmp_path, "T2", "paths")
    straight, broken = new_run(scene, tmp_path / "straight"), new_run(scene, tmp_path / "broken")
    train(scene, straight)
    said: list[str] = []

    def tell(what: str, part: float) -> None:
        if not said:
            signal.raise_signal(signal.SIGINT)
        said.append(what)

    assert train(scene, broken, tell=tell).step == 0
    assert len(said) == 1
    train(scene, broken, resume=True)
    assert same(straight.restore(), broken.restore())


@pytest.mark.parametrize("name", GENERATED)
@pytest.mark.parametrize("objective", ["paths", "bellman"])
def test_it_comes_nearer_to_the_arrival_time_than_the_distance(tmp_path: Path, name: str, objective: str) -> None:
    """Behind the obstacle, the field is closer to the costs of paths than T = d is."""
    scene = scene_of(tmp_path, name, objective)
    folder = new_run(scene, tmp_path / "run")
    outcome = train(scene, folder)
    assert outcome.summary is not None
    run = load_run(folder.path, scene.manifold)
    arrays = folder.restore()
    if objective == "paths":
        x, truth = arrays["label_x"], arrays["label_time"]
        free = scene.signed_distance(scene.goal.new_tensor(x)).numpy() > 0
        x, truth = x[free], truth[free]
        found = run.arrival.time(scene.goal.new_tensor(x)).numpy()
        distance = scene.manifold.distance(scene.goal.new_tensor(x), scene.goal.expand(len(x), -1)).numpy()
        assert np.sqrt(np.mean((found - truth) ** 2)) < 0.5 * np.sqrt(np.mean((distance - truth) ** 2))
        assert np.all(truth >= distance - 1e-4)
    assert outcome.summary.loss < 0.2
    assert json.loads((folder.path / "settings.json").read_text())["training"]["objective"] == {"kind": objective}
    assert bool(run.arrival.time(scene.sample(50, seeded())).isfinite().all())


@needs_compiler
def test_coordinates_make_no_difference_to_what_is_learnt(tmp_path: Path) -> None:
    """The hyperbolic plane as a disk and as a hyperboloid: two fields of one scene, both near the same truth."""
    training = {"objective": "paths", "splats": 60, "points": 6000}
    examples = Path(__file__).parent.parent / "examples"
    sheet, disk = (
        replace(read_scene(examples / f"{name}.yaml"), training=training_of(training))
        for name in ("paper/hyperbolic-1", "poincare")
    )
    fields = []
    for scene in (sheet, disk):
        objective = make_objective(scene)
        objective.begin()
        while objective.step < objective.steps:
            objective.advance()
        fields.append(objective.arrival)
    cells = free_cells(sheet).points
    on_sheet, on_disk = fields[0].time(cells.float()), fields[1].time((cells[:, 1:] / (1 + cells[:, :1])).float())
    apart, time = (on_sheet - on_disk).square().mean().sqrt(), on_sheet.mean()
    assert float(apart) < 0.01 * float(time)
    assert float((on_sheet / on_disk - 1).abs().median()) < 0.01
