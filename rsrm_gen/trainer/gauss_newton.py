"""Gauss-Newton on all that shapes a splat: the sum of squares of weighted residuals, linear in the parameters nearby.

A splat has Q = 1 + d + d (d + 1) / 2 effective parameters, and only they are moved:

    its amplitude, v (2 pi)^(-d/2) |det A^-1|, which is the value at the centre;
    u (d), the move of the centre to Exp_mu(E^T A u), so that |u| = 1 is one standard deviation;
    S, symmetric (d, d): A becomes A expm(-S), so that log(singular values) change by at most |S|.

What turns A's image, A Q for a rotation Q, changes no splat, and S spans all the rest. Both u and S are free of units.

Rows of the Jacobian come from the generated kernel in its own variables (mu, W, amplitude), and a small matrix a splat takes
them to the effective ones. The matrix of the normal equations (P, P), P = K Q, is summed over blocks of points, and in each
block over those pairs of splats only that both reach it: nothing of size N x P is ever there.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import torch
from torch import Tensor

from rsrm_gen.trainer.arithmetic import Splats
from rsrm_gen.trainer.blocks import Block, blocks, halves
from rsrm_gen.trainer.model import SplatField, width

TILE = 64  # splats whose columns of the Jacobian are multiplied at once
WIDEST_TILE = 384  # columns, or those of 8 splats
BLOCK = 1024  # points of which rows of the Jacobian are there at the same time
BLOCK_NUMBERS = 2**24  # and how many numbers these rows may be
REACH = 6.0  # standard deviations, beyond which a splat's derivatives are below rounding: exp(-18) is 1.5e-8
LARGEST_MOVE = 1.0  # of a centre, in standard deviations
LARGEST_STRETCH = math.log(2)  # of a shape, in the logarithm of its singular values


def effective_count(dim: int) -> int:
    """Q, the effective parameters of a splat."""
    return 1 + dim + dim * (dim + 1) // 2


def effective_map(field: SplatField, splats: Splats) -> Tensor:
    """What takes derivatives in (mu, W, amplitude) to those in the effective parameters: (K, D + d T + 1, Q)."""
    manifold, count = field.manifold, len(splats.mu)
    D, d, T = manifold.point_size, manifold.dim, manifold.tangent_size
    result = splats.mu.new_zeros(count, D + d * T + 1, effective_count(d))
    result[:, -1, 0] = 1
    # A unit vector at a time through the adjoint of what a step does to a splat: the last d rows are the centre's.
    units = torch.eye(D + d * T, dtype=splats.mu.dtype)
    nothing = splats.amplitude.new_zeros(count)
    A = field.A[:count]
    for i in range(D + d * T if field.metric_varies else D):
        mu_bar, W_bar = torch.split(units[i].expand(count, -1), [D, d * T], 1)
        columns = field.gradient(splats, mu_bar.contiguous(), W_bar.reshape(count, d, T).contiguous(), nothing)
        result[:, i, 1 : 1 + d] = (columns[-d:].T[:, None] @ A)[:, 0]
    # W = A^-1 F becomes expm(S) W.
    upper = torch.triu_indices(d, d)
    for column, (i, j) in enumerate(upper.T.tolist(), 1 + d):
        by_W = result[:, D : D + d * T, column].view(count, d, T)
        by_W[:, i] += splats.W[:, j]
        if i != j:
            by_W[:, j] += splats.W[:, i]
    return result


def amplitudes_alone(field: SplatField) -> Tensor:
    """What takes derivatives in (mu, W, amplitude) to those in the amplitudes: (K, D + d T + 1, 1)."""
    manifold = field.manifold
    result = field.mu.new_zeros(field.count, manifold.point_size + manifold.dim * manifold.tangent_size + 1, 1)
    result[:, -1] = 1
    return result


@dataclass(frozen=True)
class Sample:
    """Points at which residuals are taken, in blocks."""

    x: Tensor  # (N, D)
    parts: list[Block]


def sample(field: SplatField, x: Tensor) -> Sample:
    """The points x (N, D) in blocks for a field of that capacity."""
    manifold = field.manifold
    numbers = field.capacity * (manifold.point_size + manifold.dim * manifold.tangent_size + 1)
    return Sample(x, blocks(manifold, x, min(BLOCK, max(BLOCK_NUMBERS // numbers, 64))))


@dataclass(frozen=True)
class NormalEquations:
    """J^T J and J^T r of residuals r (N,) with the Jacobian J (N, P), Q parameters of a splat side by side."""

    order: Tensor  # (K,), the splats in the order of their parameters
    matrix: Tensor  # (P, P), its lower triangle
    gradient: Tensor  # (P,), float64

    def per_splat(self, numbers: Tensor) -> Tensor:
        """Numbers (P,) that belong to the parameters, as the splats are ordered in their field: (K, Q)."""
        rows = numbers.view(len(self.order), -1)
        return torch.empty_like(rows).index_copy_(0, self.order, rows)


def normal_equations(
    field: SplatField, at: Sample, slope: Tensor, residual: Tensor, to_parameters: Tensor, dtype: torch.dtype
) -> NormalEquations:
    """Of N points with residuals (N,) and their derivatives in f, `slope` (N,).

    `to_parameters` (K, D + d T + 1, Q) says which parameters, as `effective_map` does. Products are summed in `dtype`.
    """
    splats, Q = field.splats(), to_parameters.shape[-1]
    tiles = list(halves(splats.mu, min(TILE, max(WIDEST_TILE // Q, 8))))
    ends = torch.tensor([0] + [len(tile) * Q for tile in tiles]).cumsum(0).tolist()
    columns = [slice(a, b) for a, b in itertools.pairwise(ends)]
    reach = REACH * width(field.A[: field.count].movedim(0, -1))
    matrix = torch.zeros(ends[-1], ends[-1], dtype=dtype)
    gradient = torch.zeros(ends[-1], dtype=torch.float64)
    for part in at.parts:
        near = _near(field, part, tiles, reach)
        if not near:
            continue
        kept = torch.cat([tiles[i] for i in near])
        J = _rows(field, splats, at.x[part.index], slope[part.index], kept, to_parameters).to(dtype)
        r = residual[part.index].to(dtype)
        J_of = dict(zip(near, torch.split(J, [len(tiles[i]) * Q for i in near], 1), strict=True))
        for i, J_i in J_of.items():
            gradient[columns[i]] += (J_i.T @ r).double()
            for j, J_j in J_of.items():
                if j <= i:
                    matrix[columns[i], columns[j]].addmm_(J_i.T, J_j)
    return NormalEquations(torch.cat(tiles), matrix, gradient)


def _near(field: SplatField, part: Block, tiles: list[Tensor], reach: Tensor) -> list[int]:
    """The tiles with a splat that reaches the block; all where distances are not those of a metric."""
    if field.manifold.maps != "geodesic":
        return list(range(len(tiles)))
    centers = field.mu[: field.count]
    distance = field.manifold.distance(part.center.expand_as(centers), centers)
    # A distance that is not finite is not known to be far.
    near = ~(distance - part.radius > reach)
    return [i for i, tile in enumerate(tiles) if bool(near[tile].any())]


def _rows(field: SplatField, splats: Splats, x: Tensor, slope: Tensor, kept: Tensor, to_parameters: Tensor) -> Tensor:
    """The Jacobian (n, k Q) at x (n, D) of the kept splats (k,)."""
    mu, W, amplitude = (rows[kept] for rows in splats.inputs())
    nothing = x.new_zeros(len(x), field.manifold.tangent_size)
    rows = field.manifold.splats_rows(x, mu, W, amplitude, slope, nothing)
    return torch.einsum("nkr,krq->nkq", rows, to_parameters[kept]).flatten(1)


def solve(equations: NormalEquations, damping: float) -> Tensor | None:
    """The step (K, Q) to the minimum of |J step + r|^2 + damping |step|^2, each parameter in units of its column's length.

    None where the matrix, with rounding, is not positive definite.
    """
    matrix = equations.matrix.double()
    length = matrix.diagonal().sqrt()
    scale = 1 / torch.where(length > 0, length, 1.0)
    matrix.mul_(scale).mul_(scale[:, None])
    matrix.diagonal().fill_(1 + damping)  # also of columns that are zero, which stay where they are
    factor, failed = torch.linalg.cholesky_ex(matrix)
    if int(failed):
        return None
    step = torch.cholesky_solve((-scale * equations.gradient)[:, None], factor)[:, 0] * scale
    return equations.per_splat(step) if bool(step.isfinite().all()) else None


@torch.no_grad()
def apply(field: SplatField, step: Tensor, bounds: tuple[float, float]) -> None:
    """Move the splats by a step (K, Q), shortened where it goes too far; singular values of A stay within the bounds."""
    count, d = field.count, field.manifold.dim
    step = step.to(field.mu.dtype)
    A, amplitude = field.A[:count], amplitudes(field) + step[:, 0]
    move, S = step[:, 1 : 1 + d], _symmetric(step[:, 1 + d :], d)
    length = move.norm(dim=1, keepdim=True)
    move = move * (LARGEST_MOVE / length.clamp_min(LARGEST_MOVE))
    rate, axes = torch.linalg.eigh(S)
    rate = rate.clamp(-LARGEST_STRETCH, LARGEST_STRETCH)
    centers = (A @ move[..., None])[..., 0]
    shrunk = A @ (axes * torch.exp(-rate)[:, None]) @ axes.mT
    A.copy_(bounded(shrunk, *bounds))
    field.move_centers(centers.T)
    set_amplitudes(field, amplitude)


def _symmetric(entries: Tensor, dim: int) -> Tensor:
    """Symmetric matrices (K, d, d) from the entries on and above the diagonal, row by row."""
    i, j = torch.triu_indices(dim, dim)
    S = entries.new_zeros(len(entries), dim, dim)
    S[:, i, j] = entries
    S[:, j, i] = entries
    return S


def bounded(A: Tensor, least: float, largest: float) -> Tensor:
    """Shapes (K, d, d) with their singular values within the bounds; those that were so stay to the last bit."""
    U, values, Vh = torch.linalg.svd(A)
    within = values.clamp(least, largest)
    changed = (within != values).any(1)
    return torch.where(changed[:, None, None], (U * within[:, None]) @ Vh, A)


def amplitudes(field: SplatField) -> Tensor:
    """v (2 pi)^(-d/2) |det A^-1| of each splat: (K,)."""
    return field.v[: field.count] / _volume(field)


def set_amplitudes(field: SplatField, amplitude: Tensor) -> None:
    """Give the splats weights v of these amplitudes (K,)."""
    field.v[: field.count] = amplitude * _volume(field)


def _volume(field: SplatField) -> Tensor:
    volume: Tensor = torch.linalg.det(field.A[: field.count]).abs() * (2 * math.pi) ** (field.manifold.dim / 2)
    return volume
