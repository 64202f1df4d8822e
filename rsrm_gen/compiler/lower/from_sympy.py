"""Sympy expressions to graph nodes, with the branches that are not taken kept from doing harm."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import sympy as sp

from rsrm_gen.compiler.derive.geometry import EPS, Assignment, Choose, ChooseSafe, Function, Polynomial, Wrap
from rsrm_gen.compiler.derive.matrix_functions import Eigenvalue, MatrixFunction
from rsrm_gen.compiler.derive.numeric import DIGITS, TINY
from rsrm_gen.compiler.lower.interpret import values_at
from rsrm_gen.compiler.lower.ir import CONDITIONS, Graph, Node, reachable
from rsrm_gen.compiler.lower.protect import protect

ELEMENTARY = {
    sp.exp: "exp", sp.log: "log", sp.sin: "sin", sp.cos: "cos", sp.tan: "tan", sp.sinh: "sinh", sp.cosh: "cosh", sp.tanh: "tanh",
    sp.asinh: "asinh", sp.acosh: "acosh", sp.acos: "acos", sp.atanh: "atanh", sp.Abs: "abs", sp.atan2: "atan2",
}  # fmt: skip


def inline(graph: Graph, function: Function, *arguments: tuple[Node, ...], prefix: str = "") -> tuple[Node, ...]:
    """The results of a staged function of given nodes; its own names begin with the prefix."""
    values: dict[sp.Symbol, Node] = {}
    for declared, given in zip(function.arguments, arguments, strict=True):
        values.update(zip(declared.symbols, given, strict=True))
    given_nodes = dict(values)
    builder = Builder(graph, values)
    for assignment in function.assignments:
        node = builder.node(assignment.expression)
        if assignment.guard is not None:
            node = _guarded(builder, assignment, node, given_nodes)
        values[assignment.symbol] = graph.named(f"{prefix}{assignment.symbol}", node)
    return tuple(builder.node(result) for result in function.results)


def _guarded(builder: Builder, assignment: Assignment, far: Node, given: Mapping[sp.Symbol, Node]) -> Node:
    """The polynomial near the singular place, else the expression, each harmless where the other is taken."""
    graph, guard = builder.graph, assignment.guard
    assert guard is not None
    variable = builder.node(guard.variable)
    near = graph.named("near", graph.node("less", variable, graph.constant(guard.threshold)))
    series = graph.named(f"{assignment.symbol}_near", builder.node(guard.near))
    for node in reachable([series]):
        if node.op == "polynomial":
            graph.named(f"{assignment.symbol}_series", node)
    place = {given[symbol]: x for symbol, x in guard.place}
    singular = _vanishing_at(place) if place else None
    # Far away only the polynomial itself can do harm, by overflow; its variable is needed there to know that it is far.
    scaled = builder.node(guard.variable / guard.threshold)
    series = protect(graph, series, near, False, lambda node: node is scaled)
    return graph.select(near, series, protect(graph, far, near, True, singular))


def _vanishing_at(place: Mapping[Node, Any]) -> Callable[[Node], bool]:
    """Whether a node is zero (or has no value) where its inputs have some given values."""

    def vanishes(node: Node) -> bool:
        (x,) = values_at(reachable([node]), place, DIGITS)[-1:]
        return not abs(x) > TINY

    return vanishes


class Builder:
    """Builds nodes for expressions in symbols whose nodes are known."""

    def __init__(self, graph: Graph, values: Mapping[sp.Symbol, Node]) -> None:
        self.graph = graph
        self.values = values

    def node(self, expression: sp.Expr) -> Node:
        """The node of an expression."""
        graph = self.graph
        if expression.is_Symbol:
            return graph.node("eps") if expression == EPS else self.values[expression]
        if expression.is_number and not expression.has(EPS):
            return graph.constant(expression)
        if expression.is_Add:
            return self.sum(expression)
        if expression.is_Mul:
            return self.product(expression)
        if expression.is_Pow:
            return self.power(self.node(expression.base), expression.exp)
        if isinstance(expression, Choose):
            return self.choose(expression)
        if isinstance(expression, Wrap):
            return self.wrap(self.node(expression.args[0]), expression.args[1])
        if isinstance(expression, Polynomial):
            return graph.polynomial(self.node(expression.args[0]), expression.args[1:])
        if isinstance(expression, MatrixFunction):
            matrix, *directions = (tuple(self.node(e) for e in packed) for packed in expression.matrices)
            return graph.spectral(expression.name_of_function, graph.eigh(matrix), directions)[expression.index]
        if isinstance(expression, Eigenvalue):
            return graph.eigenvalue(tuple(self.node(e) for e in expression.args[2:]), int(expression.args[1]))
        if isinstance(expression, sp.sign):
            x = self.node(expression.args[0])
            return graph.select(graph.node("less", x, graph.constant(0)), graph.constant(-1), graph.constant(1))
        return graph.function(ELEMENTARY[expression.func], *(self.node(a) for a in expression.args))

    def sum(self, expression: sp.Add) -> Node:
        """Positive terms first, so that a difference reads as one."""
        positive = [t for t in expression.args if not t.could_extract_minus_sign()]
        negative = [-t for t in expression.args if t.could_extract_minus_sign()]
        total = self.graph.constant(0)
        for term in positive:
            total = self.graph.add(total, self.node(term))
        for term in negative:
            total = self.graph.sub(total, self.node(term))
        return total

    def product(self, expression: sp.Mul) -> Node:
        """Numerator over denominator: one division."""
        numerator, denominator = self.graph.constant(1), self.graph.constant(1)
        for factor in expression.args:
            if factor.is_Pow and factor.exp.is_number and factor.exp.is_negative:
                denominator = self.graph.mul(denominator, self.power(self.node(factor.base), -factor.exp))
            else:
                numerator = self.graph.mul(numerator, self.node(factor))
        return self.graph.div(numerator, denominator)

    def power(self, base: Node, exponent: sp.Expr) -> Node:
        """Rational powers by multiplications and square roots."""
        graph = self.graph
        if exponent.is_negative:
            return graph.div(graph.constant(1), self.power(base, -exponent))
        if exponent.is_Integer:
            return self.integer_power(base, int(exponent))
        if exponent.is_Rational and exponent.q in (2, 4):
            root = graph.function("root", base)
            return self.power(root, exponent * 2)
        return graph.function("exp", graph.mul(self.node(exponent), graph.function("log", base)))

    def integer_power(self, base: Node, exponent: int) -> Node:
        if exponent == 0:
            return self.graph.constant(1)
        half = self.integer_power(base, exponent // 2)
        square = self.graph.mul(half, half)
        return self.graph.mul(square, base) if exponent % 2 else square

    def choose(self, expression: Choose) -> Node:
        kind, a, b, x, y = expression.args
        condition = self.graph.node(CONDITIONS[int(kind)], self.node(a), self.node(b))
        if isinstance(expression, ChooseSafe):
            self.graph.named("on_cut_locus", condition)
            return self.graph.select(condition, self.node(x), self.node(y))
        taken = protect(self.graph, self.node(x), condition, False, guard=False)
        return self.graph.select(condition, taken, protect(self.graph, self.node(y), condition, True, guard=False))

    def wrap(self, x: Node, period: sp.Expr) -> Node:
        """x - k L with L split into a part of few digits, which k multiplies exactly, and the rest."""
        graph = self.graph
        turns = graph.function("round", graph.div(x, graph.constant(period)))
        for part in split(period):
            x = graph.sub(x, graph.mul(turns, graph.constant(part)))
        return x


def split(period: sp.Expr) -> tuple[sp.Expr, ...]:
    """A number as its leading 12 binary digits and the exact rest.

    Rounding the rest costs less than a thousandth of what rounding k L itself costs.
    """
    exponent = sp.floor(sp.log(sp.Abs(period), 2).evalf(20)) - 11
    leading = sp.Integer(sp.floor(period / sp.Integer(2) ** exponent)) * sp.Rational(2) ** exponent
    return (leading,) if leading == period else (leading, period - leading)
