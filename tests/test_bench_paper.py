"""`rsrm bench paper`: the networks are the paper's, jobs are done once, tables say what the rows say."""

from __future__ import annotations

import json
import math
import re
import signal
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch
from plain_manifolds import PLAIN
from scenes import CENTER, ORIGIN, seeded, small_scene

from rsrm_gen.bench.cli import PAPER_METHODS
from rsrm_gen.bench.paper import euclidean, judge, runner
from rsrm_gen.bench.paper.descent import NetworkDescent, fill, network_arrival
from rsrm_gen.bench.paper.euclidean import PlaneJob, collected_plane, plane_jobs, plane_table
from rsrm_gen.bench.paper.jobs import Job, scene_files
from rsrm_gen.bench.paper.methods import BY_KEY, METHODS, QUICK, Method
from rsrm_gen.bench.paper.network import Network
from rsrm_gen.bench.paper.published import NetworkShape, published
from rsrm_gen.bench.paper.rows import Row, collected, grouped, spread
from rsrm_gen.bench.paper.runner import finished, run, selected
from rsrm_gen.bench.paper.tables import notes, read_rows, tables, write_all
from rsrm_gen.bench.table import latex_text
from rsrm_gen.errors import UserError
from rsrm_gen.manifold import Manifold
from rsrm_gen.trainer import cli
from rsrm_gen.trainer.evaluate import ErrorRow, Evaluation
from rsrm_gen.trainer.planning import Planning, PlanningRow
from rsrm_gen.trainer.run import Metric, RunFolder, Summary
from rsrm_gen.trainer.train import train

SMALL = NetworkShape(width=6, depth=2, learning_rate=0.01, frequency=1.5)
POINT_SIZES = {"torus": 2, "sphere": 3, "hyperbolic": 3}
TINY = "{objective: eikonal, steps: 40, points: 32, checkpoint_every: 10, splats: {initial: 5, add: 0}}"


def small_network(manifold: Manifold, shape: NetworkShape = SMALL) -> Network:
    """With biases that are not zero, so that none is forgotten."""
    network = Network(manifold, shape, torch.float64)
    network.begin(seeded(3))
    with torch.no_grad():
        for tensor in network.parameters:
            tensor.add_(0.3 * torch.randn(tensor.shape, generator=seeded(4), dtype=torch.float64))
    return network


@pytest.mark.parametrize("name", POINT_SIZES)
def test_the_networks_have_the_papers_numbers_of_parameters(name: str) -> None:
    known, size = published()[name], POINT_SIZES[name]
    assert {"torus": 33793, "sphere": 34049, "hyperbolic": 198657}[name] == known.mlp.parameters
    assert known.network.parameters(size) == known.mlp.parameters
    small = known.network.shrunk_to(known.rsrm.parameters, size)
    assert small.depth == known.network.depth
    assert (known.network.divisor, small.divisor) == (30, 1)
    assert abs(small.parameters(size) / known.rsrm.parameters - 1) < 0.03


def test_a_networks_parameters_are_those_that_it_counts() -> None:
    network = small_network(PLAIN["S2"])
    assert network.parameter_count == SMALL.parameters(3) == (7 * 6) + (7 * 6) + 7


@pytest.mark.parametrize("name", PLAIN)
@pytest.mark.parametrize("frequency", [None, 1.5])
def test_the_gradient_written_out_is_autograds(name: str, frequency: float | None, tmp_path: Path) -> None:
    scene = small_scene(tmp_path, name)
    network = small_network(scene.manifold, SMALL.model_copy(update={"frequency": frequency}))
    x = scene.sample(7, seeded()).requires_grad_()
    value, partials = network.value_and_partials(x)
    (truth,) = torch.autograd.grad(value.sum(), x, create_graph=True)
    assert torch.allclose(partials, truth, rtol=1e-11, atol=1e-13)
    # And what it becomes differentiated in the weights.
    bars = torch.randn(partials.shape, generator=seeded(1), dtype=torch.float64)
    ours, autograds = (
        torch.autograd.grad((p * bars).sum(), network.parameters[:-1], retain_graph=True) for p in (partials, truth)
    )
    assert all(torch.allclose(a, b, rtol=1e-9, atol=1e-12) for a, b in zip(ours[:-1], autograds[:-1], strict=True))


def test_t_of_a_network_has_the_gradient_that_differences_have(tmp_path: Path) -> None:
    scene = small_scene(tmp_path, "S2", "{dtype: float64, link: {kind: quotient, floor: 0.1}, objective: eikonal}")
    arrival, x = network_arrival(scene, small_network(scene.manifold)), scene.sample(5, seeded())
    gradient, v, h = arrival.time_and_gradient(x)[1], scene.manifold.frame(x)[:, 0], 1e-6
    ahead, behind = (arrival.time(scene.manifold.exp(x, side * h * v)) for side in (1, -1))
    assert torch.allclose(scene.manifold.inner(x, gradient, v), (ahead - behind) / (2 * h), rtol=1e-5, atol=1e-7)


def network_run(tmp_path: Path, name: str, stop: int | None = None, resume: bool = False) -> RunFolder:
    scene, folder = small_scene(tmp_path, "T2", TINY), RunFolder(tmp_path / name)
    if not resume:
        folder.create(scene)

    def ctrl_c(metric: Metric) -> None:
        if metric.step == stop:
            signal.raise_signal(signal.SIGINT)

    train(scene, folder, resume, ctrl_c, make=lambda scene, clock, tell: NetworkDescent(scene, SMALL, clock))
    return folder


def test_a_network_goes_on_exactly_and_lowers_its_loss(tmp_path: Path) -> None:
    straight = network_run(tmp_path, "straight")
    network_run(tmp_path, "broken", stop=17)
    broken = network_run(tmp_path, "broken", resume=True)
    a, b = straight.restore(), broken.restore()
    assert a.keys() == b.keys()
    assert all(np.array_equal(a[key], b[key]) for key in a if key != "seconds")
    summary = straight.read_summary()
    assert summary is not None
    assert (summary.splats, summary.parameters) == (0, SMALL.parameters(2))
    losses = [metric.loss for metric in straight.read_metrics()]
    assert losses[-1] < losses[0]


def test_a_checkpoint_of_another_network_is_refused(tmp_path: Path) -> None:
    arrays = network_run(tmp_path, "run").restore()
    with pytest.raises(UserError, match="another network"):
        fill(Network(PLAIN["T2"], SMALL.model_copy(update={"width": 7})), arrays, tmp_path)


# Jobs. What judges is replaced: a reference solution takes longer than all of these tests.


SCENE = f"""\
scene: small
manifold: T2
goal: {ORIGIN["T2"]}
obstacles: [{{center: {CENTER["T2"]}, radius: 0.4}}]
domain: {{center: {ORIGIN["T2"]}, radius: 2}}
training: {TINY}
"""


@pytest.fixture
def benchmark(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Three scenes on a plain manifold, of which the paper is made to know; gives the folder of the scenes."""
    monkeypatch.setattr("rsrm_gen.trainer.scene.load", lambda name, kernels=None, **parameters: PLAIN[name])
    monkeypatch.setitem(published(), PLAIN["T2"].name, published()["torus"].model_copy(update={"network": SMALL}))
    monkeypatch.setattr(judge, "solve_truth", lambda scene, console=None: ZeroReference())
    monkeypatch.setattr(judge, "evaluate_all", evaluated)
    monkeypatch.setattr(judge, "planning", planned)
    scenes = tmp_path / "scenes"
    scenes.mkdir()
    for name in ("T2-1", "T2-2", "T2-10"):
        (scenes / f"{name}.yaml").write_text(SCENE)
    (scenes / "notes.yaml").write_text("no: scene")
    return scenes


class ZeroReference:
    def time(self, x: torch.Tensor) -> torch.Tensor:
        return torch.zeros(len(x), dtype=torch.float64)


def evaluated(scene: object, fields: object, reference: object) -> Evaluation:
    rows = (ErrorRow("field", 0.25, 0.26, 0.5, 0.75), ErrorRow("T = d", 0.5, 0.5, 1, 2))
    return Evaluation("small", 10, rows, 1e-4, 1e-3, "none")


def planned(arrival: object, scene: object, reference: object) -> Planning:
    return Planning((PlanningRow("all", 200, 0.995, 0, 1.01, 1.0, 1.05, 1.5),), 1, 20.0, 1.0)


KEYS = ("recipe", "mlp", "mlp-small")


def jobs(scenes: Path, output: Path, *keys: str, seeds: tuple[int, ...] = ()) -> list[Job]:
    return selected(output, scenes, keys or KEYS, (), seeds, False)


def test_what_is_finished_is_not_done_again(benchmark: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    chosen, said = jobs(benchmark, tmp_path / "out", seeds=(1,)), []
    result = run(chosen, said.append)
    assert [row.method for row in result.rows] == list(KEYS)
    assert (result.missing, result.failures, result.interrupted) == (0, (), False)
    assert any("T2-1 by mlp (2 of 3): trained" in words for words in said)
    monkeypatch.setattr(runner, "train", None)  # whoever trained now would fail
    again = run(jobs(benchmark, tmp_path / "out", seeds=(1,)), said.append)
    assert again.rows == result.rows == finished(chosen).rows
    assert finished(jobs(benchmark, tmp_path / "out")).missing == 6


def test_a_job_that_is_asked_otherwise_is_begun_again(benchmark: Path, tmp_path: Path) -> None:
    def steps() -> int:
        return run(jobs(benchmark, tmp_path / "out", "recipe", seeds=(2,)), lambda words: None).rows[0].steps

    assert steps() == 40
    (benchmark / "T2-2.yaml").write_text(SCENE.replace("steps: 40", "steps: 20"))
    assert steps() == 20


def test_an_interrupted_job_leaves_no_row_and_goes_on(
    benchmark: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    chosen = jobs(benchmark, tmp_path / "out", "recipe", "mlp", seeds=(1,))
    record, interrupted = RunFolder.record, []

    def ctrl_c(self: RunFolder, metric: Metric) -> None:
        record(self, metric)
        if self.path == chosen[1].folder.path and metric.step == 20 and not interrupted:
            interrupted.append(metric.step)
            signal.raise_signal(signal.SIGINT)

    monkeypatch.setattr(RunFolder, "record", ctrl_c)
    result = run(chosen, lambda words: None)
    assert (len(result.rows), result.missing, result.interrupted) == (1, 1, True)
    assert not chosen[1].row_file.exists()
    assert len(collected(tmp_path / "out")) == 1
    said: list[str] = []
    assert len(run(chosen, said.append).rows) == 2
    assert any("trained further" in words for words in said)
    assert chosen[1].folder.read_metrics()[0].step == 10  # it went on: the first steps were not made twice
    assert [metric.step for metric in chosen[1].folder.read_metrics()] == [10, 20, 30, 40]


def test_ctrl_c_while_a_field_is_judged_keeps_the_training(
    benchmark: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def impatient(*arguments: object) -> Planning:
        raise KeyboardInterrupt

    chosen = jobs(benchmark, tmp_path / "out", "recipe", seeds=(1,))
    monkeypatch.setattr(judge, "planning", impatient)
    assert run(chosen, lambda words: None).interrupted
    assert not chosen[0].row_file.exists()
    monkeypatch.setattr(judge, "planning", planned)
    monkeypatch.setattr(runner, "train", None)  # the field is there: it is only judged
    assert len(run(chosen, lambda words: None).rows) == 1


def test_a_job_that_fails_is_said_and_the_others_are_done(
    benchmark: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(NetworkDescent, "final_loss", lambda self: broken())

    def broken() -> float:
        raise UserError("the network is not itself")

    result = run(jobs(benchmark, tmp_path / "out", "mlp", "recipe", seeds=(1,)), lambda words: None)
    assert [row.method for row in result.rows] == ["recipe"]
    assert result.failures == ("T2-1 by mlp: the network is not itself",)
    assert "Failed: T2-1 by mlp: the network is not itself." in foot_of(result.rows, result.failures, 1, "rsrm")


def test_scenes_are_found_by_manifold_and_seed(benchmark: Path) -> None:
    assert [file.seed for file in scene_files(benchmark, (), ())] == [1, 2, 10]
    assert [file.seed for file in scene_files(benchmark, ("T2",), (10, 1))] == [1, 10]
    with pytest.raises(UserError, match="has the seed 7"):
        scene_files(benchmark, (), (7,))
    with pytest.raises(UserError, match="has the manifold S2"):
        scene_files(benchmark, ("S2",), ())
    assert [job.file.seed for job in selected(benchmark, benchmark, ("recipe",), (), (), True)] == [1]


def test_the_papers_fifteen_scenes_are_the_default() -> None:
    files = scene_files(None, (), ())
    assert [(f.manifold, f.seed) for f in files] == [(m, s) for m in POINT_SIZES for s in range(1, 6)]


def test_methods_are_settings(benchmark: Path, tmp_path: Path) -> None:
    assert [method.key for method in METHODS] == PAPER_METHODS
    assert set(QUICK) <= set(PAPER_METHODS)
    recipe, mlp = jobs(benchmark, tmp_path / "out", "recipe", "mlp", seeds=(1,))
    assert recipe.scene.training.steps == mlp.scene.training.steps == 40
    assert recipe.network is None
    assert mlp.network == SMALL
    assert BY_KEY["recipe"].training({"seed": 3}, PLAIN["T2"], 3, quick=True) == {"seed": 3, "steps": 400}
    assert mlp.scene.training.learning_rate == SMALL.learning_rate


def test_a_scene_with_another_objective_is_no_scene_for_the_recipe(benchmark: Path, tmp_path: Path) -> None:
    (benchmark / "T2-1.yaml").write_text(SCENE.replace(TINY, "{objective: bellman}"))
    result = run(jobs(benchmark, tmp_path / "out", "recipe", seeds=(1,)), lambda words: None)
    assert "T2-1.yaml is no scene for the paper's recipe" in result.failures[0]


@pytest.mark.parametrize(("share", "count"), [(1, 504), (1 / 2, 252), (1 / 4, 126)])
def test_ours_stores_no_more_numbers_than_its_share(
    share: float, count: int, benchmark: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    method = Method("x", "x", share=share, recipe=False)
    settings = method.training({"steps": 9}, PLAIN["T2"], 5, quick=False)
    assert settings["splats"] == {"count": count}  # of 1 + 2 + 4 numbers
    assert settings["seed"] == 5
    assert "steps" not in settings


# Tables.


def foot_of(*arguments: Any) -> str:
    return " ".join(notes(*arguments))


ROW = Row(
    method="recipe",
    manifold="torus",
    seed=1,
    loss=0.02,
    milliseconds=2.0,
    seconds=8.0,
    parameters=3500,
    splats=500,
    steps=4000,
    error=0.2,
    rms=0.21,
    p95=0.4,
    maximum=1.5,
    distance_error=0.45,
    reference_error=1e-4,
    reached=1.0,
    cost_mean=1.05,
    cost_p95=1.2,
    microseconds=20.0,
    threads=2,
    others=0.0,
)
ROWS = [ROW, replace(ROW, seed=2, error=0.3, parameters=3600), replace(ROW, method="mlp", error=0.4, splats=0)]


def test_means_deviations_and_the_papers_figures_stand_side_by_side() -> None:
    paper, beyond = tables(ROWS)
    assert paper.title == "torus, seeds 1 to 2"
    cells = dict(zip(paper.headings[:1] + paper.headings[7:9], (paper.rows[0][i] for i in (0, 7, 8)), strict=True))
    assert cells == {"method": "RSRM, the paper's recipe", "final error": "0.250 ± 0.071", "paper": "0.276"}
    assert paper.rows[0][9:] == ("3550", "3534")
    assert paper.rows[1][7:9] == ("0.400", "0.324")
    assert paper.rows[-1][:1] + paper.rows[-1][7:9] == ("T = d", "0.450 ± 0.000", "0.530")
    assert beyond.rows[0][4:7] == ("100.0 %", "1.0500", "1.2000")
    words = foot_of(ROWS, (), 2, "rsrm bench paper")
    assert "Fewer seeds than 2: mlp on torus (1)" in words
    assert "NOT FINISHED: 2 trainings" in words
    assert "SHORTENED" not in words
    assert "DISTURBED" not in words
    assert "SHORTENED" in foot_of([replace(ROW, steps=400)], (), 0, "rsrm")
    assert "up to 1.5 cores" in foot_of([replace(ROW, others=1.5)], (), 0, "rsrm")


def test_manifolds_stand_in_the_papers_order_and_methods_in_ours() -> None:
    rows = [replace(ROW, manifold=m, method=k) for m in ("circle", "sphere", "torus") for k in ("ours", "recipe")]
    shown = tables(rows)
    assert [table.title.split(",")[0] for table in shown[::2]] == ["torus", "sphere", "circle"]
    assert [row[0] for row in shown[0].rows] == ["RSRM, the paper's recipe", "ours", "T = d"]
    assert shown[0].rows[1][8] == "0.276"  # of as many parameters
    assert shown[4].rows[0][8] == "-"  # the paper has no circle


def test_the_spread_is_that_of_a_sample() -> None:
    found = spread([1.0, None, 3.0])
    assert found is not None
    assert (found.mean, found.deviation) == (2.0, pytest.approx(math.sqrt(2)))
    assert str(found) == "2.00 ± 1.41"
    assert str(spread([0.000523])) == "0.000523"
    assert str(spread([1234.5])) == "1234"
    assert str(spread([0.0, 0.0])) == "0 ± 0"
    assert spread([None]) is None


def test_what_was_never_measured_is_a_dash() -> None:
    _, beyond = tables([replace(ROW, reached=None, cost_mean=None, cost_p95=None, microseconds=None)])
    assert beyond.rows[0][4:] == ("-", "-", "-", "-")


def test_rows_come_back_from_the_file_and_tables_of_them_are_the_same(tmp_path: Path) -> None:
    for row in ROWS:
        folder = tmp_path / row.method / f"{row.manifold}-{row.seed}"
        folder.mkdir(parents=True)
        (folder / "row.json").write_text(json.dumps(row.__dict__))
    write_all(tmp_path, "rsrm bench paper")
    again, plane = read_rows(tmp_path / "paper.json")
    assert plane == []
    assert {(g.method, len(g.rows)) for g in grouped(again)} == {("recipe", 2), ("mlp", 1)}
    assert tables(again) == tables(collected(tmp_path))
    assert "| RSRM, the paper's recipe | 0.0200 ± 0.0000 |" in (tmp_path / "paper.md").read_text()
    (tmp_path / "paper.json").write_text('{"rows": [{"method": "mlp"}]}')
    with pytest.raises(UserError, match="no rows of this benchmark"):
        read_rows(tmp_path / "paper.json")


def test_latex_is_well_formed_and_escaped(tmp_path: Path) -> None:
    text = tables(ROWS)[1].latex()
    begun, ended = (re.findall(rf"\\{word}{{(\w+)}}", text) for word in ("begin", "end"))
    assert begun == ["table", "tabular"]
    assert ended == begun[::-1]
    body = text[text.index(r"\toprule") : text.index(r"\bottomrule")]
    lines = [line for line in body.splitlines() if line.endswith(r"\\")]
    assert len(lines) == 4
    assert {len(re.findall(r"(?<!\\)&", line)) for line in lines} == {7}
    assert r"100.0 \%" in text
    assert r"$\pm$" in tables(ROWS)[0].latex()
    assert latex_text("a_b & 5% {~^\\} <") == (
        r"a\_b \& 5\% \{\textasciitilde{}\textasciicircum{}\textbackslash{}\} $<$"
    )


def test_the_command_trains_writes_and_makes_tables_again(
    benchmark: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def rsrm(*arguments: str) -> int:
        with pytest.raises(SystemExit) as done:
            cli.main(["bench", "paper", *arguments])
        return int(done.value.code or 0)

    out, table = tmp_path / "out", tmp_path / "table.tex"
    chosen = ["--scenes", str(benchmark), "-o", str(out), "--method", "mlp-small", "--seed", "2"]
    assert rsrm(*chosen, "--latex", str(table)) == 0
    shown = capsys.readouterr()
    assert "MLP with the RSRM's parameters" in shown.out
    assert "T2-2 by mlp-small (1 of 1): trained" in shown.err
    assert f"`rsrm bench paper --method mlp-small --seed 2 --scenes {benchmark}`" in shown.out.replace("\n", "")
    assert all((out / name).exists() for name in ("paper.json", "paper.md", "paper.tex"))
    assert r"\toprule" in table.read_text()
    monkeypatch.setattr(runner, "train", None)
    assert rsrm(*chosen, "--tables") == 0
    assert rsrm("--rows", str(out / "paper.json")) == 0
    assert capsys.readouterr().out.count("MLP with the RSRM's parameters") == 4
    assert rsrm("--method", "magic") == 2
    assert "`magic` is no method" in capsys.readouterr().err


def test_an_interrupted_command_shows_what_is_done_and_says_how_it_ended(
    benchmark: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def impatient(*arguments: object, **named: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(runner, "train", impatient)
    with pytest.raises(SystemExit) as done:
        cli.main(["bench", "paper", "--scenes", str(benchmark), "-o", str(tmp_path / "out"), "--method", "mlp"])
    assert done.value.code == cli.INTERRUPTED
    assert "NOT FINISHED: 3 trainings are missing; the same command goes on." in capsys.readouterr().out


def test_progress_is_said_seldom(monkeypatch: pytest.MonkeyPatch) -> None:
    clock, said = [0.0], []
    monkeypatch.setattr("time.monotonic", lambda: clock[0])
    say = runner._seldom(said.append)
    for clock[0] in (1.0, 9.0, 11.0, 12.0, 22.0):
        say(f"at {clock[0]:g}")
    assert said == ["at 11", "at 22"]


def test_a_finished_training_becomes_a_row(benchmark: Path, tmp_path: Path) -> None:
    (job,) = jobs(benchmark, tmp_path / "out", "mlp", seeds=(1,))
    (row,) = run([job], lambda words: None).rows
    summary = job.folder.read_summary()
    assert isinstance(summary, Summary)
    assert (row.error, row.rms, row.distance_error, row.reached) == (0.25, 0.26, 0.5, 0.995)
    assert (row.parameters, row.seconds, row.steps) == (summary.parameters, summary.seconds, 40)
    # The residual of the network that the folder holds, not of a fresh one.
    assert row.loss == pytest.approx(judge.residual(job.scene, judge.trained(job)))
    fresh = network_arrival(job.scene, Network(job.scene.manifold, SMALL, job.scene.goal.dtype))
    assert row.loss != pytest.approx(judge.residual(job.scene, fresh))


# The plane.


@pytest.mark.parametrize(("method", "steps"), [("recipe", 300), ("ours", 12)])
def test_splats_learn_the_published_regression_case(
    method: str, steps: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    job = PlaneJob(tmp_path, method, 20, 1, steps)
    result = run([], lambda words: None, plane=[job])
    (row,) = result.plane
    assert row.parameters == 20 * 7
    assert row.test_error < 0.5 * float(euclidean.data(1).test_value.square().mean())
    assert row.train_error < row.test_error * 2
    assert row.rms**2 == pytest.approx(row.test_error, rel=0.5)  # 200 points beside 10 000
    monkeypatch.setattr(euclidean, "fitted", None)
    assert run([], lambda words: None, plane=[job]).plane == (row,)
    assert replace(job, steps=steps + 1).kept() is None
    assert collected_plane(tmp_path) == [row]
    table = plane_table([row, replace(row, seed=2, test_error=row.test_error)])
    assert table.rows[0][1:3] == ("140", str(steps))
    assert "±" in table.rows[0][4]


def test_the_plane_is_fitted_by_both_methods() -> None:
    jobs = plane_jobs(Path("out"), (), quick=False)
    assert len(jobs) == len(set(jobs)) == 2 * 4 * 5
    assert {(job.method, job.steps) for job in jobs} == {("recipe", 20_000), ("ours", 60)}
    assert {job.seed for job in plane_jobs(Path("out"), (), quick=True)} == {1}


def test_the_samples_are_of_the_function_with_the_noise() -> None:
    given = euclidean.data(7)
    assert given.x.shape == (1000, 2)
    assert float((given.value - euclidean.target(given.x)).std()) == pytest.approx(0.01, rel=0.1)
    assert torch.equal(given.dense_value, euclidean.target(given.dense_x))
    assert torch.equal(euclidean.data(7).test_value, given.test_value)
    assert float(euclidean.target(torch.tensor([[0.25, 1.0]]))) == pytest.approx(1.0)  # sin(3 pi / 2) cos(3 pi)
