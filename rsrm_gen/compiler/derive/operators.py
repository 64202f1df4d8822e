"""Linear algebra of the tangent spaces: metric, musical isomorphism, tangent projection, Riemannian gradient.

With the ambient or chart metric G and constraints c(p) = 0, the normals are G^-1 dc, and the tangential part of a vector
x is x - N (dc N)^-1 dc x. A gradient is G^-1 df, made tangential.
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import cached_property
from typing import Any

import mpmath as mp
import sympy as sp

from rsrm_gen.compiler.derive.bounds import Sizes, inverse, may_be_expanded
from rsrm_gen.compiler.derive.geometry import Argument, Function, argument
from rsrm_gen.compiler.derive.numeric import DIGITS, TINY, determinant, run, value
from rsrm_gen.compiler.derive.scalarise import Reading, scalarised
from rsrm_gen.compiler.derive.trace import Trace
from rsrm_gen.compiler.spec import ManifoldSpec
from rsrm_gen.errors import Span, UserError


class Operators:
    """The operators of one spec, as sympy matrices in the symbols of p."""

    def __init__(self, spec: ManifoldSpec, points: Sequence[Sequence[Any]]) -> None:
        """`points` are some points of the manifold in high precision, to see what is constant on it."""
        self.spec = spec
        self.p = argument("p", spec.point_size)
        self.points = [dict(zip(self.p.symbols, point, strict=True)) for point in points]
        self.metric = self.read_metric()
        self.frame = self.read_frame()  # rows: the vectors that tangent components multiply
        self.check_frame()
        self.constraint_jacobian = self.read_constraint_jacobian()  # (constraints, D)
        self.check_metric()
        self.check_normals_and_frame()
        self.metric_inverse = _inverse(self.metric, spec.metric.value.span)

    def read_metric(self) -> sp.Matrix:
        spec, size = self.spec, self.spec.tangent_size
        if spec.metric.value.shape:
            trace = Trace([self.p])
            entries = Reading(spec, trace).entries(spec.metric)
            return sp.Matrix(size, size, [trace.unfolded(e, spec.metric.value.span) for e in entries])
        unit = sp.eye(size)
        return sp.Matrix(size, size, lambda i, j: self.metric_of(unit.row(i), unit.row(j)))

    def check_metric(self) -> None:
        """Refuse a formula that is not bilinear, or a matrix that is not symmetric or not invertible."""
        spec, span = self.spec, self.spec.metric.value.span
        rng = random.Random(3)
        size = spec.tangent_size
        for point in self.points:
            with mp.workdps(DIGITS):
                u, v = (mp.matrix([mp.mpf(rng.gauss(0, 1)) for _ in range(size)]) for _ in range(2))
                G = mp.matrix([[value(self.metric[i, j], point) for j in range(size)] for i in range(size)])
                if not all(mp.isfinite(x) for x in G):
                    raise UserError("the metric is no finite real number at some points", span)
                if not abs(determinant(G)) > TINY:
                    raise UserError(
                        "the metric has no inverse", span, "<u, v> must not vanish for all v, except at u = 0"
                    )
                if mp.norm(G - G.T) > TINY:
                    raise UserError("the metric is not symmetric: <u, v> and <v, u> differ", span)
                if not spec.metric.value.shape and abs(self.inner_value(point, u, v) - (u.T * G * v)[0]) > TINY:
                    raise UserError("the metric is not linear in u and in v", span)

    def check_normals_and_frame(self) -> None:
        """Refuse constraints and frames whose rows are not of full rank."""
        spec = self.spec
        for matrix, chart_map, complaint in (
            (
                self.constraint_jacobian,
                spec.constraint,
                "the derivatives of `constraint` vanish, or depend on one another",
            ),
            (self.frame, spec.frame, "the vectors of `frame` depend on one another"),
        ):
            for point in self.points if chart_map is not None else ():
                with mp.workdps(DIGITS):
                    rows = mp.matrix([[value(x, point) for x in matrix.row(i)] for i in range(matrix.rows)])
                    if chart_map is not None and not abs(determinant(rows * rows.T)) > TINY:
                        raise UserError(f"{complaint} at points of the manifold", chart_map.value.span)

    def inner_value(self, point: Mapping[sp.Symbol, Any], u: Sequence[Any], v: Sequence[Any]) -> Any:
        """The author's <u, v>_p in high precision."""
        inner = self.inner()
        values = dict(point)
        for declared, given in zip(inner.arguments[1:], (u, v), strict=True):
            values.update(zip(declared.symbols, given, strict=True))
        return value(inner.results[0], values)

    def metric_of(self, u: sp.Matrix, v: sp.Matrix) -> sp.Expr:
        """<u, v>_p from the author's formula."""
        size = self.spec.tangent_size
        trace = Trace([self.p, Argument("u", (size,), tuple(u)), Argument("v", (size,), tuple(v))])
        return trace.unfolded(Reading(self.spec, trace).entries(self.spec.metric)[0], self.spec.metric.value.span)

    def read_frame(self) -> sp.Matrix:
        spec = self.spec
        if spec.frame is None:
            return sp.eye(spec.point_size)
        trace = Trace([self.p])
        span = spec.frame.value.span
        return self.frame_vectors(trace).applyfunc(lambda e: trace.unfolded(e, span))

    def frame_vectors(self, trace: Trace) -> sp.Matrix:
        """The vectors of the frame as rows, in the assignments of a trace: what the author's formula is for unit vectors."""
        spec, size = self.spec, self.spec.tangent_size
        assert spec.frame is not None
        rows = []
        for i in range(size):
            trace.arguments["v"] = Argument("v", (size,), tuple(sp.eye(size).row(i)))
            rows.append(Reading(spec, trace).entries(spec.frame))
        del trace.arguments["v"]
        return sp.Matrix(size, spec.point_size, [e for row in rows for e in row])

    def check_frame(self) -> None:
        """Refuse a formula that is not linear in v, or vectors that are not independent."""
        spec, rng = self.spec, random.Random(4)
        if spec.frame is None:
            return
        formula = scalarised(spec, "frame", spec.frame, (self.p, argument("v", spec.tangent_size)), spec.point_shape)
        with mp.workdps(DIGITS):
            for point, vectors in zip(self.points, self.frame_values, strict=True):
                v = [mp.mpf(rng.gauss(0, 1)) for _ in range(spec.tangent_size)]
                found = mp.matrix(run(formula, list(point.values()), v)[0])
                if not all(mp.isfinite(x) for x in (*found, *vectors)):
                    raise UserError("`frame` has no value at a point of the manifold", spec.frame.value.span)
                if mp.norm(found - vectors.T * mp.matrix(v)) > TINY * mp.norm(vectors):
                    raise UserError("`frame` is not linear in v", spec.frame.value.span)
                if abs(determinant(vectors * vectors.T)) < TINY:
                    raise UserError("the vectors of `frame` are not independent", spec.frame.value.span)

    @cached_property
    def frame_values(self) -> list[Any]:
        """The frame at every one of the points, in high precision."""
        frame = self.frame
        with mp.workdps(DIGITS):
            return [
                mp.matrix([[value(frame[i, j], point) for j in range(frame.cols)] for i in range(frame.rows)])
                for point in self.points
            ]

    def read_constraint_jacobian(self) -> sp.Matrix:
        if self.spec.constraint is None:
            return sp.zeros(0, self.spec.point_size)
        trace, span = Trace([self.p]), self.spec.constraint.value.span
        entries = Reading(self.spec, trace).entries(self.spec.constraint)
        jacobian = sp.Matrix([trace.unfolded(e, span) for e in entries]).jacobian(self.p.symbols)
        # A constraint and its half have the same normals: 2 p and p on the sphere.
        contents = [sp.gcd_list([e.as_coeff_Mul()[0] for e in jacobian.row(i) if e != 0]) for i in range(jacobian.rows)]
        return sp.Matrix(*jacobian.shape, lambda i, j: jacobian[i, j] / (contents[i] or 1))

    def on_manifold(self, matrix: sp.Matrix) -> sp.Matrix:
        """The matrix with those entries as numbers that are constant on the manifold, like p . p on the sphere."""

        def constant(entry: sp.Expr) -> sp.Expr:
            values = [value(entry, point) for point in self.points] if entry.free_symbols else []
            if not values or not mp.isfinite(values[0]):
                return entry
            simple = Fraction(mp.nstr(values[0], 20)).limit_denominator(64)
            with mp.workdps(DIGITS):
                same = all(abs(x - mp.mpf(simple.numerator) / simple.denominator) < TINY for x in values)
            return sp.Rational(simple.numerator, simple.denominator) if same else entry

        return matrix.applyfunc(constant)

    def normals(self) -> sp.Matrix:
        """The normal vectors as columns, not of unit length (ambient tangents only)."""
        return self.metric_inverse * self.constraint_jacobian.T

    def tangential(self, x: sp.Matrix, trace: Trace) -> sp.Matrix:
        """The tangential part of an ambient vector (ambient tangents only)."""
        normals, jacobian = self.normals(), self.constraint_jacobian
        assert self.spec.constraint is not None
        span = self.spec.constraint.value.span
        parts = _inverse(self.on_manifold(jacobian * normals), span) * (jacobian * x)
        return x - normals * sp.Matrix(
            [trace.define(f"normal_part{i if len(parts) > 1 else ''}", e) for i, e in enumerate(parts)]
        )

    def to_tangent(self) -> Function:
        """The tangent part of an ambient vector; components in the frame are those of the nearest tangent vector."""
        x = argument("x", self.spec.point_size)
        vector, trace = sp.Matrix(x.symbols), Trace((self.p, x))
        if self.spec.frame is not None:
            result, formula = self.components(x.symbols, trace), "(E E^T)^-1 E x"
        elif self.spec.embedded:
            result, formula = self.tangential(vector, trace), "x - N (dc N)^-1 dc x"
        else:
            result, formula = vector, "x"
        return Function(
            "to_tangent", (self.p, x), tuple(trace.assignments), tuple(result), (self.spec.tangent_size,), formula
        )

    def components(self, x: Sequence[sp.Expr], trace: Trace) -> sp.Matrix:
        """The components in the frame of the tangent vector that is nearest to an ambient vector."""
        with mp.workdps(DIGITS):
            grams = [vectors * vectors.T for vectors in self.frame_values]
            constant = all(mp.norm(gram - grams[0]) < TINY for gram in grams)
        frame = self.frame_vectors(trace)
        if constant:
            assert self.spec.frame is not None
            return _inverse(self.on_manifold(frame * frame.T), self.spec.frame.value.span) * (frame * sp.Matrix(x))
        return _least_squares([list(frame.row(i)) for i in range(frame.rows)], list(x), trace)

    def inner(self) -> Function:
        """<u, v>_p as the author wrote it."""
        spec = self.spec
        u, v = argument("u", spec.tangent_size), argument("v", spec.tangent_size)
        formula = spec.metric.value.text
        if spec.metric.value.shape:
            result, formula = sp.Matrix(u.symbols).T * self.metric * sp.Matrix(v.symbols), "u^T G(p) v"
        else:
            result = sp.Matrix([self.metric_of(sp.Matrix(u.symbols).T, sp.Matrix(v.symbols).T)])
        return self.function("inner", (self.p, u, v), result, (), formula)

    def norm(self) -> Function:
        """|v|_p: the author's closed form, or sqrt(<v, v>_p)."""
        v = argument("v", self.spec.tangent_size)
        if self.spec.norm is not None:
            return scalarised(self.spec, "norm", self.spec.norm, (self.p, v), ())
        inner = self.inner()
        replaced = dict(zip(inner.arguments[1].symbols + inner.arguments[2].symbols, v.symbols * 2, strict=True))
        square = inner.results[0].xreplace(replaced)
        return self.function("norm", (self.p, v), sp.Matrix([sp.sqrt(square)]), (), "sqrt(<v, v>_p)")

    def length_of(self, vector: Sequence[sp.Expr], trace: Trace) -> sp.Expr:
        """The norm of a vector, in the assignments of a trace."""
        norm = self.norm()
        names = dict(zip(norm.arguments[1].symbols, vector, strict=True))
        for a in norm.assignments:
            names[a.symbol] = trace.define(str(a.symbol), a.expression.xreplace(names))
        return norm.results[0].xreplace(names)

    def flat(self) -> Function:
        """The covector <v, .>_p."""
        v = argument("v", self.spec.tangent_size)
        return self.function(
            "flat", (self.p, v), self.metric * sp.Matrix(v.symbols), (self.spec.tangent_size,), "G(p) v"
        )

    def riemannian_gradient(self) -> Function:
        """grad f from the partial derivatives df."""
        df = argument("df", self.spec.point_size)
        trace = Trace((self.p, df))
        result = tuple(self.gradient(df, trace))
        return Function(
            "riemannian_gradient",
            (self.p, df),
            tuple(trace.assignments),
            result,
            (self.spec.tangent_size,),
            self.gradient_formula(),
        )

    def gradient_norm(self) -> Function:
        """|grad f|_p from the partial derivatives df."""
        df = argument("df", self.spec.point_size)
        trace = Trace((self.p, df))
        gradient = [trace.define(f"gradient{i}", e) for i, e in enumerate(self.gradient(df, trace))]
        length = self.length_of(gradient, trace)
        return Function("gradient_norm", (self.p, df), tuple(trace.assignments), (length,), (), "|grad f|_p")

    def gradient(self, df: Argument, trace: Trace) -> sp.Matrix:
        """The entries of grad f."""
        partials = sp.Matrix(df.symbols)
        if self.spec.ambient_tangents:
            return self.tangential(self.metric_inverse * partials, trace)
        frame = self.frame_vectors(trace) if self.spec.frame is not None else self.frame
        return self.metric_inverse * (frame * partials)

    def gradient_formula(self) -> str:
        """How the gradient is made, for the generated documentation."""
        if self.spec.ambient_tangents:
            return "the tangential part of G^-1 df"
        return "G^-1 E df" if self.spec.frame else "G(p)^-1 df"

    @staticmethod
    def function(
        name: str, arguments: tuple[Argument, ...], entries: sp.Matrix, shape: tuple[int, ...], formula: str
    ) -> Function:
        """A function without assignments of its own."""
        return Function(name, arguments, (), tuple(entries), shape, formula)


def _least_squares(vectors: list[list[sp.Expr]], x: list[sp.Expr], trace: Trace) -> sp.Matrix:
    """The components v with sum v_k e_k nearest to x, by Gram and Schmidt, which lose fewer digits than (E E^T)^-1."""

    def dot(a: Sequence[sp.Expr], b: Sequence[sp.Expr]) -> sp.Expr:
        return sp.Add(*(s * t for s, t in zip(a, b, strict=True)))

    def less(name: str, a: list[sp.Expr], part: sp.Expr, b: list[sp.Expr]) -> list[sp.Expr]:
        return [trace.define(f"{name}_{i}", s - part * t) for i, (s, t) in enumerate(zip(a, b, strict=True))]

    parts: list[sp.Expr] = []
    upper: dict[tuple[int, int], sp.Expr] = {}
    left = [[trace.define(f"e{k}_{i}", c) for i, c in enumerate(e)] for k, e in enumerate(vectors)]
    for k, e in enumerate(left):
        square = trace.define(f"e{k}_squared", dot(e, e))
        parts.append(trace.define(f"part{k}", dot(e, x) / square))
        x = less("rest", x, parts[k], e)
        for j in range(k + 1, len(left)):
            upper[k, j] = trace.define(f"shear{k}_{j}", dot(e, left[j]) / square)
            left[j] = less(f"e{j}", left[j], upper[k, j], e)
    for k in reversed(range(len(left))):
        others = (upper[k, j] * parts[j] for j in range(k + 1, len(left)))
        parts[k] = trace.define(f"component{k}", sp.Add(parts[k], *(-other for other in others)))
    return sp.Matrix(parts)


def _inverse(matrix: sp.Matrix, span: Span) -> sp.Matrix:
    """The inverse, written out; simplified where that takes no time."""
    if matrix.is_diagonal():
        return sp.diag(*(1 / matrix[i, i] for i in range(matrix.rows)))
    written_out = inverse(matrix, span)
    Sizes().check(written_out, span)
    simplify = matrix.rows <= 4 and all(map(may_be_expanded, written_out))
    return written_out.applyfunc(sp.cancel) if simplify else written_out
