"""The Eikonal loss, and its gradients against double differentiation of the formulas by torch."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from typing import Literal

import pytest
import torch
from plain_manifolds import PLAIN
from scenes import random_field, seeded, small_scene
from torch import Tensor

from rsrm_gen.files import bundled
from rsrm_gen.load import load
from rsrm_gen.manifold import Manifold
from rsrm_gen.trainer.link import Exponential, Link, Quotient
from rsrm_gen.trainer.model import ArrivalTime, SplatField
from rsrm_gen.trainer.objectives.residual import Residual
from rsrm_gen.trainer.run import new_arrival
from rsrm_gen.trainer.scene import Scene, read_scene


def plain_slope(scene: Scene, link: str, x: Tensor, v: Tensor, mu: Tensor, E: Tensor, A: Tensor) -> Tensor:
    """|grad T| from the model's formula, by autograd in x. E may be the frame where mu came from: moved a little, the
    frame differs from it by a normal part, which the inner product with a tangent vector does not see."""
    M = scene.manifold
    x = x.clone().requires_grad_()
    log = M.log(mu[None], x[:, None])
    components = M.inner(mu[None, :, None], E[None], log[:, :, None])
    z = torch.linalg.solve(A[None], components[..., None])[..., 0]
    density = torch.exp(-(z**2).sum(-1) / 2 + M.log_abs_det(mu[None], x[:, None]))
    f = (v * density / torch.linalg.det(A).abs()).sum(1) / (2 * math.pi) ** (M.dim / 2)
    d = M.distance(x, scene.goal.expand_as(x))
    t = d * torch.exp(f) if link == "exponential" else d / (0.25 + 0.75 * torch.sigmoid(f + 1))
    (dt,) = torch.autograd.grad(t.sum(), x, create_graph=True)
    return M.gradient_norm(x, dt)


def plain_loss(slope: Tensor, slowness: Tensor, residual: str) -> Tensor:
    if residual == "squared":
        return ((slope - slowness) ** 2).mean()
    root = torch.sqrt(slope / slowness)
    return ((1 - root).abs() + (1 - 1 / root).abs()).mean()


LINKS: dict[str, Link] = {"exponential": Exponential(), "quotient": Quotient(1.0, 0.25)}


@pytest.mark.parametrize("residual", ["ratio", "squared"])
@pytest.mark.parametrize("link", LINKS)
@pytest.mark.parametrize("name", PLAIN)
def test_the_closed_forms_are_the_gradients_of_double_differentiation(
    tmp_path: Path, name: str, link: str, residual: Literal["ratio", "squared"]
) -> None:
    scene = small_scene(tmp_path, name)
    field = random_field(scene.manifold, scene.sample(6, seeded()), seeded(1))
    arrival = ArrivalTime(field, LINKS[link], scene.manifold, scene.goal)
    x = scene.sample(30, seeded(2))
    eikonal = Residual(scene, residual)
    loss, columns = eikonal.loss_and_gradient(arrival, eikonal.at(arrival, x))
    assert loss == eikonal.loss(arrival, x)[0]

    truth, gradients = doubly_differentiated(scene, field, link, residual, x)
    assert loss == pytest.approx(float(truth), rel=1e-12)
    ours = named(scene.manifold, columns)
    for key, gradient in gradients.items():
        assert float((ours[key] - gradient).norm() / gradient.norm()) < 1e-10, key


def named(manifold: Manifold, columns: Tensor) -> dict[str, Tensor]:
    """The parts of `SplatField.gradient`."""
    d = manifold.dim
    v, A, mu = columns.split((1, d * d, d))
    return {"v": v[0], "mu": mu.T, "A": A.T.unflatten(1, (d, d))}


GENERATED = {
    "R2": ("euclidean", {"n": 2}),
    "T2": ("torus", {}),
    "S2": ("sphere", {}),
    "H2": ("hyperbolic", {}),
    "SO3": ("so3", {}),
}


@pytest.mark.parametrize("name", GENERATED)
def test_generated_code_gives_the_gradients_of_double_differentiation_by_hand(tmp_path: Path, name: str) -> None:
    plain = small_scene(tmp_path, name)
    bundled, parameters = GENERATED[name]
    scene = replace(plain, manifold=load(bundled, **parameters))
    field = random_field(scene.manifold, plain.sample(6, seeded()), seeded(1))
    arrival = ArrivalTime(field, Exponential(), scene.manifold, scene.goal)
    x = plain.sample(30, seeded(2))
    eikonal = Residual(scene, "ratio")
    loss, columns = eikonal.loss_and_gradient(arrival, eikonal.at(arrival, x))

    truth, gradients = doubly_differentiated(plain, field, "exponential", "ratio", x)
    assert loss == pytest.approx(float(truth), rel=1e-11)
    ours = named(scene.manifold, columns)
    for key, gradient in gradients.items():
        assert float((ours[key] - gradient).norm() / gradient.norm()) < 1e-9, key


@pytest.mark.parametrize("name", ["torus", "rotations", "arm"])
def test_the_residual_is_that_of_the_arrival_times_own_slope(name: str) -> None:
    """By differences, on smooth bases and on a retraction, along which -Log / d is not the gradient of d."""
    scene = read_scene(bundled("examples") / f"{name}.yaml").in_double()
    M, h = scene.manifold, 1e-5
    x = scene.sample(40, seeded(2))
    arrival = new_arrival(scene, 6)
    arrival.field = random_field(M, x[:6], seeded(1))
    steps = h * M.frame(x[6:])
    ahead, behind = (arrival.time(M.exp(x[6:, None], s * steps).flatten(0, 1)).view(-1, M.dim) for s in (1, -1))
    slope = (ahead - behind).norm(dim=1) / (2 * h)
    _, residuals = Residual(scene, "squared").loss(arrival, x[6:])
    torch.testing.assert_close(residuals, (slope - scene.slowness(x[6:])) ** 2, rtol=1e-5, atol=1e-5)


def doubly_differentiated(
    scene: Scene, field: SplatField, link: str, residual: str, x: Tensor
) -> tuple[Tensor, dict[str, Tensor]]:
    """The loss and its gradients in v, in the centres (components of a move by Exp in their frames) and in A."""
    K, M = field.count, scene.manifold
    v = field.v.detach()[:K].clone().requires_grad_()
    A = field.A.detach()[:K].clone().requires_grad_()
    move = torch.zeros(K, M.dim, dtype=torch.float64, requires_grad=True)
    E = field.frame[:K]
    mu = M.exp(field.mu.detach()[:K], (move[:, None] @ E)[:, 0])
    loss = plain_loss(plain_slope(scene, link, x, v, mu, E, A), scene.slowness(x), residual)
    return loss.detach(), dict(zip(("v", "mu", "A"), torch.autograd.grad(loss, (v, move, A)), strict=True))


@pytest.mark.parametrize("residual", ["ratio", "squared"])
def test_the_distance_itself_has_no_residual_in_free_space(
    tmp_path: Path, residual: Literal["ratio", "squared"]
) -> None:
    scene = small_scene(tmp_path, "H2", obstacles=False)
    manifold: Manifold = scene.manifold
    field = random_field(manifold, scene.sample(3, seeded()), seeded(1))
    with torch.no_grad():
        field.v.zero_()
    arrival = ArrivalTime(field, Exponential(), manifold, scene.goal)
    loss, residuals = Residual(scene, residual).loss(arrival, scene.sample(50, seeded(2)))
    assert loss < 1e-9
    assert residuals.shape == (50,)


def test_a_slope_twice_or_half_the_slowness_is_equally_wrong_by_the_ratio(tmp_path: Path) -> None:
    scene = small_scene(tmp_path, "R2", obstacles=False)
    field = random_field(scene.manifold, scene.sample(1, seeded()), seeded(1))
    with torch.no_grad():
        field.v.zero_()
    x = scene.sample(10, seeded(2))

    class Scaled(Exponential):
        def partials(self, d: Tensor, f: Tensor) -> tuple[Tensor, Tensor]:
            return factor + 0 * f, 0 * d

    for factor in (2.0, 0.5):
        arrival = ArrivalTime(field, Scaled(), scene.manifold, scene.goal)
        ratio, _ = Residual(scene, "ratio").loss(arrival, x)
        squared, _ = Residual(scene, "squared").loss(arrival, x)
        assert float(ratio) == pytest.approx(math.sqrt(2) - 1 / math.sqrt(2))
        assert float(squared) == pytest.approx((factor - 1) ** 2)
