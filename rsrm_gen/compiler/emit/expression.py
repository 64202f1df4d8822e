"""Expressions as text, with as few parentheses as their meaning allows. A language differs only in its spellings."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from rsrm_gen.compiler.lower import Node

SUM, PRODUCT, UNARY, ATOM = 1, 2, 3, 4  # how tightly an expression binds
COMPARISONS = {"less": "<", "less_equal": "<=", "equal": "=="}


@dataclass(frozen=True)
class Spelling:
    """How a language writes what is not arithmetic.

    `function` maps an operation to a template of its arguments; `select`, `polynomial` and `eps` likewise.
    """

    function: Mapping[str, str]
    select: str  # {condition}, {x}, {y}
    pick: str  # the same for two numbers; {like} is a quantity of the precision in use
    polynomial: str  # {x}, {coefficients}
    entry: str  # {whole}, {index}: one value of a function of a matrix
    eigenvalue: str  # {whole}, {index}
    eps: str
    suffix: str  # of floating-point literals
    compare_binds: int  # how tightly a comparison binds where a select reads it


class Printer:
    """Prints nodes: those with a name by their name, the others in place."""

    def __init__(self, spelling: Spelling, names: dict[Node, str], coefficients: Mapping[Any, str]) -> None:
        self.spelling = spelling
        self.names = names
        self.coefficients = coefficients  # of polynomials, to the names of their tables

    def text(self, node: Node, binding: int = 0) -> str:
        """The node as its users write it; in parentheses where they bind more tightly."""
        if node in self.names:
            return self.names[node]
        text, own = self.definition(node)
        return f"({text})" if own < binding else text

    def definition(self, node: Node) -> tuple[str, int]:
        """The expression of a node, and how tightly it binds."""
        a = node.arguments
        match node.op:
            case "constant":
                return self.number(node)
            case "eps":
                return self.spelling.eps, ATOM
            case "neg":
                return f"-{self.text(a[0], ATOM)}", UNARY
            case "add" | "sub":
                sign = "+" if node.op == "add" else "-"
                return f"{self.text(a[0], SUM)} {sign} {self.text(a[1], PRODUCT)}", SUM
            case "mul" | "div":
                sign = "*" if node.op == "mul" else "/"
                return f"{self.text(a[0], PRODUCT)} {sign} {self.text(a[1], UNARY)}", PRODUCT
            case "less" | "less_equal" | "equal":
                return (
                    f"{self.text(a[0], SUM)} {COMPARISONS[node.op]} {self.text(a[1], SUM)}",
                    self.spelling.compare_binds,
                )
            case "select":
                parts = (self.text(x, binding) for x, binding in zip(a, (SUM, SUM, SUM), strict=True))
                condition, x, y = parts
                template = self.spelling.pick if a[1].is_constant and a[2].is_constant else self.spelling.select
                return template.format(condition=condition, x=x, y=y, like=self.operand(a[0])), ATOM
            case "polynomial":
                return self.spelling.polynomial.format(
                    x=self.text(a[0]), coefficients=self.coefficients[node.value]
                ), ATOM
            case "entry":
                of_eigh = a[0].op == "eigh"
                template = self.spelling.eigenvalue if of_eigh else self.spelling.entry
                return template.format(whole=self.names[a[0]], index=node.value), ATOM
        return self.spelling.function[node.op].format(*(self.text(x) for x in a)), ATOM

    def operand(self, node: Node) -> str:
        """Something that a condition compares and that is not a number."""
        return next((self.text(x) for x in node.arguments if not x.is_constant), "")

    def number(self, node: Node) -> tuple[str, int]:
        """An exact number as the nearest double."""
        value = float(node.value.evalf(25))  # type: ignore[attr-defined]
        return repr(value) + self.spelling.suffix, ATOM if value >= 0 else UNARY
