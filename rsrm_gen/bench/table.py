"""Tables with one content and four forms: on a screen, in Markdown, in LaTeX, in JSON."""

from __future__ import annotations

import json
import os
import platform
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import rich.table

from rsrm_gen.files import write_text_whole
from rsrm_gen.version import __version__


@dataclass(frozen=True)
class Table:
    """Rows of cells under headings; the first `labels` columns say what a row is about, the others are figures."""

    title: str
    headings: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    labels: int = 1

    def rich(self) -> rich.table.Table:
        """For a terminal."""
        table = rich.table.Table(title=self.title, title_justify="left", box=None, pad_edge=False, header_style="dim")
        for i, heading in enumerate(self.headings):
            table.add_column(heading, justify="left" if i < self.labels else "right", no_wrap=True)
        for row in self.rows:
            table.add_row(*row)
        return table

    def markdown(self) -> str:
        """For a page: the title as a heading, then the table."""
        rule = ["---"] * self.labels + ["--:"] * (len(self.headings) - self.labels)
        lines = [_line(self.headings), _line(rule), *map(_line, self.rows)]
        return f"### {self.title}\n\n" + "\n".join(lines) + "\n"

    def latex(self) -> str:
        """For a paper: a `table` with the rules of booktabs; the title is its caption."""
        columns = "l" * self.labels + "r" * (len(self.headings) - self.labels)
        rows = [" & ".join(map(latex_text, row)) + r" \\" for row in (self.headings, *self.rows)]
        lines = [
            r"\begin{table}",
            r"\centering",
            rf"\caption{{{latex_text(self.title)}}}",
            rf"\begin{{tabular}}{{{columns}}}",
            r"\toprule",
            rows[0],
            r"\midrule",
            *rows[1:],
            r"\bottomrule",
            r"\end{tabular}",
            r"\end{table}",
        ]
        return "\n".join(lines) + "\n"


# What LaTeX would obey.
LATEX = {c: rf"\{c}" for c in "&%$#_{}"} | {
    "\\": r"\textbackslash{}",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    "<": "$<$",
    ">": "$>$",
    "|": "$|$",
    "±": r"$\pm$",
}


def latex_text(text: str) -> str:
    """The text as LaTeX prints it."""
    return "".join(LATEX.get(c, c) for c in text)


def write_latex(file: Path, tables: Sequence[Table], foot: str) -> None:
    """All tables and a paragraph below them, to be read by \\input into a document that uses booktabs."""
    head = r"% \usepackage{booktabs}"
    write_text_whole(file, "\n".join([head, *(table.latex() for table in tables), latex_text(foot) + "\n"]))


def _line(cells: Sequence[str]) -> str:
    return "| " + " | ".join(cell.replace("|", r"\|") for cell in cells) + " |"


def write_markdown(file: Path, tables: Sequence[Table], foot: str) -> None:
    """All tables and a paragraph below them, into a file."""
    write_text_whole(file, "\n".join([*(table.markdown() for table in tables), foot + "\n"]))


def write_json(file: Path, document: Any) -> None:
    """A document of plain data, into a file."""
    write_text_whole(file, json.dumps(document, indent=1, allow_nan=False) + "\n")


def figure(x: float) -> str:
    """An error in a table cell, in two digits or less."""
    if x == 0:
        return "0"
    if x < 0.01:
        return "<0.01"
    if x >= 1e4:
        mantissa, exponent = f"{x:.0e}".split("e")
        return f"{mantissa}e{int(exponent)}"
    if x >= 99.5:
        return f"{x:.0f}"
    return f"{x:.2g}"


def machine() -> str:
    """This machine and what runs here, in words."""
    python = f"Python {platform.python_version()}"
    return f"rsrm-gen {__version__}, {python}, {platform.system()}, {_processor()}, {os.cpu_count()} cores"


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return platform.processor() or platform.machine()
    return next((line.partition(":")[2].strip() for line in lines if line.startswith("model name")), platform.machine())
