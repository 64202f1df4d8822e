"""Sums of splats in C and in torch: exact to the last promised digit, for any sizes, threads and callers."""

from __future__ import annotations

import ctypes
import logging
import os
import random
import shutil
import subprocess
import sys
import threading
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import mpmath as mp
import numpy as np
import pytest
import torch
from compiled import MANIFOLDS, NAMES, geometry, needs_compiler, program, summing
from torch import Tensor

import rsrm_gen
from rsrm_gen import Manifold, UserError, load
from rsrm_gen.compiler import native
from rsrm_gen.compiler.derive.sampling import sampler_of
from rsrm_gen.compiler.lower import interpret
from rsrm_gen.manifold import not_finite

CASES: list[tuple[str, dict[str, Any]]] = [
    *((name, {}) for name in NAMES),
    ("sphere", {"n": 5}),
    ("hyperbolic", {"n": 5}),
    ("torus", {"n": 6}),
]
BY = [pytest.param("c", marks=needs_compiler), "torch"]
TOLERANCE = {torch.float64: 1e-10, torch.float32: 1e-5}  # of the norm
PARAMETERS = ("mu", "W", "amplitude")
Splats = tuple[Tensor, Tensor, Tensor, Tensor]
Results = dict[str, Tensor]


@pytest.fixture(autouse=True)
def one_thread() -> Iterator[None]:
    before = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(before)


def some_splats(m: Manifold, points: int, splats: int, dtype: torch.dtype = torch.float64, seed: int = 3) -> Splats:
    """Points and splats near each other, none on the cut locus of another; the last three want gradients."""
    generator = torch.Generator().manual_seed(seed)

    def draw(*shape: int) -> Tensor:
        return torch.randn(*shape, generator=generator, dtype=torch.float64)

    middle = m.project(0.4 * draw(m.point_size))

    def around(count: int) -> Tensor:
        v = m.to_tangent(middle, draw(count, m.point_size))
        v = v / m.norm(middle, v).clamp_min(1.0)[:, None]  # at most 1 from the middle, so at most 2 apart
        return m.exp(middle, v).to(dtype)

    x, mu = around(points), around(splats)
    W = (0.7 * draw(splats, m.dim, m.tangent_size)).to(dtype)
    return x, mu.requires_grad_(), W.requires_grad_(), draw(splats).to(dtype).requires_grad_()


def bars_of(x: Tensor, m: Manifold) -> tuple[Tensor, Tensor]:
    """Random derivatives of something in the values and gradients."""
    generator = torch.Generator().manual_seed(9)
    value_bar = torch.randn(len(x), generator=generator, dtype=torch.float64)
    gradient_bar = torch.randn(len(x), m.tangent_size, generator=generator, dtype=torch.float64)
    return value_bar.to(x), gradient_bar.to(x)


def all_results(m: Manifold, tensors: Splats) -> Results:
    """Value, gradient and the derivatives of a random combination of the two."""
    result = m.splats(*tensors)
    bars = torch.autograd.grad(result, tensors[1:], bars_of(tensors[0], m))
    return {"value": result[0].detach(), "gradient": result[1].detach(), **dict(zip(PARAMETERS, bars, strict=True))}


def by_autograd(m: Manifold, tensors: Splats) -> Results:
    """The same from the splats one by one, differentiated by autograd in double precision."""
    x, *own = (t.detach().double().requires_grad_(t.requires_grad) for t in tensors)
    value, gradient = m.splat(x[:, None], *own)
    result = value.sum(1), gradient.sum(1)
    bars = torch.autograd.grad(result, own, tuple(bar.double() for bar in bars_of(tensors[0], m)))
    return {"value": result[0].detach(), "gradient": result[1].detach(), **dict(zip(PARAMETERS, bars, strict=True))}


def exactly(name: str, parameters: dict[str, Any], tensors: Splats, m: Manifold) -> Results:
    """The same in 60 digits, by the author's formulas; the inputs are taken as they are."""
    p = program(name, **parameters)
    x, *own = (_exact(t) for t in tensors)
    value_bar, gradient_bar = (_exact(bar) for bar in bars_of(tensors[0], m))
    found: dict[str, list[Any]] = {"value": [], "gradient": [], **{key: [None] * len(own[0]) for key in PARAMETERS}}
    with mp.workdps(60):
        for n, point in enumerate(x):
            value, gradient = None, None
            for k, splat in enumerate(zip(*own, strict=True)):
                one = interpret(p["splat"], point, *splat)
                value, gradient = _plus(value, one[0]), _plus(gradient, one[1])
                bars = interpret(p["splat_vjp"], point, *splat, value_bar[n], gradient_bar[n])
                for key, bar in zip(PARAMETERS, bars, strict=True):
                    found[key][k] = _plus(found[key][k], bar)
            found["value"].append(value)
            found["gradient"].append(gradient)
    like = {"value": tensors[0][:, 0], "gradient": tensors[0].new_empty(len(x), m.tangent_size)}
    like |= dict(zip(PARAMETERS, tensors[1:], strict=True))
    return {
        key: torch.tensor([[float(c) for c in row] for row in rows], dtype=torch.float64).reshape(like[key].shape)
        for key, rows in found.items()
    }


def _exact(tensor: Tensor) -> list[list[Any]]:
    return [[mp.mpf(c) for c in row] for row in tensor.detach().double().reshape(len(tensor), -1).tolist()]


def _plus(total: list[Any] | None, more: list[Any]) -> list[Any]:
    return list(more) if total is None else [a + b for a, b in zip(total, more, strict=True)]


def assert_close(m: Manifold, mu: Tensor, found: Results, expected: Results, tolerance: float) -> None:
    """To the tolerance, in units of each tensor's norm; of the derivatives in mu, the part that is on the manifold."""
    for name, truth in expected.items():
        ours = found[name].double()
        assert ours.shape == truth.shape, name
        if name == "mu":
            ours, truth = (m.riemannian_gradient(mu.detach().double(), bar) for bar in (ours, truth))
        error = float((ours - truth).norm() / truth.norm().clamp_min(1e-300)) if truth.numel() else 0.0
        assert error <= tolerance, f"{name}: {error:.1e}"


@cache
def exact_pairs(name: str, dtype: torch.dtype, **parameters: Any) -> tuple[Splats, Results]:
    m = summing(name, "torch", **parameters)
    tensors = some_splats(m, 2, 2, dtype, seed=5)
    return tensors, exactly(name, parameters, tensors, m)


@pytest.mark.parametrize(("name", "parameters"), CASES)
@pytest.mark.parametrize("dtype", TOLERANCE)
@pytest.mark.parametrize("by", BY)
def test_sums_are_those_in_60_digits(name: str, parameters: dict[str, Any], dtype: torch.dtype, by: str) -> None:
    tensors, truth = exact_pairs(name, dtype, **parameters)
    m = summing(name, by, **parameters)
    found = all_results(m, tensors)
    assert {t.dtype for t in found.values()} == {dtype}
    assert_close(m, tensors[1], found, truth, TOLERANCE[dtype])


@pytest.mark.parametrize(("name", "parameters"), CASES)
@pytest.mark.parametrize("dtype", TOLERANCE)
@pytest.mark.parametrize("by", BY)
def test_sums_are_those_of_autograd(name: str, parameters: dict[str, Any], dtype: torch.dtype, by: str) -> None:
    m = summing(name, by, **parameters)
    tensors = some_splats(m, 131, 17, dtype)
    truth = by_autograd(m, tensors)
    assert_close(m, tensors[1], all_results(m, tensors), truth, TOLERANCE[dtype])
    value = m.splats_value(*tensors)
    torch.testing.assert_close(
        value.double(), truth["value"], rtol=0, atol=TOLERANCE[dtype] * float(truth["value"].norm())
    )


@pytest.mark.parametrize(("name", "parameters"), CASES)
@pytest.mark.parametrize("by", BY)
def test_rows_add_up_to_the_derivatives(name: str, parameters: dict[str, Any], by: str) -> None:
    m = summing(name, by, **parameters)
    tensors = some_splats(m, 19, 3)
    rows = m.splats_rows(*tensors, *bars_of(tensors[0], m))
    assert rows.shape == (19, 3, m.point_size + m.dim * m.tangent_size + 1)
    mu, W, amplitude = rows.sum(0).split([m.point_size, m.dim * m.tangent_size, 1], -1)
    found = {"mu": mu, "W": W.reshape(tensors[2].shape), "amplitude": amplitude[:, 0]}
    truth = all_results(m, tensors)
    assert_close(m, tensors[1], found, {key: truth[key] for key in PARAMETERS}, 1e-12)
    one = [t[7:8] for t in (tensors[0], *bars_of(tensors[0], m))]
    torch.testing.assert_close(m.splats_rows(one[0], *tensors[1:], *one[1:])[0], rows[7], rtol=1e-12, atol=1e-14)


@pytest.mark.parametrize("by", BY)
@pytest.mark.parametrize("dtype", TOLERANCE)
@pytest.mark.parametrize("points", [0, 1, 2, 15, 16, 17, 33, 129])
def test_any_number_of_points_and_splats_will_do(points: int, dtype: torch.dtype, by: str) -> None:
    m = summing("sphere", by)
    for splats in (0, 1, 5):
        tensors = some_splats(m, points, splats, dtype)
        found = all_results(m, tensors)
        assert found["value"].shape == (points,)
        assert found["gradient"].shape == (points, m.tangent_size)
        assert_close(m, tensors[1], found, by_autograd(m, tensors), TOLERANCE[dtype])
        assert m.splats_rows(*tensors, *bars_of(tensors[0], m)).shape == (points, splats, 10)


# Where formulas lose digits.


def at_distances(name: str, distances: list[float], scale: float, dtype: torch.dtype, m: Manifold) -> Splats:
    """One splat, and a point at each distance from it."""
    mu, direction = sampler_of(geometry(name)).pair(random.Random(11))
    start = torch.tensor([[float(c) for c in mu]], dtype=torch.float64)
    towards = torch.tensor([[float(c) for c in direction]], dtype=torch.float64)
    v = m.log(start, towards)
    v = v / m.norm(start, v)[:, None]
    x = m.exp(start, torch.tensor(distances, dtype=torch.float64)[:, None] * v).to(dtype)
    generator = torch.Generator().manual_seed(2)
    A = torch.eye(m.dim, dtype=torch.float64) + 0.2 * torch.randn(
        m.dim, m.dim, generator=generator, dtype=torch.float64
    )
    W = (A / scale @ m.flat(start[:, None], m.frame(start))).to(dtype)
    one = torch.ones(1, dtype=dtype)
    return x, start.to(dtype).requires_grad_(), W.requires_grad_(), one.requires_grad_()


@pytest.mark.parametrize("name", ["sphere", "hyperbolic", "so3", "so3_matrix", "spd", "poincare", "se3"])
@pytest.mark.parametrize("dtype", TOLERANCE)
@pytest.mark.parametrize("by", BY)
def test_points_at_a_centre_and_near_it_are_as_exact(name: str, dtype: torch.dtype, by: str) -> None:
    m = summing(name, by)
    tensors = at_distances(name, [0.0, 1e-9, 1e-5, 1e-2, 0.2], 0.3, dtype, m)
    found = all_results(m, tensors)
    assert all(bool(t.isfinite().all()) for t in found.values())
    assert_close(m, tensors[1], found, exactly(name, {}, tensors, m), TOLERANCE[dtype])


@pytest.mark.parametrize("name", ["sphere", "so3"])
@pytest.mark.parametrize("scale", [0.5, 1.5])  # of the splat: the second is wide over the cut locus
@pytest.mark.parametrize("dtype", TOLERANCE)
@pytest.mark.parametrize("by", BY)
def test_near_the_cut_locus_errors_are_those_of_rounding_the_input(
    name: str, scale: float, dtype: torch.dtype, by: str
) -> None:
    m = summing(name, by)
    for gap in (0.1, 1e-3, 1e-5):
        tensors = at_distances(name, [torch.pi - gap], scale, dtype, m)
        tolerance = 32 * torch.finfo(dtype).eps * (1 + 1 / gap)  # |det D Log| grows like 1 / gap
        assert_close(m, tensors[1], all_results(m, tensors), exactly(name, {}, tensors, m), tolerance)


@pytest.mark.parametrize("dtype", TOLERANCE)
@pytest.mark.parametrize("by", BY)
def test_wide_splats_over_the_antipode_of_many_points_stay_finite(dtype: torch.dtype, by: str) -> None:
    m = summing("sphere", by)
    x, mu, _, amplitude = some_splats(m, 64, 64, dtype)
    mu = (-x).detach().requires_grad_()  # each splat exactly opposite one of the points
    W = (m.flat(x[:, None], m.frame(x)) / 0.8).detach().requires_grad_()
    found = all_results(m, (x, mu, W, amplitude))
    assert all(bool(t.isfinite().all()) for t in found.values())
    truth = by_autograd(m, (x, mu, W, amplitude))
    off = ~torch.eye(64, dtype=torch.bool)  # what is not opposite, one splat at a time
    for k in range(0, 64, 9):
        near = off[k] & (m.distance(-x, mu[k].detach()) < 2.5)
        own = tuple(t[k : k + 1] for t in (mu, W, amplitude))
        value = m.splats_value(x[near], *own)
        expected = m.splat(x[near].double(), *(t[0].double() for t in own))[0]
        torch.testing.assert_close(value.double(), expected, rtol=1e3 * torch.finfo(dtype).eps, atol=0)
    assert torch.isfinite(truth["value"]).all()


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("by", BY)
def test_what_is_not_finite_stays_in_its_rows(name: str, by: str) -> None:
    m = summing(name, by)
    x, mu, W, amplitude = (t.detach() for t in some_splats(m, 70, 4))
    whole, bars = m.splats(x, mu, W, amplitude), bars_of(x, m)
    rows = m.splats_rows(x, mu, W, amplitude, *bars)
    for bad in (torch.nan, torch.inf):
        spoilt = x.clone()
        spoilt[17] = bad
        others = torch.arange(70) != 17
        value, gradient = m.splats(spoilt, mu, W, amplitude)
        # to a rounding: beside numbers that are too large for it, a faster sine may give way to an exact one
        found = value, gradient, m.splats_rows(spoilt, mu, W, amplitude, *bars)
        for ours, clean in zip(found, (*whole, rows), strict=True):
            torch.testing.assert_close(ours[others], clean[others], rtol=1e-12, atol=1e-14)
        assert not bool(gradient[17].isfinite().all()) or bool((gradient[17] == 0).all())  # infinitely far is zero
        if bad is torch.nan:
            assert bool(value[17].isnan())
            assert bool(gradient[17].isnan().any())
    parts = [t.clone().requires_grad_() for t in (mu, W, amplitude)]
    with torch.no_grad():
        parts[1][2] = torch.nan
    value, gradient = m.splats(x, *parts)
    assert bool(value.isnan().all())  # that splat is in every sum
    derivatives = torch.autograd.grad((value, gradient), parts, bars)
    for bar in derivatives:
        assert bool(bar[[0, 1, 3]].isfinite().all())
        assert bool(bar[2].isnan().any())


def test_what_is_not_finite_is_named() -> None:
    x, W = torch.ones(4, 2), torch.ones(3, 2, 2)
    assert not_finite(x=x, W=W, amplitude=torch.ones(3), nothing=torch.ones(0, 2)) is None
    W[1, 0, 1] = torch.inf
    assert not_finite(x=x, W=W) == "W[1] is not finite: [1, inf, 1, 1] (1 of 3 rows)"
    assert not_finite(a=torch.tensor([0, 1, torch.nan])) == "a[2] is not finite: [nan] (1 of 3 rows)"


# Threads and processes.


@needs_compiler
@pytest.mark.parametrize("name", ["so3", "spd", "dual_arm"])
@pytest.mark.parametrize("dtype", TOLERANCE)
def test_two_threads_give_the_bits_that_one_gives(name: str, dtype: torch.dtype) -> None:
    m = summing(name)
    tensors = some_splats(m, 1203, 31, dtype)
    one = all_results(m, tensors)
    for count in (2, 3):
        torch.set_num_threads(count)
        several = all_results(m, tensors)
        assert all(torch.equal(several[key], one[key]) for key in one)


@needs_compiler
def test_threads_of_the_caller_do_not_meet() -> None:
    m = summing("sphere")
    torch.set_num_threads(2)
    cases = [some_splats(m, 900 + 100 * i, 60, seed=i) for i in range(4)]
    alone = [all_results(m, tensors) for tensors in cases]
    wrong: list[int] = []

    def work(i: int) -> None:
        for _ in range(20):
            found = all_results(m, cases[i])
            if not all(torch.equal(found[key], alone[i][key]) for key in found):
                wrong.append(i)

    threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


@needs_compiler
@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")
@pytest.mark.filterwarnings("ignore:This process .* is multi-threaded:DeprecationWarning")
def test_a_forked_child_sums_too() -> None:
    m = summing("sphere")
    torch.set_num_threads(2)
    tensors = tuple(t.detach() for t in some_splats(m, 1000, 60))
    value, _ = m.splats(*tensors)
    child = os.fork()
    if child == 0:
        same = torch.equal(m.splats(*tensors)[0], value)
        os._exit(0 if same else 1)
    assert os.waitpid(child, 0)[1] == 0


# Autograd and the compiler of torch.


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("by", BY)
def test_derivatives_are_the_differences_of_values(name: str, by: str) -> None:
    m = summing(name, by)
    x, mu, W, amplitude = some_splats(m, 2, 2)

    def splats(mu: Tensor, W: Tensor, amplitude: Tensor) -> tuple[Tensor, ...]:
        return (*m.splats(x, m.project(mu), W, amplitude), m.splats_value(x, m.project(mu), W, amplitude))

    assert torch.autograd.gradcheck(splats, (mu, W, amplitude), eps=1e-6, atol=1e-6, rtol=1e-5, fast_mode=True)


@pytest.mark.parametrize("by", BY)
def test_second_derivatives_are_refused(by: str) -> None:
    m = summing("sphere", by)
    tensors = some_splats(m, 3, 2)
    for result in (m.splats(*tensors)[0], m.splats_value(*tensors).square()):
        (once,) = torch.autograd.grad(result.sum(), tensors[1], create_graph=True)
        with pytest.raises(RuntimeError, match="`splats` has first derivatives only"):
            (once.sum() + tensors[1].square().sum()).backward()


def test_points_that_want_a_gradient_get_theirs_and_second_ones() -> None:
    m = summing("sphere", "auto")
    x, mu, W, amplitude = some_splats(m, 3, 2)
    x.requires_grad_()
    value, gradient = m.splats(x, mu, W, amplitude)
    (partials,) = torch.autograd.grad(value.sum(), x, create_graph=True)
    torch.testing.assert_close(m.riemannian_gradient(x, partials), gradient, rtol=1e-9, atol=1e-12)
    assert torch.autograd.gradgradcheck(
        lambda x, mu: m.splats(m.project(x), m.project(mu), W, amplitude), (x, mu), atol=1e-5, fast_mode=True
    )


@pytest.mark.filterwarnings("ignore:.*should not be instantiated:DeprecationWarning")  # torch's own doing
@pytest.mark.parametrize("name", ["sphere", "torus"])
@pytest.mark.parametrize("by", BY)
def test_torch_compiles_sums_whole(name: str, by: str) -> None:
    m = summing(name, by)
    tensors = some_splats(m, 40, 6)

    def loss(x: Tensor, mu: Tensor, W: Tensor, amplitude: Tensor) -> Tensor:
        value, gradient = m.splats(2 * x / 2, mu, W, amplitude)
        return (value.square() + gradient.square().sum(-1)).sum() + m.splats_value(x, mu, W, amplitude).sum()

    compiled = torch.compile(loss, fullgraph=True, backend="aot_eager")
    truth = loss(*tensors)
    torch.testing.assert_close(compiled(*tensors), truth)
    for ours, expected in zip(
        torch.autograd.grad(compiled(*tensors), tensors[1:]), torch.autograd.grad(truth, tensors[1:]), strict=True
    ):
        torch.testing.assert_close(ours, expected)


@needs_compiler
@pytest.mark.parametrize("dtype", TOLERANCE)
def test_operations_are_what_torch_expects_of_them(dtype: torch.dtype) -> None:
    m = summing("so3")
    tensors = some_splats(m, 7, 3, dtype)
    key = next(key for key in kernels_by_key() if key.startswith("so3_") and "matrix" not in key)
    for name in ("splats", "splats_value"):
        torch.library.opcheck(getattr(torch.ops.rsrm_gen, name).default, (key, *tensors))
    plain = tuple(t.detach() for t in tensors)
    for name in ("splats_vjp", "splats_rows"):
        torch.library.opcheck(getattr(torch.ops.rsrm_gen, name).default, (key, *plain, *bars_of(tensors[0], m)))


def kernels_by_key() -> dict[str, Any]:
    from rsrm_gen.kernels import _KERNELS

    return _KERNELS


def test_an_operation_without_its_kernel_says_what_to_do() -> None:
    one = torch.ones(1, 1)
    with pytest.raises(UserError, match="the kernel nowhere is not loaded"):
        torch.ops.rsrm_gen.splats_value("nowhere", one, one, one[None], one[0])


@needs_compiler
@pytest.mark.parametrize("by", BY)
def test_what_was_changed_before_the_backward_pass_is_noticed(by: str) -> None:
    m = summing("sphere", by)
    x, mu, W, amplitude = some_splats(m, 5, 4)
    value, _ = m.splats(x, mu, W, amplitude)
    with torch.no_grad():
        mu += 0.1
    with pytest.raises(RuntimeError, match="modified by an inplace operation"):
        value.sum().backward()


def test_results_are_the_callers_own() -> None:
    m = summing("torus", "auto")
    tensors = some_splats(m, 30, 3)
    value, gradient = m.splats(*tensors)
    kept = value.detach().clone(), gradient.detach().clone()
    m.splats(*some_splats(m, 30, 3, seed=4))
    assert torch.equal(value, kept[0])
    assert torch.equal(gradient, kept[1])


@pytest.mark.parametrize("by", BY)
def test_strided_tensors_are_read_in_their_own_order(by: str) -> None:
    m = summing("hyperbolic", by)
    x, mu, W, amplitude = (t.detach() for t in some_splats(m, 40, 6))
    strided = (x.T.contiguous().T, mu.flip(0).flip(0), W.transpose(1, 2).contiguous().transpose(1, 2), amplitude)
    for found, expected in zip(m.splats(*strided), m.splats(x, mu, W, amplitude), strict=True):
        assert torch.equal(found, expected)
    every_other = amplitude.repeat_interleave(2)[::2]
    assert torch.equal(m.splats(x, mu, W, every_other)[0], m.splats(x, mu, W, amplitude)[0])


# What is taken, and by what it is summed.


@pytest.mark.parametrize("dtype", [torch.float16, torch.bfloat16])
def test_half_precision_is_summed_in_single(dtype: torch.dtype) -> None:
    m = summing("torus", "auto")
    tensors = tuple(t.detach().to(dtype) for t in some_splats(m, 6, 3))
    value, gradient = m.splats(*tensors)
    assert value.dtype == gradient.dtype == dtype
    exact = m.splats(*(t.float() for t in tensors))
    torch.testing.assert_close(value, exact[0].to(dtype))
    torch.testing.assert_close(gradient, exact[1].to(dtype))
    assert m.splats_rows(*tensors, *bars_of(tensors[0], m)).dtype == dtype


def test_mixed_precisions_give_the_wider_one() -> None:
    m = summing("torus", "auto")
    x, mu, W, amplitude = (t.detach() for t in some_splats(m, 6, 3))
    value, _ = m.splats(x.float(), mu, W, amplitude)
    assert value.dtype == torch.float64
    torch.testing.assert_close(value, m.splats(x, mu, W, amplitude)[0], rtol=1e-5, atol=1e-5)


@pytest.mark.parametrize("by", ["auto", *BY])
def test_numbers_and_shapes_that_are_no_splats_are_errors(by: str) -> None:
    m = summing("sphere", by)
    x, mu, W, amplitude = (t.detach() for t in some_splats(m, 5, 4))
    with pytest.raises(ValueError, match=r"W has shape \(3, 2, 3\); with 5 points and 4 splats it is \(4, 2, 3\)"):
        m.splats(x, mu, W[:3], amplitude)
    with pytest.raises(ValueError, match="amplitude has shape"):
        m.splats_value(x, mu, W, amplitude[:1])
    with pytest.raises(ValueError, match="x has shape"):
        m.splats(x[0], mu, W, amplitude)
    if by != "c":
        with pytest.raises(TypeError, match=r"x is torch.int64: splats take floating-point numbers"):
            m.splats(x.long(), mu, W, amplitude)


@needs_compiler
def test_c_that_is_forced_says_why_it_cannot() -> None:
    m = summing("sphere", "c")
    x, mu, W, amplitude = (t.detach() for t in some_splats(m, 5, 4))
    with pytest.raises(UserError, match="x is float16 and C has float32 and float64") as caught:
        m.splats(*(t.half() for t in (x, mu, W, amplitude)))
    assert "auto" in str(caught.value.hint)
    with pytest.raises(UserError, match="float32 and float64 are mixed"):
        m.splats(x.float(), mu, W, amplitude)
    with pytest.raises(UserError, match="x requires a gradient"):
        m.splats(x.requires_grad_(), mu, W, amplitude)
    with pytest.raises(UserError, match="x is on meta and C runs on the CPU"):
        m.splats(*(t.to("meta") for t in (x, mu, W, amplitude)))


@pytest.mark.parametrize("name", NAMES)
def test_torch_code_keeps_to_the_device_it_is_given(name: str) -> None:
    m = summing(name, "torch")
    if name == "spd":
        pytest.skip("whether Jacobi's rotations are enough cannot be asked of numbers that are not there")
    tensors = tuple(t.detach().to("meta").requires_grad_(t.requires_grad) for t in some_splats(m, 9, 4))
    found = all_results(m, tensors)
    assert {t.device.type for t in found.values()} == {"meta"}
    assert found["W"].shape == tensors[2].shape


@needs_compiler
def test_the_log_says_once_what_sums(caplog: pytest.LogCaptureFixture) -> None:
    from compiled import files

    from rsrm_gen.kernels import accelerated

    assert files("circle")
    m = type(summing("circle", "c")).__mro__[1]()  # type: ignore[attr-defined]
    folder = Path(sys.modules[type(m).__module__].__file__ or "").parent
    m = accelerated(m, folder)
    tensors = tuple(t.detach() for t in some_splats(m, 5, 4))
    caplog.set_level(logging.INFO, "rsrm_gen")
    for _ in range(2):
        m.splats(*tensors)
        m.splats(*(t.half() for t in tensors))
    said = [record.message for record in caplog.records]
    assert len(said) == 2
    assert said[0] == f"circle: sums of splats by {m.kernels(tensors[0])}"
    assert m.kernels(tensors[0]).endswith(", 1 thread")
    assert said[1] == "circle: sums of splats by torch, x is float16 and C has float32 and float64"
    assert m.kernels(tensors[0].half()) == "torch, cpu (x is float16 and C has float32 and float64)"


@pytest.mark.parametrize("choice", ["auto", "torch", pytest.param("c", marks=needs_compiler)])
def test_load_is_told_what_sums(choice: str, monkeypatch: pytest.MonkeyPatch) -> None:
    by_argument = load("torus", kernels=choice)
    monkeypatch.setenv("RSRM_KERNELS", choice)
    assert load("torus") is by_argument
    sums = load("torus").kernels(torch.zeros(1))
    assert sums.startswith("torch, cpu" if choice == "torch" else "C, ")


def test_an_unknown_choice_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(UserError, match="kernels is `gpu`") as caught:
        load("torus", kernels="gpu")
    assert "auto, c, torch" in str(caught.value.hint)
    monkeypatch.setenv("RSRM_KERNELS", "fast")
    with pytest.raises(UserError, match="RSRM_KERNELS is `fast`"):
        load("torus")


WITHOUT = """
import torch
from rsrm_gen import UserError, load
m = load("torus")
load("torus")
ones = torch.ones(2, 2)
print(m.splats(ones, ones, torch.eye(2).expand(2, 2, 2), torch.ones(2))[0].tolist(), m.kernels(ones))
try:
    load("torus", kernels="c")
except UserError as error:
    print(error.message)
"""


def test_without_a_compiler_torch_sums_and_one_line_says_so(tmp_path: Path) -> None:
    root = str(Path(rsrm_gen.__file__).parent.parent)
    nowhere = {**os.environ, "CC": str(tmp_path / "cc"), "PYTHONPATH": root, "OMP_NUM_THREADS": "1"}
    ran = subprocess.run(
        [sys.executable, "-c", WITHOUT], env=nowhere, cwd=tmp_path, capture_output=True, text=True, check=True
    )
    assert ran.stdout == "[2.0, 2.0] torch, cpu\nC is wanted for sums of splats, but there is no C compiler\n"
    assert ran.stderr.count("\n") == 1
    assert "no C compiler found" in ran.stderr


@pytest.mark.parametrize("name", ["torus", "sphere", "so3", "so3_matrix"])
def test_clang_sums_what_the_usual_compiler_sums(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    if shutil.which("clang") is None:
        pytest.skip("no clang on this machine")
    m = load(name)
    generator = torch.Generator().manual_seed(3)
    x, mu = m.sample(37, generator).double(), m.sample(11, generator).double()
    W, amplitude = 2 * m.flat(mu[:, None], m.frame(mu)), torch.ones(11, dtype=torch.float64)
    inputs = [np.ascontiguousarray(t.numpy()) for t in (x, mu, W, amplitude)]
    found = []
    for cc in (None, "clang"):
        if cc:
            monkeypatch.setenv("CC", cc)
        native.compiler.cache_clear()
        files = {path.name: path.read_text() for path in (MANIFOLDS.parent / "generated" / name).glob("*.[ch]")}
        library = native.compiled(files, f"{name}_splats.c", native.FAST)
        work = native.scratch(library, name, len(x), len(mu), 1, np.float64)
        value, gradient = np.empty(len(x)), np.empty((len(x), m.tangent_size))
        function = getattr(library, f"{name}_splats")
        pointers = map(native.pointer, (*inputs, None, value, gradient, work))
        function(ctypes.c_size_t(len(x)), ctypes.c_size_t(len(mu)), *pointers, ctypes.c_int(1))
        found.append((value, gradient))
    native.compiler.cache_clear()
    for ours, theirs in zip(*found, strict=True):
        np.testing.assert_allclose(ours, theirs, rtol=1e-12, atol=1e-12)
