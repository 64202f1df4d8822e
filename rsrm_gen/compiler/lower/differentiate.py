"""Reverse-mode differentiation on the graph: one sweep gives all partial derivatives of one node."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from rsrm_gen.compiler.lower.ir import Graph, Node, reachable

Rule = Callable[[Graph, Node, Node], tuple[Node | None, ...]]  # (graph, node, adjoint) -> adjoints of its arguments


def gradient(graph: Graph, output: Node, inputs: Sequence[Node]) -> tuple[Node, ...]:
    """The partial derivatives of a node with respect to some others."""
    dependent = _dependents(output, inputs)
    adjoints: dict[Node, Node] = {output: graph.constant(1)}
    for node in sorted(dependent, key=lambda n: -n.number):
        if node not in adjoints or node.op not in RULES:
            continue
        if node in graph.names:
            graph.named(f"by_{graph.names[node]}", adjoints[node])
        contributions = RULES[node.op](graph, node, adjoints[node])
        for argument, contribution in zip(node.arguments, contributions, strict=True):
            if contribution is not None and argument in dependent:
                adjoints[argument] = (
                    graph.add(adjoints[argument], contribution) if argument in adjoints else contribution
                )
    return tuple(adjoints.get(x, graph.constant(0)) for x in inputs)


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
