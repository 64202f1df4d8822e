"""A manifold's functions of points by the generated C, on CPU tensors: a call for all rows instead of one an operation.

Where a gradient is wanted, on other devices and for other dtypes, the generated torch code runs.
"""

from __future__ import annotations

import ctypes
import math
import re
import sys
from collections.abc import Callable, Iterable
from functools import cached_property
from pathlib import Path
from typing import Any

import torch
from torch import Tensor

from rsrm_gen.compiler.native import FAST, compiled
from rsrm_gen.errors import UserError
from rsrm_gen.manifold import Manifold

# By this name alone glibc's headers declare exp, atan2 and so on for vectors, wrong by less than 4 units in the last
# place; it allows the compiler nothing.
VECTOR_MATH = "-D__FAST_MATH__"

# Without the first of these gcc would neither inline what the loops over rows call, nor vectorise them.
FLAGS = (*FAST, "-fno-semantic-interposition", VECTOR_MATH)

SUFFIX = {torch.float64: "", torch.float32: "_f"}

# What the arguments and the result of a function are: a point, a tangent vector, or (the result only) a number. What
# `to_tangent` and `riemannian_gradient` take beside a point has the size of one.
SIGNATURES = {
    "exp": ("point", "tangent", "point"),
    "log": ("point", "point", "tangent"),
    "distance": ("point", "point", "number"),
    "project": ("point", "point"),
    "to_tangent": ("point", "point", "tangent"),
    "flat": ("point", "tangent", "tangent"),
    "riemannian_gradient": ("point", "point", "tangent"),
}

# What the loop over rows of such a function calls becomes part of it, however long: it could not be vectorised around
# calls. gcc and clang know the attribute.
LOOP = re.compile(rf"^(?=void \w+_({'|'.join(SIGNATURES)}|norm)_batch(_f)?\()", re.MULTILINE)
WHOLE = "__attribute__((flatten)) "


def in_rows(manifold: Manifold, folder: Path) -> Manifold:
    """The same manifold, its functions of points by the C code in `folder`; the compiler runs at the first call."""
    generated = type(manifold)
    library = _Library(manifold, folder)

    def function(name: str) -> Callable[..., Tensor]:
        by_torch = getattr(generated, name)

        def by_rows(self: Manifold, *arguments: Tensor) -> Tensor:
            result = library.call(name, arguments)
            return by_torch(self, *arguments) if result is None else result

        by_rows.__name__, by_rows.__doc__ = name, by_torch.__doc__
        return by_rows

    functions = {name: function(name) for name in SIGNATURES}
    made: Manifold = type(generated.__name__, (generated,), functions)()
    return made


def addresses(manifold: Manifold, names: Iterable[str]) -> dict[str, int]:
    """Where generated C functions of a manifold lie in memory, for C code that calls them: their addresses by name.

    The names are those in the manifold's header without its own: "exp_batch", "frame", "inner_f". The code stays in memory as
    long as the process. Raises `UserError` where there is no C compiler, and for a manifold that was not generated.
    """
    folder = _generated_folder(manifold)
    library = _compiled(folder)
    return {name: ctypes.cast(library[f"{folder.name}_{name}"], ctypes.c_void_p).value or 0 for name in names}


def _generated_folder(manifold: Manifold) -> Path:
    """Where the generated code of a manifold is, whatever it was wrapped into."""
    for cls in type(manifold).__mro__:
        file = getattr(sys.modules.get(cls.__module__), "__file__", None)
        if file and Path(file).with_suffix(".c").is_file():
            return Path(file).parent
    raise UserError(f"there is no generated C code of {manifold.name}")


def _compiled(folder: Path) -> ctypes.CDLL:
    files = {path.name: path.read_text(encoding="utf-8") for path in folder.glob("*.[ch]")}
    source = f"{folder.name}.c"
    return compiled({**files, source: LOOP.sub(WHOLE, files[source])}, source, FLAGS)


class _Library:
    """The C functions of a manifold that take rows."""

    def __init__(self, manifold: Manifold, folder: Path) -> None:
        self.folder = folder
        sizes = {"point": (manifold.point_size,), "tangent": (manifold.tangent_size,), "number": ()}
        self.shapes = {name: [sizes[kind] for kind in kinds] for name, kinds in SIGNATURES.items()}
        self.functions: dict[tuple[str, torch.dtype], Any] = {}

    @cached_property
    def library(self) -> ctypes.CDLL:
        return _compiled(self.folder)

    def function(self, name: str, dtype: torch.dtype) -> Any:
        """name(count, argument, ..., result) on addresses."""
        if (name, dtype) not in self.functions:
            function = getattr(self.library, f"{self.folder.name}_{name}_batch{SUFFIX[dtype]}")
            function.argtypes = [ctypes.c_size_t, *[ctypes.c_void_p] * len(SIGNATURES[name])]
            function.restype = None
            self.functions[name, dtype] = function
        return self.functions[name, dtype]

    def call(self, name: str, arguments: tuple[Tensor, ...]) -> Tensor | None:
        """A function of arguments whose leading dimensions broadcast; None where C cannot give it."""
        first = arguments[0]
        graph = torch.is_grad_enabled()
        *taken, given = self.shapes[name]
        leading = first.shape[:-1]
        for t, shape in zip(arguments, taken, strict=True):
            if t.dtype != first.dtype or not t.is_cpu or (graph and t.requires_grad) or t.shape[-1:] != shape:
                return None
            if t.shape[:-1] != leading:
                leading = torch.broadcast_shapes(leading, t.shape[:-1])  # type: ignore[no-untyped-call]
        if first.dtype not in SUFFIX:
            return None
        rows = [(t if t.shape[:-1] == leading else t.expand(*leading, t.shape[-1])).contiguous() for t in arguments]
        result = first.new_empty((*leading, *given))
        addresses = [t.data_ptr() for t in rows]
        self.function(name, first.dtype)(math.prod(leading), *addresses, result.data_ptr())
        return result
