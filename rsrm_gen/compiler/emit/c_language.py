"""How C writes what the graph computes: precisions, spellings, statements. Shared by the C files that are emitted."""

from __future__ import annotations

import textwrap
from collections.abc import Callable

from rsrm_gen.compiler.emit import c_matrix
from rsrm_gen.compiler.emit.c_precision import FLOAT, Precision
from rsrm_gen.compiler.emit.expression import UNARY, Printer, Spelling
from rsrm_gen.compiler.emit.series import Coefficients, described, in_double, in_single, spelled
from rsrm_gen.compiler.lower import Program, Routine
from rsrm_gen.compiler.lower.ir import FUNCTIONS, SEVERAL

WIDTH = 110
NAMES = {"root": "sqrt", "abs": "fabs", "round": "rint"}  # the others are called in C what they are called here


def comment(lines: list[str]) -> str:
    """A block comment."""
    safe = (line.replace("*/", "* /").replace("/*", "/ *").replace("??/", "?? /") for line in lines)
    return "/*\n" + "".join(f" * {line}".rstrip() + "\n" for line in safe) + " */"


def restrict(program: Program) -> str:
    """The macro that stands for C's restrict, which C++ spells otherwise."""
    return f"{program.name.upper()}_RESTRICT"


def spelling(precision: Precision) -> Spelling:
    """How C writes the operations in a precision."""
    function = {name: f"{NAMES.get(name, name)}{precision.suffix}({{}})" for name in FUNCTIONS}
    function["atan2"] = f"atan2{precision.suffix}({{}}, {{}})"
    return Spelling(
        function,
        select="({condition} ? {x} : {y})",
        pick="({condition} ? {x} : {y})",
        polynomial="{coefficients}({x})",
        entry="{whole}[{index}]",
        eigenvalue="{whole}[{index}]",
        eps=precision.eps,
        suffix=precision.suffix,
        compare_binds=UNARY,
    )


def series_name(table: str, precision: Precision) -> str:
    """The function of a table of coefficients."""
    return f"polynomial_{table.lower()}{precision.tag}"


def series_function(name: str, coefficients: Coefficients, precision: Precision) -> str:
    """A polynomial by Horner's rule, as an inline function, with its degree and what that costs."""
    title, body = series_body(name, coefficients, precision)
    t = precision.type
    return f"/* {title} */\nstatic inline {t} {series_name(name, precision)}({t} x) {{\n{body}\n}}"


def series_body(
    name: str, coefficients: Coefficients, precision: Precision, body: Callable[[list[str]], str] | None = None
) -> tuple[str, str]:
    """What a polynomial's comment says, and its body: by Horner's rule, or as `body` makes it of the coefficients."""
    numbers, title = in_double(coefficients), described(name, coefficients)
    if precision is FLOAT:
        single = in_single(coefficients)
        if single.degree < len(numbers) - 1:
            title = f"of degree {single.degree}, within {single.bits} of that of double precision"
        numbers = single.coefficients
    texts = spelled(numbers, precision.suffix)
    return f"{title[0].upper()}{title[1:]}.", body(texts) if body else wrapped(f"return {horner(texts, 'x')};")


def horner(coefficients: list[str], x: str) -> str:
    """c0 + x (c1 + x (c2 + ...))."""
    *rest, last = coefficients
    text = last
    for coefficient in reversed(rest):
        text = f"{coefficient} + {x} * ({text})" if text != last else f"{coefficient} + {x} * {text}"
    return text


def wrapped(statement: str) -> str:
    """A statement of a function's body, in lines that are not too long."""
    text = textwrap.fill(statement, WIDTH - 4, subsequent_indent="    ", break_long_words=False, break_on_hyphens=False)
    return textwrap.indent(text, "    ")


def statements(routine: Routine, printer: Printer, precision: Precision) -> list[str]:
    """The body of a routine; the printer learns its names."""
    lines = []
    for name, node in routine.body:
        if node.op in SEVERAL:
            arguments = [printer.text(a) for a in node.arguments]
            lines += c_matrix.call(name, node, arguments, precision).splitlines()
            printer.names[node] = name
            continue
        condition = node.op in ("less", "less_equal", "equal")
        text = f"const {'int' if condition else precision.type} {name} = {printer.definition(node)[0]};"
        lines.append(
            textwrap.fill(text, WIDTH - 4, subsequent_indent="    ", break_long_words=False, break_on_hyphens=False)
        )
        printer.names[node] = name
    return lines
