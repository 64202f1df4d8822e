"""HTML of what is said in words and numbers. Every text comes from outside and is escaped here."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from html import escape
from typing import Any


def number(value: float | int | None, digits: int = 4) -> str:
    """A number as a person writes it."""
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return "\N{EN DASH}"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, int):
        return f"{value:,}".replace(",", "\N{THIN SPACE}")
    if math.isinf(value):
        return "\N{INFINITY}"
    return f"{value:.{digits}g}"


def tiles(entries: Iterable[tuple[str, str, str]]) -> str:
    """Headline numbers: (what it is, the number, what to compare it with)."""
    drawn = [
        f"<div><dt>{escape(what)}</dt><dd>{escape(value)}{f'<small>{escape(beside)}</small>' if beside else ''}</dd></div>"
        for what, value, beside in entries
    ]
    return f'<dl class="tiles">{"".join(drawn)}</dl>'


def table(headings: Sequence[str], rows: Iterable[Sequence[Any]]) -> str:
    """A table; columns of numbers are aligned to the right."""
    rows = [list(row) for row in rows]
    numeric = [any(_is_number(row[i]) for row in rows) for i in range(len(headings))]
    head = "".join(f"<th{' class=n' if n else ''}>{escape(h)}</th>" for h, n in zip(headings, numeric, strict=True))
    body = "".join(
        "<tr>" + "".join(_cell(value, n) for value, n in zip(row, numeric, strict=True)) + "</tr>" for row in rows
    )
    return f'<div class="wide"><table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table></div>'


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _cell(value: Any, numeric: bool) -> str:
    if isinstance(value, bool):
        return f'<td class="{"yes" if value else "no"}">{number(value)}</td>'
    said = number(value) if _is_number(value) else "" if value is None else str(value)
    return f"<td{' class=n' if numeric else ''}>{escape(said)}</td>"


def facts(document: Mapping[str, Any]) -> str:
    """What a JSON document says, a line each; what is nested gets names with points."""
    if not document:
        return ""
    rows = "".join(
        f"<tr><td>{escape(name)}</td><td>{escape(_said(value))}</td></tr>" for name, value in _flat(document)
    )
    return f'<div class="wide"><table><tbody>{rows}</tbody></table></div>'


def _flat(document: Mapping[str, Any], above: str = "") -> Iterable[tuple[str, Any]]:
    for key, value in document.items():
        name = f"{above}{key}"
        if isinstance(value, Mapping) and value:
            yield from _flat(value, f"{name}.")
        else:
            yield name, value


def _said(value: Any) -> str:
    if value is None:
        return "left out"
    if isinstance(value, bool | int | float):
        return number(value, 6)
    if isinstance(value, list):
        return ", ".join(_said(part) for part in value)
    return str(value)
