"""The run folder: what comes back is what was put in, and nothing is lost or half written."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
import torch
from plain_manifolds import PLAIN, Sphere
from scenes import seeded, small_scene

from rsrm_gen.errors import UserError
from rsrm_gen.manifold import Manifold
from rsrm_gen.trainer.objectives.eikonal import Eikonal
from rsrm_gen.trainer.run import Metric, RunFolder, load_run
from rsrm_gen.trainer.scene import read_scene
from rsrm_gen.trainer.train import train

TINY = "{steps: 6, points: 32, splats: {initial: 5, add: 0}, link: {kind: quotient, floor: 0.1}}"


def trained(folder: Path, name: str = "S2") -> RunFolder:
    scene = small_scene(folder, name, TINY)
    run = RunFolder(folder / "run")
    run.create(scene)
    train(scene, run)
    return run


@pytest.mark.parametrize("name", PLAIN)
def test_a_loaded_field_is_the_trained_one(tmp_path: Path, name: str) -> None:
    scene = small_scene(tmp_path, name, TINY)
    trainer = Eikonal(scene)
    trainer.begin()
    for _ in range(3):
        trainer.advance()
    folder = RunFolder(tmp_path / "run")
    folder.create(scene)
    folder.save(trainer.arrays())
    run = load_run(tmp_path / "run", PLAIN[name])
    x = scene.sample(20, seeded())
    for ours, theirs in zip(run.arrival.evaluate(x), trainer.arrival.evaluate(x), strict=True):
        assert torch.equal(ours, theirs)
    assert run.scene.training == scene.training
    assert run.step == 3
    assert run.summary is None


def test_settings_given_on_the_command_line_come_back(tmp_path: Path) -> None:
    scene = small_scene(tmp_path, "S2", TINY).with_training(seed=77, steps=3)
    folder = RunFolder(tmp_path / "run")
    folder.create(scene)
    assert folder.read_scene(PLAIN["S2"]).training == scene.training
    settings = json.loads((tmp_path / "run" / "settings.json").read_text())
    assert settings["training"]["seed"] == 77
    assert set(settings["versions"]) == {"rsrm-gen", "torch", "numpy", "python"}


def test_a_training_is_not_overwritten_unless_forced(tmp_path: Path) -> None:
    run = trained(tmp_path)
    checkpoint = run.checkpoint.read_bytes()
    scene = small_scene(tmp_path, "S2", TINY)
    with pytest.raises(UserError, match="already holds a training") as caught:
        run.create(scene)
    assert all(way in str(caught.value) for way in ("--resume", "-o", "--force"))
    assert run.checkpoint.read_bytes() == checkpoint
    run.create(scene, force=True)
    assert not run.checkpoint.exists()
    assert run.read_metrics() == []
    assert run.read_summary() is None


def test_a_checkpoint_that_fails_to_be_written_leaves_the_old_one(tmp_path: Path) -> None:
    run = trained(tmp_path)
    before, names = run.checkpoint.read_bytes(), sorted(path.name for path in run.path.iterdir())
    with pytest.raises(ValueError, match="pickle"):
        run.save({"step": np.array([object()])})
    assert run.checkpoint.read_bytes() == before
    assert sorted(path.name for path in run.path.iterdir()) == names


def test_a_checkpoint_can_run_no_code(tmp_path: Path) -> None:
    run = trained(tmp_path)
    np.savez(run.checkpoint, v=np.array([object()]))
    with pytest.raises(UserError, match=r"checkpoint\.npz cannot be read"):
        load_run(run.path, PLAIN["S2"])


def test_broken_files_are_named(tmp_path: Path) -> None:
    run = trained(tmp_path)
    run.checkpoint.write_bytes(run.checkpoint.read_bytes()[:200])
    with pytest.raises(UserError, match=r"checkpoint\.npz cannot be read"):
        load_run(run.path, PLAIN["S2"])
    (run.path / "settings.json").write_text('{"training": {"steps": -1}}')
    with pytest.raises(UserError, match=r"settings\.json cannot be read"):
        load_run(run.path, PLAIN["S2"])


def test_a_checkpoint_of_another_manifold_does_not_fit(tmp_path: Path) -> None:
    run = trained(tmp_path)
    arrays = run.restore()
    run.save({**arrays, "mu": arrays["mu"][:, :2]})
    with pytest.raises(UserError, match="`mu` has another shape"):
        load_run(run.path, PLAIN["S2"])


def test_what_is_not_a_run_folder_is_said_to_be_none(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="not a run folder"):
        load_run(tmp_path / "nowhere")


def test_a_folder_that_cannot_be_made_is_an_error(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(UserError, match="cannot write to"):
        RunFolder(tmp_path / "file" / "run").create(small_scene(tmp_path, "S2"))


def test_a_metric_that_was_cut_off_does_not_spoil_the_others(tmp_path: Path) -> None:
    folder = RunFolder(tmp_path)
    for step in (10, 20, 30):
        folder.record(Metric(step, 1 / step, 5, 0.1 * step))
    with folder.metrics.open("a") as file:
        file.write('{"step": 40, "lo')
    assert [metric.step for metric in folder.read_metrics()] == [10, 20, 30]
    folder.drop_metrics_after(20)
    assert folder.read_metrics() == [Metric(10, 0.1, 5, 1.0), Metric(20, 0.05, 5, 2.0)]


def test_the_manifolds_file_is_found_again_from_the_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[Path] = []

    def load(name: Path, kernels: str | None = None, **parameters: object) -> Manifold:
        asked.append(name)
        return Sphere(2)

    monkeypatch.setattr("rsrm_gen.trainer.scene.load", load)
    place = tmp_path / "scenes"
    place.mkdir()
    text = 'scene: x\nmanifold: {spec: "../own/mine.yaml"}  # ours\ngoal: [0, 0, 1]\n'
    (place / "scene.yaml").write_text(text)
    folder = RunFolder(tmp_path / "a" / "b" / "run")
    folder.create(read_scene(place / "scene.yaml"))
    folder.read_scene()
    assert [path.resolve() for path in asked] == [(tmp_path / "own" / "mine.yaml").resolve()] * 2
    copied = (folder.path / "scene.yaml").read_text()
    assert copied == text.replace("../own/mine.yaml", "../../../own/mine.yaml")


def test_a_run_is_not_continued_on_another_manifold_of_the_same_name(tmp_path: Path) -> None:
    run = trained(tmp_path)

    class Larger(Sphere):
        content_hash = "another"  # type: ignore[assignment]

    with pytest.raises(UserError, match="is not the manifold any more on which"):
        load_run(run.path, Larger(2))


def test_results_of_a_field_that_changes_are_removed(tmp_path: Path) -> None:
    run = trained(tmp_path)
    stale = [run.path / name for name in ("evaluation.json", "field.png", "field.pdf")]
    for path in stale:
        path.write_text("old")
    run.create(small_scene(tmp_path, "S2", TINY), force=True)
    assert not any(path.exists() for path in [*stale, run.summary])
