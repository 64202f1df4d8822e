"""What every manifold file needs read: parameters, constants, formulas with their places."""

from __future__ import annotations

import hashlib
import re
import textwrap
from collections.abc import Mapping, Sequence
from fractions import Fraction

from rsrm_gen.compiler.budget import spend
from rsrm_gen.compiler.spec import formula as f
from rsrm_gen.compiler.spec.model import Formula, Map
from rsrm_gen.compiler.spec.schema import Heading
from rsrm_gen.compiler.spec.shapes import Scope, constant, describe, shape_of
from rsrm_gen.compiler.spec.vocabulary import CONSTANTS, TRUTH, WORDS, Shape
from rsrm_gen.document import Document, Path_
from rsrm_gen.errors import UserError, did_you_mean

RESERVED = {"p", "q", "u", "v", "x", "mu", "W", "amplitude", "df", "normal", "uniform", *CONSTANTS, *WORDS}


class FormulaReader:
    """Reads the formulas of one document, whose parameters and constants it knows."""

    def __init__(self, document: Document, schema: Heading, overrides: Mapping[str, int | float | str]) -> None:
        self.document = document
        self.schema: Heading = schema
        self.sizes: dict[str, Shape] = {}  # of the arguments of formulas
        self.constants: tuple[tuple[str, Formula], ...] = ()
        self.parameters = self.read_parameters(overrides)
        self.overridden = tuple(k for k in overrides if self.parameters[k] != self.number(schema.parameters[k], k))

    def read_constants(self, texts: Mapping[str, str]) -> None:
        """The `let` of the whole file."""
        for name, text in texts.items():
            scope = {known: formula.shape for known, formula in self.constants}
            self.check_let_name(name, scope, ("let", name))
            self.constants += ((name, self.formula(text, ("let", name), scope, None)),)

    def read_symbols(self, maps: Sequence[Map | None]) -> tuple[tuple[str, str], ...]:
        """What the file says of its letters; each must be one that some formula can use."""
        lets = {name for some in maps if some for name, _ in some.lets}
        known = {"p", "q", "u", "v", *self.parameters, *lets, *(name for name, _ in self.constants)}
        for name in self.schema.symbols:
            if name not in known:
                span = self.document.key_span(("symbols", name))
                raise UserError(f"there is no symbol `{name}` in this file", span, did_you_mean(name, known))
        return tuple((name, " ".join(text.split())) for name, text in self.schema.symbols.items())

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
        return {
            name: self.number(overrides.get(name, value), name, name in overrides) for name, value in declared.items()
        }

    def number(self, value: int | float | str, name: str, given: bool = False) -> Fraction:
        """A parameter's value, written in the file or `given` by the user of the file."""
        try:
            text = str(value)
            exponent = re.search(r"[eE]([+-]?[0-9]+)$", text)
            if len(text) > 40 or (exponent and abs(int(exponent[1])) > 300):
                raise ValueError
            return Fraction(text)  # the decimal as it is written, not its binary neighbour
        except (ValueError, ZeroDivisionError):
            span = None if given else self.document.span(("parameters", name))
            hint = "write an integer, a decimal or a fraction, like 2, 0.5 or 1/3"
            raise UserError(f"parameter `{name}` must be a number, this is {_shown(value)}", span, hint) from None

    def length(self, section: object, path: Path_) -> Map | None:
        """A positive number; None for infinity."""
        if section is None or (isinstance(section, str) and section.strip() == "infinity"):
            return None
        length = self.map(section, path, (), ())
        self.check_positive(length, str(path[-1]))
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
        scope: dict[str, Shape] = {name: self.sizes[name] for name in arguments}
        lets = list(lets_of.lets if lets_of else self.constants)
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
        spend()
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

    def content_hash(self, *parts: str) -> str:
        """A hash of the text, the values in force, and what else the manifold is made of."""
        values = ",".join(f"{name}={value}" for name, value in self.parameters.items())
        text = "\0".join([self.document.source.text.replace("\r\n", "\n"), values, *parts])
        return hashlib.sha256(text.encode()).hexdigest()


def _shown(value: int | float | str) -> str:
    """A value as a message quotes it; a number of thousands of digits cannot even be written."""
    large = isinstance(value, int) and value.bit_length() > 400
    return "a number of more than 100 digits" if large else textwrap.shorten(repr(value), 60, placeholder="...'")
