"""Sums of splats on a hyperboloid far from its apex, where differences of coordinates lose their digits."""

from __future__ import annotations

import math

import mpmath as mp
import pytest
import torch
from compiled import needs_compiler, program
from torch import Tensor

from rsrm_gen import load
from rsrm_gen.compiler.lower import interpret


def on_hyperboloid(rho: float, beside: Tensor) -> Tensor:
    """Points at a distance rho from the apex, a little beside each other: (N, 3) from (N, 2)."""
    r, angle = rho + beside[:, 0], 0.7 + beside[:, 1] / math.sinh(rho)
    return torch.stack([torch.cosh(r), torch.sinh(r) * torch.cos(angle), torch.sinh(r) * torch.sin(angle)], -1)


@needs_compiler
@pytest.mark.parametrize(
    ("dtype", "rho"),
    [(torch.float64, 0.5), (torch.float64, 1), (torch.float64, 3), (torch.float64, 5), (torch.float64, 8),
     (torch.float32, 0.5), (torch.float32, 1), (torch.float32, 3), (torch.float32, 5)],
)  # fmt: skip
def test_sums_far_out_lose_what_coordinates_lose(dtype: torch.dtype, rho: float) -> None:
    """Tangent vectors and covectors are as long as exp(rho) in coordinates: their products keep eps exp(2 rho)."""
    tolerance = 4 * torch.finfo(dtype).eps * math.exp(2 * rho)
    m = load("hyperbolic")
    generator = torch.Generator().manual_seed(8)
    x = on_hyperboloid(rho, torch.randn(5, 2, generator=generator, dtype=torch.float64)).to(dtype)
    mu = on_hyperboloid(rho, torch.randn(3, 2, generator=generator, dtype=torch.float64)).to(dtype)
    W = m.flat(mu.double()[:, None], m.frame(mu.double())).to(dtype)
    amplitude = torch.ones(3, dtype=dtype)
    value, gradient = m.splats(x, mu, W, amplitude)
    routine = program("hyperbolic")["splat"]
    for n in range(len(x)):
        arguments = ([x[n].tolist(), mu[k].tolist(), W[k].flatten().tolist(), [1.0]] for k in range(3))
        exact = [interpret(routine, *a) for a in arguments]
        truth = float(mp.fsum(v[0] for v, _ in exact))
        assert abs(float(value[n]) - truth) <= tolerance * truth
        slopes = [float(mp.fsum(g[i] for _, g in exact)) for i in range(3)]
        error = torch.tensor(slopes, dtype=torch.float64) - gradient[n].double()
        assert float(error.norm()) <= 4 * tolerance * math.hypot(*slopes)
