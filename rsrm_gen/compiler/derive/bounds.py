"""How large formulas may become while they are read, so that what cannot be interrupted ends soon.

A formula of a few lines can stand for more operations than a machine performs: every `let` may double the one before.
Quantities that have a name are symbols, and cost nothing; what is counted is an expression between two names, written
out as a tree.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

import mpmath as mp
import sympy as sp

from rsrm_gen.compiler.budget import spend
from rsrm_gen.compiler.derive.numeric import value
from rsrm_gen.errors import Span, UserError

MAX_OPERATIONS = 20_000  # of one scalar expression between two names
MAX_DEPTH = 60
MAX_BITS = 4096  # of a number: four times the exponents of double precision
LARGEST = mp.mpf(2) ** 1024  # of double precision
MAX_EXPANDED = 6  # rows of a matrix whose determinant is written out: its terms grow like a factorial
MAX_TERMS = 400  # of numerators and denominators that are multiplied out to find common factors
LET = "name its parts with `let`"


@dataclass(frozen=True)
class Size:
    """Operations and depth of an expression as a tree."""

    operations: int
    depth: int


@dataclass
class Sizes:
    """Measures expressions; parts are shared, and each is measured once. Some symbols may stand for expressions."""

    known: dict[sp.Basic, Size] = field(default_factory=dict)

    def of(self, expression: sp.Basic) -> Size:
        """The size of an expression."""
        size = self.known.get(expression)
        if size is None:
            parts = [self.of(a) for a in expression.args]
            size = Size(1 + sum(p.operations for p in parts), 1 + max((p.depth for p in parts), default=0))
            self.known[expression] = size
        return size

    def check(self, expressions: Iterable[sp.Basic], span: Span | None) -> None:
        """Refuse expressions that are too large to be worked on; the others are paid for."""
        sizes = [self.of(expression) for expression in expressions]
        if any(size.operations > MAX_OPERATIONS for size in sizes):
            raise UserError(f"this multiplies out to more than {MAX_OPERATIONS} operations", span, LET)
        if any(size.depth > MAX_DEPTH for size in sizes):
            raise UserError(f"this is nested deeper than {MAX_DEPTH} levels", span, LET)
        spend(sum(size.operations for size in sizes))


def require_real(expressions: Iterable[sp.Expr], span: Span) -> None:
    """Refuse what is no finite real number whatever the arguments are, and numbers beyond floating point."""
    for expression in expressions:
        if any(max(abs(r.p), r.q).bit_length() > MAX_BITS for r in expression.atoms(sp.Rational)):
            raise UserError("a number out of the range of floating point", span)
        impossible = expression.has(sp.zoo, sp.nan, sp.oo, sp.I)
        if impossible or (expression.is_number and not abs(value(expression, {})) < LARGEST):
            raise UserError("this is no finite real number", span)


def exponential(x: sp.Expr) -> sp.Expr:
    """exp(x); not a number where sympy, which writes exp(k log 2) as 2^k, could not hold it."""
    huge = any(
        term.has(sp.log) and any(factor.is_number and not abs(factor) < MAX_BITS for factor in sp.Mul.make_args(term))
        for term in sp.Add.make_args(x)
    )
    return sp.nan if huge else sp.exp(x)


def terms_when_expanded(expression: sp.Expr) -> float:
    """At most how many terms an expression has when it is multiplied out, its denominators like its numerators."""
    if expression.is_Add:
        return float(sum(terms_when_expanded(a) for a in expression.args))
    if expression.is_Mul:
        return float(sp.prod([terms_when_expanded(a) for a in expression.args]))
    if expression.is_Pow and expression.exp.is_Integer:
        terms, power = terms_when_expanded(expression.base), min(abs(int(expression.exp)), 1000)
        return float(sp.binomial(int(min(terms, 1e6)) + power - 1, power)) if terms > 1 else 1.0
    return 1.0


def may_be_expanded(expression: sp.Expr) -> bool:
    """Whether common factors can be looked for in no time."""
    return terms_when_expanded(expression) <= MAX_TERMS


def determinant(matrix: sp.MatrixBase, span: Span | None) -> sp.Expr:
    """The determinant of a small matrix, written out."""
    if matrix.rows > MAX_EXPANDED:
        raise UserError(
            f"a determinant of {matrix.rows} x {matrix.rows}; beyond {MAX_EXPANDED} x {MAX_EXPANDED} it is not written out",
            span,
            "write it, or what it is for, in closed form",
        )
    return _minor(matrix, tuple(range(matrix.rows)), tuple(range(matrix.cols)), {})


def inverse(matrix: sp.MatrixBase, span: Span | None) -> sp.MatrixBase:
    """The inverse of a small matrix by its minors, written out."""
    divisor = determinant(matrix, span)
    if divisor == 0:
        raise UserError("this matrix has no inverse", span)
    known: dict[Minor, sp.Expr] = {}
    every = tuple(range(matrix.rows))

    def entry(i: int, j: int) -> sp.Expr:
        rows, columns = (tuple(k for k in every if k != left_out) for left_out in (j, i))
        return (-1) ** (i + j) * _minor(matrix, rows, columns, known) / divisor

    return sp.Matrix(*matrix.shape, entry)


Minor = tuple[tuple[int, ...], tuple[int, ...]]


def _minor(
    matrix: sp.MatrixBase, rows: tuple[int, ...], columns: tuple[int, ...], known: dict[Minor, sp.Expr]
) -> sp.Expr:
    """The determinant of some rows and columns by Laplace's expansion; nothing is multiplied out, and nothing hangs."""
    if not rows:
        return sp.Integer(1)
    if (rows, columns) not in known:
        spend(1)
        terms = (
            (-1) ** k * matrix[rows[0], c] * _minor(matrix, rows[1:], (*columns[:k], *columns[k + 1 :]), known)
            for k, c in enumerate(columns)
            if matrix[rows[0], c] != 0
        )
        known[rows, columns] = sp.Add(*terms)
    return known[rows, columns]
