"""Safe branches: what a branch divides by, or takes a root, logarithm or exponential of, is harmless while it is not taken.

A select computes both of its branches, and in a derivative 0 * inf is NaN. So the *inputs* of operations that may be
singular or overflow are replaced, not their results.
"""

from __future__ import annotations

from collections.abc import Callable

from rsrm_gen.compiler.lower.ir import Graph, Node

# By which argument, and what it is replaced by: a value at which the operation and its derivatives are finite.
SINGULAR = {
    "div": (1, 1),
    "sqrt": (0, 1),
    "root": (0, 1),
    "log": (0, 1),
    "polynomial": (0, 0),
    "atanh": (0, 0),
    "acosh": (0, 2),
    "acos": (0, 0),
}
OVERFLOWING = {"exp": (0, 0), "cosh": (0, 0), "sinh": (0, 0)}


def protect(
    graph: Graph,
    root: Node,
    condition: Node,
    when: bool,
    singular: Callable[[Node], bool] | None = None,
    guard: bool = True,
) -> Node:
    """The same branch, harmless where `condition` is `when`: where it is not taken.

    `singular` says of a node whether it vanishes somewhere there; without it, every input in danger is replaced that is
    not harmless by its form. A `guard` parts what is close to a singular place from the rest: nothing overflows close by,
    and no root vanishes in the rest. Other conditions part anything.
    """
    done: dict[Node, Node] = {}

    def visit(node: Node) -> Node:
        if node not in done:
            done[node] = rebuilt(node)
        return done[node]

    def rebuilt(node: Node) -> Node:
        if node.op == "select":
            if node.arguments[0] is condition:
                return visit(node.arguments[2 if when else 1])  # where the branch is taken, the condition is known
            arguments = (node.arguments[0], *(visit(a) for a in node.arguments[1:]))
        else:
            arguments = tuple(visit(a) for a in node.arguments)
        if is_endangered(node.op, arguments):
            index, safe = (SINGULAR | OVERFLOWING)[node.op]
            x, harmless = arguments[index], graph.constant(safe)
            x = graph.select(condition, harmless, x) if when else graph.select(condition, x, harmless)
            arguments = (*arguments[:index], x, *arguments[index + 1 :])
        return node if arguments == node.arguments else copied(node, arguments)

    def is_endangered(op: str, arguments: tuple[Node, ...]) -> bool:
        if op in OVERFLOWING:
            return not guard and not cannot_overflow(op, arguments[0])
        if op not in SINGULAR:
            return False
        x = arguments[SINGULAR[op][0]]
        if op in ("acos", "acosh", "atanh"):  # singular at +-1
            return singular is None or singular(graph.sub(graph.mul(x, x), graph.constant(1)))
        return not is_positive(x, condition, when) and (singular is None or singular(x))

    def copied(node: Node, arguments: tuple[Node, ...]) -> Node:
        # A root of what cannot vanish is a plain square root.
        op = "sqrt" if node.op == "root" and guard else node.op
        copy = graph.node(op, *arguments, value=node.value)
        if node in graph.names:
            graph.named(graph.names[node], copy)
        return copy

    return visit(root)


def cannot_overflow(op: str, x: Node) -> bool:
    """Whether an exponential is bounded by its form: of a number, or e to minus something that is not negative."""
    return x.is_constant or (op == "exp" and x.op == "neg" and is_nonnegative(x.arguments[0]))


def is_positive(node: Node, condition: Node | None = None, when: bool = True) -> bool:
    """Whether a node is above zero whatever its inputs are, as 1 + x x and its root are.

    With a condition: whether it is so where the condition is `when`.
    """
    a = node.arguments

    def positive(argument: Node) -> bool:
        return is_positive(argument, condition, when)

    match node.op:
        case "constant":
            return bool(node.value > 0)  # type: ignore[operator]
        case "exp" | "cosh":
            return True
        case "add":
            return all(map(is_nonnegative, a)) and any(map(positive, a))
        case "sqrt" | "root" | "mul" | "div":
            return all(map(positive, a))
        case "select" if a[0] is condition:
            return positive(a[1] if when else a[2])
        case "select":
            return positive(a[1]) and positive(a[2])
    return False


def is_nonnegative(node: Node) -> bool:
    """Whether a node is never below zero, as a square is."""
    a = node.arguments
    match node.op:
        case "abs" | "sqrt" | "root":
            return True
        case "mul":
            return a[0] is a[1] or all(map(is_nonnegative, a))
        case "add":
            return all(map(is_nonnegative, a))
    return is_positive(node)
