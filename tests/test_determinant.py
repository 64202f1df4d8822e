"""log |det D Log|: closed forms that are found, determinants that are eliminated, and models of one space that agree."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from typing import Any

import mpmath as mp
import pytest
from compiled import MANIFOLDS, geometry, program, spec_of

from rsrm_gen.compiler.derive import Geometry, derive
from rsrm_gen.compiler.derive.closed_form import rational
from rsrm_gen.compiler.derive.numeric import run
from rsrm_gen.compiler.lower import interpret, lower
from rsrm_gen.errors import UserError

Point = list[Any]


@pytest.fixture(autouse=True)
def _sixty_digits() -> Iterator[None]:
    with mp.workdps(60):
        yield


def gauss(rng: random.Random, size: int) -> Point:
    return [mp.mpf(rng.gauss(0, 1)) for _ in range(size)]


def dot(x: Point, y: Point) -> Any:
    return mp.fsum(a * b for a, b in zip(x, y, strict=True))


def log_det(made: Geometry, p: Point, q: Point) -> Any:
    return run(made["log_abs_det"], p, q)[0][0]


CHART = """\
manifold: m
doc: A plane with a logarithm of its own.
parameters: {{n: {n}}}
chart: {{space: R^n}}
metric: "{metric}"
exp: p + v
log: "{log}"
injectivity_radius: infinity
"""


def chart(log: str, metric: str = "dot(u, v)", n: int = 2) -> Geometry:
    return derive(spec_of(CHART.format(log=log, metric=metric, n=n)))


# What is found.

FOUND: dict[str, tuple[str, str, Callable[[Any, Any, Point, Point], Any]]] = {
    "the derivative of asinh and the metric's volume": (
        "[asinh(q[0] - p[0]), q[1] - p[1] - asinh(q[0] - p[0])^3]",
        "exp(p[1]) * u[0] * v[0] + u[1] * v[1]",
        lambda x, y, p, q: -mp.log(1 + x**2) / 2 + (p[1] - q[1]) / 2,
    ),
    "the derivative of tanh": (
        "[tanh(q[0] - p[0]), q[1] - p[1]]",
        "dot(u, v)",
        lambda x, y, p, q: mp.log(1 - mp.tanh(x) ** 2),
    ),
    "the derivative of a square root": (
        "[sqrt(exp(q[0])) - sqrt(exp(p[0])), q[1] - p[1]]",
        "dot(u, v)",
        lambda x, y, p, q: q[0] / 2 - mp.log(2),
    ),
}


@pytest.mark.parametrize("case", FOUND.values(), ids=FOUND)
def test_closed_forms_are_found_among_what_derivatives_divide_by(case: tuple[str, str, Any]) -> None:
    log, metric, expected = case
    made = chart(log, metric)
    assert made.log_det_origin == "closed form"
    rng = random.Random(20)
    for _ in range(4):
        p, q = gauss(rng, 2), gauss(rng, 2)
        assert abs(log_det(made, p, q) - expected(q[0] - p[0], q[1] - p[1], p, q)) < mp.mpf(10) ** -40


@pytest.mark.parametrize("name", ["hyperbolic", "poincare", "half_space", "sphere", "so3"])
def test_space_forms_have_closed_determinants(name: str) -> None:
    for parameters in ({}, *([{"n": 3}, {"n": 5}] if name != "so3" else [])):
        assert geometry(name, **parameters).log_det_origin == "closed form"


def test_of_equal_closed_forms_the_accurate_one_is_taken() -> None:
    # sqrt(1 - (p . q)^2) is sin t, and loses its digits near 0 and pi; |q - p| |q + p| / 2 is too, and does not.
    text = (MANIFOLDS / "sphere.yaml").read_text()
    poor = derive(spec_of(text.replace("t * w / norm(w)", "t / sqrt(1 - dot(p, q)^2) * w")))
    assert poor.log_det_origin == "closed form"
    assert poor["log_abs_det"].formula == "log(2*t/(norm_d*norm_q_plus_p))"
    assert geometry("sphere")["log_abs_det"].formula == "log(t_over_norm_w)"  # as accurate, and shorter


def test_exponents_are_simple_fractions_or_none() -> None:
    assert str(rational(mp.mpf(3) / 2)) == "3/2"
    assert rational(mp.sqrt(2)) is None
    assert rational(mp.mpf(1) / 7) is None


# What is eliminated.


def rows(n: int) -> list[str]:
    """Log with a dense Jacobian I + A(q - p), in no product form."""
    terms = [
        [f"{(3 * i + 5 * j) % 7 + 1} / 40 * sin({j + 1} / {n} * (q[{j}] - p[{j}]))" for j in range(n)] for i in range(n)
    ]
    return [f"q[{i}] - p[{i}] + " + " + ".join(row) for i, row in enumerate(terms)]


@pytest.mark.parametrize("n", [2, 3, 4, 5, 7, 8])
def test_dense_determinants_are_eliminated_exactly(n: int) -> None:
    made = chart("[" + ", ".join(rows(n)) + "]", n=n)
    assert made.log_det_origin == "staged"
    rng = random.Random(21)
    for _ in range(3):
        p, q = gauss(rng, n), gauss(rng, n)
        jacobian = mp.matrix(n, n)
        for i in range(n):
            for j in range(n):
                k = mp.mpf(j + 1) / n
                jacobian[i, j] = int(i == j) + mp.mpf((3 * i + 5 * j) % 7 + 1) / 40 * k * mp.cos(k * (q[j] - p[j]))
        assert abs(log_det(made, p, q) - mp.log(abs(mp.det(jacobian)))) < mp.mpf(10) ** -50


def test_elimination_grows_like_the_cube_of_the_dimension() -> None:
    counts = {n: lower(chart("[" + ", ".join(rows(n)) + "]", n=n))["log_abs_det"].operations for n in (4, 8)}
    assert counts[8] < 9 * counts[4]


def test_triangular_patterns_need_no_elimination() -> None:
    n = 12  # beyond what is eliminated at once
    entries = [
        f"q[{i}] - p[{i}] + sin(q[{i}] - p[{i}]) / 2" + (f" + q[{i - 1}]^2 - p[{i - 1}]^2" if i else "")
        for i in range(n)
    ]
    made = chart("[" + ", ".join(entries) + "]", n=n)
    p, q = gauss(random.Random(22), n), gauss(random.Random(23), n)
    expected = mp.fsum(mp.log(1 + mp.cos(b - a) / 2) for a, b in zip(p, q, strict=True))
    assert abs(log_det(made, p, q) - expected) < mp.mpf(10) ** -50
    assert lower(made)["log_abs_det"].operations < 12 * n


def test_a_permuted_pattern_is_matched() -> None:
    made = chart("[q[1] - p[1] + sin(q[1] - p[1]) / 2, q[2] - p[2], q[0] - p[0]]", n=3)
    p, q = gauss(random.Random(24), 3), gauss(random.Random(25), 3)
    assert abs(log_det(made, p, q) - mp.log(1 + mp.cos(q[1] - p[1]) / 2)) < mp.mpf(10) ** -50


CUBIC = (MANIFOLDS / "sphere.yaml").read_text().replace("value: t * w / norm(w)", "value: (t + t^3) * w / norm(w)")


@pytest.mark.parametrize("n", [1, 2, 3, 6])
def test_with_ambient_tangents_the_matrix_is_bordered_by_the_normals(n: int) -> None:
    made = derive(spec_of(CUBIC, n=n))
    rng = random.Random(26)
    for _ in range(3):
        p, q = ([c / mp.sqrt(dot(x, x)) for c in x] for x in (gauss(rng, n + 1), gauss(rng, n + 1)))
        t = mp.acos(dot(p, q))
        expected = (n - 1) * mp.log((t + t**3) / mp.sin(t)) + mp.log(1 + 3 * t**2)
        assert abs(log_det(made, p, q) - expected) < mp.mpf(10) ** -40


def test_determinants_and_their_derivatives_are_finite_where_points_coincide() -> None:
    low = lower(derive(spec_of(CUBIC, n=4)))
    p = [mp.mpf(c) for c in (0.5, 0.5, 0.5, 0.5, 0)]
    assert abs(interpret(low["log_abs_det"], p, p)[0][0]) < mp.mpf(10) ** -15
    zero, one = [0] * 5, [mp.mpf(1)]
    value, gradient = interpret(low["splat"], p, p, [1] * 20, one)
    assert abs(value[0] - 1) < mp.mpf(10) ** -14
    assert max(map(abs, gradient)) < mp.mpf(10) ** -14
    adjoints = interpret(low["splat_vjp"], p, p, [1] * 20, one, one, zero)
    assert all(mp.isfinite(x) for entries in adjoints for x in entries)


def test_a_determinant_too_large_to_eliminate_asks_for_a_closed_form() -> None:
    with pytest.raises(UserError) as error:
        derive(spec_of(CUBIC, n=8))
    assert "log_det:" in str(error.value.hint)


def test_a_logarithm_that_forgets_a_coordinate_is_refused() -> None:
    with pytest.raises(UserError, match="does not tell points apart"):
        chart("[q[0] - p[0], sin(q[0] - p[0])]")


# Three models of one space.


def to_ball(x: Point) -> Point:
    """From the hyperboloid: project from (-1, 0, ..., 0)."""
    return [c / (1 + x[0]) for c in x[1:]]


def to_half_space(y: Point) -> Point:
    """From the ball: invert in the sphere of radius sqrt 2 around -e_n, and turn the result over."""
    shifted = [*y[:-1], y[-1] + 1]
    square = dot(shifted, shifted)
    inverted = [2 * c / square for c in shifted]
    return [*inverted[:-1], inverted[-1] - 1]


MODELS: dict[str, Callable[[Point], Point]] = {"poincare": to_ball, "half_space": lambda x: to_half_space(to_ball(x))}


@pytest.mark.parametrize("n", [2, 3, 5])
@pytest.mark.parametrize("name", MODELS)
def test_models_of_hyperbolic_space_agree_under_their_isometry(name: str, n: int) -> None:
    ours, plain, move = program(name, n=n), program("hyperbolic", n=n), MODELS[name]
    rng = random.Random(27)
    for _ in range(3):
        p, q = ([mp.sqrt(1 + dot(s, s)), *s] for s in (gauss(rng, n), gauss(rng, n)))
        for routine in ("distance", "log_abs_det"):
            there, here = interpret(plain[routine], p, q)[0][0], interpret(ours[routine], move(p), move(q))[0][0]
            assert abs(there - here) < mp.mpf(10) ** -16 * abs(there)
        v = interpret(plain["log"], p, q)[0]
        for part in (mp.mpf("0.3"), mp.mpf(1), mp.mpf(2)):
            w = interpret(ours["log"], move(p), move(q))[0]
            expected = move(interpret(plain["exp"], p, [part * c for c in v])[0])
            found = interpret(ours["exp"], move(p), [part * c for c in w])[0]
            assert max(abs(a - b) for a, b in zip(found, expected, strict=True)) < mp.mpf(10) ** -15 * max(
                map(abs, expected)
            )


def test_small_circles_are_one() -> None:
    """The circle in the plane, SO(2), the torus T^1 and the sphere S^1 have one distance."""
    rng = random.Random(28)
    for _ in range(4):
        a, b = (mp.mpf(rng.uniform(-3, 3)) for _ in range(2))
        p, q = ([mp.cos(x), mp.sin(x)] for x in (a, b))
        angle = interpret(program("so2")["log"], [a], [b])[0][0]
        assert abs(interpret(program("circle")["log"], p, q)[0][0] - angle) < mp.mpf(10) ** -50
        assert abs(interpret(program("torus", n=1)["log"], [a], [b])[0][0] - angle) < mp.mpf(10) ** -50
        assert abs(interpret(program("sphere", n=1)["distance"], p, q)[0][0] - abs(angle)) < mp.mpf(10) ** -50
