"""The derivatives of a field in its splats, written out, against autograd through every step from mu, A and v."""

from __future__ import annotations

import math

import pytest
import torch
from scenes import random_field, seeded
from torch import Tensor

from rsrm_gen.load import load_in_rows
from rsrm_gen.manifold import Manifold

MANIFOLDS = {
    "sphere": [0.0, 0.6, 0.8],
    "so3": [0.8, 0.0, 0.6, 0.0],
    "hyperbolic": [1.25, 0.75, 0.0],
    "torus": [0.5, -1.0],
    "se3": [0.3, -0.2, 0.1, 0.8, 0.0, 0.6, 0.0],
    "poincare": [0.3, -0.4],
    "half_space": [0.3, 0.8],
    "arm2": [0.4, 0.9],
}


def gram_schmidt(M: Manifold, mu: Tensor, E: Tensor) -> Tensor:
    """As a step does it: the frame E where mu came from, made orthonormal at mu."""
    if M.tangent_size == M.point_size:
        E = M.to_tangent(mu[:, None], E)
    rows: list[Tensor] = []
    for e in E.unbind(1):
        for row in rows:
            e = e - M.inner(mu, row, e)[:, None] * row
        rows.append(e / M.norm(mu, e)[:, None])
    return torch.stack(rows, 1)


@pytest.mark.parametrize("name", MANIFOLDS)
def test_written_out_derivatives_are_those_of_autograd(name: str) -> None:
    M = load_in_rows(name)
    center = torch.tensor(MANIFOLDS[name], dtype=torch.float64)
    field = random_field(M, M.sample_ball(center, 0.7, 6, seeded()), seeded(1))
    x = M.sample_ball(center, 0.7, 20, seeded(2))
    f_bar = torch.randn(20, generator=seeded(3), dtype=torch.float64)
    df_bar = torch.randn(20, M.tangent_size, generator=seeded(4), dtype=torch.float64)

    splats = field.splats()
    inputs = [t.requires_grad_() for t in splats.inputs()]
    bars = torch.autograd.grad(M.splats(x, *inputs), inputs, (f_bar, df_bar))
    ours = field.gradient(splats, *[bar.detach() for bar in bars])

    v, mu, A = (rows[:6].clone().requires_grad_() for rows in (field.v.detach(), field.mu.detach(), field.A))
    W = torch.linalg.inv(A) @ M.flat(mu[:, None], gram_schmidt(M, mu, field.frame[:6]))
    amplitude = v * (2 * math.pi) ** (-M.dim / 2) / torch.linalg.det(A).abs()
    f, df = M.splats(x, mu, W, amplitude)
    by_v, by_mu, by_A = torch.autograd.grad((f, df), (v, mu, A), (f_bar, df_bar))
    gradient = M.riemannian_gradient(mu.detach(), by_mu)
    by_center = M.inner(mu.detach()[:, None], field.frame[:6], gradient[:, None])
    truth = torch.cat((by_v[None], by_A.flatten(1).T, by_center.T))
    assert float((ours - truth).abs().max()) < 1e-10 * float(truth.abs().max())
