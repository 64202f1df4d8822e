"""Results of a routine as short sums of products of other nodes, for sums over many points.

Of more results than a processor has registers, most are entries of outer products a_i b_j. Then what is computed for a
point is the factors; the products are formed where they are added up, some results at a time, whose sums fit registers.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

from rsrm_gen.compiler.lower import Node, Routine

TERMS = 4  # longer sums are computed as they are
GROUP = 12  # results whose sums stay in registers together, of 16, with the factors in use

Term = tuple[int, tuple[Node, ...]]  # a sign, and one or two factors


@dataclass(frozen=True)
class Products:
    """The factors to compute for each point, and for each result that is not 0, by index, its terms in them."""

    factors: tuple[Node, ...]
    terms: dict[int, tuple[Term, ...]]

    @cached_property
    def groups(self) -> list[list[int]]:
        """Results that are added up together: each joins the group to which it adds the fewest factors."""
        left, groups = list(self.terms), []
        while left:
            group = [left.pop(0)]
            while left and len(group) < GROUP:
                known = {f for i in group for f in self._factors(i)}
                best = min(left, key=lambda i: len(self._factors(i) - known))
                left.remove(best)
                group.append(best)
            groups.append(group)
        return groups

    def _factors(self, index: int) -> set[Node]:
        return {factor for _, factors in self.terms[index] for factor in factors}


def products_of(routine: Routine, vectors: set[Node]) -> Products:
    """The products in the one result of a routine; `vectors` are the nodes that differ from point to point."""
    entries = {i: node for i, node in enumerate(routine.results[0].nodes) if not node.is_number(0)}
    found = {i: _terms(node) for i, node in entries.items()}
    uses = Counter(f for terms in found.values() for _, factors in terms for f in factors)
    for i, node in entries.items():
        factors = [f for _, factors in found[i] for f in factors]
        shared = all(f.op == "input" or uses[f] > 1 for f in factors) and all(f in vectors for f in factors)
        if not shared or len(found[i]) > TERMS:
            found[i] = [(1, (node,))]
    needed = {f for terms in found.values() for _, factors in terms for f in factors if f.op != "input"}
    ordered = tuple(sorted(needed, key=lambda node: node.number))
    return Products(ordered, {i: tuple(terms) for i, terms in found.items()})


def terms_of(node: Node, uses: Counter[Node]) -> list[Term]:
    """A node as a sum of nodes and products, as far as nothing else reads the parts of it that then have no value."""
    return _terms(node, 1, lambda n: uses[n] <= 1)


def uses_of(routine: Routine) -> Counter[Node]:
    """How often each node is read, by other nodes or as a result."""
    roots = [node for result in routine.results for node in result.nodes]
    return Counter(argument for node in routine.nodes for argument in node.arguments) + Counter(roots)


def _terms(node: Node, sign: int = 1, splits: Callable[[Node], bool] = lambda node: True) -> list[Term]:
    if not splits(node):
        return [(sign, (node,))]
    a = node.arguments
    if node.op == "neg":
        return _terms(a[0], -sign, splits)
    if node.op in ("add", "sub"):
        return _terms(a[0], sign, splits) + _terms(a[1], sign if node.op == "add" else -sign, splits)
    return [(sign, a if node.op == "mul" else (node,))]
