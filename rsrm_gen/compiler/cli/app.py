"""The commands under their names; what names no command is a manifold to compile."""

from __future__ import annotations

from typing import Annotated, Any

import typer
from typer.core import TyperGroup

from rsrm_gen.compiler.cli.audit import audit_command
from rsrm_gen.compiler.cli.compile import HELP as COMPILE_HELP
from rsrm_gen.compiler.cli.compile import compile_command
from rsrm_gen.compiler.cli.explain import explain_command
from rsrm_gen.compiler.cli.list import list_command
from rsrm_gen.compiler.cli.new import new_command
from rsrm_gen.compiler.cli.schema import schema_command
from rsrm_gen.version import __version__

HELP = """Compile manifolds from YAML to audited torch and C code.

A manifold file says how a point is stored, the metric, and the formulas of Exp and Log. rsrm-gen derives the rest,
proves the formulas right, and writes OUT/NAME/{NAME.py,NAME.h,NAME.c,NAME_splats.c,audit.json}.

Examples:

\b
  rsrm-gen new mine                        mine.yaml, a manifold to begin with
  rsrm-gen mine.yaml                       compiled and audited, into generated/mine/
  rsrm-gen manifolds/*.yaml --timings      several, with each stage's seconds
  rsrm-gen sphere -p n=5                   the bundled S^n, into generated/sphere_n5/
  rsrm-gen manifolds/*.yaml --check        is what is there up to date?
  rsrm-gen audit generated/mine            every check again, on the code as it is now

Where a FILE or SPEC is asked for, the name of a bundled manifold will do. The language of manifold files is
described in docs/language.md. Exit codes: 0, 1 when a check of `audit` fails, 2 for a mistake.
"""


class _CompileByDefault(TyperGroup):
    """`rsrm-gen FILE` is `rsrm-gen compile FILE`."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        known = {*self.commands, "--help", "--version"}
        if args and args[0] not in known:
            args = ["compile", *args]
        return super().parse_args(ctx, args)


app = typer.Typer(
    cls=_CompileByDefault,
    help=HELP,
    add_completion=False,
    no_args_is_help=True,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
)


def _show_version(wanted: bool) -> None:
    if wanted:
        print(f"rsrm-gen {__version__}")
        raise typer.Exit


@app.callback(help=HELP)
def _options(
    version: Annotated[
        bool, typer.Option("--version", callback=_show_version, is_eager=True, help="Show the version.")
    ] = False,
) -> None:
    """Options of no command."""


app.command("compile", help=COMPILE_HELP)(compile_command)
app.command("new")(new_command)
app.command("list")(list_command)
app.command("explain")(explain_command)
app.command("audit")(audit_command)
app.command("schema")(schema_command)
