"""The functions of vectors in generated C against 40 digits, in both precisions, as vectors and as single numbers."""

from __future__ import annotations

import ctypes
import os
import shlex
import subprocess
from collections.abc import Callable
from functools import cache
from typing import Any

import mpmath as mp
import numpy as np
import pytest
from compiled import needs_compiler

from rsrm_gen.compiler.emit.c_precision import DOUBLE, FLOAT, PRECISIONS, Precision
from rsrm_gen.compiler.emit.c_vector import BASICS, TYPES, spelled
from rsrm_gen.compiler.emit.c_vector_math import ORDER, functions

TYPE = {DOUBLE: np.float64, FLOAT: np.float32}
UNITS = 4.0  # in the last place
HEAD = "#include <math.h>\n#include <stddef.h>\n#include <stdint.h>\n#include <string.h>\n"
RUN = """
void run_{name}@(T_*x, const T_*y, size_t n) {{
    (void)y;
    for (size_t i = 0; i < n; i += LANES@) vector_store@(x + i, {name}_each@({arguments}));
}}"""
FLAGS = ("-O2", "-ffp-contract=fast", "-fno-math-errno", "-fno-trapping-math", "-Wall", "-Wextra", "-Werror")
NATIVE = ("-march=native",)
MACHINES = {"native": NATIVE, "baseline": (), "numbers": ("-DRSRM_NO_VECTORS",)}
FUNCTIONS = [name for name in ORDER if name not in ("bits", "signed", "expm1", "log1p")]


@pytest.fixture(scope="module")
def libraries(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], ctypes.CDLL]:
    """All functions in both precisions, compiled for a machine."""
    folder = tmp_path_factory.mktemp("vectors")

    @cache
    def library(machine: str) -> ctypes.CDLL:
        parts = [HEAD, TYPES]
        for precision in PRECISIONS:
            parts += [spelled(BASICS, precision), *functions(ORDER, precision)]
            for name in FUNCTIONS:
                arguments = "vector_load@(x + i)" + (", vector_load@(y + i)" if name == "atan2" else "")
                parts.append(spelled(RUN.format(name=name, arguments=arguments), precision))
        (folder / "vectors.c").write_text("\n".join(parts), encoding="utf-8")
        cc = shlex.split(os.environ.get("CC") or "cc")
        command = [*cc, "-std=c99", *FLAGS, *MACHINES[machine], "-fPIC", "-shared", "vectors.c", "-o", f"{machine}.so"]
        subprocess.run([*command, "-lm"], cwd=folder, check=True)
        return ctypes.CDLL(str(folder / f"{machine}.so"))

    return library


def run(library: ctypes.CDLL, name: str, precision: Precision, *arguments: Any) -> Any:
    """A function of equally many numbers."""
    arrays = [np.resize(np.asarray(a, TYPE[precision]), -(-len(a) // 16) * 16) for a in arguments]
    found, other = arrays[0].copy(), arrays[-1]
    function = getattr(library, f"run_{name}{precision.tag}")
    function(*(ctypes.c_void_p(a.ctypes.data) for a in (found, other)), ctypes.c_size_t(len(found)))
    return found[: len(arguments[0])]


def samples(name: str, precision: Precision) -> Any:
    """Arguments of all sizes that a function takes."""
    rng = np.random.default_rng(7)
    top = 80.0 if precision is FLOAT else 700.0
    sizes = np.exp(rng.uniform(-30, 30, 600)) * rng.choice([-1.0, 1.0], 600)
    if name in ("exp", "sinh", "cosh"):
        return np.concatenate([rng.uniform(-top, top, 600), rng.uniform(-2, 2, 600), np.exp(rng.uniform(-30, 0, 99))])
    if name == "gaussian":
        return np.concatenate([rng.uniform(0, 2 * top, 600), rng.uniform(0, 4, 600), np.exp(rng.uniform(-30, 0, 99))])
    if name == "round":
        return sizes[abs(sizes) < (2.0**22 if precision is FLOAT else 2.0**51)]
    if name in ("log", "sqrt"):
        return np.concatenate([abs(sizes), rng.uniform(0.5, 2, 600)])
    if name == "acosh":
        return 1 + abs(sizes)
    if name in ("acos", "atanh"):
        return np.concatenate([rng.uniform(-1, 1, 600), sizes[abs(sizes) < 1]])
    if name in ("sin", "cos", "tan"):
        near = np.arange(-60, 61) * np.pi / 2  # where one of them is nearly zero
        return np.concatenate([near, rng.uniform(-10, 10, 600), sizes[abs(sizes) < 1e8]])
    return np.concatenate([sizes, rng.uniform(-3, 3, 600)])


EXACT = {"abs": mp.fabs, "round": mp.nint, "gaussian": lambda s: mp.exp(-s / 2)}


@needs_compiler
@pytest.mark.parametrize("machine", MACHINES)
@pytest.mark.parametrize("precision", PRECISIONS, ids=lambda p: p.type)
@pytest.mark.parametrize("name", FUNCTIONS)
def test_functions_are_exact_to_a_few_units(
    name: str, precision: Precision, machine: str, libraries: Callable[[str], ctypes.CDLL]
) -> None:
    x = samples(name, precision).astype(TYPE[precision])
    others = [np.random.default_rng(8).permutation(x)] if name == "atan2" else []
    found = run(libraries(machine), name, precision, x, *others)
    with mp.workdps(40):
        function = EXACT.get(name) or getattr(mp, name)
        exact = [function(*(mp.mpf(float(a)) for a in row)) for row in zip(x, *others, strict=True)]
        least = mp.mpf(float(np.finfo(TYPE[precision]).tiny)) * 2
        units = [float(abs(mp.mpf(float(a)) - b) / (abs(b) + least)) for a, b in zip(found, exact, strict=True)]
    worst = int(np.argmax(units))
    assert units[worst] <= UNITS * np.finfo(TYPE[precision]).eps / 2, (
        x[worst],
        [o[worst] for o in others],
        found[worst],
    )


ENDS = {
    "exp": [(0, 1), (-np.inf, 0), (np.inf, np.inf), (1e4, np.inf), (-1e4, 0)],
    "gaussian": [(0, 1), (np.inf, 0), (1e4, 0), (1e30, 0)],
    "round": [(0, 0), (np.inf, np.inf), (-np.inf, -np.inf), (2.5, 2), (-3.5, -4)],
    "log": [(0, -np.inf), (np.inf, np.inf), (-1, np.nan), (1, 0)],
    "sqrt": [(0, 0), (np.inf, np.inf), (-1, np.nan)],
    "sin": [(0, 0), (np.inf, np.nan)],
    "cos": [(0, 1), (np.inf, np.nan)],
    "sinh": [(np.inf, np.inf), (-np.inf, -np.inf), (0, 0)],
    "cosh": [(np.inf, np.inf), (-np.inf, np.inf), (0, 1)],
    "tanh": [(np.inf, 1), (-np.inf, -1), (0, 0)],
    "asinh": [(np.inf, np.inf), (-np.inf, -np.inf), (0, 0)],
    "acosh": [(1, 0), (np.inf, np.inf), (0, np.nan)],
    "atanh": [(1, np.inf), (-1, -np.inf), (2, np.nan), (0, 0)],
}


@needs_compiler
@pytest.mark.parametrize("machine", MACHINES)
@pytest.mark.parametrize("precision", PRECISIONS, ids=lambda p: p.type)
@pytest.mark.parametrize("name", ENDS)
def test_functions_have_their_limits(
    name: str, precision: Precision, machine: str, libraries: Callable[[str], ctypes.CDLL]
) -> None:
    x, expected = np.array([*ENDS[name], (np.nan, np.nan)]).T
    np.testing.assert_array_equal(run(libraries(machine), name, precision, x), expected.astype(TYPE[precision]))


@needs_compiler
@pytest.mark.parametrize("machine", MACHINES)
@pytest.mark.parametrize("precision", PRECISIONS, ids=lambda p: p.type)
def test_atan2_knows_its_octants_and_signs(
    precision: Precision, machine: str, libraries: Callable[[str], ctypes.CDLL]
) -> None:
    values = [0.0, -0.0, 1.0, -1.0, 2.0, -3.0, np.inf, -np.inf]
    y, x = (a.ravel().astype(TYPE[precision]) for a in np.meshgrid(values, values))
    found, expected = run(libraries(machine), "atan2", precision, y, x), np.arctan2(y, x)
    np.testing.assert_allclose(found, expected, rtol=2 * np.finfo(TYPE[precision]).eps)
    assert np.array_equal(np.signbit(found), np.signbit(expected))
    assert np.all(np.isnan(run(libraries(machine), "atan2", precision, [np.nan, 1.0], [1.0, np.nan])))
