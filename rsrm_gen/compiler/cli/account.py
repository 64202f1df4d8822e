"""What was derived of a manifold, as chapters of facts; each fact can be said in plain text and in LaTeX."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import sympy as sp

from rsrm_gen.compiler.cli.notation import latex, latex_name, latex_of, plain_of
from rsrm_gen.compiler.derive import Geometry
from rsrm_gen.compiler.derive.geometry import Assignment, Function, Guard, Polynomial
from rsrm_gen.compiler.spec import ManifoldSpec, Map, ProductSpec, Spec
from rsrm_gen.compiler.spec import formula as f

SHORT = 16  # entries and assignments of a derived function that are shown unasked

# The left sides of equations, in plain text and in LaTeX.
EXP = "Exp_p(v)", r"\operatorname{Exp}_p(v)"
LOG = "Log_p(q)", r"\operatorname{Log}_p(q)"
DISTANCE = "d(p, q)", "d(p, q)"
DETERMINANT = "log |det D Log_p(q)|", r"\log \lvert \det D\operatorname{Log}_p(q) \rvert"
INNER = "<u, v>_p", r"\langle u, v \rangle_p"
GRADIENT = "grad f", r"\operatorname{grad} f"
GRADIENTS = {  # the formulas of `derive`, in LaTeX
    "the tangential part of G^-1 df": r"P_p \, G(p)^{-1} \, df",
    "G^-1 E df": r"G(p)^{-1} E(p) \, df",
    "G(p)^-1 df": r"G(p)^{-1} \, df",
}

Sides = tuple[str, str]  # in plain text, in LaTeX


@dataclass(frozen=True)
class Fact:
    """A formula with words on it; words alone where there is no formula."""

    words: str
    plain: str = ""
    latex: str = ""


@dataclass(frozen=True)
class Chapter:
    """Facts under a title."""

    title: str
    facts: tuple[Fact, ...]


def account(geometry: Geometry, steps: bool = False) -> list[Chapter]:
    """All chapters on a manifold; with `steps`, how every derived function is computed, scalar by scalar."""
    spec = geometry.spec
    told = _product(geometry, spec) if isinstance(spec, ProductSpec) else _single(geometry, spec)
    chapters = [_chapter(title, facts) for title, facts in told.items()]
    for name, factor in geometry.factors:
        parts = account(factor)
        chapters.append(_chapter(f"Factor {name}: {factor.spec.identifier}", [Fact(factor.spec.doc)]))
        chapters += [_chapter(f"{name}: {part.title}", part.facts) for part in parts if part.title != "Splat"]
    if steps:
        chapters += [_chapter(f"Steps of {function.name}", _steps(function)) for function in geometry]
    return [chapter for chapter in chapters if chapter.facts]


def _chapter(title: str, facts: Iterable[Fact]) -> Chapter:
    return Chapter(title, tuple(facts))


def _single(geometry: Geometry, spec: ManifoldSpec) -> dict[str, Iterable[Fact]]:
    """A manifold with formulas of its own."""
    retraction = "a retraction and its inverse, not the geodesics of the metric"
    return {
        "Symbols": [*_symbols(spec), *_constants(spec)],
        "Points": _points(spec),
        "Tangent vectors": _tangents(geometry, spec),
        "Metric": [*_metric(spec), *_scale(spec)],
        "Exp and Log": [
            Fact("the geodesics of the metric" if spec.maps == "geodesic" else retraction),
            *_map(spec, spec.exp, EXP),
            *_map(spec, spec.log, LOG),
            *_map(spec, spec.transport, ("transport_pq(v)", r"\operatorname{transport}_{pq}(v)")),
            *_map(spec, spec.sample, ("sample", r"\operatorname{sample}"), "from normal and uniform random numbers"),
        ],
        "Distance": [*_distance(spec), *_lengths(geometry)],
        "Determinant": _determinant(geometry, spec),
        "Gradient": _gradient(geometry, spec),
        "Splat": _splat(),
        "Removable singularities": _singularities(geometry),
        "Cut locus": _cut_locus(spec),
    }


def _product(geometry: Geometry, spec: ProductSpec) -> dict[str, Iterable[Fact]]:
    """How points, lengths and determinants of the factors go together."""
    names = [factor.name for factor in spec.factors]
    weights = [factor.weight.value if factor.weight else None for factor in spec.factors]
    inner = (
        [(f"({w.text})^2 " if w else "") + f"<u, v>_{name}" for name, w in zip(names, weights, strict=True)],
        [
            (rf"\left({latex(w.tree)}\right)^2 " if w else "") + rf"\langle u, v \rangle_{{{latex_name(name)}}}"
            for name, w in zip(names, weights, strict=True)
        ],
    )
    logs = (
        [f"log |det D Log|_{name}" for name in names],
        [rf"\log \lvert \det D\operatorname{{Log}} \rvert_{{{latex_name(name)}}}" for name in names],
    )
    return {
        "Symbols": _symbols(spec),
        "Points and tangent vectors": [_size(spec), *_parts(spec)],
        "Metric": [_sum(INNER, *inner), *_scale(spec)],
        "Exp and Log": [Fact("those of the factors, each on its part of the numbers")],
        "Distance": [_equation(DISTANCE, LENGTH_OF_LOG), *_lengths(geometry)],
        "Determinant": [_sum(DETERMINANT, *logs)],
        "Splat": _splat(),
    }


LENGTH_OF_LOG = "|Log_p(q)|_p", r"\lvert \operatorname{Log}_p(q) \rvert_p"


def _equation(left: Sides, right: Sides, words: str = "") -> Fact:
    return Fact(words, f"{left[0]} = {right[0]}", f"{left[1]} = {right[1]}")


def _sum(left: Sides, plain: Sequence[str], tex: Sequence[str]) -> Fact:
    return _equation(left, (" + ".join(plain), " + ".join(tex)))


def _definition(symbol: sp.Symbol, expression: sp.Expr, words: str = "where") -> Fact:
    """What a symbol of the compiler's stands for."""
    return _equation(_symbol(str(symbol)), (plain_of(expression), latex_of(expression)), words)


def _symbol(name: str) -> Sides:
    return name, latex_name(name)


def _parts(spec: ProductSpec) -> Iterator[Fact]:
    start = 0
    for factor in spec.factors:
        stop = start + factor.spec.point_size
        weight = f", its lengths multiplied by {factor.weight.value.text}" if factor.weight else ""
        words = f"a point of {factor.spec.identifier}{weight}"
        yield Fact(words, f"{factor.name}: p[{start}:{stop}]", rf"\text{{{_tex(factor.name)}: }} p_{{{start}:{stop}}}")
        start = stop


def _tex(word: str) -> str:
    return word.replace("_", r"\_")


def _symbols(spec: Spec) -> Iterator[Fact]:
    for name, text in spec.symbols:
        yield Fact(text, *_symbol(name))
    for name, value in spec.parameters:
        yield _equation(_symbol(name), (str(value), str(value)), "parameter")


def _constants(spec: ManifoldSpec) -> Iterator[Fact]:
    """The `let` of the whole file."""
    for name in sorted(_shared(spec), key=[name for name, _ in spec.exp.lets].index):
        formula = dict(spec.exp.lets)[name]
        yield _equation(_symbol(name), (formula.text, latex(formula.tree)), "constant")


def _shared(spec: ManifoldSpec) -> set[str]:
    """The names of the constants: what Exp and Log have in common."""
    return {name for name, _ in set(spec.exp.lets) & set(spec.log.lets)}


def _scale(spec: Spec) -> Iterator[Fact]:
    if spec.scale is not None:
        value = spec.scale.value
        yield _equation(("scale", r"\text{scale}"), (value.text, latex(value.tree)), "all lengths are multiplied by it")


def _size(spec: Spec) -> Fact:
    D = spec.point_size
    return Fact(f"the dimension is {spec.dim}", f"p in R^{D}", rf"p \in \mathbb{{R}}^{{{D}}}")


def _points(spec: ManifoldSpec) -> Iterator[Fact]:
    yield _size(spec)
    yield from _map(spec, spec.constraint, ("0", "0"), "on the manifold")
    if spec.domain is not None:
        yield Fact("for valid points", spec.domain.value.text, latex(spec.domain.value.tree))
    yield from _map(
        spec, spec.project, ("project(p)", r"\operatorname{project}(p)"), "the point that numbers nearby stand for"
    )
    if spec.equivalent is not None:
        other = spec.equivalent.value
        yield Fact("two names of one point", f"p ~ {other.text}", rf"p \sim {latex(other.tree)}")
    for value, count in _runs(spec.periods or ()):
        if value is not None:
            yield from _map(spec, value, ("period", r"\text{period}"), f"of {count}")


def _runs(periods: Sequence[Map | None]) -> Iterator[tuple[Map | None, str]]:
    """Each period with the coordinates that have it, in words."""
    for i, period in enumerate(periods):
        if period in periods[:i]:
            continue
        alike = [k for k, other in enumerate(periods) if other == period]
        yield period, "every coordinate" if len(alike) == len(periods) else ", ".join(f"p[{k}]" for k in alike)


def _tangents(geometry: Geometry, spec: ManifoldSpec) -> Iterator[Fact]:
    if spec.frame is None and spec.embedded:
        yield Fact(f"{spec.tangent_size} ambient numbers, in the kernel of the constraint's differential dc(p)")
    elif spec.frame is None:
        yield Fact(f"{spec.dim} components along the coordinates")
    elif isinstance(spec.frame.value.tree, f.Rows):
        yield Fact(f"{spec.dim} components in the frame")
        rows = zip(spec.frame.value.tree.items, spec.frame.value.text.split("; "), strict=True)
        for i, (row, text) in enumerate(rows, 1):
            yield _equation((f"e{i}", f"e_{{{i}}}"), (text, latex(row)))
    else:
        yield from _map(spec, spec.frame, ("frame", r"\text{frame}"), f"{spec.dim} components in it")
    yield from _entries(geometry["to_tangent"], ("P x", r"P_p\,x"), "the tangent part of an ambient vector x")


def _metric(spec: ManifoldSpec) -> Iterator[Fact]:
    if spec.metric.value.shape:
        yield from _map(spec, spec.metric, ("G(p)", "G(p)"), "<u, v>_p = u^T G(p) v")
    else:
        yield from _map(spec, spec.metric, INNER)
    yield from _map(spec, spec.norm, ("|v|_p", r"\lvert v \rvert_p"), "the author's closed form")


def _distance(spec: ManifoldSpec) -> Iterator[Fact]:
    if spec.distance is None:
        yield _equation(DISTANCE, LENGTH_OF_LOG)
    else:
        yield from _map(spec, spec.distance, DISTANCE, "the author's closed form, in the names of Log", spec.log)


def _lengths(geometry: Geometry) -> Iterator[Fact]:
    for name, value in (("injectivity radius", geometry.injectivity_radius), ("diameter", geometry.diameter)):
        number = "infinity" if value == sp.oo else plain_of(value)
        yield _equation((name, rf"\text{{{name}}}"), (number, latex_of(value)))


def _determinant(geometry: Geometry, spec: ManifoldSpec) -> Iterator[Fact]:
    function = geometry["log_abs_det"]
    if geometry.log_det_origin == "author":
        yield from _map(spec, spec.log_det, DETERMINANT, "the author's closed form, in the names of Log", spec.log)
    elif geometry.log_det_origin == "closed form":
        found = _found(function)
        words = "found as a product of powers of what Log computes, and checked to 40 digits"
        yield _equation(DETERMINANT, (plain_of(found), latex_of(found)), words)
        yield from _definitions(function, found, {name for name, _ in spec.log.lets})
    else:
        yield Fact("of the Jacobian of Log between orthonormal bases, by stages", *DETERMINANT)
    yield Fact("The volumes on both sides are Riemannian: no coordinates enter, nor does a constant scale.")


def _found(function: Function) -> sp.Expr:
    """The closed form away from the cut locus and from its removable singularity."""
    return next((a.expression for a in function.assignments if str(a.symbol) == "log_det"), function.results[0])


def _definitions(function: Function, expression: sp.Expr, known: set[str]) -> Iterator[Fact]:
    """What the compiler's own names in an expression stand for, down to the author's names."""
    definitions = {a.symbol: a.expression for a in function.assignments}
    waiting = sorted(expression.free_symbols, key=str)
    for symbol in waiting:
        if symbol in definitions and str(symbol) not in known and not str(symbol).startswith(("norm_", "dot_")):
            yield _definition(symbol, definitions[symbol])
            waiting += sorted(definitions[symbol].free_symbols - set(waiting), key=str)


def _gradient(geometry: Geometry, spec: ManifoldSpec) -> Iterator[Fact]:
    formula = geometry["riemannian_gradient"].formula
    words = "from the partial derivatives df" + (", E the frame" if spec.frame else "")
    yield _equation(GRADIENT, (formula, GRADIENTS.get(formula, rf"\text{{{_tex(formula)}}}")), words)
    yield from _entries(geometry["riemannian_gradient"], GRADIENT, "entry by entry")


def _splat() -> Iterator[Fact]:
    gaussian = r"a \exp\left(-\tfrac12 \lVert W \operatorname{Log}_\mu(x) \rVert^2\right)"
    yield _equation(
        ("phi(x)", r"\varphi(x)"),
        (
            "amplitude exp(-|W Log_mu(x)|^2 / 2) |det D Log_mu(x)|",
            rf"{gaussian} \, \lvert \det D\operatorname{{Log}}_\mu(x) \rvert",
        ),
        "W = A^-1 E(mu), with A A^T the covariance in an orthonormal frame E at mu (RSRM eq. 3)",
    )


def _singularities(geometry: Geometry) -> Iterator[Fact]:
    seen: set[tuple[sp.Symbol, sp.Expr]] = set()
    for function in geometry:
        for a in function.assignments if function.name in ("exp", "log", "log_abs_det", "distance") else ():
            if a.guard is not None and (a.symbol, a.expression) not in seen:
                seen.add((a.symbol, a.expression))
                yield _guard(function.name, a, a.guard)
    if not seen:
        yield Fact("none: no formula is 0/0 at coincident points or at the zero vector")


def _guard(function: str, assignment: Assignment, guard: Guard) -> Fact:
    degree = max((len(polynomial.args) - 2 for polynomial in guard.near.atoms(Polynomial)), default=0)
    words = (
        f"in {function}: 0/0 where x = {plain_of(guard.variable)} is 0; for x < {float(guard.threshold):.6g} a polynomial "
        f"of degree {degree} in x stands for it, its relative error at most {guard.error:.1e}"
    )
    return _definition(assignment.symbol, assignment.expression, words)


def _cut_locus(spec: ManifoldSpec) -> Iterator[Fact]:
    cut = spec.cut_locus
    if cut is None:
        yield Fact("none is declared")
        return
    yield Fact("there, in the names of Log", cut.where.value.text, latex(cut.where.value.tree))
    if cut.log is None:
        yield Fact("policy: tie. The formula of Log returns one of the shortest vectors.")
        return
    yield Fact("policy: declared. The code returns there")
    yield from _map(spec, cut.log, LOG, "", spec.log)
    yield from _map(spec, cut.log_det, DETERMINANT, "", spec.log)


def _map(
    spec: ManifoldSpec, found: Map | None, left: Sides, words: str = "", lets_of: Map | None = None
) -> Iterator[Fact]:
    """A map of the author's, if there is one: its value, then those of its parts that are not told elsewhere."""
    if found is None:
        return
    yield _equation(left, (found.value.text, latex(found.value.tree)), words)
    told = _shared(spec) | {name for name, _ in lets_of.lets} if lets_of else _shared(spec)
    for name, formula in found.lets:
        if name not in told:
            yield _equation(_symbol(name), (formula.text, latex(formula.tree)), "where")


def _entries(function: Function, left: Sides, words: str) -> Iterator[Fact]:
    """A derived function in scalars, if it is short."""
    if len(function.assignments) + len(function.results) > SHORT:
        yield Fact(f"{words}: {function.formula}; its {len(function.results)} entries are told by --steps")
        return
    plain = ", ".join(map(plain_of, function.results))
    rows = r" \\ ".join(map(latex_of, function.results))
    yield _equation(left, (f"[{plain}]", rf"\begin{{pmatrix}} {rows} \end{{pmatrix}}"), words)
    for a in function.assignments:
        yield _definition(a.symbol, a.expression)


def _steps(function: Function) -> Iterator[Fact]:
    for a in function.assignments:
        yield _definition(a.symbol, a.expression, "")
    for i, result in enumerate(function.results):
        name = f"{function.name}[{i}]" if function.shape else function.name
        yield _equation((name, rf"\text{{{_tex(name)}}}"), (plain_of(result), latex_of(result)))
