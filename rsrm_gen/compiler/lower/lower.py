"""Every function of a geometry as a routine, and the splat with its gradient."""

from __future__ import annotations

from dataclasses import replace

import sympy as sp

from rsrm_gen.compiler.derive import Geometry
from rsrm_gen.compiler.derive.geometry import Function
from rsrm_gen.compiler.lower.culling import culling
from rsrm_gen.compiler.lower.differentiate import gradient
from rsrm_gen.compiler.lower.from_sympy import inline
from rsrm_gen.compiler.lower.ir import Graph, Node, Packed, Pairs, Parameter, Program, Result, Routine, dot
from rsrm_gen.compiler.lower.pairs import SplatNodes, pairs_of
from rsrm_gen.compiler.lower.quadratic import pays, quadratic
from rsrm_gen.compiler.lower.reduced import reduced
from rsrm_gen.compiler.lower.schedule import schedule
from rsrm_gen.compiler.spec.vocabulary import Shape

RESULT_NAMES = {
    "project": "p",
    "exp": "q",
    "log": "v",
    "to_tangent": "v",
    "flat": "covector",
    "riemannian_gradient": "gradient",
    "transport": "w",
    "other_name": "q",
    "sample": "p",
}


def lower(geometry: Geometry) -> Program:
    """The program of a manifold: the functions of the `Manifold` protocol, one routine each."""
    routines = [routine_of(function) for function in geometry]
    splat = _Splat(geometry)
    return Program(
        geometry.spec.identifier, (*routines, splat.routine(), splat.vjp()), splat.pairs(), culling(geometry)
    )


def routine_of(function: Function) -> Routine:
    """One function of a geometry as a routine."""
    graph = Graph()
    parameters = tuple(_parameter(graph, a.name, a.shape, tuple(map(str, a.symbols))) for a in function.arguments)
    nodes = inline(graph, function, *(p.nodes for p in parameters))
    name = RESULT_NAMES.get(function.name, function.name)
    result = Result(name, function.shape, _named(graph, name, nodes) if function.shape else nodes)
    return schedule(graph, function.name, parameters, (result,), function.formula)


class _Splat:
    """phi = amplitude exp(log |det D Log_mu(x)| - |W Log_mu(x)|^2 / 2) and its Riemannian gradient in x (RSRM eq. 3)."""

    formula = "amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)|"

    def __init__(self, geometry: Geometry) -> None:
        spec = geometry.spec
        self.size = spec.tangent_size
        self.graph = graph = Graph()
        self.x, self.mu = _vector(graph, "x", spec.point_size), _vector(graph, "mu", spec.point_size)
        self.W = _matrix(graph, "W", spec.dim, self.size)
        self.amplitude = _parameter(graph, "amplitude", (), ("amplitude",))
        log = _named(graph, "v", inline(graph, geometry["log"], self.mu.nodes, self.x.nodes))
        (log_det,) = inline(graph, geometry["log_abs_det"], self.mu.nodes, self.x.nodes)
        rows = [self.W.nodes[i * self.size : (i + 1) * self.size] for i in range(spec.dim)]
        z = _named(graph, "z", tuple(dot(graph, row, log) for row in rows))
        exponent = graph.sub(log_det, graph.mul(graph.constant(sp.Rational(1, 2)), dot(graph, z, z)))
        self.exponent, self.geometry = exponent, geometry
        self.rows, self.log, self.log_det = rows, log, log_det
        self.value = graph.named("phi", graph.mul(self.amplitude.nodes[0], graph.function("exp", exponent)))
        partials = _named(graph, "exponent_by_x", gradient(graph, exponent, self.x.nodes))
        df = _named(graph, "df", tuple(graph.mul(self.value, partial) for partial in partials))
        slope = inline(graph, geometry["riemannian_gradient"], self.x.nodes, df)
        self.gradient = _named(graph, "gradient", slope)

    def routine(self) -> Routine:
        """The value and the gradient."""
        results = Result("value", (), (self.value,)), Result("gradient", (self.size,), self.gradient)
        return schedule(self.graph, "splat", (self.x, self.mu, self.W, self.amplitude), results, self.formula)

    def pairs(self) -> Pairs:
        """The splat split for sums over many points and splats: in the author's formulas or reduced, whichever is less work."""
        plain = SplatNodes(self.x, self.mu, self.W, self.amplitude, self.value, self.exponent, self.value)

        def to_gradient(graph: Graph, x: Packed, df: Packed) -> Packed:
            return inline(graph, self.geometry["riemannian_gradient"], x, df)

        forms = [plain, self.by_matrix(plain), reduced(self.geometry, plain, self.graph)]
        return min((pairs_of(self.graph, form, to_gradient) for form in forms if form), key=lambda pairs: pairs.work)

    def by_matrix(self, plain: SplatNodes) -> SplatNodes | None:
        """The same splat as a function of W^T W, where that has fewer entries than W.

        Not of ambient vectors, whose entries may be much larger than they are long: there W^T W loses digits.
        """
        graph = self.graph
        if self.size > len(self.rows) or not pays(len(self.rows), self.size):
            return None
        exponent = graph.sub(self.log_det, quadratic(graph, self.rows, self.log))
        phi = graph.named("phi", graph.mul(self.amplitude.nodes[0], graph.function("exp", exponent)))
        return replace(plain, phi=phi, exponent=exponent, by_exponent=phi)

    def vjp(self) -> Routine:
        """The derivatives of <value, value_bar> + <gradient, gradient_bar> in mu, W and amplitude."""
        graph = self.graph
        value_bar = _parameter(graph, "value_bar", (), ("value_bar",))
        gradient_bar = _vector(graph, "gradient_bar", self.size)
        total = dot(graph, (self.value, *self.gradient), (*value_bar.nodes, *gradient_bar.nodes))
        parameters = (self.mu, self.W, self.amplitude)
        adjoints = iter(gradient(graph, total, [node for p in parameters for node in p.nodes]))
        results = tuple(Result(f"{p.name}_bar", p.shape, tuple(next(adjoints) for _ in p.nodes)) for p in parameters)
        inputs = (self.x, *parameters, value_bar, gradient_bar)
        return schedule(graph, "splat_vjp", inputs, results, "d (value value_bar + gradient . gradient_bar)")


def _named(graph: Graph, name: str, nodes: tuple[Node, ...]) -> tuple[Node, ...]:
    return tuple(graph.named(f"{name}{i}", node) for i, node in enumerate(nodes))


def _vector(graph: Graph, name: str, size: int) -> Parameter:
    return _parameter(graph, name, (size,), tuple(f"{name}{i}" for i in range(size)))


def _matrix(graph: Graph, name: str, rows: int, columns: int) -> Parameter:
    return _parameter(
        graph, name, (rows, columns), tuple(f"{name}{i}_{j}" for i in range(rows) for j in range(columns))
    )


def _parameter(graph: Graph, name: str, shape: Shape, entries: tuple[str, ...]) -> Parameter:
    return Parameter(name, shape, tuple(graph.input(entry) for entry in entries))
