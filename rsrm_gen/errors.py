"""The one exception that a user's mistake raises: where it is, what is wrong, what to write instead."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass


@dataclass(frozen=True)
class Source:
    """A text a user wrote: `name` is how they know it (a path, or "<text>")."""

    name: str
    text: str

    def line(self, number: int) -> str:
        """The line with that 1-based number, without its newline; empty past the end."""
        lines = self.text.splitlines()
        return lines[number - 1] if 0 < number <= len(lines) else ""


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
            text = self.span.source.line(self.span.line)
            # Tabs stay tabs, so that the caret stands under its character in any terminal.
            indent = "".join("\t" if c == "\t" else " " for c in text[: self.span.column - 1])
            lines += [f"  {text}", f"  {indent}^{'~' * (min(self.span.length, len(text)) - 1)}"]
        if self.hint:
            lines.append(f"  hint: {self.hint}")
        return "\n".join(lines)


def did_you_mean(name: str, known: Iterable[str]) -> str | None:
    """A hint that names the closest of the known names, or lists them when none is close."""
    import difflib  # not needed by who makes no mistake

    names = sorted(known)
    close = difflib.get_close_matches(name, names, n=1)
    if close:
        return f"did you mean `{close[0]}`?"
    return f"known here: {', '.join(names)}" if names else None
