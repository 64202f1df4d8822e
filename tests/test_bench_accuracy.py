"""`rsrm bench accuracy` measures what it says: by peers whose error is known, and a truth that others computed."""

from __future__ import annotations

import json
import random
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import mpmath as mp
import numpy as np
import pytest
from compiled import MANIFOLDS, geometry, needs_compiler, program

from rsrm_gen.bench import rows as places
from rsrm_gen.bench.accuracy import OURS, Accuracy, accuracy
from rsrm_gen.bench.ambient import PositiveDefinite, Rotations
from rsrm_gen.bench.cli import app
from rsrm_gen.bench.measure import DETERMINANT, FUNCTIONS, LOST, Score, measure
from rsrm_gen.bench.peers import PEERS, Evaluate, Peer, bundled_name
from rsrm_gen.bench.rows import Band, Truth, band, bands
from rsrm_gen.compiler.audit.numbers import PRECISIONS, ROUTINES, grain, shaken
from rsrm_gen.compiler.lower import interpret
from rsrm_gen.compiler.spec import Spec, read_spec
from rsrm_gen.errors import UserError
from rsrm_gen.trainer.cli import main

ORACLE = np.load(Path(__file__).parent / "oracle.npz")
KEYS = {"log": "log", "distance": "dist", "log_abs_det": "logabsdet"}


def exact(spec: Spec, precision: str) -> Mapping[str, Evaluate]:
    """The program in 60 digits at the points meant, its results rounded to the precision: no code can do better."""
    routines = program(spec.name)

    def point(x: Any) -> list[Any]:
        numbers = [float(c) for c in x]
        return interpret(routines["project"], numbers)[0] if spec.embedded else numbers

    def function(name: str) -> Evaluate:
        def evaluate(a: Any, b: Any) -> Any:
            pairs = [
                (point(p), [float(c) for c in x] if name == "exp" else point(x)) for p, x in zip(a, b, strict=True)
            ]
            results = [interpret(routines[name], *pair)[0] for pair in pairs]
            return np.array([[float(x) for x in result] for result in results]).astype(precision)

        return evaluate

    return {name: function(name) for name in ROUTINES}


def peer(functions: Any, name: str = "fake") -> Peer:
    return Peer(name, "pytest", functions)  # a package that is installed wherever this runs


def measured(*peers: Peer, manifold: str = "sphere", count: int = 4) -> Accuracy:
    return accuracy([(MANIFOLDS / f"{manifold}.yaml", {})], count, peers)


def scores(result: Accuracy, code: str) -> list[Score]:
    found = [entry.score for entry in result.entries if entry.code == code]
    assert found
    return [score for score in found if score is not None]


def known_band(*units: float) -> Band:
    """Rows with the results 1, 2, 3, ... of the distance, whatever the points."""
    count = len(units)
    points = np.zeros((count, 1))
    truth = Truth([[k + 1] for k in range(count)], np.array(units))
    return Band("known", "float64", points, points, points, {"distance": truth})


@pytest.mark.parametrize("manifold", ["hyperbolic", "so3"])
def test_an_exact_peer_is_at_most_one_unit_wrong(manifold: str) -> None:
    for score in scores(measured(peer(exact), manifold=manifold, count=3), "fake"):
        assert score.worst <= 1
        assert (score.not_finite, score.raised, score.batch_raised, score.lost) == (0, 0, False, 0)


def test_a_known_error_is_what_is_found() -> None:
    score = measure({"distance": lambda a, b: np.array([1.0, 2.5, 3.25])}, known_band(0.125, 0.125, 0.125))["distance"]
    assert score == Score(rows=3, worst=4.0, median=2.0)


def test_a_relative_error_is_as_many_units_in_the_whole_run() -> None:
    def wrong(spec: Spec, precision: str) -> Mapping[str, Evaluate]:
        right = exact(spec, precision)["distance"]
        return {"distance": lambda a, b: right(a, b) * (1 + 1000 * np.finfo(precision).eps)}

    result = measured(peer(wrong), manifold="torus")
    middle = [e.score for e in result.entries if (e.code, e.band, e.function) == ("fake", places.MIDDLE, "distance")]
    assert len(middle) == 2  # one a precision
    for score in middle:
        assert score is not None
        assert 200 < score.median <= score.worst < 1001  # a unit is one rounding of the result, and what the inputs add


def test_rows_that_are_not_finite_or_lost_are_counted() -> None:
    found = np.array([np.nan, 2.0, np.inf, 4.0 + 2 * LOST, 5.0])
    score = measure({"distance": lambda a, b: found}, known_band(1, 1, 1, 1, 1))["distance"]
    assert score == Score(rows=5, worst=np.inf, median=2 * LOST, not_finite=2, lost=1)


def test_a_row_that_raises_is_told_from_a_batch_that_does() -> None:
    def raises(a: Any, b: Any) -> Any:
        if len(a) > 1:
            raise ValueError("one of them is bad")
        if next(calls) == 1:
            raise ValueError("this one")
        return np.array([1.0])

    calls = iter(range(3))
    score = measure({"distance": raises}, known_band(1, 1, 0.5))["distance"]
    assert score == Score(rows=3, worst=np.inf, median=4.0, raised=1, batch_raised=True)


def test_a_function_that_a_peer_does_not_have_has_no_score() -> None:
    result = measured(peer(lambda spec, precision: {}), manifold="torus")
    assert scores(result, "fake") == []
    assert all(row[-1] == "-" for table in [*result.worst(), *result.bands()] for row in table.rows)


def test_peers_that_are_not_installed_are_skipped_and_named() -> None:
    def never(spec: Spec, precision: str) -> Mapping[str, Evaluate]:
        raise AssertionError("not installed, and used")

    result = measured(Peer("absent", "a-package-that-nobody-has-written", never), manifold="torus")
    assert result.missing == ("absent: not installed",)
    assert "absent" not in result.codes
    assert "absent: not installed" in result.foot()


def test_a_peer_that_cannot_be_imported_is_skipped_with_its_reason() -> None:
    def broken(spec: Spec, precision: str) -> Mapping[str, Evaluate]:
        raise ImportError("cannot import name 'trapz' from 'numpy'")

    result = measured(peer(broken), manifold="torus")
    assert result.missing == ("fake: cannot import name 'trapz' from 'numpy'",)
    assert "fake" not in result.codes


def test_the_determinant_is_not_blamed_for_its_logarithm() -> None:
    near = next(b for b in bands(geometry("sphere"), program("sphere"), "float64", 6) if b.name == places.NEAR)
    values = np.array([float(value[0]) for value in near.truths["log_abs_det"].values])
    one_rounding = measure({"log_abs_det": lambda a, b: values + 2.0**-52}, near)  # of |det|, which is 1 or so
    logarithm, determinant = one_rounding["log_abs_det"], one_rounding[DETERMINANT]
    assert logarithm is not None
    assert logarithm.lost > 0
    assert determinant is not None
    assert 0.9 < determinant.median < 1.1


@pytest.mark.parametrize(
    ("key", "name"), [("S2", "sphere"), ("H2", "hyperbolic"), ("SO3_quat", "so3"), ("T2", "torus"), ("R3", "euclidean")]
)
def test_the_truth_and_its_unit_are_those_of_the_oracle(key: str, name: str) -> None:
    chosen = [*range(20), *range(160, 200)]  # random, near, far
    p, q, v = (ORACLE[f"{key}/{field}"][chosen] for field in ("mu", "x", "log"))
    found = band(geometry(name), program(name), "oracle", "float64", list(zip(p, q, v, strict=True)), tuple(KEYS))
    for function, field in KEYS.items():
        theirs = ORACLE[f"{key}/{field}"][chosen].reshape(len(chosen), -1)
        unit = ORACLE[f"{key}/sens_{field}"][chosen] + 2.0**-52 * np.abs(theirs).max(axis=1)
        truth = found.truths[function]
        off = [
            max(abs(float(a - b)) for a, b in zip(x, y, strict=True)) for x, y in zip(truth.values, theirs, strict=True)
        ]
        assert (np.array(off) <= unit).all(), function
        curved = unit > 0  # the determinant of flat space has nothing to round
        assert curved.all() or (function == "log_abs_det" and name in ("torus", "euclidean"))
        assert (np.abs(np.log(truth.units[curved] / unit[curved])) < np.log(10)).all(), function


@needs_compiler
def test_both_of_our_codes_hold_their_promise_on_these_pairs() -> None:
    result = measured(manifold="so3", count=6)
    for code in OURS:
        assert len(scores(result, code)) == 2 * (4 * len(FUNCTIONS) + 3)  # at the injectivity radius Log is in doubt
        assert max(score.worst for score in scores(result, code)) <= 64


@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize("name", ["sphere", "hyperbolic", "so3", "so3_matrix", "torus"])
def test_pairs_are_as_far_apart_as_they_say(name: str, precision: str) -> None:
    chosen = list(bands(geometry(name), program(name), precision, 6))
    found = {b.name: [float(d[0]) for d in b.truths["distance"].values] for b in chosen}
    rounding = 8 * PRECISIONS[precision][2]
    assert max(found[places.COINCIDENT]) == 0
    assert 0.009 < max(found[places.NEAR]) < 0.011
    assert min(found[places.NEAR]) < 1e-12 + rounding
    assert 0.1 < min(found[places.MIDDLE]) < max(found[places.MIDDLE]) < 3.1
    if name == "hyperbolic":
        assert min(found[places.FAR]) > 2.9
        assert 29 < max(found[places.FAR]) < 31
    else:
        assert np.pi - 1e-3 < max(found[places.NEAR_RADIUS]) < np.pi
    if name in ("so3", "so3_matrix"):
        assert np.allclose(found[places.AT_RADIUS], np.pi, atol=rounding)
    if name == "so3":
        (opposite,) = (b for b in chosen if b.name == places.AT_RADIUS)
        assert (np.sum(opposite.p * opposite.q, axis=1) == 0).all()  # exactly where cos(angle / 2) = 0


def test_inputs_are_rounded_up_as_well_as_down() -> None:
    rng, x = random.Random(3), [mp.mpf(1), mp.mpf(-2)]
    with mp.workdps(60):  # in doubles 1 + 2^-53 would be 1
        near = [shaken(x, grain(x, ()), PRECISIONS["float64"][2], rng) for _ in range(20)]
    assert {float((a - b) / b * 2**53) for y in near for a, b in zip(y, x, strict=True)} == {-1.0, 1.0}


def test_pairs_at_the_border_of_the_domain_are_left_out_and_counted() -> None:
    ball = geometry("poincare"), program("poincare")
    far = next(b for b in bands(*ball, "float32", 8) if b.name == places.FAR)
    assert len(far.p) + far.left_out == 8
    assert far.left_out > 0
    assert (np.sum(np.float64(far.q) ** 2, axis=1) < 1 - 32 * np.finfo("float32").eps).all()
    assert all(np.isfinite(truth.units).all() for truth in far.truths.values())
    assert [b.left_out for b in bands(*ball, "float64", 3)] == [0, 0, 0, 0]


def test_pairs_that_were_left_out_are_said_in_the_tables() -> None:
    (table,) = (t for t in measured(manifold="poincare", count=8).bands() if t.title == "poincare, float32")
    assert {row[1] for row in table.rows if "left out" in row[1]} == {"far away, 3..30 (4 left out)"}


def test_components_are_the_ambient_matrices_of_the_same_length() -> None:
    rng = np.random.default_rng(5)
    A, v = rng.normal(size=(4, 3, 3)), rng.normal(size=(4, 6))
    P = A @ A.transpose(0, 2, 1) + np.eye(3)
    V = PositiveDefinite.ambient(P.reshape(4, 9), v).astype(float)
    S = np.linalg.solve(P, V)
    assert np.allclose(np.trace(S @ S, axis1=1, axis2=2), np.sum(v**2, axis=1))
    assert np.allclose(PositiveDefinite.components(P.reshape(4, 9), V), v)
    R, w = np.linalg.qr(A)[0], v[:, :3]
    W = Rotations.ambient(R.reshape(4, 9), w).astype(float)
    assert np.allclose(W @ np.array([1, 0, 0]), R @ np.cross(w, [1, 0, 0])[:, :, None] @ np.ones(1))
    assert np.allclose(Rotations.components(R.reshape(4, 9), W), w)


def test_casadi_is_not_credited_with_an_eigen_decomposition_that_is_ours() -> None:
    (casadi,) = (p for p in PEERS if p.name == "CasADi")
    assert casadi.functions(read_spec(MANIFOLDS / "spd.yaml"), "float64") == {}
    assert set(casadi.functions(read_spec(MANIFOLDS / "so3_matrix.yaml"), "float64")) == set(ROUTINES)


def test_a_peer_knows_only_the_manifolds_that_come_with_this_project(tmp_path: Path) -> None:
    mine = tmp_path / "sphere.yaml"
    mine.write_text((MANIFOLDS / "sphere.yaml").read_text() + "\n# mine\n")
    assert bundled_name(read_spec(MANIFOLDS / "sphere.yaml", {"n": 4})) == "sphere"
    assert bundled_name(read_spec(MANIFOLDS / "sphere.yaml", {"radius": 2})) is None
    assert bundled_name(read_spec(mine)) is None


def test_every_peer_is_in_the_extra_of_its_name() -> None:
    text = (MANIFOLDS.parent / "pyproject.toml").read_text()
    extra = text.split("\npeers = [")[1].split("]")[0]
    assert [p for p in PEERS if f'"{p.package}>=' not in extra and p.package != "casadi"] == []


def test_the_command_writes_tables_and_figures(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    files = tmp_path / "tables.md", tmp_path / "figures.json"
    with pytest.raises(SystemExit) as done:
        main(["bench", "accuracy", "torus", "--rows", "2", "--markdown", str(files[0]), "--json", str(files[1])])
    assert done.value.code == 0
    shown = capsys.readouterr()
    assert "Worst error of all pairs, float64" in shown.out
    assert "torus, float32: rsrm-gen torch" in shown.err
    assert "| torus | Exp | " in files[0].read_text()
    document = json.loads(files[1].read_text())
    assert {e["code"] for e in document["entries"]} >= {OURS[0], "CasADi"}
    assert document["entries"][0]["score"]["rows"] == 1


def test_an_unknown_manifold_is_refused_with_a_suggestion() -> None:
    with pytest.raises(UserError, match="no bundled manifold `spere`") as refused:
        app(["accuracy", "spere"], standalone_mode=False)
    assert "sphere" in str(refused.value.hint)
