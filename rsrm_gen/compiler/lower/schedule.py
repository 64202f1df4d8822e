"""From results to a routine: which nodes get a name, which, and in what order."""

from __future__ import annotations

import keyword
from collections import Counter

from rsrm_gen.compiler.lower.ir import (
    CONDITIONS,
    FUNCTIONS,
    SEVERAL,
    Graph,
    Node,
    Parameter,
    Result,
    Routine,
    reachable,
)

INLINE_DEPTH = 4  # deeper expressions are broken up, for people

# Names that mean something in the languages written, or would hide a function there.
RESERVED = {
    *FUNCTIONS, *(f"{name}f" for name in FUNCTIONS), "fabs", "rint", "fabsf", "rintf", "floor", "ceil", "gamma", "signgam",
    "y0", "y1", "yn", "j0", "j1", "jn", "NAN", "NULL", "INFINITY", "HUGE_VAL", "DBL_EPSILON", "FLT_EPSILON", "LANES",
    "SIMD", "VECTOR", "self", "torch", "math", "eps", "polynomial", "i", "k", "n", "lane", "lanes", "count", "sum", "total",
    "start", "weight", "mode", "rest", "amplitude_k", "x_block", "value_bar_block", "gradient_bar_block",
    "auto", "case", "char", "const", "default", "do", "double", "enum", "extern", "float", "goto", "inline", "int", "long",
    "register", "restrict", "short", "signed", "sizeof", "static", "struct", "switch", "typedef", "union", "unsigned", "void",
    "volatile", *(f"in_{k}" for k in range(9)), "itertools", "Tensor",
}  # fmt: skip


def schedule(
    graph: Graph, name: str, parameters: tuple[Parameter, ...], results: tuple[Result, ...], formula: str
) -> Routine:
    """Name what is used twice, what the author named, and what would nest too deeply; write the rest in place."""
    roots = [node for result in results for node in result.nodes]
    nodes = reachable(roots)
    uses = Counter(argument for node in nodes for argument in node.arguments) + Counter(roots)
    names = _Names(
        RESERVED
        | {p.name for p in parameters}
        | {r.name for r in results}
        | {str(n.value) for p in parameters for n in p.nodes}
    )
    depth: dict[Node, int] = {}
    body: list[tuple[str, Node]] = []
    for node in nodes:
        if node.op == "entry" and node not in graph.names:  # reads as well as a name of its own
            depth[node] = 0
            continue
        nested = 1 + max((depth[a] for a in node.arguments), default=-1)
        chosen = uses[node] > 1 or node in graph.names or nested > INLINE_DEPTH or node.op in SEVERAL
        worth_a_name = bool(node.arguments) and chosen
        if worth_a_name:
            body.append((names.of(graph, node), node))
        depth[node] = 0 if worth_a_name else nested
    return Routine(name, parameters, tuple(body), results, formula)


class _Names:
    """Names for nodes, each once in a routine."""

    def __init__(self, taken: set[str]) -> None:
        self.taken = taken

    def of(self, graph: Graph, node: Node) -> str:
        """The node's own name, or one that says what it is."""
        return self.fresh(graph.names.get(node) or self.describe(graph, node))

    def describe(self, graph: Graph, node: Node) -> str:
        if node.op in CONDITIONS:
            return "is_small" if node.arguments[1].is_constant else "is_" + node.op
        if node.op == "spectral":
            name, order = node.function
            return f"{name}m" + ("_slope", f"_derivative{order}")[min(order - 1, 1)] * (order > 0)
        inner = next((graph.names[a] for a in node.arguments if a in graph.names), "")
        words = {
            "mul": "product",
            "add": "total",
            "sub": "gap",
            "div": "ratio",
            "select": "chosen",
            "neg": "minus",
            "root": "length",
        }
        word = words.get(node.op, node.op)
        if node.op == "mul" and node.arguments[0] is node.arguments[1]:
            word = "squared"
        return f"{inner}_{word}" if inner and len(inner) < 12 else word

    def fresh(self, hint: str) -> str:
        name, count = hint + ("_" if keyword.iskeyword(hint) else ""), 1
        while name in self.taken:
            count += 1
            name = f"{hint}_{count}"
        self.taken.add(name)
        return name
