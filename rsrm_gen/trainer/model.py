"""The model: a sum of wrapped anisotropic Gaussians on the manifold, and the arrival time made of it (RSRM eq. 1-7).

f(x) = sum_i v_i (2 pi)^(-d/2) |det A_i^-1| exp(-|A_i^-1 E_i Log_mu_i(x)|^2 / 2) |det D Log_mu_i(x)|

N points, K active splats of a capacity C, d the manifold's dimension, D numbers a point, T numbers a tangent vector.
The derivative of a number L in a tensor X is written X_bar. Nothing here leaves a graph for autograd: a training step
consists of so small operations that recording them would take longer than the sum of splats itself. `arithmetic.py`
has what does not depend on the manifold.
"""

from __future__ import annotations

from collections.abc import Callable

import torch
from torch import Tensor

from rsrm_gen.manifold import Manifold
from rsrm_gen.trainer.arithmetic import Splats, arithmetic
from rsrm_gen.trainer.base import Base, Distance, metric_varies
from rsrm_gen.trainer.link import Link

WORTH_WIDTHS = 2**18  # pairs of a point and a splat, below which leaving far ones out gains less than widths cost


def _is_identity(function: Callable[[Tensor, Tensor], Tensor], p: Tensor, size: int) -> bool:
    """Whether function(p, v), linear in v, is v itself and has no p in its formula; p (D,) requires a gradient."""
    unit = torch.eye(size, dtype=p.dtype)
    image = function(p, unit)
    return not image.requires_grad and torch.equal(image, unit)


def width(A: Tensor) -> Tensor:
    """At least the largest singular value of matrices A (d, d, K): (K,), at most d^(1/8) times it, itself where d <= 2.

    A 2 x 2 matrix is Q times a rotation plus R times a reflection, and its largest value Q + R; else this is the 8th root of
    the sum of the 8th powers of all.
    """
    if len(A) == 2:
        (a, b), (c, d) = A
        return (torch.hypot(a + d, c - b) + torch.hypot(a - d, c + b)) / 2
    scale = A.abs().amax((0, 1))
    A = A / torch.where(scale == 0, 1.0, scale)  # 8th powers of small numbers are zero
    square = torch.einsum("jik,jlk->ilk", A, A)
    fourth = torch.einsum("ijk,jlk->ilk", square, square)
    return scale * (fourth * fourth).sum((0, 1)) ** 0.125


class SplatField:
    """f and its gradient, from buffers of fixed capacity whose first `count` rows are the active splats.

    `v` (C), `mu` (C, D) and `A` (C, d, d) are trained. `frame` (C, d, T) is state: an orthonormal basis at each centre
    that is carried along with it, because no manifold need have a continuous frame field.
    """

    def __init__(self, manifold: Manifold, capacity: int, dtype: torch.dtype = torch.float32) -> None:
        """Room for `capacity` splats, none of them active."""
        self.manifold = manifold
        self.capacity = capacity
        self.count = 0
        d, D, T = manifold.dim, manifold.point_size, manifold.tangent_size
        self.arithmetic = arithmetic(d, T, dtype)
        self.numbers = torch.zeros(1 + d * d, capacity, dtype=dtype)  # v and A, which the optimiser moves at once
        self.v = self.numbers[0]
        self.A = self.numbers[1:].view(d, d, capacity).movedim(-1, 0)
        self.mu = torch.zeros(capacity, D, dtype=dtype)
        self.frame = torch.zeros(capacity, d, T, dtype=dtype)
        p = torch.zeros(D, dtype=dtype, requires_grad=True)
        self.metric_varies = metric_varies(manifold, p)
        self.covectors_are_vectors = _is_identity(manifold.flat, p, T)
        self.gradients_are_vectors = D == T and _is_identity(manifold.riemannian_gradient, p, T)
        # Vectors of d numbers have no normal part: without a metric that varies, a frame stays orthonormal as it is.
        self.frames_stay = d == T and not self.metric_varies

    @property
    def parameter_count(self) -> int:
        """Stored numbers of the active splats: K (1 + D + d^2); the frame is not one, the manifold gives it."""
        return self.count * (1 + self.manifold.point_size + self.manifold.dim**2)

    def buffers_of_splats(self) -> dict[str, Tensor]:
        """The buffers whose rows are splats, by name."""
        return {"v": self.v, "mu": self.mu, "A": self.A, "frame": self.frame}

    @torch.no_grad()
    def value_and_gradient(self, x: Tensor) -> tuple[Tensor, Tensor]:
        """f (N,) and its Riemannian gradient (N, T) at x (N, D)."""
        return self.manifold.splats(x, *self.splats().inputs(), self.widths(len(x)))

    def flat(self, p: Tensor, v: Tensor) -> Tensor:
        """The covectors (..., T) of tangent vectors v at p: `Manifold.flat`, which need not be called for v itself."""
        return v if self.covectors_are_vectors else self.manifold.flat(p, v)

    def splats(self) -> Splats:
        """The active splats as the manifold takes them."""
        mu = self.mu[: self.count]
        F = self.flat(mu[:, None], self.frame[: self.count])
        return self.arithmetic.splats(mu, F, self.numbers)

    def gradient(self, splats: Splats, mu_bar: Tensor, W_bar: Tensor, amplitude_bar: Tensor) -> Tensor:
        """The derivatives in v, A and the centre of each splat, a column each: (1 + d^2 + d, K).

        Those in the centres are components in their frames. They are of what a step really does, which moves a centre
        and makes its frame orthonormal there.
        """
        if self.metric_varies:
            mu_bar = mu_bar + self._through_the_metric(splats, W_bar)
        # The Riemannian gradient is the same for every extension of the formulas off the manifold; mu_bar is not.
        gradient = mu_bar if self.gradients_are_vectors else self.manifold.riemannian_gradient(splats.mu, mu_bar)
        return self.arithmetic.splats_adjoint(splats, gradient, W_bar, amplitude_bar)

    def _through_the_metric(self, splats: Splats, W_bar: Tensor) -> Tensor:
        """What mu_bar gains because the metric changes with mu: (K, D), from F_bar = B^T W_bar.

        F is the flattened frame. With dG the change of the metric and S_ij = dG(E_i, E_j), Gram-Schmidt moves the frame
        by dE_i = -sum_j<i S_ij E_j - S_ii E_i / 2, and dF_i = dG E_i + G dE_i: what is left of sum_i F_bar_i . dF_i is
        the upper half of sum_ij c_ij S_ij, c_ij = F_bar_i . F_j. The normal part of dE_i counts for nothing: F_bar_i is
        a tangent vector, because W_bar is a sum of Logs.
        """
        E, d = self.frame[: self.count], self.manifold.dim
        c = splats.B.mT @ W_bar @ splats.F.mT
        upper = c.new_ones(d, d).triu() - 0.5 * torch.eye(d, dtype=c.dtype)
        mu = splats.mu.clone().requires_grad_()
        with torch.enable_grad():
            flattened = self.manifold.flat(mu[:, None], E)
        (mu_bar,) = torch.autograd.grad(flattened, mu, (c * upper) @ E)
        return mu_bar

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

    def move_centers(self, steps: Tensor) -> None:
        """Move each centre by Exp along `steps` (d, K), components in its frame, and carry the frame along."""
        mu, E = self.mu[: self.count], self.frame[: self.count]
        mu.copy_(self.manifold.exp(mu, self.arithmetic.tangents(steps, E)))
        if not self.frames_stay:
            E.copy_(self.orthonormal(mu, E))

    def orthonormal(self, mu: Tensor, E: Tensor) -> Tensor:
        """Frames E (K, d, T), nearly orthonormal at mu (K, D), made orthonormal there by Gram-Schmidt: (K, d, T)."""
        manifold, p = self.manifold, mu[:, None]
        if manifold.dim < manifold.tangent_size == manifold.point_size:  # ambient vectors: only they have a normal part
            E = manifold.to_tangent(p, E)
        return self.arithmetic.orthonormal(E, self.flat(p, E))

    def project_centers(self) -> None:
        """Take away what rounding has moved the centres off the manifold: Exp ends on it, but many steps add up."""
        mu = self.mu[: self.count]
        mu.copy_(self.manifold.project(mu))

    def clamp_shapes(self, min_singular: float) -> None:
        """Raise every singular value of A below the bound to it."""
        self.arithmetic.clamp_shapes(self.count, min_singular, self.numbers)

    def widths(self, points: int) -> Tensor | None:
        """Beside so many points, how wide the active splats are (K,); None where that is not worth knowing."""
        worth_it = points * self.count >= WORTH_WIDTHS
        return width(self.A[: self.count].movedim(0, -1)) if worth_it else None


class ArrivalTime:
    """T(x) = link(b(x), f(x)) and its Riemannian gradient, with b the distance to the goal or what stands for it."""

    def __init__(
        self, field: SplatField, link: Link, manifold: Manifold, goal: Tensor, base: Base | None = None
    ) -> None:
        """The goal is a point (D,); without a base, b is the distance to it."""
        self.field = field
        self.link = link
        self.manifold = manifold
        self.goal = goal
        self.base = base or Distance(manifold, goal)

    def time(self, x: Tensor) -> Tensor:
        """T (N,) at x (N, D)."""
        return self.time_and_gradient(x)[0]

    @torch.no_grad()
    def time_and_gradient(self, x: Tensor) -> tuple[Tensor, Tensor]:
        """T (N,) and grad T (N, T) as a tangent vector at x (N, D); zero at the goal itself, where T has a cone."""
        f, df = self.field.value_and_gradient(x)
        b, away = self.base.value_and_gradient(x)
        by_b, by_f = self.link.partials(b, f)
        return self.link.value(b, f), by_b[:, None] * away + by_f[:, None] * df

    def evaluate(self, x: Tensor, chunk: int = 8192) -> tuple[Tensor, Tensor]:
        """T (N,) and grad T (N, T) at any number of points, in chunks that fit in memory."""
        parts = [self.time_and_gradient(part) for part in torch.split(x, chunk)]
        if not parts:
            return x.new_zeros(0), x.new_zeros(0, self.manifold.tangent_size)
        return torch.cat([part[0] for part in parts]), torch.cat([part[1] for part in parts])
