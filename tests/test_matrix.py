"""Points that are matrices, and functions of symmetric matrices: values and derivatives wherever eigenvalues meet.

The truth is mpmath's expm, logm, sqrtm and differences of them in 80 digits, and closed forms of the manifolds.
"""

from __future__ import annotations

import math
import tempfile
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import mpmath as mp
import numpy as np
import pytest
import torch
from compiled import call_batch, files, needs_compiler, program, shared_library, spec_of, torch_module

from rsrm_gen.compiler.audit.laws import Laws
from rsrm_gen.compiler.audit.numbers import matrices
from rsrm_gen.compiler.derive import derive
from rsrm_gen.compiler.derive.matrix_numeric import FUNCTIONS, derivative, places
from rsrm_gen.compiler.emit import emit
from rsrm_gen.compiler.lower import interpret, lower
from rsrm_gen.compiler.spec import read_spec
from rsrm_gen.errors import UserError

NAMES = tuple(FUNCTIONS)
SIZES = (2, 3, 4)
GAPS = (0.0, 1e-12, 1e-9, 1e-6, 1e-3)
EPS = {torch.float64: 2.0**-52, torch.float32: 2.0**-23}


def rng(seed: int) -> np.random.Generator:
    return np.random.default_rng(seed)


def matrix_of(n: int, kind: str, seed: int = 0) -> np.ndarray:
    """A symmetric positive definite matrix: with random, equal, or nearly equal eigenvalues."""
    random = rng(seed + n)
    basis = np.linalg.qr(random.normal(size=(n, n)))[0]
    values = np.sort(random.uniform(0.2, 3.0, n))
    if kind == "unit":
        return np.eye(n)
    if kind.startswith("gap "):
        values[1] = values[0] + float(kind[4:])
    matrix = basis @ np.diag(values) @ basis.T
    return (matrix + matrix.T) / 2


KINDS = ("random", "unit", *(f"gap {gap:g}" for gap in GAPS))


def packed(matrix: Any, n: int) -> tuple[Any, ...]:
    return tuple(mp.mpf(matrix[i, j]) for i, j in places(n))


def direction(n: int, seed: int) -> np.ndarray:
    e = rng(100 + seed).normal(size=(n, n))
    return e + e.T


def exact(name: str, a: Any) -> Any:
    """f(A) by mpmath's own functions; log(sinh(B) B^-1), B = A^(1/2), by its power series in A where A is small."""
    if name == "exp":
        return mp.expm(a)
    if name == "log":
        return mp.logm(a)
    if name == "sqrt":
        return mp.sqrtm(a)
    if name == "invsqrt":
        return mp.inverse(mp.sqrtm(a))
    terms, term = mp.eye(a.rows), mp.eye(a.rows)
    for k in range(1, 80):
        term = term * a / ((2 * k) * (2 * k + 1))
        terms = terms + term
    return mp.logm(terms)


def differences(name: str, a: Any, directions: list[Any]) -> Any:
    """Derivatives of mpmath's function by central differences."""
    if not directions:
        return exact(name, a)
    *rest, e = directions
    h = mp.mpf(10) ** (-14 if len(directions) == 2 else -25)
    ahead, behind = (differences(name, a + sign * h * e, rest) for sign in (1, -1))
    return (ahead - behind) / (2 * h)


@cache
def truth(name: str, n: int, kind: str, order: int) -> Any:
    with mp.workdps(100):
        directions = [mp.matrix(direction(n, k).tolist()) for k in range(order)]
        return differences(name, mp.matrix(matrix_of(n, kind).tolist()), directions)


def error(found: Any, expected: Any, n: int) -> float:
    """The largest error of packed entries beside the largest entry."""
    wanted = [mp.re(expected[i, j]) for i, j in places(n)]
    return float(max(abs(mp.mpf(x) - y) for x, y in zip(found, wanted, strict=True)) / (max(map(abs, wanted)) or 1))


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("kind", KINDS)
def test_sixty_digits_are_right_wherever_eigenvalues_meet(name: str, kind: str) -> None:
    for n in (2, 3):
        with mp.workdps(60):
            a = packed(matrix_of(n, kind), n)
            directions = tuple(packed(direction(n, k), n) for k in range(2))
            for order, bound in ((0, 1e-55), (1, 1e-40), (2, 1e-20)):  # the last two are what the differences are worth
                found = derivative(name, a, directions[:order])
                assert error(found, truth(name, n, kind, order), n) < bound, (n, order)


# A manifold that uses all functions, so that its torch module has the code of all of them.
ALL = """
manifold: all_functions
doc: Symmetric 2 x 2 matrices, with every function of a symmetric matrix in its projection.
embedded:
  space: R^(2 x 2)
  constraint: above(p - transpose(p))
  project:
    let: {S: (p + transpose(p)) / 2, E: expm(S)}
    value: logm(E) + 1e-30 * (sqrtm(E) + invsqrtm(E) + log_sinhc_sqrtm(E))
frame: smat(v)
metric: dot(u, v)
exp: p + smat(v)
log: svec(q - p)
injectivity_radius: infinity
"""


@pytest.fixture(scope="module")
def helpers(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """The generated helpers for all functions."""
    geometry = derive(spec_of(ALL))
    code = emit(geometry, lower(geometry))
    return torch_module(code, "all_functions", tmp_path_factory.mktemp("all"))


def entries(matrix: torch.Tensor) -> list[torch.Tensor]:
    n = matrix.shape[-1]
    return [matrix[..., i, j] for i, j in places(n)]


def applied(helpers: Any, name: str, a: torch.Tensor, *directions: torch.Tensor) -> torch.Tensor:
    """The generated D^m f(A)[E1, ..., Em], packed."""
    result: torch.Tensor = helpers._spectral(name, helpers._eigh(*entries(a)), *map(entries, directions))
    return result


@pytest.mark.parametrize("dtype", EPS, ids=str)
@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("n", SIZES)
def test_torch_values_and_derivatives_are_exact(helpers: Any, name: str, n: int, dtype: torch.dtype) -> None:
    for kind in KINDS:
        rounded = torch.tensor(matrix_of(n, kind), dtype=dtype)
        if not torch.equal(rounded.double(), torch.tensor(matrix_of(n, kind))):  # the truth of what float32 holds
            continue
        for order, units in ((0, 30), (1, 60), (2, 400)):
            directions = [torch.tensor(direction(n, k), dtype=dtype) for k in range(order)]
            found = applied(helpers, name, rounded, *directions)
            bound = units * 2.0**-52 if dtype == torch.float64 else units * 2.0**-23
            assert error(found.tolist(), truth(name, n, kind, order), n) < bound, (kind, order)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("n", SIZES)
def test_float32_is_as_exact_as_float64_says(helpers: Any, name: str, n: int) -> None:
    for kind in KINDS:
        a = torch.tensor(matrix_of(n, kind), dtype=torch.float32)
        directions = [torch.tensor(direction(n, k), dtype=torch.float32) for k in range(2)]
        for order, units in ((0, 30), (1, 60), (2, 400)):
            found = applied(helpers, name, a, *directions[:order]).double()
            wanted = applied(helpers, name, a.double(), *(e.double() for e in directions[:order]))
            assert float((found - wanted).abs().max()) < float(wanted.abs().max() or 1) * units * 2.0**-23, (
                kind,
                order,
            )


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("kind", ["random", "unit", "gap 0", "gap 1e-06"])
def test_autograd_agrees_with_differences(helpers: Any, name: str, kind: str) -> None:
    n = 3
    batch = np.stack([matrix_of(n, kind, seed) for seed in (0, 5)])
    a, one = torch.tensor(batch, requires_grad=True), torch.tensor(batch[0], requires_grad=True)

    def function(x: torch.Tensor) -> torch.Tensor:
        return applied(helpers, name, (x + x.mT) / 2)

    assert torch.autograd.gradcheck(function, (a,), atol=1e-6, rtol=1e-5)
    assert torch.autograd.gradgradcheck(function, (one,), atol=1e-4, rtol=1e-4)


def test_wide_eigenvalues_are_as_exact_as_close_ones(helpers: Any) -> None:
    """Divided differences by recursion, far from any series."""
    n = 3
    a = np.diag([1e-6, 1.0, 1e6])
    with mp.workdps(80):
        for name in ("log", "sqrt", "invsqrt"):
            for order in (0, 1, 2):
                directions = [direction(n, k) for k in range(order)]
                wanted = derivative(name, packed(a, n), tuple(packed(e, n) for e in directions))
                found = applied(helpers, name, torch.tensor(a), *map(torch.tensor, directions)).tolist()
                worst = max(abs(mp.mpf(x) - y) for x, y in zip(found, wanted, strict=True))
                assert worst < 1e-13 * max(map(abs, wanted)), (name, order)


def test_log_sinhc_sqrt_is_exact_from_the_smallest_to_the_largest(helpers: Any) -> None:
    with mp.workdps(80):
        for size in (1e-24, 1e-8, 1.0, 3.99, 4.01, 30.0, 399.0, 401.0, 1e4):
            a = np.diag([size, 1.1 * size, 2 * size])
            e = direction(3, 1)
            for order in (0, 1, 2):
                wanted = derivative("log_sinhc_sqrt", packed(a, 3), (packed(e, 3),) * order)
                found = applied(helpers, "log_sinhc_sqrt", torch.tensor(a), *[torch.tensor(e)] * order).tolist()
                worst = max(abs(mp.mpf(x) - y) for x, y in zip(found, wanted, strict=True))
                assert worst < 1e-13 * max(map(abs, wanted)), (size, order)


def test_a_row_that_is_not_finite_changes_no_other(helpers: Any) -> None:
    good = torch.tensor(np.stack([matrix_of(3, "random", k) for k in range(3)]))
    bad = good.clone()
    bad[1] = torch.nan
    other = good.clone()
    other[1, 0, 0] = torch.inf
    alone = applied(helpers, "log", good)
    for broken in (bad, other):
        found = applied(helpers, "log", broken)
        assert torch.equal(found[[0, 2]], alone[[0, 2]])
        assert found[1].isnan().all()


# Manifolds.


def spd(n: int, seed: int) -> Any:
    """A point of SPD(n) in doubles."""
    return matrix_of(n, "random", seed)


def spd_truth(p: np.ndarray, q: np.ndarray) -> tuple[Any, Any, Any]:
    """P^(-1/2)-frame Log as a matrix, distance, and log |det D Log|, from mpmath's functions alone."""
    n = len(p)
    P, Q = mp.matrix(p.tolist()), mp.matrix(q.tolist())
    r = mp.inverse(mp.sqrtm((P + P.T) / 2))
    M = r * ((Q + Q.T) / 2) * r
    values, vectors = mp.eigsy((M + M.T) / 2)
    logs = [mp.log(x) for x in values]
    L = vectors * mp.diag(logs) * vectors.T
    det = mp.mpf(0)
    for i in range(n):
        for j in range(i + 1, n):
            half = abs(logs[i] - logs[j]) / 2
            det += mp.log(half / mp.sinh(half)) if half else 0
    return L, mp.sqrt(mp.fsum(x**2 for x in logs)), det


def svec(L: Any, n: int) -> list[Any]:
    return [L[i, j] * (1 if i == j else mp.sqrt(2)) for i, j in places(n)]


Backend = Callable[[str, np.ndarray, np.ndarray], np.ndarray]


@cache
def spd_torch(n: int) -> Any:
    with tempfile.TemporaryDirectory() as folder:
        name = "spd" if n == 2 else f"spd_n{n}"
        return torch_module(files("spd", n=n), name, Path(folder)).manifold


def spd_pairs(n: int) -> list[tuple[np.ndarray, np.ndarray]]:
    """Coincident, close by, middling and far."""
    found = []
    for k, size in enumerate((0.0, 1e-12, 1e-9, 1e-6, 1e-4, 1e-2, 1.0, 3.0)):
        p = spd(n, 40 + k)
        root = np.linalg.cholesky(p)
        step = size * direction(n, k)
        values, vectors = np.linalg.eigh(step)
        q = root @ (vectors * np.exp(values)) @ vectors.T @ root.T
        found.append((p, (q + q.T) / 2 if size else p.copy()))
    return found


@pytest.mark.parametrize("n", [2, 3])
@pytest.mark.parametrize("backend", ["torch", pytest.param("C", marks=needs_compiler)])
def test_spd_is_exact_near_and_far(n: int, backend: str, tmp_path: Path) -> None:
    pairs = spd_pairs(n)
    p, q = (np.stack([pair[i].ravel() for pair in pairs]) for i in (0, 1))
    if backend == "torch":
        manifold = spd_torch(n)
        found = [
            getattr(manifold, f)(torch.tensor(p), torch.tensor(q)).numpy() for f in ("log", "distance", "log_abs_det")
        ]
    else:
        name = "spd" if n == 2 else f"spd_n{n}"
        library = shared_library(files("spd", n=n), name, tmp_path)
        found = [call_batch(library, name, program("spd", n=n)[f], p, q)[0] for f in ("log", "distance", "log_abs_det")]
    log, distance, det = found
    with mp.workdps(60):
        for k, (a, b) in enumerate(pairs):
            L, length, log_det = spd_truth(a, b)
            floor = 40 * 2.0**-52 * np.linalg.cond(a) * np.linalg.cond(b)  # what rounding the points can move Log by
            spread = float(length)
            assert max(abs(mp.mpf(x) - y) for x, y in zip(log[k], svec(L, n), strict=True)) < floor * (1 + spread)
            assert abs(mp.mpf(float(distance[k])) - length) < floor * (1 + spread)
            assert abs(mp.mpf(float(det[k])) - log_det) < floor * (spread + floor)


@pytest.mark.parametrize("n", [2, 3])
def test_spd_exp_inverts_log_and_keeps_to_the_manifold(n: int) -> None:
    manifold = spd_torch(n)
    for p, q in spd_pairs(n):
        a, b = torch.tensor(p).ravel(), torch.tensor(q).ravel()
        back = manifold.exp(a, manifold.log(a, b))
        assert float((back - b).abs().max()) < 1e-13 * float(b.abs().max()) * np.linalg.cond(p)
        assert torch.linalg.eigvalsh(manifold.project(back).reshape(n, n))[0] > 0


def test_a_splat_on_spd_has_derivatives_at_its_centre() -> None:
    """All eigenvalues of P^(-1/2) Q P^(-1/2) are 1 there."""
    manifold = spd_torch(3)
    p = torch.tensor(spd(3, 3)).ravel()
    W, amplitude = torch.eye(6, dtype=torch.float64), torch.ones((), dtype=torch.float64)
    mu = p.clone().requires_grad_()
    value, gradient = manifold.splat(p, mu, W, amplitude)
    assert float(value.detach()) == pytest.approx(1.0, abs=1e-14)
    assert float(gradient.detach().abs().max()) < 1e-13
    (by_mu,) = torch.autograd.grad(gradient.sum(), mu)
    assert torch.isfinite(by_mu).all()
    assert float(by_mu.abs().max()) > 0.1


def rotation(axis: np.ndarray, angle: Any) -> Any:
    """Rodrigues' formula in the working precision."""
    a = mp.matrix(axis.tolist())
    a = a / mp.norm(a)
    K = mp.matrix([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])
    return mp.eye(3) + mp.sin(angle) * K + (1 - mp.cos(angle)) * K * K


ANGLES = ("1e-12", "1e-8", "1e-4", "0.01", "1", "2.5", "pi-1e-3", "pi-1e-6", "pi-1e-9")


def angle_of(text: str) -> Any:
    return mp.pi - mp.mpf(text[3:]) if text.startswith("pi") else mp.mpf(text)


@pytest.mark.parametrize("text", ANGLES)
def test_rotation_matrices_are_exact_at_every_angle(text: str, tmp_path: Path) -> None:
    """Log p^T q = angle axis; |det D Log| = ((t / 2) / sin(t / 2))^2, about each of several axes."""
    manifold = torch_module(files("so3_matrix"), "so3_matrix", tmp_path).manifold
    axes = [*np.eye(3), *rng(1).normal(size=(4, 3))]
    with mp.workdps(50):
        t = angle_of(text)
        for k, axis in enumerate(axes):
            P = rotation(rng(50 + k).normal(size=3), mp.mpf("1.3"))
            Q = P * rotation(axis, t)
            p, q = (torch.tensor([float(x) for x in m], dtype=torch.float64) for m in (P, Q))
            log, unit = manifold.log(p, q), axis / np.linalg.norm(axis)
            wanted = [float(t) * x for x in unit]
            assert np.abs(log.numpy() - wanted).max() < 2e-15 * max(1, float(t)) * 4
            assert float(manifold.distance(p, q)) == pytest.approx(float(t), abs=2e-15 * 4)
            det = 2 * mp.log(t / 2 / mp.sin(t / 2))
            assert float(manifold.log_abs_det(p, q)) == pytest.approx(float(det), abs=1e-14 * max(1e-2, float(t)))
            back = manifold.exp(p, torch.tensor(wanted))
            assert float((back - q).abs().max()) < 4e-15


def test_rotation_matrices_are_sampled_as_rotations(tmp_path: Path) -> None:
    manifold = torch_module(files("so3_matrix"), "so3_matrix", tmp_path).manifold
    like = torch.zeros((), dtype=torch.float64)
    R = manifold.sample(500, torch.Generator().manual_seed(0), like).reshape(-1, 3, 3)
    assert float((R.mT @ R - torch.eye(3)).abs().max()) < 1e-14
    assert float((torch.linalg.det(R) - 1).abs().max()) < 1e-14
    assert float(R.mean(0).abs().max()) < 0.1  # Haar measure has mean 0
    assert float(manifold.sample_ball(R[0].flatten(), 1.0, 50)[:, 0].isfinite().sum()) == 50


def test_the_determinant_of_rotation_matrices_is_found_without_help() -> None:
    assert (
        derive(spec_of((Path(__file__).parent.parent / "manifolds/so3_matrix.yaml").read_text())).log_det_origin
        == "closed form"
    )


SPHERE = """
manifold: matrix_sphere
doc: Unit 2 x 2 matrices, with ambient tangent vectors that are matrices too.
embedded:
  space: R^(2 x 2)
  constraint: dot(p, p) - 1
  project: p / norm(p)
metric: trace(transpose(u) * v)
exp: cos(norm(v)) * p + sinc(norm(v)) * v
log:
  let: {d: q - p, w: "d - dot(p, d) * p", t: "2 * atan2(norm(d), norm(q + p))"}
  value: t * w / norm(w)
distance: t
injectivity_radius: pi
diameter: pi
"""


def test_matrices_can_be_ambient_tangent_vectors() -> None:
    """The sphere of matrices is the sphere of their entries, to the last digit of the interpreter."""
    geometry = derive(spec_of(SPHERE))
    assert geometry.log_det_origin == "closed form"
    program_ = lower(geometry)
    assert all(check.passed for check in Laws(geometry, program_).checks())
    p, q = [0.5, 0.5, 0.5, 0.5], [1.0, 0.0, 0.0, 0.0]
    (length,) = interpret(program_["distance"], p, q)[0]
    with mp.workdps(60):
        assert abs(length - mp.pi / 3) < mp.mpf(10) ** -55


# What people get wrong.

WRONG = {
    "a function of a number, of a matrix": ("logm(r * q * r)", "log(r * q * r)", "does not take a 2 x 2 matrix", "logm(A)"),
    "not square": ("expm(smat(v))", "expm([[1, 2, 3], [4, 5, 6]])", "does not take a 2 x 3 matrix", "symmetric"),
    "not a vector of a triangle's size": ("value: s * expm(smat(v)) * s", "value: s * expm(smat(v[1:])) * s",
                                          "does not take a vector of 2", "n (n + 1) / 2"),
    "a constraint that is a matrix": ("constraint: above(p - transpose(p))", "constraint: p - transpose(p)",
                                      "a scalar or a vector", "above(A)"),
    "a frame that is not linear": ("sqrtm(p) * smat(v) * sqrtm(p)      #", "sqrtm(p) * smat(v) * sqrtm(p) * norm(v)  #",
                                   "not linear in v", ""),
    "a frame that is not of the shape of a point": ("frame: sqrtm(p) * smat(v) * sqrtm(p)", "frame: v", "must be a 2 x 2", ""),
    "a unit matrix of a size that varies": ("s * expm(smat(v)) * s", "s * expm(eye(v[0])) * s", "a number is expected", ""),
    "an eigenvalue with a derivative": ("distance: norm(L)", "distance: eigh(L)[1]", "only compared", "trace(logm(A))"),
}  # fmt: skip


def spd_text() -> str:
    return (Path(__file__).parent.parent / "manifolds/spd.yaml").read_text(encoding="utf-8")


@pytest.mark.parametrize("mistake", WRONG.values(), ids=WRONG)
def test_a_mistake_with_matrices_is_named(mistake: tuple[str, str, str, str]) -> None:
    old, new, message, hint = mistake
    assert old in spd_text()
    with pytest.raises(UserError) as caught:
        derive(spec_of(spd_text().replace(old, new, 1)))
    assert message in caught.value.message
    assert hint in (caught.value.hint or "")
    assert caught.value.span is not None


def test_a_function_of_a_matrix_that_is_not_symmetric_is_refused() -> None:
    text = (Path(__file__).parent.parent / "manifolds/so3_matrix.yaml").read_text(encoding="utf-8")
    old = "exp: p * rotation([cos(norm(v) / 2), sinc(norm(v) / 2) / 2 * v])"
    assert old in text
    with pytest.raises(UserError) as caught:
        derive(spec_of(text.replace(old, "exp: p * expm(hat(v))")))
    assert "symmetric" in caught.value.message


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("distance: norm(L)", "distance: norm(logm(q * r * r))"),
        ("ad_squared(L) / 4", "ad_squared(r * q) / 4"),
        ("invsqrtm(q) * sqrtm(p) * expm(L / 2)", "sqrtm(q * p) * expm(L / 2)"),
    ],
    ids=["distance", "log_det", "transport"],
)
def test_it_is_refused_in_formulas_on_top_of_log_too(old: str, new: str) -> None:
    assert old in spd_text()
    with pytest.raises(UserError, match="here the matrix is none"):
        derive(spec_of(spd_text().replace(old, new)))


def test_a_domain_that_no_matrix_satisfies_is_refused() -> None:
    with pytest.raises(UserError, match="no point"):
        derive(spec_of(spd_text().replace("domain: eigh(p)[0] > 0", "domain: eigh(p)[0] > eigh(p)[1]")))


def test_spaces_of_matrices_are_read() -> None:
    spec = spec_of(spd_text(), n=3)
    assert spec.point_shape == (3, 3)  # type: ignore[union-attr]
    assert (spec.point_size, spec.tangent_size, spec.dim) == (9, 6, 6)
    assert math.prod(spec.tangent_shape) == 6  # type: ignore[union-attr]


def test_a_product_knows_which_of_its_entries_are_matrices(tmp_path: Path) -> None:
    """They are rounded as one: the audit's unit of error is a part of the largest entry of each."""
    file = tmp_path / "pair.yaml"
    file.write_text("manifold: pair\ndoc: A pair.\nproduct: {a: spd, b: torus, c: so3_matrix}\n")
    assert matrices(read_spec(file)) == [slice(0, 4), slice(6, 15)]
