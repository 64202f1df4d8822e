"""The sums of splats in C: N points times K splats, values and gradients forward, their adjoints backward.

Every routine of `program.pairs` becomes a function of vectors. Forward, the lanes of some vectors are points, and all
splats pass over them, some at a time (see `c_pairs.py`). Backward, the points pass over each splat, whose sums stay in
registers, and are added up over the lanes once a chunk. Nothing of size N x K is stored, and no sum depends on the number
of threads: forward they share the points, backward the splats.
"""

from __future__ import annotations

import math
from functools import lru_cache

from rsrm_gen.compiler.emit import c_culling, c_matrix
from rsrm_gen.compiler.emit.c_language import comment, restrict
from rsrm_gen.compiler.emit.c_pairs import (
    BLOCK,
    FORMS,
    PAIRS,
    Sizes,
    backward_products,
    buffered,
    filled,
    kept_sums,
    pair_routine,
    stored,
)
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
from rsrm_gen.compiler.emit.products import Products
from rsrm_gen.compiler.emit.series import Coefficients, tables
from rsrm_gen.compiler.lower import Node, Program, Routine

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
    "gradient": "The Riemannian gradient at some points, of the sums of slopes.",
    "gradient_vjp": "The adjoint of slope at some points, of that of the gradient.",
    "constants_vjp": "The adjoints of some splats' parameters, of their sums over the points.",
    "distance": "The distances of some points q from one point p.",
}


def _routines(program: Program, series: dict[Coefficients, str], precision: Precision) -> list[str]:
    sizes = _sizes(program)
    texts: list[str] = []
    for routine in _all(program):
        if routine.name in FORMS:
            texts += pair_routine(routine, sizes, series, precision)
        else:
            texts.append(_routine(routine, series, precision))
    return texts


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
        stores += [stored(result.name, i, body.result(node)) for i, node in enumerate(result.nodes)]
    lines = indented([*unread, *body.lines(), *stores], 4)
    name = "distances" if routine.name == "distance" else routine.name  # `pair_distance` is public on a manifold `pair`
    head = f"OUTLINE void pair_{name}{precision.tag}("
    return f"/* {TITLES[routine.name]} */\n{head}\n    {', '.join(arguments)}) {{\n{lines}\n}}"


def _loops(program: Program, precision: Precision) -> list[str]:
    z, backward = _sizes(program), program.pairs.backward
    products, culls = backward_products(backward), program.culling is not None
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
    parts["SPLATS"], parts["PAIRS"] = PAIRS // BLOCK, PAIRS if products is None else buffered(products)
    for name in PROMISES:
        parts[f"SIGNATURE_{name}$"] = _signature(program, name, precision)
    if products is None:
        sums = [f"sums[{i}] += vector_sum@(sum[{i}]);" for i in kept_sums(backward)]
        parts["SUMS$"] = indented(sums, 4).strip()
    else:
        parts["SUMS$"] = f"for (size_t i = 0; i < {z.sums}; ++i) sums[i] += vector_sum@(sum[i]);"
        parts["nF"] = len(products.factors)
        parts["GROUPS$"] = indented([_group(products, g, z) for g in range(len(products.groups))], 4).strip()
    return [filled(text, parts, precision) for text in texts]


def _group(products: Products, number: int, z: Sizes) -> str:
    """The sums of a group of products over some vectors of points."""
    group, call = products.groups[number], f"pair_products_{number}@"
    step = f"for (size_t i = 0; i < count; ++i) {call}(factor + $nF * i, points + {z.point} * (size_t)near[i], sum);"
    adds = [f"sums[{i}] += sum[{j}];" for j, i in enumerate(group)]
    return "{\n" + indented([f"vector@ sum[{len(group)}] = {{ZERO}};", step, *adds], 4) + "\n}"
