"""The model: a sum of wrapped anisotropic Gaussians on the manifold, and the arrival time made of it (RSRM eq. 1-7).

f(x) = sum_i v_i (2 pi)^(-d/2) |det A_i^-1| exp(-|A_i^-1 E_i Log_mu_i(x)|^2 / 2) |det D Log_mu_i(x)|

N points, K active splats of a capacity C, d the manifold's dimension, D numbers a point, T numbers a tangent vector.
"""

from __future__ import annotations

import math

import torch
from torch import Tensor, nn

from rsrm_gen.manifold import Manifold
from rsrm_gen.trainer.link import Link


def orthonormal(manifold: Manifold, mu: Tensor, E: Tensor) -> Tensor:
    """Frames E (K, d, T), nearly orthonormal at mu (K, D), made orthonormal there by Gram-Schmidt: (K, d, T)."""
    if manifold.tangent_size == manifold.point_size:  # ambient vectors; components in a Lie frame are tangent anyway
        E = manifold.to_tangent(mu[:, None], E)
    rows: list[Tensor] = []
    for e in E.unbind(1):
        for row in rows:
            e = e - manifold.inner(mu, row, e)[:, None] * row
        rows.append(e / manifold.norm(mu, e)[:, None])
    return torch.stack(rows, 1)


class SplatField(nn.Module):
    """f and its gradient, from buffers of fixed capacity whose first `count` rows are the active splats.

    `v` (C), `mu` (C, D) and `A` (C, d, d) are parameters. `frame` (C, d, T) is state: an orthonormal basis at each
    centre that is carried along with it, because no manifold need have a continuous frame field.
    """

    def __init__(self, manifold: Manifold, capacity: int, dtype: torch.dtype = torch.float32) -> None:
        """Room for `capacity` splats, none of them active."""
        super().__init__()
        self.manifold = manifold
        self.capacity = capacity
        self.count = 0
        d, D, T = manifold.dim, manifold.point_size, manifold.tangent_size
        self.v = nn.Parameter(torch.zeros(capacity, dtype=dtype))
        self.mu = nn.Parameter(torch.zeros(capacity, D, dtype=dtype))
        self.A = nn.Parameter(torch.zeros(capacity, d, d, dtype=dtype))
        self.frame: Tensor
        self.register_buffer("frame", torch.zeros(capacity, d, T, dtype=dtype))

    @property
    def parameter_count(self) -> int:
        """Stored numbers of the active splats: K (1 + D + d^2); the frame is not one, the manifold gives it."""
        return self.count * (1 + self.manifold.point_size + self.manifold.dim**2)

    def buffers_of_splats(self) -> dict[str, Tensor]:
        """The buffers whose rows are splats, by name, without a gradient."""
        return {"v": self.v.detach(), "mu": self.mu.detach(), "A": self.A.detach(), "frame": self.frame}

    def value_and_gradient(self, x: Tensor) -> tuple[Tensor, Tensor]:
        """f (N,) and its Riemannian gradient (N, T) at x (N, D); differentiable once in v, mu and A."""
        mu, A, v = self.mu[: self.count], self.A[: self.count], self.v[: self.count]
        # The frame follows the centre by the rule that moves it after a step (`settle`): so the gradient in mu is that
        # of what a step really does, also where the metric changes with mu.
        E = orthonormal(self.manifold, mu, self.frame[: self.count])
        inverse = torch.linalg.inv(A)
        W = inverse @ self.manifold.flat(mu[:, None], E)
        amplitude = v * ((2 * math.pi) ** (-self.manifold.dim / 2) * torch.linalg.det(inverse).abs())
        return self.manifold.splats(x, mu, W, amplitude)

    @torch.no_grad()
    def append(self, mu: Tensor, shape: float) -> int:
        """Add round splats of weight 0 and A = shape * I at mu (k, D), as many as there is room for; how many."""
        mu = mu[: self.capacity - self.count]
        new = slice(self.count, self.count + len(mu))
        self.v[new] = 0  # f does not jump
        self.mu[new] = mu
        self.A[new] = shape * torch.eye(self.manifold.dim, dtype=mu.dtype)
        self.frame[new] = self.manifold.frame(mu)
        self.count += len(mu)
        return len(mu)

    @torch.no_grad()
    def keep(self, kept: Tensor) -> None:
        """Keep the splats with these indices, in that order, as the first rows."""
        for rows in self.buffers_of_splats().values():
            rows[: len(kept)] = rows[kept]
        self.count = len(kept)

    @torch.no_grad()
    def move_centers(self, steps: Tensor) -> None:
        """Move each centre by Exp along `steps` (K, d), components in its frame, and carry the frame along."""
        mu, E = self.mu[: self.count], self.frame[: self.count]
        moved = self.manifold.project(self.manifold.exp(mu, (steps[:, None] @ E)[:, 0]))
        E.copy_(orthonormal(self.manifold, moved, E))
        mu.copy_(moved)

    @torch.no_grad()
    def center_gradient(self) -> Tensor:
        """The gradient in the centres as components in their frames, (K, d), from the partial derivatives `mu.grad`.

        The Riemannian gradient is the same for every extension of the formulas off the manifold; mu.grad is not.
        """
        assert self.mu.grad is not None
        mu, E = self.mu[: self.count], self.frame[: self.count]
        gradient = self.manifold.riemannian_gradient(mu, self.mu.grad[: self.count])
        return self.manifold.inner(mu[:, None], E, gradient[:, None])

    @torch.no_grad()
    def clamp_shapes(self, min_singular: float) -> None:
        """Raise every singular value of A below the bound to it."""
        A = self.A[: self.count]
        # The smallest singular value is at least 1 / |A^-1|_F: most splats need no decomposition.
        suspect = ~(torch.linalg.matrix_norm(torch.linalg.inv_ex(A)[0]) * min_singular <= 1)
        if suspect.any():
            U, S, Vh = torch.linalg.svd(A[suspect])
            A[suspect] = (U * S.clamp_min(min_singular)[:, None]) @ Vh


class ArrivalTime:
    """T(x) = link(d(x, goal), f(x)) and its Riemannian gradient."""

    def __init__(self, field: SplatField, link: Link, manifold: Manifold, goal: Tensor) -> None:
        """The goal is a point (D,)."""
        self.field = field
        self.link = link
        self.manifold = manifold
        self.goal = goal

    def time(self, x: Tensor) -> Tensor:
        """T (N,) at x (N, D)."""
        return self.time_and_gradient(x)[0]

    def time_and_gradient(self, x: Tensor) -> tuple[Tensor, Tensor]:
        """T (N,) and grad T (N, T) as a tangent vector at x (N, D); zero at the goal itself, where T has a cone."""
        f, df = self.field.value_and_gradient(x)
        goal = self.goal.expand_as(x)
        d = self.manifold.distance(x, goal)
        # grad d = -Log_x(goal) / d
        away = -self.manifold.log(x, goal) / torch.where(d > 0, d, 1.0)[:, None]
        by_d, by_f = self.link.partials(d, f)
        return self.link.value(d, f), by_d[:, None] * away + by_f[:, None] * df

    @torch.no_grad()
    def evaluate(self, x: Tensor, chunk: int = 8192) -> tuple[Tensor, Tensor]:
        """T (N,) and grad T (N, T) at any number of points, without a graph and in chunks that fit in memory."""
        parts = [self.time_and_gradient(part) for part in torch.split(x, chunk)]
        if not parts:
            return x.new_zeros(0), x.new_zeros(0, self.manifold.tangent_size)
        return torch.cat([part[0] for part in parts]), torch.cat([part[1] for part in parts])
