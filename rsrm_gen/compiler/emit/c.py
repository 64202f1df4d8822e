"""The C back end: a header and a source in dependency-free C99, every function in double and in float.

Scalar functions for users (`so3_log`), batches of rows (`so3_log_batch`); no allocation, no global state, no branches but
selects, so that compilers can vectorise the batches.
"""

from __future__ import annotations

import textwrap
from dataclasses import dataclass, replace

import sympy as sp

from rsrm_gen.compiler.derive import Geometry
from rsrm_gen.compiler.emit.expression import UNARY, Printer, Spelling
from rsrm_gen.compiler.emit.series import Coefficients, spelled, tables
from rsrm_gen.compiler.emit.torch import PROMISES
from rsrm_gen.compiler.lower import Parameter, Program, Routine
from rsrm_gen.compiler.lower.ir import FUNCTIONS, Result

WIDTH = 110
NAMES = {"root": "sqrt", "abs": "fabs", "round": "rint"}  # the others are called in C what they are called here


@dataclass(frozen=True)
class Precision:
    """One of the two instances of every function."""

    type: str
    suffix: str  # of C function names and literals
    tag: str  # of our function names
    eps: str


DOUBLE = Precision("double", "", "", "DBL_EPSILON")
FLOAT = Precision("float", "f", "_f", "FLT_EPSILON")


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
    declarations = [_declarations(program, routine) for routine in program]
    frame = f"/* An orthonormal basis of the tangent space at p, one vector a row. */\n{_frame_signature(program, DOUBLE)};\n{_frame_signature(program, FLOAT)};"
    return "\n".join([
        _comment(heading),
        f"#ifndef {guard}\n#define {guard}\n\n#include <math.h>\n#include <stddef.h>\n",
        f'#ifdef __cplusplus\n#define {_restrict(program)} __restrict\nextern "C" {{\n#else\n#define {_restrict(program)} restrict\n#endif\n',
        "\n".join(constants) + "\n",
        f"/*\n * Points are {spec.point_size} numbers, tangent vectors {spec.tangent_size}. Arguments and results must not overlap.\n"
        " * `_f` functions are in float; `_batch` functions take `count` rows of every argument, one after the other.\n */\n",
        "\n\n".join([*declarations, frame]),
        "\n#ifdef __cplusplus\n}\n#endif\n\n#endif\n",
    ])  # fmt: skip


def source(geometry: Geometry, program: Program, heading: list[str]) -> str:
    """The text of the source file."""
    series = tables(program)
    parts = [_comment([heading[0], "", "See the header for what the functions promise."]), f'#include "{program.name}.h"\n\n#include <float.h>']
    for precision in (DOUBLE, FLOAT):
        parts += [_table(name, coefficients, precision) for coefficients, name in series.items()]
        if series:
            parts.append(_horner(precision))
        parts += [_function(program, routine, series, precision) for routine in program]
        parts.append(_frame(geometry, program, precision))
    return "\n\n".join(parts) + "\n"


def _comment(lines: list[str]) -> str:
    return "/*\n" + "".join(f" * {line}".rstrip() + "\n" for line in lines) + " */"


def _number(value: sp.Expr) -> str:
    return "HUGE_VAL" if value == sp.oo else repr(float(value))


def _restrict(program: Program) -> str:
    return f"{program.name.upper()}_RESTRICT"


def _declarations(program: Program, routine: Routine) -> str:
    lines = [f"/* {PROMISES[routine.name]}", f" * {textwrap.shorten(routine.formula, WIDTH - 4)} */"]
    for precision in (DOUBLE, FLOAT):
        lines.append(_signature(program, routine, precision) + ";")
    for precision in (DOUBLE, FLOAT):
        lines.append(_batch_signature(program, routine, precision) + ";")
    return "\n".join(lines)


def _inputs(parameter: Parameter, program: Program, precision: Precision) -> str:
    return f"const {precision.type} *{_restrict(program)} {parameter.name}" if parameter.shape else f"{precision.type} {parameter.name}"


def _outputs(result: Result, program: Program, precision: Precision) -> str:
    return f"{precision.type} *{_restrict(program)} {_out(result)}"


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


def _table(name: str, coefficients: Coefficients, precision: Precision) -> str:
    rows = textwrap.fill(", ".join(spelled(coefficients, precision.suffix)), WIDTH - 4)
    return f"static const {precision.type} {name}{precision.tag.upper()}[{len(coefficients)}] = {{\n{textwrap.indent(rows, '    ')}}};"


def _horner(precision: Precision) -> str:
    t = precision.type
    return f"""/* c[0] + c[1] x + ... by Horner's rule. */
static inline {t} polynomial{precision.tag}({t} x, const {t} *c, int size) {{
    {t} result = c[size - 1];
    for (int i = size - 2; i >= 0; --i) result = result * x + c[i];
    return result;
}}"""


def _spelling(precision: Precision) -> Spelling:
    function = {name: f"{NAMES.get(name, name)}{precision.suffix}({{}})" for name in FUNCTIONS}
    function["atan2"] = f"atan2{precision.suffix}({{}}, {{}})"
    return Spelling(
        function,
        select="({condition} ? {x} : {y})",
        polynomial=f"polynomial{precision.tag}({{x}}, {{coefficients}})",
        eps=precision.eps,
        suffix=precision.suffix,
        compare_binds=UNARY,
    )


def _function(program: Program, routine: Routine, series: dict[Coefficients, str], precision: Precision) -> str:
    """The scalar function and its batch."""
    coefficients = {k: f"{name}{precision.tag.upper()}, {len(k)}" for k, name in series.items()}
    names = {node: (f"{p.name}[{i}]" if p.shape else p.name) for p in routine.parameters for i, node in enumerate(p.nodes)}
    printer = Printer(_spelling(precision), names, coefficients)
    lines = [f"(void){p.name};" for p in routine.parameters if not routine.inputs & {str(n.value) for n in p.nodes}]
    for name, node in routine.body:
        condition = node.op in ("less", "less_equal", "equal")
        text = f"const {'int' if condition else precision.type} {name} = {printer.definition(node)[0]};"
        lines.append(textwrap.fill(text, WIDTH - 4, subsequent_indent="    ", break_long_words=False, break_on_hyphens=False))
        names[node] = name
    for result in routine.results:
        texts = [printer.text(node) for node in result.nodes]
        if _returns_value(routine):
            lines.append(f"return {texts[0]};")
        else:
            lines += [f"{_out(result)}[{i}] = {text};" for i, text in enumerate(texts)]
    body = textwrap.indent("\n".join(lines), "    ")
    comment = f"/* {textwrap.shorten(routine.formula, WIDTH - 6)} */"
    return f"{comment}\n{_signature(program, routine, precision)} {{\n{body}\n}}\n\n{_batch(program, routine, precision)}"


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
    r, t = _restrict(program), precision.type
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
