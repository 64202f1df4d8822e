"""Generated C, compiled once per content and called from Python."""

from __future__ import annotations

import ctypes
import hashlib
import os
import shutil
import subprocess
import tempfile
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from platformdirs import user_cache_path

from rsrm_gen.compiler.lower import Program
from rsrm_gen.errors import UserError

FLAGS = ("-std=c99", "-O2", "-ffp-contract=off", "-Wall", "-Wextra", "-Werror", "-fPIC", "-shared")


def cache_folder() -> Path:
    """Where compiled code is kept; `RSRM_GEN_CACHE` overrides the platform's place."""
    return Path(os.environ.get("RSRM_GEN_CACHE") or user_cache_path("rsrm-gen"))


@lru_cache
def compiler() -> str | None:
    """The C compiler of this machine (`CC`, or cc), or None."""
    return shutil.which(os.environ.get("CC") or "cc")


def compiled(files: Mapping[str, str], program: Program) -> NativeLibrary:
    """The library of a program, compiled unless the same text was compiled before."""
    cc = compiler()
    if cc is None:
        raise UserError("no C compiler found", hint="install one, or name it in CC; torch code needs none")
    name = f"{program.name}.c"
    key = hashlib.sha256("\0".join([cc, *FLAGS, files[f"{program.name}.h"], files[name]]).encode()).hexdigest()[:32]
    path = cache_folder() / "native" / f"{program.name}-{key}.so"
    if not path.exists():
        _compile(cc, files, name, path)
    return NativeLibrary(ctypes.CDLL(str(path)), program)


def _compile(cc: str, files: Mapping[str, str], name: str, path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=path.parent) as folder:
        for file, text in files.items():
            (Path(folder) / file).write_text(text)
        result = subprocess.run([cc, *FLAGS, name, "-o", "library.so", "-lm"], cwd=folder, capture_output=True, text=True)
        if result.returncode:
            raise UserError(f"the C compiler refuses the generated {name}:\n{result.stderr}")
        os.replace(Path(folder) / "library.so", path)  # whole or not at all, also when two processes do it at once


class NativeLibrary:
    """The batch functions of a compiled program, on numpy arrays."""

    def __init__(self, library: ctypes.CDLL, program: Program) -> None:
        self.library = library
        self.program = program

    def call(self, routine_name: str, *arguments: Any, dtype: Any = np.float64) -> list[Any]:
        """A routine on arrays of rows (N, entries); its results as (N, entries)."""
        routine = self.program[routine_name]
        function = getattr(self.library, f"{self.program.name}_{routine_name}_batch" + ("_f" if dtype == np.float32 else ""))
        inputs = [np.ascontiguousarray(a, dtype=dtype) for a in arguments]
        count = len(inputs[0])
        outputs = [np.empty((count, len(result.nodes)), dtype=dtype) for result in routine.results]
        pointers = [a.ctypes.data_as(ctypes.c_void_p) for a in (*inputs, *outputs)]
        function(ctypes.c_size_t(count), *pointers)
        return outputs
