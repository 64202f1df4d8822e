"""Sums of splats by the generated C on CPU tensors: one pass forward, one backward, nothing of size N x K stored.

The C code is compiled for this machine on first use. Other devices, points that need a gradient themselves, and
machines without a C compiler use the generated torch code, which gives the same numbers.
"""

from __future__ import annotations

import ctypes
from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import Tensor

from rsrm_gen.compiler.native import FAST, compiled, pointer, scratch
from rsrm_gen.manifold import Manifold


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
    """The C functions of a manifold, called with as many threads as torch would take."""

    def __init__(self, manifold: Manifold, folder: Path) -> None:
        files = {path.name: path.read_text(encoding="utf-8") for path in folder.glob("*.[ch]")}
        self.name = folder.name
        self.tangent_size = manifold.tangent_size
        self.library = compiled(files, f"{self.name}_splats.c", FAST)

    def forward(self, x: Any, mu: Any, W: Any, amplitude: Any) -> tuple[Any, Any]:
        """Values (N,) and gradients (N, T) from numpy arrays."""
        value = np.empty(len(x), x.dtype)
        gradient = np.empty((len(x), self.tangent_size), x.dtype)
        self.call("splats", len(x), len(mu), x, mu, W, amplitude, value, gradient)
        return value, gradient

    def vjp(self, x: Any, mu: Any, W: Any, amplitude: Any, value_bar: Any, gradient_bar: Any) -> tuple[Any, Any, Any]:
        """The derivatives in mu (K, D), W (K, d, T) and amplitude (K,)."""
        sums = np.empty_like(mu), np.empty_like(W), np.empty_like(amplitude)
        self.call("splats_vjp", len(x), len(mu), x, mu, W, amplitude, value_bar, gradient_bar, *sums)
        return sums

    def call(self, function: str, points: int, splats: int, *arrays: Any) -> None:
        """One C function."""
        dtype, threads = arrays[0].dtype, torch.get_num_threads()
        work = scratch(self.library, self.name, points, splats, threads, dtype)
        c_function = getattr(self.library, f"{self.name}_{function}" + ("_f" if dtype == np.float32 else ""))
        pointers = map(pointer, (*arrays, work))
        c_function(ctypes.c_size_t(points), ctypes.c_size_t(splats), *pointers, ctypes.c_int(threads))


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
