"""`rsrm-gen new NAME`: a manifold file to begin with."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Annotated

import typer

from rsrm_gen.errors import UserError
from rsrm_gen.files import write_text_whole

TEMPLATES = Path(__file__).parent / "templates"
NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,39}")


def new_command(
    name: Annotated[str, typer.Argument(metavar="NAME", help="The name of the manifold.", show_default=False)],
    embedded: Annotated[
        bool, typer.Option("--embedded", help="Points are vectors under a constraint; what you get by default.")
    ] = False,
    chart: Annotated[bool, typer.Option("--chart", help="Points are coordinates, maybe periodic.")] = False,
    product: Annotated[bool, typer.Option("--product", help="Points are those of several manifolds.")] = False,
    folder: Annotated[Path, typer.Option("-o", "--output", metavar="DIR", help="The folder to write to.")] = Path("."),
) -> None:
    """Write NAME.yaml, a manifold to begin with.

    It is commented and compiles as it is, to be edited into your own.
    """
    if embedded + chart + product > 1:
        raise UserError("a manifold is one of --embedded, --chart and --product")
    if not NAME.fullmatch(name):
        raise UserError(
            f"`{name}` is no name for a manifold",
            hint="use letters, digits and underscores, a letter first, 40 at most",
        )
    kind = "chart" if chart else "product" if product else "embedded"
    file = folder / f"{name}.yaml"
    if file.exists():
        raise UserError(f"{file} is there already", hint="choose another name, or another folder with -o")
    text = (TEMPLATES / f"{kind}.yaml").read_text(encoding="utf-8")
    write_text_whole(file, text.replace("NAME", name))
    print(f"{file}: edit it, then compile it with\n  rsrm-gen {file}")
