"""`rsrm` as a person meets it: what it prints, where, and its exit code."""

from __future__ import annotations

import json
import re
import signal
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from plain_manifolds import PLAIN
from scenes import ORIGIN, small_scene

from rsrm_gen import __version__
from rsrm_gen.errors import UserError
from rsrm_gen.manifold import Manifold
from rsrm_gen.trainer import cli
from rsrm_gen.trainer.clock import StopWatch, table
from rsrm_gen.trainer.run import Metric, RunFolder
from rsrm_gen.trainer.train import train

SCENE = f"""\
scene: a small scene
manifold: S2
goal: {ORIGIN["S2"]}
obstacles: [{{center: [0.8, 0, 0.6], radius: 0.3}}]
training: {{objective: eikonal, steps: 20, points: 64, splats: {{initial: 6, add: 0}}}}
"""


@pytest.fixture
def rsrm(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[..., int]:
    """Runs `rsrm ARGUMENTS` in an empty folder with the plain manifolds; gives its exit code."""

    def load(name: str, kernels: str | None = None, **parameters: object) -> Manifold:
        if name not in PLAIN:
            raise UserError(f"no manifold is called {name}")
        return PLAIN[name]

    monkeypatch.setattr("rsrm_gen.trainer.scene.load", load)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "160")
    (tmp_path / "scene.yaml").write_text(SCENE)

    def run(*arguments: str) -> int:
        with pytest.raises(SystemExit) as caught:
            cli.main(arguments)
        return int(caught.value.code or 0)

    return run


Rsrm = Callable[..., int]
Capture = pytest.CaptureFixture[str]


def test_version_and_help(rsrm: Rsrm, capsys: Capture) -> None:
    assert rsrm("--version") == 0
    assert capsys.readouterr().out == f"rsrm {__version__}\n"
    assert rsrm("--help") == 0
    text = capsys.readouterr().out
    assert all(word in text for word in ("rsrm train", "rsrm eval", "rsrm plan", "runs/scene"))
    assert rsrm("train", "--help") == 0
    assert "rsrm train --resume runs/first" in capsys.readouterr().out


def test_a_training_reports_ten_times_and_keeps_its_run_under_runs(rsrm: Rsrm, capsys: Capture) -> None:
    assert rsrm("train", "scene.yaml", "--no-picture") == 0
    printed = capsys.readouterr().out
    assert len(re.findall(r"^step \d+/20  loss \d", printed, re.MULTILINE)) == 10
    assert "6 splats (48 numbers)" in printed
    assert RunFolder(Path("runs/scene")).read_summary() is not None


def test_a_training_says_what_sums_its_splats(rsrm: Rsrm, capsys: Capture) -> None:
    assert rsrm("train", "scene.yaml", "--no-picture", "--kernels", "torch", "--steps", "1") == 0
    assert "kernels: autograd, cpu\n" in capsys.readouterr().out
    settings = json.loads(Path("runs/scene/settings.json").read_text())
    assert settings["training"]["kernels"] == "torch"
    assert rsrm("train", "scene.yaml", "--kernels", "gpu") == 2
    assert "--kernels gpu: one of auto, c, torch" in capsys.readouterr().err


def test_a_plan_says_what_the_path_costs(rsrm: Rsrm, capsys: Capture) -> None:
    assert rsrm("train", "scene.yaml", "-o", "run", "--no-picture", "--steps", "2") == 0
    capsys.readouterr()
    assert rsrm("plan", "run", "--from", "[-0.6, 0, 0.8]", "--from=0,0,1", "-o", "paths.json") == 0
    table = capsys.readouterr().out
    assert "[-0.6, 0, 0.8]" in table
    assert "true cost" in table
    paths = json.loads(Path("paths.json").read_text())
    assert [path["reached"] for path in paths] == [True, True]
    assert f"{paths[0]['cost']:.4f}" in table
    assert paths[1]["points"][0] == [0, 0, 1]
    assert paths[1]["points"][-1] == pytest.approx(ORIGIN["S2"])


def test_a_plan_through_an_obstacle_is_refused_where_the_scene_forbids_it(rsrm: Rsrm, capsys: Capture) -> None:
    forbidding = SCENE.replace("obstacles:", "forbid_obstacles: true\nobstacles:")
    Path("scene.yaml").write_text(forbidding.replace("[0.8, 0, 0.6]", "[0, 0, 1]"))
    assert rsrm("train", "scene.yaml", "-o", "run", "--no-picture", "--steps", "2") == 0
    assert rsrm("plan", "run", "--from=0,0,1", "--from=0.8,0,0.6", "-o", "paths.json") == 1
    printed = capsys.readouterr()
    assert "refused: through an obstacle" in printed.out
    assert "which the scene forbids" in printed.err
    paths = json.loads(Path("paths.json").read_text())
    assert [path["refused"] for path in paths] == [True, False]
    assert paths[0]["points"] is None


def test_ctrl_c_says_what_is_kept_and_how_to_go_on(
    rsrm: Rsrm, capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    record = RunFolder.record

    def ctrl_c(self: RunFolder, metric: Metric) -> None:
        record(self, metric)
        if metric.step == 10:
            signal.raise_signal(signal.SIGINT)

    monkeypatch.setattr(RunFolder, "record", ctrl_c)
    assert rsrm("train", "scene.yaml") == cli.INTERRUPTED
    printed = capsys.readouterr().out
    assert "stopped after step 10 of 20" in printed
    assert "rsrm train --resume runs/scene" in printed
    monkeypatch.undo()


def test_an_interrupted_training_is_resumed(rsrm: Rsrm, capsys: Capture, monkeypatch: pytest.MonkeyPatch) -> None:
    with monkeypatch.context() as patch:
        patch.setattr(RunFolder, "record", lambda self, metric: signal.raise_signal(signal.SIGINT))
        assert rsrm("train", "scene.yaml") == cli.INTERRUPTED
    assert rsrm("train", "--resume", "runs/scene", "--no-picture") == 0
    summary = RunFolder(Path("runs/scene")).read_summary()
    assert summary is not None
    assert summary.steps == 20
    capsys.readouterr()
    assert rsrm("train", "--resume", "runs/scene") == 2
    assert "--steps 40" in capsys.readouterr().err
    assert rsrm("train", "--resume", "runs/scene", "--steps", "25", "--no-picture") == 0
    assert int(RunFolder(Path("runs/scene")).restore()["step"]) == 25


MISTAKES = {
    "no such scene": (["train", "scne.yaml"], "did you mean `scene.yaml`?"),
    "no scene": (["train"], "which scene?"),
    "no steps": (["train", "scene.yaml", "--steps", "0"], "--steps must be at least 1"),
    "negative seed": (["train", "scene.yaml", "--seed", "-1"], "--seed must be"),
    "resume with a seed": (["train", "--resume", "run", "--seed", "3"], "only --steps and --kernels may be given"),
    "resume nothing": (["train", "--resume", "nowhere"], "not a run folder"),
    "again": (["train", "scene.yaml", "-o", "run"], "--force"),
    "plan in nothing": (["plan", "nowhere", "--from", "0,0,1"], "not a run folder"),
    "start is words": (["plan", "run", "--from", "here"], "not a list of numbers"),
    "start is short": (["plan", "run", "--from", "0,1"], "has 2 numbers"),
    "start is off": (["plan", "run", "--from", "0,0,3"], "the point it projects to is [0, 0, 1]"),
    "step is negative": (["plan", "run", "--from", "0,0,1", "--step", "-1"], "--step must be a positive length"),
}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_is_a_message_and_exit_code_2(rsrm: Rsrm, capsys: Capture, mistake: str) -> None:
    arguments, message = MISTAKES[mistake]
    assert rsrm("train", "scene.yaml", "-o", "run", "--steps", "1", "--no-picture") == 0
    capsys.readouterr()
    assert rsrm(*arguments) == 2
    printed = capsys.readouterr()
    assert message in printed.err
    assert "Traceback" not in printed.err + printed.out


def test_force_replaces_a_training(rsrm: Rsrm) -> None:
    assert rsrm("train", "scene.yaml", "--steps", "3", "--no-picture") == 0
    assert rsrm("train", "scene.yaml", "--steps", "2", "--no-picture", "--force") == 0
    assert int(RunFolder(Path("runs/scene")).restore()["step"]) == 2


def test_a_missing_optional_package_names_its_extra(
    rsrm: Rsrm, capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Missing:
        def find_spec(self, name: str, *_: object) -> None:
            if name == "rsrm_gen.trainer.picture":
                raise ModuleNotFoundError("No module named 'matplotlib'", name="matplotlib")
            if name == "rsrm_gen.trainer.evaluate":
                raise ModuleNotFoundError("No module named 'eikonalfm'", name="eikonalfm")

    monkeypatch.delitem(sys.modules, "rsrm_gen.trainer.picture", raising=False)
    monkeypatch.delitem(sys.modules, "rsrm_gen.trainer.evaluate", raising=False)
    monkeypatch.setattr(sys, "meta_path", [Missing(), *sys.meta_path])
    assert rsrm("train", "scene.yaml", "--steps", "1") == 0  # the field is trained and kept all the same
    assert "the picture needs matplotlib" in capsys.readouterr().err
    assert rsrm("eval", "runs/scene") == 2
    assert "pip install 'rsrm-gen[reference]'" in capsys.readouterr().err


def test_the_phases_of_a_step_add_up_to_it(tmp_path: Path) -> None:
    watch = StopWatch(warm=2)
    scene = small_scene(tmp_path, "S2", "{steps: 34, points: 32, splats: {initial: 5, add: 0, prune_below: 0}}")
    folder = RunFolder(tmp_path / "run")
    folder.create(scene)
    train(scene, folder, clock=watch)
    phases = watch.typical()
    assert {"sampling", "splat map", "kernel forward", "kernel backward", "optimiser", "logging"} <= phases.keys()
    assert watch.steps == 32
    assert phases["sampling"].frequency == 2 / 32
    assert phases["loss"].frequency == 1
    shares = [cells for column in table(watch).columns if column.header == "share" for cells in column.cells]
    assert shares[-2] == "100.0 %"


def test_a_run_is_drawn_and_reported(rsrm: Rsrm, capsys: Capture, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("rsrm_gen.trainer.report.page.read_audit", lambda name: {"checks": [], "files": {}})
    assert rsrm("train", "scene.yaml", "-o", "run", "--no-picture", "--steps", "2") == 0
    RunFolder(Path("run")).forget_results()
    assert rsrm("figure", "run", "-o", "drawn.svg", "--paths", "1") == 0
    assert "figure: drawn.svg" in capsys.readouterr().out
    assert Path("drawn.svg").read_text().startswith("<?xml")
    assert rsrm("figure", "run", "-o", "drawn.gif") == 2
    assert ".pdf, .png, .svg" in capsys.readouterr().err
    assert rsrm("figure", "nowhere") == 2
    assert rsrm("report", "nowhere") == 2
    assert rsrm("report", "run", "--paths", "1") == 0
    assert "report: run/report.html" in capsys.readouterr().out
    Path("file").write_text("")
    assert rsrm("report", "run", "--paths", "0", "-o", "file/report.html") == 2
    assert "cannot write file/report.html" in capsys.readouterr().err
