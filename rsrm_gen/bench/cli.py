"""`rsrm bench`: measurements of the compiler and its code, as tables that anyone can make again."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from rsrm_gen.files import assignments, bundled, manifold_file

app = typer.Typer(
    no_args_is_help=True,
    add_completion=False,
    rich_markup_mode=None,
    help="Measure the generated code and the compiler.",
)

Parameters = Mapping[str, int | float | str]

# What other tools have too.
CASES: tuple[tuple[str, Parameters], ...] = (
    ("sphere", {}),
    ("hyperbolic", {}),
    ("so3", {}),
    ("torus", {}),
    ("sphere", {"n": 5}),
    ("poincare", {}),
    ("half_space", {}),
    ("so3_matrix", {}),
    ("spd", {}),
    ("spd", {"n": 3}),
)
LARGE: tuple[tuple[str, Parameters], ...] = (("sphere", {"n": 16}),)
ROWS, QUICK_ROWS = 48, 8

Manifolds = Annotated[
    list[str] | None, typer.Argument(metavar="[MANIFOLD...]", help="Bundled manifolds or files.", show_default=False)
]
Assignments = Annotated[
    list[str] | None, typer.Option("-p", "--parameter", metavar="NAME=VALUE", help="A parameter of the manifolds.")
]
Markdown = Annotated[Path | None, typer.Option("--markdown", metavar="FILE", help="Write the tables as Markdown.")]
Json = Annotated[Path | None, typer.Option("--json", metavar="FILE", help="Write all figures as JSON.")]


@app.command("accuracy")
def accuracy_command(
    manifolds: Manifolds = None,
    parameter: Assignments = None,
    rows: Annotated[int, typer.Option(min=1, help="Pairs of points a band.")] = ROWS,
    quick: Annotated[bool, typer.Option("--quick", help=f"{QUICK_ROWS} pairs a band.")] = False,
    markdown: Markdown = None,
    json: Json = None,
) -> None:
    """The worst and median error of the generated code, beside other tools on the same points.

    \b
    rsrm bench accuracy                          S^2, H^2 in three models, SO(3) in two, T^2, S^5, SPD(2), SPD(3)
    rsrm bench accuracy sphere -p n=7 --quick
    rsrm bench accuracy --markdown accuracy.md --json accuracy.json

    Other tools are measured where they are installed: pip install 'rsrm-gen[peers]'.
    """
    from rsrm_gen.bench.accuracy import accuracy
    from rsrm_gen.bench.table import write_json, write_markdown

    given: Parameters = assignments(parameter or ())
    chosen = [(name, given) for name in manifolds] if manifolds else [(name, {**p, **given}) for name, p in CASES]
    cases = [(manifold_file(name), parameters) for name, parameters in chosen]
    with _progress() as say:
        result = accuracy(cases, QUICK_ROWS if quick else rows, say=say)
    console = _console()
    summary = [*result.worst(), result.counts()]
    for table in summary:
        console.print(table.rich())
        console.print()
    console.print(result.foot(), style="dim", highlight=False)
    if markdown is not None:
        write_markdown(markdown, [*summary, *result.bands()], result.foot())
    if json is not None:
        write_json(json, result.document())


@app.command("generation")
def generation_command(
    manifolds: Manifolds = None,
    parameter: Assignments = None,
    runs: Annotated[int, typer.Option(min=1, help="How often each is generated; the table has medians.")] = 3,
    quick: Annotated[bool, typer.Option("--quick", help="Once.")] = False,
    markdown: Markdown = None,
    json: Json = None,
) -> None:
    """The seconds that rsrm-gen takes, cold and when nothing changed.

    \b
    rsrm bench generation                        every bundled manifold, and S^16
    rsrm bench generation mine.yaml --runs 5
    """
    from rsrm_gen.bench.generation import document, foot, generation, tables
    from rsrm_gen.bench.table import write_json, write_markdown

    given: Parameters = assignments(parameter or ())
    chosen = [(name, given) for name in manifolds] if manifolds else [*((n, given) for n in _names()), *LARGE]
    with _progress() as say:
        results = generation(
            [(manifold_file(name), parameters) for name, parameters in chosen], 1 if quick else runs, say
        )
    console = _console()
    for table in tables(results):
        console.print(table.rich())
    console.print(foot(results), style="dim", highlight=False)
    if markdown is not None:
        write_markdown(markdown, tables(results), foot(results))
    if json is not None:
        write_json(json, document(results))


def _names() -> list[str]:
    """The bundled manifolds."""
    return sorted(path.stem for path in bundled("manifolds").glob("*.yaml"))


def _console() -> Console:
    console = Console()
    return console if console.is_terminal else Console(width=200)  # a table in a file is not cut to fit a screen


@contextmanager
def _progress() -> Iterator[Callable[[str], None]]:
    """Says on the error stream what is being measured: one changing line in a terminal, else a line each."""
    console = Console(stderr=True)
    if not console.is_terminal:
        yield lambda words: console.print(words, style="dim", highlight=False, soft_wrap=True)
        return
    with console.status("") as status:
        yield status.update
