"""What several commands ask for."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

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
