"""The command line of the compiler, `rsrm-gen`."""

from __future__ import annotations

import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.status import Status
from rich.table import Table

from rsrm_gen.compiler.budget import SECONDS
from rsrm_gen.compiler.driver import STAGES, Compiled, compile_manifold
from rsrm_gen.compiler.native import compiler
from rsrm_gen.compiler.output import contents, staleness, write
from rsrm_gen.compiler.spec import read_spec
from rsrm_gen.errors import UserError
from rsrm_gen.version import __version__

HELP = """Compile manifolds from YAML to audited torch and C code.

A manifold file says how a point is stored, the metric, and the formulas of Exp and Log. rsrm-gen derives the rest,
proves the formulas right, and writes OUT/NAME/{NAME.py,NAME.h,NAME.c,NAME_splats.c,audit.json}.

Examples:

\b
  rsrm-gen manifolds/so3.yaml              into generated/so3/
  rsrm-gen manifolds/*.yaml --timings      several, with each stage's seconds
  rsrm-gen manifolds/sphere.yaml -p n=5    S^5, into generated/sphere_n5/
  rsrm-gen manifolds/*.yaml --check        is what is there up to date?

A manifold file has these keys; docs are in the files of manifolds/:

\b
  manifold, doc, parameters     a name, a sentence, numbers with defaults
  embedded: or chart:           how a point is stored: constraint and project,
                                or domain and period
  frame                         vectors that tangent components multiply
  metric, exp, log              formulas in p, q, u, v
  norm, distance, log_det       closed forms, optional: checked, not trusted
  injectivity_radius, diameter  lengths
  cut_locus                     where Log jumps, and what is returned there
"""

EXPLANATION = "operations of a splat with its gradient; worst errors in units of what rounding inputs and output costs"

app = typer.Typer(add_completion=False, rich_markup_mode=None, pretty_exceptions_enable=False)
out, err = Console(), Console(stderr=True)
if not out.is_terminal:
    out = Console(width=120)  # a table in a file is not cut to fit a screen


def _show_version(wanted: bool) -> None:
    if wanted:
        print(f"rsrm-gen {__version__}")
        raise typer.Exit


@app.command(help=HELP)
def compile_command(
    files: Annotated[list[Path], typer.Argument(metavar="FILE...", help="Manifold files.", show_default=False)],
    parameter: Annotated[
        list[str],
        typer.Option("-p", "--parameter", metavar="NAME=VALUE", help="Set a parameter of the manifold; repeatable."),
    ] = [],  # noqa: B006
    output: Annotated[Path, typer.Option("-o", "--output", metavar="DIR", help="The folder to write to.")] = Path(
        "generated"
    ),
    check: Annotated[
        bool, typer.Option("--check", help="Write nothing; say whether the generated files are stale or were edited.")
    ] = False,
    budget: Annotated[
        float,
        typer.Option(
            "--budget", metavar="SECONDS", min=1, help="What each stage may take of the processor.", show_default=True
        ),
    ] = SECONDS,
    timings: Annotated[bool, typer.Option("--timings", help="Show the seconds of every stage.")] = False,
    version: Annotated[
        bool, typer.Option("--version", callback=_show_version, is_eager=True, help="Show the version.")
    ] = False,
) -> None:
    """Compile, or check, manifold files."""
    parameters = dict(_assignment(text) for text in parameter)
    if check:
        _check(files, parameters, output)
    else:
        _compile(files, parameters, output, timings, budget)


def _assignment(text: str) -> tuple[str, str]:
    name, equals, value = text.partition("=")
    if not equals or not name or not value:
        raise UserError(f"`{text}` does not set a parameter", hint="write -p NAME=VALUE, like -p n=5")
    return name.strip(), value.strip()


def _check(files: list[Path], parameters: dict[str, str], output: Path) -> None:
    reasons = {}
    for file in files:
        spec = read_spec(file, parameters)
        reasons[output / spec.identifier] = staleness(spec, output / spec.identifier)
    for folder, reason in reasons.items():
        print(f"{folder}: {reason or 'up to date'}")
    if any(reasons.values()):
        options = "".join(f" -p {name}={value}" for name, value in parameters.items())
        raise UserError(
            "some generated files are not up to date",
            hint=f"generate them again: rsrm-gen {' '.join(map(str, files))}{options} -o {output}",
        )


def _compile(files: list[Path], parameters: dict[str, str], output: Path, timings: bool, budget: float) -> None:
    if compiler() is None:
        err.print("no C compiler found: the C code is written, but its numbers are not audited", soft_wrap=True)
    done: list[Compiled] = []
    try:
        for file in files:
            with _progress(file) as progress:
                compiled = compile_manifold(file, parameters, progress, budget)
            if any(compiled.program.name == other.program.name for other in done):
                raise UserError(f"{file} describes a second `{compiled.program.name}`", hint="give each its own name")
            write(contents(compiled), output / compiled.program.name)
            done.append(compiled)
    finally:
        if done:
            out.print(_table(done, timings))
            out.print(EXPLANATION, style="dim", soft_wrap=True)


@contextmanager
def _progress(file: Path) -> Iterator:  # type: ignore[type-arg]
    """A function to tell the stage to; what it is told is shown once a second has passed."""
    status = Status("", console=err)
    timer = threading.Timer(1.0, status.start)
    timer.daemon = True
    if err.is_terminal:
        timer.start()
    try:
        yield lambda stage: status.update(f"{file.name}: {stage}")
    finally:
        timer.cancel()
        status.stop()


def _table(done: list[Compiled], timings: bool) -> Table:
    table = Table(box=None, pad_edge=False, header_style="dim")
    for column in (
        "manifold",
        "dim",
        "operations",
        "float64",
        "float32",
        "audit",
        *(STAGES if timings else ()),
        "seconds",
    ):
        table.add_column(column, justify="left" if column in ("manifold", "audit") else "right", no_wrap=True)
    for compiled in done:
        seconds = [f"{compiled.seconds[stage]:.2f}" for stage in STAGES] if timings else []
        table.add_row(
            compiled.program.name,
            str(compiled.spec.dim),
            str(compiled.program["splat"].operations),
            *(_accuracy(compiled, precision) for precision in ("float64", "float32")),
            f"{len(compiled.report.checks)} checks passed",
            *seconds,
            f"{sum(compiled.seconds.values()):.1f}",
        )
    return table


def _accuracy(compiled: Compiled, precision: str) -> str:
    return f"<= {max(m.bound for m in compiled.report.measured if m.precision == precision)}"


def main() -> None:
    """The entry point: a user's mistake is printed, and exits with code 2."""
    try:
        app()
    except UserError as error:
        err.print(str(error), markup=False, highlight=False, soft_wrap=True)
        sys.exit(2)
    except KeyboardInterrupt:
        sys.exit(130)


if __name__ == "__main__":
    main()
