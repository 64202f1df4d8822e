"""The step as `rsrm train` takes it: `SplatField` over the generated kernel, and the sum of splats alone."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, cast

import torch

from rsrm_gen.bench.steps.problem import Problem
from rsrm_gen.manifold import Manifold
from rsrm_gen.trainer.arithmetic import Points
from rsrm_gen.trainer.link import Exponential
from rsrm_gen.trainer.model import ArrivalTime, SplatField
from rsrm_gen.trainer.objectives.residual import Residual
from rsrm_gen.trainer.scene import Scene

Step = Callable[[], tuple[Any, tuple[Any, ...]]]


class _AtCenters:
    """The derivatives in the centres, which the trainer has as components in their frames; as an array, partial ones."""

    def __init__(self, field: SplatField, components: torch.Tensor) -> None:
        self.field = field
        self.components = components  # (d, K)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Any:
        """Partial derivatives (K, D) whose Riemannian gradient this is."""
        mu, E = self.field.mu.double(), self.field.frame.double()
        gradient = (self.components.T.double()[:, None] @ E)[:, 0]
        unit = torch.eye(mu.shape[1], dtype=torch.float64)[:, None].expand(-1, *mu.shape)
        matrix = self.field.manifold.riemannian_gradient(mu, unit).permute(1, 2, 0)  # (K, T, D): what partials become
        return (torch.linalg.pinv(matrix) @ gradient[..., None])[..., 0].numpy()


def whole(manifold: Manifold, problem: Problem) -> Step:
    """The loss and its gradient by the trainer's own model and residual."""
    field, d = _field(manifold, problem), manifold.dim
    arrival = ArrivalTime(field, Exponential(), manifold, field.mu[0])
    # The points know all that the residual asks of the scene.
    residual = Residual(cast(Scene, None), "squared")
    points = Points(*map(torch.from_numpy, problem.points))

    def step() -> tuple[Any, tuple[Any, ...]]:
        loss, gradient = residual.loss_and_gradient(arrival, points)
        A = gradient[1 : 1 + d * d].view(d, d, -1).movedim(-1, 0)
        return loss, (gradient[0], _AtCenters(field, gradient[1 + d * d :]), A)

    return step


def kernel(manifold: Manifold, problem: Problem) -> Step:
    """The sum of splats, forward and backward, without what is done once a point or a splat."""
    return _kernel(manifold, problem, None)


def culled(manifold: Manifold, problem: Problem) -> Step:
    """The same told how wide the splats are, so that pairs too far apart may be left out where that pays."""
    return _kernel(manifold, problem, torch.linalg.matrix_norm(torch.from_numpy(problem.A), 2))


def _kernel(manifold: Manifold, problem: Problem, width: torch.Tensor | None) -> Step:
    x, v, mu, A, E = map(torch.from_numpy, (problem.x, problem.v, problem.mu, problem.A, problem.flat_frame))
    inverse = torch.linalg.inv(A)
    leaves = mu.clone(), inverse @ E, v * torch.linalg.det(inverse).abs()
    for leaf in leaves:
        leaf.requires_grad_()
    value_bar, gradient_bar = torch.ones_like(x[:, 0]), torch.from_numpy(problem.away)

    def step() -> tuple[Any, tuple[Any, ...]]:
        results = manifold.splats(x, *leaves, width=width)
        return results[0].detach().sum(), torch.autograd.grad(results, leaves, (value_bar, gradient_bar))

    return step


def _field(manifold: Manifold, problem: Problem) -> SplatField:
    field = SplatField(manifold, len(problem.v), torch.from_numpy(problem.v).dtype)
    with torch.no_grad():
        for name in ("v", "mu", "A", "frame"):
            getattr(field, name).copy_(torch.from_numpy(getattr(problem, name)))
    field.count = len(problem.v)
    return field
