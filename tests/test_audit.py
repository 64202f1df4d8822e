"""What the audit says: how large an error is and where, how many digits agree, what was proved; of files with one
mistake, tests/test_mutants.py."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from compiled import MANIFOLDS, NAMES, bundled_spec, spec_of
from test_mutants import FILES

from rsrm_gen.compiler.audit import AuditReport, Check
from rsrm_gen.compiler.audit.digits import advice
from rsrm_gen.compiler.audit.laws import PAIRS, Laws
from rsrm_gen.compiler.derive import derive
from rsrm_gen.compiler.driver import compile_manifold
from rsrm_gen.compiler.lower import lower
from rsrm_gen.compiler.spec.formula import parse
from rsrm_gen.errors import Source, Span, UserError

HALF_LINE = FILES["half_line"]
HERE = Span(Source("file.yaml", ""), 1, 1)


def test_a_refusal_says_how_large_the_error_is_and_where(tmp_path: Path) -> None:
    file = tmp_path / "euclidean.yaml"
    file.write_text((MANIFOLDS / file.name).read_text().replace("exp: p + v", "exp: p + 3 * v"))
    with pytest.raises(UserError, match=r"the audit refuses `euclidean`: .*\(at most 1e-12\) at p = \(") as caught:
        compile_manifold(file)
    assert "log(exp)" in str(caught.value.hint)  # what else is broken


def test_a_right_closed_form_of_the_determinant_is_accepted(tmp_path: Path) -> None:
    file = tmp_path / "sphere.yaml"
    text = (MANIFOLDS / file.name).read_text()
    file.write_text(text.replace("distance: t\n", "distance: t\nlog_det: (n - 1) * log(t / sin(t))\n"))
    assert compile_manifold(file).report.passed


@pytest.mark.parametrize("name", NAMES)
def test_the_audit_of_a_bundled_manifold_keeps_every_promise(name: str) -> None:
    # The committed report: tests/test_generated.py makes it again.
    document = json.loads((MANIFOLDS.parent / "generated" / name / "audit.json").read_text())
    assert document["passed"] is True
    assert document["manifold"] == name
    assert document["content_hash"] == bundled_spec(name).content_hash
    for check in document["checks"]:
        assert check["passed"] is True
        assert check["points"] > 0 or check["exactly"]
        assert check["error_below"] <= max(10 * check["tolerance"], 1e-15)  # no bound is given below that
    names = {check["check"] for check in document["checks"]}
    assert {"log second reading", "distance", "log det"} <= {name.split(": ")[-1] for name in names}
    assert {f"log {code} {precision}" for code in ("torch", "C") for precision in ("float64", "float32")} <= names
    assert {row["precision"] for row in document["accuracy"]} == {"float64", "float32"}


def checks_of(text: str) -> dict[str, Check]:
    geometry = derive(spec_of(text))
    return {check.name: check for check in Laws(geometry, lower(geometry)).each()}


def test_straight_lines_in_a_constant_metric_are_geodesics_exactly() -> None:
    checks = checks_of((MANIFOLDS / "torus.yaml").read_text())
    assert checks["geodesic"].exact
    assert checks["speed"].exact
    assert not checks["first order"].exact
    curved = checks_of(HALF_LINE)
    assert not curved["geodesic"].exact
    assert curved["geodesic"].passed
    assert curved["geodesic"].points == PAIRS


def test_a_retraction_is_asked_for_what_it_promises_and_no_more() -> None:
    text = (MANIFOLDS / "euclidean.yaml").read_text().replace("transport: v\n", "")
    text = text.replace("metric: dot(u, v)", "metric: (1 + dot(p, p)) * dot(u, v)")
    checks = checks_of(text.replace("exp: p + v", "maps: retraction\nexp: p + v"))
    assert all(check.passed for check in checks.values())
    assert {"first order", "exp(log)", "log(exp)", "distance", "log det", "splat gradient"} <= checks.keys()
    assert not {"speed", "geodesic", "eikonal", "gauss", "symmetry", "triangle"} & checks.keys()
    wrong = checks_of(text.replace("exp: p + v", "maps: retraction\nexp: p + 2 * v"))
    assert not wrong["first order"].passed


def test_a_check_says_how_many_digits_agree() -> None:
    assert [Check("c", "", worst, 1e-12, 3).digits for worst in (3e-7, 0.0, 1e-30, float("nan"))] == [6, 15, 15, 0]
    code = Check("c", "", 8.0, 64, 3, unit=2.0**-24)  # eight units of single precision
    assert code.digits == 6
    document = json.loads(AuditReport("flat", "hash", (code,), ()).json())
    assert document["checks"][0]["digits"] == 6


LOSSES = {
    "acos(dot(p, q))": "2 * atan2(norm(q - p), norm(q + p))",
    "acos(2 * dot(p, q)^2 - 1)": "atan2(s, 2 * dot(p, q)^2 - 1)",
    "acosh(p[0] * q[0] - dot(p[1:], q[1:]))": "2 * asinh(sqrt(c) / 2)",
    "sqrt(1 - dot(p, q)^2)": "norm(d - dot(p, d) * p)",
    "sqrt(norm(p)^2 - 1)": "sinh(r)",
    "cosh(p[0] + 1) - 1": "2 * sinh((p[0] + 1) / 2)^2",
    "1 - cos(p[0])": "2 * sin(p[0] / 2)^2",
    "log(1 + p[0])": "2 * atanh(x / (2 + x))",
    "exp(p[0]) - 1": "2 * exp(p[0] / 2) * sinh(p[0] / 2)",
    "1 - dot(p, q)": "dot(d, d) / 2",
    "q - dot(p, q) * p": "d - dot(p, d) * p",
}


@pytest.mark.parametrize("formula", LOSSES)
def test_formulas_that_lose_digits_have_better_forms(formula: str) -> None:
    better = advice(parse(formula, HERE))
    assert better is not None
    assert LOSSES[formula] in better


@pytest.mark.parametrize("formula", ["acosh(2) * p", "1 + cos(p[0])", "cosh(p[0]) + 1", "log(2 * p[0])", "q - p"])
def test_formulas_that_keep_their_digits_are_left_alone(formula: str) -> None:
    tree = parse(formula, HERE)
    assert advice(tree) is None


def test_a_refusal_is_written_as_one_too() -> None:
    good = Check("exp(log)", "Exp undoes Log", 1e-14, 1e-12, 3)
    for worst in (1e-3, float("inf"), float("nan")):
        report = AuditReport("flat", "hash", (good, Check("log(exp)", "Log undoes Exp", worst, 1e-12, 3)), ())
        document = json.loads(report.json())
        assert document["passed"] is False
        assert [check["passed"] for check in document["checks"]] == [True, False]
        with pytest.raises(UserError, match="Log undoes Exp"):
            report.require()
