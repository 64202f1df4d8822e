"""The model: a sum of wrapped anisotropic Gaussians on the manifold, and the arrival time made of it (RSRM eq. 1-7).

f(x) = sum_i v_i (2 pi)^(-d/2) |det A_i^-1| exp(-|A_i^-1 E_i Log_mu_i(x)|^2 / 2) |det D Log_mu_i(x)|

N points, K active splats of a capacity C, d the manifold's dimension, D numbers a point, T numbers a tangent vector.
The derivative of a number L in a tensor X is written X_bar. Nothing here leaves a graph for autograd: a training step
consists of so small operations that recording them would take longer than the sum of splats itself.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import torch
from torch import Tensor

from rsrm_gen.manifold import Manifold
from rsrm_gen.trainer.link import Link

WORTH_WIDTHS = 2**18  # pairs of a point and a splat, below which leaving far ones out gains less than widths cost


def orthonormal(manifold: Manifold, mu: Tensor, E: Tensor) -> Tensor:
    """Frames E (K, d, T), nearly orthonormal at mu (K, D), made orthonormal there by Gram-Schmidt: (K, d, T)."""
    if manifold.dim < manifold.tangent_size == manifold.point_size:  # ambient vectors: only they have a normal part
        E = manifold.to_tangent(mu[:, None], E)
    F = manifold.flat(mu[:, None], E)
    # A row and its covector one above the other, splats last: their product is the square of the length.
    left = torch.stack((E, F)).movedim(1, -1).contiguous()
    rows: list[Tensor] = []
    for row in left.unbind(1):
        for e, covector in rows:
            row = row - (covector * row[0]).sum(0) * torch.stack((e, covector))
        rows.append(row * (row[0] * row[1]).sum(0).rsqrt())
    return torch.stack([row[0] for row in rows]).movedim(-1, 0)


# The functions below have the splats in the last dimension, where numbers that are treated alike lie side by side.


def inverse(A: Tensor) -> tuple[Tensor, Tensor]:
    """A^-1 and det A of matrices A (d, d, K): (d, d, K), (K). By cofactors up to d = 3, where LAPACK takes longer."""
    d = len(A)
    if d > 3:
        rows = A.movedim(-1, 0)
        return torch.linalg.inv_ex(rows)[0].movedim(0, -1), torch.linalg.det(rows)
    if d == 3:
        cofactors = torch.linalg.cross(A[[1, 2, 0]], A[[2, 0, 1]], dim=1)
    elif d == 2:
        cofactors = torch.stack((A[1, 1], -A[1, 0], -A[0, 1], A[0, 0])).view(2, 2, -1)
    else:
        cofactors = torch.ones_like(A)
    det = (A[0] * cofactors[0]).sum(0)
    return cofactors.transpose(0, 1) / det, det


def raise_singular_pairs(A: Tensor, least: float) -> None:
    """Raise the singular values of A (2, 2, K) that are smaller to `least`, in place.

    A is a rotation times Q plus a reflection times R, and its singular values are Q + R and |Q - R|.
    """
    (a, b), (c, d) = A
    rotation, reflection = torch.stack((a + d, c - b)) / 2, torch.stack((a - d, c + b)) / 2
    Q, R = torch.hypot(*rotation), torch.hypot(*reflection)
    small = (Q - R).abs() < least
    if not small.any():
        return
    larger = (Q + R).clamp_min(least)
    smaller = (Q - R).abs().clamp_min(least) * torch.where(Q < R, -1.0, 1.0)
    rotation[0] += Q == 0  # any rotation will do
    rotation *= (larger + smaller) / 2 / torch.where(Q == 0, 1.0, Q)
    reflection *= (larger - smaller) / 2 / torch.where(R == 0, 1.0, R)
    (x, y), (z, w) = rotation, reflection
    raised = torch.stack((x + z, w - y, y + w, x - z)).view(2, 2, -1)
    A.copy_(torch.where(small, raised, A))


def product(A: Tensor, B: Tensor) -> Tensor:
    """Matrices (i, j, K) times matrices (j, k, K): (i, k, K)."""
    return (A[:, :, None] * B[None]).sum(1)


def width(A: Tensor) -> Tensor:
    """At least the largest singular value of matrices A (d, d, K): (K,), at most d^(1/8) times it, itself where d <= 2.

    Where d = 2 it is Q + R, see `raise_singular_pairs`; else the 8th root of the sum of the 8th powers of all.
    """
    if len(A) == 2:
        (a, b), (c, d) = A
        return (torch.hypot(a + d, c - b) + torch.hypot(a - d, c + b)) / 2
    scale = A.abs().amax((0, 1))
    A = A / torch.where(scale == 0, 1.0, scale)  # 8th powers of small numbers are zero
    square = product(A.transpose(0, 1), A)
    fourth = product(square, square)
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
        self.numbers = torch.zeros(1 + d * d, capacity, dtype=dtype)  # v and A, which the optimiser moves at once
        self.v = self.numbers[0]
        self.A = self.numbers[1:].view(d, d, capacity).movedim(-1, 0)
        self.mu = torch.zeros(capacity, D, dtype=dtype)
        self.frame = torch.zeros(capacity, d, T, dtype=dtype)
        p = torch.zeros(D, dtype=dtype, requires_grad=True)
        # Whether <u, v>_p has p in its formula.
        self.metric_varies = manifold.flat(p, torch.ones(T, dtype=dtype)).requires_grad
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
        splats = self.splats()
        return self.manifold.splats(x, *splats.inputs(), splats.widths(len(x)))

    @torch.no_grad()
    def splats(self) -> Splats:
        """The active splats as the manifold takes them."""
        mu = self.mu[: self.count]
        A = self._shapes()
        B, det = inverse(A)
        F = self.manifold.flat(mu[:, None], self.frame[: self.count]).movedim(0, -1).contiguous()
        per_weight = (2 * math.pi) ** (-self.manifold.dim / 2) / det.abs()
        return Splats(mu, product(B, F), self.v[: self.count] * per_weight, A, B, F, per_weight)

    def _shapes(self) -> Tensor:
        """A of the active splats, (d, d, K)."""
        return self.A[: self.count].movedim(0, -1)

    @torch.no_grad()
    def gradient(self, splats: Splats, mu_bar: Tensor, W_bar: Tensor, amplitude_bar: Tensor) -> Tensor:
        """The derivatives in v, A and the centre of each splat, a column each: (1 + d^2 + d, K).

        Those in the centres are components in their frames. They are of what a step really does, which moves a centre
        and makes its frame orthonormal there.
        """
        B, F = splats.B, splats.F
        v_bar = amplitude_bar * splats.per_weight
        # W = B F with B = A^-1: dB = -B dA B and d log |det B| = -tr(B dA).
        WW = product(W_bar.movedim(0, -1).contiguous(), splats.W.transpose(0, 1))
        if self.metric_varies:
            mu_bar = mu_bar + self._through_the_metric(
                product(product(B.transpose(0, 1), WW), self._shapes().transpose(0, 1))
            )
        WW.diagonal().T.add_(amplitude_bar * splats.amplitude)
        A_bar = product(B.transpose(0, 1), WW).neg_()
        # The Riemannian gradient is the same for every extension of the formulas off the manifold; mu_bar is not.
        gradient = self.manifold.riemannian_gradient(splats.mu, mu_bar)
        return torch.cat((v_bar[None], A_bar.flatten(0, 1), (F * gradient.T).sum(1)))

    def _through_the_metric(self, c: Tensor) -> Tensor:
        """What mu_bar gains because the metric changes with mu: (K, D), from c (d, d, K), c_ij = F_bar_i . F_j.

        F is the flattened frame. With dG the change of the metric and S_ij = dG(E_i, E_j), Gram-Schmidt moves the frame
        by dE_i = -sum_j<i S_ij E_j - S_ii E_i / 2, and dF_i = dG E_i + G dE_i: what is left of sum_i F_bar_i . dF_i is
        the upper half of sum_ij c_ij S_ij. The normal part of dE_i counts for nothing: F_bar_i is a tangent vector,
        because W_bar is a sum of Logs.
        """
        E = self.frame[: self.count]
        upper = c.new_ones(len(c), len(c)).triu() - 0.5 * torch.eye(len(c), dtype=c.dtype)
        mu = self.mu[: self.count].clone().requires_grad_()
        with torch.enable_grad():
            flattened = self.manifold.flat(mu[:, None], E)
        F_bar = product(c * upper[..., None], E.movedim(0, -1)).movedim(-1, 0)
        (mu_bar,) = torch.autograd.grad(flattened, mu, F_bar)
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

    @torch.no_grad()
    def move_centers(self, steps: Tensor) -> None:
        """Move each centre by Exp along `steps` (K, d), components in its frame, and carry the frame along."""
        mu, E = self.mu[: self.count], self.frame[: self.count]
        moves = (steps.T[:, None] * E.movedim(0, -1).contiguous()).sum(0).T
        mu.copy_(self.manifold.exp(mu, moves))
        if not self.frames_stay:
            E.copy_(orthonormal(self.manifold, mu, E))

    @torch.no_grad()
    def project_centers(self) -> None:
        """Take away what rounding has moved the centres off the manifold: Exp ends on it, but many steps add up."""
        mu = self.mu[: self.count]
        mu.copy_(self.manifold.project(mu))

    @torch.no_grad()
    def clamp_shapes(self, min_singular: float) -> None:
        """Raise every singular value of A below the bound to it."""
        A = self._shapes()
        if self.manifold.dim == 2:
            raise_singular_pairs(A, min_singular)
            return
        # The smallest singular value is at least 1 / |A^-1|_F: most splats need no decomposition.
        B = inverse(A)[0].flatten(0, 1)
        suspect = ~((B * B).sum(0) * min_singular**2 <= 1)
        if suspect.any():
            U, S, Vh = torch.linalg.svd(A[..., suspect].movedim(-1, 0))
            A[..., suspect] = ((U * S.clamp_min(min_singular)[:, None]) @ Vh).movedim(0, -1)


@dataclass(frozen=True)
class Splats:
    """What `Manifold.splats` needs to know of K splats, and what that was made of."""

    mu: Tensor  # (K, D)
    W: Tensor  # (d, T, K), B F
    amplitude: Tensor  # (K), v times per_weight
    A: Tensor  # (d, d, K)
    B: Tensor  # (d, d, K), A^-1
    F: Tensor  # (d, T, K), the covectors of the frame
    per_weight: Tensor  # (K), (2 pi)^(-d/2) |det B|

    def inputs(self) -> tuple[Tensor, Tensor, Tensor]:
        """mu, W and amplitude as the manifold takes them: (K, D), (K, d, T), (K)."""
        return self.mu, self.W.movedim(-1, 0).contiguous(), self.amplitude

    def widths(self, points: int) -> Tensor | None:
        """Beside so many points, how wide the splats are (K,); None where that is not worth knowing."""
        return width(self.A) if points * len(self.mu) >= WORTH_WIDTHS else None


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

    @torch.no_grad()
    def time_and_gradient(self, x: Tensor) -> tuple[Tensor, Tensor]:
        """T (N,) and grad T (N, T) as a tangent vector at x (N, D); zero at the goal itself, where T has a cone."""
        f, df = self.field.value_and_gradient(x)
        d, away = self.from_goal(x)
        by_d, by_f = self.link.partials(d, f)
        return self.link.value(d, f), (by_d * away + by_f * df.T).T

    @torch.no_grad()
    def from_goal(self, x: Tensor) -> tuple[Tensor, Tensor]:
        """The distance d (N,) of x (N, D) to the goal and grad d (T, N), zero at the goal itself."""
        d = self.manifold.distance(x, self.goal.expand_as(x))
        toward = self.manifold.log(x, self.goal.expand_as(x)).T.contiguous()
        return d, toward / -torch.where(d > 0, d, 1.0)

    def evaluate(self, x: Tensor, chunk: int = 8192) -> tuple[Tensor, Tensor]:
        """T (N,) and grad T (N, T) at any number of points, in chunks that fit in memory."""
        parts = [self.time_and_gradient(part) for part in torch.split(x, chunk)]
        if not parts:
            return x.new_zeros(0), x.new_zeros(0, self.manifold.tangent_size)
        return torch.cat([part[0] for part in parts]), torch.cat([part[1] for part in parts])
