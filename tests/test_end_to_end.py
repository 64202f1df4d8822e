"""Manifolds that nobody wrote Python for: compiled, audited, trained on, judged and planned with, from YAML alone."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable
from pathlib import Path

import pytest
import torch
from compiled import needs_compiler

from rsrm_gen import load
from rsrm_gen.trainer import cli
from rsrm_gen.trainer.run import RunFolder

TORUS = """\
manifold: two_radii
doc: A flat torus with two radii a and b, two angles in radians.
parameters: {a: 1, b: 2}
chart:
  space: R^2
  period: 2 * pi
metric: [[a^2, 0], [0, b^2]]
exp: wrap(p + v)
log: wrap(q - p)
injectivity_radius: -pi * max([-a, -b])
diameter: pi * sqrt(a^2 + b^2)
cut_locus: {where: max(abs(wrap(q - p))) = pi, policy: tie}
"""
SPHERE = """\
manifold: globe
doc: The sphere of radius R, as unit vectors.
parameters: {R: 2}
embedded:
  space: R^3
  constraint: dot(p, p) - 1
  project: p / norm(p)
metric: R^2 * dot(u, v)
exp: cos(norm(v)) * p + sinc(norm(v)) * v
log:
  let:
    d: q - p
    w: d - dot(p, d) * p
    t: 2 * atan2(norm(d), norm(q + p))
  value: t * w / sqrt(dot(w, w))
distance: R * t
injectivity_radius: pi * R
diameter: pi * R
cut_locus:
  where: norm(q + p) <= 4 * eps
  log: pi * orthogonal(p)
  log_det: log(pi / (4 * eps))
"""
TORUS_SCENE = """\
scene: a torus with two radii
manifold: shapes/two_radii.yaml
goal: [-1.0, -1.0]
obstacles: [{center: [0.4, 0.3], radius: 1.2}]
slowness: {free: 1, obstacle: 4, width: 0.3}
evaluation: {grid: chart, cells: 30}
"""
SPHERE_SCENE = """\
scene: a globe
manifold: shapes/globe.yaml
goal: [0.0, 0.6, 0.8]
obstacles: [{center: [0.8, 0, 0.6], radius: 1}]
slowness: {free: 1, obstacle: 4, width: 0.3}
evaluation: {cells: 30}
"""
TRAINING = """\
training:
  objective: eikonal
  steps: 150
  points: 256
  link: {kind: quotient, offset: 2}
  learning_rate: 0.03
  splats: {initial: 24, add: 8, every: 40, shape: 0.7}
"""


@pytest.fixture
def rsrm(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[..., int]:
    """Runs `rsrm ARGUMENTS` in a folder with two scenes and the manifold files that they name."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "160")
    Path("shapes").mkdir()
    Path("shapes/two_radii.yaml").write_text(TORUS)
    Path("shapes/globe.yaml").write_text(SPHERE)
    Path("torus.yaml").write_text(TORUS_SCENE + TRAINING)
    Path("globe.yaml").write_text(SPHERE_SCENE + TRAINING)

    def run(*arguments: str) -> int:
        with pytest.raises(SystemExit) as caught:
            cli.main(arguments)
        return int(caught.value.code or 0)

    return run


Rsrm = Callable[..., int]
Capture = pytest.CaptureFixture[str]


def losses(run: str) -> list[float]:
    rows = [json.loads(line) for line in (Path(run) / "metrics.jsonl").read_text().splitlines()]
    return [float(row["loss"]) for row in rows]


@pytest.mark.parametrize(
    ("scene", "start", "straight"),
    [
        ("torus", [-2.0, 0.2], math.hypot(1, 2 * 1.2)),
        ("globe", [0.6, -0.64, 0.48], 2 * math.acos(0.8 * 0.48 - 0.6 * 0.64)),
    ],
)
def test_a_new_manifold_is_trained_on_and_planned_with(
    rsrm: Rsrm, capsys: Capture, scene: str, start: list[float], straight: float
) -> None:
    assert rsrm("train", f"{scene}.yaml", "--no-picture") == 0
    run = f"runs/{scene}"
    loss = losses(run)
    assert sum(loss[-3:]) < 0.7 * sum(loss[:3])  # ten are reported
    assert rsrm("plan", run, "--from", str(start), "-o", "paths.json") == 0
    (path,) = json.loads(Path("paths.json").read_text())
    assert path["reached"]
    assert straight * 0.999 <= path["length"] <= path["cost"] * 1.001  # slowness is at least 1
    assert path["cost"] < 4 * straight
    capsys.readouterr()


def test_a_new_manifold_is_judged_by_the_reference(rsrm: Rsrm, capsys: Capture) -> None:
    pytest.importorskip("eikonalfm")
    assert rsrm("train", "torus.yaml", "--no-picture") == 0
    capsys.readouterr()
    assert rsrm("eval", "runs/torus") == 0
    printed = capsys.readouterr().out
    assert "T = d" in printed
    assert re.search(r"\d\.\d", printed)


def test_new_manifolds_measure_what_geometry_says(rsrm: Rsrm) -> None:
    torus, globe = load("shapes/two_radii.yaml", b=3), load("shapes/globe.yaml")
    p, q = torch.tensor([0.5, 3.0], dtype=torch.float64), torch.tensor([1.0, -3.0], dtype=torch.float64)
    assert float(torus.distance(p, q)) == pytest.approx(math.hypot(0.5, 3 * (2 * math.pi - 6)), rel=1e-14)
    assert torus.injectivity_radius == pytest.approx(math.pi)
    north = torch.tensor([0.0, 0.0, 1.0], dtype=torch.float64)
    equator = torch.tensor([1.0, 0.0, 0.0], dtype=torch.float64)
    assert float(globe.distance(north, equator)) == pytest.approx(math.pi, rel=1e-14)
    t = math.pi / 2
    assert float(globe.log_abs_det(north, equator)) == pytest.approx(math.log(t / math.sin(t)), rel=1e-12)


@needs_compiler
def test_a_run_keeps_to_the_manifold_it_was_trained_on(rsrm: Rsrm, capsys: Capture) -> None:
    assert rsrm("train", "torus.yaml", "--no-picture", "--steps", "3") == 0
    assert RunFolder(Path("runs/torus")).read_scene().manifold.name == "two_radii"
    capsys.readouterr()


def test_a_new_manifold_that_is_wrong_stops_before_training(rsrm: Rsrm, capsys: Capture) -> None:
    Path("shapes/two_radii.yaml").write_text(TORUS.replace("exp: wrap(p + v)", "exp: wrap(p - v)"))
    assert rsrm("train", "torus.yaml") == 2
    printed = capsys.readouterr().err
    assert re.search(r"shapes/two_radii\.yaml:8:\d+: error: the audit refuses `two_radii`", printed)
    assert not Path("runs").exists()
