"""C programs that run every function of a generated pair of files, for the tests under sanitizers.

A driver is written for each manifold. It gives every function arrays of exactly the size that the header promises, so that
one number read or written too far is seen.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from rsrm_gen.compiler.emit.c_precision import PRECISIONS, Precision
from rsrm_gen.compiler.emit.c_splats import CULLED
from rsrm_gen.compiler.emit.promises import public
from rsrm_gen.compiler.lower import Program, Routine

ROWS = 200
COUNTS = (0, 1, 63, 64, 65, ROWS)  # around the points that pass together in the sums of splats
SPLATS = (0, 1, 3)
ORACLES = {"euclidean": "R3", "sphere": "S2", "torus": "T2", "hyperbolic": "H2", "so3": "SO3_quat"}
TYPES = {"double": np.float64, "float": np.float32}

PREAMBLE = """
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static FILE *rows;
static FILE *shown_double, *shown_float; /* where results go, if anywhere */
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

static void show(FILE *file, const void *memory, size_t size) {
    if (file && fwrite(memory, 1, size, file) != size) exit(5);
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
    """A C program that runs all functions at the rows of a file; given two more files, it writes what they return there,
    in double and in float."""
    blocks = [_block(program, routine, precision) for routine, precision in calls(program)]
    frames = [_frame(program, precision) for precision in PRECISIONS]
    body = "\n".join([*blocks, *frames])
    preamble = PREAMBLE.replace("COUNTS", ", ".join(map(str, COUNTS))).replace("SPLATS", ", ".join(map(str, splats)))
    body = body.replace("THREADS", str(threads))
    return f"""#include "{program.name}.h"
{preamble}
int main(int argc, char **argv) {{
    if (argc < 2 || (rows = fopen(argv[1], "rb")) == NULL) return 2;
    if (argc == 4) {{
        shown_double = fopen(argv[2], "wb");
        shown_float = fopen(argv[3], "wb");
    }}
{body}
    return fclose(rows);
}}
"""


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
    shown = [f"show(shown_{t}, {r.name}, {size(r)});" for r in results]
    return "{ " + " ".join([*lines, f"{name}({given});", *shown, *(f"free({name});" for name in names)]) + " }"


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
