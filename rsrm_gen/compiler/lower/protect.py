"""Safe branches: what a branch divides by, or takes a root or logarithm of, is 1 while the branch is not taken.

A select computes both of its branches, and in a derivative 0 * inf is NaN. So the *inputs* of singular operations are
replaced, not their results.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Iterator, Sequence

from rsrm_gen.compiler.derive.matrix_numeric import places
from rsrm_gen.compiler.lower.ir import Graph, Node

ENDANGERED = {"div": 1, "sqrt": 0, "root": 0, "log": 0, "polynomial": 0, "atanh": 0, "acosh": 0}  # by which argument
SAFE = {"polynomial": 0, "atanh": 0}  # what it is replaced by; 1 elsewhere


def protect(
    graph: Graph, root: Node, condition: Node, when: bool, singular: Callable[[Node], bool] | None = None
) -> Node:
    """The same branch, harmless where `condition` is `when`: where it is not taken.

    `singular` says of a node whether it vanishes somewhere there; without it, every input in danger is replaced that is
    not positive by its form.
    """
    done: dict[Node, Node] = {}
    positive = Positivity(condition, when)

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
        if node.op in ENDANGERED:
            x = parts[ENDANGERED[node.op]]
            if not positive.holds(x) and (singular is None or singular(x)):
                safe = graph.constant(SAFE.get(node.op, 1))
                x = graph.select(condition, safe, x) if when else graph.select(condition, x, safe)
                index = ENDANGERED[node.op]
                parts = (*parts[:index], x, *parts[index + 1 :])
        return node if parts == node.arguments else copied(node, parts)

    def copied(node: Node, arguments: tuple[Node, ...]) -> Node:
        # A root of what cannot vanish is a plain square root.
        copy = graph.node("sqrt" if node.op == "root" else node.op, *arguments, value=node.value)
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


class Positivity:
    """What is known of the signs of nodes by their form; with a condition, where the condition is `when`."""

    def __init__(self, condition: Node | None = None, when: bool = True) -> None:
        self.condition = condition
        self.when = when
        self.known: dict[Node, tuple[bool, bool]] = {}  # above zero, never below zero

    def holds(self, node: Node) -> bool:
        """Whether a node is above zero whatever its inputs are, as 1 + x x and its root are."""
        for part in arguments_first(node, lambda n: n.arguments, self.known):
            positive = self.is_positive(part)
            self.known[part] = positive, positive or self.is_nonnegative(part)
        return self.known[node][0]

    def is_positive(self, node: Node) -> bool:
        """The same, for a node whose arguments are known."""
        a = node.arguments
        positive = [self.known[x][0] for x in a]
        match node.op:
            case "constant":
                return bool(node.value > 0)  # type: ignore[operator]
            case "exp" | "cosh":
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
            case "abs" | "sqrt" | "root":
                return True
            case "mul":
                return a[0] is a[1] or all(self.known[x][1] for x in a)
            case "add":
                return all(self.known[x][1] for x in a)
        return False
