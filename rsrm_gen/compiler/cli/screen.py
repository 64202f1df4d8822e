"""Where commands print: tables on stdout, progress and complaints on stderr."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cache
from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

UNCUT = 1000  # characters of a line in a file: a table there is not cut to fit a screen


@cache
def out() -> Console:
    """Stdout."""
    return _console(stderr=False)


@cache
def err() -> Console:
    """Stderr."""
    return _console(stderr=True)


def _console(stderr: bool) -> Console:
    from rich.console import Console

    console = Console(stderr=stderr)
    return console if console.is_terminal else Console(stderr=stderr, width=UNCUT)


def table(
    columns: Sequence[str], rows: Iterable[Sequence[str]], left: Sequence[str] = (), folds: str = "", cut: str = ""
) -> Table:
    """A table without lines: numbers to the right, the columns in `left` to the left.

    On a narrow screen one column may fold or be cut; no other column loses a character.
    """
    from rich.table import Table
    from rich.text import Text

    cells = [[*row] for row in rows]
    result = Table(box=None, pad_edge=False, header_style="dim")
    for i, column in enumerate(columns):
        width = max(len(text) for text in (column, *(row[i] for row in cells)))
        free = column in (folds, cut)
        justify: Literal["left", "right"] = "left" if column in left else "right"
        result.add_column(column, justify=justify, no_wrap=column != folds, min_width=None if free else width)
    for row in cells:
        result.add_row(*map(Text, row))
    return result
