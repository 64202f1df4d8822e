"""Factors of a splat alone, taken out of sums over points: sum_n c a_n = c sum_n a_n.

The derivatives of a splat in its own constants are sums over all points, of products in which some factors belong to the
splat. Where different sums are made of the same parts with different factors, as those of a row M y are of the entries of
y, the parts are what is summed, and the factors wait until that is done, once a splat.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from rsrm_gen.compiler.lower.ir import Graph, Node, reachable
from rsrm_gen.compiler.lower.protect import arguments_first

PARTS = 16  # a sum of more is left as it is


@dataclass(frozen=True)
class Sums:
    """What is to be summed, and each wanted sum as sum over i of factors[i] sums[i], by index; factors None are 1."""

    parts: tuple[Node, ...]
    wanted: tuple[Mapping[int, Node | None], ...]


def factored(graph: Graph, wanted: Sequence[Node], splat: Sequence[Node], forms: Mapping[Node, Node]) -> Sums:
    """Take factors that are made of a splat's own numbers out of sums; `forms` are others of nodes, linear in such."""
    linear = _Linear(graph, wanted, splat, forms)
    found = {node: linear.parts(node) for node in wanted}
    fewer = {node for group in _connected(found) if _is_worth_it(group, found) for node in group}
    parts: dict[Node, int] = {}
    recipes: list[dict[int, Node | None]] = []
    for node in wanted:
        terms: dict[Node | None, Node] = found[node] if node in fewer else {None: node}
        if node.is_number(0):
            terms = {}
        recipes.append({parts.setdefault(part, len(parts)): factor for factor, part in terms.items()})
    return Sums(tuple(parts), tuple(recipes))


def _connected(found: Mapping[Node, Mapping[Node | None, Node]]) -> list[list[Node]]:
    """The sums by groups that share parts."""
    groups: list[tuple[set[Node], list[Node]]] = []
    for node, terms in found.items():
        parts, members = set(terms.values()), [node]
        for group in [g for g in groups if g[0] & parts]:
            groups.remove(group)
            parts, members = parts | group[0], [*group[1], *members]
        groups.append((parts, members))
    return [members for _, members in groups]


def _is_worth_it(group: Sequence[Node], found: Mapping[Node, Mapping[Node | None, Node]]) -> bool:
    """Whether all have factors, their parts are no more than they are, and are less to compute."""
    parts = {part for node in group for part in found[node].values()}
    if len(parts) > len(group) or any(None in found[node] for node in group):
        return False
    return len(reachable(parts)) < len(reachable(group))


class _Linear:
    """Nodes as sums of parts, each with a factor of the splat; the factor None is 1."""

    def __init__(self, graph: Graph, wanted: Sequence[Node], splat: Sequence[Node], forms: Mapping[Node, Node]) -> None:
        self.graph = graph
        self.forms = forms
        own = set(splat)
        for node in reachable([*wanted, *forms.values()]):
            if node.arguments and all(a in own or a.is_constant for a in node.arguments):
                own.add(node)
        self.own = own
        self.known: dict[Node, dict[Node | None, Node]] = {}

    def parts(self, node: Node) -> dict[Node | None, Node]:
        """By factor; a node that has too many is one part."""
        for part in arguments_first(node, self.needed, self.known):
            self.known[part] = self.of(part)
        return self.known[node]

    def needed(self, node: Node) -> Sequence[Node]:
        """What a node is made of, in the form that is linear if there is one."""
        return (self.forms[node],) if node in self.forms else node.arguments

    def of(self, node: Node) -> dict[Node | None, Node]:
        """The same for a node whose arguments are known."""
        if node in self.forms:
            return self.known[self.forms[node]]
        terms: dict[Node | None, Node] = {}
        match node.op:
            case "neg":
                terms = {c: self.graph.neg(n) for c, n in self.known[node.arguments[0]].items()}
            case "add" | "sub":
                terms = self.added(node.arguments[0], node.arguments[1], node.op == "sub")
            case "mul":
                terms = self.product(node.arguments[0], node.arguments[1])
        return terms if 0 < len(terms) <= PARTS else {None: node}

    def added(self, x: Node, y: Node, negative: bool) -> dict[Node | None, Node]:
        """x + y or x - y."""
        if x in self.own or y in self.own:
            return {}
        terms, graph = dict(self.known[x]), self.graph
        for factor, part in self.known[y].items():
            part = graph.neg(part) if negative else part
            terms[factor] = graph.add(terms[factor], part) if factor in terms else part
        return terms

    def product(self, x: Node, y: Node) -> dict[Node | None, Node]:
        """x y, where at most one of the two has factors of the splat."""
        graph = self.graph
        if y in self.own:
            x, y = y, x
        if x.is_constant:
            return {c: graph.mul(x, n) for c, n in self.known[y].items()}
        if x in self.own:
            return {graph.mul(x, c) if c else x: n for c, n in self.known[y].items()} if y not in self.own else {}
        if None not in self.known[y]:
            x, y = y, x
        if None in self.known[x] or None not in self.known[y] or len(self.known[y]) > 1:
            return {}
        return {c: graph.mul(n, y) for c, n in self.known[x].items()}
