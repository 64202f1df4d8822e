"""`rsrm-gen FILE...`: manifold files to code; `--check`: is the code what the files give?"""

from __future__ import annotations

import difflib
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from rsrm_gen.compiler.budget import SECONDS
from rsrm_gen.compiler.cli.options import GENERATED, BudgetOption, OutputOption, ParameterOption
from rsrm_gen.compiler.cli.screen import err, out, table
from rsrm_gen.compiler.output import staleness, unchanged, write
from rsrm_gen.errors import UserError
from rsrm_gen.files import assignments, manifold_file

if TYPE_CHECKING:
    from rich.table import Table

    from rsrm_gen.compiler.driver import Compiled

HELP = """Compile manifold files; the word `compile` may be left out.

What is there already and was made of the same text, parameters and compiler is left alone.
"""
COMMANDS = ("compile", "new", "list", "explain", "audit", "schema")
EXPLANATION = "operations of a splat with its gradient; worst errors in units of what rounding inputs and output costs"


def compile_command(
    files: Annotated[
        list[str], typer.Argument(metavar="FILE", help="Manifold files, or bundled names.", show_default=False)
    ],
    parameter: ParameterOption = [],  # noqa: B006
    output: OutputOption = GENERATED,
    check: Annotated[
        bool, typer.Option("--check", help="Write nothing; say whether the generated files are stale or were edited.")
    ] = False,
    force: Annotated[bool, typer.Option("--force", help="Compile also what did not change.")] = False,
    budget: BudgetOption = SECONDS,
    timings: Annotated[bool, typer.Option("--timings", help="Show the seconds of every stage.")] = False,
) -> None:
    """Compile, or check, manifold files."""
    parameters = assignments(parameter)
    paths = [_file(name) for name in files]
    if check:
        _check(paths, parameters, output)
    else:
        _compile(paths, parameters, output, force, timings, budget)


def _file(name: str) -> Path:
    try:
        return manifold_file(name)
    except UserError as error:
        close = difflib.get_close_matches(name, COMMANDS, n=1)
        hint = (
            f"did you mean `rsrm-gen {close[0]}`?" if close else f"{error.hint}; `rsrm-gen --help` lists the commands"
        )
        raise UserError(f"there is no command or bundled manifold `{name}`", hint=hint) from None


def _check(files: list[Path], parameters: dict[str, str], output: Path) -> None:
    reasons = {}
    for file in files:
        folder, reason = _state(file, parameters, output)
        reasons[folder] = reason
    for folder, reason in reasons.items():
        print(f"{folder}: {reason or 'up to date'}")
    if any(reasons.values()):
        options = "".join(f" -p {name}={value}" for name, value in parameters.items())
        raise UserError(
            "some generated files are not up to date",
            hint=f"generate them again: rsrm-gen {' '.join(map(str, files))}{options} -o {output}",
        )


def _state(file: Path, parameters: dict[str, str], output: Path) -> tuple[Path, str | None]:
    """Where the code of a file belongs, and why what is there is not it."""
    folder = unchanged(file, parameters, output)
    if folder is not None:
        return folder, None
    from rsrm_gen.compiler.spec import read_spec

    spec = read_spec(file, parameters)
    return output / spec.identifier, staleness(spec, output / spec.identifier)


def _compile(
    files: list[Path], parameters: dict[str, str], output: Path, force: bool, timings: bool, budget: float
) -> None:
    done: list[Compiled] = []
    sources: dict[Path, Path] = {}  # by folder
    try:
        for file in files:
            folder, reason = _state(file, parameters, output)
            if sources.setdefault(folder, file) is not file:
                raise UserError(f"{file} describes a second `{folder.name}`", hint="give each its own name")
            if reason is None and not force:
                print(f"{folder}: up to date")
            else:
                done.append(_compiled(file, parameters, folder, budget, warn=not done))
    finally:
        if done:
            out().print(_table(done, timings))
            out().print(EXPLANATION, style="dim", soft_wrap=True)


def _compiled(file: Path, parameters: dict[str, str], folder: Path, budget: float, warn: bool) -> Compiled:
    from rsrm_gen.compiler.driver import compile_manifold
    from rsrm_gen.compiler.native import compiler
    from rsrm_gen.compiler.output import contents

    if warn and compiler() is None:
        err().print("no C compiler found: the C code is written, but its numbers are not audited", soft_wrap=True)
    with progress(file.name) as tell:
        compiled = compile_manifold(file, parameters, tell, budget)
    write(contents(compiled), folder)
    return compiled


@contextmanager
def progress(name: str) -> Iterator[Callable[[str], None]]:
    """A function to tell the stage to; what it is told is shown once a second has passed."""
    from rich.status import Status

    status = Status("", console=err())
    timer = threading.Timer(1.0, status.start)
    timer.daemon = True
    if err().is_terminal:
        timer.start()
    try:
        yield lambda stage: status.update(f"{name}: {stage}")
    finally:
        timer.cancel()
        status.stop()


def _table(done: list[Compiled], timings: bool) -> Table:
    from rsrm_gen.compiler.driver import STAGES

    stages = STAGES if timings else ()
    columns = ("manifold", "dim", "operations", "float64", "float32", "audit", *stages, "seconds")
    rows = [
        (
            compiled.program.name,
            str(compiled.spec.dim),
            str(compiled.program["splat"].operations),
            *(_accuracy(compiled, precision) for precision in ("float64", "float32")),
            f"{len(compiled.report.checks)} checks passed",
            *(f"{compiled.seconds[stage]:.2f}" for stage in stages),
            f"{sum(compiled.seconds.values()):.1f}",
        )
        for compiled in done
    ]
    return table(columns, rows, left=("manifold", "audit"))


def _accuracy(compiled: Compiled, precision: str) -> str:
    return f"<= {max(m.bound for m in compiled.report.measured if m.precision == precision)}"
