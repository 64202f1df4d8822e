"""Sums without far pairs are the whole sums within the bound that `lower/culling.py` proves; without a bound, the very same."""

from __future__ import annotations

import logging
import math
from collections.abc import Iterator
from typing import Any

import pytest
import torch
from compiled import needs_compiler, program
from torch import Tensor

from rsrm_gen import Manifold, load
from rsrm_gen.compiler.emit.c_culling import CUT
from rsrm_gen.compiler.lower.culling import REACH
from rsrm_gen.errors import UserError
from rsrm_gen.trainer.model import width as width_of

pytestmark = needs_compiler
DTYPES = (torch.float64, torch.float32)
CUTS = dict(zip(DTYPES, CUT.values(), strict=True))
# The largest stretch of D Log and the largest gradient of the determinant's logarithm, as that module has them.
GAP = math.pi * (1 - REACH)
CASES: dict[str, tuple[str, dict[str, int], float, float]] = {
    "sphere": ("sphere", {}, math.pi * REACH / math.sin(GAP), 1 / math.tan(GAP)),
    "so3": ("so3", {}, math.pi / 2, 2 / math.pi),
    "hyperbolic": ("hyperbolic", {}, 1.0, 1.0),
    "torus": ("torus", {}, 1.0, 0.0),
    "torus of 6": ("torus", {"n": 6}, 1.0, 0.0),
    "se3": ("se3", {}, math.pi / 2, 2 / math.pi),
}
Splats = tuple[Tensor, Tensor, Tensor, Tensor, Tensor]


@pytest.fixture(autouse=True)
def one_thread() -> Iterator[None]:
    before = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(before)


def both(name: str, **parameters: int) -> tuple[Manifold, Manifold]:
    """The manifold whose sums leave far pairs out, and the one whose sums do not."""
    return load(name, culling="on", **parameters), load(name, culling="off", **parameters)


def narrow(m: Manifold, points: int, splats: int, sigma: float, dtype: torch.dtype) -> Splats:
    """Points and splats all over a ball, with widths between a third of sigma and sigma, and those widths."""
    generator = torch.Generator().manual_seed(8)

    def draw(*shape: int) -> Tensor:
        return torch.randn(*shape, generator=generator, dtype=torch.float64)

    middle = m.project(0.3 * draw(m.point_size))  # on a hyperboloid near the apex, where sums keep their digits

    def around(count: int) -> Tensor:
        v = 3 * m.to_tangent(middle, draw(count, m.point_size))
        v = v * (3 / m.norm(middle, v)).clamp_max(1.0)[:, None]
        return m.project(m.exp(middle, v))

    mu = around(splats)
    turned = torch.linalg.qr(draw(splats, m.dim, m.dim))[0]
    stretch = sigma * torch.rand(splats, m.dim, generator=generator, dtype=torch.float64).mul(2 / 3).add(1 / 3)
    stretch[:, 0] = sigma
    W = turned @ ((turned / stretch[:, None]).mT @ m.flat(mu[:, None], m.frame(mu)))
    widths = torch.full((splats,), sigma, dtype=torch.float64)
    x, mu, W, amplitude, widths = (t.to(dtype) for t in (around(points), mu, W, draw(splats), widths))
    return x, mu.requires_grad_(), W.requires_grad_(), amplitude.requires_grad_(), widths


def derivatives(m: Manifold, tensors: Splats) -> list[Tensor]:
    """Value, gradient, and the derivatives of a random combination of the two."""
    value, gradient = m.splats(*tensors)
    generator = torch.Generator().manual_seed(9)
    bars = [torch.randn(t.shape, generator=generator, dtype=torch.float64).to(t.dtype) for t in (value, gradient)]
    return [value.detach(), gradient.detach(), *torch.autograd.grad((value, gradient), tensors[1:4], bars)]


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("dtype", DTYPES)
def test_culled_sums_are_the_dense_ones_within_the_bound(case: str, dtype: torch.dtype) -> None:
    name, parameters, stretch, slope = CASES[case]
    culled, dense = both(name, **parameters)
    sigma = 0.12
    tensors = narrow(dense, 600, 70, sigma, dtype)
    found, whole = derivatives(culled, tensors), derivatives(dense, tensors)
    assert not all(map(torch.equal, found, whole)) or near_part(culled, tensors) < 1
    dropped = float(tensors[3].detach().abs().sum()) * math.exp(-CUTS[dtype] / 2)
    radius = math.sqrt(CUTS[dtype] + 2 * program(name, **parameters).culling.log_bound)  # type: ignore[union-attr]
    steep = radius * stretch / (sigma / 3) + slope
    rounding = 64 * torch.finfo(dtype).eps
    assert bool(((found[0] - whole[0]).abs() <= dropped + rounding * whole[0].abs().max()).all())
    difference = dense.norm(tensors[0], found[1] - whole[1])
    assert bool((difference <= dropped * steep + rounding * dense.norm(tensors[0], whole[1]).max()).all())
    for ours, truth in zip(found[2:], whole[2:], strict=True):
        assert float((ours - truth).norm()) <= 256 * rounding * float(truth.norm())  # sums of points in another order


def near_part(m: Any, tensors: Splats) -> float:
    """About which part of the pairs is near."""
    x, mu, _, amplitude, widths = tensors
    return float(m.sums.ordered(x, mu, amplitude, widths, 2.0)[0])


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("dtype", DTYPES)
def test_a_splat_is_left_out_just_beyond_its_reach_and_was_below_the_bound(case: str, dtype: torch.dtype) -> None:
    name, parameters, stretch, slope = CASES[case]
    culled, dense = both(name, **parameters)
    mu, W, sigma = round_splat(dense, dtype)
    radius = math.sqrt(CUTS[dtype] + 2 * program(name, **parameters).culling.log_bound)  # type: ignore[union-attr]
    direction = dense.frame(mu[0])[0]
    inputs = mu, W, torch.ones(1, dtype=dtype), torch.full((1,), sigma, dtype=dtype)
    for times, left_out in ((1.02, True), (0.98, False)):
        x = dense.exp(mu[0], times * radius * sigma * direction)[None]
        value, gradient = culled.splats(x, *inputs)
        whole, whole_gradient = dense.splats(x, *inputs)
        assert float(whole.abs()) <= math.exp(-CUTS[dtype] / 2 * (1 if left_out else 0.9))
        if left_out:
            assert not value.any()
            assert not gradient.any()
            bound = math.exp(-CUTS[dtype] / 2) * (radius * stretch / sigma + slope)
            assert float(dense.norm(x, whole_gradient)) <= bound
        else:
            assert torch.equal(value, whole)
            assert torch.equal(gradient, whole_gradient)
            assert bool(value.any())


def round_splat(m: Manifold, dtype: torch.dtype) -> tuple[Tensor, Tensor, float]:
    """One splat that reaches less far than the cut locus: mu (1, D), W (1, d, T), width."""
    sigma = 0.1
    generator = torch.Generator().manual_seed(2)
    mu = m.project(torch.randn(1, m.point_size, generator=generator, dtype=torch.float64))
    return mu.to(dtype), (m.flat(mu[:, None], m.frame(mu)) / sigma).to(dtype), sigma


@pytest.mark.parametrize("dtype", DTYPES)
def test_nothing_is_left_out_near_the_cut_locus_of_a_sphere(dtype: torch.dtype) -> None:
    culled, dense = both("sphere")
    mu, W, sigma = round_splat(dense, torch.float64)
    away = torch.tensor([[1.0], [1 - 1e-9], [1 - 1e-5], [0.99], [0.98], [0.97]], dtype=torch.float64) * math.pi
    x = dense.exp(mu, away * dense.frame(mu[0])[0])
    # so strong that what is left of it is a number of size
    inputs = [t.to(dtype) for t in (mu, 0.1 * W, torch.full((1,), 1e3).double(), torch.full((1,), sigma).double())]
    for point in x.to(dtype):
        for ours, truth in zip(culled.splats(point[None], *inputs), dense.splats(point[None], *inputs), strict=True):
            assert torch.equal(ours, truth)
    assert bool(dense.splats(x.to(dtype), *inputs)[0].any())


@pytest.mark.parametrize("case", CASES)
def test_one_point_far_from_its_block_finds_its_own_splat(case: str) -> None:
    name, parameters, _, _ = CASES[case]
    culled, dense = both(name, **parameters)
    x, mu, W, amplitude, widths = (t.detach() for t in narrow(dense, 600, 70, 0.1, torch.float64))
    x = x[:1].repeat(600, 1)
    x[311] = mu[5]
    value, _ = culled.splats(x, mu, W, amplitude, widths)
    torch.testing.assert_close(value, dense.splats(x, mu, W, amplitude)[0], rtol=1e-12, atol=1e-15)
    assert bool(value[311] != 0)


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("dtype", DTYPES)
def test_what_is_no_number_spoils_what_it_spoils_anyway(case: str, dtype: torch.dtype) -> None:
    name, parameters, _, _ = CASES[case]
    culled, dense = both(name, **parameters)
    x, mu, W, amplitude, widths = (t.detach() for t in narrow(dense, 200, 20, 0.1, dtype))
    for number in (math.nan, math.inf):
        spoilt = x.clone()
        spoilt[17, -1] = number
        value, gradient = culled.splats(spoilt, mu, W, amplitude, widths)
        others = torch.arange(200) != 17
        assert bool(value[others].isfinite().all())
        assert bool(gradient[others].isfinite().all())
        assert bool(dense.splats(spoilt, mu, W, amplitude)[0][17].isfinite()) == bool(value[17].isfinite())
    for k in (0, 2):
        broken = [mu.clone(), W, amplitude.clone()]
        broken[k][3] = math.nan
        assert bool(culled.splats(x, *broken, widths)[0].isnan().all())
    assert bool(culled.splats(x, mu, W, amplitude, torch.full_like(widths, math.nan))[0].isfinite().all())


@pytest.mark.parametrize("points", [0, 1, 31, 32, 33, 257])
@pytest.mark.parametrize("splats", [0, 1, 5, 300])
def test_any_number_of_points_and_splats_will_do(points: int, splats: int) -> None:
    culled, dense = both("torus")
    tensors = narrow(dense, points, splats, 0.1, torch.float64)
    for ours, truth in zip(derivatives(culled, tensors), derivatives(dense, tensors), strict=True):
        torch.testing.assert_close(ours, truth, rtol=1e-11, atol=1e-11)


@pytest.mark.parametrize("name", ["spd", "arm2"])
@pytest.mark.parametrize("dtype", DTYPES)
def test_where_no_bound_is_known_all_pairs_are_summed(name: str, dtype: torch.dtype) -> None:
    assert program(name).culling is None
    culled, dense = both(name)
    tensors = narrow(dense, 100, 20, 0.1, dtype)
    assert all(map(torch.equal, derivatives(culled, tensors), derivatives(dense, tensors)))


@pytest.mark.parametrize("dtype", DTYPES)
def test_culled_sums_do_not_depend_on_the_number_of_threads(dtype: torch.dtype) -> None:
    culled, _ = both("so3")
    tensors = narrow(culled, 2051, 50, 0.1, dtype)
    one = derivatives(culled, tensors)
    torch.set_num_threads(4)
    assert all(map(torch.equal, one, derivatives(culled, tensors)))


def test_pairs_are_left_out_where_that_pays_and_the_log_says_so_once(caplog: pytest.LogCaptureFixture) -> None:
    m, dense = load("sphere", radius=2), load("sphere", culling="off", radius=2)
    caplog.set_level(logging.INFO, "rsrm_gen")
    for sigma in (0.05, 0.05, 2.0, 2.0):
        tensors = narrow(m, 2000, 100, sigma, torch.float64)
        same = torch.equal(derivatives(m, tensors)[2], derivatives(dense, tensors)[2])
        assert same == (sigma == 2.0)
    said = [words for record in caplog.records if " over " in (words := record.getMessage())]
    assert len(said) == 2
    assert "of the pairs, the near ones" in said[0]
    assert "all pairs" in said[1]


def test_sums_without_widths_leave_nothing_out() -> None:
    culled, dense = both("sphere")
    tensors = narrow(dense, 600, 70, 0.1, torch.float64)[:4]
    assert all(map(torch.equal, culled.splats(*tensors), dense.splats(*tensors)))


def test_other_words_for_culling_are_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(UserError, match="culling is `never`"):
        load("torus", culling="never")
    monkeypatch.setenv("RSRM_CULLING", "1")
    with pytest.raises(UserError, match="RSRM_CULLING is `1`"):
        load("torus")


@pytest.mark.parametrize("d", range(1, 7))
@pytest.mark.parametrize("size", [1e-9, 1.0, 1e9])
def test_the_width_of_a_shape_is_at_least_its_largest_singular_value(d: int, size: float) -> None:
    generator = torch.Generator().manual_seed(d)
    A = size * torch.randn(d, d, 50, generator=generator)
    A[..., 0] = 0
    A[..., 1] = size * torch.eye(d)
    largest = torch.linalg.matrix_norm(A.movedim(-1, 0), ord=2)
    found = width_of(A)
    assert bool((found >= largest * (1 - 1e-5)).all())
    assert bool((found <= largest * (1 if d == 2 else d**0.125) * (1 + 1e-5)).all())
