"""From a document to a `Spec`: every formula parsed, its names and shapes checked."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from fractions import Fraction
from pathlib import Path

from rsrm_gen.compiler.spec import formula as f
from rsrm_gen.compiler.spec.formulas import FormulaReader
from rsrm_gen.compiler.spec.model import CutLocus, Formula, ManifoldSpec, Map, Spec
from rsrm_gen.compiler.spec.product import ProductReader
from rsrm_gen.compiler.spec.schema import ManifoldFile, ProductFile
from rsrm_gen.compiler.spec.shapes import describe, integer
from rsrm_gen.compiler.spec.vocabulary import TRUTH, Shape
from rsrm_gen.document import Document, Path_, read_document, validate
from rsrm_gen.errors import UserError

MAX_DIM = 16


def read_spec(file: Path | Document, overrides: Mapping[str, int | float | str] | None = None) -> Spec:
    """Read a manifold file, with some of its parameters overridden; raises `UserError` for whatever is wrong."""
    return _read(file, dict(overrides or {}), ())


def _read(file: Path | Document, overrides: Mapping[str, int | float | str], inside: tuple[Path, ...]) -> Spec:
    """Read a file that is a factor `inside` the files of some products."""
    document = read_document(file) if isinstance(file, Path) else file
    if "product" in document.data:
        product = validate(document, ProductFile)
        return ProductReader(document, product, overrides, _read, inside).spec()
    schema = validate(document, ManifoldFile)
    _require_maps(document, schema)
    return _Reader(document, schema, overrides).spec()


def _require_maps(document: Document, schema: ManifoldFile) -> None:
    """A metric alone describes a manifold, but not one that this version compiles."""
    for key in ("exp", "log"):
        if getattr(schema, key) is None:
            raise UserError(
                f"a metric without `{key}:` is not compiled by this version: geodesics are not solved for",
                document.key_span((key,) if key in document.data else ("metric",)),
                f"add the closed form `{key}: ...`, or a retraction and its inverse with `maps: retraction`",
            )


class _Reader(FormulaReader):
    """Builds the spec of one manifold section by section."""

    schema: ManifoldFile

    def __init__(self, document: Document, schema: ManifoldFile, overrides: Mapping[str, int | float | str]) -> None:
        super().__init__(document, schema, overrides)
        self.read_constants(schema.let)
        space = schema.embedded or schema.chart
        assert space is not None
        self.kind = "embedded" if schema.embedded else "chart"
        self.point_shape = self.space_shape(space.space, (self.kind, "space"))
        self.point_size = math.prod(self.point_shape)
        self.sizes = dict.fromkeys(("p", "q", "normal", "uniform"), self.point_shape)
        self.set_tangents(self.point_shape)  # unless there is a frame
        self.constraint = self.read_constraint()
        self.frame = self.read_frame()
        self.tangent_size = math.prod(self.sizes["v"])

    def spec(self) -> ManifoldSpec:
        """The whole, in the order in which a reader of the file meets it."""
        schema = self.schema
        embedded = schema.embedded
        chart = schema.chart
        point, tangent, dim = self.point_shape, self.sizes["v"], self.read_dim()
        exp = self.map(schema.exp, ("exp",), ("p", "v"), point)
        log = self.map(schema.log, ("log",), ("p", "q"), tangent)
        return ManifoldSpec(
            name=schema.manifold,
            doc=schema.doc.strip(),
            symbols=self.read_symbols([exp, log]),
            parameters=tuple(self.parameters.items()),
            overridden=self.overridden,
            scale=self.length(schema.scale, ("scale",)),
            maps=schema.maps,
            point_shape=point,
            point_size=self.point_size,
            tangent_size=self.tangent_size,
            dim=dim,
            constraint=self.constraint,
            project=self.map(embedded.project, ("embedded", "project"), ("p",), point) if embedded else None,
            domain=self.optional((embedded or chart).domain, (self.kind, "domain"), ("p",), TRUTH),  # type: ignore[union-attr]
            equivalent=self.optional(embedded.equivalent, ("embedded", "equivalent"), ("p",), point)
            if embedded
            else None,
            periods=self.read_periods(),
            frame=self.frame,
            metric=self.read_metric(),
            exp=exp,
            log=log,
            norm=self.optional(schema.norm, ("norm",), ("p", "v"), (), exp),
            distance=self.optional(schema.distance, ("distance",), ("p", "q"), (), log),
            log_det=self.optional(schema.log_det, ("log_det",), ("p", "q"), (), log),
            transport=self.optional(schema.transport, ("transport",), ("p", "q", "v"), tangent, log),
            sample=self.optional(schema.sample, ("sample",), ("normal", "uniform"), point),
            injectivity_radius=self.length(schema.injectivity_radius, ("injectivity_radius",)),
            diameter=self.length(schema.diameter, ("diameter",)),
            cut_locus=self.read_cut_locus(log),
            source=self.document.source,
            content_hash=self.content_hash(),
        )

    def set_tangents(self, shape: Shape) -> None:
        """What tangent vectors are in formulas."""
        self.sizes |= {"u": shape, "v": shape}

    def space_shape(self, text: str, path: Path_) -> Shape:
        span = self.document.span(path)
        match = re.fullmatch(r"\s*R\s*\^\s*(?:\((.+)\sx\s(.+)\)|(.+?))\s*", text)
        if not match:
            raise UserError(f"`{text}` is not a space", span, "write R^3, R^n or R^(n+1); R^(n x n) for matrices")
        groups = [i for i in (1, 2, 3) if match[i]]
        shape = tuple(integer(f.parse(match[i], span.inner(match.start(i))), self.parameters) for i in groups)
        size = math.prod(shape)
        if not all(1 <= n <= 4 * MAX_DIM for n in (*shape, size)):
            raise UserError(f"a space of {size} dimensions; 1 to {4 * MAX_DIM} are compiled", span)
        if len(shape) == 2 and self.schema.embedded is None:
            raise UserError("the coordinates of a chart are a vector, not a matrix", span, f"write R^{size}")
        return shape

    def read_constraint(self) -> Map | None:
        if self.schema.embedded is None:
            return None
        constraint = self.map(self.schema.embedded.constraint, ("embedded", "constraint"), ("p",), None)
        if len(constraint.value.shape) > 1:
            hint = "the independent entries are above(A), or upper(A) with the diagonal"
            raise UserError("a constraint is a scalar or a vector of them, not a matrix", constraint.value.span, hint)
        return constraint

    @property
    def free(self) -> int:
        """Entries of a point less constraints: the dimension."""
        constraints = 0 if self.constraint is None else (self.constraint.value.shape or (1,))[0]
        return self.point_size - constraints

    def read_dim(self) -> int:
        dim = self.free
        if not 1 <= dim <= MAX_DIM:
            raise UserError(
                f"a manifold of {dim} dimensions; 1 to {MAX_DIM} are compiled", self.document.span((self.kind, "space"))
            )
        if self.frame is not None and self.tangent_size != dim:
            raise UserError(
                f"the frame has {self.tangent_size} vectors, the manifold {dim} dimensions",
                self.document.key_span(("frame",)),
            )
        return dim

    def read_frame(self) -> Map | None:
        rows = self.schema.frame
        if rows is None:
            return None
        if self.schema.embedded is None:
            raise UserError(
                "a chart needs no frame: its tangent vectors are components already", self.document.key_span(("frame",))
            )
        if not isinstance(rows, list):
            self.set_tangents((max(self.free, 1),))
            return self.map(rows, ("frame",), ("p", "v"), self.point_shape)
        self.set_tangents((len(rows),))
        scope = {"p": self.point_shape, **{name: c.shape for name, c in self.constants}}
        formulas = [self.formula(text, ("frame", i), scope, self.point_shape) for i, text in enumerate(rows)]
        value = Formula("; ".join(rows), _combination(formulas), self.point_shape, formulas[0].span)
        return Map(("p", "v"), self.constants, value)

    def read_periods(self) -> tuple[Map | None, ...] | None:
        if self.schema.chart is None:
            return None
        period = self.schema.chart.period
        if isinstance(period, list):
            if len(period) != self.point_size:
                raise UserError(
                    f"{len(period)} periods for {self.point_size} coordinates", self.document.span(("chart", "period"))
                )
            return tuple(self.period(text, ("chart", "period", i)) for i, text in enumerate(period))
        return (self.period(period, ("chart", "period")),) * self.point_size

    def period(self, text: str | None, path: Path_) -> Map | None:
        """One coordinate's period, a positive number."""
        period = self.optional(text, path, (), ())
        if period is not None:
            self.check_positive(period, "period")
        return period

    def read_metric(self) -> Map:
        metric = self.map(self.schema.metric, ("metric",), ("p", "u", "v"), None)
        if metric.value.shape not in ((), (self.tangent_size, self.tangent_size)):
            raise UserError(
                f"a metric is a scalar in p, u, v or a {self.tangent_size} x {self.tangent_size} matrix in p, "
                f"this is {describe(metric.value.shape)}",
                metric.value.span,
            )
        if metric.value.shape:  # a matrix is a function of the point alone
            try:
                return self.map(self.schema.metric, ("metric",), ("p",), metric.value.shape)
            except UserError as error:
                said = f"a metric that is a matrix is a formula in p alone: {error.message}"
                raise UserError(said, error.span, "or write <u, v>_p as a scalar, like dot(u, v)") from None
        return metric

    def read_cut_locus(self, log: Map) -> CutLocus | None:
        section = self.schema.cut_locus
        if section is None:
            return None
        where = self.map(section.where, ("cut_locus", "where"), ("p", "q"), TRUTH, log)
        value = self.optional(section.log, ("cut_locus", "log"), ("p", "q"), self.sizes["v"], log)
        log_det = self.optional(section.log_det, ("cut_locus", "log_det"), ("p", "q"), (), log)
        return CutLocus(where, value, log_det)


def _combination(vectors: list[Formula]) -> f.Tree:
    """v[0] * e_0 + v[1] * e_1 + ..., the ambient vector of components in a list of vectors."""

    def term(i: int, vector: Formula) -> f.Tree:
        component = f.Index(f.Name("v", vector.span), f.Number(Fraction(i), vector.span), None, False, vector.span)
        return f.Binary("*", component, vector.tree, vector.span)

    total = term(0, vectors[0])
    for i, vector in enumerate(vectors[1:], start=1):
        total = f.Binary("+", total, term(i, vector), vector.span)
    return total
