"""`rsrm-gen list`: which manifolds there are."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from rsrm_gen.compiler.cli.options import GENERATED, OutputOption
from rsrm_gen.compiler.cli.screen import out, table
from rsrm_gen.compiler.cli.targets import manifold_files
from rsrm_gen.compiler.output import staleness
from rsrm_gen.errors import UserError
from rsrm_gen.files import bundled


def list_command(
    folder: Annotated[
        Path | None, typer.Argument(metavar="[DIR]", help="A folder of manifold files; by default the bundled ones.")
    ] = None,
    output: OutputOption = GENERATED,
) -> None:
    """List the bundled manifolds, or those of a folder.

    Shows dimension and parameters, what they are, and whether their generated code is up to date.
    """
    if folder is not None and not folder.is_dir():
        raise UserError(f"there is no folder {folder}")
    files = manifold_files(folder or bundled("manifolds"))
    if not files:
        raise UserError(f"there are no manifold files in {folder}")
    columns = ("manifold", "dim", "parameters", "code", "what it is")
    rows = (_row(file, output) for file in files)
    out().print(table(columns, rows, left=("manifold", "parameters", "code", "what it is"), folds="what it is"))


def _row(file: Path, output: Path) -> tuple[str, ...]:
    from rsrm_gen.compiler.spec import read_spec

    try:
        spec = read_spec(file)
    except UserError as error:
        return file.stem, "", "", "", f"cannot be read: {error.message}"
    parameters = ", ".join(f"{name} = {value}" for name, value in spec.parameters)
    return spec.identifier, str(spec.dim), parameters, _state(spec.identifier, file, output), spec.doc


def _state(identifier: str, file: Path, output: Path) -> str:
    """Whether the code in the output folder, or else the bundled one, is what the file gives."""
    from rsrm_gen.compiler.spec import read_spec

    folders = [folder / identifier for folder in (output, bundled("generated"))]
    folder = next((folder for folder in folders if folder.is_dir()), None)
    return "not generated" if folder is None else staleness(read_spec(file), folder) or "up to date"
