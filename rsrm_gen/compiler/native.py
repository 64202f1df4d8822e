"""Generated C, compiled once per content into shared libraries."""

from __future__ import annotations

import ctypes
import hashlib
import os
import platform
import shlex
import shutil
import subprocess
import tempfile
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from rsrm_gen.compiler.budget import HINT, seconds_left
from rsrm_gen.errors import UserError
from rsrm_gen.files import cache_folder

COMMON = ("-std=c99", "-Wall", "-Wextra", "-Werror", "-fPIC", "-shared")
EXACT = ("-O0", "-ffp-contract=off")  # what the audit measures: no code that a flag could have made better or worse
QUICK = (
    "-march=native",
    "-ffp-contract=fast",
    "-fno-math-errno",
    "-fno-trapping-math",
)  # never -ffast-math, which reorders sums and forgets NaN; and with threads, where the compiler has OpenMP
FAST = ("-O3", *QUICK)  # what trains
TRIED = ("-Og", *QUICK)  # the same for the audit, products fused alike, compiled in a third of the time
OPENMP = ("-fopenmp",)
# What is independent among a pair's hundred operations is mixed before registers are given out.
SCHEDULED = ("-fschedule-insns", "-fsched-pressure")
WHERE_KNOWN: dict[tuple[str, ...], tuple[tuple[str, ...], ...]] = {
    FAST: (SCHEDULED, OPENMP),
    TRIED: (OPENMP,),
}  # flags that not every compiler has


@lru_cache
def compiler() -> tuple[str, ...] | None:
    """The C compiler of this machine with its own arguments (`CC`, or cc), or None."""
    command = shlex.split(os.environ.get("CC") or "cc")
    return tuple(command) if command and shutil.which(command[0]) else None


def compiled(files: Mapping[str, str], source: str, flags: tuple[str, ...], *macros: str) -> ctypes.CDLL:
    """One of some C files as a library, compiled unless the same text was compiled before with the same flags."""
    cc = compiler()
    if cc is None:
        raise UserError("no C compiler found", hint="install one, or name it in CC; torch code needs none")
    known = (flag for some in WHERE_KNOWN.get(flags, ()) if _takes(cc, *some) for flag in some)
    flags = (*flags, *known, *(f"-D{macro}" for macro in macros))
    headers = [text for name, text in sorted(files.items()) if name.endswith(".h")]
    key = "\0".join([*cc, *COMMON, *flags, _processor(), source, files[source], *headers])
    name = Path(source).stem + "-" + hashlib.sha256(key.encode()).hexdigest()[:32] + ".so"
    path = cache_folder() / "native" / name
    if not path.exists():
        try:
            _compile(cc, files, source, flags, path)
        except OSError as error:
            hint = "set RSRM_GEN_CACHE to a folder that can be written"
            raise UserError(f"cannot compile into {path.parent}: {error.strerror}", hint=hint) from None
    return ctypes.CDLL(str(path))


def _compile(cc: tuple[str, ...], files: Mapping[str, str], source: str, flags: tuple[str, ...], path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=path.parent) as folder:
        for file, text in files.items():
            (Path(folder) / file).write_text(text, encoding="utf-8")
        command = [*cc, *COMMON, *flags, source, "-o", "library.so", "-lm"]
        try:
            result = subprocess.run(
                command, cwd=folder, capture_output=True, text=True, check=False, timeout=seconds_left()
            )
        except subprocess.TimeoutExpired:
            raise UserError(f"the C compiler takes too long over the generated {source}", hint=HINT) from None
        if result.returncode:
            raise UserError(f"the C compiler refuses the generated {source}:\n{result.stderr}")
        os.replace(Path(folder) / "library.so", path)  # whole or not at all, also when two processes do it at once


@lru_cache
def _takes(cc: tuple[str, ...], *flags: str) -> bool:
    """Whether the compiler makes a library with some flags: it may know OpenMP and yet lack its library."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "empty.c").write_text("extern int nothing;\n", encoding="utf-8")
        command = [*cc, *COMMON, *flags, "empty.c", "-o", "library.so"]
        return not subprocess.run(command, cwd=folder, capture_output=True, check=False).returncode


@lru_cache
def _processor() -> str:
    """What -march=native depends on: a cache may be shared by different machines."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return platform.machine() + platform.processor()
    return next((line for line in lines if line.startswith(("flags", "Features"))), platform.machine())


def vector_unit() -> str:
    """The vector instructions that code for this machine uses."""
    flags = _processor().split()
    names = {"avx512f": "AVX-512", "avx2": "AVX2", "avx": "AVX", "sve": "SVE", "asimd": "NEON", "sse2": "SSE2"}
    return next((name for flag, name in names.items() if flag in flags), platform.machine())


def scratch(library: ctypes.CDLL, name: str, points: int, splats: int, threads: int, dtype: Any) -> Any:
    """The scratch memory that the sums of splats of a manifold's library want."""
    function = getattr(library, f"{name}_splats_work" + ("_f" if dtype == np.float32 else ""))
    function.restype, function.argtypes = ctypes.c_size_t, (ctypes.c_size_t, ctypes.c_size_t, ctypes.c_int)
    return np.empty(function(points, splats, threads), dtype)


def pointer(array: Any) -> ctypes.c_void_p:
    """The address of a contiguous numpy array's numbers; NULL for None."""
    if array is None:
        return ctypes.c_void_p()
    assert isinstance(array, np.ndarray)
    assert array.flags.c_contiguous
    return array.ctypes.data_as(ctypes.c_void_p)
