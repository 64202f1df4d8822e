"""What several commands ask for."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from rsrm_gen.errors import UserError

ParameterOption = Annotated[
    list[str],
    typer.Option("-p", "--parameter", metavar="NAME=VALUE", help="Set a parameter of the manifold; repeatable."),
]
OutputOption = Annotated[
    Path, typer.Option("-o", "--output", metavar="DIR", help="The folder of the folders of generated code.")
]
BudgetOption = Annotated[
    float, typer.Option("--budget", metavar="SECONDS", min=1, help="What each stage may take of the processor.")
]
GENERATED = Path("generated")


def assignments(texts: list[str]) -> dict[str, str]:
    """`["n=5"]` as `{"n": "5"}`."""
    return dict(_assignment(text) for text in texts)


def _assignment(text: str) -> tuple[str, str]:
    name, equals, value = text.partition("=")
    if not equals or not name or not value:
        raise UserError(f"`{text}` does not set a parameter", hint="write -p NAME=VALUE, like -p n=5")
    return name.strip(), value.strip()
