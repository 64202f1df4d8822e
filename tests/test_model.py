"""The splat field and the arrival time made of it."""

from __future__ import annotations

from pathlib import Path

import pytest
import torch
from plain_manifolds import PLAIN, Euclidean
from scenes import random_field, seeded, small_scene

from rsrm_gen.trainer.link import Exponential
from rsrm_gen.trainer.model import ArrivalTime, SplatField

ALL = list(PLAIN)


def arrival_in(folder: Path, name: str) -> ArrivalTime:
    scene = small_scene(folder, name)
    field = random_field(scene.manifold, scene.sample(6, seeded()), seeded(1))
    return ArrivalTime(field, Exponential(), scene.manifold, scene.goal)


def test_one_splat_in_flat_space_is_a_gaussian_density() -> None:
    field = SplatField(Euclidean(2), 3, torch.float64)
    field.append(torch.tensor([[0.5, -0.5]], dtype=torch.float64), 0.5)
    A = torch.tensor([[0.5, 0.2], [0.0, 0.3]], dtype=torch.float64)
    with torch.no_grad():
        field.v[0] = 2.0
        field.A[0] = A
    x = torch.tensor([[0.9, 0.1], [0.5, -0.5]], dtype=torch.float64)
    truth = torch.distributions.MultivariateNormal(field.mu[0].detach(), A @ A.T)
    assert torch.allclose(field.value_and_gradient(x)[0], 2 * truth.log_prob(x).exp(), rtol=1e-12)


@pytest.mark.parametrize("name", ALL)
def test_the_gradient_of_T_is_its_slope_along_every_geodesic(tmp_path: Path, name: str) -> None:
    arrival = arrival_in(tmp_path, name)
    M, h = arrival.manifold, 1e-4
    x = small_scene(tmp_path, name).sample(20, seeded(2))
    u = (torch.randn(20, 1, M.dim, generator=seeded(3), dtype=torch.float64) @ M.frame(x))[:, 0]
    slope = (arrival.time(M.exp(x, h * u)) - arrival.time(M.exp(x, -h * u))) / (2 * h)
    assert torch.allclose(M.inner(x, arrival.time_and_gradient(x)[1], u), slope, atol=1e-6)


@pytest.mark.parametrize("name", ALL)
def test_T_is_zero_and_its_gradient_finite_at_the_goal(tmp_path: Path, name: str) -> None:
    arrival = arrival_in(tmp_path, name)
    t, gradient = arrival.evaluate(arrival.goal[None])
    assert abs(float(t)) < 1e-12
    assert torch.isfinite(gradient).all()


@pytest.mark.parametrize("name", ALL)
def test_chunks_change_nothing(tmp_path: Path, name: str) -> None:
    arrival = arrival_in(tmp_path, name)
    x = small_scene(tmp_path, name).sample(17, seeded(2))
    whole, chunked = arrival.evaluate(x), arrival.evaluate(x, chunk=5)
    assert torch.allclose(whole[0], chunked[0], rtol=1e-13)
    assert torch.allclose(whole[1], chunked[1], rtol=1e-12, atol=1e-14)
    assert not whole[0].requires_grad
    assert [len(part) for part in arrival.evaluate(x[:0])] == [0, 0]


@pytest.mark.parametrize("name", ALL)
def test_centres_move_along_geodesics_and_carry_an_orthonormal_frame(tmp_path: Path, name: str) -> None:
    scene = small_scene(tmp_path, name)
    M = scene.manifold
    field = random_field(M, scene.sample(6, seeded()), seeded(1))
    before = field.mu[:6].detach().clone()
    steps = 0.2 * torch.randn(6, M.dim, generator=seeded(2), dtype=torch.float64)
    field.move_centers(steps.T)
    mu, E = field.mu[:6].detach(), field.frame[:6]
    assert torch.allclose(M.project(mu), mu, atol=1e-14)
    assert torch.allclose(M.distance(before, mu), steps.norm(dim=-1), atol=1e-12)
    gram = M.inner(mu[:, None, None], E[:, :, None], E[:, None])
    assert torch.allclose(gram, torch.eye(M.dim, dtype=torch.float64).expand_as(gram), atol=1e-13)


@pytest.mark.parametrize("name", ALL)
def test_small_moves_carry_the_frame_like_parallel_transport(tmp_path: Path, name: str) -> None:
    """Along its own geodesic a tangent vector is transported to the geodesic's velocity, known by Exp and Log."""
    scene = small_scene(tmp_path, name)
    M = scene.manifold
    field = random_field(M, scene.sample(6, seeded()), seeded(1))
    before, steps = field.mu[:6].detach().clone(), torch.zeros(6, M.dim, dtype=torch.float64)
    steps[:, 0] = 1e-3
    field.move_centers(steps.T)
    backwards = -M.log(field.mu[:6].detach(), before) / 1e-3
    assert torch.allclose(field.frame[:6, 0], backwards, atol=1e-8)


@pytest.mark.parametrize("name", ALL)
def test_an_orthonormal_frame_stays_as_it_is(tmp_path: Path, name: str) -> None:
    mu = small_scene(tmp_path, name).sample(5, seeded())
    E = PLAIN[name].frame(mu)
    field = SplatField(PLAIN[name], 5, torch.float64)
    assert torch.allclose(field.orthonormal(mu, E), E, atol=1e-12)


def test_no_singular_value_falls_below_the_bound_and_none_above_it_moves() -> None:
    field = SplatField(Euclidean(2), 4, torch.float64)
    field.append(torch.zeros(4, 2, dtype=torch.float64), 0.3)
    shapes = torch.stack(
        [torch.diag(torch.tensor(pair)) for pair in ((0.3, 0.01), (0.0, 0.0), (0.2, 0.08), (5.0, 0.05))]
    )
    with torch.no_grad():
        field.A.copy_(shapes)
    field.clamp_shapes(0.07)
    singular = torch.linalg.svdvals(field.A.detach())
    expected = torch.tensor([[0.3, 0.07], [0.07, 0.07], [0.2, 0.08], [5.0, 0.07]], dtype=torch.float64)
    assert torch.allclose(singular, expected, atol=1e-7)
    assert torch.equal(field.A.detach()[2], shapes[2].double())


@pytest.mark.parametrize("d", [1, 2, 3])
def test_what_is_clamped_keeps_its_singular_vectors(d: int) -> None:
    field = SplatField(Euclidean(d), 60, torch.float64)
    field.append(torch.zeros(60, d, dtype=torch.float64), 0.3)
    field.A.copy_(0.2 * torch.randn(60, d, d, generator=seeded(), dtype=torch.float64))
    U, S, Vh = torch.linalg.svd(field.A)
    assert S.min() < 0.07 < S.max()
    field.clamp_shapes(0.07)
    assert torch.allclose(field.A, (U * S.clamp_min(0.07)[:, None]) @ Vh, atol=1e-13)


def test_new_splats_do_not_change_the_field_and_stop_at_the_capacity(tmp_path: Path) -> None:
    scene = small_scene(tmp_path, "S2")
    field = random_field(scene.manifold, scene.sample(6, seeded()), seeded(1))
    x = scene.sample(9, seeded(2))
    before = field.value_and_gradient(x)[0]
    assert field.append(scene.sample(5, seeded(3)), 0.4) == 2
    assert field.count == field.capacity == 8
    assert torch.allclose(field.value_and_gradient(x)[0], before, rtol=1e-14)
    assert field.parameter_count == 8 * (1 + 3 + 4)


def test_kept_splats_are_the_first_rows_in_their_order(tmp_path: Path) -> None:
    scene = small_scene(tmp_path, "SO3")
    field = random_field(scene.manifold, scene.sample(6, seeded()), seeded(1))
    before = {name: rows.clone() for name, rows in field.buffers_of_splats().items()}
    field.keep(torch.tensor([0, 3, 4]))
    assert field.count == 3
    for name, rows in field.buffers_of_splats().items():
        assert torch.equal(rows[:3], before[name][[0, 3, 4]])


def test_the_centres_gradient_does_not_depend_on_how_formulas_extend_off_the_manifold(tmp_path: Path) -> None:
    scene = small_scene(tmp_path, "S2")
    field = random_field(scene.manifold, scene.sample(6, seeded()), seeded(1))
    splats = field.splats()
    bars = [torch.randn(t.shape, generator=seeded(2), dtype=t.dtype) for t in splats.inputs()]
    before = field.gradient(splats, *bars)
    bars[0] += 7 * splats.mu  # the part along the normal
    assert torch.allclose(field.gradient(splats, *bars), before, atol=1e-13)
    assert float(before[-2:].norm()) > 0.1
