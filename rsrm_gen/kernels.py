"""Sums of splats by the generated C on CPU tensors: one pass forward, one backward, nothing of size N x K stored.

The C code is compiled for this machine on first use. Other devices, points that need a gradient themselves, and
machines without a C compiler use the generated torch code, which gives the same numbers.
"""

from __future__ import annotations

import ctypes
import itertools
import os
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
            if x.requires_grad or not _fit_the_kernel(manifold, *tensors):
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


def _fit_the_kernel(manifold: Manifold, x: Tensor, mu: Tensor, W: Tensor, amplitude: Tensor) -> bool:
    """Whether C may read these tensors: one dtype, on the CPU, and shaped as said, not merely broadcastable to it."""
    D, K = manifold.point_size, len(mu) if mu.dim() else 0
    tensors = (x, mu, W, amplitude)
    shapes = ((len(x) if x.dim() else 0, D), (K, D), (K, manifold.dim, manifold.tangent_size), (K,))
    alike = all(t.device.type == "cpu" and t.dtype == x.dtype for t in tensors)
    return alike and x.dtype in DTYPES and all(t.shape == shape for t, shape in zip(tensors, shapes, strict=True))


DTYPES = {torch.float64: ("", np.float64), torch.float32: ("_f", np.float32)}


class SplatKernel:
    """The two C functions of a manifold, called with the points shared among torch's number of threads."""

    def __init__(self, manifold: Manifold, folder: Path) -> None:
        files = {path.name: path.read_text(encoding="utf-8") for path in folder.glob("*.[ch]")}
        self.name = folder.name
        self.tangent_size = manifold.tangent_size
        self.library = compiled(files, f"{self.name}_splats.c", FAST)
        self.pool: ThreadPoolExecutor | None = None
        self.pool_of = (0, 0)  # the process and the number of threads of the pool

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
        if self.pool is None or self.pool_of != (os.getpid(), threads):  # threads do not survive a fork
            self.pool, self.pool_of = ThreadPoolExecutor(threads), (os.getpid(), threads)
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
        ctx.kernel = kernel
        ctx.save_for_backward(x, mu, W, amplitude)  # autograd notices when one is changed before the backward pass
        value, gradient = kernel.forward(*map(_array, (x, mu, W, amplitude)))
        return torch.from_numpy(value), torch.from_numpy(gradient)

    @staticmethod
    @torch.autograd.function.once_differentiable
    def backward(ctx: Any, value_bar: Tensor, gradient_bar: Tensor) -> tuple[Any, ...]:
        sums = ctx.kernel.vjp(*map(_array, (*ctx.saved_tensors, value_bar, gradient_bar)))
        return None, None, *(torch.from_numpy(s) for s in sums)


def _array(tensor: Tensor) -> Any:
    return tensor.detach().contiguous().numpy()
