"""What was derived of a manifold, as a list of facts; each can be said in plain text and in LaTeX."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import sympy as sp

from rsrm_gen.compiler.cli.notation import latex, latex_name, latex_of, plain_of
from rsrm_gen.compiler.derive import Geometry
from rsrm_gen.compiler.derive.geometry import Assignment, Function, Guard, Polynomial
from rsrm_gen.compiler.spec import ManifoldSpec, Map, ProductSpec, Spec
from rsrm_gen.compiler.spec import formula as f

CONSTANT = "constant"
DETERMINANT = ("log |det D Log_p(q)|", r"\log \lvert \det D\operatorname{Log}_p(q) \rvert")
SHORT = 16  # entries and assignments of a derived function that are shown unasked


@dataclass(frozen=True)
class Fact:
    """A formula `left = right` with words around it; a fact without a formula is words alone."""

    words: str = ""
    plain: tuple[str, str] | None = None
    latex: tuple[str, str] | None = None


@dataclass(frozen=True)
class Chapter:
    """Facts under a title."""

    title: str
    facts: tuple[Fact, ...]


def account(geometry: Geometry, steps: bool = False) -> list[Chapter]:
    """All chapters on a manifold; with `steps`, how every derived function is computed, scalar by scalar."""
    spec = geometry.spec
    chapters = _product(geometry, spec) if isinstance(spec, ProductSpec) else _single(geometry, spec)
    for name, factor in geometry.factors:
        title = f"Factor `{name}`" if len(geometry.factors) > 1 else "Every factor"
        chapters.append(Chapter(f"{title}: {factor.spec.identifier}", (Fact(factor.spec.doc),)))
        chapters += [Chapter(f"{name}: {c.title}", c.facts) for c in account(factor)]
    if steps:
        chapters += [Chapter(f"Steps of {function.name}", tuple(_steps(function))) for function in geometry]
    return chapters


def _single(geometry: Geometry, spec: ManifoldSpec) -> list[Chapter]:
    maps = (
        "the maps of the metric"
        if spec.maps == "geodesic"
        else "a retraction and its inverse, not geodesics of the metric"
    )
    transport = _map(spec.transport, r"\operatorname{transport}", "transport") if spec.transport else ()
    sample = _map(spec.sample, r"\operatorname{sample}", "sample") if spec.sample else ()
    chapters = [
        Chapter("Symbols", (*_symbols(spec), *_constants(spec))),
        Chapter("Points", tuple(_points(spec))),
        Chapter("Tangent vectors", tuple(_tangents(geometry, spec))),
        Chapter("Metric", (*_metric(spec), *_closed_norm(spec), *_scale(spec))),
        Chapter("Exp", (Fact(maps), *_map(spec.exp, r"\operatorname{Exp}_p(v)", "Exp_p(v)"))),
        Chapter("Log", tuple(_map(spec.log, r"\operatorname{Log}_p(q)", "Log_p(q)"))),
        Chapter("Transport and sampling", (*transport, *sample)),
        Chapter("Distance", (*_distance(spec), *_lengths(geometry))),
        Chapter("Determinant", tuple(_determinant(geometry, spec))),
        Chapter("Gradient", tuple(_gradient(geometry, spec))),
        Chapter("Splat", tuple(_splat())),
        Chapter("Removable singularities", tuple(_singularities(geometry))),
        Chapter("Cut locus", tuple(_cut_locus(spec))),
    ]
    constants = {fact.plain for fact in _constants(spec)}
    return [
        Chapter(c.title, tuple(f for f in c.facts if f.words == CONSTANT or f.plain not in constants))
        for c in chapters
        if c.facts
    ]


def _product(geometry: Geometry, spec: ProductSpec) -> list[Chapter]:
    """What is particular of a product: how points, lengths and determinants of the factors go together."""
    parts = []
    start = 0
    for factor in spec.factors:
        stop = start + factor.spec.point_size
        weight = "" if factor.weight is None else f", lengths multiplied by {factor.weight.value.text}"
        words = f"{factor.spec.identifier}, p[{start}:{stop}]{weight}"
        parts.append(
            Fact(
                words,
                ("point of", f"`{factor.name}`"),
                (r"\text{point of}", rf"\text{{`{factor.name}'}}".replace("_", r"\_")),
            )
        )
        start = stop
    names = [factor.name for factor in spec.factors]
    weights = {f.name: f.weight.value.text for f in spec.factors if f.weight}
    terms = [f"({weights[n]})^2 <u, v>_{n}" if n in weights else f"<u, v>_{n}" for n in names]
    tex = [
        (rf"\left({latex(f.weight.value.tree)}\right)^2 " if f.weight else "")
        + rf"\langle u, v \rangle_{{{latex_name(f.name)}}}"
        for f in spec.factors
    ]
    together = ("|v|_p = sqrt(<v, v>_p); Exp and Log are those of the factors, each on its part of the numbers",)
    determinants = [f"log |det D Log|_{n}" for n in names]
    sums = [rf"\log \lvert \det D\operatorname{{Log}} \rvert_{{{latex_name(n)}}}" for n in names]
    chapters = [
        Chapter("Symbols", tuple(_symbols(spec))),
        Chapter(
            "Points and tangent vectors", (Fact(f"{spec.point_size} numbers; the dimension is {spec.dim}"), *parts)
        ),
        Chapter(
            "Metric",
            (
                Fact("", ("<u, v>_p", " + ".join(terms)), (r"\langle u, v \rangle_p", " + ".join(tex))),
                Fact(*together),
                *_scale(spec),
            ),
        ),
        Chapter(
            "Distance",
            (
                Fact(
                    "",
                    ("d(p, q)", "sqrt of the sum of the squares"),
                    ("d(p, q)", r"\lvert \operatorname{Log}_p(q) \rvert_p"),
                ),
                *_lengths(geometry),
            ),
        ),
        Chapter(
            "Determinant",
            (
                Fact(
                    "the sum of those of the factors",
                    (DETERMINANT[0], " + ".join(determinants)),
                    (DETERMINANT[1], " + ".join(sums)),
                ),
            ),
        ),
        Chapter("Splat", tuple(_splat())),
    ]
    return [chapter for chapter in chapters if chapter.facts]


def _symbols(spec: Spec) -> Iterator[Fact]:
    for name, text in spec.symbols:
        yield Fact(text, (name, ""), (latex_name(name), ""))
    for name, value in spec.parameters:
        yield Fact("parameter", (name, str(value)), (latex_name(name), str(value)))


def _constants(spec: ManifoldSpec) -> Iterator[Fact]:
    """The `let` of the whole file: what Exp and Log share."""
    shared = dict(spec.exp.lets)
    for name, formula in spec.log.lets:
        if shared.get(name) == formula:
            yield Fact(CONSTANT, (name, formula.text), (latex_name(name), latex(formula.tree)))


def _scale(spec: Spec) -> Iterator[Fact]:
    if spec.scale is not None:
        yield from _map(spec.scale, r"\text{scale}", "scale", "all lengths are multiplied by it")


def _points(spec: ManifoldSpec) -> Iterator[Fact]:
    D = spec.point_size
    yield Fact(f"{D} numbers; the dimension is {spec.dim}", ("p in", f"R^{D}"), (r"p \in", rf"\mathbb{{R}}^{{{D}}}"))
    if spec.constraint is not None:
        yield from _map(spec.constraint, "0", "0", "on the manifold")
    if spec.domain is not None:
        tree = spec.domain.value
        yield Fact("valid where", ("", tree.text), ("", latex(tree.tree)))
    if spec.project is not None:
        yield from _map(spec.project, r"\operatorname{project}(p)", "project(p)", "numbers nearby stand for the point")
    if spec.equivalent is not None:
        yield from _map(spec.equivalent, r"p \sim", "p ~", "two names of one point")
    for i, period in enumerate(spec.periods or ()):
        if period is not None:
            yield from _map(period, rf"\text{{period of }} p_{{{i}}}", f"period of p[{i}]")


def _tangents(geometry: Geometry, spec: ManifoldSpec) -> Iterator[Fact]:
    if spec.frame is not None:
        yield Fact(f"{spec.dim} components in the frame")
        assert isinstance(spec.frame.value.tree, f.Rows)
        for i, (row, text) in enumerate(
            zip(spec.frame.value.tree.items, spec.frame.value.text.split("; "), strict=True)
        ):
            yield Fact("", (f"e{i + 1}", text), (f"e_{{{i + 1}}}", latex(row)))
    elif spec.embedded:
        yield Fact(f"{spec.tangent_size} ambient numbers, in the kernel of the constraint's differential dc(p)")
    else:
        yield Fact(f"{spec.dim} components along the coordinates")
    yield from _entries(geometry["to_tangent"], "tangent part of an ambient vector x", "to_tangent_p(x)", r"P_p\,x")


def _metric(spec: ManifoldSpec) -> Iterator[Fact]:
    if spec.metric.value.shape:
        yield from _map(spec.metric, "G(p)", "G(p)", "<u, v>_p = u^T G(p) v")
    else:
        yield from _map(spec.metric, r"\langle u, v \rangle_p", "<u, v>_p")


def _closed_norm(spec: ManifoldSpec) -> Iterator[Fact]:
    if spec.norm is not None:
        yield from _map(spec.norm, r"\lvert v \rvert_p", "|v|_p", "the author's closed form")


def _distance(spec: ManifoldSpec) -> Iterator[Fact]:
    if spec.distance is None:
        yield Fact("", ("d(p, q)", "|Log_p(q)|_p"), ("d(p, q)", r"\lvert \operatorname{Log}_p(q) \rvert_p"))
    else:
        yield Fact(
            "the author's closed form, in the names of Log",
            ("d(p, q)", spec.distance.value.text),
            ("d(p, q)", latex(spec.distance.value.tree)),
        )


def _lengths(geometry: Geometry) -> Iterator[Fact]:
    for name, value in (("injectivity radius", geometry.injectivity_radius), ("diameter", geometry.diameter)):
        number = "infinite" if value == sp.oo else plain_of(value)
        yield Fact("", (name, number), (rf"\text{{{name}}}", latex_of(value)))


def _determinant(geometry: Geometry, spec: ManifoldSpec) -> Iterator[Fact]:
    left = DETERMINANT
    function = geometry["log_abs_det"]
    if geometry.log_det_origin == "author":
        assert spec.log_det is not None
        tree = spec.log_det.value.tree
        yield Fact("the author's closed form, in the names of Log", (left[0], function.formula), (left[1], latex(tree)))
    elif geometry.log_det_origin == "closed form":
        expression = _found(function)
        yield Fact(
            "found as a product of powers of what Log computes, and checked to 40 digits",
            (left[0], plain_of(expression)),
            (left[1], latex_of(expression)),
        )
        yield from _definitions(function, expression, {name for name, _ in spec.log.lets})
    else:
        yield Fact("the determinant of the Jacobian of Log, entry by entry, in orthonormal bases", *_same(left))
    yield Fact("The volumes on both sides are Riemannian: no coordinates enter, nor does a constant scale.")


def _same(left: tuple[str, str]) -> tuple[tuple[str, str], tuple[str, str]]:
    return (left[0], "staged"), (left[1], r"\text{staged}")


def _found(function: Function) -> sp.Expr:
    """The closed form away from the cut locus and from its removable singularity."""
    guarded = {a.symbol: a.expression for a in function.assignments if str(a.symbol) == "log_det"}
    return next(iter(guarded.values()), function.results[0])


def _definitions(function: Function, expression: sp.Expr, known: set[str]) -> Iterator[Fact]:
    """What the compiler's own names in an expression stand for, down to the author's names."""
    definitions = {a.symbol: a.expression for a in function.assignments}
    waiting = sorted(expression.free_symbols, key=str)
    for symbol in waiting:
        if symbol not in definitions or str(symbol) in known or str(symbol).startswith(("norm_", "dot_")):
            continue
        value = definitions[symbol]
        yield Fact("where", (str(symbol), plain_of(value)), (latex_name(str(symbol)), latex_of(value)))
        waiting += sorted(value.free_symbols - set(waiting), key=str)


def _gradient(geometry: Geometry, spec: ManifoldSpec) -> Iterator[Fact]:
    formulas = {
        "the tangential part of G^-1 df": r"P_p \, G(p)^{-1} \, df",
        "G^-1 E df": r"G(p)^{-1} E(p) \, df",
        "G(p)^-1 df": r"G(p)^{-1} \, df",
    }
    formula = geometry["riemannian_gradient"].formula
    yield Fact(
        "from the partial derivatives df" + (", E the frame" if spec.frame else ""),
        ("grad f", formula),
        (r"\operatorname{grad} f", formulas.get(formula, rf"\text{{{formula}}}")),
    )
    yield from _entries(geometry["riemannian_gradient"], "entry by entry", "grad f", r"\operatorname{grad} f")


def _splat() -> Iterator[Fact]:
    yield Fact(
        "W = A^-1 E(mu), the inverse square root of the covariance in an orthonormal frame at mu (RSRM eq. 3)",
        ("phi(x)", "amplitude exp(-|W Log_mu(x)|^2 / 2) |det D Log_mu(x)|"),
        (
            r"\varphi(x)",
            r"a \exp\left(-\tfrac12 \lVert W \operatorname{Log}_\mu(x) \rVert^2\right)"
            r" \lvert \det D\operatorname{Log}_\mu(x) \rvert",
        ),
    )


def _singularities(geometry: Geometry) -> Iterator[Fact]:
    seen: dict[tuple[sp.Symbol, sp.Expr], str] = {}
    for function in geometry:
        if function.name not in ("exp", "log", "log_abs_det", "distance"):
            continue
        for assignment in function.assignments:
            key = assignment.symbol, assignment.expression
            if assignment.guard is not None and key not in seen:
                seen[key] = function.name
                yield _guard(function.name, assignment, assignment.guard)
    if not seen:
        yield Fact("none: no formula is 0/0 at coincident points or at the zero vector")


def _guard(function: str, assignment: Assignment, guard: Guard) -> Fact:
    degree = max((len(polynomial.args) - 2 for polynomial in guard.near.atoms(Polynomial)), default=0)
    name, expression = str(assignment.symbol), assignment.expression
    words = (
        f"in {function}: 0/0 where x = {plain_of(guard.variable)} is 0; for x < {float(guard.threshold):.6g} a polynomial "
        f"of degree {degree} in x stands for it, its relative error at most {guard.error:.1e}"
    )
    return Fact(words, (name, plain_of(expression)), (latex_name(name), latex_of(expression)))


def _cut_locus(spec: ManifoldSpec) -> Iterator[Fact]:
    cut = spec.cut_locus
    if cut is None:
        yield Fact("none is declared")
        return
    yield Fact("where this holds, in the names of Log", ("", cut.where.value.text), ("", latex(cut.where.value.tree)))
    if cut.log is None or cut.log_det is None:
        yield Fact("policy: tie. The formula of Log returns one of the shortest vectors.")
        return
    yield Fact(
        "policy: declared. There the code returns",
        ("Log_p(q)", cut.log.value.text),
        (r"\operatorname{Log}_p(q)", latex(cut.log.value.tree)),
    )
    yield Fact(
        "and",
        ("log |det D Log_p(q)|", cut.log_det.value.text),
        (r"\log \lvert \det D\operatorname{Log}_p(q) \rvert", latex(cut.log_det.value.tree)),
    )


def _map(found: Map, left: str, plain_left: str, words: str = "") -> Iterator[Fact]:
    """A map of the author's: its value, then its parts."""
    yield Fact(words, (plain_left, found.value.text), (left, latex(found.value.tree)))
    for name, formula in found.lets:
        yield Fact("where", (name, formula.text), (latex_name(name), latex(formula.tree)))


def _entries(function: Function, words: str, plain_left: str, left: str) -> Iterator[Fact]:
    """A derived function in scalars, if it is short."""
    if len(function.assignments) + len(function.results) > SHORT:
        yield Fact(
            words, (plain_left, function.formula), (left, rf"\text{{{function.formula.replace('^', ' to the ')}}}")
        )
        return
    plain = ", ".join(map(plain_of, function.results))
    rows = r" \\ ".join(map(latex_of, function.results))
    yield Fact(words, (plain_left, f"[{plain}]"), (left, rf"\begin{{pmatrix}} {rows} \end{{pmatrix}}"))
    for a in function.assignments:
        yield Fact(
            "where", (str(a.symbol), plain_of(a.expression)), (latex_name(str(a.symbol)), latex_of(a.expression))
        )


def _steps(function: Function) -> Iterator[Fact]:
    for a in function.assignments:
        yield Fact("", (str(a.symbol), plain_of(a.expression)), (latex_name(str(a.symbol)), latex_of(a.expression)))
    for i, result in enumerate(function.results):
        name = f"{function.name}[{i}]" if function.shape else function.name
        yield Fact("", (name, plain_of(result)), (rf"\text{{{name}}}".replace("_", r"\_"), latex_of(result)))
