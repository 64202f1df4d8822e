"""Syntax trees as text again: what `parse` reads back as the same tree."""

from __future__ import annotations

from fractions import Fraction

from rsrm_gen.compiler.spec import formula as f

PRECEDENCE = {"=": 0, "<": 0, "<=": 0, ">": 0, ">=": 0, "+": 1, "-": 1, "*": 2, "/": 2, "^": 4}
NEGATE, ITEM = 3, 5


def written(tree: f.Tree) -> str:
    """The formula, with no more brackets than it needs."""
    match tree:
        case f.Number():
            return _number(tree.value)
        case f.Name():
            return tree.name
        case f.Call():
            return f"{tree.function}({', '.join(map(written, tree.arguments))})"
        case f.Negate():
            return "-" + _inside(tree.operand, NEGATE)
        case f.Binary() | f.Compare():
            level = PRECEDENCE[tree.operator]
            if tree.operator == "^":
                return f"{_inside(tree.left, ITEM)}^{_inside(tree.right, NEGATE)}"
            return f"{_inside(tree.left, level)} {tree.operator} {_inside(tree.right, level + 1)}"
        case f.Stack() | f.Rows():
            return f"[{', '.join(map(written, tree.items))}]"
        case f.Index():
            start, stop = (written(bound) if bound is not None else "" for bound in (tree.start, tree.stop))
            return f"{_inside(tree.base, ITEM)}[{f'{start}:{stop}' if tree.slice else start}]"


def _inside(tree: f.Tree, level: int) -> str:
    """The formula as an operand of something that binds as tightly as `level`."""
    text = written(tree)
    return text if _level(tree) >= level else f"({text})"


def _level(tree: f.Tree) -> int:
    match tree:
        case f.Binary() | f.Compare():
            return PRECEDENCE[tree.operator]
        case f.Negate():
            return NEGATE
        case f.Number():
            return ITEM if tree.value.denominator == 1 or _is_decimal(tree.value) else PRECEDENCE["/"]
    return ITEM


def _number(value: Fraction) -> str:
    if value.denominator == 1:
        return str(value.numerator)
    return _decimal(value) if _is_decimal(value) else f"{value.numerator} / {value.denominator}"


def _is_decimal(value: Fraction) -> bool:
    rest = value.denominator
    for prime in (2, 5):
        while rest % prime == 0:
            rest //= prime
    return rest == 1 and value.denominator < 10**15


def _decimal(value: Fraction) -> str:
    places = 0
    while (value * 10**places).denominator != 1:
        places += 1
    digits = str((value * 10**places).numerator).rjust(places + 1, "0")
    return f"{digits[:-places]}.{digits[-places:]}"
