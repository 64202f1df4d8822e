"""A pair's function in steps, so that a processor need not wait.

The operations for one pair are a chain: a root, of which a division is made, of which an exponential is made. Each takes
long, and a processor looks ahead not much further than one pair. Done step by step for several pairs, the slow operations
of a step overlap, because those of different pairs do not wait for each other.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Mapping, Sequence
from dataclasses import dataclass

from rsrm_gen.compiler.lower import Node
from rsrm_gen.compiler.lower.ir import CONDITIONS, FUNCTIONS, SEVERAL

SLOW = {"div", *FUNCTIONS} - {"abs", "round"}  # operations whose results a processor waits for


@dataclass(frozen=True)
class Step:
    """The named nodes that a step computes, in order, and those of earlier steps that it reads."""

    nodes: tuple[Node, ...]
    kept: tuple[Node, ...]


def steps(
    named: Sequence[Node], results: Iterable[Node], reads: Callable[[Node], Sequence[Node]], vectors: set[Node]
) -> list[Step]:
    """Split the named nodes of a routine after its slow operations; one step if it has none, or decomposes matrices.

    `reads` are the arguments of a node as it is written. A node is computed as late as possible, so that little is kept;
    conditions, and numbers that are no vectors, are computed again where they are needed.
    """
    known = set(named)
    if any(node.op in SEVERAL for node in named):
        return [Step(tuple(named), ())]
    inside = {node: expression(reads(node), reads, known) for node in named}
    needs = {node: [n for n in parts if n in known] for node, parts in inside.items()}
    slow = {node: any(n.op in SLOW for n in (node, *parts) if n in vectors and n not in known - {node})
            for node, parts in inside.items()}  # fmt: skip
    wanted = [n for n in expression(results, reads, known) if n in known]
    earliest: dict[Node, int] = {}
    for node in named:
        earliest[node] = max((earliest[n] + slow[n] for n in needs[node]), default=0)
    last = max((earliest[n] + slow[n] for n in wanted), default=0)
    latest = {node: last - slow[node] for node in named}
    for node in reversed(named):
        for n in needs[node]:
            latest[n] = min(latest[n], latest[node] - slow[n])
    again = {node for node in named if node.op in CONDITIONS or node not in vectors}
    return [_step(number, number == last, named, wanted, needs, latest, again) for number in range(last + 1)]


def _step(
    number: int,
    is_last: bool,
    named: Sequence[Node],
    wanted: Sequence[Node],
    needs: Mapping[Node, Sequence[Node]],
    latest: Mapping[Node, int],
    again: set[Node],
) -> Step:
    own = {node for node in named if latest[node] == number and node not in again}
    read = {n for node in own for n in needs[node]} | (set(wanted) if is_last else set())
    while more := {n for node in read & again for n in needs[node]} - read:
        read |= more
    own |= read & again
    return Step(tuple(n for n in named if n in own), tuple(n for n in named if n in read - own))


def expression(roots: Iterable[Node], reads: Callable[[Node], Sequence[Node]], named: Container[Node]) -> list[Node]:
    """The nodes that the text of some nodes is made of: themselves; of those without a name, their arguments and theirs."""
    found = dict.fromkeys(roots)
    stack = list(found)
    while stack:
        node = stack.pop()
        for argument in () if node in named else reads(node):
            if argument not in found:
                found[argument] = None
                stack.append(argument)
    return list(found)
