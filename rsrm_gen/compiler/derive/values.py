"""What formulas are while they are read: vectors and matrices not yet multiplied out, comparisons, choices."""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from rsrm_gen.compiler.derive.geometry import EPS, EQUAL, LESS, LESS_EQUAL, Choose
from rsrm_gen.compiler.derive.numeric import value
from rsrm_gen.errors import Span


@dataclass(frozen=True)
class Vector:
    """entries * product(factors) / product(divisors), not multiplied out; with `columns`, a matrix row by row."""

    entries: tuple[sp.Expr, ...]
    factors: tuple[sp.Expr, ...] = ()
    divisors: tuple[sp.Expr, ...] = ()
    columns: int | None = None

    @property
    def rows(self) -> int:
        """How many rows a matrix has; the entries of a vector."""
        return len(self.entries) // (self.columns or 1)

    def entry(self, i: int, j: int) -> sp.Expr:
        """An entry of a matrix, without factors and divisors."""
        assert self.columns is not None
        return self.entries[i * self.columns + j]

    def suffix(self, k: int) -> str:
        """What an entry is called after: 3, or 1_0 in a matrix."""
        return str(k) if self.columns is None else f"{k // self.columns}_{k % self.columns}"


@dataclass(frozen=True)
class Truth:
    """A comparison: a < b, a <= b or a == b by kind."""

    kind: sp.Integer
    a: sp.Expr
    b: sp.Expr


@dataclass(frozen=True)
class Symmetry:
    """What a function of symmetric matrices takes for granted: that two entries are equal, at a place in the file."""

    pairs: tuple[tuple[sp.Expr, sp.Expr], ...]
    span: Span


def choose(condition: Truth, x: sp.Expr, y: sp.Expr) -> sp.Expr:
    """x where the condition holds, else y; decided here when it compares numbers."""
    a, b = condition.a, condition.b
    if not (a - b).is_number or (a - b).has(EPS):
        return Choose(condition.kind, a, b, x, y)
    difference = value(a - b, {})
    holds = {LESS: difference < 0, LESS_EQUAL: difference <= 0, EQUAL: difference == 0}[condition.kind]
    return x if holds else y
