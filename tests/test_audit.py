"""A manifold file with one thing wrong is refused, at the line to blame, by the promise that it breaks."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from pathlib import Path

import pytest
from compiled import MANIFOLDS, NAMES, bundled_spec

from rsrm_gen.compiler.audit import AuditReport, Check
from rsrm_gen.compiler.driver import compile_manifold
from rsrm_gen.errors import UserError


@dataclass(frozen=True)
class Mutant:
    """A bundled manifold with some text replaced: what must be said, and a piece of the line to blame."""

    manifold: str
    edits: tuple[tuple[str, str], ...]
    says: str
    blames: str = ""  # any line of the file, where several could be wrong

    def text(self) -> str:
        text = (MANIFOLDS / f"{self.manifold}.yaml").read_text()
        for old, new in self.edits:
            assert old in text, f"the bundled file no longer says `{old}`"
            text = text.replace(old, new)
        return text


RETRACTION = (
    ("exp: cos(norm(v)) * p + sinc(norm(v)) * v", "exp: (p + v) / norm(p + v)"),
    ("value: t * w / norm(w)", "value: q / dot(p, q) - p"),
    ("injectivity_radius: pi", "injectivity_radius: pi / 2"),
)
ONE_LAW = r"\|grad distance\| = 1|length of Log|Gauss"  # the metric and Exp contradict each other: either may be wrong

MUTANTS = {
    "formulas that change far away": Mutant(
        "euclidean",
        (
            ("exp: p + v", "exp: where(dot(v, v) > 5, p + 3 * v, p + v)"),
            ("log: q - p", "log: where(dot(q - p, q - p) > 5, 2 * (q - p), q - p)"),
        ),
        r"Exp_p\(Log_p\(q\)\) = q",
    ),
    "a quotient whose only square is small at the antipode too": Mutant(
        "sphere",
        (("t: 2 * atan2(norm(d), norm(q + p))", "t: acos(dot(p, q))"),),
        "not finite where the points coincide|as exact as its inputs allow|mends it",
    ),
    "a diameter that is too small": Mutant("torus", (("pi * sqrt(n)", "pi"),), "diameter", "diameter:"),
    "another period than that of Exp": Mutant("torus", (("period: 2 * pi", "period: 2"),), "period", "period:"),
    "a Log on the cut locus of another length": Mutant(
        "sphere", (("log: pi * orthogonal", "log: 2 * orthogonal"),), "cut locus|distance", "log: 2"
    ),
    "a projection that is none": Mutant(
        "sphere", (("project: p / norm(p)", "project: p / dot(p, p)"),), "onto the manifold", "project:"
    ),
    "a sign in Exp": Mutant(
        "sphere", (("p + sinc", "p - sinc"),), r"Exp_p\(Log_p\(q\)\) = q", "exp: cos"
    ),
    "Exp too fast": Mutant("torus", (("wrap(p + v)", "wrap(p + 2 * v)"),), r"Exp_p\(Log_p\(q\)\) = q", "exp:"),
    "Exp that leaves the manifold": Mutant(
        "sphere", (("sinc(norm(v)) * v", "1.1 * sinc(norm(v)) * v"),), "satisfies the constraint", "exp: cos"
    ),
    "Log of the other side": Mutant("so3", (("qmul(conj(p), q)", "qmul(conj(q), p)"),), r"Exp_p\(Log_p\(q\)\) = q"),
    "Log in another tangent space": Mutant(
        "sphere", (("d - dot(p, d) * p", "d - dot(q, d) * q"),), "tangent to the manifold at p", "value: t * w"
    ),
    "Log that takes the long way": Mutant(
        "torus", (("log: wrap(q - p)", "log: q - p"),), "inside the injectivity radius", "log: q - p"
    ),
    "one entry of the metric": Mutant("sphere", (("dot(u, v)", "dot(u, v) + u[0] * v[0]"),), ONE_LAW),
    "a metric that varies under a constant Exp": Mutant(
        "torus", (("dot(u, v)", "(1 + sin(p[0])^2) * dot(u, v)"),), r"distance\(p, q\) = distance\(q, p\)|gradient"
    ),
    "an asymmetric metric": Mutant(
        "torus", (("metric: dot(u, v)", "metric: [[1, 1/2], [0, 1]]"),), "not symmetric", "metric:"
    ),
    "a negative metric": Mutant("euclidean", (("dot(u, v)", "-dot(u, v)"),), "not positive", "metric:"),
    "a quadratic metric": Mutant("euclidean", (("dot(u, v)", "dot(u, v)^2"),), "not linear", "metric:"),
    "another determinant": Mutant(
        "sphere", (("distance: t\n", "distance: t\nlog_det: n * log(t / sin(t))\n"),), "determinant", "log_det:"
    ),
    "another distance": Mutant(
        "sphere", (("distance: t\n", "distance: 2 * t\n"),), "distance is the length of Log", "distance: 2"
    ),
    "a distance that loses its digits": Mutant(
        "sphere", (("distance: t\n", "distance: acos(dot(p, q))\n"),), "distance of the .* code .* exact"
    ),
    "another norm": Mutant("hyperbolic", (("norm: r ", "norm: 2 * r "),), "norm|<u, v>_p"),
    "a projection that moves the manifold": Mutant(
        "sphere", (("project: p / norm(p)", "project: -p / norm(p)"),), "leaves its points alone", "project:"
    ),
    "a constraint of another radius": Mutant(
        "sphere", (("dot(p, p) - 1", "dot(p, p) - 4"),), "onto the manifold|constraint"
    ),
    "a frame that is not tangent": Mutant(
        "so3", (("qmul(p, [0, 1/2, 0, 0])", "qmul(p, [1/10, 1/2, 0, 0])"),), "`frame` are tangent", "[1/10"
    ),
    "a frame twice as long": Mutant("so3", (("1/2,", "1,"), ("1/2]", "1]")), "det D Log|frame|Exp"),
    "a forgotten name of a point": Mutant(
        "so3", (("sign(g[0]) * ", ""), ("abs(g[0])", "g[0]")), "same for every name of q", "equivalent:"
    ),
    "another name that is another point": Mutant(
        "so3", (("equivalent: -p", "equivalent: conj(p)"),), "same for every name of q", "equivalent:"
    ),
    "too large an injectivity radius": Mutant(
        "torus", (("radius: pi", "radius: 1.2 * pi"),), "inside the injectivity radius"
    ),
    "a retraction for Exp": Mutant("sphere", RETRACTION, ONE_LAW),
}  # fmt: skip


@pytest.mark.parametrize("name", MUTANTS)
def test_a_wrong_formula_is_refused_where_it_stands(name: str, tmp_path: Path) -> None:
    assert_refused(MUTANTS[name], tmp_path)


def assert_refused(mutant: Mutant, tmp_path: Path) -> None:
    file = tmp_path / f"{mutant.manifold}.yaml"
    file.write_text(mutant.text())
    with pytest.raises(UserError) as caught:
        compile_manifold(file)
    error = caught.value
    assert re.search(mutant.says, error.message), error.message
    assert error.span is not None
    assert error.span.source.name == str(file)
    line = file.read_text().splitlines()[error.span.line - 1]
    assert mutant.blames in line, f"blamed: {line}"
    assert 1 <= error.span.column <= len(line)


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
        assert check["points"] > 0
        assert check["error_below"] <= 10 * check["tolerance"]
    names = {check["check"] for check in document["checks"]}
    assert {"exp(log)", "log(exp)", "distance", "eikonal", "gauss", "log det", "log second reading"} <= names
    assert {f"log {code} {precision}" for code in ("torch", "C") for precision in ("float64", "float32")} <= names
    assert {row["precision"] for row in document["accuracy"]} == {"float64", "float32"}


def test_a_refusal_is_written_as_one_too() -> None:
    good = Check("exp(log)", "Exp undoes Log", 1e-14, 1e-12, 3)
    for worst in (1e-3, float("inf"), float("nan")):
        report = AuditReport("flat", "hash", (good, Check("log(exp)", "Log undoes Exp", worst, 1e-12, 3)), ())
        document = json.loads(report.json())
        assert document["passed"] is False
        assert [check["passed"] for check in document["checks"]] == [True, False]
        with pytest.raises(UserError, match="Log undoes Exp"):
            report.require()
