"""Gauss-Newton on splats: its Jacobian on every kind of manifold, what it finds, what it never does, going on exactly."""

from __future__ import annotations

from pathlib import Path

import pytest
import torch
from scenes import random_field, seeded
from torch import Tensor

import rsrm_gen
from rsrm_gen.manifold import Manifold
from rsrm_gen.trainer import gauss_newton
from rsrm_gen.trainer.base import smooth_base
from rsrm_gen.trainer.fit import Fit, Schedule, Targets
from rsrm_gen.trainer.gauss_newton import (
    WHOLE,
    NormalEquations,
    amplitudes_alone,
    apply,
    curvature,
    effective_count,
    effective_map,
    gradient,
    sample,
)
from rsrm_gen.trainer.link import Exponential, Quotient
from rsrm_gen.trainer.model import ArrivalTime, SplatField
from rsrm_gen.trainer.response import Affine, Arrival

# Ambient vectors, components in a frame, a metric that varies, products, a retraction.
MANIFOLDS = ["sphere", "hyperbolic", "torus", "so3", "so3_matrix", "poincare", "se2", "se3", "spd", "arm2", "so2"]
UNBOUNDED = (0.0, float("inf"))


def points(manifold: Manifold, count: int, seed: int = 0) -> Tensor:
    """In a ball where nothing is far, whatever the manifold."""
    center = torch.full((manifold.point_size,), 0.1, dtype=torch.float64)
    center[0] = center[-1] = 1  # a matrix like this is positive and has a rotation near it
    center = manifold.project(center)
    return manifold.sample_ball(center, min(0.5, manifold.injectivity_radius / 2), count, seeded(seed))


def field_of(manifold: Manifold, count: int, seed: int = 0) -> SplatField:
    return random_field(manifold, points(manifold, count, seed + 1), seeded(seed))


def copy_of(field: SplatField) -> SplatField:
    copy = SplatField(field.manifold, field.capacity, field.mu.dtype)
    copy.count = field.count
    for name, rows in copy.buffers_of_splats().items():
        rows.copy_(field.buffers_of_splats()[name])
    return copy


def values(field: SplatField, x: Tensor) -> Tensor:
    return field.manifold.splats_value(x, *field.splats().inputs())


def jacobian(field: SplatField, x: Tensor, to_parameters: Tensor | None = None) -> Tensor:
    """df / d(parameters), the effective ones if none are given: (N, K, Q)."""
    splats = field.splats()
    nothing = x.new_zeros(len(x), field.manifold.tangent_size)
    rows = field.manifold.splats_rows(x, *splats.inputs(), x.new_ones(len(x)), nothing)
    return torch.einsum("nkr,krq->nkq", rows, effective_map(field, splats) if to_parameters is None else to_parameters)


@pytest.mark.parametrize("name", MANIFOLDS)
def test_the_jacobian_is_that_of_the_steps_made(name: str) -> None:
    manifold = rsrm_gen.load(name)
    field, x = field_of(manifold, 3), points(manifold, 7)
    found = jacobian(field, x)
    h = 1e-5
    for k in range(field.count):
        for q in range(effective_count(manifold.dim)):
            step = torch.zeros(field.count, effective_count(manifold.dim), dtype=torch.float64)
            ends = []
            for sign in (h, -h):
                step[k, q] = sign
                moved = copy_of(field)
                apply(moved, step, UNBOUNDED)
                ends.append(values(moved, x))
            torch.testing.assert_close(found[:, k, q], (ends[0] - ends[1]) / (2 * h), rtol=2e-6, atol=2e-8)


@pytest.mark.parametrize("name", ["sphere", "poincare", "se2"])
def test_sums_over_blocks_are_those_over_all_points(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    manifold = rsrm_gen.load(name)
    field, x = field_of(manifold, 20), points(manifold, 300)
    J = jacobian(field, x).flatten(1)
    residual = torch.randn(300, generator=seeded(), dtype=torch.float64)
    monkeypatch.setattr(gauss_newton, "BLOCK", 37)
    monkeypatch.setattr(gauss_newton, "CHUNK", 41)
    at = sample(field, x)
    assert len(at.parts) > 4
    ones, mapped = torch.ones_like(residual), effective_map(field, field.splats())
    matrix = curvature(field, at, ones, mapped, torch.float64, reach=9.0)
    torch.testing.assert_close(matrix, J.T @ J, rtol=1e-9, atol=1e-12)
    right = gradient(field, x, ones, residual, mapped)
    torch.testing.assert_close(right, J.T @ residual, rtol=1e-9, atol=1e-12)
    step = NormalEquations.of(matrix, right).step(0.1)
    assert step is not None
    damped = matrix + 0.1 * torch.diag(matrix.diagonal())
    torch.testing.assert_close(damped @ step, -right, rtol=1e-8, atol=1e-10)


@pytest.mark.parametrize("name", ["sphere", "torus", "so3", "hyperbolic"])
def test_curvature_leaves_out_only_what_is_small(name: str) -> None:
    manifold = rsrm_gen.load(name)
    field, x = field_of(manifold, 60), points(manifold, 2000)
    noise = torch.randn(60, manifold.dim, manifold.dim, generator=seeded(4), dtype=torch.float64)
    field.A[:60] = 0.06 * (torch.eye(manifold.dim) + 0.1 * noise)
    at, ones = sample(field, x), torch.ones(2000, dtype=torch.float64)
    mapped = effective_map(field, field.splats())
    J = jacobian(field, x).flatten(1)
    length = (J.T @ J).diagonal().sqrt()
    found = curvature(field, at, ones, mapped, torch.float64)
    assert int((found == 0).sum()) > len(length)  # some splats share no block
    assert float(((found - J.T @ J) / length / length[:, None]).abs().max()) < 2e-3


@pytest.mark.parametrize("name", ["torus", "sphere", "hyperbolic"])
def test_needles_are_not_left_out_where_nothing_may_be_missing(name: str) -> None:
    manifold = rsrm_gen.load(name)
    field, x = field_of(manifold, 60), points(manifold, 3000)
    turn = torch.linalg.qr(torch.randn(60, 2, 2, generator=seeded(4), dtype=torch.float64))[0]
    field.A[:60] = turn * torch.tensor([0.2, 0.004], dtype=torch.float64)
    at, ones = sample(field, x), torch.ones(3000, dtype=torch.float64)
    alone = amplitudes_alone(field)
    J = jacobian(field, x, alone).flatten(1)
    found = curvature(field, at, ones, alone, torch.float64, WHOLE)
    torch.testing.assert_close(found, J.T @ J, rtol=0, atol=1e-8 * float((J.T @ J).amax()))


@pytest.mark.parametrize("name", ["torus", "sphere", "so3", "hyperbolic", "poincare", "cylinder"])
def test_a_field_made_of_splats_is_found_again(name: str) -> None:
    manifold = rsrm_gen.load(name)
    truth, x = field_of(manifold, 4), points(manifold, 400)
    truth.A[:4] *= 0.4  # narrower than the ball that is seen, so that nothing else looks the same there
    field = copy_of(truth)
    Q = effective_count(manifold.dim)
    apply(field, 0.1 * torch.randn(4, Q, generator=seeded(5), dtype=torch.float64), UNBOUNDED)
    fit = Fit(field, Affine(), Targets(x, values(truth, x), torch.ones(400).double()), Schedule(40))
    assert fit.errors()[0] > 1e-3
    while not fit.done and fit.errors()[0] > 1e-9:
        fit.advance()
    assert fit.errors()[0] < 1e-8
    fresh = points(manifold, 50, seed=9)
    torch.testing.assert_close(values(field, fresh), values(truth, fresh), rtol=1e-5, atol=1e-7)


def arrival_targets(name: str, count: int, seed: int) -> tuple[ArrivalTime, Targets]:
    """T = b exp(a smooth function) around a goal, with no splats yet."""
    manifold = rsrm_gen.load(name)
    x = points(manifold, count, seed).float()
    goal = points(manifold, 1, 77)[0].float()
    arrival = ArrivalTime(SplatField(manifold, 40), Exponential(), manifold, goal, smooth_base(manifold, goal))
    other = points(manifold, 1, 78)[0].float()
    smooth = torch.sin(manifold.distance(x, other.expand_as(x)) ** 2)
    return arrival, Targets(x, arrival.base.value(x) * torch.exp(smooth), torch.ones(count))


@pytest.mark.parametrize("name", ["torus", "sphere", "so3", "hyperbolic"])
def test_an_arrival_time_is_learnt_from_labels_and_the_cost_never_rises(name: str) -> None:
    arrival, targets = arrival_targets(name, 2500, 1)
    fit = Fit(arrival.field, Arrival(arrival), targets, Schedule(16, {3: 0.1}))
    fit.place(36)
    last = fit.errors()[0]
    while not fit.done:
        record = fit.advance()
        assert record.relocated or record.rms <= last
        last = record.rms
    _, fresh = arrival_targets(name, 400, 2)
    error = arrival.time(fresh.x) - fresh.value
    assert float(error.square().mean().sqrt()) < 1e-3


def test_going_on_is_as_if_nothing_had_stopped(tmp_path: Path) -> None:
    schedule = Schedule(6, {2: 0.2, 5: 0.1})
    runs = []
    for interrupted in (False, True):
        arrival, targets = arrival_targets("sphere", 600, 1)
        fit = Fit(arrival.field, Arrival(arrival), targets, schedule)
        fit.place(16)
        for _ in range(3):
            fit.advance()
        if interrupted:
            arrays = fit.arrays()
            arrival, targets = arrival_targets("sphere", 600, 1)
            fit = Fit(arrival.field, Arrival(arrival), targets, schedule)
            fit.restore(arrays, tmp_path)
        while not fit.done:
            fit.advance()
        runs.append(fit.arrays())
    for name, array in runs[0].items():
        assert (array == runs[1][name]).all(), name


def test_a_second_phase_keeps_the_splats_and_counts_on() -> None:
    arrival, targets = arrival_targets("torus", 500, 1)
    fit = Fit(arrival.field, Arrival(arrival), targets, Schedule(3))
    fit.place(12)
    while not fit.done:
        fit.advance()
    splats = arrival.field.mu.clone()
    fit.aim(arrival_targets("torus", 900, 3)[1], Schedule(2))
    assert torch.equal(splats, arrival.field.mu)
    assert not fit.done
    assert [fit.advance().iteration for _ in range(2)] == [4, 5]
    assert fit.done


def test_a_step_that_helps_nothing_leaves_the_splats_alone() -> None:
    arrival, targets = arrival_targets("sphere", 300, 1)
    targets.value[7] = torch.nan
    fit = Fit(arrival.field, Arrival(arrival), targets, Schedule(3))
    arrival.field.append(targets.x[:9], 0.3)
    before = arrival.field.mu.clone()
    assert not fit.advance().accepted
    assert torch.equal(before, arrival.field.mu)


def test_splats_that_moved_for_the_worse_are_taken_back(monkeypatch: pytest.MonkeyPatch) -> None:
    arrival, targets = arrival_targets("sphere", 600, 1)
    fit = Fit(arrival.field, Arrival(arrival), targets, Schedule(5, {1: 0.2, 2: 0.2}))
    fit.place(12)
    assert fit.advance().relocated == 2
    solve = fit.solve_amplitudes

    def too_high() -> None:
        solve()
        fit.field.v[:12] += 1e3

    monkeypatch.setattr(fit, "solve_amplitudes", too_high)
    before = fit.errors()[0]
    assert fit.advance().relocated == 0
    assert fit.errors()[0] <= before


def test_more_targets_are_wanted_where_residuals_are_large() -> None:
    arrival, targets = arrival_targets("sphere", 600, 1)
    fit = Fit(arrival.field, Arrival(arrival), targets, Schedule(5))
    fit.place(12)
    worst = fit.worst(3)
    error = (arrival.time(targets.x) - targets.value).abs()
    assert torch.equal(worst[0], targets.x[int(error.argmax())])
    distance = fit.field.manifold.distance(worst[:, None], worst[None])
    assert float((distance + torch.eye(3)).min()) > 0.05


def test_targets_that_say_nothing_give_a_field_of_zero() -> None:
    arrival, targets = arrival_targets("torus", 100, 1)
    nowhere = Targets(arrival.goal.expand(100, -1).contiguous(), torch.zeros(100), torch.ones(100))
    fit = Fit(arrival.field, Arrival(arrival), nowhere, Schedule(2))
    arrival.field.append(targets.x[:5], 0.3)
    fit.solve_amplitudes()
    assert not arrival.field.v.any()


def test_shapes_stay_within_their_bounds() -> None:
    arrival, targets = arrival_targets("sphere", 600, 1)
    fit = Fit(arrival.field, Arrival(arrival), targets, Schedule(5, {2: 0.2}, (0.2, 0.3)))
    fit.place(12)
    while not fit.done:
        fit.advance()
    values = torch.linalg.svdvals(arrival.field.A[: arrival.field.count])
    assert float(values.min()) > 0.2 - 1e-6
    assert float(values.max()) < 0.3 + 1e-6


@pytest.mark.parametrize("link", [Exponential(), Quotient(), Quotient(2.0, 0.25)])
def test_a_link_gives_the_field_back(link: Exponential | Quotient) -> None:
    d = torch.linspace(0.1, 3, 50, dtype=torch.float64)
    f = torch.linspace(-3, 3, 50, dtype=torch.float64)
    torch.testing.assert_close(link.field(d, link.value(d, f)), f)
