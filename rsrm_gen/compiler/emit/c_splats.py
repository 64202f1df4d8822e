"""The sums of splats in C: N points times K splats, values and gradients forward, their adjoints backward.

Every routine of `program.pairs` becomes a function of vectors. Forward, the lanes of some vectors are points, and all
splats pass over them while the sums stay in registers. Backward, the points pass over each splat, whose sums stay in
registers, and are added up over the lanes once a chunk. Nothing of size N x K is stored, and no sum depends on the number
of threads: forward they share the points, backward the splats.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

from rsrm_gen.compiler.emit import c_culling, c_matrix
from rsrm_gen.compiler.emit.c_language import comment, restrict, wrapped
from rsrm_gen.compiler.emit.c_precision import PRECISIONS, Precision
from rsrm_gen.compiler.emit.c_splats_loops import (
    BACKWARD,
    CONSTANTS,
    FLUSH,
    FORWARD,
    OMP,
    POINTS,
    PRODUCTS,
    ROWS,
    ROWWISE,
    SUMS,
    VALUE,
    WORK,
)
from rsrm_gen.compiler.emit.c_vector import BASICS, TYPES, Body, functions_of, indented, polynomial_function, spelled
from rsrm_gen.compiler.emit.c_vector_math import functions
from rsrm_gen.compiler.emit.products import Products, Term, products_of, terms_of, uses_of
from rsrm_gen.compiler.emit.series import Coefficients, tables
from rsrm_gen.compiler.lower import Node, Program, Routine
from rsrm_gen.compiler.lower.ir import Result, reachable

REGISTERS = 20  # sums that stay in registers; of more, products are added up in groups
INLINED = 700  # operations of a routine beyond which a call costs nothing
UNROLLED = (
    400  # operations of a routine beyond which a loop over points costs nothing, and its turns, written out, seconds
)
BUFFER = 24576  # bytes of factors that stay in the first cache
BLOCK = 2  # vectors of points that pass together forward
PAIRS = 16  # of a vector of points and a splat, that a processor computes together: a multiple of BLOCK
CHUNK = 1 << 17  # bytes of points that pass together backward: what stays in the second cache with room to spare

# With one of these defined, the functions of the other precision are left out: who wants one need not wait for both.
OTHER_ALONE = {"": "RSRM_ONLY_FLOAT", "_f": "RSRM_ONLY_DOUBLE"}

PROMISES = {
    "splats_work": "How many numbers of scratch memory the functions below need, for these sizes or smaller ones.",
    "splats_order": "An order of the points in which neighbours are near each other, for sums that leave far pairs out.\n"
    " * Returns about which part of the pairs is summed then; if that is more than `limit`, the order may be any.",
    "splats": "The sums of `splat_count` splats and their gradients at `count` points (RSRM eq. 4).$",
    "splats_value": "The values of the sums alone.$",
    "splats_vjp": "The derivatives of sum_n value_n value_bar_n + gradient_n . gradient_bar_n in mu, W and amplitude.$",
    "splats_rows": "The summands of `splats_vjp`: for each point and splat, the derivatives of value_n value_bar_n +\n"
    " * gradient_n . gradient_bar_n in its mu, W and amplitude, in this order.",
}
WIDTH = """
 * `width` is NULL or has for each splat at least the largest |v| / |W v| of tangent vectors v: pairs that are too far apart
 * are then left out, {far}, if the points are in such an order that far ones are rarely neighbours."""
FAR = "of whose values each is less than |amplitude| {cut:.0e} ({cut_f:.0e} in float)"
INPUTS = ("x", "mu", "W", "amplitude")
CULLED = ("splats", "splats_value", "splats_vjp")  # which may leave far pairs out
BARS = ("value_bar", "gradient_bar")
OUTPUTS = {
    "splats": ("value", "gradient"),
    "splats_value": ("value",),
    "splats_vjp": ("mu_bar", "W_bar", "amplitude_bar"),
    "splats_rows": ("rows",),
}


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


def declarations(program: Program) -> list[str]:
    """The prototypes, for the header."""
    cut, cut_f = (math.exp(-cut / 2) for cut in c_culling.CUT.values())
    far = FAR.format(cut=cut, cut_f=cut_f) if program.culling else "of which there are none on this manifold"
    width = WIDTH.format(far=far)
    return [
        "\n".join([f"/* {promise.replace('$', width)} */", *(_signature(program, name, p) + ";" for p in PRECISIONS)])
        for name, promise in PROMISES.items()
    ]


@lru_cache(maxsize=8)
def source(program: Program, title: str) -> str:
    """The text of NAME_splats.c; asked for twice, before the audit and, with its figures in the other files, after it."""
    routines = _all(program)
    series = tables(routines)
    top = comment([title, "", "Sums of splats, forward and backward. See the header for what the functions promise."])
    includes = f'#include "{program.name}.h"\n\n#include <float.h>\n#include <stdint.h>\n#include <string.h>'
    parts = [top, includes, TYPES, OMP, FLUSH]
    for precision in PRECISIONS:
        parts += [f"#if !defined({OTHER_ALONE[precision.tag]}) /* {precision.type} */"]
        parts += [spelled(BASICS, precision), *functions(functions_of(routines), precision)]
        parts += [polynomial_function(name, coefficients, precision) for coefficients, name in series.items()]
        parts += c_matrix.support(routines, precision)
        parts += _routines(program, series, precision)
        parts += [*_loops(program, precision), f"#endif /* {precision.type} */"]
    return "\n\n".join(parts) + "\n"


def _all(program: Program) -> list[Routine]:
    """The routines on vectors: the pairs', and the distance by which far ones are known."""
    return [*program.pairs, *([program["distance"]] if program.culling else [])]


def _sizes(program: Program) -> Sizes:
    pairs = program.pairs
    x, (mu, W, _) = pairs.features.parameters[0], pairs.constants.parameters
    size = [len(p.nodes) for p in (x, pairs.forward.parameters[0], pairs.gradient.results[0], mu, W)]
    return Sizes(
        size[0],
        size[1],
        size[2],
        size[3],
        size[4],
        len(pairs.forward.parameters[1].nodes),
        len(pairs.backward.results[0].nodes),
    )


def _signature(program: Program, name: str, precision: Precision) -> str:
    full = f"{program.name}_{name}{precision.tag}"
    if name == "splats_work":
        return f"size_t {full}(size_t count, size_t splat_count, int threads)"
    t, r = precision.type, restrict(program)
    if name == "splats_order":
        rows = ", ".join(f"const {t} *{r} {n}" for n in ("x", "mu", "amplitude", "width"))
        return (
            f"double {full}(\n    size_t count, size_t splat_count, {rows},\n"
            f"    double limit, size_t *{r} order, {t} *{r} work)"
        )
    inputs = INPUTS + (("width",) if name in CULLED else ()) + (BARS if name in ("splats_vjp", "splats_rows") else ())
    arguments = ["size_t count", "size_t splat_count", *(f"const {t} *{r} {n}" for n in inputs)]
    arguments += [*(f"{t} *{r} {n}" for n in OUTPUTS[name]), f"{t} *{r} work", "int threads"]
    return (
        f"void {full}(\n    {', '.join(arguments[: 2 + len(inputs)])},\n    {', '.join(arguments[2 + len(inputs) :])})"
    )


# What each routine is for.
TITLES = {
    "features": "What pairs read of points x.",
    "constants": "What pairs read of a splat, of some splats.",
    "value": "Adds the values phi of some splats at $BLOCK vectors of points.",
    "forward": "Adds the values phi of some splats at $BLOCK vectors of points, and slope = d phi / d X.",
    "gradient": "The Riemannian gradient at some points, of the sums of slopes.",
    "factors": "The factors of whose products are what is summed over the points, for some vectors of points.",
    "gradient_vjp": "The adjoint of slope at some points, of that of the gradient.",
    "backward": "Adds what makes the derivatives of phi value_bar + slope . slope_bar, of a splat at some vectors of points.",
    "constants_vjp": "The adjoints of some splats' parameters, of their sums over the points.",
    "distance": "The distances of some points q from one point p.",
}
STEPS = [
    "In steps, each for all pairs before the next, so that what is slow overlaps; `kept` is what later steps read."
]


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
        return [place for name, place in self.places.items() if any(f"{name}[" in line for line in lines)] + [*lines]


SPLATS_AT = "size_t count, const vector@ *points, const T_*splats, const uint32_t *near, vector@ *values"
POINTS_AT = "size_t count, const vector@ *points, const uint32_t *near, const T_*S"
OF_SPLATS = {
    " X": "const vector@ *X = points + $nX * b;",
    " S": "const T_*S = splats + $nS * near[k];",
    "value": "vector@ *value = values + b;",
}
OF_POINTS = {
    " X": "const vector@ *X = points + $nB * (size_t)near[i];",
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


def _routines(program: Program, series: dict[Coefficients, str], precision: Precision) -> list[str]:
    pairs = program.pairs
    sizes, products = _sizes(program), _products(pairs.backward)
    texts = []
    for routine in _all(program):
        if routine is pairs.backward and products is not None:
            texts += _factored(routine, products, sizes, series, precision)
        elif routine.name in FORMS:
            texts.append(_pair_routine(routine, PAIRS, sizes, series, precision))
        else:
            texts.append(_routine(routine, series, precision))
    return texts


def _products(backward: Routine) -> Products | None:
    """The sums of backward as products, where they are more than registers hold."""
    if len(_kept(backward.results[0])) <= REGISTERS:
        return None
    vectors = {n for p in backward.parameters if p.name != "S" for n in p.nodes}
    for node in backward.nodes:
        if any(a in vectors for a in node.arguments):
            vectors.add(node)
    return products_of(backward, vectors)


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
    texts = [_pair_routine(first, _buffer(products), sizes, series, precision)]
    for number, group in enumerate(products.groups):
        sums = [f"sum[{j}] = sum[{j}]{_sum_of(products.terms[i], names)};" for j, i in enumerate(group)]
        texts.append(
            f"/* Adds some of the sums, as products. */\nINLINE void pair_products_{number}{precision.tag}("
            f"const {v} *factor, const {v} *point, {v} *sum) {{\n    (void)factor;\n    (void)point;\n{indented(sums, 4)}\n}}"
        )
    return texts


def _buffer(products: Products) -> int:
    """How many pairs' factors stay in the first cache."""
    return max(4, min(16, BUFFER // (64 * len(products.factors))))


def _needed(routine: Routine, nodes: Sequence[Node]) -> tuple[tuple[str, Node], ...]:
    needed = set(reachable(nodes))
    return tuple((name, node) for name, node in routine.body if node in needed)


def _as_sums(routine: Routine) -> dict[Node, list[Term]]:
    uses = uses_of(routine)
    return {node: terms_of(node, uses) for result in routine.results for node in result.nodes}


def _sum_of(terms: Sequence[Term], names: Mapping[Node, str]) -> str:
    return "".join(f" {'+' if sign > 0 else '-'} {' * '.join(names[f] for f in factors)}" for sign, factors in terms)


def _routine(routine: Routine, series: dict[Coefficients, str], precision: Precision) -> str:
    """A routine on vectors, of what belongs to points alone, or to splats alone."""
    v, t = f"vector{precision.tag}", precision.type
    arguments: list[str] = []
    inputs: dict[Node, str] = {}
    vectors: set[Node] = set()
    unread: list[str] = []
    for parameter in routine.parameters:
        is_vector = (routine.name, parameter.name) != ("distance", "p")
        arguments.append(f"const {v if is_vector else t} *{parameter.name}")
        inputs |= {node: f"{parameter.name}[{i}]" for i, node in enumerate(parameter.nodes)}
        vectors |= set(parameter.nodes) if is_vector else set()
        if not routine.inputs & {str(n.value) for n in parameter.nodes}:
            unread.append(f"(void){parameter.name};")
    body = Body(routine, inputs, vectors, precision, series)
    stores = []
    for result in routine.results:
        arguments.append(f"{v} *{result.name}")
        stores += [_stored(result.name, i, body.result(node)) for i, node in enumerate(result.nodes)]
    lines = indented([*unread, *body.lines(), *stores], 4)
    name = "distances" if routine.name == "distance" else routine.name  # `pair_distance` is public on a manifold `pair`
    head = f"OUTLINE void pair_{name}{precision.tag}("
    return f"/* {TITLES[routine.name]} */\n{head}\n    {', '.join(arguments)}) {{\n{lines}\n}}"


def _stored(result: str, i: int, text: str) -> str:
    return wrapped(f"{result}[{i}] = {text};").strip()


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
    says = comment([TITLES[routine.name], *(STEPS if len(steps) > 1 else []), "", *routine.formula.splitlines()])
    head = f"{kind} void pair_{routine.name}@(\n    {form.arguments}) {{"
    parts = {"nX": sizes.X, "nB": sizes.point, "nS": sizes.S, "nF": len(routine.results[0].nodes)}
    parts |= {"BLOCK": BLOCK, "SPLATS": PAIRS // BLOCK}
    return _filled(f"{says}\n{head}\n{indented([*first, text], 4)}\n}}", parts, precision)


def _stores(routine: Routine, body: Body, sums: Mapping[Node, list[Term]]) -> list[str]:
    """The results of a routine of pairs; sums term by term, so that each is one instruction that multiplies and adds."""
    stores = []
    for result in routine.results:
        for i, node in enumerate(result.nodes):
            if node not in sums:
                stores.append(_stored(result.name, i, body.result(node)))
            elif not node.is_number(0):
                stores.append(_stored(result.name, i, f"{result.name}[{i}]{body.sum_of(sums[node])}"))
    return stores


def _loops(program: Program, precision: Precision) -> list[str]:
    z, backward = _sizes(program), program.pairs.backward
    products, culls = _products(backward), program.culling is not None
    texts = [ROWS, WORK, c_culling.NEAR if culls else c_culling.NONE, CONSTANTS, FORWARD, VALUE, POINTS]
    texts += [
        *([] if products is None else [PRODUCTS]),
        SUMS,
        BACKWARD,
        ROWWISE,
        c_culling.ORDER if culls else c_culling.ORDER_NONE,
    ]
    parts: dict[str, object] = {
        "NAME": program.name,
        "nx": z.x, "nX": z.X, "nG": z.gradient, "nmu": z.mu, "nW": z.W, "nS": z.S, "nP": z.own, "nB": z.point, "nU": z.sums,
        "BLOCK": BLOCK, "CHUNK": CHUNK, "nNEAR": z.x + 1 if culls else 0,
        **c_culling.numbers(program.culling, precision),
    }  # fmt: skip
    parts["SPLATS"], parts["PAIRS"] = PAIRS // BLOCK, PAIRS if products is None else _buffer(products)
    for name in PROMISES:
        parts[f"SIGNATURE_{name}$"] = _signature(program, name, precision)
    if products is None:
        sums = [f"sums[{i}] += vector_sum@(sum[{i}]);" for i in _kept(backward.results[0])]
        parts["SUMS$"] = indented(sums, 4).strip()
    else:
        parts["SUMS$"] = f"for (size_t i = 0; i < {z.sums}; ++i) sums[i] += vector_sum@(sum[i]);"
        parts["nF"] = len(products.factors)
        parts["GROUPS$"] = indented([_group(products, g, z) for g in range(len(products.groups))], 4).strip()
    return [_filled(text, parts, precision) for text in texts]


def _group(products: Products, number: int, z: Sizes) -> str:
    """The sums of a group of products over some vectors of points."""
    group, call = products.groups[number], f"pair_products_{number}@"
    step = f"for (size_t i = 0; i < count; ++i) {call}(factor + $nF * i, points + {z.point} * (size_t)near[i], sum);"
    adds = [f"sums[{i}] += sum[{j}];" for j, i in enumerate(group)]
    return "{\n" + indented([f"vector@ sum[{len(group)}] = {{ZERO}};", step, *adds], 4) + "\n}"


def _kept(result: Result) -> list[int]:
    return [i for i, node in enumerate(result.nodes) if not node.is_number(0)]


def _filled(text: str, parts: Mapping[str, object], precision: Precision) -> str:
    for name in sorted(parts, key=len, reverse=True):
        text = text.replace(f"${name}", str(parts[name]))
    return spelled(text, precision)
