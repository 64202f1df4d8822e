"""The assignments that are written down while formulas are read."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy

import mpmath as mp
import sympy as sp

from rsrm_gen.compiler.budget import spend
from rsrm_gen.compiler.derive.bounds import Sizes
from rsrm_gen.compiler.derive.geometry import Argument, Assignment, Guard
from rsrm_gen.compiler.derive.numeric import TINY, Values, value
from rsrm_gen.compiler.derive.values import Symmetry
from rsrm_gen.errors import Span


class Trace:
    """The assignments written down while formulas are read.

    `probe` holds the values of the arguments where the author's formulas may be 0/0 (coincident points, a zero
    vector); a quotient of two quantities that vanish there is recorded in `quotients`, to be removed.
    """

    def __init__(self, arguments: Sequence[Argument], probe: Values | None = None) -> None:
        self.arguments = {a.name: a for a in arguments}
        self.assignments: list[Assignment] = []
        self.quotients: list[sp.Symbol] = []
        self.scalars: list[sp.Symbol] = []  # quantities of the author's: candidates for closed forms
        self.probe = dict(probe) if probe else None
        self.known: dict[sp.Expr, sp.Symbol] = {}
        self.sizes = Sizes()
        self.symmetries: list[Symmetry] = []
        self.taken = {str(s) for a in arguments for s in a.symbols} | {a.name for a in arguments}

    def define(self, hint: str, expression: sp.Expr, guard: Guard | None = None) -> sp.Expr:
        """A symbol for an expression; numbers and symbols stand for themselves, and nothing is defined twice."""
        if expression.is_number or expression.is_Symbol:
            return expression
        if expression not in self.known:
            spend(1)
            symbol = sp.Symbol(self.fresh(hint), real=True)
            self.known[expression] = symbol
            self.assignments.append(Assignment(symbol, expression, guard))
            if self.probe is not None:
                self.probe[symbol] = value(guard.near if guard else expression, self.probe)
        return self.known[expression]

    def extended(self, *arguments: Argument) -> Trace:
        """This trace itself, or a copy that knows further arguments."""
        if not arguments:
            return self
        trace = copy(self)
        trace.arguments = self.arguments | {a.name: a for a in arguments}
        trace.assignments, trace.quotients = list(self.assignments), list(self.quotients)
        trace.symmetries = list(self.symmetries)
        trace.scalars, trace.known = list(self.scalars), dict(self.known)
        trace.taken = self.taken | {str(s) for a in arguments for s in a.symbols} | {a.name for a in arguments}
        trace.probe = self.probe and {**self.probe, **{s: mp.mpf(1) for a in arguments for s in a.symbols}}
        return trace

    def fresh(self, hint: str) -> str:
        """An unused name that begins with the hint."""
        name, count = hint, 1
        while name in self.taken:
            count += 1
            name = f"{hint}_{count}"
        self.taken.add(name)
        return name

    def vanishes(self, expression: sp.Expr) -> bool:
        """Whether the expression is zero at the probe."""
        return self.probe is not None and not expression.is_number and abs(value(expression, self.probe)) < TINY

    def unfolded(self, expression: sp.Expr, span: Span) -> sp.Expr:
        """An expression in the arguments alone; a `UserError` where it explodes, as when every `let` doubles the last."""
        needed = expression.free_symbols
        used = []
        for assignment in reversed(self.assignments):
            if assignment.symbol in needed:
                used.append(assignment)
                needed |= assignment.expression.free_symbols
        full = Sizes()
        for assignment in reversed(used):
            full.known[assignment.symbol] = full.of(assignment.expression)
        full.check([expression], span)
        for assignment in used:
            expression = expression.xreplace({assignment.symbol: assignment.expression})
        return expression

    def definition(self, symbol: sp.Expr) -> sp.Expr | None:
        """The expression that a symbol was defined as."""
        return next((a.expression for a in self.assignments if a.symbol == symbol), None)
