"""The splat in the form in which sums of many are cheapest: on quadrics of constant curvature, see `derive.radial`.

There a pair is d + 1 dot products of the point with rows that belong to the splat, and functions of one number: with
w = sqrt((1 + c) / 2), c = <mu, x>, and eta = d log A / dw, which is one polynomial,

    1 / A = w - (1 - w^2) eta,   a = A / w,   d log a / dw = eta - 1 / w,   z = a R x,   R = W (tangent part at mu).

In a product every factor has its own form, or the author's formulas. The routines of single splats keep those.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import sympy as sp

from rsrm_gen.compiler.derive import Geometry
from rsrm_gen.compiler.derive.geometry import Radial
from rsrm_gen.compiler.derive.radial import NEAR, profile
from rsrm_gen.compiler.lower.from_sympy import inline
from rsrm_gen.compiler.lower.ir import Graph, Node, Packed, Result, Routine, dot
from rsrm_gen.compiler.lower.pairs import SplatNodes, parameter
from rsrm_gen.compiler.lower.schedule import schedule
from rsrm_gen.compiler.spec import ProductSpec

HALF = sp.Rational(1, 2)


@dataclass(frozen=True)
class _Part:
    """A factor that is no product: where its entries begin in points and in tangent vectors."""

    geometry: Geometry
    point: int
    tangent: int
    prefix: str


def _parts(geometry: Geometry, point: int = 0, tangent: int = 0, prefix: str = "") -> Iterator[_Part]:
    spec = geometry.spec
    if not isinstance(spec, ProductSpec):
        yield _Part(geometry, point, tangent, prefix)
        return
    known = {factor.spec.content_hash: factor for _, factor in geometry.factors}
    for factor in spec.factors:
        yield from _parts(known[factor.spec.content_hash], point, tangent, f"{prefix}{factor.name}_")
        point, tangent = point + factor.spec.point_size, tangent + factor.spec.tangent_size


def reduced(geometry: Geometry, splat: SplatNodes, graph: Graph) -> SplatNodes | None:
    """The same splat in the reduced form; None where no part of the manifold has one."""
    parts = list(_parts(geometry))
    if not any(part.geometry.radial for part in parts):
        return None
    form = _Form(graph, splat, geometry.spec.dim, geometry.spec.tangent_size)
    for part in parts:
        if part.geometry.radial:
            form.add_radial(part, part.geometry.radial)
        else:
            form.add_plain(part)
    return form.splat_nodes(alone=len(parts) == 1)


def extent(geometry: Geometry) -> Routine | None:
    """The sum of squares of the coordinates of a point on unbounded quadrics; None where there is none."""
    graph = Graph()
    p = parameter(graph, "p", [f"p{i}" for i in range(geometry.spec.point_size)])
    squares = [
        node
        for part in _parts(geometry)
        if part.geometry.radial and part.geometry.radial.unbounded
        for node in p.nodes[part.point : part.point + part.geometry.spec.point_size]
    ]
    if not squares:
        return None
    return schedule(graph, "extent", (p,), (Result("extent", (), (dot(graph, squares, squares),)),), "")


class _Form:
    """Gathers what the parts of a manifold give to z = W Log_mu(x), to log |det D Log| and to the splat."""

    def __init__(self, graph: Graph, splat: SplatNodes, dim: int, tangent_size: int) -> None:
        self.graph = graph
        self.splat = splat
        self.dim = dim
        self.tangent_size = tangent_size
        self.scaled_rows: list[tuple[Node, Packed]] = []  # a and R x of each radial part
        self.plain_rows: list[Packed] = []  # W v of the others
        self.log_dets: list[Node] = []
        self.factors: list[Node] = []  # powers of a, which need no exponential
        self.exponents: list[Node] = []  # log dets of the others
        self.at_cut: list[
            tuple[Node, Node]
        ] = []  # where a point is on the cut locus of a splat, and the splat's value there

    def covector(self, i: int, part: _Part) -> Packed:
        """The entries of a row of W that belong to a part."""
        start = i * self.tangent_size + part.tangent
        return self.splat.W.nodes[start : start + part.geometry.spec.tangent_size]

    def points(self, part: _Part) -> tuple[Packed, Packed]:
        """Its entries of mu and x."""
        place = slice(part.point, part.point + part.geometry.spec.point_size)
        return self.splat.mu.nodes[place], self.splat.x.nodes[place]

    def add_plain(self, part: _Part) -> None:
        """A part by the author's Log and its determinant."""
        graph, (mu, x) = self.graph, self.points(part)
        v = inline(graph, part.geometry["log"], mu, x, prefix=part.prefix)
        (log_det,) = inline(graph, part.geometry["log_abs_det"], mu, x, prefix=part.prefix)
        self.plain_rows.append(tuple(dot(graph, self.covector(i, part), v) for i in range(self.dim)))
        self.log_dets.append(log_det)
        self.exponents.append(log_det)

    def add_radial(self, part: _Part, radial: Radial) -> None:
        """A part in the radial form."""
        graph, (mu, x) = self.graph, self.points(part)
        size = len(x)
        unit = [tuple(graph.constant(int(i == j)) for i in range(size)) for j in range(size)]
        tangent = [inline(graph, part.geometry["to_tangent"], mu, e, prefix=part.prefix) for e in unit]
        rows = []
        for i in range(self.dim):
            row = (dot(graph, self.covector(i, part), column) for column in tangent)
            named = tuple(graph.named(f"{part.prefix}R{i}_{j}", node) for j, node in enumerate(row))
            rows.append(graph.named(f"{part.prefix}r{i}", dot(graph, named, x)))
        shape = _Profile(graph, radial, part.prefix, mu, x)
        self.scaled_rows.append((shape.a, tuple(rows)))
        self.log_dets.append(graph.mul(graph.constant(radial.power), shape.log_a))
        self.factors += [shape.a] * radial.power
        if shape.on_cut is not None:
            self.at_cut.append((shape.on_cut, self.value_at_cut(part, mu)))

    def value_at_cut(self, part: _Part, mu: Packed) -> Node:
        """exp(log det - |z|^2 / 2) at the antipode of mu, by the author's policy: the splat's own number."""
        graph = self.graph
        antipode = tuple(map(graph.neg, mu))
        v = inline(graph, part.geometry["log"], mu, antipode)
        (log_det,) = inline(graph, part.geometry["log_abs_det"], mu, antipode)
        z = [dot(graph, self.covector(i, part), v) for i in range(self.dim)]
        exponent = graph.sub(log_det, graph.mul(graph.constant(HALF), dot(graph, z, z)))
        return graph.named(f"{part.prefix}value_on_cut_locus", graph.function("exp", exponent))

    def square(self, alone: bool) -> Node:
        """|z|^2."""
        graph = self.graph
        if alone and self.scaled_rows:
            ((a, rows),) = self.scaled_rows
            return graph.mul(graph.mul(a, a), graph.named("length_squared", dot(graph, rows, rows)))
        terms = [[graph.mul(a, r) for r in rows] for a, rows in self.scaled_rows] + [list(r) for r in self.plain_rows]
        z = []
        for i in range(self.dim):
            total = terms[0][i]
            for term in terms[1:]:
                total = graph.add(total, term[i])
            z.append(graph.named(f"z{i}", total))
        return dot(graph, z, z)

    def splat_nodes(self, alone: bool) -> SplatNodes:
        """phi, the exponent whose derivative is phi's own, and the factor between them."""
        graph = self.graph
        half_square = graph.mul(graph.constant(HALF), self.square(alone))
        exponent, inside = graph.neg(half_square), graph.neg(half_square)
        for log_det in self.log_dets:
            exponent = graph.add(exponent, log_det)
        for log_det in self.exponents:
            inside = graph.add(inside, log_det)
        value = graph.named("gaussian", graph.function("exp", inside))
        for factor in self.factors:
            value = graph.mul(value, factor)
        slope = value
        for on_cut, at_cut in self.at_cut:
            value = graph.select(on_cut, at_cut, value)
            slope = graph.select(on_cut, graph.constant(0), slope)
        # The derivative of both is the second: on the cut locus itself, the splat does not change.
        value, slope = graph.declared(value, exponent), graph.declared(slope, exponent)
        graph.slopes[value] = graph.slopes[slope] = slope
        amplitude = self.splat.amplitude.nodes[0]
        phi = graph.named("phi", graph.mul(amplitude, value))
        return replace(self.splat, phi=phi, exponent=exponent, by_exponent=graph.mul(amplitude, slope))


class _Profile:
    """a and log a as functions of c = <mu, x>, and where the cut locus is; `log_a` is good for its derivatives only."""

    def __init__(self, graph: Graph, radial: Radial, prefix: str, mu: Packed, x: Packed) -> None:
        self.graph = graph
        self.prefix = prefix
        self.on_cut: Node | None = None
        self.form = [[graph.constant(f) for f in row] for row in radial.form]
        columns = zip(*self.form, strict=True)
        row = tuple(self.named(f"c{j}", dot(graph, mu, column)) for j, column in enumerate(columns))
        c = dot(graph, row, x)
        if radial.folded:
            self.of_folded(c)
        elif radial.unbounded:
            self.of_hyperboloid(c, self.chord(mu, x, graph.sub))
        else:
            self.of_sphere(c, self.chord(mu, x, graph.add))

    def named(self, name: str, node: Node) -> Node:
        """A node under a name of the part."""
        return self.graph.named(f"{self.prefix}{name}", node)

    def number(self, x: sp.Expr | int) -> Node:
        return self.graph.constant(x)

    def square(self, x: Node) -> Node:
        return self.graph.mul(x, x)

    def chord(self, mu: Packed, x: Packed, combined: Callable[[Node, Node], Node]) -> Node:
        """<x + mu, x + mu> / 4 = (1 + c) / 2, or of x - mu, (1 - c) / 2: without the cancellation in 1 +- c."""
        graph = self.graph
        chord = tuple(combined(a, b) for a, b in zip(x, mu, strict=True))
        image = (dot(graph, column, chord) for column in zip(*self.form, strict=True))
        return graph.mul(self.number(sp.Rational(1, 4)), dot(graph, chord, tuple(image)))

    def of_folded(self, c: Node) -> None:
        """a = A(|c|): the sign of a changes z, not its length."""
        graph = self.graph
        w = self.named("w", graph.function("abs", c))
        gap = graph.sub(self.number(1), w)
        eta, eta_slope = self.near(gap, False)
        over_A = graph.add(w, graph.mul(graph.mul(gap, graph.add(self.number(1), w)), graph.neg(eta)))
        self.declare(w, self.named("a", graph.div(self.number(1), over_A)), eta, eta_slope, None)

    def of_sphere(self, c: Node, u: Node) -> None:
        """u = w^2 = (1 + c) / 2."""
        graph = self.graph
        smallest = graph.mul(self.number(4), self.square(graph.node("eps")))
        self.on_cut = self.named("on_cut_locus", graph.node("less_equal", u, smallest))
        u = self.named("u", graph.select(self.on_cut, self.number(1), u))
        w = self.named("w", graph.function("sqrt", u))
        gap = graph.sub(self.number(1), w)
        eta, eta_slope = self.near(gap, False)
        over_A = graph.sub(w, graph.mul(graph.sub(self.number(1), u), eta))
        self.of_root(c, w, over_A, eta, eta_slope)

    def of_hyperboloid(self, c: Node, negative_u: Node) -> None:
        """u = w^2 - 1 = (c - 1) / 2; A by its polynomial near w = 1, else by the logarithm that acosh is."""
        graph, one = self.graph, self.number(1)
        u = graph.neg(negative_u)
        u = self.named("u", graph.select(graph.node("less", u, self.number(0)), self.number(0), u))  # -0 by rounding
        w = self.named("w", graph.function("sqrt", graph.add(one, u)))
        near = self.named("near", graph.node("less", w, self.number(NEAR)))
        gap = graph.select(near, graph.sub(w, one), self.number(0))
        near_eta, near_slope = self.near(graph.mul(self.number(1 / (NEAR - 1)), gap), True)
        far_u = graph.select(near, one, u)
        s = graph.function("sqrt", far_u)
        angle = self.named("half_angle", graph.function("log", graph.add(w, s)))
        angle_s = graph.mul(angle, s)
        both = graph.div(one, graph.mul(angle_s, far_u))  # one division for 1 / (angle s) and 1 / u
        over_angle_s, over_u = graph.mul(both, far_u), graph.mul(both, angle_s)
        far_eta = graph.sub(over_angle_s, graph.mul(w, over_u))
        # d far_eta / dw = -over_angle_s^2 - over_angle_s w / u + (w^2 + 1) / u^2
        far_slope = graph.sub(
            graph.mul(graph.add(graph.add(one, one), far_u), self.square(over_u)),
            graph.mul(over_angle_s, graph.add(over_angle_s, graph.mul(w, over_u))),
        )
        eta = graph.select(near, near_eta, far_eta)
        eta_slope = graph.select(near, near_slope, far_slope)
        over_A = graph.select(near, graph.add(w, graph.mul(u, near_eta)), graph.mul(far_u, over_angle_s))
        self.of_root(c, w, over_A, eta, eta_slope)

    def near(self, t: Node, unbounded: bool) -> tuple[Node, Node]:
        """eta and its derivative in w by their polynomials."""
        graph = self.graph
        eta, slope = profile(unbounded)
        return self.named("eta", graph.polynomial(t, eta)), self.named("eta_slope", graph.polynomial(t, slope))

    def of_root(self, c: Node, w: Node, over_A: Node, eta: Node, eta_slope: Node) -> None:
        """a = A / w and w = sqrt((1 + c) / 2), with one division for 1 / w and 1 / (A w)."""
        graph = self.graph
        a = self.named("a", graph.div(self.number(1), graph.mul(w, over_A)))
        over_w = self.named("over_w", graph.mul(over_A, a))
        w_of_c = graph.declared(w, c)
        over_w_of_c = graph.declared(over_w, w_of_c)
        graph.slopes[w_of_c] = graph.mul(self.number(sp.Rational(1, 4)), over_w_of_c)
        graph.slopes[over_w_of_c] = graph.neg(self.square(over_w_of_c))
        self.declare(w_of_c, a, eta, eta_slope, over_w_of_c)

    def declare(self, w: Node, a: Node, eta: Node, eta_slope: Node, over_w: Node | None) -> None:
        """What the derivatives of a and of log a in w are."""
        graph = self.graph
        eta_of_w = graph.declared(eta, w)
        graph.slopes[eta_of_w] = eta_slope
        slope = graph.sub(eta_of_w, over_w) if over_w else eta_of_w
        self.a, self.log_a = graph.declared(a, w), graph.declared(self.number(0), w)
        graph.slopes[self.log_a] = slope
        graph.slopes[self.a] = graph.mul(self.a, slope)
