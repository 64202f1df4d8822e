"""`rsrm-gen explain` tells a person what was derived: plainly, and in LaTeX that can be set."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from commands import Command, runner
from compiled import MANIFOLDS, NAMES, geometry

from rsrm_gen.compiler.cli.account import account
from rsrm_gen.compiler.cli.explain import escaped
from rsrm_gen.compiler.cli.notation import latex, latex_name
from rsrm_gen.compiler.derive.geometry import Polynomial
from rsrm_gen.compiler.spec.formula import parse
from rsrm_gen.errors import Source, Span

CHAPTERS = [
    "Points", "Tangent vectors", "Metric", "Exp and Log", "Distance", "Determinant", "Gradient", "Splat",
    "Removable singularities", "Cut locus",
]  # fmt: skip
SINGLE = ["sphere", "so3", "hyperbolic", "torus", "euclidean", "arm2"]


@pytest.fixture
def run(tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Command:
    monkeypatch.chdir(tmp_path)
    return runner(capsys, monkeypatch)


@pytest.mark.parametrize("name", SINGLE)
def test_every_chapter_is_there(name: str) -> None:
    titles = [chapter.title for chapter in account(geometry(name))]
    assert [title for title in titles if title != "Symbols"] == CHAPTERS


@pytest.mark.parametrize("name", SINGLE)
def test_every_removable_singularity_is_told_with_its_polynomial(name: str) -> None:
    found = geometry(name)
    (chapter,) = (c for c in account(found) if c.title == "Removable singularities")
    told = " ".join(fact.plain + fact.words for fact in chapter.facts)
    guards = [(a, a.guard) for f in ("exp", "log", "log_abs_det") for a in found[f].assignments if a.guard]
    for assignment, guard in guards:
        degree = max(len(p.args) - 2 for p in guard.near.atoms(Polynomial))
        assert f"{assignment.symbol} = " in told
        assert f"x < {float(guard.threshold):.6g} a polynomial of degree {degree}" in told
        assert f"at most {guard.error:.1e}" in told
    assert guards or "none" in told


def test_the_author_s_formulas_are_told_as_written(run: Command) -> None:
    ran = run("explain", "sphere")
    assert (ran.code, ran.err) == (0, "")
    for line in (
        "Exp_p(v) = cos(norm(v)) * p + sinc(norm(v)) * v",
        "Log_p(q) = t * w / norm(w)",
        "where w = e - dot(p, e) * p",
        "0 = dot(p, p) - 1",
        "log |det D Log_p(q)| = log(t_over_norm_w)",
        "where t_over_norm_w = t/norm_w",
        "where normal_part = df0*p0 + df1*p1 + df2*p2",
        "policy: declared",
        "Log_p(q) = pi * orthogonal(p)",
    ):
        assert line in ran.out


def test_a_bundled_name_a_path_and_parameters_are_understood(run: Command, tmp_path: Path) -> None:
    (tmp_path / "mine.yaml").write_text((MANIFOLDS / "sphere.yaml").read_text())
    assert run("explain", "mine.yaml").out == run("explain", "sphere").out
    assert "p in R^4" in run("explain", "sphere", "-p", "n=3").out


def test_a_product_tells_its_factors_and_their_weights(run: Command) -> None:
    out = run("explain", "se3").out
    assert "<u, v>_p = <u, v>_position + (radius)^2 <u, v>_rotation" in out
    assert "rotation: p[3:7]    (a point of so3, its lengths multiplied by radius)" in out
    assert "Factor rotation: so3" in out
    assert "where t_over_norm_s = t/norm_s" in out


def test_a_retraction_is_told_from_geodesics_and_constants_once(run: Command) -> None:
    out = run("explain", "arm2").out
    assert "a retraction and its inverse" in out
    assert out.count("b = m2 * l1 * c2") == 1
    assert "where total = " in out
    assert "joint velocities in radians per second" in out


def test_steps_are_told_when_asked_for(run: Command) -> None:
    short, long = run("explain", "sphere").out, run("explain", "sphere", "--steps").out
    assert long.startswith(short.rstrip("\n"))
    assert "Steps of log_abs_det" in long
    assert "where(norm_q_plus_p <= 4*eps, p0, q0)" in long
    assert "Choose" not in long


def test_plain_text_and_latex_can_be_had_together(run: Command) -> None:
    plain, tex = run("explain", "torus").out, run("explain", "torus", "--latex").out
    assert run("explain", "torus", "--plain").out == plain
    assert run("explain", "torus", "--latex", "--plain").out == plain + tex
    assert tex.startswith("\\documentclass")


def test_what_cannot_be_read_is_a_mistake(run: Command) -> None:
    ran = run("explain", "sfere")
    assert ran.code == 2
    assert "did you mean `sphere`?" in ran.err


# LaTeX.


def set_formula(text: str) -> None:
    """Set one formula with matplotlib's own TeX, which knows neither environments nor \\lVert."""
    mathtext = pytest.importorskip("matplotlib.mathtext")
    plain = re.sub(r"\\begin\{(cases|pmatrix)\}|\\end\{(cases|pmatrix)\}|&", " ", text).replace(r"\\", " ")
    plain = plain.replace(r"\lVert", r"\Vert").replace(r"\rVert", r"\Vert")
    plain = plain.replace(r"\lvert", r"\vert").replace(r"\rvert", r"\vert").replace(r"\tfrac12", r"\frac{1}{2}")
    plain = plain.replace(r"\text{", r"\mathrm{").replace(r"\top", "T").replace(r"\_", "x")
    mathtext.MathTextParser("path").parse(f"${plain}$")


@pytest.mark.parametrize("name", NAMES)
def test_every_formula_is_latex(name: str) -> None:
    for chapter in account(geometry(name), steps=name in ("so3", "sphere")):
        for fact in chapter.facts:
            assert bool(fact.plain) == bool(fact.latex)
            assert fact.latex.count("{") == fact.latex.count("}")
            assert fact.latex.count(r"\left") == fact.latex.count(r"\right")
            if fact.latex:
                set_formula(fact.latex)


FORMULAS = {
    "(a + b) * c": r"\left(a + b\right) \, c",
    "a + b * c": r"a + b \, c",
    "a - (b - c)": r"a - \left(b - c\right)",
    "a - b - c": "a - b - c",
    "-(a + b)": r"-\left(a + b\right)",
    "a * (b * c)": r"a \, \left(b \, c\right)",
    "a / (b + c)": r"\frac{a}{b + c}",
    "(a + b)^2": r"{\left(a + b\right)}^{2}",
    "(a^b)^c": r"{\left({a}^{b}\right)}^{c}",
    "a * -b": r"a \, \left(-b\right)",
    "norm(a + b)": r"\lVert a + b \rVert",
    "dot(p, q)": r"\langle p, q \rangle",
    "p[1:]": r"{p}_{1:}",
    "p[0]": r"{p}_{0}",
    "sin(theta) <= 1/2": r"\sin\left(\theta\right) \leq \frac{1}{2}",
    "sinhc(r)": r"\operatorname{sinhc}\left(r\right)",
    "[a, [b, c]]": r"\left(a, \left(b, c\right)\right)",
    "[[a, b], [c, d]]": r"\begin{pmatrix} a & b \\ c & d \end{pmatrix}",
    "where(a < b, c, d)": r"\begin{cases} c & a < b \\ d & \text{otherwise} \end{cases}",
    "sinh_r": r"\mathit{sinh\_r}",
    "x2": "x_{2}",
    "0.5": r"0.5",
}


@pytest.mark.parametrize("text", FORMULAS)
def test_parentheses_stand_where_the_tree_needs_them(text: str) -> None:
    source = Source("text", text)
    assert latex(parse(text, Span(source, 1, 1, len(text)))) == FORMULAS[text]


@pytest.mark.parametrize(
    ("name", "tex"),
    [("norm_w", r"\lVert w \rVert"), ("norm_w_squared", r"\lVert w \rVert^2"), ("t_over_norm_w", r"\frac{t}{\lVert w \rVert}"),
     ("q_plus_p0_2", r"\mathit{q\_plus\_p0}_{2}"), ("omega1", r"\omega_{1}")],
)  # fmt: skip
def test_names_of_the_compiler_are_read(name: str, tex: str) -> None:
    assert latex_name(name) == tex


def test_words_are_escaped() -> None:
    assert escaped("R^(n+1) & 5% of {x_1} <~> \\") == (
        r"R\^{}(n+1) \& 5\% of \{x\_1\} \textless{}\~{}\textgreater{} \textbackslash{}"
    )
