"""Values and derivatives of the generated code against closed forms and differences in 60 digits, on every kind of place.

The unit of an error is what rounding the inputs and the output costs (`sens` + eps |value|); 64 of them pass.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from typing import Any

import mpmath as mp
import numpy as np
import pytest
import sympy as sp
import torch
from closed_forms import CASES, ClosedForm, Point, plus, times
from compiled import call_batch, files, geometry, needs_compiler, program, shared_library, spec_of, torch_module

from rsrm_gen.compiler.derive import derive
from rsrm_gen.compiler.emit import emit
from rsrm_gen.compiler.emit.series import in_double, in_single, tables
from rsrm_gen.compiler.lower import interpret, lower

DIGITS = 60
DERIVATIVE_DIGITS = 110
EPS = {"float64": 2.0**-53, "float32": 2.0**-24}
DTYPES = {"float64": torch.float64, "float32": torch.float32}


@pytest.fixture(autouse=True)
def _sixty_digits() -> Iterator[None]:
    with mp.workdps(DIGITS):
        yield


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Any:
    return tmp_path_factory.mktemp("numerics")


@dataclass(frozen=True)
class Rows:
    """Places as doubles that are numbers of the precision: p, q, and v from the one to the other."""

    p: np.ndarray
    q: np.ndarray
    v: np.ndarray
    kind: list[str]


@cache
def rows(case: str, precision: str) -> Rows:
    """Coincident, near, in the middle, and near the cut locus or far away."""
    with mp.workdps(DIGITS):
        form, rng = CASES[case], random.Random(31)
        whole = mp.mpf(form.cut or 2)
        lengths = [("near", mp.mpf(10) ** -k) for k in range(2, 13)] + [("middle", whole * k / 9) for k in range(1, 9)]
        if form.cut:
            lengths += [("cut", whole * (1 - mp.mpf(10) ** -k)) for k in range(1, 10 if precision == "float64" else 5)]
        else:
            lengths += [("far", mp.mpf(r)) for r in ((4, 8, 16, 30) if precision == "float64" else (4, 8))]
        kind, found = [], []
        for name, r in lengths:
            p = rounded(form.point(rng), precision)
            u = form.unit(rng, form.project(p))
            q = rounded(form.exp(form.project(p), times(r, u)), precision)
            kind.append(name)
            found.append((p, q, rounded(times(r, u), precision)))
            if name == "middle":
                kind.append("coincident")
                found.append((p, p, times(mp.mpf(0), u)))
        columns = (np.array([[float(c) for c in x] for x in column]) for column in zip(*found, strict=True))
        return Rows(*columns, kind)


def rounded(x: Point, precision: str) -> Point:
    return [mp.mpf(float(np.float32(float(c)) if precision == "float32" else float(c))) for c in x]


def torch_manifold(case: str, folder: Any) -> Any:
    form = CASES[case]
    identifier = geometry(form.name, **form.parameters).spec.identifier
    return torch_module(files(form.name, **form.parameters), identifier, folder).manifold


TRUTH: dict[str, Callable[[ClosedForm, Point, Point], Point]] = {
    "log": lambda form, p, q: form.log(form.project(p), form.project(q)),
    "distance": lambda form, p, q: [form.distance(form.project(p), form.project(q))],
    "log_abs_det": lambda form, p, q: [form.log_det(form.distance(form.project(p), form.project(q)))],
    "exp": lambda form, p, v: form.exp(form.project(p), v),
}


def largest(x: Any) -> float:
    return float(max((abs(c) for c in x), default=mp.mpf(0)))


def unit_and_truth(case: str, function: str, precision: str) -> tuple[np.ndarray, list[Point]]:
    form, at, rng = CASES[case], rows(case, precision), random.Random(32)
    units, truths = [], []
    for p, second in zip(at.p, at.v if function == "exp" else at.q, strict=True):
        given = [[mp.mpf(c) for c in x] for x in (p, second)]
        exact = TRUTH[function](form, *given)
        moved = 0.0
        for _ in range(4):
            shaken = [[c * (1 + EPS[precision] * rng.choice((-1, 1))) for c in x] for x in given]
            moved = max(moved, largest(a - b for a, b in zip(TRUTH[function](form, *shaken), exact, strict=True)))
        units.append(moved + 2 * EPS[precision] * largest(exact) + 1e-300)
        truths.append(exact)
    return np.array(units), truths


def check(found: np.ndarray, truths: list[Point], units: np.ndarray, kinds: list[str]) -> None:
    found = found.reshape(len(truths), -1)
    assert np.isfinite(found).all(), [kinds[i] for i in np.flatnonzero(~np.isfinite(found).all(axis=1))]
    errors = [
        largest(mp.mpf(float(a)) - b for a, b in zip(row, exact, strict=True))
        for row, exact in zip(found, truths, strict=True)
    ]
    ratio = np.array(errors) / units
    worst = int(np.argmax(ratio))
    assert ratio[worst] <= 64, f"row {worst} ({kinds[worst]}): {ratio[worst]:.3g} units"


@pytest.mark.parametrize("precision", EPS)
@pytest.mark.parametrize("function", TRUTH)
@pytest.mark.parametrize("case", CASES)
def test_torch_is_as_exact_as_its_inputs_allow(case: str, function: str, precision: str, folder: Any) -> None:
    at = rows(case, precision)
    second = at.v if function == "exp" else at.q
    arguments = (torch.from_numpy(x).to(DTYPES[precision]) for x in (at.p, second))
    units, truths = unit_and_truth(case, function, precision)
    check(getattr(torch_manifold(case, folder), function)(*arguments).double().numpy(), truths, units, at.kind)


@needs_compiler
@pytest.mark.parametrize("precision", EPS)
@pytest.mark.parametrize("case", CASES)
def test_c_is_as_exact_as_its_inputs_allow(case: str, precision: str, folder: Any) -> None:
    form, at = CASES[case], rows(case, precision)
    identifier = geometry(form.name, **form.parameters).spec.identifier
    library = shared_library(files(form.name, **form.parameters), identifier, folder)
    dtype = np.float32 if precision == "float32" else np.float64
    for function in TRUTH:
        second = at.v if function == "exp" else at.q
        routine = program(form.name, **form.parameters)[function]
        (found,) = call_batch(library, identifier, routine, at.p, second, dtype=dtype)
        units, truths = unit_and_truth(case, function, precision)
        check(found.astype(np.float64), truths, units, at.kind)


# Derivatives.

SCALARS: dict[str, Callable[[Any, torch.Tensor, torch.Tensor], torch.Tensor]] = {
    "log": lambda m, p, q: m.log(p, q),
    "exp": lambda m, p, v: m.exp(p, v),
    "squared distance": lambda m, p, q: m.distance(p, q)[..., None] ** 2,
    "log_abs_det": lambda m, p, q: m.log_abs_det(p, q)[..., None],
    "splat": lambda m, p, q: m.splat(q, p, *splat_parameters(m, p))[0][..., None],
}


def splat_parameters(m: Any, p: torch.Tensor) -> tuple[torch.Tensor, torch.Tensor]:
    W = torch.from_numpy(splat_matrix(m.dim, m.tangent_size)).to(p)
    return W.expand(*p.shape[:-1], m.dim, m.tangent_size), torch.ones(p.shape[:-1], dtype=p.dtype)


def splat_matrix(dim: int, tangent_size: int) -> np.ndarray:
    return np.round(np.random.default_rng(33).normal(size=(dim, tangent_size)) * 8) / 16


def interpreted(case: str, function: str, p: Point, second: Point) -> Point:
    form = CASES[case]
    made = program(form.name, **form.parameters)
    if function == "splat":
        spec = geometry(form.name, **form.parameters).spec
        W = splat_matrix(spec.dim, spec.tangent_size).ravel()
        return interpret(made["splat"], second, p, W.tolist(), [1], digits=DERIVATIVE_DIGITS)[0]
    if function == "squared distance":
        return [interpret(made["distance"], p, second, digits=DERIVATIVE_DIGITS)[0][0] ** 2]
    return interpret(made[function], p, second, digits=DERIVATIVE_DIGITS)[0]


def directions(size: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Two directions in which inputs move, and the weights of the results: numbers of few digits."""
    rng = np.random.default_rng(34)
    return tuple(np.round(rng.normal(size=size) * 8) / 8 for _ in range(3))  # type: ignore[return-value]


def differences(case: str, function: str, p: Point, second: Point) -> tuple[Any, Any]:
    """The first derivative along one direction and the second along two, of the weighted sum of the results."""
    h, size = mp.mpf(10) ** -30, len(p)
    d, e, _ = directions(len(p) + len(second))

    def at(s: int, t: int) -> Any:
        moved = plus([*p, *second], plus(times(s * h, [mp.mpf(x) for x in d]), times(t * h, [mp.mpf(x) for x in e])))
        result = interpreted(case, function, moved[:size], moved[size:])
        weights = directions(len(result))[2]
        return mp.fsum(w * r for w, r in zip(weights, result, strict=True))

    first = (at(1, 0) - at(-1, 0)) / (2 * h)
    return first, (at(1, 1) - at(1, -1) - at(-1, 1) + at(-1, -1)) / (4 * h * h)


def by_autograd(manifold: Any, function: str, p: np.ndarray, second: np.ndarray, dtype: torch.dtype) -> np.ndarray:
    """The same two numbers for every row, and the largest terms of the value and of each: (rows, 5)."""
    size = p.shape[1]
    z = torch.from_numpy(np.concatenate([p, second], 1)).to(dtype).requires_grad_()
    d, e, _ = (torch.from_numpy(x).to(dtype) for x in directions(z.shape[1]))
    result = SCALARS[function](manifold, z[:, :size], z[:, size:])
    weights = torch.from_numpy(directions(result.shape[1])[2]).to(dtype)
    slope = bend = torch.zeros_like(z)
    if result.requires_grad:
        (slope,) = torch.autograd.grad((result * weights).sum(), z, create_graph=True)
    if slope.requires_grad:
        (bend,) = torch.autograd.grad((slope * d).sum(), z)
    terms = [(slope * d).detach().double(), (bend * e).double()]
    largest_terms = [t.abs().amax(-1) for t in (result.detach().double(), *terms)]
    return torch.stack([*(t.sum(-1) for t in terms), *largest_terms], 1).numpy()


@pytest.mark.parametrize("precision", EPS)
@pytest.mark.parametrize("function", SCALARS)
@pytest.mark.parametrize("case", ["S2", "T7", "H2", "ball3", "half2", "SO3", "circle", "cylinder"])
def test_first_and_second_derivatives_are_as_exact_as_their_inputs_allow(
    case: str, function: str, precision: str, folder: Any
) -> None:
    at, eps = rows(case, precision), EPS[precision]
    second = at.v if function == "exp" else at.q
    found = by_autograd(torch_manifold(case, folder), function, at.p, second, DTYPES[precision])
    assert np.isfinite(found).all()
    chosen = [i for i, kind in enumerate(at.kind) if i % 3 == 0 or kind != "middle"]
    rng = random.Random(35)
    with mp.workdps(DERIVATIVE_DIGITS):
        for i in chosen:
            place = [[mp.mpf(c) for c in x] for x in (at.p[i], second[i])]
            exact = differences(case, function, *place)
            shaken = [[[c * (1 + eps * rng.choice((-1, 1))) for c in x] for x in place] for _ in range(4)]
            moved = [differences(case, function, *x) for x in shaken]
            # Where points coincide the distance has a kink, and no code that sees it alone knows its square's second derivative.
            orders = (0,) if function == "squared distance" and (at.p[i] == second[i]).all() else (0, 1)
            for k in orders:
                sens = max(abs(m[k] - exact[k]) for m in moved)
                unit = sens + 2 * eps * max(abs(exact[k]), *found[i, 2 : 4 + k]) + mp.mpf(10) ** -40
                assert abs(found[i, k] - exact[k]) <= (64, 256)[k] * unit, (
                    at.kind[i],
                    k + 1,
                    float(abs(found[i, k] - exact[k]) / unit),
                )


@pytest.mark.parametrize("case", CASES)
def test_derivatives_are_finite_on_every_manifold(case: str, folder: Any) -> None:
    manifold = torch_manifold(case, folder)
    for precision, dtype in DTYPES.items():
        at = rows(case, precision)
        for function in SCALARS:
            second = at.v if function == "exp" else at.q
            assert np.isfinite(by_autograd(manifold, function, at.p, second, dtype)).all(), (function, precision)


# Rows that are hostile, or on a boundary, do no harm to others.


def hostile(p: np.ndarray, q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """NaN, infinity, zero, huge, opposite and coincident rows."""
    bad = np.repeat(p[:1], 8, axis=0)
    other = np.stack([
        np.full_like(q[0], np.nan), np.full_like(q[0], np.inf), np.zeros_like(q[0]), np.full_like(q[0], 1e200),
        -q[0], q[1], q[0] * np.nan, -np.full_like(q[0], np.inf),
    ])  # fmt: skip
    bad[6] = np.inf
    return bad, other


@pytest.mark.parametrize("case", CASES)
def test_no_row_of_torch_feels_another(case: str, folder: Any) -> None:
    manifold, at = torch_manifold(case, folder), rows(case, "float64")
    for function in SCALARS:
        second = at.v if function == "exp" else at.q
        bad = hostile(at.p, second)
        among = [np.concatenate([b, x, b]) for b, x in zip(bad, (at.p, second), strict=True)]
        alone = by_autograd(manifold, function, at.p, second, torch.float64)
        found = by_autograd(manifold, function, among[0], among[1], torch.float64)[8:-8]
        # Vectorised and scalar code may differ in the last bits.
        scale = np.abs(alone).max(axis=1, keepdims=True) + 1e-30
        assert (np.abs(found - alone) <= 1e-11 * scale).all(), function


@needs_compiler
@pytest.mark.parametrize("case", CASES)
def test_no_row_of_c_feels_another(case: str, folder: Any) -> None:
    form, at = CASES[case], rows(case, "float64")
    identifier = geometry(form.name, **form.parameters).spec.identifier
    library = shared_library(files(form.name, **form.parameters), identifier, folder)
    for function in TRUTH:
        second = at.v if function == "exp" else at.q
        among = [np.concatenate([b, x, b]) for b, x in zip(hostile(at.p, second), (at.p, second), strict=True)]
        routine = program(form.name, **form.parameters)[function]
        (alone,) = call_batch(library, identifier, routine, at.p, second)
        (found,) = call_batch(library, identifier, routine, *among)
        assert (found[8:-8] == alone).all(), function


# What a branch that is not taken computes.

STEEP = """\
manifold: steep
doc: A line whose formulas overflow in the branch that is not taken.
chart: {{space: R^1}}
metric: dot(u, v)
exp: p + v
log: q - p
distance:
  let: {{w: 'exp(-q[0]^2)'}}
  value: 'norm(q - p) * where(q[0] < 5, {large}, 1)'
injectivity_radius: infinity
"""


@pytest.mark.parametrize(
    "large", ["exp(q[0]^2)", "cosh(9 * q[0])", "sinh(q[0]^3)", "acos(q[0])", "acosh(q[0])", "1 / w"]
)
def test_what_is_not_taken_does_not_poison_derivatives(large: str, folder: Any) -> None:
    made = derive(spec_of(STEEP.format(large=large)))
    texts = emit(made, lower(made))
    manifold = torch_module(texts, "steep", folder).manifold
    p, q = torch.zeros(1, 1, dtype=torch.float64), torch.tensor([[900.0]], dtype=torch.float64, requires_grad=True)
    distance = manifold.distance(p, q)
    (slope,) = torch.autograd.grad(distance.sum(), q)
    assert float(distance.detach()) == 900
    assert float(slope) == 1


ANGLE = """\
manifold: angle
doc: A plane whose formulas take the angle of a vector that vanishes in the branch that is not taken.
chart: {space: R^2}
metric: dot(u, v)
exp: p + v
log:
  let: {a: "atan2(q[0], q[1])"}
  value: "(q - p) * where(dot(q, q) < 1e-4, 1, cos(a)^2 + sin(a)^2)"
injectivity_radius: infinity
"""


def test_an_angle_that_is_not_taken_does_not_poison_the_gradient_of_a_splat(folder: Any) -> None:
    made = derive(spec_of(ANGLE))
    manifold = torch_module(emit(made, lower(made)), "angle", folder).manifold
    x, mu, one = torch.zeros(1, 2), torch.ones(1, 2), torch.ones(1)
    value, gradient = manifold.splats(x, mu, torch.eye(2)[None], one)
    torch.testing.assert_close(gradient, value[:, None] * (mu - x))


# Polynomials for single precision.


@pytest.mark.parametrize("name", ["sphere", "hyperbolic", "so3", "poincare"])
def test_single_precision_has_fewer_coefficients_and_they_suffice(name: str) -> None:
    for coefficients in tables(program(name)):
        single, double = in_single(coefficients), in_double(coefficients)
        assert single.degree < len(double) - 1
        assert single.error <= 2.0**-27
        for k in range(201):
            u = mp.mpf(k) / 200
            exact = mp.polyval([mp.mpf(c) for c in double[::-1]], u)
            approximate = mp.polyval([mp.mpf(c) for c in single.coefficients[::-1]], u)
            assert abs(approximate / exact - 1) <= mp.mpf(single.error) * (1 + mp.mpf(10) ** -6)


def test_a_polynomial_that_vanishes_keeps_its_degree() -> None:
    coefficients = tuple(sp.Rational(c) for c in ("-1/2", "1", "1/1000000000", "1/1000000000000"))
    assert in_single(coefficients).degree == 3
