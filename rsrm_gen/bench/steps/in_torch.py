"""Steps in torch: eager double backward, closed formulas with one backward pass, and those under torch.compile."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import torch
from torch import Tensor

from rsrm_gen.bench.steps import closed, plain
from rsrm_gen.bench.steps.problem import Problem

Step = Callable[[], tuple[Any, tuple[Any, ...]]]  # the loss and its gradient in v, mu and A


def eager(name: str, problem: Problem, chunk: int) -> Step:
    """Plain formulas; grad f by autograd, with a graph, and autograd through that."""

    def chunk_loss(points: tuple[Tensor, ...], mu: Tensor, W: Tensor, amplitude: Tensor) -> Tensor:
        x = points[0].requires_grad_()
        f = plain.field(torch, name, x, mu, W, amplitude)
        (df,) = torch.autograd.grad(f.sum(), x, create_graph=True)
        return plain.residuals(torch, name, points, f, plain.to_gradient(torch, name, x, df)).sum()  # type: ignore[no-any-return]

    return _in_chunks(chunk_loss, problem, chunk)


def analytic(name: str, problem: Problem, chunk: int) -> Step:
    """The gradient of f in closed form."""
    return _in_chunks(_analytic_loss(name), problem, chunk)


def compiled(name: str, problem: Problem, chunk: int) -> Step:
    """The same, compiled for these shapes."""
    torch.compiler.reset()
    return _in_chunks(torch.compile(_analytic_loss(name), fullgraph=True, dynamic=False), problem, chunk)


def _analytic_loss(name: str) -> Callable[..., Tensor]:
    def chunk_loss(points: tuple[Tensor, ...], mu: Tensor, W: Tensor, amplitude: Tensor) -> Tensor:
        x = points[0]
        f, df = closed.value_and_partials(torch, name, x, mu, W, amplitude)
        return plain.residuals(torch, name, points, f, plain.to_gradient(torch, name, x, df)).sum()  # type: ignore[no-any-return]

    return chunk_loss


def _in_chunks(chunk_loss: Callable[..., Tensor], problem: Problem, chunk: int) -> Step:
    """A step that adds the chunks' losses and gradients; what depends on the splats alone is done once."""
    count = len(problem.x)
    parts = [tuple(t.clone() for t in part) for part in zip(*(map(_chunks(chunk), problem.points)), strict=True)]
    v, mu, A = (torch.from_numpy(a).clone().requires_grad_() for a in (problem.v, problem.mu, problem.A))
    E = torch.from_numpy(problem.flat_frame)

    def step() -> tuple[Tensor, tuple[Tensor, ...]]:
        W, amplitude = plain.splats(torch, v, A, E)
        leaves = mu, W.detach().requires_grad_(), amplitude.detach().requires_grad_()
        loss, sums = torch.zeros((), dtype=v.dtype), tuple(torch.zeros_like(leaf) for leaf in leaves)
        for points in parts:
            part = chunk_loss(points, *leaves) / count
            for total, bar in zip(sums, torch.autograd.grad(part, leaves), strict=True):
                total += bar
            loss += part.detach()
        v_bar, A_bar = torch.autograd.grad((W, amplitude), (v, A), sums[1:])
        return loss, (v_bar, sums[0], A_bar)

    return step


def _chunks(chunk: int) -> Callable[[Any], tuple[Tensor, ...]]:
    return lambda array: torch.split(torch.from_numpy(array), chunk)
