"""The mathematics: derived functions against closed forms and finite differences in 50 digits, and what is refused."""

from __future__ import annotations

import random
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import mpmath as mp
import pytest
from compiled import MANIFOLDS, bundled_spec, geometry, program, spec_of

from rsrm_gen.compiler.derive import _Derivation, derive
from rsrm_gen.compiler.derive.determinant import staged_log_det
from rsrm_gen.compiler.derive.numeric import run
from rsrm_gen.compiler.driver import compile_manifold
from rsrm_gen.compiler.lower import interpret, lower
from rsrm_gen.errors import UserError

DIGITS = 60
Point = list[Any]


@pytest.fixture(autouse=True)
def _sixty_digits() -> Any:
    with mp.workdps(DIGITS):
        yield


def dot(x: Point, y: Point) -> Any:
    return mp.fsum(a * b for a, b in zip(x, y, strict=True))


def unit(x: Point) -> Point:
    return [c / mp.sqrt(dot(x, x)) for c in x]


def gauss(rng: random.Random, size: int) -> Point:
    return [mp.mpf(rng.gauss(0, 1)) + mp.mpf(rng.random()) * mp.mpf(2) ** -53 for _ in range(size)]


def on_sphere(rng: random.Random, n: int) -> Point:
    return unit(gauss(rng, n + 1))


def on_hyperboloid(rng: random.Random, n: int) -> Point:
    s = gauss(rng, n)
    return [mp.sqrt(1 + dot(s, s)), *s]


def lorentz(x: Point, y: Point) -> Any:
    return dot(x[1:], y[1:]) - x[0] * y[0]


def angle(p: Point, q: Point) -> Any:
    return mp.acos(dot(p, q))


def rotation_angle(p: Point, q: Point) -> Any:
    return 2 * mp.acos(abs(dot(p, q)))


def hyperbolic_distance(p: Point, q: Point) -> Any:
    return mp.acosh(-lorentz(p, q))


def torus_distance(p: Point, q: Point) -> Any:
    turns = [(b - a) - 2 * mp.pi * mp.nint((b - a) / (2 * mp.pi)) for a, b in zip(p, q, strict=True)]
    return mp.sqrt(dot(turns, turns))


Draw = Callable[[random.Random], Point]
Pairing = Callable[[Point, Point], Any]

# Manifold, parameters, random points, distance, log |det D Log| as a function of the distance.
CLOSED: dict[str, tuple[str, dict[str, int], Draw, Pairing, Callable[[Any], Any]]] = {
    "so3": ("so3", {}, lambda r: on_sphere(r, 3), rotation_angle, lambda t: 2 * mp.log(t / 2 / mp.sin(t / 2))),
    **{
        f"S{n}": (
            "sphere",
            {"n": n},
            lambda r, n=n: on_sphere(r, n),
            angle,
            lambda t, n=n: (n - 1) * mp.log(t / mp.sin(t)),
        )
        for n in (1, 2, 3, 4)
    },
    **{
        f"H{n}": (
            "hyperbolic",
            {"n": n},
            lambda r, n=n: on_hyperboloid(r, n),
            hyperbolic_distance,
            lambda t, n=n: (n - 1) * mp.log(t / mp.sinh(t)),
        )
        for n in (2, 3, 4)
    },
    **{f"T{n}": ("torus", {"n": n}, lambda r, n=n: gauss(r, n), torus_distance, lambda t: mp.mpf(0)) for n in (2, 3)},
    **{
        f"R{n}": (
            "euclidean",
            {"n": n},
            lambda r, n=n: gauss(r, n),
            lambda p, q: mp.sqrt(mp.fsum((a - b) ** 2 for a, b in zip(p, q, strict=True))),
            lambda t: mp.mpf(0),
        )
        for n in (2, 4)
    },
}  # type: ignore[misc]


@pytest.mark.parametrize("case", CLOSED)
def test_distance_and_log_determinant_are_the_closed_forms(case: str) -> None:
    name, parameters, draw, distance, log_det = CLOSED[case]
    made = geometry(name, **parameters)
    rng = random.Random(11)
    for _ in range(5):
        p, q = draw(rng), draw(rng)
        t = distance(p, q)
        assert abs(run(made["distance"], p, q)[0][0] - t) < mp.mpf(10) ** -45 * t
        assert abs(run(made["log_abs_det"], p, q)[0][0] - log_det(t)) < mp.mpf(10) ** -45


@pytest.mark.parametrize("case", CLOSED)
def test_exp_goes_where_log_points_at_unit_speed(case: str) -> None:
    name, parameters, draw, distance, _ = CLOSED[case]
    made = geometry(name, **parameters)
    rng = random.Random(12)
    p, q = draw(rng), draw(rng)
    v = run(made["log"], p, q)[0]
    t = distance(p, q)
    assert abs(run(made["norm"], p, v)[0][0] - t) < mp.mpf(10) ** -45
    for part in (mp.mpf("0.25"), mp.mpf("0.5"), mp.mpf(1)):
        there = run(made["exp"], p, [part * c for c in v])[0]
        assert abs(distance(p, there) - part * t) < mp.mpf(10) ** -25
        assert abs(distance(there, q) - (1 - part) * t) < mp.mpf(10) ** -25


@cache
def derivation(name: str, n: int | None) -> _Derivation:
    return _Derivation(bundled_spec(name, **({"n": n} if n else {})))


@pytest.mark.parametrize(
    "case",
    [("so3", None), ("sphere", 2), ("sphere", 3), ("hyperbolic", 2), ("hyperbolic", 3), ("torus", 2), ("euclidean", 2)],
)
def test_the_staged_determinant_agrees_with_the_closed_form(case: tuple[str, int | None]) -> None:
    name, n = case
    letter = {"sphere": "S", "hyperbolic": "H", "torus": "T", "euclidean": "R"}.get(name)
    _, _, draw, distance, log_det = CLOSED[f"{letter}{n}" if letter else name]
    made = derivation(name, n)
    staged = staged_log_det(made.jacobian, made.operators)
    rng = random.Random(13)
    for _ in range(3):
        p, q = draw(rng), draw(rng)
        assert abs(run(staged, p, q)[0][0] - log_det(distance(p, q))) < mp.mpf(10) ** -40


# Gradients.


def walk(name: str, p: Point, u: Point, h: Any) -> Point:
    """A curve through p with velocity u, u as the manifold stores tangent vectors."""
    if name in ("euclidean", "torus"):
        return [a + h * b for a, b in zip(p, u, strict=True)]
    if name == "so3":
        w, x, y, z = p
        a, b, c = (h * k / 2 for k in u)
        return unit([
            w - a * x - b * y - c * z,
            x + w * a + y * c - z * b,
            y + w * b + z * a - x * c,
            z + w * c + x * b - y * a,
        ])  # fmt: skip
    moved = [a + h * b for a, b in zip(p, u, strict=True)]
    if name == "sphere":
        return unit(moved)
    return [mp.sqrt(1 + dot(moved[1:], moved[1:])), *moved[1:]]


def tangent(name: str, rng: random.Random, p: Point, dim: int) -> Point:
    x = gauss(rng, dim if name == "so3" else len(p))
    if name == "sphere":
        return [a - dot(p, x) * b for a, b in zip(x, p, strict=True)]
    if name == "hyperbolic":
        return [a + lorentz(p, x) * b for a, b in zip(x, p, strict=True)]
    return x


def metric(name: str, u: Point, v: Point) -> Any:
    return lorentz(u, v) if name == "hyperbolic" else dot(u, v)


@pytest.mark.parametrize("case", ["so3", "S2", "S3", "H2", "H3", "T2", "R4"])
def test_riemannian_gradients_are_directional_derivatives(case: str) -> None:
    name, parameters, draw, _, _ = CLOSED[case]
    made = geometry(name, **parameters)
    rng = random.Random(14)
    p = draw(rng)
    a, size = gauss(rng, len(p)), len(p)

    def f(x: Point) -> Any:
        return mp.sin(dot(a, x)) + x[0] * x[1] ** 2

    df = [mp.cos(dot(a, p)) * a[i] + (p[1] ** 2 if i == 0 else 2 * p[0] * p[1] if i == 1 else 0) for i in range(size)]
    grad = run(made["riemannian_gradient"], p, df)[0]
    h = mp.mpf(10) ** -15
    for _ in range(4):
        u = tangent(name, rng, p, made.spec.dim)
        slope = (f(walk(name, p, u, h)) - f(walk(name, p, u, -h))) / (2 * h)
        assert abs(metric(name, grad, u) - slope) < mp.mpf(10) ** -25
    if name in ("sphere", "hyperbolic"):
        assert abs(metric(name, grad, p)) < mp.mpf(10) ** -50
    length = run(made["gradient_norm"], p, df)[0][0]
    assert abs(length - mp.sqrt(metric(name, grad, grad))) < mp.mpf(10) ** -50


@pytest.mark.parametrize("case", ["so3", "S2", "S4", "H2", "H4"])
def test_tangent_parts_are_tangent_and_keep_what_is(case: str) -> None:
    name, parameters, draw, _, _ = CLOSED[case]
    made = geometry(name, **parameters)
    rng = random.Random(15)
    p = draw(rng)
    u = tangent(name, rng, p, made.spec.dim)
    h = mp.mpf(10) ** -20
    ambient = [(b - a) / (2 * h) for a, b in zip(walk(name, p, u, -h), walk(name, p, u, h), strict=True)]
    assert max(abs(a - b) for a, b in zip(run(made["to_tangent"], p, ambient)[0], u, strict=True)) < mp.mpf(10) ** -30
    if name == "so3":
        return
    part = run(made["to_tangent"], p, gauss(rng, len(p)))[0]
    assert abs(metric(name, part, p)) < mp.mpf(10) ** -50


# Where formulas are 0/0.


@pytest.mark.parametrize("case", ["so3", "S1", "S2", "S4", "H2", "H4", "T2", "R2"])
def test_everything_is_finite_where_points_coincide(case: str) -> None:
    name, parameters, draw, _, _ = CLOSED[case]
    made = program(name, **parameters)
    p = [mp.mpf(float(x)) for x in draw(random.Random(16))]  # a double: not exactly on the manifold
    zero = [0] * geometry(name, **parameters).spec.tangent_size
    assert [float(x) for x in interpret(made["exp"], p, zero)[0]] == [float(x) for x in p] or name == "hyperbolic"
    assert max(abs(x) for x in interpret(made["log"], p, p)[0]) < mp.mpf(10) ** -15
    assert abs(interpret(made["distance"], p, p)[0][0]) < mp.mpf(10) ** -15
    assert abs(interpret(made["log_abs_det"], p, p)[0][0]) < mp.mpf(10) ** -15
    dim = geometry(name, **parameters).spec.dim
    value, gradient = interpret(made["splat"], p, p, [1] * (dim * len(zero)), [mp.mpf(3)])
    assert abs(value[0] - 3) < mp.mpf(10) ** -14
    assert max(abs(x) for x in gradient) < mp.mpf(10) ** -14


@pytest.mark.parametrize("case", ["so3", "S2", "S4", "H2", "H4"])
def test_polynomials_near_0_over_0_are_exact_to_double_precision(case: str) -> None:
    name, parameters, draw, distance, log_det = CLOSED[case]
    made, low = geometry(name, **parameters), program(name, **parameters)
    rng = random.Random(17)
    p = draw(rng)
    u = tangent(name, rng, p, made.spec.dim)
    for r in ("1e-12", "1e-6", "1e-3", "0.03", "0.3", "0.9", "1.1"):
        q = walk(name, p, u, mp.mpf(r) / mp.sqrt(metric(name, u, u)))
        t = distance(p, q)
        found = interpret(low["log_abs_det"], p, q)[0][0]
        assert abs(found - log_det(t)) < mp.mpf(2) ** -53 * abs(log_det(t))
        plain = run(made["log"], p, q)[0]
        scale = max(abs(x) for x in plain)
        for ours, theirs in zip(interpret(low["log"], p, q)[0], plain, strict=True):
            assert abs(ours - theirs) < mp.mpf(2) ** -53 * scale


def text_of(name: str, old: str, new: str) -> str:
    text = (MANIFOLDS / f"{name}.yaml").read_text()
    assert old in text
    return text.replace(old, new, 1)


SINGULAR = {
    "one norm too many": "t * w / norm(w)^2",
    "a length in the wrong metric": "t * w / sqrt(w[0]^2 + 2 * w[1]^2 + 3 * w[2]^2)",
    "a pole": "w / norm(w)^3",
    "a kink": "sqrt(t) * w / norm(w)",
}


@pytest.mark.parametrize("value", SINGULAR.values(), ids=SINGULAR)
def test_a_singularity_that_is_none_is_refused_with_advice(value: str) -> None:
    text = text_of("sphere", "value: t * w / norm(w)", f"value: {value}")
    with pytest.raises(UserError) as error:
        derive(spec_of(text))
    assert "Log at coincident points is 0/0" in error.value.message
    assert "t * w / norm(w)" in str(error.value.hint)
    span = error.value.span
    assert span is not None
    assert span.source.line(span.line)[span.column - 1 :].startswith(value)


def test_a_singular_exp_is_refused_with_advice() -> None:
    text = text_of("sphere", "sinc(norm(v)) * v", "sin(norm(v)) / norm(v)^2 * v")
    with pytest.raises(UserError, match="Exp at the zero vector") as error:
        derive(spec_of(text))
    assert "sinc" in str(error.value.hint)


def test_quotients_may_be_written_in_other_ways() -> None:
    for value in ("t / norm(w) * w", "w * (t / norm(w))", "w / norm(w) * t", "w / sin(t) * t", "w / (norm(w) / t)"):
        made = derive(spec_of(text_of("sphere", "value: t * w / norm(w)", f"value: {value}")))
        assert made.log_det_origin == "closed form"
        rng = random.Random(18)
        p, q = on_sphere(rng, 2), on_sphere(rng, 2)
        t = angle(p, q)
        assert abs(run(made["log_abs_det"], p, q)[0][0] - mp.log(t / mp.sin(t))) < mp.mpf(10) ** -45


# Determinants that are no product of powers.

CUBIC = text_of("sphere", "value: t * w / norm(w)", "value: (t + t^3) * w / norm(w)")


def test_without_a_closed_form_the_determinant_is_staged_and_right_on_a_sphere() -> None:
    made = derive(spec_of(CUBIC))
    assert made.log_det_origin == "staged"
    rng = random.Random(19)
    for _ in range(3):
        p, q = on_sphere(rng, 2), on_sphere(rng, 2)
        t = angle(p, q)
        expected = mp.log((t + t**3) / mp.sin(t) * (1 + 3 * t**2))
        assert abs(run(made["log_abs_det"], p, q)[0][0] - expected) < mp.mpf(10) ** -40


def test_a_constant_factor_of_the_metric_leaves_the_determinant_alone() -> None:
    made = derive(spec_of(text_of("sphere", "metric: dot(u, v)", "metric: 9 * dot(u, v)").replace("distance: t\n", "")))
    rng = random.Random(21)
    p, q = on_sphere(rng, 2), on_sphere(rng, 2)
    t = angle(p, q)
    assert abs(run(made["log_abs_det"], p, q)[0][0] - mp.log(t / mp.sin(t))) < mp.mpf(10) ** -45
    assert abs(run(made["distance"], p, q)[0][0] - 3 * t) < mp.mpf(10) ** -45


def test_an_authors_closed_form_is_kept_and_said_to_be_theirs() -> None:
    made = derive(spec_of(text_of("sphere", "distance: t\n", "distance: t\nlog_det: (n - 1) * log(t / norm(w))\n")))
    assert made.log_det_origin == "author"
    assert interpret(lower(made)["log_abs_det"], [0, 0, 1], [0, 0, 1]) == [[0]]


# What no formula can mean.

LOG, EXP = "log: q - p\n", "exp: p + v\n"
MEANINGLESS = {
    "a division by zero": (LOG, LOG + "distance: norm(q - p) + 1/0\n"),
    "a vector over zero": (LOG, "log: (q - p) / 0\n"),
    "the logarithm of zero": (LOG, LOG + "distance: norm(q - p) + log(0)\n"),
    "the root of a negative number": (LOG, LOG + "distance: norm(q - p) + sqrt(-1)\n"),
    "the arc cosine of two": (LOG, LOG + "distance: norm(q - p) + acos(2)\n"),
    "a number beyond double precision": (LOG, LOG + "distance: norm(q - p) + 1e200 * 1e200\n"),
    "a degenerate metric": ("metric: dot(u, v)", "metric: u[0] * v[0]"),
    "a metric that is not bilinear": ("metric: dot(u, v)", "metric: dot(u, u) * dot(v, v)"),
    "a negative metric": ("metric: dot(u, v)", "metric: -dot(u, v)"),
    "a log that goes nowhere": (LOG, "log: p - p\n"),
    "a radius below zero": ("radius: infinity", "radius: -1"),
    "a period of zero": ("space: R^n", "space: R^n\n  period: 0"),
    "a period below zero": ("space: R^n", "space: R^n\n  period: -1"),
}


@pytest.mark.parametrize("edit", MEANINGLESS.values(), ids=MEANINGLESS)
def test_what_has_no_meaning_is_refused(edit: tuple[str, str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("RSRM_GEN_CACHE", str(tmp_path / "cache"))
    (tmp_path / "file.yaml").write_text(text_of("euclidean", *edit))
    with pytest.raises(UserError):
        compile_manifold(tmp_path / "file.yaml")


UNIT = "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]"
VOCABULARY = {
    "sinc of a vector": (EXP, "exp: p + v + 0 * sinc(v)\n"),
    "sinhc of a vector": (EXP, "exp: p + v + 0 * sinhc(v)\n"),
    "where of matrices": ("metric: dot(u, v)", f'metric: "where(p[0] < 0, {UNIT}, {UNIT})"'),
    "the inverse of a matrix": ("metric: dot(u, v)", 'metric: "inv([[1, 0, 0], [0, 1, 0], [0, 0, 1]])"'),
    "a negative matrix": ("metric: dot(u, v)", 'metric: "-[[-1, 0, 0], [0, -1, 0], [0, 0, -1]]"'),
    "a matrix times a vector": (EXP, 'exp: "p + [[1, 0, 0], [0, 1, 0], [0, 0, 1]] * v"\n'),
    "a row of a matrix": (EXP, 'exp: "p + [[1, 1, 1], [0, 1, 0]][0] * 0 + v"\n'),
    "transpose, outer, det": (EXP, "exp: p + v * det(transpose(outer(p, p))) ^ 0\n"),
    "wrap of a vector": (EXP, "exp: p + v + 0 * wrap(p, 3)\n"),
}


@pytest.mark.parametrize("edit", VOCABULARY.values(), ids=VOCABULARY)
def test_what_the_shape_rules_accept_is_derived(edit: tuple[str, str]) -> None:
    made = derive(spec_of(text_of("euclidean", *edit)))
    p, v = [mp.mpf("0.3"), mp.mpf("0.2"), mp.mpf("-0.7")], [mp.mpf("1.5"), mp.mpf("0.25"), mp.mpf("2")]
    assert max(abs(a - b - c) for a, b, c in zip(run(made["exp"], p, v)[0], p, v, strict=True)) < mp.mpf(10) ** -50
    assert abs(run(made["inner"], p, v, v)[0][0] - dot(v, v)) < mp.mpf(10) ** -50


def test_a_frame_of_one_vector_makes_a_circle() -> None:
    made = derive(
        spec_of("""\
manifold: circle
doc: The rotations of a plane.
embedded: {space: R^2, constraint: "dot(p, p) - 1", project: p / norm(p)}
frame: ["[-p[1], p[0]]"]
metric: dot(u, v)
exp: "[cos(v[0]) * p[0] - sin(v[0]) * p[1], sin(v[0]) * p[0] + cos(v[0]) * p[1]]"
log: "[atan2(p[0] * q[1] - p[1] * q[0], dot(p, q))]"
injectivity_radius: pi
diameter: pi
""")
    )
    p, q = ([mp.cos(mp.mpf(t)), mp.sin(mp.mpf(t))] for t in ("0.4", "1.5"))
    assert abs(run(made["log"], p, q)[0][0] - mp.mpf("1.1")) < mp.mpf(10) ** -50
    assert abs(run(made["log_abs_det"], p, q)[0][0]) < mp.mpf(10) ** -40
