"""Sums of splats by the generated C on CPU tensors: one pass forward, one backward, nothing of size N x K stored.

The C code is compiled for this machine on first use. Other devices, points that need a gradient themselves, and
machines without a C compiler use the generated torch code, which gives the same numbers.
"""

from __future__ import annotations

import ctypes
import itertools
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import Tensor

from rsrm_gen.compiler.native import FAST, compiled, pointer
from rsrm_gen.manifold import Manifold

SMALLEST_SHARE = 256  # points a thread is worth starting for


def accelerated(manifold: Manifold, folder: Path) -> Manifold:
    """The same manifold, its `splats` by the C kernel in `folder`; the compiler runs when it is first called."""
    generated = type(manifold)

    class Accelerated(generated):  # type: ignore[misc,valid-type]
        kernel: SplatKernel | None = None

        def splats(self, x: Tensor, mu: Tensor, W: Tensor, amplitude: Tensor) -> tuple[Tensor, Tensor]:
            tensors = (x, mu, W, amplitude)
            if (
                x.requires_grad
                or x.dtype not in DTYPES
                or any(t.device.type != "cpu" or t.dtype != x.dtype for t in tensors)
            ):
                value, gradient = super().splats(x, mu, W, amplitude)
                return value, gradient
            if Accelerated.kernel is None:
                Accelerated.kernel = SplatKernel(manifold, folder)
            value, gradient = _Splats.apply(Accelerated.kernel, *tensors)  # type: ignore[no-untyped-call]
            return value, gradient

    Accelerated.__name__ = generated.__name__
    Accelerated.__qualname__ = generated.__qualname__
    Accelerated.splats.__doc__ = generated.splats.__doc__
    return Accelerated()


DTYPES = {torch.float64: ("", np.float64), torch.float32: ("_f", np.float32)}


class SplatKernel:
    """The two C functions of a manifold, called with the points shared among torch's number of threads."""

    def __init__(self, manifold: Manifold, folder: Path) -> None:
        files = {path.name: path.read_text(encoding="utf-8") for path in folder.glob("*.[ch]")}
        self.name = folder.name
        self.tangent_size = manifold.tangent_size
        self.library = compiled(files, f"{self.name}_splats.c", FAST)
        self.pool: ThreadPoolExecutor | None = None
        self.pool_size = 0

    def forward(self, x: Any, mu: Any, W: Any, amplitude: Any) -> tuple[Any, Any]:
        """Values (N,) and gradients (N, T) from numpy arrays."""
        value = np.empty(len(x), x.dtype)
        gradient = np.empty((len(x), self.tangent_size), x.dtype)

        def part(rows: slice) -> None:
            self.call("splats", rows, len(mu), x[rows], mu, W, amplitude, value[rows], gradient[rows])

        self.share(len(x), part)
        return value, gradient

    def vjp(self, x: Any, mu: Any, W: Any, amplitude: Any, value_bar: Any, gradient_bar: Any) -> tuple[Any, Any, Any]:
        """The derivatives in mu, W and amplitude: each thread's sum over its points, added in order."""

        def part(rows: slice) -> tuple[Any, Any, Any]:
            sums = np.empty_like(mu), np.empty_like(W), np.empty_like(amplitude)
            self.call(
                "splats_vjp", rows, len(mu), x[rows], mu, W, amplitude, value_bar[rows], gradient_bar[rows], *sums
            )
            return sums

        parts = self.share(len(x), part)
        return tuple(sum(arrays[1:], start=arrays[0]) for arrays in zip(*parts, strict=True))

    def share(self, count: int, part: Any) -> list[Any]:
        """Call `part` on consecutive slices of the points, one a thread."""
        threads = max(1, min(torch.get_num_threads(), count // SMALLEST_SHARE))
        bounds = [count * i // threads for i in range(threads + 1)]
        slices = [slice(a, b) for a, b in itertools.pairwise(bounds)]
        if threads == 1:
            return [part(slices[0])]
        if self.pool is None or self.pool_size < threads:
            self.pool, self.pool_size = ThreadPoolExecutor(threads), threads
        return list(self.pool.map(part, slices))

    def call(self, function: str, rows: slice, splats: int, *arrays: Any) -> None:
        """One C function on one slice."""
        suffix = "_f" if arrays[0].dtype == np.float32 else ""
        c_function = getattr(self.library, f"{self.name}_{function}{suffix}")
        c_function(ctypes.c_size_t(rows.stop - rows.start), ctypes.c_size_t(splats), *map(pointer, arrays))


class _Splats(torch.autograd.Function):
    """The kernel under autograd; differentiable once, in mu, W and amplitude."""

    @staticmethod
    def forward(
        ctx: Any, kernel: SplatKernel, x: Tensor, mu: Tensor, W: Tensor, amplitude: Tensor
    ) -> tuple[Tensor, Tensor]:
        arrays = [t.detach().contiguous().numpy() for t in (x, mu, W, amplitude)]
        ctx.kernel, ctx.arrays = kernel, arrays
        value, gradient = kernel.forward(*arrays)
        return torch.from_numpy(value), torch.from_numpy(gradient)

    @staticmethod
    @torch.autograd.function.once_differentiable
    def backward(ctx: Any, value_bar: Tensor, gradient_bar: Tensor) -> tuple[Any, ...]:
        bars = (value_bar.contiguous().numpy(), gradient_bar.contiguous().numpy())
        sums = ctx.kernel.vjp(*ctx.arrays, *bars)
        return None, None, *(torch.from_numpy(s) for s in sums)
