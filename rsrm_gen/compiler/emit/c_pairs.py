"""What is computed for pairs of points and splats, in C: the functions `pair_value`, `pair_forward` and `pair_backward`.

One call is for some pairs of a vector of points and a splat: forward those of a few vectors with some splats, backward those
of some vectors with one splat. What is slow in a pair, a root, a division, an exponential, is waited for in all of them at
the same time (see `steps.py`). Backward, where a splat has more sums than there are registers, the pairs give factors,
whose products are then added up in groups (see `products.py`).
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from rsrm_gen.compiler.emit.c_language import comment, wrapped
from rsrm_gen.compiler.emit.c_precision import Precision
from rsrm_gen.compiler.emit.c_vector import Body, indented, spelled
from rsrm_gen.compiler.emit.products import Products, Term, products_of, terms_of, uses_of
from rsrm_gen.compiler.emit.series import Coefficients
from rsrm_gen.compiler.lower import Node, Routine
from rsrm_gen.compiler.lower.ir import Result, reachable

REGISTERS = 20  # sums that stay in registers; of more, products are added up in groups
INLINED = 700  # operations of a routine beyond which a call costs nothing
UNROLLED = (
    400  # operations beyond which a loop over points costs nothing, and its turns, written out, take seconds to compile
)
BUFFER = 24576  # bytes of factors that stay in the first cache
BLOCK = 2  # vectors of points that pass together forward
PAIRS = 16  # of a vector of points and a splat, that a processor computes together: a multiple of BLOCK


@dataclass(frozen=True)
class Sizes:
    """How many numbers belong to a point (x, its features X, its gradient) and to a splat (its parameters, constants S, sums)."""

    x: int
    X: int
    gradient: int
    mu: int
    W: int
    S: int
    sums: int

    @property
    def point(self) -> int:
        """What backward reads of a point: its features, value_bar and the adjoints of its slope."""
        return 2 * self.X + 1

    @property
    def own(self) -> int:
        """The parameters of a splat."""
        return self.mu + self.W + 1


# What each routine is for.
TITLES = {
    "value": "Adds the values phi of some splats at $BLOCK vectors of points.",
    "forward": "Adds the values phi of some splats at $BLOCK vectors of points, and slope = d phi / d X.",
    "factors": "The factors of whose products are what is summed over the points, for some vectors of points.",
    "backward": "Adds what makes the derivatives of phi value_bar + slope . slope_bar, of a splat at some vectors of points.",
}
STEPS = "In steps, each for all pairs before the next, so that what is slow overlaps; `kept` is what later steps read."


@dataclass(frozen=True)
class Form:
    """How a routine of pairs is called, and how it passes over them: a splat's with some points, or those of some splats."""

    arguments: str
    places: Mapping[str, str]  # the numbers of a pair, by the array that they are in
    splats: bool  # whether the splats differ
    adds: bool  # whether the results are added to what is there
    may_be_unread: tuple[str, ...]

    @property
    def over(self) -> str:
        """The loop over splats, or over vectors of points."""
        return "for (size_t k = 0; k < count; ++k) {" if self.splats else "for (size_t i = 0; i < count; ++i) {"

    @property
    def kept(self) -> str:
        """Where what is kept of a pair is."""
        return "kept[k][b]" if self.splats else "kept[i]"

    def located(self, lines: Sequence[str]) -> list[str]:
        """Lines, after those that say where the arrays are that they read or write."""
        text = "\n".join(lines)
        return [place for name, place in self.places.items() if re.search(rf"\b{name}\[", text)] + [*lines]


SPLATS_AT = "size_t count, const vector@ *points, const T_*splats, const uint32_t *near, vector@ *values"
POINTS_AT = "size_t count, const vector@ *points, const uint32_t *near, const T_*S"
OF_SPLATS = {
    "X": "const vector@ *X = points + $nX * b;",
    "S": "const T_*S = splats + $nS * near[k];",
    "value": "vector@ *value = values + b;",
}
OF_POINTS = {
    "X": "const vector@ *X = points + $nB * (size_t)near[i];",
    "value_bar": "const vector@ *value_bar = points + $nB * (size_t)near[i] + $nX;",
    "slope_bar": "const vector@ *slope_bar = points + $nB * (size_t)near[i] + $nX + 1;",
}
WITH_SLOPE = {**OF_SPLATS, "slope": "vector@ *slope = slopes + $nX * b;"}
FORMS = {
    "value": Form(SPLATS_AT, OF_SPLATS, True, True, ("points", "splats", "near")),
    "forward": Form(f"{SPLATS_AT}, vector@ *slopes", WITH_SLOPE, True, True, ("points", "splats", "near", "slopes")),
    "backward": Form(f"{POINTS_AT}, vector@ *sums", OF_POINTS, False, True, ("points", "near", "S")),
    "factors": Form(
        f"{POINTS_AT}, vector@ *factors",
        {**OF_POINTS, "factor": "vector@ *factor = factors + $nF * i;"},
        False,
        False,
        ("points", "near", "S"),
    ),
}


def pair_routine(routine: Routine, sizes: Sizes, series: dict[Coefficients, str], precision: Precision) -> list[str]:
    """The function of a routine of pairs; or of backward in two steps, its factors and their products."""
    products = backward_products(routine) if routine.name == "backward" else None
    if products is not None:
        return _factored(routine, products, sizes, series, precision)
    return [_pair_routine(routine, PAIRS, sizes, series, precision)]


def backward_products(backward: Routine) -> Products | None:
    """The sums of backward as products, where they are more than registers hold."""
    if len(kept_sums(backward)) <= REGISTERS:
        return None
    vectors = {n for p in backward.parameters if p.name != "S" for n in p.nodes}
    for node in backward.nodes:
        if any(a in vectors for a in node.arguments):
            vectors.add(node)
    return products_of(backward, vectors)


def kept_sums(backward: Routine) -> list[int]:
    """The sums of backward that are not always zero, by index."""
    return [i for i, node in enumerate(backward.results[0].nodes) if not node.is_number(0)]


def _factored(
    routine: Routine, products: Products, sizes: Sizes, series: dict[Coefficients, str], precision: Precision
) -> list[str]:
    """Backward in two steps: the factors of a pair, then their products."""
    v = f"vector{precision.tag}"
    results = (Result("factor", (len(products.factors),), products.factors),)
    # what only a result needed has no name and is written where the result was
    first = replace(routine, name="factors", results=results, body=_needed(routine, products.factors))
    names = {node: f"factor[{i}]" for i, node in enumerate(products.factors)}
    offset = 0
    for parameter in routine.parameters:
        if parameter.name != "S":
            names |= {node: f"point[{offset + i}]" for i, node in enumerate(parameter.nodes)}
            offset += len(parameter.nodes)
    texts = [_pair_routine(first, buffered(products), sizes, series, precision)]
    for number, group in enumerate(products.groups):
        sums = [f"sum[{j}] = sum[{j}]{_sum_of(products.terms[i], names)};" for j, i in enumerate(group)]
        texts.append(
            f"/* Adds some of the sums, as products. */\nINLINE void pair_products_{number}{precision.tag}("
            f"const {v} *factor, const {v} *point, {v} *sum) {{\n    (void)factor;\n    (void)point;\n{indented(sums, 4)}\n}}"
        )
    return texts


def buffered(products: Products) -> int:
    """How many pairs' factors stay in the first cache."""
    return max(4, min(PAIRS, BUFFER // (64 * len(products.factors))))


def _needed(routine: Routine, nodes: Sequence[Node]) -> tuple[tuple[str, Node], ...]:
    needed = set(reachable(nodes))
    return tuple((name, node) for name, node in routine.body if node in needed)


def _as_sums(routine: Routine) -> dict[Node, list[Term]]:
    uses = uses_of(routine)
    return {node: terms_of(node, uses) for result in routine.results for node in result.nodes}


def _sum_of(terms: Sequence[Term], names: Mapping[Node, str]) -> str:
    return "".join(f" {'+' if sign > 0 else '-'} {' * '.join(names[f] for f in factors)}" for sign, factors in terms)


def _pair_routine(
    routine: Routine, pairs: int, sizes: Sizes, series: dict[Coefficients, str], precision: Precision
) -> str:
    """A routine of some pairs of a vector of points and a splat, of which the constants S are numbers; in steps."""
    form = FORMS[routine.name]
    inputs = {n: f"{p.name}[{i}]" for p in routine.parameters for i, n in enumerate(p.nodes)}
    vectors = {node for p in routine.parameters if p.name != "S" for node in p.nodes}
    sums = _as_sums(routine) if form.adds else {}
    read = [f for terms in sums.values() for _, factors in terms for f in factors]
    results = read if form.adds else list(routine.results[0].nodes)
    body = Body(replace(routine, body=_needed(routine, results)), inputs, vectors, precision, series)
    steps = body.steps(results)
    later = {node for step in steps for node in step.kept}
    kept = {node: body.printer.names[node] for _, node in body.named if node in later}
    loops: list[str] = []
    for step in steps:
        is_last = step is steps[-1]
        loaded = body.read_by(step.nodes, results if is_last else ())
        own = [n for n in loaded if form.splats and n not in vectors]
        lines = [f"const {body.kind(n)} {kept[n]} = {form.kept}.{kept[n]};" for n in step.kept]
        lines += body.statements(step.nodes, [n for n in loaded if n not in own])
        lines += [f"{form.kept}.{kept[n]} = {kept[n]};" for n in step.nodes if n in kept]
        lines += _stores(routine, body, sums) if is_last else []
        lines = form.located(lines)
        if form.splats:
            over = "UNROLLED " * (routine.operations <= UNROLLED) + "for (size_t b = 0; b < $BLOCK; ++b) {"
            lines = [*form.located(body.statements((), own)), over, indented(lines, 4), "}"]
        loops += [form.over, indented(lines, 4), "}"]
    text = "\n".join(loops)
    first = [f"(void){name};" for name in form.may_be_unread if not re.search(rf"\b{name}\b", text)]
    if kept:
        kinds = {kind: [kept[n] for n in kept if body.kind(n) == kind] for kind in map(body.kind, kept)}
        fields = " ".join(f"{kind} {', '.join(names)};" for kind, names in kinds.items())
        first.append(
            wrapped(f"struct {{ {fields} }} kept{'[$SPLATS][$BLOCK]' if form.splats else f'[{pairs}]'};").strip()
        )
    kind = "INLINE" if routine.operations <= INLINED else "OUTLINE"
    says = comment([TITLES[routine.name], *[STEPS] * (len(steps) > 1), "", *routine.formula.splitlines()])
    head = f"{kind} void pair_{routine.name}@(\n    {form.arguments}) {{"
    parts = {"nX": sizes.X, "nB": sizes.point, "nS": sizes.S, "nF": len(routine.results[0].nodes)}
    parts |= {"BLOCK": BLOCK, "SPLATS": PAIRS // BLOCK}
    return filled(f"{says}\n{head}\n{indented([*first, text], 4)}\n}}", parts, precision)


def stored(result: str, i: int, text: str) -> str:
    """The statement that stores an entry of a result."""
    return wrapped(f"{result}[{i}] = {text};").strip()


def _stores(routine: Routine, body: Body, sums: Mapping[Node, list[Term]]) -> list[str]:
    """The results of a routine of pairs; sums term by term, so that each is one instruction that multiplies and adds."""
    stores = []
    for result in routine.results:
        for i, node in enumerate(result.nodes):
            if node not in sums:
                stores.append(stored(result.name, i, body.result(node)))
            elif not node.is_number(0):
                stores.append(stored(result.name, i, f"{result.name}[{i}]{body.sum_of(sums[node])}"))
    return stores


def filled(text: str, parts: Mapping[str, object], precision: Precision) -> str:
    """A template with its parts, in a precision."""
    for name in sorted(parts, key=len, reverse=True):
        text = text.replace(f"${name}", str(parts[name]))
    return spelled(text, precision)
