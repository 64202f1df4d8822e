"""Sums of splats by the generated C are those of the generated torch code, for every thread count and under autograd."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
import torch
from compiled import NAMES, needs_compiler
from torch import Tensor

import rsrm_gen
from rsrm_gen import Manifold, load
from rsrm_gen.kernels import SplatKernel

PARAMETERS = ("mu", "W", "amplitude")
Splats = tuple[Tensor, Tensor, Tensor, Tensor]


@pytest.fixture
def one_thread() -> Iterator[None]:
    before = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(before)


pytestmark = pytest.mark.usefixtures("one_thread")


def in_torch(m: Manifold, *tensors: Tensor) -> tuple[Tensor, Tensor]:
    """The same sum by the generated torch code, which the kernel replaces."""
    value, gradient = type(m).__mro__[1].splats(m, *tensors)  # type: ignore[attr-defined]
    return value, gradient


def some_splats(m: Manifold, points: int, splats: int, dtype: torch.dtype = torch.float64, seed: int = 3) -> Splats:
    """Points and splats near each other, none on the cut locus of another; the last three want gradients."""
    generator = torch.Generator().manual_seed(seed)

    def draw(*shape: int) -> Tensor:
        return torch.randn(*shape, generator=generator, dtype=torch.float64)

    middle = m.project(draw(m.point_size))

    def around(count: int) -> Tensor:
        v = m.to_tangent(middle, draw(count, m.point_size))
        v = v / m.norm(middle, v).clamp_min(1.0)[:, None]  # at most 1 from the middle, so at most 2 apart
        return m.exp(middle, v).to(dtype)

    x, mu = around(points), around(splats)
    W = (0.7 * draw(splats, m.dim, m.tangent_size)).to(dtype)
    return x, mu.requires_grad_(), W.requires_grad_(), draw(splats).to(dtype).requires_grad_()


def with_derivatives(result: tuple[Tensor, Tensor], tensors: Splats) -> dict[str, Tensor]:
    """Value, gradient and the derivatives of a random combination of the two."""
    value, gradient = result
    generator = torch.Generator().manual_seed(9)
    a = torch.randn(value.shape, generator=generator, dtype=torch.float64).to(value.dtype)
    b = torch.randn(gradient.shape, generator=generator, dtype=torch.float64).to(value.dtype)
    bars = torch.autograd.grad((value * a).sum() + (gradient * b).sum(), tensors[1:])
    return {"value": value.detach(), "gradient": gradient.detach(), **dict(zip(PARAMETERS, bars, strict=True))}


def on_manifold(m: Manifold, tensors: Splats, found: dict[str, Tensor]) -> dict[str, Tensor]:
    """The derivatives in mu as Riemannian gradients: off the manifold, splats are what each of the two makes of them."""
    return {**found, "mu": m.riemannian_gradient(tensors[1].detach(), found["mu"])}


def assert_close(found: dict[str, Tensor], expected: dict[str, Tensor], tolerance: float) -> None:
    """To the tolerance, in units of each tensor's norm."""
    for name, truth in expected.items():
        assert found[name].shape == truth.shape, name
        assert found[name].dtype == truth.dtype, name
        error = float((found[name] - truth).norm() / truth.norm().clamp_min(1e-300)) if truth.numel() else 0.0
        assert error <= tolerance, f"{name}: {error:.1e}"


@needs_compiler
@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize(("dtype", "tolerance"), [(torch.float64, 1e-10), (torch.float32, 1e-4)])
def test_kernel_and_torch_agree(name: str, dtype: torch.dtype, tolerance: float) -> None:
    m = load(name)
    tensors = some_splats(m, 200, 40, dtype)
    result = m.splats(*tensors)
    assert result[0].grad_fn is not None
    assert "_Splats" in type(result[0].grad_fn).__name__  # the kernel, not the torch code it is compared with
    found, expected = with_derivatives(result, tensors), with_derivatives(in_torch(m, *tensors), tensors)
    assert_close(on_manifold(m, tensors, found), on_manifold(m, tensors, expected), tolerance)


@needs_compiler
@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize(("dtype", "tolerance"), [(torch.float64, 1e-12), (torch.float32, 1e-5)])
def test_values_alone_and_rows_are_the_same_sums(name: str, dtype: torch.dtype, tolerance: float) -> None:
    m = load(name)
    N, K = 37, 11
    x, mu, W, amplitude = (t.detach().numpy() for t in some_splats(m, N, K, dtype))
    m.splats(*some_splats(m, 1, 1, dtype))
    kernel: SplatKernel = type(m).kernel  # type: ignore[attr-defined]
    rng = np.random.default_rng(5)
    value_bar, gradient_bar = (rng.normal(size=s).astype(x.dtype) for s in ((N,), (N, m.tangent_size)))
    rows = np.empty((N, K, m.point_size + m.dim * m.tangent_size + 1), x.dtype)
    kernel.call("splats_rows", N, K, x, mu, W, amplitude, value_bar, gradient_bar, rows)
    bars = kernel.vjp(x, mu, W, amplitude, value_bar, gradient_bar)
    summed = np.concatenate([bar.reshape(K, -1) for bar in bars], 1)
    np.testing.assert_allclose(rows.sum(0), summed, rtol=0, atol=tolerance * np.abs(rows).sum(0).max())
    value = np.empty(N, x.dtype)
    kernel.call("splats_value", N, K, x, mu, W, amplitude, value)
    both, _ = kernel.forward(x, mu, W, amplitude)
    np.testing.assert_allclose(value, both, rtol=0, atol=tolerance * np.abs(both).max())


@needs_compiler
@pytest.mark.parametrize("name", NAMES)
def test_kernel_derivatives_are_the_differences_of_its_values(name: str) -> None:
    m = load(name)
    x, *parameters = some_splats(m, 3, 2)
    mu, W, amplitude = parameters

    def splats(mu: Tensor, W: Tensor, amplitude: Tensor) -> tuple[Tensor, Tensor]:
        return m.splats(x, m.project(mu), W, amplitude)

    assert torch.autograd.gradcheck(splats, (mu, W, amplitude), eps=1e-6, atol=1e-6, rtol=1e-5)


@needs_compiler
@pytest.mark.parametrize("points", [0, 1, 63, 64, 65, 257])
@pytest.mark.parametrize("splats", [0, 1, 5])
def test_any_number_of_points_and_splats_will_do(points: int, splats: int) -> None:
    m = load("sphere")
    tensors = some_splats(m, points, splats)
    found = with_derivatives(m.splats(*tensors), tensors)
    assert found["value"].shape == (points,)
    assert found["gradient"].shape == (points, m.tangent_size)
    expected = with_derivatives(in_torch(m, *tensors), tensors)
    assert_close(on_manifold(m, tensors, found), on_manifold(m, tensors, expected), 1e-10)


@needs_compiler
@pytest.mark.parametrize("dtype", [torch.float64, torch.float32])
def test_several_threads_give_what_one_gives(dtype: torch.dtype) -> None:
    m = load("so3")
    tensors = some_splats(m, 2051, 9, dtype)  # more than one share of points for each of four threads
    one = with_derivatives(m.splats(*tensors), tensors)
    torch.set_num_threads(4)
    four = with_derivatives(m.splats(*tensors), tensors)
    assert torch.equal(one["value"], four["value"])
    assert torch.equal(one["gradient"], four["gradient"])
    assert all(torch.equal(one[name], four[name]) for name in PARAMETERS)


@needs_compiler
@pytest.mark.parametrize("name", NAMES)
def test_a_point_that_is_no_number_spoils_its_own_row_only(name: str) -> None:
    m = load(name)
    x, mu, W, amplitude = some_splats(m, 70, 4)
    whole = m.splats(x, mu, W, amplitude)
    spoilt = x.clone()
    spoilt[17] = torch.nan
    value, gradient = m.splats(spoilt, mu, W, amplitude)
    others = torch.arange(70) != 17
    assert torch.equal(value[others], whole[0][others])
    assert torch.equal(gradient[others], whole[1][others])
    assert bool(value[17].isnan())
    assert bool(gradient[17].isnan().any())


@needs_compiler
def test_results_are_the_callers_own() -> None:
    m = load("torus")
    tensors = some_splats(m, 30, 3)
    value, gradient = m.splats(*tensors)
    kept = value.detach().clone(), gradient.detach().clone()
    m.splats(*some_splats(m, 30, 3, seed=4))
    assert torch.equal(value, kept[0])
    assert torch.equal(gradient, kept[1])


@needs_compiler
def test_strided_tensors_are_read_in_their_own_order() -> None:
    m = load("hyperbolic")
    x, mu, W, amplitude = (t.detach() for t in some_splats(m, 40, 6))
    strided = (x.T.contiguous().T, mu.flip(0).flip(0), W.transpose(1, 2).contiguous().transpose(1, 2), amplitude)
    for found, expected in zip(m.splats(*strided), m.splats(x, mu, W, amplitude), strict=True):
        assert torch.equal(found, expected)
    every_other = amplitude.repeat_interleave(2)[::2]
    assert torch.equal(m.splats(x, mu, W, every_other)[0], m.splats(x, mu, W, amplitude)[0])


def test_points_that_want_a_gradient_get_theirs() -> None:
    m = load("sphere")
    x, mu, W, amplitude = some_splats(m, 5, 3)
    value, gradient = m.splats(x.requires_grad_(), mu, W, amplitude)
    (partials,) = torch.autograd.grad(value.sum(), x, create_graph=True)
    torch.testing.assert_close(m.riemannian_gradient(x, partials), gradient, rtol=1e-9, atol=1e-12)
    (second,) = torch.autograd.grad(gradient.sum(), x)  # which the kernel does not offer
    assert bool(second.isfinite().all())


@pytest.mark.parametrize("dtype", [torch.float16, torch.bfloat16])
def test_half_precision_is_summed_in_torch(dtype: torch.dtype) -> None:
    m = load("torus")
    tensors = tuple(t.detach().to(dtype) for t in some_splats(m, 6, 3))
    value, gradient = m.splats(*tensors)
    assert value.dtype == gradient.dtype == dtype
    double = m.splats(*(t.double() for t in tensors))
    torch.testing.assert_close(value.double(), double[0], rtol=0, atol=0.1)


def test_mixed_precisions_give_the_wider_one() -> None:
    m = load("torus")
    x, mu, W, amplitude = (t.detach() for t in some_splats(m, 6, 3))
    value, _ = m.splats(x.float(), mu, W, amplitude)
    assert value.dtype == torch.float64
    torch.testing.assert_close(value, m.splats(x, mu, W, amplitude)[0], rtol=1e-5, atol=1e-5)


WITHOUT = """
import torch
from rsrm_gen import load
m = load("torus")
load("torus")
ones = torch.ones(2, 2)
print(m.splats(ones, ones, torch.eye(2).expand(2, 2, 2), torch.ones(2))[0].tolist())
"""


def test_without_a_compiler_torch_sums_and_one_line_says_so(tmp_path: Path) -> None:
    root = str(Path(rsrm_gen.__file__).parent.parent)
    nowhere = {**os.environ, "CC": str(tmp_path / "cc"), "PYTHONPATH": root, "OMP_NUM_THREADS": "1"}
    ran = subprocess.run(
        [sys.executable, "-c", WITHOUT], env=nowhere, cwd=tmp_path, capture_output=True, text=True, check=True
    )
    assert ran.stdout == "[2.0, 2.0]\n"
    assert ran.stderr.count("\n") == 1
    assert "no C compiler found" in ran.stderr


@needs_compiler
@pytest.mark.parametrize("name", NAMES)
def test_tensors_that_only_broadcast_are_left_to_torch(name: str) -> None:
    m = load(name)
    x, mu, W, _ = some_splats(m, 5, 4)
    for odd in ((x, mu, W, torch.ones(1).double()), (x[None], mu, W, torch.ones(4).double())):
        for ours, truth in zip(m.splats(*odd), in_torch(m, *odd), strict=True):
            assert ours.shape == truth.shape
            torch.testing.assert_close(ours, truth)


@needs_compiler
def test_splats_that_do_not_fit_are_an_error_and_not_read() -> None:
    m = load("sphere")
    x, mu, W, amplitude = some_splats(m, 5, 4)
    with pytest.raises(RuntimeError):
        m.splats(x, mu, W[:3], amplitude)


@needs_compiler
def test_what_was_changed_before_the_backward_pass_is_noticed() -> None:
    m = load("sphere")
    x, mu, W, amplitude = some_splats(m, 5, 4)
    value, _ = m.splats(x, mu, W, amplitude)
    with torch.no_grad():
        mu += 0.1
    with pytest.raises(RuntimeError, match="modified by an inplace operation"):
        value.sum().backward()
