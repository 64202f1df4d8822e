"""The splat split by what its parts depend on, so that a sum over N points and K splats pays for a pair's own work only.

    features      of a point alone:   x -> X                                    N times
    constants     of a splat alone:   (mu, W, amplitude) -> S                   K times
    value         of a pair:          (X, S) -> phi                             N K times
    forward       of a pair:          (X, S) -> phi, slope = d phi / d X        N K times; both are summed over the splats
    gradient      of a point alone:   (x, sum of slopes) -> grad f              N times
    gradient_vjp  of a point alone:   (x, gradient_bar) -> slope_bar            N times
    backward      of a pair:          (X, S, value_bar, slope_bar) -> sums      N K times; summed over the points
    constants_vjp of a splat alone:   (mu, W, amplitude, sums) -> mu_bar, W_bar, amplitude_bar   K times

What depends on the point alone, or on the splat alone, and is read by something that depends on both, is an entry of X or
of S. `backward` is the reverse sweep over value_bar phi + slope_bar . slope, with nothing stored for a pair. All of that is
proportional to the amplitude, which therefore counts once a splat, as do other factors of it (see `sums.py`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from rsrm_gen.compiler.lower.differentiate import gradient
from rsrm_gen.compiler.lower.ir import (
    CONDITIONS,
    SEVERAL,
    Graph,
    Node,
    Packed,
    Pairs,
    Parameter,
    Result,
    Routine,
    dot,
    reachable,
)
from rsrm_gen.compiler.lower.protect import arguments_first
from rsrm_gen.compiler.lower.schedule import schedule
from rsrm_gen.compiler.lower.sums import Sums, factored


@dataclass(frozen=True)
class SplatNodes:
    """A splat in a graph, what it is a function of, and how it follows its exponent: d phi = by_exponent d exponent.

    Of the exponent, only the derivatives count.
    """

    x: Parameter
    mu: Parameter
    W: Parameter
    amplitude: Parameter
    phi: Node
    exponent: Node
    by_exponent: Node
    formula: str = "phi = amplitude |det D Log_mu(x)| exp(-|z|^2 / 2), z = W Log_mu(x)"


X, S = 1, 2  # what a node depends on: the point, the splat, or both


def pairs_of(graph: Graph, splat: SplatNodes, slope_to_gradient: Callable[[Graph, Packed, Packed], Packed]) -> Pairs:
    """Split a splat; `slope_to_gradient` makes the Riemannian gradient (graph, x, df) of partial derivatives."""
    roots = (splat.phi, splat.exponent, splat.by_exponent)
    depends = _dependence(graph, roots, splat)
    X_nodes = _hoisted(depends, X)
    S_nodes = _hoisted(depends, S)
    point, own = (splat.x,), (splat.mu, splat.W, splat.amplitude)

    features = _routine(graph, "features", point, {"X": X_nodes})
    pair = Graph()
    names = _Names(graph)
    x = _parameter(pair, "X", [names.of(n) for n in X_nodes])
    s = _parameter(pair, "S", [names.of(n) for n in S_nodes])
    known = dict(zip((*X_nodes, *S_nodes), (*x.nodes, *s.nodes), strict=True))
    phi, exponent, by_exponent = copied(graph, pair, roots, known)
    slopes = gradient(pair, exponent, x.nodes, by_exponent)
    for node, partial in zip(x.nodes, slopes, strict=True):
        pair.named(f"by_{node.value}", partial)
    value_bar, slope_bar = _parameter(pair, "value_bar", ["value_bar"]), _like(pair, "slope_bar", x)
    total = pair.mul(phi, value_bar.nodes[0])
    for a, b in zip(slopes, slope_bar.nodes, strict=True):
        total = pair.add(total, pair.mul(a, b))
    # The amplitude is a factor of all but its own derivative.
    unit = dict(zip(S_nodes, s.nodes, strict=True))[splat.amplitude.nodes[0]]
    bars = copied(pair, pair, gradient(pair, total, s.nodes), {unit: pair.constant(1)})
    sums = factored(pair, bars, s.nodes, pair.forms)
    read = _read(
        pair, (phi, *slopes, *sums.parts), s.nodes
    )  # other constants count once a splat, in what is done after
    s_read = Parameter(s.name, (len(read),), tuple(read))

    S_read = [source for source, node in zip(S_nodes, s.nodes, strict=True) if node in read]
    constants = _routine(graph, "constants", own, {"S": S_read})

    finish = Graph()
    at = _copied_parameter(finish, splat.x)
    moved = copied(graph, finish, X_nodes, dict(zip(splat.x.nodes, at.nodes, strict=True)))
    slope = _parameter(finish, "slope", [f"slope_{n.value}" for n in x.nodes])
    df = gradient(finish, dot(finish, moved, slope.nodes), at.nodes)
    grad = slope_to_gradient(finish, at.nodes, df)
    gradient_bar = _parameter(finish, "gradient_bar", [f"gradient_bar{i}" for i in range(len(grad))])
    back = gradient(finish, dot(finish, grad, gradient_bar.nodes), slope.nodes)

    splats = Graph()
    parts = tuple(_copied_parameter(splats, p) for p in own)
    inputs = {a: b for p, q in zip(own, parts, strict=True) for a, b in zip(p.nodes, q.nodes, strict=True)}
    again = copied(graph, splats, S_nodes, inputs)
    summed = _parameter(splats, "sums", [f"sum{i}" for i in range(len(sums.parts))])
    s_bar = _wanted(splats, sums, pair, dict(zip(s.nodes, again, strict=True)), summed.nodes)
    # What nothing of a pair is differentiated in has an adjoint of zero, also where its own derivative overflows.
    reached = [(value, bar) for value, bar in zip(again, s_bar, strict=True) if not bar.is_number(0)]
    entries = [node for p in parts for node in p.nodes]
    *by, by_amplitude = gradient(splats, dot(splats, *zip(*reached, strict=True)), entries)
    by_entries = iter([*(splats.mul(parts[2].nodes[0], bar) for bar in by), by_amplitude])
    own_bars = {f"{p.name}_bar": [next(by_entries) for _ in p.nodes] for p in parts}

    return Pairs(
        features,
        constants,
        _routine(pair, "value", (x, s_read), {"value": [phi]}, splat.formula),
        _routine(pair, "forward", (x, s_read), {"value": [phi], "slope": slopes}, splat.formula),
        _routine(finish, "gradient", (at, slope), {"gradient": grad}),
        _routine(finish, "gradient_vjp", (at, gradient_bar), {"slope_bar": back}),
        _routine(pair, "backward", (x, s_read, value_bar, slope_bar), {"sums": sums.parts}, splat.formula),
        _routine(splats, "constants_vjp", (*parts, summed), own_bars),
    )


def _wanted(
    splats: Graph, sums: Sums, pair: Graph, known: Mapping[Node, Node], summed: Sequence[Node]
) -> Iterator[Node]:
    """The sums that were wanted, of those that were made; nothing else depends on their factors."""
    for recipe in sums.wanted:
        total = splats.constant(0)
        for index, factor in recipe.items():
            by = copied(pair, splats, [factor], known)[0] if factor else splats.constant(1)
            total = splats.add(total, splats.mul(by, summed[index]))
        fixed = total if total.is_number(0) else splats.declared(total)
        splats.slopes[fixed] = ()
        yield fixed


def _dependence(graph: Graph, roots: Sequence[Node], splat: SplatNodes) -> dict[Node, int]:
    """X, S or both of every node that the roots and their derivatives need; 0 for numbers."""
    of_point = set(splat.x.nodes)
    depends: dict[Node, int] = {}
    needed = reachable(roots)
    while len(needed) < len(
        needed := reachable([*needed, *(d for n in needed if n.op == "declared" for d in graph.slopes[n])])
    ):
        pass
    for node in needed:
        if node.op == "input":
            depends[node] = X if node in of_point else S
        else:
            depends[node] = 0
            for argument in node.arguments:
                depends[node] |= depends[argument]
    for root in roots:
        depends[root] = X | S  # a constant splat is a pair's own all the same
    return depends


def _hoisted(depends: dict[Node, int], side: int) -> tuple[Node, ...]:
    """The numbers of one side that something of both sides reads."""
    users = (node for node, on in depends.items() if on == X | S)
    read = {a for node in users for a in _numbers(node, depends)}
    return tuple(sorted((a for a in read if depends[a] == side), key=lambda node: node.number))


def _numbers(node: Node, depends: dict[Node, int]) -> Iterator[Node]:
    """The arguments of a node; of what is no single number (a condition, a matrix' decomposition), its arguments."""
    for argument in node.arguments:
        if argument.op in CONDITIONS + SEVERAL and depends[argument] != X | S:
            yield from _numbers(argument, depends)
        else:
            yield argument


def copied(source: Graph, target: Graph, roots: Sequence[Node], known: Mapping[Node, Node]) -> tuple[Node, ...]:
    """Nodes of one graph in another, where some are known already; names, declared derivatives and forms go along."""
    done, declared, waiting = dict(known), [], list(roots)
    while waiting:
        for node in arguments_first(waiting.pop(), lambda n: n.arguments, done):
            parts = tuple(done[a] for a in node.arguments)
            is_trivial = node.op == "mul" and any(part.is_number(1) for part in parts)
            done[node] = target.mul(*parts) if is_trivial else target.node(node.op, *parts, value=node.value)
            if node in source.names:
                target.named(source.names[node], done[node])
            if node.op == "declared":
                declared.append(node)
                waiting += source.slopes[node]
                waiting += [source.forms[node]] if node in source.forms else []
    target.forms.update({done[node]: done[source.forms[node]] for node in declared if node in source.forms})
    target.slopes.update({done[node]: tuple(done[slope] for slope in source.slopes[node]) for node in declared})
    return tuple(done[root] for root in roots)


def undeclared(source: Graph, roots: Sequence[Node], inputs: Sequence[Node]) -> tuple[Graph, dict[Node, Node]]:
    """The same nodes without declared derivatives, which have served once everything is differentiated."""
    target = Graph()
    done = {node: target.input(str(node.value)) for node in inputs}
    for root in roots:
        for node in arguments_first(root, _computes, done):
            parts = [done[a] for a in _computes(node)]
            done[node] = parts[0] if node.op == "declared" else target.node(node.op, *parts, value=node.value)
            if node in source.names:
                target.named(source.names[node], done[node])
    return target, done


def _routine(
    graph: Graph,
    name: str,
    parameters: Sequence[Parameter],
    results: Mapping[str, Sequence[Node]],
    formula: str = "",
) -> Routine:
    target, done = undeclared(
        graph, [n for nodes in results.values() for n in nodes], [n for p in parameters for n in p.nodes]
    )
    moved = tuple(Parameter(p.name, p.shape, tuple(done[n] for n in p.nodes)) for p in parameters)
    found = tuple(Result(key, (len(nodes),), tuple(done[n] for n in nodes)) for key, nodes in results.items())
    return schedule(target, name, moved, found, formula)


def _read(graph: Graph, roots: Sequence[Node], inputs: Sequence[Node]) -> list[Node]:
    """The inputs that are read to compute the roots, not merely to differentiate them."""
    found: dict[Node, None] = {}
    for root in roots:
        for node in arguments_first(root, _computes, found):
            found[node] = None
    return [node for node in inputs if node in found]


def _computes(node: Node) -> Sequence[Node]:
    """What a node is computed from."""
    return node.arguments[:1] if node.op == "declared" else node.arguments


def _parameter(graph: Graph, name: str, entries: Sequence[str]) -> Parameter:
    return Parameter(name, (len(entries),), tuple(graph.input(entry) for entry in entries))


def _like(graph: Graph, name: str, other: Parameter) -> Parameter:
    return _parameter(graph, name, [f"{node.value}_bar" for node in other.nodes])


def _copied_parameter(graph: Graph, other: Parameter) -> Parameter:
    return Parameter(other.name, other.shape, tuple(graph.input(str(node.value)) for node in other.nodes))


class _Names:
    """Names of hoisted nodes: an input's own, the one that people know, or what it is."""

    def __init__(self, graph: Graph) -> None:
        self.graph = graph
        self.taken: set[str] = set()

    def of(self, node: Node) -> str:
        """A name that no other hoisted node has."""
        hint = str(node.value) if node.op == "input" else self.graph.names.get(node, f"{node.op}_of_one")
        name, count = hint, 1
        while name in self.taken:
            count += 1
            name = f"{hint}_{count}"
        self.taken.add(name)
        return name
