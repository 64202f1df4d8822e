"""The operation table: how many arithmetic operations each function of each bundled manifold takes.

It is committed in docs/operations.md, written by `make update` and compared by a test, so that a change that makes the
generated code slower is seen as a difference of numbers. Run as `python -m rsrm_gen.compiler.operations PAGE MANIFOLD...`.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

from rsrm_gen.compiler.derive import derive
from rsrm_gen.compiler.lower import Program, lower
from rsrm_gen.compiler.spec import read_spec
from rsrm_gen.errors import UserError
from rsrm_gen.files import write_text_whole

Counts = Mapping[str, int]  # by function

INTRODUCTION = """\
# Operations of the generated code

How many arithmetic operations one call takes, by `make update`; a test compares. A call of a function of the C library
is one operation, a polynomial counts its steps. `splat` is a wrapped Gaussian with its gradient, `splat_vjp` its adjoint.
"""


def operations(program: Program) -> dict[str, int]:
    """The operations of every function of a program."""
    return {routine.name: routine.operations for routine in program}


def page(counts: Mapping[str, Counts]) -> str:
    """The table as a Markdown page: one manifold a line, one function a column."""
    functions = list(dict.fromkeys(function for row in counts.values() for function in row))
    lines = [
        _line("manifold", functions),
        _line("---", ["--:"] * len(functions)),
        *(_line(name, [str(row.get(f, "-")) for f in functions]) for name, row in sorted(counts.items())),
    ]
    return INTRODUCTION + "\n" + "\n".join(lines) + "\n"


def read_page(text: str) -> dict[str, dict[str, int]]:
    """The counts in a page that `page` wrote."""
    table = [
        [cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines() if line.startswith("|")
    ]
    (_, *functions), _, *rows = table
    return {
        name: {f: int(cell) for f, cell in zip(functions, cells, strict=True) if cell != "-"} for name, *cells in rows
    }


def _line(name: str, cells: Sequence[str]) -> str:
    return "| " + " | ".join([name, *cells]) + " |"


def main(arguments: Sequence[str] | None = None) -> None:
    """Write the page of some manifold files, whole; a user's mistake is printed, and exits with code 2."""
    output, *files = map(Path, sys.argv[1:] if arguments is None else arguments)
    try:
        programs = [lower(derive(read_spec(file))) for file in files]
        write_text_whole(output, page({program.name: operations(program) for program in programs}))
    except UserError as error:
        print(error, file=sys.stderr)
        sys.exit(2)


if __name__ == "__main__":
    main()
