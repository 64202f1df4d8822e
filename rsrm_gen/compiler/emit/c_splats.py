"""The sums of splats in C: N points times K splats, values and gradients forward, their adjoints backward.

Nothing of size N x K is stored: forward, a block of points stays in the cache while all splats pass over it; backward,
a splat gathers its derivatives from all points in the lanes of a vector, which are added up at the end. All loops over
points are plain loops without branches over contiguous arrays, for the compiler to vectorise.
"""

from __future__ import annotations

import textwrap

from rsrm_gen.compiler.emit import c_matrix
from rsrm_gen.compiler.emit.c_language import (
    comment,
    restrict,
    series_function,
    series_name,
    spelling,
    statements,
)
from rsrm_gen.compiler.emit.c_precision import PRECISIONS, Precision
from rsrm_gen.compiler.emit.expression import Printer
from rsrm_gen.compiler.emit.series import Coefficients, tables
from rsrm_gen.compiler.lower import Parameter, Program, Routine

LANES = 64  # points that pass together; a multiple of every vector length, small enough for the cache

# Far splats are denormal numbers, on which processors are ten times slower; here they are zero.
FLUSH = """/* Denormal numbers count as zero while the sums run: far splats are many, and slow. */
#if defined(__SSE2__)
#include <xmmintrin.h>
static unsigned flush_denormals(void) {
    const unsigned mode = _mm_getcsr();
    _mm_setcsr(mode | 0x8040u);
    return mode;
}
static void restore_denormals(unsigned mode) { _mm_setcsr(mode); }
#else
static unsigned flush_denormals(void) { return 0; }
static void restore_denormals(unsigned mode) { (void)mode; }
#endif"""


def declarations(program: Program) -> list[str]:
    """The prototypes, for the header."""
    forward = "/* The sums of `splat_count` splats and their gradients at `count` points (RSRM eq. 4). */"
    backward = (
        "/* The derivatives of sum_n value_n value_bar_n + gradient_n . gradient_bar_n in mu, W and amplitude. */"
    )
    return [
        "\n".join([forward, *(_forward_signature(program, p) + ";" for p in PRECISIONS)]),
        "\n".join([backward, *(_backward_signature(program, p) + ";" for p in PRECISIONS)]),
    ]


def source(program: Program, heading: list[str]) -> str:
    """The text of NAME_splats.c."""
    kernels = program["splat"], program["splat_vjp"]
    series = tables(kernels)
    top = comment(
        [heading[0], "", "Sums of splats, forward and backward. See the header for what the functions promise."]
    )
    parts = [top, f'#include "{program.name}.h"\n\n#include <float.h>\n\n#define LANES {LANES}', FLUSH]
    for precision in PRECISIONS:
        parts += [series_function(name, coefficients, precision) for coefficients, name in series.items()]
        parts += c_matrix.support(kernels, precision)
        parts += [_forward(program, series, precision), _backward(program, series, precision)]
    return "\n\n".join(parts) + "\n"


def _pointer(name: str, program: Program, precision: Precision, const: bool = True) -> str:
    return f"{'const ' if const else ''}{precision.type} *{restrict(program)} {name}"


def _arguments(program: Program, precision: Precision, inputs: list[str], outputs: list[str]) -> str:
    pointers = [_pointer(n, program, precision) for n in inputs] + [
        _pointer(n, program, precision, False) for n in outputs
    ]
    return ",\n    ".join(["size_t count", "size_t splat_count", *pointers])


def _forward_signature(program: Program, precision: Precision) -> str:
    arguments = _arguments(program, precision, ["x", "mu", "W", "amplitude"], ["value", "gradient"])
    return f"void {program.name}_splats{precision.tag}(\n    {arguments})"


def _backward_signature(program: Program, precision: Precision) -> str:
    inputs = ["x", "mu", "W", "amplitude", "value_bar", "gradient_bar"]
    arguments = _arguments(program, precision, inputs, ["mu_bar", "W_bar", "amplitude_bar"])
    return f"void {program.name}_splats_vjp{precision.tag}(\n    {arguments})"


def _size(parameter: Parameter) -> int:
    return len(parameter.nodes)


def _local(parameter: Parameter, i: int) -> str:
    """The name of an entry of splat k; the graph gave it, so that no name of the author's is the same."""
    return str(parameter.nodes[i].value) if parameter.shape else f"{parameter.name}_k"


def _body(
    routine: Routine, series: dict[Coefficients, str], precision: Precision, per_point: tuple[str, ...]
) -> tuple[list[str], list[str]]:
    """Statements of one pair and the expressions of its results; what belongs to the point is read from its lane."""
    names = {}
    for parameter in routine.parameters:
        for i, node in enumerate(parameter.nodes):
            names[node] = f"{parameter.name}_block[{i}][lane]" if parameter.name in per_point else _local(parameter, i)
    printer = Printer(spelling(precision), names, {k: series_name(name, precision) for k, name in series.items()})
    lines = statements(routine, printer, precision)
    return lines, [printer.text(node) for result in routine.results for node in result.nodes]


def _splat_locals(routine: Routine, precision: Precision, names: tuple[str, ...]) -> str:
    """The numbers of splat k as constants; those that are not read, left out."""
    lines = []
    for parameter in routine.parameters:
        if parameter.name in names:
            for i, node in enumerate(parameter.nodes):
                if str(node.value) in routine.inputs:
                    lines.append(
                        f"const {precision.type} {_local(parameter, i)} = {parameter.name}[{_size(parameter)} * k + {i}];"
                    )
    return "\n".join(lines)


def _load(parameter: Parameter, last: str) -> str:
    """The lanes of a block of points, transposed; lanes past the end repeat the last point."""
    n = _size(parameter)
    return f"for (size_t i = 0; i < {n}; ++i) {parameter.name}_block[i][lane] = {parameter.name}[{n} * {last} + i];"


def _forward(program: Program, series: dict[Coefficients, str], precision: Precision) -> str:
    routine, t = program["splat"], precision.type
    x = routine.parameters[0]
    lines, results = _body(routine, series, precision, ("x",))
    rows = len(results)
    sums = [f"sum[{i}][lane] += {text};" for i, text in enumerate(results)]
    return f"""{_forward_signature(program, precision)} {{
    const unsigned mode = flush_denormals();
    for (size_t start = 0; start < count; start += LANES) {{
        const size_t lanes = count - start < LANES ? count - start : LANES;
        {t} x_block[{_size(x)}][LANES], sum[{rows}][LANES] = {{{{0}}}};
        for (size_t lane = 0; lane < LANES; ++lane) {{
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            {_load(x, "n")}
        }}
        for (size_t k = 0; k < splat_count; ++k) {{
{textwrap.indent(_splat_locals(routine, precision, ("mu", "W", "amplitude")), " " * 12)}
            for (size_t lane = 0; lane < LANES; ++lane) {{
{_indented(lines + sums, 16)}
            }}
        }}
        for (size_t lane = 0; lane < lanes; ++lane) {{
            value[start + lane] = sum[0][lane];
            for (size_t i = 0; i < {rows - 1}; ++i) gradient[{rows - 1} * (start + lane) + i] = sum[i + 1][lane];
        }}
    }}
    restore_denormals(mode);
}}"""


def _backward(program: Program, series: dict[Coefficients, str], precision: Precision) -> str:
    routine, t = program["splat_vjp"], precision.type
    by_name = {p.name: p for p in routine.parameters}
    points = (by_name["x"], by_name["value_bar"], by_name["gradient_bar"])
    lines, results = _body(routine, series, precision, tuple(p.name for p in points))
    sums = [f"sum[{i}][lane] += {text};" for i, text in enumerate(results)]
    blocks = ", ".join(f"{p.name}_block[{_size(p)}][LANES]" for p in points)
    loads = "\n".join(" " * 12 + _load(p, "n") for p in points)
    # A lane past the end has adjoints of zero, and so adds nothing.
    mask = "\n".join(
        f"{' ' * 12}for (size_t i = 0; i < {_size(p)}; ++i) {p.name}_block[i][lane] *= weight;" for p in points[1:]
    )
    outputs = [(f"{name}_bar", _size(by_name[name])) for name in ("mu", "W", "amplitude")]
    clear = "\n".join(f"    for (size_t i = 0; i < {n} * splat_count; ++i) {name}[i] = 0;" for name, n in outputs)
    offset, stores = 0, []
    for name, n in outputs:
        stores += [f"{name}[{n} * k + {i}] += total[{offset + i}];" for i in range(n)]
        offset += n
    return f"""{_backward_signature(program, precision)} {{
    const unsigned mode = flush_denormals();
{clear}
    for (size_t start = 0; start < count; start += LANES) {{
        const size_t lanes = count - start < LANES ? count - start : LANES;
        {t} {blocks};
        for (size_t lane = 0; lane < LANES; ++lane) {{
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            const {t} weight = lane < lanes ? 1 : 0;
{loads}
{mask}
        }}
        for (size_t k = 0; k < splat_count; ++k) {{
            {t} sum[{len(results)}][LANES] = {{{{0}}}}, total[{len(results)}] = {{0}};
{textwrap.indent(_splat_locals(routine, precision, ("mu", "W", "amplitude")), " " * 12)}
            for (size_t lane = 0; lane < LANES; ++lane) {{
{_indented(lines + sums, 16)}
            }}
            for (size_t i = 0; i < {len(results)}; ++i)
                for (size_t lane = 0; lane < LANES; ++lane) total[i] += sum[i][lane];
{_indented(stores, 12)}
        }}
    }}
    restore_denormals(mode);
}}"""


def _indented(lines: list[str], width: int) -> str:
    return textwrap.indent("\n".join(lines), " " * width)
