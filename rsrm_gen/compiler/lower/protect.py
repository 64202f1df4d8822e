"""Safe branches: what a branch divides by, or takes a root, logarithm or exponential of, is harmless while it is not taken.

A select computes both of its branches, and in a derivative 0 * inf is NaN. So the *inputs* of operations that may be
singular or overflow are replaced, not their results.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Iterator, Sequence

from rsrm_gen.compiler.derive.matrix_numeric import places
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
    "atan2": (1, 1),
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
    positive = Positivity(condition, when, underflow=not guard)

    def needed(node: Node) -> tuple[Node, ...]:
        if node.op != "select":
            return node.arguments
        if node.arguments[0] is condition:  # where the branch is taken, the condition is known
            return (node.arguments[2 if when else 1],)
        return node.arguments[1:]

    def rebuilt(node: Node) -> Node:
        parts = tuple(done[a] for a in needed(node))
        if node.op == "select":
            if node.arguments[0] is condition:
                return parts[0]
            parts = (node.arguments[0], *parts)
        if node.op == "eigh" and singular is None:  # its logarithm or root may not exist: of a unit matrix, it does
            unit = [graph.constant(int(i == j)) for i, j in places(node.rows)]
            pairs = list(zip(unit, parts, strict=True))
            parts = tuple(graph.select(condition, *((e, x) if when else (x, e))) for e, x in pairs)
        if is_endangered(node.op, parts):
            index, safe = (SINGULAR | OVERFLOWING)[node.op]
            x, harmless = parts[index], graph.constant(safe)
            x = graph.select(condition, harmless, x) if when else graph.select(condition, x, harmless)
            parts = (*parts[:index], x, *parts[index + 1 :])
        return node if parts == node.arguments else copied(node, parts)

    def is_endangered(op: str, arguments: tuple[Node, ...]) -> bool:
        if op in OVERFLOWING:
            return not guard and not cannot_overflow(op, arguments[0], positive)
        if op not in SINGULAR:
            return False
        x = arguments[SINGULAR[op][0]]
        if op in ("acos", "acosh", "atanh"):  # singular at +-1
            return singular is None or singular(graph.sub(graph.mul(x, x), graph.constant(1)))
        if op == "atan2":  # singular where both are zero
            vanish = singular is None or all(map(singular, arguments))
            return vanish and not any(map(positive.holds, arguments))
        return not positive.holds(x) and (singular is None or singular(x))

    def copied(node: Node, arguments: tuple[Node, ...]) -> Node:
        # A root of what cannot vanish is a plain square root.
        op = "sqrt" if node.op == "root" and guard else node.op
        copy = graph.node(op, *arguments, value=node.value)
        if node in graph.names:
            graph.named(graph.names[node], copy)
        return copy

    for node in arguments_first(root, needed, done):
        done[node] = rebuilt(node)
    return done[root]


def arguments_first(root: Node, needed: Callable[[Node], Sequence[Node]], done: Container[Node]) -> Iterator[Node]:
    """The root and all that it needs and that is not done, each after what it needs; as deep as it may be."""
    waiting = [root]
    while waiting:
        node = waiting[-1]
        missing = next((a for a in needed(node) if a not in done), None) if node not in done else None
        if missing is not None:
            waiting.append(missing)
            continue
        waiting.pop()
        if node not in done:
            yield node


def cannot_overflow(op: str, x: Node, signs: Positivity) -> bool:
    """Whether an exponential is bounded by its form: of a number, or e to minus something that is not negative."""
    return x.is_constant or (op == "exp" and x.op == "neg" and signs.is_not_negative(x.arguments[0]))


def never_negative(node: Node) -> bool:
    """Whether a node is not below zero by its form, as a sum of squares is."""
    return Positivity(node, True, underflow=True).is_not_negative(node)


class Positivity:
    """What is known of the signs of nodes by their form, where the condition is `when`.

    With `underflow`, an exponential may be zero: there its argument may be anything.
    """

    def __init__(self, condition: Node, when: bool, underflow: bool) -> None:
        self.condition = condition
        self.when = when
        self.underflow = underflow
        self.known: dict[Node, tuple[bool, bool]] = {}  # above zero, never below zero

    def holds(self, node: Node) -> bool:
        """Whether a node is above zero whatever its inputs are, as 1 + x x and its root are."""
        for part in arguments_first(node, lambda n: n.arguments, self.known):
            positive = self.is_positive(part)
            self.known[part] = positive, positive or self.is_nonnegative(part)
        return self.known[node][0]

    def is_not_negative(self, node: Node) -> bool:
        """Whether a node is never below zero."""
        return self.holds(node) or self.known[node][1]

    def is_positive(self, node: Node) -> bool:
        """The same as `holds`, for a node whose arguments are known."""
        a = node.arguments
        positive = [self.known[x][0] for x in a]
        match node.op:
            case "constant":
                return bool(node.value > 0)  # type: ignore[operator]
            case "exp":
                return not self.underflow
            case "cosh":
                return True
            case "add":
                return all(self.known[x][1] for x in a) and any(positive)
            case "sqrt" | "root" | "mul" | "div":
                return all(positive)
            case "select" if a[0] is self.condition:
                return positive[1 if self.when else 2]
            case "select":
                return positive[1] and positive[2]
        return False

    def is_nonnegative(self, node: Node) -> bool:
        """Whether a node is never below zero, as a square is, for a node whose arguments are known."""
        a = node.arguments
        match node.op:
            case "abs" | "sqrt" | "root" | "exp":
                return True
            case "mul":
                return a[0] is a[1] or all(self.known[x][1] for x in a)
            case "add":
                return all(self.known[x][1] for x in a)
        return False
