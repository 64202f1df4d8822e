"""The generated code against values computed elsewhere from closed forms in 90 digits (tests/oracle.npz).

200 rows each: random pairs, near ones down to 1e-9, far ones or ones near the cut locus. `sens` is how much an output
moves when the inputs are rounded, so that a row passes when its error is within 64 (sens + eps |value|).
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
import torch
from compiled import CC, call_batch, files, needs_compiler, program, shared_library, torch_module
from plain_manifolds import Euclidean, FlatTorus, Hyperboloid, Plain, Rotations, Sphere

ORACLE = np.load(Path(__file__).parent / "oracle.npz")
EPS = 2.0**-52

SETS = {"R3": "euclidean", "S2": "sphere", "T2": "torus", "H2": "hyperbolic", "SO3_quat": "so3"}
PLAIN = {"R3": Euclidean(3), "S2": Sphere(2), "T2": FlatTorus(2), "H2": Hyperboloid(2), "SO3_quat": Rotations()}


class Generated(NamedTuple):
    key: str
    torch: Any
    library: ctypes.CDLL | None

    @property
    def name(self) -> str:
        return SETS[self.key]

    def values(self, key: str) -> np.ndarray:
        return np.asarray(ORACLE[f"{self.key}/{key}"])

    def by_torch(self, function: str, *arguments: np.ndarray) -> np.ndarray:
        return getattr(self.torch, function)(*map(torch.from_numpy, arguments)).numpy()

    def by_c(self, function: str, *arguments: np.ndarray) -> np.ndarray:
        assert self.library is not None
        return call_batch(self.library, self.name, program(self.name)[function], *arguments)[0]


@pytest.fixture(scope="module", params=SETS)
def generated(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Generated:
    name, folder = SETS[request.param], tmp_path_factory.mktemp(request.param)
    library = shared_library(files(name), name, folder) if CC else None
    return Generated(request.param, torch_module(files(name), name, folder).manifold, library)


Evaluate = Callable[..., np.ndarray]


@pytest.fixture(params=["torch", pytest.param("c", marks=needs_compiler)])
def evaluate(request: pytest.FixtureRequest, generated: Generated) -> Evaluate:
    return generated.by_torch if request.param == "torch" else generated.by_c


def largest(x: np.ndarray) -> np.ndarray:
    """The maximum norm of each row."""
    return np.abs(x).reshape(len(x), -1).max(axis=1)


@pytest.mark.parametrize(
    ("function", "key"), [("log", "log"), ("distance", "dist"), ("log_abs_det", "logabsdet")], ids=lambda x: x
)
def test_every_row_is_as_exact_as_its_inputs_allow(
    generated: Generated, evaluate: Evaluate, function: str, key: str
) -> None:
    expected, sens = generated.values(key), generated.values(f"sens_{key}")
    error = largest(evaluate(function, generated.values("mu"), generated.values("x")) - expected)
    allowed = 64 * (sens + EPS * largest(expected))
    assert len(error) == 200
    worst = int(np.argmax(error - allowed))
    assert (error <= allowed).all(), f"row {worst}, kind {generated.values('kind')[worst]}: {error[worst]:.3g}"


def test_exp_of_log_is_the_other_point(generated: Generated, evaluate: Evaluate) -> None:
    mu, expected = generated.values("mu"), generated.values("exp")
    there = evaluate("exp", mu, evaluate("log", mu, generated.values("x")))
    # Relative to the point and, where space expands, to what rounding the tangent vector does to the point.
    expansion = largest(expected) * np.maximum(1, largest(generated.values("log")))
    assert (largest(there - expected) <= 64 * EPS * (1 + expansion) + 64 * generated.values("sens_log")).all()


def splat_arguments(generated: Generated, count: int) -> list[torch.Tensor]:
    """mu, W, amplitude for as many rows of the oracle."""
    generator = torch.Generator().manual_seed(0)
    d, tangent = generated.torch.dim, generated.torch.tangent_size
    W = torch.randn(count, d, tangent, generator=generator, dtype=torch.float64) / 2
    amplitude = torch.rand(count, generator=generator, dtype=torch.float64) + 0.5
    return [torch.from_numpy(generated.values("mu")[:count]), W, amplitude]


def test_splats_are_those_of_a_plain_implementation(generated: Generated) -> None:
    rows = 160  # the random ones
    plain: Plain = PLAIN[generated.key]
    x = torch.from_numpy(generated.values("x")[:rows])
    apart = torch.from_numpy((generated.values("dist") < 2.9) & (generated.values("dist") > 0.05))[:rows]
    value, gradient = generated.torch.splat(x, *splat_arguments(generated, rows))
    with torch.no_grad():
        plain_value, plain_gradient = plain.splat(x, *splat_arguments(generated, rows))
    assert int(apart.sum()) > 40
    assert torch.allclose(value[apart], plain_value[apart], rtol=1e-9, atol=1e-12)
    assert torch.allclose(gradient[apart], plain_gradient[apart], rtol=1e-8, atol=1e-11)


def test_splats_are_finite_and_flat_at_their_centre(generated: Generated) -> None:
    mu, W, amplitude = splat_arguments(generated, 200)
    mu = generated.torch.project(mu)
    value, gradient = generated.torch.splat(mu, mu, W, amplitude)
    assert torch.allclose(value, amplitude, rtol=1e-14, atol=0)
    assert float(gradient.abs().max()) < 1e-13


@needs_compiler
def test_splats_in_c_are_those_in_torch(generated: Generated) -> None:
    assert generated.library is not None
    x = torch.from_numpy(generated.values("x"))
    arguments = [x, *splat_arguments(generated, 200)]
    expected = generated.torch.splat(*arguments)
    found = call_batch(
        generated.library, generated.name, program(generated.name)["splat"], *(a.numpy() for a in arguments)
    )
    for ours, theirs in zip(found, expected, strict=True):
        size = 1 + largest(theirs.numpy())[:, None]
        difference = np.abs(ours - theirs.numpy()).reshape(200, -1)
        assert (difference <= 1e-9 * size).all()


def test_the_sum_of_splats_is_the_sum_of_each(generated: Generated) -> None:
    mu, W, amplitude = splat_arguments(generated, 7)
    x = torch.from_numpy(generated.values("x")[20:25])
    value, gradient = generated.torch.splats(x, mu, W, amplitude)
    each = [generated.torch.splat(x, mu[k], W[k], amplitude[k]) for k in range(7)]
    assert torch.allclose(value, sum(v for v, _ in each), rtol=1e-13)
    assert torch.allclose(gradient, sum(g for _, g in each), rtol=1e-12, atol=1e-14)


def test_float32_is_right_to_float32_where_points_are_apart(generated: Generated) -> None:
    kind, distance = generated.values("kind"), generated.values("dist")
    rows = (kind == 0) & (distance > 0.1) & (distance < 2.9)
    p, q = (torch.from_numpy(generated.values(key)[rows]).float() for key in ("mu", "x"))
    for function, key in (("log", "log"), ("distance", "dist"), ("log_abs_det", "logabsdet")):
        expected = generated.values(key)[rows]
        found = getattr(generated.torch, function)(p, q)
        assert found.dtype == torch.float32
        allowed = 64 * (generated.values(f"sens_{key}")[rows] * 2**29 + 2.0**-23 * (1 + largest(expected)))
        assert (largest(found.double().numpy() - expected) <= allowed).all()


# Rows that must not harm themselves (coincident, nearly so) or others (all of them).


def hostile_pairs(generated: Generated) -> tuple[torch.Tensor, torch.Tensor]:
    p = generated.torch.project(torch.from_numpy(generated.values("mu")[:6]))
    q = p.clone()
    q[1] = generated.torch.exp(p[1], torch.full((generated.torch.tangent_size,), 1e-160, dtype=p.dtype))
    q[2] = -p[2]
    q[3] = torch.nan
    q[4] = torch.inf
    q[5] = 0
    return p, q


FUNCTIONS = ("log", "distance", "log_abs_det", "splat", "slope")


def outputs(generated: Generated, function: str, p: torch.Tensor, q: torch.Tensor) -> torch.Tensor:
    if function not in ("splat", "slope"):
        return getattr(generated.torch, function)(p, q)
    _, W, amplitude = splat_arguments(generated, 1)
    value, gradient = generated.torch.splat(q, p, W.expand(len(p), -1, -1), amplitude.expand(len(p)))
    return value if function == "splat" else gradient


def derivatives(generated: Generated, function: str, p: torch.Tensor, q: torch.Tensor) -> list[torch.Tensor]:
    p, q = p.clone().requires_grad_(), q.clone().requires_grad_()
    result = outputs(generated, function, p, q)
    if not result.requires_grad:
        return [torch.zeros_like(p), torch.zeros_like(q)]
    weights = torch.linspace(0.5, 1.5, result[0].numel(), dtype=p.dtype).reshape(result.shape[1:]).expand_as(result)
    found = torch.autograd.grad(result, (p, q), weights, allow_unused=True)
    return [torch.zeros_like(p) if g is None else g for g in found]


@pytest.mark.parametrize("dtype", [torch.float64, torch.float32], ids=["float64", "float32"])
@pytest.mark.parametrize("function", FUNCTIONS)
def test_autograd_is_finite_where_points_coincide(generated: Generated, function: str, dtype: torch.dtype) -> None:
    p = generated.torch.project(torch.from_numpy(generated.values("mu")).to(dtype))
    moved = generated.torch.exp(p, torch.full((len(p), generated.torch.tangent_size), 1e-30, dtype=dtype))
    for q in (p, moved):
        assert torch.isfinite(outputs(generated, function, p, q)).all()
        for gradient in derivatives(generated, function, p, q):
            assert torch.isfinite(gradient).all()


@pytest.mark.parametrize("function", FUNCTIONS)
def test_autograd_is_the_derivative_where_points_are_near(generated: Generated, function: str) -> None:
    # Central differences along the ambient coordinates, across the places where a polynomial takes over.
    # The distance has a kink where points coincide: it is looked at further away.
    h, rows = 2e-6, slice(0, 20) if function == "distance" else slice(150, 180)
    p, q = (torch.from_numpy(generated.values(key)[rows]) for key in ("mu", "x"))
    _, gradient = derivatives(generated, function, p, q)
    for i in range(p.shape[-1]):
        step = h * torch.nn.functional.one_hot(torch.tensor(i), p.shape[-1])
        high, low = (outputs(generated, function, p, q + sign * step) for sign in (1, -1))
        weights = torch.linspace(0.5, 1.5, high[0].numel(), dtype=p.dtype).reshape(high.shape[1:])
        slope = ((high - low) / (2 * h) * weights).reshape(len(p), -1).sum(-1)
        assert torch.allclose(gradient[:, i], slope, rtol=1e-5, atol=1e-6)


@pytest.mark.parametrize("function", FUNCTIONS)
def test_no_row_feels_another(generated: Generated, function: str) -> None:
    good_p, good_q = (torch.from_numpy(generated.values(key)[:32]) for key in ("mu", "x"))
    bad_p, bad_q = hostile_pairs(generated)
    p, q = torch.cat([bad_p, good_p, bad_p]), torch.cat([bad_q, good_q, bad_q])
    rows = slice(len(bad_p), len(bad_p) + 32)
    alone, among = outputs(generated, function, good_p, good_q), outputs(generated, function, p, q)[rows]
    assert torch.allclose(alone, among, rtol=1e-13, atol=1e-15)
    pairs = zip(derivatives(generated, function, good_p, good_q), derivatives(generated, function, p, q), strict=True)
    for expected, found in pairs:
        assert torch.allclose(expected, found[rows], rtol=1e-12, atol=1e-14)


def test_second_derivatives_are_finite_where_points_coincide(generated: Generated) -> None:
    p = generated.torch.project(torch.from_numpy(generated.values("mu")[:20]))
    q = p.clone().requires_grad_()
    _, W, amplitude = splat_arguments(generated, 20)
    W, amplitude = W.requires_grad_(), amplitude.requires_grad_()
    value, gradient = generated.torch.splat(q, p, W, amplitude)
    loss = (value**2).sum() + (gradient**2).sum() + gradient.sum()
    for derivative in torch.autograd.grad(loss, (q, W, amplitude)):
        assert torch.isfinite(derivative).all()
