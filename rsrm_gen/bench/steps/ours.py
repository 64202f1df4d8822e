"""The step as `rsrm train` takes it: `SplatField` over the generated kernel, and the sum of splats alone."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import torch

from rsrm_gen.bench.steps.problem import Problem
from rsrm_gen.manifold import Manifold
from rsrm_gen.trainer.link import Exponential
from rsrm_gen.trainer.model import SplatField

Step = Callable[[], tuple[Any, tuple[Any, ...]]]


def whole(manifold: Manifold, problem: Problem) -> Step:
    """The loss and its gradient by the trainer's own model."""
    field, link = _field(manifold, problem), Exponential()
    x, d, away, slowness = map(torch.from_numpy, problem.points)

    def step() -> tuple[Any, tuple[Any, ...]]:
        f, df = field.value_and_gradient(x)
        by_d, by_f = link.partials(d, f)
        slope = manifold.norm(x, by_d[:, None] * away + by_f[:, None] * df)
        loss = ((slope - slowness) ** 2).mean()
        return loss.detach(), torch.autograd.grad(loss, (field.v, field.mu, field.A))

    return step


def kernel(manifold: Manifold, problem: Problem) -> Step:
    """The sum of splats, forward and backward, without what is done once a point or a splat."""
    x, v, mu, A, E = map(torch.from_numpy, (problem.x, problem.v, problem.mu, problem.A, problem.flat_frame))
    inverse = torch.linalg.inv(A)
    leaves = mu.clone(), inverse @ E, v * torch.linalg.det(inverse).abs()
    for leaf in leaves:
        leaf.requires_grad_()
    value_bar, gradient_bar = torch.ones_like(x[:, 0]), torch.from_numpy(problem.away)

    def step() -> tuple[Any, tuple[Any, ...]]:
        results = manifold.splats(x, *leaves)
        return results[0].detach().sum(), torch.autograd.grad(results, leaves, (value_bar, gradient_bar))

    return step


def _field(manifold: Manifold, problem: Problem) -> SplatField:
    field = SplatField(manifold, len(problem.v), torch.from_numpy(problem.v).dtype)
    with torch.no_grad():
        for name in ("v", "mu", "A", "frame"):
            getattr(field, name).copy_(torch.from_numpy(getattr(problem, name)))
    field.count = len(problem.v)
    return field
