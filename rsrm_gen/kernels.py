"""Sums of splats by the generated C on CPU tensors: one pass forward, one backward, nothing of size N x K stored.

The C code is compiled for this machine on first use. Other devices, points that need a gradient themselves, and
machines without a C compiler use the generated torch code, which gives the same numbers.

    accelerated    a manifold whose sums run in C where they can
    SplatKernel    the C functions, called with the addresses of tensors
    _Splats        them under autograd
    _OPERATIONS    them as operations `rsrm_gen::splats` and so on, which torch.compile and torch.export see as one node
"""

from __future__ import annotations

import ctypes
import hashlib
import logging
import os
import threading
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import torch
from torch import Tensor, nn
from torch.utils._python_dispatch import is_in_torch_dispatch_mode

from rsrm_gen.compiler.native import FAST, compiled, vector_unit
from rsrm_gen.errors import UserError
from rsrm_gen.manifold import Manifold

DTYPES = {torch.float64: "", torch.float32: "_f"}  # to the ending of the C functions' names
ONLY = {torch.float64: "RSRM_ONLY_DOUBLE", torch.float32: "RSRM_ONLY_FLOAT"}  # the other is compiled when it is wanted
WORTH_A_THREAD = 2**15  # pairs of a point and a splat
WORTH_A_LOOK = 2**16  # of them, below which nobody asks how many are far apart
WORTH_CULLING = 0.7  # the part of the pairs that are near up to which it is faster to leave out the others

log = logging.getLogger("rsrm_gen")


def accelerated(manifold: Manifold, folder: Path, always: bool = False, culling: str = "auto") -> Manifold:
    """The same manifold, its sums of splats by the C kernel in `folder`; the compiler runs when one is first called.

    What C cannot do is done in torch, or is a `UserError` if C is wanted `always`. `culling` says whether pairs too far apart
    to count are left out of sums that are given widths: "on", "off", or "auto", which is where it pays.
    """
    kernel = SplatKernel(manifold, folder, culling)
    generated = type(manifold)

    class Accelerated(generated):  # type: ignore[misc,valid-type]
        sums = kernel

        def splats(
            self, x: Tensor, mu: Tensor, W: Tensor, amplitude: Tensor, width: Tensor | None = None
        ) -> tuple[Tensor, Tensor]:
            if self._runs_in_c(x, mu, W, amplitude):
                return kernel.splats(x, mu, W, amplitude, width=width)
            value, gradient = super().splats(x, mu, W, amplitude)
            return value, gradient

        def splats_value(self, x: Tensor, mu: Tensor, W: Tensor, amplitude: Tensor) -> Tensor:
            if self._runs_in_c(x, mu, W, amplitude):
                return kernel.splats_value(x, mu, W, amplitude)
            value: Tensor = super().splats_value(x, mu, W, amplitude)
            return value

        def splats_rows(
            self, x: Tensor, mu: Tensor, W: Tensor, amplitude: Tensor, value_bar: Tensor, gradient_bar: Tensor
        ) -> Tensor:
            tensors = x, mu, W, amplitude, value_bar, gradient_bar
            if self._runs_in_c(x.detach(), *tensors[1:]):
                return kernel.splats_rows(*tensors)
            rows: Tensor = super().splats_rows(*tensors)
            return rows

        def kernels(self, like: Tensor) -> str:
            reason = kernel.unfit(like)
            return f"{super().kernels(like)} ({reason})" if reason else kernel.described()

        def _runs_in_c(self, *tensors: Tensor) -> bool:
            """Whether C sums these; else the log says once why not, or that is an error."""
            if not kernel.fits(tensors):
                return False  # in torch, which says what is wrong
            reason = kernel.unfit(*tensors)
            if reason is None:
                return True
            if always:
                hint = "`auto` lets torch sum what C cannot"
                raise UserError(f"{self.name}: C is wanted for sums of splats, but {reason}", hint=hint)
            kernel.say(f"torch, {reason}")
            return False

    for name in ("splats", "splats_value", "splats_rows", "kernels"):
        getattr(Accelerated, name).__doc__ = getattr(generated, name).__doc__
    Accelerated.__name__ = generated.__name__
    Accelerated.__qualname__ = generated.__qualname__
    return Accelerated()


class SplatKernel:
    """The C functions of a manifold, called with as many threads as torch would take. Safe to call from any thread."""

    def __init__(self, manifold: Manifold, folder: Path, culling: str = "auto") -> None:
        self.name = folder.name
        self.culling = culling
        self.sizes = manifold.point_size, manifold.dim, manifold.tangent_size
        self.files = {path.name: path.read_text(encoding="utf-8") for path in folder.glob("*.[ch]")}
        self.key = f"{self.name}_{hashlib.sha256(self.files[self.source].encode()).hexdigest()[:16]}"
        self.functions: dict[tuple[str, torch.dtype], Any] = {}
        self.compiling = threading.Lock()
        self.scratch = threading.local()  # memory of each calling thread
        self.said: set[str] = set()
        self.decided: set[bool] = set()  # whether the log has said that far pairs were left out, and that they were not
        _KERNELS[self.key] = self

    @property
    def source(self) -> str:
        """The C file."""
        return f"{self.name}_splats.c"

    def described(self) -> str:
        """What runs, for people."""
        count = torch.get_num_threads()
        return f"C, {vector_unit()}, {count} thread{'s' if count > 1 else ''}"

    def say(self, what: str) -> None:
        """Log what computes the sums, once each; nothing while torch traces."""
        if not torch.compiler.is_compiling() and what not in self.said:
            self.said.add(what)
            log.info("%s: sums of splats by %s", self.name, what)

    def fits(self, tensors: tuple[Tensor, ...]) -> bool:
        """Whether x, mu, W, amplitude and what belongs to x have the shapes that are said, not merely broadcast to them."""
        x, mu, W, amplitude = tensors[:4]
        D, d, T = self.sizes
        if x.dim() != 2 or mu.dim() != 2:
            return False
        N, K = x.shape[0], mu.shape[0]
        same = x.shape[1] == D and mu.shape[1] == D and W.shape == (K, d, T) and amplitude.shape == (K,)
        return same and (len(tensors) == 4 or (tensors[4].shape == (N,) and tensors[5].shape == (N, T)))

    def unfit(self, x: Tensor, *others: Tensor) -> str | None:
        """Why C cannot take these tensors, if so."""
        if x.dtype not in DTYPES:
            return f"x is {_plain(x.dtype)} and C has float32 and float64"
        if not x.is_cpu:
            return f"x is on {x.device} and C runs on the CPU"
        if x.requires_grad and torch.is_grad_enabled():
            return "x requires a gradient, which C does not give"
        for tensor in others:
            if tensor.dtype is not x.dtype:
                return f"{_plain(x.dtype)} and {_plain(tensor.dtype)} are mixed"
            if not tensor.is_cpu:
                return f"x is on the CPU and another tensor on {tensor.device}"
        return None

    def splats(self, *tensors: Tensor, width: Tensor | None = None) -> tuple[Tensor, Tensor]:
        """Values (N,) and gradients (N, T); with widths (K,) without far pairs where that pays, but not while traced."""
        result: tuple[Tensor, Tensor]
        if _is_traced(tensors):
            result = torch.ops.rsrm_gen.splats(self.key, *tensors)
        elif _wants_gradient(tensors):
            result = _Splats.apply(self, self.near(*tensors, width=width), *tensors)  # type: ignore[no-untyped-call]
        else:
            result = self.forward(*tensors, near=self.near(*tensors, width=width))
        return result

    def near(self, x: Tensor, mu: Tensor, W: Tensor, amplitude: Tensor, *, width: Tensor | None) -> Near | None:
        """How far pairs are left out; None where that does not pay, or nobody knows how wide the splats are.

        It follows from the tensors alone, whatever was summed before and however many threads there are.
        """
        if width is None or self.culling == "off" or (self.culling == "auto" and len(x) * len(mu) < WORTH_A_LOOK):
            return None
        if width.shape != amplitude.shape:
            raise ValueError(
                f"width has shape {tuple(width.shape)}; with {len(mu)} splats it is {tuple(amplitude.shape)}"
            )
        width = width.detach().to(x).contiguous()
        limit = 1.0 if self.culling == "on" else WORTH_CULLING
        share, order = self.ordered(x, mu, amplitude, width, limit)
        culls = share <= limit
        if culls not in self.decided:
            self.decided.add(culls)
            pairs = f"about {share:.0%} of the pairs, the near ones" if culls else "all pairs, near and far"
            log.info("%s: sums of splats over %s", self.name, pairs)
        return Near(width, order) if culls else None

    def ordered(self, x: Tensor, mu: Tensor, amplitude: Tensor, width: Tensor, limit: float) -> tuple[float, Tensor]:
        """The C function `splats_order`: about which part of the pairs is near, and the order of the points (N,) for that."""
        rows = [tensor.detach().contiguous() for tensor in (x, mu, amplitude, width)]
        order = torch.empty(x.shape[0], dtype=torch.int64)
        work = self.work(x.dtype, x.shape[0], mu.shape[0], 1)
        addresses = [tensor.data_ptr() for tensor in rows]
        function = self.function("splats_order", x.dtype)
        share: float = function(x.shape[0], mu.shape[0], *addresses, limit, order.data_ptr(), work.data_ptr())
        return share, order

    def splats_value(self, *tensors: Tensor) -> Tensor:
        """Values (N,)."""
        result: Tensor
        if _is_traced(tensors):
            result = torch.ops.rsrm_gen.splats_value(self.key, *tensors)
        elif _wants_gradient(tensors):
            result = _Value.apply(self, *tensors)  # type: ignore[no-untyped-call]
        else:
            result = self.value(*tensors)
        return result

    def splats_rows(self, *tensors: Tensor) -> Tensor:
        """Rows (N, K, D + d T + 1)."""
        if _is_traced(tensors):
            result: Tensor = torch.ops.rsrm_gen.splats_rows(self.key, *(t.detach() for t in tensors))
            return result
        return self.rows(*tensors)

    def forward(
        self, x: Tensor, mu: Tensor, W: Tensor, amplitude: Tensor, *, near: Near | None = None
    ) -> tuple[Tensor, Tensor]:
        """The C function `splats`."""
        results = x.new_empty(x.shape[0]), x.new_empty(x.shape[0], self.sizes[2])
        if near is None:
            self.call("splats", (x, mu, W, amplitude, None), results)
            return results
        self.call("splats", (x[near.order], mu, W, amplitude, near.width), results)
        return near.put_back(results[0]), near.put_back(results[1])

    def value(self, x: Tensor, mu: Tensor, W: Tensor, amplitude: Tensor) -> Tensor:
        """The C function `splats_value`."""
        result = x.new_empty(x.shape[0])
        self.call("splats_value", (x, mu, W, amplitude, None), (result,))
        return result

    def vjp(
        self,
        x: Tensor,
        mu: Tensor,
        W: Tensor,
        amplitude: Tensor,
        value_bar: Tensor,
        gradient_bar: Tensor,
        *,
        near: Near | None = None,
    ) -> tuple[Tensor, Tensor, Tensor]:
        """The C function `splats_vjp`."""
        results = mu.new_empty(mu.shape), W.new_empty(W.shape), amplitude.new_empty(amplitude.shape)
        width = None
        if near is not None:
            x, value_bar, gradient_bar = (tensor[near.order] for tensor in (x, value_bar, gradient_bar))
            width = near.width
        self.call("splats_vjp", (x, mu, W, amplitude, width, value_bar, gradient_bar), results)
        return results

    def rows(
        self, x: Tensor, mu: Tensor, W: Tensor, amplitude: Tensor, value_bar: Tensor, gradient_bar: Tensor
    ) -> Tensor:
        """The C function `splats_rows`."""
        result = x.new_empty(_rows_shape(x, mu, W))
        self.call("splats_rows", (x, mu, W, amplitude, value_bar, gradient_bar), (result,))
        return result

    def call(self, name: str, inputs: tuple[Tensor | None, ...], results: tuple[Tensor, ...]) -> None:
        """One C function, which fills the results; None is NULL. ctypes lets other Python threads run meanwhile."""
        x, mu = inputs[:2]
        assert x is not None
        assert mu is not None
        dtype, points, splats = x.dtype, x.shape[0], mu.shape[0]
        threads = _threads(points * splats)
        rows = [None if tensor is None else tensor.contiguous() for tensor in inputs]  # kept until C is done with them
        work = self.work(dtype, points, splats, threads)
        addresses = [None if tensor is None else tensor.data_ptr() for tensor in (*rows, *results, work)]
        self.function(name, dtype)(points, splats, *addresses, threads)

    def work(self, dtype: torch.dtype, points: int, splats: int, threads: int) -> Any:
        """Scratch memory for C, this thread's own, as large as it ever was needed."""
        own = self.scratch.__dict__
        last, work = own.get(DTYPES[dtype], (None, None))
        if last == (points, splats, threads):
            return work
        size = self.function("splats_work", dtype)(points, splats, threads)
        if work is None or work.numel() < size:
            work = torch.empty(size, dtype=dtype)
        own[DTYPES[dtype]] = (points, splats, threads), work
        return work

    def function(self, name: str, dtype: torch.dtype) -> Any:
        """A C function with the types of its arguments."""
        found = self.functions.get((name, dtype))
        if found is None:
            self.say(self.described())
            self.compile(dtype)
            found = self.functions[name, dtype]
        return found

    def compile(self, dtype: torch.dtype) -> None:
        """Compile the C code of a precision, or take what was compiled before."""
        ending, macro = DTYPES[dtype], ONLY[dtype]
        with self.compiling:
            library = compiled(self.files, self.source, FAST, macro)
            size, pointer, number = ctypes.c_size_t, ctypes.c_void_p, ctypes.c_int
            for name, pointers in _POINTERS.items():
                function = getattr(library, f"{self.name}_{name}{ending}")
                function.argtypes = [size, size, *[pointer] * pointers, number]
                function.restype = None if pointers else size
                self.functions[name, dtype] = function
            function = getattr(library, f"{self.name}_splats_order{ending}")
            function.argtypes = [size, size, *[pointer] * 4, ctypes.c_double, pointer, pointer]
            function.restype = ctypes.c_double
            self.functions["splats_order", dtype] = function


@dataclass(frozen=True)
class Near:
    """What leaves far pairs out: how wide splats are (K,), and an order of the points (N,) in which neighbours are near."""

    width: Tensor
    order: Tensor

    def put_back(self, rows: Tensor) -> Tensor:
        """Rows in that order, as the points were."""
        return torch.empty_like(rows).index_copy_(0, self.order, rows)


# The C functions, and how many addresses each takes.
_POINTERS = {"splats_work": 0, "splats": 8, "splats_value": 7, "splats_vjp": 11, "splats_rows": 8}
_KERNELS: dict[str, SplatKernel] = {}  # by the keys that operations name them by


def _kernel(key: str) -> SplatKernel:
    if key not in _KERNELS:
        raise UserError(f"the kernel {key} is not loaded", hint="`rsrm_gen.load` its manifold first")
    return _KERNELS[key]


def _plain(dtype: torch.dtype) -> str:
    return str(dtype).removeprefix("torch.")


def _wants_gradient(tensors: tuple[Tensor, ...]) -> bool:
    return torch.is_grad_enabled() and any(tensor.requires_grad for tensor in tensors)


def _is_traced(tensors: tuple[Tensor, ...]) -> bool:
    """Whether somebody must see operations of torch: its compiler, a tensor that is not one of numbers."""
    if torch.compiler.is_compiling() or is_in_torch_dispatch_mode():
        return True
    return any(type(tensor) not in (Tensor, nn.Parameter) for tensor in tensors)


class _Process:
    """Threads of OpenMP do not survive a fork: whoever had some leaves a child that can have none."""

    had_threads = False
    may_have_threads = True

    @classmethod
    def forked(cls) -> None:
        """In the child."""
        cls.may_have_threads = not cls.had_threads


os.register_at_fork(after_in_child=_Process.forked)


def _threads(pairs: int) -> int:
    """As many as torch would take, if they are worth starting."""
    if pairs < WORTH_A_THREAD or not _Process.may_have_threads:
        return 1
    threads = torch.get_num_threads()
    _Process.had_threads |= threads > 1
    return threads


def _rows_shape(x: Tensor, mu: Tensor, W: Tensor) -> tuple[int, ...]:
    return x.shape[0], mu.shape[0], mu.shape[1] + W.shape[1] * W.shape[2] + 1


class _Splats(torch.autograd.Function):
    """The kernel under autograd; differentiable once, in mu, W and amplitude."""

    @staticmethod
    def forward(ctx: Any, kernel: SplatKernel, near: Near | None, *tensors: Tensor) -> tuple[Tensor, Tensor]:
        """Values and gradients."""
        ctx.kernel, ctx.near = kernel, near
        ctx.save_for_backward(*tensors)  # autograd notices when one is changed before the backward pass
        return kernel.forward(*tensors, near=near)

    @staticmethod
    def backward(ctx: Any, value_bar: Tensor, gradient_bar: Tensor) -> tuple[Tensor | None, ...]:
        """The derivatives in mu, W and amplitude."""
        return None, *_derivatives(ctx.kernel, ctx.near, *ctx.saved_tensors, value_bar, gradient_bar)


class _Value(torch.autograd.Function):
    """The value alone."""

    @staticmethod
    def forward(ctx: Any, kernel: SplatKernel, *tensors: Tensor) -> Tensor:
        """Values."""
        ctx.kernel = kernel
        ctx.save_for_backward(*tensors)
        return kernel.value(*tensors)

    @staticmethod
    def backward(ctx: Any, value_bar: Tensor) -> tuple[Tensor | None, ...]:
        """The derivatives in mu, W and amplitude."""
        x, mu, W, amplitude = ctx.saved_tensors
        return _derivatives(ctx.kernel, None, x, mu, W, amplitude, value_bar, x.new_zeros(x.shape[0], W.shape[2]))


def _derivatives(kernel: SplatKernel, near: Near | None, *tensors: Tensor) -> tuple[Tensor | None, ...]:
    """Of kernel, x, mu, W and amplitude."""
    if torch.is_grad_enabled():
        return None, None, *_Backward.apply(kernel, near, *tensors)  # type: ignore[no-untyped-call]
    return None, None, *kernel.vjp(*tensors, near=near)


class _Backward(torch.autograd.Function):
    """The backward pass where somebody might differentiate it again, which is an error."""

    @staticmethod
    def forward(ctx: Any, kernel: SplatKernel, near: Near | None, *tensors: Tensor) -> tuple[Tensor, Tensor, Tensor]:
        """The derivatives in mu, W and amplitude."""
        return kernel.vjp(*tensors, near=near)

    @staticmethod
    def backward(ctx: Any, *bars: Tensor) -> Any:
        """None."""
        raise RuntimeError("`splats` has first derivatives only; of `splat`, autograd knows all")


# Operations: what they take and give, what they do, and what their results look like without doing it.
_SPLATS = "str kernel, Tensor x, Tensor mu, Tensor W, Tensor amplitude"
_BARS = "Tensor value_bar, Tensor gradient_bar"
_OPERATIONS: dict[str, tuple[str, Any, Any]] = {
    "splats": (
        f"({_SPLATS}) -> (Tensor, Tensor)",
        lambda kernel, *tensors: _kernel(kernel).forward(*tensors),
        lambda kernel, x, mu, W, amplitude: (x.new_empty(x.shape[0]), x.new_empty(x.shape[0], W.shape[2])),
    ),
    "splats_value": (
        f"({_SPLATS}) -> Tensor",
        lambda kernel, *tensors: _kernel(kernel).value(*tensors),
        lambda kernel, x, mu, W, amplitude: x.new_empty(x.shape[0]),
    ),
    "splats_vjp": (
        f"({_SPLATS}, {_BARS}) -> (Tensor, Tensor, Tensor)",
        lambda kernel, *tensors: _kernel(kernel).vjp(*tensors),
        lambda kernel, x, *splat: tuple(tensor.new_empty(tensor.shape) for tensor in splat[:3]),
    ),
    "splats_rows": (
        f"({_SPLATS}, {_BARS}) -> Tensor",
        lambda kernel, *tensors: _kernel(kernel).rows(*tensors),
        lambda kernel, x, mu, W, *rest: x.new_empty(_rows_shape(x, mu, W)),
    ),
}


def _remember(ctx: Any, inputs: tuple[Any, ...], output: Any) -> None:
    ctx.kernel = inputs[0]
    ctx.save_for_backward(*inputs[1:])


def _splats_backward(ctx: Any, value_bar: Tensor, gradient_bar: Tensor) -> tuple[Tensor | None, ...]:
    return None, None, *torch.ops.rsrm_gen.splats_vjp(ctx.kernel, *ctx.saved_tensors, value_bar, gradient_bar)


def _value_backward(ctx: Any, value_bar: Tensor) -> tuple[Tensor | None, ...]:
    x, _, W, _ = ctx.saved_tensors
    return _splats_backward(ctx, value_bar, x.new_zeros(x.shape[0], W.shape[2]))


def _register() -> None:
    for name, (schema, run, fake) in _OPERATIONS.items():
        operation = torch.library.custom_op(
            f"rsrm_gen::{name}", run, mutates_args=(), device_types="cpu", schema=schema
        )
        operation.register_fake(fake)
        if name == "splats":
            operation.register_autograd(_splats_backward, setup_context=_remember)
        elif name == "splats_value":
            operation.register_autograd(_value_backward, setup_context=_remember)


_register()
