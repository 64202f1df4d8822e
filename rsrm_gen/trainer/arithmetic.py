"""The arithmetic of a training step around the sum of splats, as torch operations (`InTorch`) or as C loops (`InC`).

A step consists of about a hundred operations on some thousand numbers. In torch each costs 2 to 10 us, all together more
than the sum of splats itself; in C, one pass for each of the functions below. Where there is no C compiler, torch does
the same: it says what is computed, as plainly as it can.

N points, K splats of a capacity C, d the manifold's dimension, T numbers a tangent vector. Points and splats are rows.
What the optimiser moves are columns: `numbers` (1 + d^2, C) are v and A; `gradient` (1 + d^2 + d, K) is in v, A and the
components of a centre's move in its frame. The derivative of a number L in a tensor X is written X_bar.
"""

from __future__ import annotations

import ctypes
import itertools
import math
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any, Protocol

import torch
from torch import Tensor

from rsrm_gen.compiler.native import FAST, compiled, compiler
from rsrm_gen.rows import VECTOR_MATH
from rsrm_gen.trainer.link import Exponential, Link, Quotient

BETA1, BETA2, EPSILON = 0.9, 0.999, 1e-8  # of AdamW

# Below this |grad T| / s the ratio's slope, q^(-3/2), says nothing any more but would drown every other point.
SMALLEST_RATIO = 1e-6

SOURCE = Path(__file__).with_name("arithmetic.c")
REALS = {torch.float32: "float", torch.float64: "double"}


@dataclass(frozen=True)
class Points:
    """N points and what the loss needs to know of them, which does not change with the field."""

    x: Tensor  # (N, D)
    base: Tensor  # (N,), what the link multiplies: see base.py
    away: Tensor  # (N, T), its gradient
    slowness: Tensor  # (N,)

    def tensors(self) -> tuple[Tensor, ...]:
        """All of it, in the order of the fields."""
        return self.x, self.base, self.away, self.slowness


@dataclass(frozen=True)
class Splats:
    """What `Manifold.splats` needs to know of K splats, and what that was made of."""

    mu: Tensor  # (K, D)
    W: Tensor  # (K, d, T), B F
    amplitude: Tensor  # (K), v times per_weight
    B: Tensor  # (K, d, d), A^-1
    F: Tensor  # (K, d, T), the covectors of the frame
    per_weight: Tensor  # (K), (2 pi)^(-d/2) |det B|

    def inputs(self) -> tuple[Tensor, Tensor, Tensor]:
        """mu, W and amplitude as the manifold takes them."""
        return self.mu, self.W, self.amplitude


@dataclass(frozen=True)
class Slope:
    """grad T at N points and the partial derivatives of T(b, f) that it was made of."""

    gradient: Tensor  # (N, T)
    partials: Tensor  # (4, N): dT/db, dT/df, d^2T/db df, d^2T/df^2


@dataclass(frozen=True)
class Loss:
    """The residual of N points, its mean, and the derivatives of the mean in f and grad f."""

    mean: float
    residual: Tensor  # (N,)
    f_bar: Tensor  # (N,)
    df_bar: Tensor  # (N, T)


class Arithmetic(Protocol):
    """What `InTorch` and `InC` both offer."""

    def far(self, parts: int, least: float, distance: Tensor, points: Points) -> list[Points]:
        """The points in so many equal parts, those alone whose distance (N,) to the goal is more than `least`."""
        ...

    def slowness(self, distances: Tensor, radii: Tensor, free: float, obstacle: float, width: float) -> Tensor:
        """free + (obstacle - free) sigmoid(-sdf / width), (N,), from distances (m, N) to the centres of m balls."""
        ...

    def splats(self, mu: Tensor, F: Tensor, numbers: Tensor) -> Splats:
        """The first K splats of `numbers`: mu (K, D), F (K, d, T)."""
        ...

    def splats_adjoint(self, splats: Splats, gradient: Tensor, W_bar: Tensor, amplitude_bar: Tensor) -> Tensor:
        """The columns `gradient`, from the Riemannian gradient in the centres (K, T)."""
        ...

    def slope(self, link: Link, points: Points, f: Tensor, df: Tensor) -> Slope:
        """grad T from f (N,) and its gradient df (N, T), contiguous."""
        ...

    def eikonal(self, squared: bool, points: Points, slope: Slope, covector: Tensor, df: Tensor) -> Loss:
        """The loss, with grad T as a covector (N, T): see `Eikonal`."""
        ...

    def adam(
        self, gradient: Tensor, clip: float, rate: float, decay: float, first: Tensor, second: Tensor, numbers: Tensor
    ) -> Tensor:
        """A step of AdamW along the gradient, made not longer than the clip, in place; the steps of the centres (d, K).

        A gradient that is not finite is a `FloatingPointError`, and nothing has moved. The moments `first` and `second`
        (1 + d^2 + d + 1, C) have in the last row those of a gradient that is always 1.
        """
        ...

    def tangents(self, steps: Tensor, E: Tensor) -> Tensor:
        """Tangent vectors (K, T) from components (d, K) in frames E (K, d, T)."""
        ...

    def orthonormal(self, E: Tensor, F: Tensor) -> Tensor:
        """Frames E (K, d, T) with the covectors F, made orthonormal by Gram-Schmidt: (K, d, T)."""
        ...

    def clamp_shapes(self, count: int, least: float, numbers: Tensor) -> None:
        """Raise the singular values of the first K shapes A that are below `least` to it, in place."""
        ...


@lru_cache
def arithmetic(dim: int, tangent_size: int, dtype: torch.dtype) -> Arithmetic:
    """In C where a compiler is there, else in torch."""
    if compiler() is None or dtype not in REALS:
        return InTorch(dim)
    return InC(dim, tangent_size, dtype)


class InTorch:
    """As torch operations."""

    def __init__(self, dim: int) -> None:
        self.dim = dim

    def far(self, parts: int, least: float, distance: Tensor, points: Points) -> list[Points]:
        """The points farther than `least` from the goal."""
        far = (distance > least).chunk(parts)
        chunks = zip(*(t.chunk(parts) for t in points.tensors()), strict=True)
        return [Points(*(t[kept] for t in chunk)) for kept, chunk in zip(far, chunks, strict=True)]

    def slowness(self, distances: Tensor, radii: Tensor, free: float, obstacle: float, width: float) -> Tensor:
        """The slowness."""
        if not len(radii):
            return distances.new_full(distances.shape[1:], free)
        return free + (obstacle - free) * torch.sigmoid((distances - radii[:, None]).amin(0) / -width)

    def splats(self, mu: Tensor, F: Tensor, numbers: Tensor) -> Splats:
        """The splats as the kernel takes them."""
        A, v = self._shapes(len(mu), numbers), numbers[0, : len(mu)]
        B = torch.linalg.inv_ex(A)[0].contiguous()
        per_weight = (2 * math.pi) ** (-self.dim / 2) / torch.linalg.det(A).abs()
        return Splats(mu, B @ F, v * per_weight, B, F, per_weight)

    def splats_adjoint(self, splats: Splats, gradient: Tensor, W_bar: Tensor, amplitude_bar: Tensor) -> Tensor:
        """The columns."""
        # W = B F with B = A^-1: dB = -B dA B and d log |det B| = -tr(B dA).
        S = W_bar @ splats.W.mT
        S.diagonal(dim1=1, dim2=2).add_((amplitude_bar * splats.amplitude)[:, None])
        A_bar = -splats.B.mT @ S
        centers = (splats.F * gradient[:, None]).sum(-1)
        return torch.cat((amplitude_bar[:, None] * splats.per_weight[:, None], A_bar.flatten(1), centers), 1).T

    def slope(self, link: Link, points: Points, f: Tensor, df: Tensor) -> Slope:
        """grad T."""
        partials = torch.stack(link.derivatives(points.base, f))
        return Slope(partials[0, :, None] * points.away + partials[1, :, None] * df, partials)

    def eikonal(self, squared: bool, points: Points, slope: Slope, covector: Tensor, df: Tensor) -> Loss:
        """The loss."""
        length = (covector * slope.gradient).sum(-1).clamp_min(0).sqrt()
        residual, by_length = (_squared if squared else _ratio)(length, points.slowness)
        by_gradient = (by_length / (length.clamp_min(1e-30) * len(df)))[:, None] * covector
        _, by_f, by_df, by_ff = slope.partials[..., None]
        f_bar = (by_gradient * (by_df * points.away + by_ff * df)).sum(-1)
        return Loss(float(residual.mean()), residual, f_bar, by_f * by_gradient)

    def adam(
        self, gradient: Tensor, clip: float, rate: float, decay: float, first: Tensor, second: Tensor, numbers: Tensor
    ) -> Tensor:
        """A step of AdamW."""
        count = gradient.shape[1]
        scale = min(1.0, clip / max(_finite(float(gradient.norm())), 1e-30))
        g = torch.cat((gradient * scale, gradient.new_ones(1, count)))
        m = first[:, :count].lerp_(g, 1 - BETA1)
        s = second[:, :count].mul_(BETA2).addcmul_(g, g, value=1 - BETA2)
        moves = m[:-1] / m[-1] / ((s[:-1] / s[-1]).sqrt() + EPSILON) * -rate
        numbers[:, :count] *= 1 - rate * decay
        numbers[:, :count] += moves[: len(numbers)]
        return moves[len(numbers) :]

    def tangents(self, steps: Tensor, E: Tensor) -> Tensor:
        """Tangent vectors."""
        return (steps.T[..., None] * E).sum(1)

    def orthonormal(self, E: Tensor, F: Tensor) -> Tensor:
        """Orthonormal frames."""
        rows: list[Tensor] = []  # a vector above its covector: (2, K, T)
        for row in torch.stack((E, F)).unbind(2):
            for e, covector in rows:
                row = row - (covector * row[0]).sum(-1, keepdim=True) * torch.stack((e, covector))
            rows.append(row * (row[0] * row[1]).sum(-1, keepdim=True).rsqrt())
        return torch.stack([row[0] for row in rows], 1)

    def clamp_shapes(self, count: int, least: float, numbers: Tensor) -> None:
        """Raise singular values."""
        A = self._shapes(count, numbers)
        U, S, Vh = torch.linalg.svd(A)
        small = S[:, -1] < least
        A[small] = ((U * S.clamp_min(least)[:, None]) @ Vh)[small]

    def _shapes(self, count: int, numbers: Tensor) -> Tensor:
        """A, (K, d, d), of which a change is one of `numbers`."""
        return numbers[1:].view(self.dim, self.dim, -1)[..., :count].movedim(-1, 0)


def _finite(length: float) -> float:
    """The length of the gradient."""
    if not math.isfinite(length):
        raise FloatingPointError("the gradient is not finite")
    return length


def _squared(slope: Tensor, slowness: Tensor) -> tuple[Tensor, Tensor]:
    """The residual and its derivative in the slope: (N,), (N,)."""
    return (slope - slowness) ** 2, 2 * (slope - slowness)


def _ratio(slope: Tensor, slowness: Tensor) -> tuple[Tensor, Tensor]:
    """The same for the other residual; both of its terms have one sign: |1 - r| + |1 - 1 / r| = |r - 1 / r|."""
    q = slope / slowness
    root = q.clamp_min(SMALLEST_RATIO).sqrt()
    difference = root - 1 / root
    by_root = difference.sign() * (1 + 1 / root**2)
    return difference.abs(), by_root / (2 * root * slowness) * (q > SMALLEST_RATIO)


class InC:
    """As C loops, on one thread: arithmetic.c, compiled for d, T and the dtype."""

    def __init__(self, dim: int, tangent_size: int, dtype: torch.dtype) -> None:
        self.dim, self.tangent_size = dim, tangent_size
        self.constant = (2 * math.pi) ** (-dim / 2)
        flags = (VECTOR_MATH, f"-DREAL={REALS[dtype]}", f"-DDIM={dim}", f"-DTANGENT={tangent_size}")
        text = SOURCE.read_text(encoding="utf-8")
        library = compiled({SOURCE.name: text}, SOURCE.name, (*FAST, *flags))
        for name, (result, types) in _SIGNATURES.items():
            function = getattr(library, name)
            function.restype, function.argtypes = result, [_TYPES[letter] for letter in types]
        self.library: Any = library

    def far(self, parts: int, least: float, distance: Tensor, points: Points) -> list[Points]:
        """The points farther than `least` from the goal."""
        count, size = points.x.shape
        distance, given = distance.contiguous(), [t.contiguous() for t in points.tensors()]
        made = [torch.empty_like(t) for t in given]
        counts = (ctypes.c_size_t * parts)()
        self.library.far_points(parts, count // parts, size, least, *_addresses(distance, *given, *made), counts)
        ends = list(itertools.accumulate(counts, initial=0))
        return [Points(*(t[start:end] for t in made)) for start, end in itertools.pairwise(ends)]

    def slowness(self, distances: Tensor, radii: Tensor, free: float, obstacle: float, width: float) -> Tensor:
        """The slowness."""
        s = distances.new_empty(distances.shape[1])
        distances = distances.contiguous()
        self.library.slowness(len(s), len(radii), *_addresses(distances, radii), free, obstacle, width, s.data_ptr())
        return s

    def splats(self, mu: Tensor, F: Tensor, numbers: Tensor) -> Splats:
        """The splats as the kernel takes them."""
        count, F = len(mu), F.contiguous()
        B, W = F.new_empty(count, self.dim, self.dim), torch.empty_like(F)
        per_weight, amplitude = F.new_empty(count), F.new_empty(count)
        addresses = _addresses(numbers, F, B, W, per_weight, amplitude)
        self.library.map_splats(count, numbers.shape[1], self.constant, *addresses)
        return Splats(mu, W, amplitude, B, F, per_weight)

    def splats_adjoint(self, splats: Splats, gradient: Tensor, W_bar: Tensor, amplitude_bar: Tensor) -> Tensor:
        """The columns."""
        s, count = splats, len(splats.mu)
        columns = gradient.new_empty(1 + self.dim**2 + self.dim, count)
        bars = gradient.contiguous(), W_bar.contiguous(), amplitude_bar.contiguous()
        addresses = _addresses(s.F, s.B, s.W, s.per_weight, s.amplitude, *bars, columns)
        self.library.map_splats_adjoint(count, *addresses)
        return columns

    def slope(self, link: Link, points: Points, f: Tensor, df: Tensor) -> Slope:
        """grad T."""
        if isinstance(link, Quotient):
            form = (1, link.offset, link.floor)
        elif type(link) is Exponential:
            form = (0, 0.0, 0.0)
        else:
            return InTorch(self.dim).slope(link, points, f, df)
        gradient, partials = torch.empty_like(df), df.new_empty(4, len(df))
        addresses = _addresses(points.base, points.away, f, df, partials, gradient)
        self.library.arrival_gradient(len(df), *form, *addresses)
        return Slope(gradient, partials)

    def eikonal(self, squared: bool, points: Points, slope: Slope, covector: Tensor, df: Tensor) -> Loss:
        """The loss."""
        covector, df_bar = covector.contiguous(), torch.empty_like(df)
        residual, f_bar = df.new_empty(len(df)), df.new_empty(len(df))
        given = slope.gradient, covector, slope.partials, points.away, df, points.slowness
        addresses = _addresses(*given, residual, f_bar, df_bar)
        mean = self.library.eikonal(len(df), squared, SMALLEST_RATIO, *addresses)
        return Loss(mean, residual, f_bar, df_bar)

    def adam(
        self, gradient: Tensor, clip: float, rate: float, decay: float, first: Tensor, second: Tensor, numbers: Tensor
    ) -> Tensor:
        """A step of AdamW."""
        count, capacity = gradient.shape[1], numbers.shape[1]
        gradient, steps = gradient.contiguous(), gradient.new_empty(self.dim, count)
        addresses = _addresses(gradient, first, second, numbers, steps)
        _finite(self.library.adam(count, capacity, clip, rate, decay, BETA1, BETA2, EPSILON, *addresses))
        return steps

    def tangents(self, steps: Tensor, E: Tensor) -> Tensor:
        """Tangent vectors."""
        steps, moves = steps.contiguous(), E.new_empty(len(E), self.tangent_size)
        self.library.tangents(len(E), *_addresses(steps, E, moves))
        return moves

    def orthonormal(self, E: Tensor, F: Tensor) -> Tensor:
        """Orthonormal frames."""
        E, F = E.contiguous(), F.contiguous()
        orthonormal = torch.empty_like(E)
        self.library.orthonormalise(len(E), *_addresses(E, F, orthonormal))
        return orthonormal

    def clamp_shapes(self, count: int, least: float, numbers: Tensor) -> None:
        """Raise singular values."""
        self.library.clamp_shapes(count, numbers.shape[1], least, numbers.data_ptr())


# The C functions: what they return and take. n: a size, i: an int, d: a double, p: an address.
_TYPES = {"n": ctypes.c_size_t, "i": ctypes.c_int, "d": ctypes.c_double, "p": ctypes.c_void_p}
_SIGNATURES: dict[str, tuple[Any, str]] = {
    "far_points": (None, "nnnd" + 10 * "p"),
    "slowness": (None, "nnppdddp"),
    "map_splats": (None, "nnd" + 6 * "p"),
    "map_splats_adjoint": (None, "n" + 9 * "p"),
    "arrival_gradient": (None, "nidd" + 6 * "p"),
    "eikonal": (ctypes.c_double, "nid" + 9 * "p"),
    "adam": (ctypes.c_double, "nndddddd" + 5 * "p"),
    "tangents": (None, "nppp"),
    "orthonormalise": (None, "nppp"),
    "clamp_shapes": (None, "nndp"),
}


def _addresses(*tensors: Tensor) -> list[int]:
    """Where the numbers of contiguous tensors lie; the caller keeps the tensors."""
    return [t.data_ptr() for t in tensors]
