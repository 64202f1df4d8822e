"""The one exception that a user's mistake raises: where it is, what is wrong, what to write instead."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

WIDTH = 160  # of a line that is shown whole


@dataclass(frozen=True)
class Source:
    """A text a user wrote: `name` is how they know it (a path, or "<text>")."""

    name: str
    text: str

    def line(self, number: int) -> str:
        """The line with that 1-based number, without its newline; empty past the end."""
        return self.lines[number - 1] if 0 < number <= len(self.lines) else ""

    @cached_property
    def lines(self) -> list[str]:
        """All lines, without their newlines."""
        return self.text.splitlines()


@dataclass(frozen=True)
class Span:
    """Some characters of one line of a source; `line` and `column` count from 1."""

    source: Source
    line: int
    column: int
    length: int = 1

    def inner(self, offset: int, length: int = 1) -> Span:
        """The part of this span that starts `offset` characters into it."""
        return Span(self.source, self.line, self.column + offset, max(length, 1))

    def __str__(self) -> str:
        return f"{self.source.name}:{self.line}:{self.column}"


class UserError(Exception):
    """Something in the user's input is wrong; the command line prints it and exits with code 2."""

    def __init__(self, message: str, span: Span | None = None, hint: str | None = None) -> None:
        super().__init__(message)
        self.message = message
        self.span = span
        self.hint = hint

    def __str__(self) -> str:
        where = f"{self.span}: " if self.span else ""
        lines = [f"{where}error: {self.message}"]
        if self.span:
            lines += _pointed_at(self.span)
        if self.hint:
            lines.append(f"  hint: {self.hint}")
        return "\n".join(printable(line) for line in "\n".join(lines).split("\n"))


def printable(text: str) -> str:
    """The text with a mark for every character that a terminal would not show but obey, like an escape."""
    return "".join(c if c == "\t" or c == " " or c.isprintable() else "\ufffd" for c in text)


def _pointed_at(span: Span) -> list[str]:
    """The line of a span, or the part of a long one that is near, with a caret below."""
    text, column = span.source.line(span.line), span.column - 1
    start = max(column - WIDTH // 2, 0) if len(text) > WIDTH else 0
    shown = text[start : start + WIDTH]
    before = ("... " if start else "") + shown[: column - start]
    marked = shown[column - start : column - start + span.length]
    after = shown[len(marked) + column - start :] + (" ..." if start + WIDTH < len(text) else "")
    # Tabs stay tabs, so that the caret stands under its character in any terminal.
    indent = "".join("\t" if c == "\t" else " " * _cells(c) for c in before)
    return [f"  {before}{marked}{after}", f"  {indent}^{'~' * (sum(map(_cells, marked)) - 1)}"]


def _cells(character: str) -> int:
    """How many cells of a terminal a character takes."""
    return 2 if unicodedata.east_asian_width(character) in "WF" else 1


def did_you_mean(name: str, known: Iterable[str]) -> str | None:
    """A hint that names the closest of the known names, or lists them when none is close."""
    import difflib  # not needed by who makes no mistake

    names = sorted(known)
    close = difflib.get_close_matches(name, names, n=1)
    if close:
        return f"did you mean `{close[0]}`?"
    return f"known here: {', '.join(names)}" if names else None
