"""From a document to a `ManifoldSpec`: every formula parsed, its names and shapes checked."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Mapping
from fractions import Fraction
from pathlib import Path

from rsrm_gen.compiler.spec import formula as f
from rsrm_gen.compiler.spec.model import CutLocus, Formula, ManifoldSpec, Map
from rsrm_gen.compiler.spec.schema import ManifoldFile
from rsrm_gen.compiler.spec.shapes import Scope, constant, describe, integer, shape_of
from rsrm_gen.compiler.spec.vocabulary import CONSTANTS, TRUTH, WORDS, Shape
from rsrm_gen.document import Document, Path_, read_document, validate
from rsrm_gen.errors import UserError, did_you_mean

MAX_DIM = 16
RESERVED = {"p", "q", "u", "v", "x", "mu", "W", "amplitude", "df", *CONSTANTS, *WORDS}


def read_spec(file: Path | Document, overrides: Mapping[str, int | float | str] | None = None) -> ManifoldSpec:
    """Read a manifold file, with some of its parameters overridden; raises `UserError` for whatever is wrong."""
    document = read_document(file) if isinstance(file, Path) else file
    _refuse_future_words(document)
    schema = validate(document, ManifoldFile)
    _require_maps(document, schema)
    return _Reader(document, schema, dict(overrides or {})).spec()


def _refuse_future_words(document: Document) -> None:
    """Words of the language that this version does not compile are named, not called unknown."""
    for key, what in {"product": "products of manifolds", "maps": "retractions", "scale": "scaled metrics"}.items():
        if key in document.data:
            raise UserError(f"{what} (`{key}:`) are not compiled by this version", document.key_span((key,)))


def _require_maps(document: Document, schema: ManifoldFile) -> None:
    """A metric alone describes a manifold, but not one that this version compiles."""
    for key in ("exp", "log"):
        if getattr(schema, key) is None:
            raise UserError(
                f"a metric without `{key}:` is not compiled by this version: geodesics are not solved for",
                document.key_span((key,) if key in document.data else ("metric",)),
                f"add the closed form `{key}: ...`",
            )


class _Reader:
    """Builds the spec section by section; knows the parameters and the sizes once they are read."""

    def __init__(self, document: Document, schema: ManifoldFile, overrides: dict[str, int | float | str]) -> None:
        self.document = document
        self.schema = schema
        self.parameters = self.read_parameters(overrides)
        self.overridden = tuple(k for k in overrides if self.parameters[k] != self.number(schema.parameters[k], k))
        space = schema.embedded or schema.chart
        assert space is not None
        self.kind = "embedded" if schema.embedded else "chart"
        self.point_size = self.space_size(space.space, (self.kind, "space"))
        self.frame = self.read_frame()
        self.tangent_size = len(schema.frame) if schema.frame else self.point_size

    def spec(self) -> ManifoldSpec:
        """The whole, in the order in which a reader of the file meets it."""
        schema = self.schema
        constraint = self.read_constraint()
        embedded = schema.embedded
        chart = schema.chart
        exp = self.map(schema.exp, ("exp",), ("p", "v"), (self.point_size,))
        log = self.map(schema.log, ("log",), ("p", "q"), (self.tangent_size,))
        return ManifoldSpec(
            name=schema.manifold,
            doc=schema.doc.strip(),
            parameters=tuple(self.parameters.items()),
            overridden=self.overridden,
            point_size=self.point_size,
            tangent_size=self.tangent_size,
            dim=self.read_dim(constraint),
            constraint=constraint,
            project=self.map(embedded.project, ("embedded", "project"), ("p",), (self.point_size,))
            if embedded
            else None,
            domain=self.optional((embedded or chart).domain, (self.kind, "domain"), ("p",), TRUTH),  # type: ignore[union-attr]
            equivalent=self.optional(embedded.equivalent, ("embedded", "equivalent"), ("p",), (self.point_size,))
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
            injectivity_radius=self.length(schema.injectivity_radius, "injectivity_radius"),
            diameter=self.length(schema.diameter or "infinity", "diameter"),
            cut_locus=self.read_cut_locus(log),
            source=self.document.source,
            content_hash=self.content_hash(),
        )

    def read_parameters(self, overrides: Mapping[str, int | float | str]) -> dict[str, Fraction]:
        declared = self.schema.parameters
        for name in declared:
            if name in RESERVED:
                raise UserError(
                    f"`{name}` has a meaning of its own",
                    self.document.key_span(("parameters", name)),
                    "choose another name",
                )
        for name in overrides:
            if name not in declared:
                raise UserError(
                    f"`{self.schema.manifold}` has no parameter `{name}`", hint=did_you_mean(name, declared)
                )
        return {name: self.number(overrides.get(name, value), name) for name, value in declared.items()}

    def number(self, value: int | float | str, name: str) -> Fraction:
        text = str(value)
        exponent = re.search(r"[eE]([+-]?[0-9]+)$", text)
        try:
            if len(text) > 40 or (exponent and abs(int(exponent[1])) > 300):
                raise ValueError
            return Fraction(text)  # the decimal as it is written, not its binary neighbour
        except (ValueError, ZeroDivisionError):
            raise UserError(
                f"parameter `{name}` must be a number, this is {value!r}", self.document.span(("parameters", name))
            ) from None

    def space_size(self, text: str, path: Path_) -> int:
        span = self.document.span(path)
        match = re.fullmatch(r"\s*R\s*\^\s*(.+?)\s*", text)
        if not match:
            raise UserError(f"`{text}` is not a space", span, "write R^3, R^n or R^(n+1)")
        size = integer(f.parse(match[1], span.inner(match.start(1))), self.parameters)
        if not 1 <= size <= 4 * MAX_DIM:
            raise UserError(f"a space of {size} dimensions; 1 to {4 * MAX_DIM} are compiled", span)
        return size

    def read_constraint(self) -> Map | None:
        if self.schema.embedded is None:
            return None
        return self.map(self.schema.embedded.constraint, ("embedded", "constraint"), ("p",), None)

    def read_dim(self, constraint: Map | None) -> int:
        constraints = 0 if constraint is None else (constraint.value.shape or (1,))[0]
        dim = self.point_size - constraints
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
        formulas = [
            self.formula(text, ("frame", i), {"p": (self.point_size,)}, (self.point_size,))
            for i, text in enumerate(rows)
        ]
        tree = f.Rows(tuple(row.tree for row in formulas), formulas[0].span)
        value = Formula("; ".join(rows), tree, (len(rows), self.point_size), formulas[0].span)
        return Map(("p",), (), value)

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
            return self.map(self.schema.metric, ("metric",), ("p",), metric.value.shape)
        return metric

    def read_cut_locus(self, log: Map) -> CutLocus | None:
        section = self.schema.cut_locus
        if section is None:
            return None
        where = self.map(section.where, ("cut_locus", "where"), ("p", "q"), TRUTH, log)
        value = self.optional(section.log, ("cut_locus", "log"), ("p", "q"), (self.tangent_size,), log)
        log_det = self.optional(section.log_det, ("cut_locus", "log_det"), ("p", "q"), (), log)
        return CutLocus(where, value, log_det)

    def length(self, text: str, key: str) -> Map | None:
        if text.strip() == "infinity":
            return None
        length = self.map(text, (key,), (), ())
        self.check_positive(length, key)
        return length

    def check_positive(self, length: Map, what: str) -> None:
        """Refuse a length that is not above zero; what is not a number of parameters and pi is left to `derive`."""
        try:
            number = constant(length.value.tree, {**self.parameters, "pi": Fraction(355, 113)})
        except UserError:
            return
        if number <= 0:
            raise UserError(f"`{what}` must be positive, this is {float(number):g}", length.value.span)

    def optional(
        self, text: object, path: Path_, arguments: tuple[str, ...], shape: Shape | None, lets_of: Map | None = None
    ) -> Map | None:
        return None if text is None else self.map(text, path, arguments, shape, lets_of)

    def map(
        self, section: object, path: Path_, arguments: tuple[str, ...], shape: Shape | None, lets_of: Map | None = None
    ) -> Map:
        """A formula with its `let`s; `lets_of` is a map whose names it may use too."""
        sizes = {"p": self.point_size, "q": self.point_size, "u": self.tangent_size, "v": self.tangent_size}
        scope: dict[str, Shape] = {name: (sizes[name],) for name in arguments}
        lets = list(lets_of.lets) if lets_of else []
        scope |= {name: formula.shape for name, formula in lets}
        texts: Mapping[str, str] = getattr(section, "let", {})
        for name, text in texts.items():
            self.check_let_name(name, scope, (*path, "let", name))
            formula = self.formula(text, (*path, "let", name), scope, None)
            lets.append((name, formula))
            scope[name] = formula.shape
        plain = isinstance(section, str)
        value = self.formula(section if plain else section.value, path if plain else (*path, "value"), scope, shape)  # type: ignore[arg-type,attr-defined]
        return Map(arguments, tuple(lets), value)

    def check_let_name(self, name: str, scope: Scope, path: Path_) -> None:
        if name in RESERVED or name in self.parameters:
            raise UserError(f"`{name}` has a meaning of its own", self.document.key_span(path), "choose another name")
        if name in scope:
            raise UserError(f"`{name}` is defined already", self.document.key_span(path), "choose another name")

    def formula(self, text: str, path: Path_, scope: Scope, shape: Shape | None) -> Formula:
        span = self.document.span(path)
        if "\n" in span.source.line(span.line)[span.column - 1 :] or text not in span.source.line(span.line):
            span = span.inner(0)  # a folded or block scalar: point at its start
        tree = f.parse(text, span)
        found = shape_of(tree, scope, self.parameters)
        if found == TRUTH and shape is None:
            raise UserError("a comparison has no value here", span, "use it as the first argument of where(c, x, y)")
        if shape is not None and found != shape:
            raise UserError(
                f"`{'.'.join(str(k) for k in path)}` must be {describe(shape)}, this is {describe(found)}", span
            )
        return Formula(text, tree, found, span)

    def content_hash(self) -> str:
        values = ",".join(f"{name}={value}" for name, value in self.parameters.items())
        text = self.document.source.text.replace("\r\n", "\n") + "\0" + values
        return hashlib.sha256(text.encode()).hexdigest()
