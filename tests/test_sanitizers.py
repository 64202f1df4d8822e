"""The generated C under sanitizers, at the oracle's rows and at random bytes; and in both languages by both compilers.

A driver in C is written for each manifold. It gives every function arrays of exactly the size that the header promises,
so that one number read or written too far is seen.
"""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from compiled import NAMES, files, program

from rsrm_gen.compiler.emit.c_precision import PRECISIONS, Precision
from rsrm_gen.compiler.emit.c_splats import CULLED
from rsrm_gen.compiler.emit.promises import public
from rsrm_gen.compiler.lower import Program, Routine

ROWS = 200
COUNTS = (0, 1, 63, 64, 65, ROWS)  # around the points that pass together in the sums of splats
SPLATS = (0, 1, 3)
ORACLES = {"euclidean": "R3", "sphere": "S2", "torus": "T2", "hyperbolic": "H2", "so3": "SO3_quat"}
SANITIZE = ("-fsanitize=address,undefined,float-cast-overflow", "-fno-sanitize-recover=all")
STRICT = ("-Wall", "-Wextra", "-Werror", "-pedantic")
TYPES = {"double": np.float64, "float": np.float32}

PREAMBLE = """
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static FILE *rows;
static const size_t counts[] = {COUNTS};
static const size_t splats[] = {SPLATS};

/* The next `size` bytes of the file, alone in memory of their own. */
static void *next(size_t size) {
    void *memory = malloc(size ? size : 1);
    if (memory == NULL || fread(memory, 1, size, rows) != size) exit(3);
    return memory;
}

/* The first `size` bytes, in memory that ends where they do. */
static void *first(const void *memory, size_t size) {
    void *part = malloc(size ? size : 1);
    if (part == NULL) exit(4);
    if (size) memcpy(part, memory, size);
    return part;
}
"""


@dataclass(frozen=True)
class Array:
    """An argument of a C function: so many numbers for each row, which is a point, or a splat, or a pair of them."""

    name: str
    size: int
    by_splat: bool = False
    by_pair: bool = False


def arrays(routine: Routine) -> list[Array]:
    """The inputs of a routine."""
    return [Array(p.name, len(p.nodes), p.name in ("mu", "W", "amplitude")) for p in routine.parameters]


def outputs(routine: Routine) -> list[Array]:
    """The results of a routine."""
    return [Array(f"{r.name}_out", len(r.nodes)) for r in routine.results]


def calls(program: Program) -> Iterator[tuple[Routine, Precision]]:
    """Every function that the driver calls, in its order."""
    for precision in PRECISIONS:
        for routine in (*public(program), program["splat_vjp"]):
            yield routine, precision


def driver(program: Program, splats: tuple[int, ...] = SPLATS, threads: int = 1) -> str:
    """A C program that runs all functions at the rows of a file."""
    blocks = [_block(program, routine, precision) for routine, precision in calls(program)]
    frames = [_frame(program, precision) for precision in PRECISIONS]
    body = "\n".join([*blocks, *frames])
    preamble = PREAMBLE.replace("COUNTS", ", ".join(map(str, COUNTS))).replace("SPLATS", ", ".join(map(str, splats)))
    body = body.replace("THREADS", str(threads))
    return (
        f'#include "{program.name}.h"\n{preamble}\nint main(int argc, char **argv) {{\n'
        f'    if (argc != 2 || (rows = fopen(argv[1], "rb")) == NULL) return 2;\n{body}\n    return fclose(rows);\n}}\n'
    )


def _block(program: Program, routine: Routine, precision: Precision) -> str:
    t, inputs = precision.type, arrays(routine)
    lines = [f"{t} *{a.name} = ({t} *)next({ROWS * a.size} * sizeof({t}));" for a in inputs]
    if routine.name != "splat_vjp":
        lines += [_scalar(program, routine, precision)]
        lines.append(f"for (size_t c = 0; c < {len(COUNTS)}; ++c) {_batch(program, routine, precision)}")
    if routine.name in ("splat", "splat_vjp"):
        loops = (
            f"for (size_t c = 0; c < {len(COUNTS)}; ++c) for (size_t k = 0; k < sizeof splats / sizeof *splats; ++k)"
        )
        lines.append(f"{loops} {_sums(program, routine, precision)}")
    lines += [f"free({a.name});" for a in inputs]
    return "    {\n" + "\n".join(f"        {line}" for line in lines) + "\n    }"


def _scalar(program: Program, routine: Routine, precision: Precision) -> str:
    """One row after another."""
    t, results = precision.type, outputs(routine)
    copies = " ".join(
        f"{t} *{a.name}_row = ({t} *)first({a.name} + {a.size} * i, {a.size} * sizeof({t}));" for a in arrays(routine)
    )
    given = [f"{p.name}_row" if p.shape else f"*{p.name}_row" for p in routine.parameters]
    returns = len(routine.results) == 1 and not routine.results[0].shape
    memory = " ".join(f"{t} *{r.name} = ({t} *)malloc({r.size} * sizeof({t}));" for r in results)
    name = f"{program.name}_{routine.name}{precision.tag}"
    call = (
        f"{results[0].name}[0] = {name}({', '.join(given)})"
        if returns
        else f"{name}({', '.join([*given, *(r.name for r in results)])})"
    )
    freed = " ".join(
        f"free({name});" for name in [*(f"{a.name}_row" for a in arrays(routine)), *(r.name for r in results)]
    )
    return f"for (size_t i = 0; i < {ROWS}; ++i) {{ {copies} {memory} {call}; {freed} }}"


def _batch(program: Program, routine: Routine, precision: Precision) -> str:
    name = f"{program.name}_{routine.name}_batch{precision.tag}"
    return _called(name, ("counts[c]",), arrays(routine), outputs(routine), precision)


def _sums(program: Program, routine: Routine, precision: Precision) -> str:
    """The sums of splats, by the functions that have the inputs of a routine."""
    results = outputs(routine)
    if routine.name == "splat":
        functions = {"splats": results, "splats_value": results[:1]}
    else:
        size = sum(r.size for r in results)
        functions = {
            "splats_vjp": [Array(r.name, r.size, True) for r in results],
            "splats_rows": [Array("rows_out", size, by_pair=True)],
        }
    work = f"{program.name}_splats_work{precision.tag}(counts[c], splats[k], THREADS)"
    inputs = arrays(routine)
    calls = []
    for name, given in functions.items():
        full = f"{program.name}_{name}{precision.tag}"
        for width in ("NULL", "amplitude_part") if name in CULLED else ("",):  # any numbers will do as widths
            calls.append(_called(full, ("counts[c]", "splats[k]"), inputs, given, precision, work, width))
    if routine.name == "splat":
        calls.append(_order(program, precision, inputs, work))
    return "{ " + " ".join(calls) + " }"


def _order(program: Program, precision: Precision, inputs: list[Array], work: str) -> str:
    """The order in which far pairs are left out, of the points and splats in the inputs."""
    t = precision.type
    rows = {"x": "counts[c]", "mu": "splats[k]", "amplitude": "splats[k]"}
    parts = [a for a in inputs if a.name in rows]
    lines = [f"{t} *{a.name}_part = ({t} *)first({a.name}, {rows[a.name]} * {a.size} * sizeof({t}));" for a in parts]
    lines += [f"{t} *work = ({t} *)malloc({work} * sizeof({t}));"]
    lines += ["size_t *order = (size_t *)malloc(counts[c] * sizeof(size_t));"]
    name = f"{program.name}_splats_order{precision.tag}"
    call = f"{name}(counts[c], splats[k], x_part, mu_part, amplitude_part, amplitude_part, 1.0, order, work);"
    freed = [f"free({a.name}_part);" for a in parts] + ["free(work);", "free(order);"]
    return "{ " + " ".join([*lines, call, *freed]) + " }"


def _called(
    name: str,
    counts: tuple[str, ...],
    inputs: list[Array],
    results: list[Array],
    precision: Precision,
    work: str = "",
    width: str = "",
) -> str:
    t = precision.type

    def size(a: Array) -> str:
        rows = "counts[c] * splats[k]" if a.by_pair else "splats[k]" if work and a.by_splat else "counts[c]"
        return f"{rows} * {a.size} * sizeof({t})"

    lines = [f"{t} *{a.name}_part = ({t} *)first({a.name}, {size(a)});" for a in inputs]
    lines += [f"{t} *{r.name} = ({t} *)malloc({size(r)});" for r in results]
    lines += [f"{t} *work = ({t} *)malloc({work} * sizeof({t}));"] if work else []
    parts = [f"{a.name}_part" for a in inputs]
    given = ", ".join([*counts, *parts[:4], *([width] if width else []), *parts[4:], *(r.name for r in results)])
    given += ", work, THREADS" if work else ""
    names = [*(f"{a.name}_part" for a in inputs), *(r.name for r in results), *(["work"] if work else [])]
    return "{ " + " ".join([*lines, f"{name}({given});", *(f"free({name});" for name in names)]) + " }"


def _frame(program: Program, precision: Precision) -> str:
    t, upper = precision.type, program.name.upper()
    return f"""    {{
        {t} *p = ({t} *)next({ROWS} * {upper}_POINT_SIZE * sizeof({t}));
        for (size_t i = 0; i < {ROWS}; ++i) {{
            {t} *row = ({t} *)first(p + {upper}_POINT_SIZE * i, {upper}_POINT_SIZE * sizeof({t}));
            {t} *frame = ({t} *)malloc({upper}_DIM * {upper}_TANGENT_SIZE * sizeof({t}));
            {program.name}_frame{precision.tag}(row, frame);
            free(row);
            free(frame);
        }}
        free(p);
    }}"""


def rows(program: Program, given: dict[str, np.ndarray]) -> bytes:
    """The file that a driver reads: what is given of each argument, and random numbers for the others."""
    rng = np.random.default_rng(0)
    point_size = len(program["project"].parameters[0].nodes)
    shapes = [(a.name, a.size, precision) for routine, precision in calls(program) for a in arrays(routine)]
    shapes += [("p", point_size, precision) for precision in PRECISIONS]
    parts = []
    for name, size, precision in shapes:
        values = given.get(name)
        if values is None or values.shape[1] != size:
            values = rng.normal(size=(ROWS, size))
        parts.append(np.resize(values, (ROWS, size)).astype(TYPES[precision.type]).tobytes())
    return b"".join(parts)


def oracle_rows(name: str) -> dict[str, np.ndarray]:
    """Points and tangent vectors of the oracle, near and far ones among them; none where it has no such manifold."""
    if name not in ORACLES:
        return {}
    with np.load(Path(__file__).parent / "oracle.npz") as oracle:
        mu, x, log = (oracle[f"{ORACLES[name]}/{key}"] for key in ("mu", "x", "log"))
    return {"p": mu, "mu": mu, "q": x, "x": x, "u": log, "v": log}


@cache
def sanitizer_is_missing() -> str | None:
    """Why no C program runs under the sanitizers here, if none does."""
    cc = shutil.which(os.environ.get("CC") or "cc")
    if cc is None:
        return "no C compiler on this machine"
    with_main = [cc, *SANITIZE, "-x", "c", "-", "-o", "/dev/null"]
    made = subprocess.run(with_main, input="int main(void) { return 0; }", capture_output=True, text=True, check=False)
    return None if made.returncode == 0 else "the C compiler has no runtime library of the sanitizers"


@pytest.fixture(scope="module")
def sanitized(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Drivers that were built, by manifold."""
    return {}


def built(name: str, known: dict[str, Path], folder: Path) -> Path:
    """The driver of a manifold under the sanitizers."""
    if name not in known:
        for file, text in {**files(name), "driver.c": driver(program(name))}.items():
            (folder / file).write_text(text, encoding="utf-8")
        sources = ["driver.c", f"{name}.c", f"{name}_splats.c"]
        command = [os.environ.get("CC") or "cc", "-std=c99", *SANITIZE, *sources, "-o", "driver", "-lm"]
        made = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
        assert made.returncode == 0, made.stderr
        known[name] = folder / "driver"
    return known[name]


@pytest.mark.parametrize("inputs", ["oracle", "bytes"])
@pytest.mark.parametrize("name", NAMES)
def test_no_function_reads_or_writes_beyond_its_arguments_whatever_they_are(
    name: str, inputs: str, sanitized: dict[str, Path], tmp_path: Path
) -> None:
    if sanitizer_is_missing():
        pytest.skip(str(sanitizer_is_missing()))
    binary = built(name, sanitized, tmp_path)
    data = rows(program(name), oracle_rows(name))
    if inputs == "bytes":  # every bit pattern: NaN, infinities, denormal numbers
        data = np.random.default_rng(1).bytes(len(data))
    (tmp_path / "rows").write_bytes(data)
    environment = {**os.environ, "ASAN_OPTIONS": "detect_leaks=0", "UBSAN_OPTIONS": "print_stacktrace=1"}
    ran = subprocess.run(
        [str(binary), str(tmp_path / "rows")], env=environment, capture_output=True, text=True, check=False
    )
    assert (ran.returncode, ran.stderr) == (0, "")


def test_the_sanitizers_see_a_number_too_many(tmp_path: Path) -> None:
    if sanitizer_is_missing():
        pytest.skip(str(sanitizer_is_missing()))
    texts = {**files("torus"), "driver.c": driver(program("torus"))}
    texts["torus.c"] = texts["torus.c"].replace("v_out[1] = ", "v_out[2] = ", 1)
    for file, text in texts.items():
        (tmp_path / file).write_text(text, encoding="utf-8")
    command = [os.environ.get("CC") or "cc", "-std=c99", "-O1", *SANITIZE, "driver.c", "torus.c", "torus_splats.c"]
    subprocess.run([*command, "-o", "driver", "-lm"], cwd=tmp_path, check=True)
    (tmp_path / "rows").write_bytes(rows(program("torus"), {}))
    ran = subprocess.run([str(tmp_path / "driver"), "rows"], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert ran.returncode != 0
    assert "heap-buffer-overflow" in ran.stderr


LANGUAGES = {"C99": ("-std=c99",), "C++17": ("-x", "c++", "-std=c++17")}


@pytest.mark.parametrize("compiler", ["gcc", "clang"])
@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("name", NAMES)
def test_the_code_is_clean_in_both_languages_and_compilers(
    name: str, language: str, compiler: str, tmp_path: Path
) -> None:
    if shutil.which(compiler) is None:
        pytest.skip(f"no {compiler} on this machine")
    for file, text in files(name).items():
        (tmp_path / file).write_text(text, encoding="utf-8")
    command = [compiler, *LANGUAGES[language], *STRICT, "-fsyntax-only", f"{name}.c", f"{name}_splats.c"]
    made = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (made.returncode, made.stderr) == (0, "")
