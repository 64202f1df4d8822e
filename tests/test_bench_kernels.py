"""`rsrm bench kernels` compares before it times, and says who was wrong, who was not there and who took too long."""

from __future__ import annotations

import json
import math
import subprocess
import sys
import time
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch
from compiled import MANIFOLDS, needs_compiler
from plain_manifolds import FlatTorus, Hyperboloid, Rotations, Sphere

from rsrm_gen import Manifold, load
from rsrm_gen.bench import kernels as bench
from rsrm_gen.bench.cli import app
from rsrm_gen.bench.kernel_tables import foot, tables
from rsrm_gen.bench.kernels import Entry, Kernels, Plan
from rsrm_gen.bench.operations import FUNCTION, pair_operations
from rsrm_gen.bench.peak import fma_peak
from rsrm_gen.bench.quiet import busy_cores
from rsrm_gen.bench.steps import CONTENDERS, Contender, crew, in_torch, ours, plain
from rsrm_gen.bench.steps.closed import phi_and_slope
from rsrm_gen.bench.steps.crew import Crew, FailedError
from rsrm_gen.bench.steps.problem import Problem, problem, read_problem
from rsrm_gen.bench.steps.worker import divisor
from rsrm_gen.compiler.lower.ir import Graph, Pairs, Parameter, Program, Result, Routine
from rsrm_gen.errors import UserError
from rsrm_gen.trainer.cli import main

CASES: list[tuple[str, dict[str, int]]] = [
    ("torus", {}),
    ("sphere", {}),
    ("hyperbolic", {}),
    ("so3", {}),
    ("torus", {"n": 6}),
    ("sphere", {"n": 5}),
    ("se3", {}),
]
each_case = pytest.mark.parametrize(("name", "parameters"), CASES, ids=lambda x: str(x))
BY_KEY = {c.key: c for c in CONTENDERS}


def small(name: str, parameters: Mapping[str, int], points: int = 48, splats: int = 12) -> tuple[Manifold, Problem]:
    manifold = load(name, **parameters)
    return manifold, problem(manifold, name, points, splats)


def assert_same(m: Manifold, p: Problem, found: Any, truth: Any, tolerance: float = 1e-8) -> None:
    """Loss and gradients, that in the centres as the Riemannian gradient."""
    for part, (a, b) in enumerate(zip((found[0], *found[1]), (truth[0], *truth[1]), strict=True)):
        x, y = (torch.from_numpy(np.asarray(t, dtype="float64").copy()) for t in (a, b))
        if part == 2:
            x, y = (m.riemannian_gradient(torch.from_numpy(p.mu), t) for t in (x, y))
        assert float((x - y).norm() / y.norm()) <= tolerance, ("loss", "v", "mu", "A")[part]


def plan(*names: str, **changes: Any) -> Plan:
    default = Plan(
        cases=tuple((MANIFOLDS / f"{name}.yaml", {}) for name in names),
        sizes=((32, 8),),
        threads=(1,),
        precisions=("float64",),
        contenders=(BY_KEY["analytic"], BY_KEY["ours"]),
        rounds=2,
    )
    return replace(default, **changes)


def entries(result: Kernels) -> dict[str, Entry]:
    return {e.contender: e for e in result.entries}


@each_case
def test_all_torch_contenders_and_ours_find_one_gradient(name: str, parameters: dict[str, int]) -> None:
    m, p = small(name, parameters)
    truth = in_torch.eager(name, p, 48)()
    assert_same(m, p, in_torch.eager(name, p, 16)(), truth, 1e-12)  # chunks change nothing
    assert_same(m, p, in_torch.analytic(name, p, 24)(), truth)
    assert_same(m, p, ours.whole(m, p)(), truth)


@each_case
def test_jax_finds_the_same_gradient(name: str, parameters: dict[str, int]) -> None:
    jax = pytest.importorskip("jax")
    from rsrm_gen.bench.steps import in_jax

    jax.config.update("jax_enable_x64", True)
    m, p = small(name, parameters)
    truth = in_torch.eager(name, p, 48)()
    for make in (in_jax.doubly, in_jax.analytic):
        assert_same(m, p, make(name, p, 24)(), truth)


@pytest.mark.parametrize(
    ("name", "truth"),
    [("torus", FlatTorus()), ("sphere", Sphere()), ("hyperbolic", Hyperboloid()), ("so3", Rotations())],
)
def test_the_plain_formulas_are_those_of_the_manifolds_written_out_by_hand(name: str, truth: Any) -> None:
    _, p = small(name, {})
    x, d, away, s, v, mu, A, E = map(torch.from_numpy, (*p.points, p.v, p.mu, p.A, p.flat_frame))
    f, df = truth.splats(x, mu, *plain.splats(torch, v, A, E))
    slope = truth.norm(x, torch.exp(f)[:, None] * (away + d[:, None] * df))
    assert float(in_torch.eager(name, p, 48)()[0]) == pytest.approx(
        float(((slope - s) ** 2).mean().detach()), rel=1e-10
    )


def test_the_distance_and_its_gradient_belong_to_one_another() -> None:
    m, p = small("hyperbolic", {})
    assert np.allclose(m.norm(*map(torch.from_numpy, (p.x, p.away))), 1)


@each_case
def test_no_point_is_near_the_cut_locus_of_a_splat_and_t_does_not_overflow(
    name: str, parameters: dict[str, int]
) -> None:
    m, p = small(name, parameters)
    distance = m.distance(torch.from_numpy(p.x)[:, None], torch.from_numpy(p.mu))
    assert float(distance.max()) < 0.95 * m.injectivity_radius
    assert math.isfinite(float(in_torch.eager(name, p, 48)()[0]))


def test_phi_and_its_slope_are_smooth_across_the_series() -> None:
    c = torch.tensor([-0.9, 0.2, 0.9699, 0.9701, 0.99999, 1.0, 1.0001, 1.0299, 1.0301, 5.0, 200.0], dtype=torch.float64)
    c.requires_grad_()
    phi, eta = phi_and_slope(torch, c)
    t = torch.where(c < 1, torch.arccos(c.clamp(max=1)), torch.arccosh(c.clamp(min=1))).detach()
    expected = torch.where(c < 1, t / torch.sin(t), t / torch.sinh(t)).detach()
    expected[5] = 1
    assert torch.allclose(phi, expected, rtol=1e-12)
    (slope,) = torch.autograd.grad(phi.log().sum(), c)
    assert torch.allclose(eta, slope, rtol=1e-9)


def test_a_problem_is_the_same_after_a_file(tmp_path: Path) -> None:
    _, p = small("so3", {})
    p.part(7, 3).save(tmp_path / "p.npz")
    again = read_problem(tmp_path / "p.npz", "float32")
    assert again.x.shape == (7, 4)
    assert again.A.shape == (3, 3, 3)
    assert again.mu.dtype == np.float32
    assert np.array_equal(again.frame, p.frame[:3].astype("float32"))


@needs_compiler
def test_the_command_writes_tables_figures_and_a_picture(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    files = [tmp_path / name for name in ("tables.md", "figures.json", "bars.png")]
    chosen = ["--size", "32,8", "--threads", "1", "--precision", "float64", "--rounds", "2"]
    named = [word for key in ("eager", "ours", "kernel") for word in ("--contender", key)]
    written = [word for pair in zip(("--markdown", "--json", "--plot"), map(str, files), strict=True) for word in pair]
    with pytest.raises(SystemExit) as done:
        main(["bench", "kernels", "torus", *chosen, *named, *written])
    assert done.value.code == 0
    shown = capsys.readouterr()
    assert "Milliseconds a step, float64, one thread" in shown.out
    assert "torus, float64, 1 thread, 32 x 8: round 2 of 2" in shown.err
    document = json.loads(files[1].read_text())
    found = {e["contender"]: e for e in document["entries"]}
    assert found.keys() == {"eager", "ours", "kernel"}
    assert all(len(e["seconds"]) == 2 and min(e["seconds"]) > 0 for e in found.values())
    assert found["eager"]["error"] < 1e-12
    assert found["ours"]["error"] < 1e-8
    assert found["eager"]["ratio"] == pytest.approx(found["eager"]["median"] / found["ours"]["median"])
    assert document["peaks"][0]["per_second"] > 1e8
    assert "| torus | 32 x 8 | " in files[0].read_text()
    assert files[2].read_bytes().startswith(b"\x89PNG")


def test_a_contender_that_is_not_installed_is_skipped_and_named() -> None:
    absent = Contender("absent", "Absent", "a_package_that_nobody_has_written")
    result = bench.kernels(plan("torus", contenders=(absent, BY_KEY["ours"])))
    assert result.missing == ("Absent: a_package_that_nobody_has_written is not installed",)
    assert entries(result).keys() == {"ours"}
    assert "Left out: Absent: a_package_that_nobody_has_written is not installed." in foot(result)


def test_a_contender_that_is_wrong_is_shown_and_not_timed(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    script = tmp_path / "wrong.py"
    script.write_text(
        "from rsrm_gen.bench.steps import in_torch, plain, worker\n"
        "right = plain.residuals\n"
        "if worker.sys.argv[1] == 'analytic':\n"
        "    plain.residuals = lambda *a: right(*a) * (1 + 1e-7)\n"
        "worker.main()\n"
    )
    monkeypatch.setattr(crew, "COMMAND", (sys.executable, str(script)))
    result = bench.kernels(plan("torus"))
    found = entries(result)
    assert found["analytic"].note == "wrong by 1.0e-07"
    assert found["analytic"].seconds == ()
    assert len(found["ours"].seconds) == 2
    assert tables(result)[0].rows[0][2] == "wrong"
    assert "analytic on torus, float64: wrong by 1.0e-07" in foot(result)


def test_manifolds_that_others_have_no_formulas_for_are_ours_alone(tmp_path: Path) -> None:
    mine = tmp_path / "sphere.yaml"  # another radius would be another manifold with the same name
    mine.write_text((MANIFOLDS / "sphere.yaml").read_text() + "# mine\n")
    found = entries(bench.kernels(plan(cases=((mine, {}),))))
    assert found["analytic"].note == "no formulas for it"
    assert (found["ours"].error, len(found["ours"].seconds)) == (None, 2)


def test_a_worker_that_answers_too_late_is_stopped_and_one_that_fails_says_why(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(crew, "START", 0.0)
    monkeypatch.setattr(crew, "COMMAND", (sys.executable, "-c", "import time; time.sleep(60)"))
    with Crew(1) as workers, pytest.raises(FailedError, match=r"stopped after 0.2 s"):
        workers.ask(BY_KEY["ours"], 0.2, do="time", steps=1)
    monkeypatch.undo()
    with Crew(1) as workers:
        request = {"do": "prepare", "problem": str(tmp_path / "none.npz"), "precision": "float64", "chunk": 1}
        with pytest.raises(FailedError, match="FileNotFoundError"):
            workers.ask(BY_KEY["analytic"], 60, **request)
        (process,) = workers.workers.values()
        assert process.process.poll() is None  # it lives on


def test_what_was_measured_before_an_interruption_is_kept() -> None:
    def stop(words: str) -> None:
        if words.startswith("sphere"):
            raise KeyboardInterrupt

    result = bench.kernels(plan("torus", "sphere", contenders=(BY_KEY["ours"],)), stop)
    assert [e.manifold for e in result.entries] == ["torus"]
    assert "interrupted" in foot(result)


def known() -> Kernels:
    """Two threads and one, with round figures."""

    def entry(contender: str, threads: int, *milliseconds: float, note: str = "") -> Entry:
        seconds = tuple(t / 1000 for t in milliseconds)
        return Entry("sphere", "float32", threads, 4096, 512, contender, seconds=seconds, first=3.1, note=note)

    return Kernels(
        entries=(
            entry("eager", 1, 800),
            entry("ours", 1, 9, 8, 30),
            entry("kernel", 1, 6),
            entry("eager", 2, 400, 500, 400),
            entry("compiled", 2, 100),
            entry("jax", 2, note="RuntimeError: no"),
            entry("ours", 2, 5),
            entry("kernel", 2, 4),
        ),
        peaks={("float32", 1): 1e11, ("float32", 2): 2e11},
        operations={("sphere", "float32"): 200},
        contenders=tuple(BY_KEY[key] for key in ("eager", "compiled", "jax", "ours", "kernel")),
        missing=(),
        rounds=3,
    )


def test_medians_ratios_shares_and_goals_are_what_they_say() -> None:
    result = known()
    two = ("sphere", "float32", 2, (4096, 512))
    assert result.ratio(two, "eager") == pytest.approx(80)
    assert result.share(two) == pytest.approx(200 * 4096 * 512 / 0.004 / 2e11)
    assert result.at_peak(two) == pytest.approx(200 * 4096 * 512 / 2e11)
    found = {table.title: table.rows for table in tables(result)}
    assert found["Milliseconds a step, float32, 2 threads"] == (
        ("sphere", "4096 x 512", "400", "100", "-", "5", "4"),
    )  # fmt: skip
    assert found["Times longer than rsrm-gen, float32, 2 threads"] == (
        ("sphere", "4096 x 512", "80", "20", "-", "3.0"),
    )
    assert found["Times faster with 2 threads than with 1"] == (("sphere", "float32", "4096 x 512", "1.8", "1.5"),)
    goals = found["Aimed at, float32, 2 threads, 4096 x 512"]
    assert goals[0] == ("sphere", "times faster than eager torch", "80", "90")
    assert goals[1] == ("sphere", "times faster than JAX jit", "-", "55")
    assert goals[2] == ("sphere", "kernel, of the peak", "52 %", "55 %")
    assert "jax on sphere, float32: RuntimeError: no" in foot(result)
    json.dumps(result.document(), allow_nan=False)


def test_every_contender_can_be_drawn(tmp_path: Path) -> None:
    draw = pytest.importorskip("rsrm_gen.bench.kernel_plot").draw
    entries = tuple(replace(known().entries[0], contender=contender.key) for contender in CONTENDERS)
    draw(replace(known(), entries=entries, contenders=CONTENDERS), tmp_path / "all.svg")
    drawn = (tmp_path / "all.svg").read_text(encoding="utf-8")
    for contender in CONTENDERS:
        assert contender.name in drawn


def test_a_run_beside_other_programs_is_called_disturbed() -> None:
    result = known()
    assert "DISTURBED" not in foot(result)
    noisy = replace(result, entries=(*result.entries[:-1], replace(result.entries[-1], others=1.5)))
    assert "other programs used 1.5 cores, at worst. DISTURBED" in foot(noisy)


@pytest.mark.skipif(not Path("/proc/stat").exists(), reason="this system does not say")
def test_a_program_that_runs_is_noticed() -> None:
    busy = subprocess.Popen([sys.executable, "-c", "while True: pass"])
    try:
        time.sleep(0.5)
        assert max(busy_cores() or 0.0 for _ in range(5)) > 0.3
    finally:
        busy.kill()
        busy.wait()


def test_operations_are_counted_by_the_rule() -> None:
    graph = Graph()
    a, b = graph.input("a"), graph.input("b")
    e = graph.function("exp", graph.neg(graph.add(graph.mul(a, b), b)))
    value = graph.select(graph.function("less", a, b), e, graph.polynomial(a, tuple(map(graph_number, (1, 2, 3)))))
    inputs = tuple(Parameter(name, (), (node,)) for name, node in (("a", a), ("b", b)))
    routine = Routine("r", inputs, (), (Result("value", (), (value,)), Result("e", (), (e,))), "")
    empty = Routine("none", (), (), (), "")
    program = Program("p", (), Pairs(*(routine if k == 3 else empty for k in range(8))))
    assert pair_operations(program, "float64") == 1 + 1 + FUNCTION["float64"] + 2 * 2 + 2  # mul add exp polynomial sums


def graph_number(n: int) -> Any:
    import sympy as sp

    return sp.Integer(n)


@needs_compiler
@pytest.mark.parametrize("precision", ["float32", "float64"])
def test_the_peak_is_that_of_a_processor(precision: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("rsrm_gen.bench.peak.SECONDS", 0.01)
    assert 1e8 < fma_peak(precision, 1) < 1e13  # a loop that the compiler took away would be faster


def test_chunks_divide_the_points() -> None:
    assert [divisor(4096, 300), divisor(37, 10), divisor(12, 5), divisor(8, 99), divisor(5, 0)] == [256, 1, 4, 8, 1]


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--size", "4096x512"], "`4096x512` is no size"),
        (["--size", "0,5"], "`0,5` is no size"),
        (["--precision", "float16"], "`float16` is no precision"),
        (["--contender", "numpy"], "`numpy` is no contender"),
    ],
)
def test_what_cannot_be_meant_is_refused(options: list[str], words: str) -> None:
    with pytest.raises(UserError, match=words):
        app(["kernels", "torus", *options], standalone_mode=False)


def test_jax_is_in_the_extra_of_its_name() -> None:
    text = (MANIFOLDS.parent / "pyproject.toml").read_text()
    assert '\njax = ["jax>=' in text
