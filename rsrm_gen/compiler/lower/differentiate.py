"""Reverse-mode differentiation on the graph: one sweep gives all partial derivatives of one node."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import sympy as sp

from rsrm_gen.compiler.derive.matrix_numeric import places
from rsrm_gen.compiler.lower.ir import Graph, Node, Packed, reachable

Rule = Callable[[Graph, Node, Node], tuple[Node | None, ...]]  # (graph, node, adjoint) -> adjoints of its arguments


def gradient(graph: Graph, output: Node, inputs: Sequence[Node], times: Node | None = None) -> tuple[Node, ...]:
    """The partial derivatives of a node with respect to some others; `times` a factor."""
    sweep = _Sweep(graph, _dependents(output, inputs))
    sweep.adjoints[output] = times or graph.constant(1)
    for node in sorted(sweep.dependent, key=lambda n: -n.number):
        sweep.visit(node)
    return tuple(sweep.adjoints.get(x, graph.constant(0)) for x in inputs)


class _Sweep:
    """The adjoints found so far, of scalars and of matrices.

    The adjoints of all entries of a function of a matrix are gathered before they go on, as one symmetric matrix B: the
    function's derivative is symmetric in its directions, so that <B, D^(m+1) f(A)[..., dA]> = <D^(m+1) f(A)[..., B], dA>.
    """

    def __init__(self, graph: Graph, dependent: set[Node]) -> None:
        self.graph = graph
        self.dependent = dependent
        self.adjoints: dict[Node, Node] = {}
        self.of_entries: dict[Node, dict[int, Node]] = {}  # of a spectral
        self.of_matrix: dict[Node, list[Node]] = {}  # of the packed entries that an eigh decomposes

    def visit(self, node: Node) -> None:
        """Pass the adjoint of a node, complete by now, on to its arguments."""
        if node.op == "spectral" and node in self.of_entries:
            self.visit_spectral(node, self.of_entries[node])
        elif node.op == "eigh" and node in self.of_matrix:
            self.give(node.arguments, self.of_matrix[node])
        elif node.op == "entry" and node in self.adjoints:
            assert node.arguments[0].op == "spectral"  # eigenvalues are only compared
            self.of_entries.setdefault(node.arguments[0], {})[node.index] = self.adjoints[node]
        elif node in self.adjoints and node.op in RULES:
            if node in self.graph.names:
                self.graph.named(f"by_{self.graph.names[node]}", self.adjoints[node])
            self.give(node.arguments, RULES[node.op](self.graph, node, self.adjoints[node]))

    def give(self, arguments: Sequence[Node], contributions: Sequence[Node | None]) -> None:
        """Add to the adjoints of some nodes."""
        for argument, contribution in zip(arguments, contributions, strict=True):
            if contribution is not None and argument in self.dependent:
                known = self.adjoints.get(argument)
                self.adjoints[argument] = contribution if known is None else self.graph.add(known, contribution)

    def visit_spectral(self, node: Node, entries: Mapping[int, Node]) -> None:
        """From the entries of D^m f(A)[E1, ..., Em] to A and the E."""
        graph, eigh, directions = self.graph, node.arguments[0], node.directions
        name = node.function[0]
        zero, half, two = graph.constant(0), graph.constant(sp.Rational(1, 2)), graph.constant(2)
        diagonal = [i == j for i, j in places(node.rows)]  # an entry off it stands for two of the matrix
        adjoint = tuple(
            entries.get(k, zero) if on else graph.mul(half, entries.get(k, zero)) for k, on in enumerate(diagonal)
        )

        def by(*others: Packed) -> list[Node]:
            derivative = graph.spectral(name, eigh, others)
            return [x if on else graph.mul(two, x) for x, on in zip(derivative, diagonal, strict=True)]

        if eigh in self.dependent:
            parts = by(*directions, adjoint)
            known = self.of_matrix.get(eigh)
            self.of_matrix[eigh] = parts if known is None else list(map(graph.add, known, parts))
        for k, direction in enumerate(directions):
            if any(e in self.dependent for e in direction):
                self.give(direction, by(*directions[:k], *directions[k + 1 :], adjoint))


def _dependents(output: Node, inputs: Sequence[Node]) -> set[Node]:
    """The nodes between the inputs and the output."""
    found = set(inputs)
    for node in reachable([output]):
        if any(argument in found for argument in node.arguments):
            found.add(node)
    return found


def _twice(graph: Graph, x: Node) -> Node:
    return graph.mul(graph.constant(2), x)


def _square_plus(graph: Graph, x: Node, constant: int) -> Node:
    return graph.add(graph.constant(constant), graph.mul(x, x))


def _mul(g: Graph, node: Node, adjoint: Node) -> tuple[Node, ...]:
    x, y = node.arguments
    if x is y:  # one edge each, so that 2 x adjoint is not added up from two halves
        return g.mul(_twice(g, adjoint), x), g.constant(0)
    return g.mul(adjoint, y), g.mul(adjoint, x)


def _div(g: Graph, node: Node, adjoint: Node) -> tuple[Node, ...]:
    numerator = g.div(adjoint, node.arguments[1])
    return numerator, g.neg(g.mul(numerator, node))


def _root(g: Graph, node: Node, adjoint: Node) -> tuple[Node, ...]:
    zero = g.node("equal", node.arguments[0], g.constant(0))
    safe = g.select(zero, g.constant(1), node)
    return (g.select(zero, g.constant(0), g.div(adjoint, _twice(g, safe))),)


def _atan2(g: Graph, node: Node, adjoint: Node) -> tuple[Node, ...]:
    y, x = node.arguments
    scaled = g.div(adjoint, g.add(g.mul(x, x), g.mul(y, y)))
    return g.mul(scaled, x), g.neg(g.mul(scaled, y))


def _abs(g: Graph, node: Node, adjoint: Node) -> tuple[Node, ...]:
    negative = g.node("less", node.arguments[0], g.constant(0))
    return (g.select(negative, g.neg(adjoint), adjoint),)


def _select(g: Graph, node: Node, adjoint: Node) -> tuple[Node | None, ...]:
    condition = node.arguments[0]
    zero = g.constant(0)
    return None, g.select(condition, adjoint, zero), g.select(condition, zero, adjoint)


def _polynomial(g: Graph, node: Node, adjoint: Node) -> tuple[Node, ...]:
    coefficients: tuple[object, ...] = node.value  # type: ignore[assignment]
    derivative = tuple(k * c for k, c in enumerate(coefficients) if k)  # type: ignore[operator]
    slope = g.polynomial(node.arguments[0], derivative)
    g.named(f"{g.names.get(node, 'series')}_slope", slope)
    return (g.mul(adjoint, slope),)


def _one(derivative: Callable[[Graph, Node, Node], Node]) -> Rule:
    """A rule for a function of one argument from its derivative (graph, argument, value)."""
    return lambda g, node, adjoint: (g.mul(adjoint, derivative(g, node.arguments[0], node)),)


def _over(denominator: Callable[[Graph, Node, Node], Node]) -> Rule:
    """A rule for a function of one argument whose derivative is one over something."""
    return lambda g, node, adjoint: (g.div(adjoint, denominator(g, node.arguments[0], node)),)


RULES: dict[str, Rule] = {
    "neg": lambda g, node, adjoint: (g.neg(adjoint),),
    "add": lambda g, node, adjoint: (adjoint, adjoint),
    "sub": lambda g, node, adjoint: (adjoint, g.neg(adjoint)),
    "mul": _mul,
    "div": _div,
    "root": _root,
    "atan2": _atan2,
    "abs": _abs,
    "select": _select,
    "declared": lambda g, node, adjoint: (None, *(g.mul(adjoint, slope) for slope in g.slopes[node])),
    "polynomial": _polynomial,
    "sqrt": _over(lambda g, x, y: _twice(g, y)),
    "exp": _one(lambda g, x, y: y),
    "log": _over(lambda g, x, y: x),
    "sin": _one(lambda g, x, y: g.function("cos", x)),
    "cos": _one(lambda g, x, y: g.neg(g.function("sin", x))),
    "tan": _one(lambda g, x, y: _square_plus(g, y, 1)),
    "sinh": _one(lambda g, x, y: g.function("cosh", x)),
    "cosh": _one(lambda g, x, y: g.function("sinh", x)),
    "tanh": _one(lambda g, x, y: g.sub(g.constant(1), g.mul(y, y))),
    "asinh": _over(lambda g, x, y: g.function("sqrt", _square_plus(g, x, 1))),
    "acosh": _over(lambda g, x, y: g.function("sqrt", _square_plus(g, x, -1))),
    "acos": _over(lambda g, x, y: g.neg(g.function("sqrt", g.sub(g.constant(1), g.mul(x, x))))),
    "atanh": _over(lambda g, x, y: g.sub(g.constant(1), g.mul(x, x))),
}  # `round` and the conditions have derivative zero
