"""Manifolds compiled in memory and put to use, for the tests of the compiler's stages."""

from __future__ import annotations

import ctypes
import importlib.util
import os
import shutil
import subprocess
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch

from rsrm_gen.compiler.derive import Geometry, derive
from rsrm_gen.compiler.emit import emit
from rsrm_gen.compiler.lower import Program, Routine, lower
from rsrm_gen.compiler.spec import ManifoldSpec, read_spec
from rsrm_gen.document import parse_document
from rsrm_gen.files import cache_folder, imported
from rsrm_gen.kernels import accelerated
from rsrm_gen.manifold import Manifold

torch.set_num_threads(1)

MANIFOLDS = Path(__file__).parent.parent / "manifolds"
NAMES = sorted(path.stem for path in MANIFOLDS.glob("*.yaml"))
CC = shutil.which(os.environ.get("CC") or "cc")
needs_compiler = pytest.mark.skipif(CC is None, reason="no C compiler on this machine")


def spec_of(text: str, **parameters: Any) -> ManifoldSpec:
    return read_spec(parse_document(text, "file.yaml"), parameters)


@cache
def bundled_spec(name: str, **parameters: Any) -> ManifoldSpec:
    return read_spec(MANIFOLDS / f"{name}.yaml", parameters)


@cache
def geometry(name: str, **parameters: Any) -> Geometry:
    return derive(bundled_spec(name, **parameters))


@cache
def program(name: str, **parameters: Any) -> Program:
    return lower(geometry(name, **parameters))


@cache
def files(name: str, **parameters: Any) -> Mapping[str, str]:
    return emit(geometry(name, **parameters), program(name, **parameters))


@cache
def summing(name: str, kernels: str = "c", **parameters: Any) -> Manifold:
    """A manifold whose sums of splats run in C, always, or in torch; its code is not the committed one, but today's."""
    texts = files(name, **parameters)
    folder = cache_folder() / "today" / program(name, **parameters).name
    folder.mkdir(parents=True, exist_ok=True)
    for file, text in texts.items():
        (folder / file).write_text(text, encoding="utf-8")
    manifold: Manifold = imported(folder / f"{folder.name}.py").manifold
    return manifold if kernels == "torch" else accelerated(manifold, folder, always=kernels == "c")


def torch_module(texts: Mapping[str, str], name: str, folder: Path) -> Any:
    """The generated torch module, written to a folder and imported from there."""
    path = folder / f"{name}.py"
    path.write_text(texts[path.name], encoding="utf-8")
    found = importlib.util.spec_from_file_location(f"generated_{name}", path)
    assert found is not None
    assert found.loader is not None
    module = importlib.util.module_from_spec(found)
    found.loader.exec_module(module)
    return module


def shared_library(texts: Mapping[str, str], name: str, folder: Path) -> ctypes.CDLL:
    """The generated C, compiled without a warning."""
    assert CC is not None
    for file in (f"{name}.c", f"{name}.h"):
        (folder / file).write_text(texts[file], encoding="utf-8")
    flags = ["-std=c99", "-O2", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-fPIC", "-shared"]
    made = subprocess.run(
        [CC, *flags, "-o", f"{name}.so", f"{name}.c", "-lm"], cwd=folder, capture_output=True, text=True, check=False
    )
    assert made.returncode == 0, made.stderr
    return ctypes.CDLL(str(folder / f"{name}.so"))


def call_batch(
    library: ctypes.CDLL, name: str, routine: Routine, *arguments: np.ndarray, dtype: type = np.float64
) -> list[np.ndarray]:
    """The results of a generated batch function for arguments with one row each."""
    rows = [np.ascontiguousarray(a, dtype) for a in arguments]
    count = len(rows[0])
    results = [np.empty((count, *result.shape), dtype) for result in routine.results]
    function = getattr(library, f"{name}_{routine.name}_batch" + ("_f" if dtype is np.float32 else ""))
    function.restype = None
    function(ctypes.c_size_t(count), *(ctypes.c_void_p(a.ctypes.data) for a in [*rows, *results]))
    return results
