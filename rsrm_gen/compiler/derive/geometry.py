"""What stage 2 gives: the functions of a manifold, each as a list of small sympy assignments.

Assignments are kept as the author's formulas suggest them (a `let`, a norm, a dot product is one), because the
order in which a formula computes is part of its accuracy, and because people read what comes out.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import sympy as sp

from rsrm_gen.compiler.spec import Spec
from rsrm_gen.compiler.spec.vocabulary import Shape

LESS, LESS_EQUAL, EQUAL = sp.Integer(0), sp.Integer(1), sp.Integer(2)
EPS = sp.Symbol("eps", positive=True)  # the rounding unit, a number only once a precision is chosen


class Choose(sp.Function):  # type: ignore[misc]
    """Choose(kind, a, b, x, y): x where a < b (or a <= b, a == b, by kind), else y."""

    nargs = 5

    def fdiff(self, argindex: int = 1) -> sp.Expr:
        """The chosen branch passes its derivative on; the comparison has none."""
        kind, a, b, _, _ = self.args
        return {4: self.func(kind, a, b, 1, 0), 5: self.func(kind, a, b, 0, 1)}.get(argindex, sp.Integer(0))


class ChooseSafe(Choose):
    """A `Choose` both of whose branches are finite everywhere, so that neither needs protection."""


class Wrap(sp.Function):  # type: ignore[misc]
    """Wrap(x, L): x less the nearest multiple of L."""

    nargs = 2

    @classmethod
    def eval(cls, x: sp.Expr, period: sp.Expr) -> sp.Expr | None:
        """Of numbers, a number."""
        return x - period * sp.floor(x / period + sp.Rational(1, 2)) if x.is_number and period.is_number else None

    def fdiff(self, argindex: int = 1) -> sp.Expr:
        """1 in x: the jumps lie on the cut locus."""
        return sp.Integer(1 if argindex == 1 else 0)


class Polynomial(sp.Function):  # type: ignore[misc]
    """Polynomial(x, c0, c1, ...): c0 + c1 x + c2 x^2 + ..."""

    def fdiff(self, argindex: int = 1) -> sp.Expr:
        """The polynomial with the coefficients k c_k."""
        x, *coefficients = self.args
        return (
            Polynomial(x, *(k * c for k, c in enumerate(coefficients) if k)) if len(coefficients) > 1 else sp.Integer(0)
        )


@dataclass(frozen=True)
class Guard:
    """A removable singularity, removed: below the threshold, `near` stands for the expression.

    `variable` is smooth and vanishes where the expression is 0/0; `near` is a polynomial in it whose relative error
    on [0, threshold] is at most `error`. `place` is one such place: values of the function's arguments; empty when
    only the variable's own zero is meant.
    """

    variable: sp.Expr
    threshold: sp.Rational
    near: sp.Expr
    error: float
    place: tuple[tuple[sp.Symbol, Any], ...] = ()


@dataclass(frozen=True)
class Assignment:
    """symbol := expression, except where the guard holds."""

    symbol: sp.Symbol
    expression: sp.Expr
    guard: Guard | None = None

    def inputs(self) -> set[sp.Symbol]:
        """The symbols that the assignment reads."""
        symbols: set[sp.Symbol] = set(self.expression.free_symbols)
        return symbols | self.guard.variable.free_symbols | self.guard.near.free_symbols if self.guard else symbols


@dataclass(frozen=True)
class Argument:
    """An argument of a function, with the symbols of its entries in row-major order."""

    name: str
    shape: Shape
    symbols: tuple[sp.Symbol, ...]


def argument(name: str, *shape: int) -> Argument:
    """An argument whose entries are called name0, name1, ... (or name00, name01, ... for a matrix)."""
    if not shape:
        return Argument(name, (), (sp.Symbol(name, real=True),))
    indices = (
        [(i,) for i in range(shape[0])]
        if len(shape) == 1
        else [(i, j) for i in range(shape[0]) for j in range(shape[1])]
    )
    return Argument(name, shape, tuple(sp.Symbol(name + "_".join(map(str, index)), real=True) for index in indices))


@dataclass(frozen=True, eq=False)
class Function:
    """A function as staged assignments; `results` are its entries in row-major order, `formula` says it to a reader.

    Identity is equality: what is made from a function once is remembered for it.
    """

    name: str
    arguments: tuple[Argument, ...]
    assignments: tuple[Assignment, ...]
    results: tuple[sp.Expr, ...]
    shape: Shape
    formula: str

    def symbols(self) -> tuple[sp.Symbol, ...]:
        """The symbols of all arguments, in order."""
        return tuple(s for argument in self.arguments for s in argument.symbols)

    def pruned(self) -> Function:
        """Without the assignments that no result needs."""
        needed: set[sp.Symbol] = set().union(*(r.free_symbols for r in self.results))
        kept = []
        for assignment in reversed(self.assignments):
            if assignment.symbol in needed:
                kept.append(assignment)
                needed |= assignment.inputs()
        return replace(self, assignments=tuple(reversed(kept)))


def renamed(function: Function, names: dict[sp.Symbol, sp.Symbol]) -> Function:
    """The function with other symbols in its assignments and results."""

    def rename(a: Assignment) -> Assignment:
        guard = a.guard and replace(
            a.guard, variable=a.guard.variable.xreplace(names), near=a.guard.near.xreplace(names)
        )
        return Assignment(names.get(a.symbol, a.symbol), a.expression.xreplace(names), guard)

    results = tuple(r.xreplace(names) for r in function.results)
    return replace(function, assignments=tuple(map(rename, function.assignments)), results=results)


@dataclass(frozen=True)
class Radial:
    """Log and its determinant on a quadric of constant curvature, as `derive.radial` finds and describes them.

    <x, y> = x . form y, in D x D numbers; `folded` where x and -x are one point.
    """

    form: tuple[tuple[sp.Rational, ...], ...]
    folded: bool
    unbounded: bool  # w >= 1, not w <= 1
    power: int


@dataclass(frozen=True)
class Geometry:
    """All that was derived from a spec.

    `log_det_origin` says how log |det D Log| was got: "author" (a closed form in the file, for the audit to judge),
    "closed form" (found as a product of powers of quantities in the formula of Log), "staged" (a determinant) or "product"
    (the sum of those of the factors). `factors` are the geometries of a product's distinct factors, by their names,
    before their weights.
    """

    spec: Spec
    functions: tuple[Function, ...]
    log_det_origin: str
    injectivity_radius: sp.Expr
    diameter: sp.Expr
    periods: tuple[sp.Expr | None, ...] | None
    domain: sp.Expr | None  # 1 where a point is valid, in the symbols of p; None if there is no condition
    factors: tuple[tuple[str, Geometry], ...] = ()
    radial: Radial | None = None  # the form in which sums of splats are computed, if it has one
    unit: sp.Expr = sp.S.One  # a length natural to the manifold, where the injectivity radius is infinite

    def __getitem__(self, name: str) -> Function:
        found = next((function for function in self.functions if function.name == name), None)
        if found is None:
            raise KeyError(name)  # and not StopIteration, which would end whatever loop asks
        return found

    def __iter__(self) -> Iterator[Function]:
        return iter(self.functions)

    def __contains__(self, name: str) -> bool:
        return any(function.name == name for function in self.functions)
