"""Gauss-Newton on all that shapes a splat: the sum of squares of weighted residuals, linear in the parameters nearby.

A splat has Q = 1 + d + d (d + 1) / 2 effective parameters, and only they are moved:

    its amplitude, v (2 pi)^(-d/2) |det A^-1|, which is the value at the centre;
    u (d), the move of the centre to Exp_mu(E^T A u), so that |u| = 1 is one standard deviation;
    S, symmetric (d, d): A becomes A expm(-S), so that log(singular values) change by at most |S|.

What turns A's image, A Q for a rotation Q, changes no splat, and S spans all the rest. Both u and S are free of units.

Rows of the Jacobian come from the generated kernel in its own variables (mu, W, amplitude), and a small matrix a splat takes
them to the effective ones. The matrix of the normal equations (P, P), P = K Q, is summed over compact blocks of points, and in
each block over the splats alone that reach it: nothing of size N x P is ever there. The gradient is that of all splats at all
points, by the kernel's backward pass, so that what is left out bends a step but not the point that steps lead to.
"""

from __future__ import annotations

import ctypes
import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import torch
from torch import Tensor

from rsrm_gen.compiler.native import FAST, compiled, compiler
from rsrm_gen.trainer.arithmetic import REALS, Splats
from rsrm_gen.trainer.blocks import Block, blocks
from rsrm_gen.trainer.model import SplatField

SOURCE = Path(__file__).with_suffix(".c")
BLOCK = 512  # points of which rows of the Jacobian are there at the same time
BLOCK_NUMBERS = 2**24  # and how many numbers these rows may be
PROBES = 32  # points of a block at which is looked whether a splat reaches it
CHUNK = 4096  # points whose derivatives are summed in the field's own dtype
REACH = 4.0  # standard deviations, beyond which curvature is left out: a splat is 3e-4 of its height there
WHOLE = 6.5  # the same where a linear problem is solved at once and nothing may be missing: 1e-9
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
    return Sample(x, blocks(manifold, x, min(BLOCK, max(BLOCK_NUMBERS // numbers, 64)), PROBES))


def curvature(
    field: SplatField, at: Sample, slope: Tensor, to_parameters: Tensor, dtype: torch.dtype, reach: float = REACH
) -> Tensor:
    """J^T J (P, P) of N values with the derivatives `slope` (N,) in f, Q parameters of a splat side by side.

    `to_parameters` (K, D + d T + 1, Q) says which parameters, as `effective_map` does. Products are summed in `dtype`.
    """
    splats, Q = field.splats(), to_parameters.shape[-1]
    widths = torch.linalg.svdvals(field.A[: field.count])
    matrix = torch.zeros(field.count * Q, field.count * Q, dtype=dtype)
    parameters = torch.arange(field.count * Q).view(-1, Q)
    add = adder(dtype)
    for part in at.parts:
        x = at.x[part.index]
        near = _near(field, splats, widths, part, reach)
        J = _rows(field, splats, x, slope[part.index], near, to_parameters).to(dtype)
        add(matrix, parameters[near].flatten(), J.T @ J)
    return matrix.tril_() + matrix.tril(-1).T


@lru_cache
def adder(dtype: torch.dtype) -> Callable[[Tensor, Tensor, Tensor], None]:
    """A function that adds a block (n, n) to the rows and columns of a matrix that are given (n,), rising: to the lower
    triangle at least."""
    if compiler() is None or dtype not in REALS:
        return _add_block
    text = SOURCE.read_text(encoding="utf-8")
    function: Any = compiled({SOURCE.name: text}, SOURCE.name, (*FAST, f"-DREAL={REALS[dtype]}")).add_block
    function.argtypes = [ctypes.c_size_t] * 2 + [ctypes.c_void_p] * 3

    def add(matrix: Tensor, columns: Tensor, block: Tensor) -> None:
        block = block.contiguous()
        function(len(matrix), len(columns), columns.data_ptr(), block.data_ptr(), matrix.data_ptr())

    return add


def _add_block(matrix: Tensor, columns: Tensor, block: Tensor) -> None:
    matrix[columns[:, None], columns] += block


def gradient(field: SplatField, x: Tensor, slope: Tensor, residual: Tensor, to_parameters: Tensor) -> Tensor:
    """J^T r of residuals r (N,) at x (N, D): (P,), in float64."""
    inputs = [rows.detach().requires_grad_() for rows in field.splats().inputs()]
    total = torch.zeros(to_parameters.shape[:2], dtype=torch.float64)
    for part, bar in zip(torch.split(x, CHUNK), torch.split(slope * residual, CHUNK), strict=True):
        with torch.enable_grad():
            f = field.manifold.splats_value(part, *inputs)
        bars = torch.autograd.grad(f, inputs, bar)
        total += torch.cat([rows.flatten(1) for rows in (*bars[:2], bars[2][:, None])], 1)
    return torch.einsum("kr,krq->kq", total, to_parameters.double()).flatten()


def _near(field: SplatField, splats: Splats, widths: Tensor, part: Block, reach: float) -> Tensor:
    """The splats (k,) that come within so many standard deviations of a block's points; widths (K, d) are the singular
    values of A, falling."""
    manifold = field.manifold
    near = torch.arange(field.count)
    if manifold.maps == "geodesic":  # else distances need not be those of a metric
        distance = manifold.distance(part.center.expand_as(splats.mu), splats.mu)
        near = near[~(distance - part.radius > reach * widths[:, 0])]  # one that is not finite is not known to be far
    size = len(near), len(part.probes), manifold.point_size
    toward = manifold.log(splats.mu[near][:, None].expand(size), part.probes.expand(size))
    z = (splats.W[near] @ toward.mT).square().sum(1).amin(1).sqrt()
    # No point is more standard deviations from its probe than it would be across the splat.
    return near[~(z > reach + part.cover / widths[near, -1])]


def _rows(field: SplatField, splats: Splats, x: Tensor, slope: Tensor, near: Tensor, to_parameters: Tensor) -> Tensor:
    """The Jacobian (n, k Q) at x (n, D) of some splats (k,)."""
    mu, W, amplitude = (rows[near] for rows in splats.inputs())
    nothing = x.new_zeros(len(x), field.manifold.tangent_size)
    rows = field.manifold.splats_rows(x, mu, W, amplitude, slope, nothing)
    return torch.einsum("nkr,krq->nkq", rows, to_parameters[near]).flatten(1)


@dataclass(frozen=True)
class NormalEquations:
    """What a step solves: J^T J, each parameter in units of its column's length, and J^T r in the same."""

    matrix: Tensor  # (P, P), float64
    gradient: Tensor  # (P,)
    scale: Tensor  # (P,), one over the length; 0 for parameters that change nothing, which then stay

    @staticmethod
    def of(matrix: Tensor, gradient: Tensor) -> NormalEquations:
        """From J^T J (P, P) and J^T r (P,)."""
        matrix = matrix.double()
        length = matrix.diagonal().sqrt()
        scale = torch.where(length > 0, 1 / length, 0.0)
        return NormalEquations(matrix * scale * scale[:, None], gradient * scale, scale)

    def step(self, damping: float) -> Tensor | None:
        """The minimum (P,) of |J step + r|^2 + damping |step|^2; None where the matrix is not positive definite."""
        matrix = self.matrix.clone()
        matrix.diagonal().fill_(1 + damping)
        factor, failed = torch.linalg.cholesky_ex(matrix)
        if int(failed):
            return None
        step = torch.cholesky_solve(-self.gradient[:, None], factor)[:, 0] * self.scale
        return step if bool(step.isfinite().all()) else None


@torch.no_grad()
def apply(field: SplatField, step: Tensor, bounds: tuple[float, float]) -> None:
    """Move the splats by a step (K Q), shortened where it goes too far; singular values of A stay within the bounds."""
    count, d = field.count, field.manifold.dim
    step = step.to(field.mu.dtype).view(count, -1)
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
