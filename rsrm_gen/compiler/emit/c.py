"""The C back end: a header and a source in dependency-free C99, every function in double and in float.

Scalar functions for users (`so3_log`), batches of rows (`so3_log_batch`); no allocation, no global state, no branches but
selects, so that compilers can vectorise the batches; only functions of matrices are loops.
"""

from __future__ import annotations

import textwrap
from dataclasses import replace

import sympy as sp

from rsrm_gen.compiler.derive import Geometry
from rsrm_gen.compiler.emit import c_matrix
from rsrm_gen.compiler.emit import c_splats as splats
from rsrm_gen.compiler.emit.c_language import (
    WIDTH,
    comment,
    restrict,
    series_function,
    series_name,
    spelling,
    statements,
)
from rsrm_gen.compiler.emit.c_precision import PRECISIONS, Precision
from rsrm_gen.compiler.emit.expression import Printer
from rsrm_gen.compiler.emit.promises import promise, public
from rsrm_gen.compiler.emit.series import Coefficients, tables
from rsrm_gen.compiler.lower import Parameter, Program, Routine
from rsrm_gen.compiler.lower.ir import Result


def header(geometry: Geometry, program: Program, heading: list[str]) -> str:
    """The text of the header."""
    guard = f"{program.name.upper()}_H"
    spec = geometry.spec
    constants = [
        f"#define {program.name.upper()}_DIM {spec.dim}",
        f"#define {program.name.upper()}_POINT_SIZE {spec.point_size}",
        f"#define {program.name.upper()}_TANGENT_SIZE {spec.tangent_size}",
        f"#define {program.name.upper()}_INJECTIVITY_RADIUS {_number(geometry.injectivity_radius)}",
        f"#define {program.name.upper()}_DIAMETER {_number(geometry.diameter)}",
    ]
    declarations = [_declarations(geometry, program, routine) for routine in public(program)]
    signatures = "\n".join(_frame_signature(program, precision) + ";" for precision in PRECISIONS)
    frame = f"/* An orthonormal basis of the tangent space at p, one vector a row. */\n{signatures}"
    return "\n".join([
        comment(heading),
        f"#ifndef {guard}\n#define {guard}\n\n#include <math.h>\n#include <stddef.h>\n",
        f"#ifdef __cplusplus\n#define {restrict(program)} __restrict",
        f'extern "C" {{\n#else\n#define {restrict(program)} restrict\n#endif\n',
        "\n".join(constants) + "\n",
        f"/*\n * Points are {spec.point_size} numbers, tangent vectors {spec.tangent_size}. Arguments and results must not\n"
        " * overlap. `_f` functions are in float; `_batch` functions take `count` rows of every argument.\n */\n",
        "\n\n".join([*declarations, frame, *splats.declarations(program)]),
        "\n#ifdef __cplusplus\n}\n#endif\n\n#endif\n",
    ])  # fmt: skip


def source(geometry: Geometry, program: Program, heading: list[str]) -> str:
    """The text of the source file."""
    series = tables(public(program))
    parts = [
        comment([heading[0], "", "See the header for what the functions promise."]),
        f'#include "{program.name}.h"\n\n#include <float.h>',
    ]
    for precision in PRECISIONS:
        parts += [series_function(name, coefficients, precision) for coefficients, name in series.items()]
        parts += c_matrix.support(public(program), precision)
        parts += [_function(program, routine, series, precision) for routine in public(program)]
        parts.append(_frame(geometry, program, precision))
    return "\n\n".join(parts) + "\n"


def _number(value: sp.Expr) -> str:
    return "HUGE_VAL" if value == sp.oo else repr(float(value))


def _declarations(geometry: Geometry, program: Program, routine: Routine) -> str:
    lines = [f"/* {promise(geometry, routine.name)}", f" * {textwrap.shorten(routine.formula, WIDTH - 4)} */"]
    for precision in PRECISIONS:
        lines.append(_signature(program, routine, precision) + ";")
    for precision in PRECISIONS:
        lines.append(_batch_signature(program, routine, precision) + ";")
    return "\n".join(lines)


def _inputs(parameter: Parameter, program: Program, precision: Precision) -> str:
    return (
        f"const {precision.type} *{restrict(program)} {parameter.name}"
        if parameter.shape
        else f"{precision.type} {parameter.name}"
    )


def _outputs(result: Result, program: Program, precision: Precision) -> str:
    return f"{precision.type} *{restrict(program)} {_out(result)}"


def _out(result: Result) -> str:
    return f"{result.name}_out"


def _returns_value(routine: Routine) -> bool:
    return len(routine.results) == 1 and not routine.results[0].shape


def _signature(program: Program, routine: Routine, precision: Precision) -> str:
    arguments = [_inputs(p, program, precision) for p in routine.parameters]
    if not _returns_value(routine):
        arguments += [_outputs(r, program, precision) for r in routine.results]
    returns = precision.type if _returns_value(routine) else "void"
    return _wrapped(f"{returns} {program.name}_{routine.name}{precision.tag}(", arguments)


def _batch_signature(program: Program, routine: Routine, precision: Precision) -> str:
    pointers = [_inputs(replace(p, shape=p.shape or (1,)), program, precision) for p in routine.parameters]
    arguments = ["size_t count", *pointers, *(_outputs(r, program, precision) for r in routine.results)]
    return _wrapped(f"void {program.name}_{routine.name}_batch{precision.tag}(", arguments)


def _wrapped(head: str, arguments: list[str]) -> str:
    line = f"{head}{', '.join(arguments)})"
    if len(line) <= WIDTH:
        return line
    return f"{head}\n    " + ",\n    ".join(arguments) + ")"


def _function(program: Program, routine: Routine, series: dict[Coefficients, str], precision: Precision) -> str:
    """The scalar function and its batch."""
    coefficients = {k: series_name(name, precision) for k, name in series.items()}
    names = {
        node: (f"{p.name}[{i}]" if p.shape else p.name) for p in routine.parameters for i, node in enumerate(p.nodes)
    }
    printer = Printer(spelling(precision), names, coefficients)
    lines = [f"(void){p.name};" for p in routine.parameters if not routine.inputs & {str(n.value) for n in p.nodes}]
    lines += statements(routine, printer, precision)
    for result in routine.results:
        texts = [printer.text(node) for node in result.nodes]
        if _returns_value(routine):
            lines.append(f"return {texts[0]};")
        else:
            lines += [f"{_out(result)}[{i}] = {text};" for i, text in enumerate(texts)]
    body = textwrap.indent("\n".join(lines), "    ")
    title = f"/* {textwrap.shorten(routine.formula, WIDTH - 6)} */"
    return f"{title}\n{_signature(program, routine, precision)} {{\n{body}\n}}\n\n{_batch(program, routine, precision)}"


def _batch(program: Program, routine: Routine, precision: Precision) -> str:
    def row(name: str, shape: tuple[int, ...], scalar: str) -> str:
        size = 1
        for n in shape:
            size *= n
        return f"{name} + {size} * i" if shape else scalar.format(name)

    arguments = [row(p.name, p.shape, "{}[i]") for p in routine.parameters]
    name = f"{program.name}_{routine.name}{precision.tag}"
    if _returns_value(routine):
        statement = f"{_out(routine.results[0])}[i] = {name}({', '.join(arguments)});"
    else:
        arguments += [row(_out(r), r.shape, "{} + i") for r in routine.results]
        statement = f"{name}({', '.join(arguments)});"
    return f"{_batch_signature(program, routine, precision)} {{\n    for (size_t i = 0; i < count; ++i) {statement}\n}}"


def _frame_signature(program: Program, precision: Precision) -> str:
    r, t = restrict(program), precision.type
    return f"void {program.name}_frame{precision.tag}(const {t} *{r} p, {t} *{r} frame)"


def _frame(geometry: Geometry, program: Program, precision: Precision) -> str:
    spec, t, tag = geometry.spec, precision.type, precision.tag
    zero, one = f"0.0{precision.suffix}", f"1.0{precision.suffix}"
    return f"""/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
{_frame_signature(program, precision)} {{
    {t} left[{spec.point_size}][{spec.tangent_size}];
    for (int i = 0; i < {spec.point_size}; ++i) {{
        {t} axis[{spec.point_size}];
        for (int j = 0; j < {spec.point_size}; ++j) axis[j] = i == j ? {one} : {zero};
        {program.name}_to_tangent{tag}(p, axis, left[i]);
    }}
    for (int row = 0; row < {spec.dim}; ++row) {{
        {t} *e = frame + {spec.tangent_size} * row;
        int longest = 0;
        for (int i = 1; i < {spec.point_size}; ++i)
            if ({program.name}_norm{tag}(p, left[i]) > {program.name}_norm{tag}(p, left[longest])) longest = i;
        const {t} length = {program.name}_norm{tag}(p, left[longest]);
        for (int j = 0; j < {spec.tangent_size}; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * {spec.point_size}; ++i) {{ /* twice, for what rounding leaves of the first subtraction */
            {t} *rest = left[i % {spec.point_size}];
            const {t} part = {program.name}_inner{tag}(p, e, rest);
            for (int j = 0; j < {spec.tangent_size}; ++j) rest[j] -= part * e[j];
        }}
    }}
}}"""
