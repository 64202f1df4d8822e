"""`rsrm bench planners`: planners solve the field's problem, whatever numbers they store points in, and are judged alike."""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
import torch

from rsrm_gen.bench.planners.contest import FIELD, Contest, Found, contests
from rsrm_gen.bench.planners.layout import Ambient, Angles, Layout, NormalCoordinates, Quaternions, layout_of
from rsrm_gen.bench.planners.motion import Motions
from rsrm_gen.bench.planners.tables import document, foot, tables
from rsrm_gen.trainer import cli
from rsrm_gen.trainer.curves import Array
from rsrm_gen.trainer.run import RunFolder
from rsrm_gen.trainer.scene import Scene, read_scene
from rsrm_gen.trainer.train import train

# A scene of each layout.
SCENES: dict[type[Layout], str] = {
    Angles: """
scene: two discs on a torus
manifold: torus
goal: [-1.5, -1.5]
obstacles: [{center: [0.5, 0.2], radius: 0.6}, {center: [-2.5, 1.0], radius: 0.5}]
""",
    Quaternions: """
scene: a ball of rotations
manifold: so3
goal: [1, 0, 0, 0]
obstacles: [{center: [0.8, 0.6, 0, 0], radius: 0.5}]
""",
    Ambient: """
scene: a cap of the sphere
manifold: sphere
goal: [0, 0, 1]
obstacles: [{center: [0.8, 0, 0.6], radius: 0.4}]
""",
    NormalCoordinates: """
scene: a ball of poses
manifold: se3
goal: [-1, 0, 0, 1, 0, 0, 0]
obstacles: [{center: [0, 0, 0, 1, 0, 0, 0], radius: 0.4}]
domain: {center: [0, 0.2, 0, 0.8, 0.6, 0, 0], radius: 2.5}
""",
}
TINY = "training: {objective: eikonal, steps: 4, points: 32, splats: {initial: 5, add: 0}}\n"
LAYOUTS = list(SCENES)


def scene_of(layout: type[Layout], folder: Path, more: str = "") -> Scene:
    path = folder / "scene.yaml"
    path.write_text(SCENES[layout] + TINY + more)
    return read_scene(path)


@pytest.mark.parametrize("kind", LAYOUTS)
def test_numbers_stand_for_points_and_points_for_numbers(tmp_path: Path, kind: type[Layout]) -> None:
    scene = scene_of(kind, tmp_path)
    layout = layout_of(scene)
    assert type(layout) is kind
    for x in scene.in_double().sample(20, torch.Generator().manual_seed(0)):
        there = layout.point(layout.numbers(x))
        assert float(scene.manifold.distance(there, x)) < 1e-9


def test_the_circles_of_an_arm_are_as_long_as_its_metric_says(tmp_path: Path) -> None:
    layout = layout_of(scene_of(Angles, tmp_path))
    assert isinstance(layout, Angles)
    assert layout.weights == (1.0, 1.0)


@pytest.mark.parametrize("kind", LAYOUTS)
def test_a_motion_costs_what_its_geodesic_does_and_no_less_than_its_bound(tmp_path: Path, kind: type[Layout]) -> None:
    scene = scene_of(kind, tmp_path).in_double()
    motions = Motions(layout_of(scene))
    x = scene.sample(40, torch.Generator().manual_seed(1))
    keys = [tuple(motions.layout.numbers(each)) for each in x]
    points = np.stack([motions.point(key) for key in keys])
    at = torch.linspace(0, 1, 4001, dtype=torch.float64)
    M = scene.manifold
    for i in range(20):
        cost = motions.cost(keys[i], keys[20 + i])
        (by_rows,), _ = motions.terrain.segments(points[i : i + 1], points[20 + i : 21 + i])
        assert cost == pytest.approx(by_rows, rel=1e-12)
        v = M.log(x[i], x[20 + i])
        slowness = scene.slowness(M.exp(x[i], at[:, None] * v))
        assert cost == pytest.approx(float(M.norm(x[i], v) * torch.trapezoid(slowness, at)), rel=2e-3)
        assert motions.bound(keys[i], keys[20 + i]) <= cost * (1 + 1e-12)
    assert motions.count == 40


def test_what_is_forbidden_or_beyond_the_domain_is_not_inside(tmp_path: Path) -> None:
    scene = scene_of(NormalCoordinates, tmp_path)
    motions = Motions(layout_of(scene))
    assert motions.inside((2.49, 0.0, 0.0, 0.0, 0.0, 0.0))
    assert not motions.inside((2.4, 0.0, 0.9, 0.0, 0.0, 0.0))
    obstacle = tuple(motions.layout.numbers(scene.centers[0].double()))
    assert motions.inside(obstacle)
    forbidding = Motions(layout_of(scene_of(NormalCoordinates, tmp_path, "forbid_obstacles: true\n")))
    assert not forbidding.inside(obstacle)


def straight(planner: str, layout: Layout, start: Array, budgets: Sequence[float]) -> list[Found]:
    """A planner that goes the geodesic, from the second budget on."""
    way = (start, layout.scene.goal.numpy())
    return [Found(budget, way if i else (), 10 * i) for i, budget in enumerate(budgets)]


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A field on the torus, hardly trained."""
    folder = tmp_path_factory.mktemp("planners")
    scene, run = scene_of(Angles, folder), RunFolder(folder / "run")
    run.create(scene)
    train(scene, run)
    return run.path


@pytest.fixture(scope="module")
def found(run: Path) -> Contest:
    said: list[str] = []
    (found,) = contests([run], straight, ["A", "B"], [2.0, 1.0], 6, said.append)
    assert any("start 6 of 6" in words for words in said)
    return found


def test_every_method_answers_every_query_and_is_held_against_the_least_cost(found: Contest) -> None:
    methods = [(query.method, query.budget) for query in found.queries[:5]]
    assert methods == [(FIELD, None), ("A", 1.0), ("A", 2.0), ("B", 1.0), ("B", 2.0)]
    assert len(found.queries) == 6 * 5
    assert {query.start for query in found.queries} == set(range(6))
    assert {query.kind for query in found.queries} == {"open", "near", "shadow"}
    for query in found.queries:
        if query.budget == 1.0:
            assert query.cost is query.ratio is None
        elif query.budget == 2.0:
            assert query.cost is not None
            assert query.ratio is not None
            assert query.ratio > 1 - 1e-3
            assert query.kind != "shadow" or query.ratio > 1.001
    assert (found.manifold, found.dim, found.layout, found.splats) == ("torus", 2, "Angles", 5)


def test_the_tables_say_what_the_queries_say(found: Contest) -> None:
    (table,) = tables([found])
    assert [row[0].split(",")[0] for row in table.rows] == ["descent of the field", "A", "A", "B", "B"]
    ratios = sorted(q.ratio for q in found.queries if q.method == "A" and q.ratio is not None)
    none, straight = table.rows[1], table.rows[2]
    assert none[2:] == ("0 %", "0 %", "-", "-", "-", "-", "-")
    assert straight[1:3] == ("2", "100 %")
    assert float(straight[4]) == pytest.approx(sum(ratios) / 6, abs=1e-4)
    assert float(straight[7]) == pytest.approx(max(ratios), abs=1e-4)
    assert straight[8] == "10"
    words = foot([found], "rsrm bench planners RUN")
    assert "`rsrm bench planners RUN`" in words
    assert found.reference in words
    assert json.loads(json.dumps(document([found]), allow_nan=False))[0]["queries"][0]["method"] == FIELD


def test_without_the_planners_a_person_is_told_what_to_install(
    run: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "ompl", None)
    monkeypatch.delitem(sys.modules, "rsrm_gen.bench.planners.search", raising=False)
    with pytest.raises(SystemExit) as caught:
        cli.main(["bench", "planners", str(run)])
    assert caught.value.code == 2
    assert "pip install 'rsrm-gen[ompl]'" in capsys.readouterr().err


def test_the_command_writes_its_tables(
    run: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("rsrm_gen.bench.planners.contest.sampling_planners", lambda: straight)
    files = [tmp_path / "planners.md", tmp_path / "planners.json"]
    options = ["--quick", "--planner", "BIT*", "--markdown", str(files[0]), "--json", str(files[1])]
    with pytest.raises(SystemExit) as caught:
        cli.main(["bench", "planners", str(run), *options])
    assert caught.value.code in (0, None)
    assert "BIT*, 0.1 s" in capsys.readouterr().out
    assert f"`rsrm bench planners {run} --starts 6 --seconds 0.1 --seconds 1`" in files[0].read_text()
    assert len(json.loads(files[1].read_text())[0]["queries"]) == 6 * 3


@pytest.mark.parametrize("planner", ["RRT*", "BIT*"])
@pytest.mark.parametrize("kind", LAYOUTS)
def test_a_planner_finds_ways_on_every_layout(tmp_path: Path, kind: type[Layout], planner: str) -> None:
    pytest.importorskip("ompl")
    from rsrm_gen.bench.planners.search import search

    scene = scene_of(kind, tmp_path)
    layout = layout_of(scene)
    motions, M = Motions(layout), scene.manifold
    start = M.project(layout.scene.sample(1, torch.Generator().manual_seed(5)))[0]
    early, late = search(planner, layout, start.numpy(), [0.3, 0.6])
    assert early.seconds >= 0.3
    assert late.seconds >= 0.6
    assert late.points >= early.points > 2  # all in the first, where one iteration took longer than both
    assert late.path
    assert float(M.distance(torch.from_numpy(late.path[0]), start)) < 1e-9
    assert float(M.distance(torch.from_numpy(late.path[-1]), layout.scene.goal)) < 1e-9
    cost = motions.path_cost(late.path)
    assert scene.law.free * float(M.distance(start, layout.scene.goal)) - 1e-9 <= cost < math.inf
    assert not early.path or cost <= motions.path_cost(early.path) * (1 + 1e-9)


def test_a_planner_keeps_out_of_obstacles_that_are_forbidden(tmp_path: Path) -> None:
    pytest.importorskip("ompl")
    from rsrm_gen.bench.planners.search import search

    layout = layout_of(scene_of(Angles, tmp_path, "forbid_obstacles: true\n"))
    motions = Motions(layout)
    start = np.array([1.6, 1.6])
    straight_on = (start, layout.scene.goal.numpy())
    assert motions.clearance(straight_on) < -0.1
    (found,) = search("BIT*", layout, start, [0.5])
    assert found.path
    assert motions.clearance(found.path) > -0.02  # as fine as motions are looked at
