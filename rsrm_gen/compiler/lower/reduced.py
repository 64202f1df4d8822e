"""The splat in the form in which sums of many are cheapest: on quadrics of constant curvature, see `derive.radial`.

There a pair is d + 1 dot products of the point with rows that belong to the splat, and functions of one number: with
w = sqrt((1 + c) / 2), c = <mu, x>, and eta = d log A / dw, which is one polynomial,

    1 / A = w - (1 - w^2) eta,   a = A / w,   d log a / dw = eta - 1 / w,   z = a R x,   R = W (tangent part at mu).

The factors 2 of it are gone into the rows: the point counts by its half h = x / 2, the centre by M = mu / 2, so that
w^2 = <h + M, h + M> and dw = d<M, h> / w; and the rows of R by their double, so that z = a r, r = R h.

In a product every factor has its own form, or the author's formulas. The routines of single splats keep those.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import sympy as sp

from rsrm_gen.compiler.derive import Geometry
from rsrm_gen.compiler.derive.geometry import Radial
from rsrm_gen.compiler.derive.radial import NEAR, profile
from rsrm_gen.compiler.lower.differentiate import gradient
from rsrm_gen.compiler.lower.from_sympy import inline
from rsrm_gen.compiler.lower.ir import Graph, Node, Packed, dot
from rsrm_gen.compiler.lower.pairs import SplatNodes
from rsrm_gen.compiler.lower.quadratic import HALF, half_square, pays, quadratic
from rsrm_gen.compiler.spec import ProductSpec

# What is said of a pair's function in generated code.
FORMULA = """h = x / 2, M = mu / 2 (x and mu where x and -x are one point)
w = cos(t / 2), or cosh, of the distance t: w^2 = <h + M, h + M>, or w = |<M, h>| where x and -x are one point
eta = d log A / dw, 1 / A = w - (1 - w^2) eta, a = A / w (A where x and -x are one point)
Log_mu(x) = a (tangent part of x), |det D Log_mu(x)| = a^k
"""
ALONE = "r = R h = W (tangent part of x), phi = amplitude a^k exp(-a^2 |r|^2 / 2)"
SEVERAL_PARTS = "r = R h = W (tangent part of x), z = a r + what other factors add, phi = amplitude a^k exp(-|z|^2 / 2)"


@dataclass(frozen=True)
class Part:
    """A factor that is no product: where its entries begin in points and in tangent vectors."""

    geometry: Geometry
    point: int
    tangent: int
    prefix: str


def parts(geometry: Geometry, point: int = 0, tangent: int = 0, prefix: str = "") -> Iterator[Part]:
    """The factors of a manifold, and theirs, that are no products; or itself."""
    spec = geometry.spec
    if not isinstance(spec, ProductSpec):
        yield Part(geometry, point, tangent, prefix)
        return
    known = {factor.spec.content_hash: factor for _, factor in geometry.factors}
    for factor in spec.factors:
        yield from parts(known[factor.spec.content_hash], point, tangent, f"{prefix}{factor.name}_")
        point, tangent = point + factor.spec.point_size, tangent + factor.spec.tangent_size


def reduced(geometry: Geometry, splat: SplatNodes, graph: Graph) -> SplatNodes | None:
    """The same splat in the reduced form; None where no part of the manifold has one."""
    found = list(parts(geometry))
    if not any(part.geometry.radial for part in found):
        return None
    far_out = any(part.geometry.radial and part.geometry.radial.unbounded for part in found)
    form = _Form(graph, splat, geometry.spec.dim, geometry.spec.tangent_size, len(found) == 1, far_out)
    for part in found:
        if part.geometry.radial:
            form.add_radial(part, part.geometry.radial)
        else:
            form.add_plain(part)
    return form.splat_nodes()


class _Form:
    """Gathers what the parts of a manifold give to z = W Log_mu(x), to log |det D Log| and to the splat."""

    def __init__(
        self, graph: Graph, splat: SplatNodes, dim: int, tangent_size: int, alone: bool, far_out: bool
    ) -> None:
        self.graph = graph
        self.splat = splat
        self.dim = dim
        self.tangent_size = tangent_size
        self.far_out = far_out  # whether a part reaches far out in its coordinates
        self.alone = alone  # whether there is one part only
        self.half: Node = graph.constant(0)  # |z|^2 / 2, of the only part
        self.z: list[Packed] = []  # what each part adds to z, of several
        self.rows_of: list[list[Packed]] = []  # what of W, or R, each of several parts is multiplied by,
        self.columns_of: list[Packed] = []  # and what it multiplies, so that both give z
        self.log_dets: list[Node] = []
        self.factors: list[Node] = []  # the determinants of radial parts, which are powers
        self.exponents: list[Node] = []  # the logarithms of the others
        self.at_cut: list[
            tuple[Node, Node]
        ] = []  # whether a point is on a splat's cut locus, and the splat's value there

    def covector(self, i: int, part: Part) -> Packed:
        """The entries of a row of W that belong to a part."""
        start = i * self.tangent_size + part.tangent
        return self.splat.W.nodes[start : start + part.geometry.spec.tangent_size]

    def points(self, part: Part) -> tuple[Packed, Packed]:
        """Its entries of mu and x."""
        place = slice(part.point, part.point + part.geometry.spec.point_size)
        return self.splat.mu.nodes[place], self.splat.x.nodes[place]

    def add_plain(self, part: Part) -> None:
        """A part by the author's Log and its determinant."""
        graph, (mu, x) = self.graph, self.points(part)
        v = inline(graph, part.geometry["log"], mu, x, prefix=part.prefix)
        (log_det,) = inline(graph, part.geometry["log_abs_det"], mu, x, prefix=part.prefix)
        rows = [self.covector(i, part) for i in range(self.dim)]
        self.z.append(tuple(dot(graph, row, v) for row in rows))
        self.rows_of.append(rows)
        self.columns_of.append(tuple(v))
        self.log_dets.append(log_det)
        self.exponents.append(log_det)

    def add_radial(self, part: Part, radial: Radial) -> None:
        """A part in the radial form."""
        graph, (mu, x) = self.graph, self.points(part)
        shape = _Profile(graph, radial, part.prefix, mu, x)
        R, h = self.rows(part, radial), shape.h
        r = [graph.named(f"{part.prefix}r{i}", dot(graph, row, h)) for i, row in enumerate(R)]
        if self.alone:
            half = quadratic(graph, R, h) if self.by_matrix(len(h)) else half_square(graph, r)
            self.half = shape.times_square(half, dot(graph, r, r))
        else:
            self.z.append(tuple(graph.mul(shape.signed_a, e) for e in r))
            self.rows_of.append(R)
            self.columns_of.append(tuple(graph.mul(shape.signed_a, c) for c in h))
        self.log_dets.append(graph.mul(graph.constant(radial.power), shape.log_a))
        self.factors += [shape.a] * radial.power
        if shape.on_cut is not None:
            self.at_cut.append((shape.on_cut, self.value_at_cut(part, mu)))

    def rows(self, part: Part, radial: Radial) -> list[Packed]:
        """R, with R h = W (tangent part of x): covectors at the part's centre, or twice that."""
        graph, (mu, _) = self.graph, self.points(part)
        vector = tuple(graph.input(f"{part.prefix}vector{j}") for j in range(len(mu)))
        tangent = inline(graph, part.geometry["to_tangent"], mu, vector, prefix=part.prefix)
        rows = []
        for i in range(self.dim):
            # The covector of a vector's tangent part; by the adjoint of the map, whose matrix loses digits far out.
            row = gradient(graph, dot(graph, self.covector(i, part), tangent), vector)
            if not radial.folded:  # a sum, because 2 and the 1 / 2 of h would cancel, and points count by both x and h
                row = tuple(graph.add(e, e) for e in row)
            rows.append(tuple(graph.named(f"{part.prefix}R{i}_{j}", e) for j, e in enumerate(row)))
        return rows

    def value_at_cut(self, part: Part, mu: Packed) -> Node:
        """exp(log det - |z|^2 / 2) at the antipode of mu, by the author's policy: the splat's own number."""
        graph = self.graph
        antipode = tuple(map(graph.neg, mu))
        v = inline(graph, part.geometry["log"], mu, antipode)
        (log_det,) = inline(graph, part.geometry["log_abs_det"], mu, antipode)
        z = [dot(graph, self.covector(i, part), v) for i in range(self.dim)]
        exponent = graph.sub(log_det, graph.mul(graph.constant(HALF), dot(graph, z, z)))
        return graph.named(f"{part.prefix}value_on_cut_locus", graph.function("exp", exponent))

    def by_matrix(self, columns: int) -> bool:
        """Whether sums are by R^T R: not with hyperboloids, far out on which R is large, and its square loses digits."""
        return pays(self.dim, columns) and not self.far_out

    def half_square(self) -> Node:
        """|z|^2 / 2, z the sum of what the parts add."""
        graph = self.graph
        if self.alone:
            return self.half
        v = tuple(c for columns in self.columns_of for c in columns)
        if self.by_matrix(len(v)):
            rows = [tuple(c for part in parts for c in part) for parts in zip(*self.rows_of, strict=True)]
            return quadratic(graph, rows, v)
        z = []
        for i, (first, *others) in enumerate(zip(*self.z, strict=True)):
            for other in others:
                first = graph.add(first, other)
            z.append(graph.named(f"z{i}", first))
        return half_square(graph, z)

    def splat_nodes(self) -> SplatNodes:
        """phi, the exponent whose derivatives give phi's, and the factor between them."""
        graph = self.graph
        exponent = inside = graph.neg(self.half_square())
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
        graph.slopes[value] = graph.slopes[slope] = (slope,)
        amplitude = self.splat.amplitude.nodes[0]
        phi = graph.named("phi", graph.mul(amplitude, value))
        by_exponent = graph.mul(amplitude, slope)
        formula = FORMULA + (ALONE if self.alone else SEVERAL_PARTS)
        return replace(self.splat, phi=phi, exponent=exponent, by_exponent=by_exponent, formula=formula)


class _Profile:
    """a and log a as functions of c = <mu, x>, and where the cut locus is; `log_a` is good for its derivatives only."""

    def __init__(self, graph: Graph, radial: Radial, prefix: str, mu: Packed, x: Packed) -> None:
        self.graph = graph
        self.prefix = prefix
        self.on_cut: Node | None = None
        self.form = [[graph.constant(f) for f in row] for row in radial.form]
        scale = graph.constant(1 if radial.folded else HALF)
        M = tuple(self.named(f"M{j}", graph.mul(scale, c)) for j, c in enumerate(mu))
        self.h = h = tuple(self.named(f"h{j}", graph.mul(scale, c)) for j, c in enumerate(x))
        product = dot(graph, self.image(M), h)  # c / 4, or c where it is folded
        if radial.folded:
            self.of_folded(product)
        elif radial.unbounded:
            self.of_hyperboloid(product, self.square_norm(tuple(map(graph.sub, h, M))))
        else:
            self.of_sphere(product, self.square_norm(tuple(map(graph.add, h, M))))

    def named(self, name: str, node: Node) -> Node:
        """A node under a name of the part."""
        return self.graph.named(f"{self.prefix}{name}", node)

    def number(self, x: sp.Expr | int) -> Node:
        return self.graph.constant(x)

    def square(self, x: Node) -> Node:
        return self.graph.mul(x, x)

    def image(self, x: Packed) -> Packed:
        """The row y with y . z = <x, z>."""
        return tuple(dot(self.graph, x, column) for column in zip(*self.form, strict=True))

    def square_norm(self, x: Packed) -> Node:
        """<x, x>: of h + M it is (1 + c) / 2, of h - M (1 - c) / 2, without the cancellation in 1 +- c."""
        return dot(self.graph, self.image(x), x)

    def of_folded(self, c: Node) -> None:
        """a = sign(c) A(|c|); its sign changes what it adds to z, not the length of that."""
        graph = self.graph
        w = self.named("w", graph.function("abs", c))
        eta, eta_slope = self.near(graph.sub(self.number(1), w), False)
        over_A = graph.sub(w, graph.mul(graph.sub(self.number(1), self.square(w)), eta))
        self.declare(w, graph.div(self.number(1), over_A), eta, eta_slope, None)
        a = self.a.arguments[0]
        negative = graph.node("less", c, self.number(0))
        self.signed_a = graph.declared(graph.select(negative, graph.neg(a), a), self.log_a)
        graph.slopes[self.signed_a] = (self.signed_a,)

    def of_sphere(self, quarter_c: Node, u: Node) -> None:
        """u = w^2 = (1 + c) / 2."""
        graph = self.graph
        smallest = graph.mul(self.number(4), self.square(graph.node("eps")))
        self.on_cut = self.named("on_cut_locus", graph.node("less_equal", u, smallest))
        u = self.named("u", graph.select(self.on_cut, self.number(1), u))
        w = self.named("w", graph.function("sqrt", u))
        eta, eta_slope = self.near(graph.sub(self.number(1), w), False)
        over_A = graph.sub(w, graph.mul(graph.sub(self.number(1), u), eta))
        self.of_root(quarter_c, w, over_A, eta, eta_slope)

    def of_hyperboloid(self, quarter_c: Node, negative_u: Node) -> None:
        """u = w^2 - 1 = (c - 1) / 2; A by its polynomial near w = 1, else by the logarithm that acosh is."""
        graph, one = self.graph, self.number(1)
        u = graph.neg(negative_u)
        u = self.named(
            "u", graph.select(graph.node("less", u, self.number(0)), self.number(0), u)
        )  # below 0 by rounding
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
        over_A = graph.add(w, graph.mul(u, eta))  # far away too, where it is s / angle
        self.of_root(quarter_c, w, over_A, eta, eta_slope)

    def near(self, t: Node, unbounded: bool) -> tuple[Node, Node]:
        """eta and its derivative in w by their polynomials."""
        graph = self.graph
        eta, slope = profile(unbounded)
        return self.named("eta", graph.polynomial(t, eta)), self.named("eta_slope", graph.polynomial(t, slope))

    def of_root(self, quarter_c: Node, w: Node, over_A: Node, eta: Node, eta_slope: Node) -> None:
        """a = A / w and w = sqrt((1 + c) / 2), with one division for 1 / w and 1 / (A w)."""
        graph = self.graph
        a = graph.div(self.number(1), graph.mul(w, over_A))
        over_w = self.named("over_w", graph.mul(over_A, a))
        w = graph.declared(w, quarter_c)
        over_w = graph.declared(over_w, w)
        graph.slopes[w] = (over_w,)
        graph.slopes[over_w] = (graph.neg(self.square(over_w)),)
        self.declare(w, a, eta, eta_slope, over_w)

    def declare(self, w: Node, a: Node, eta: Node, eta_slope: Node, over_w: Node | None) -> None:
        """What the derivatives are of log a in w, and of a and a^2 in log a."""
        graph = self.graph
        eta = graph.declared(eta, w)
        graph.slopes[eta] = (eta_slope,)
        a = self.named("a", a)
        self.log_a = graph.declared(self.number(0), w)
        graph.slopes[self.log_a] = (graph.sub(eta, over_w) if over_w else eta,)
        self.a = graph.declared(a, self.log_a)
        graph.slopes[self.a] = (self.a,)
        self.signed_a = self.a
        self.a_squared = graph.declared(self.named("a_squared", self.square(a)), self.log_a)
        graph.slopes[self.a_squared] = (graph.mul(self.number(2), self.a_squared),)

    def times_square(self, half: Node, square: Node) -> Node:
        """a^2 times half a square that does not depend on a: as p = s / 2, dp = s d log a + a^2 d half."""
        graph = self.graph
        whole = self.named("square", graph.mul(self.a_squared.arguments[0], square))
        product = graph.declared(graph.mul(self.number(HALF), whole), self.log_a, half)
        s = graph.declared(whole, product)
        graph.slopes[s] = (self.number(2),)
        graph.slopes[product] = (s, self.a_squared)
        return product
