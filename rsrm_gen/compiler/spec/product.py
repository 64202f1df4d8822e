"""Products: the factors of a `product:` section, each a manifold file of its own, read with its parameters."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from pathlib import Path

from rsrm_gen.compiler.spec import formula as f
from rsrm_gen.compiler.spec.formulas import FormulaReader
from rsrm_gen.compiler.spec.model import Factor, ProductSpec, Spec, section
from rsrm_gen.compiler.spec.schema import FactorSection, ProductFile
from rsrm_gen.compiler.spec.shapes import constant, integer
from rsrm_gen.document import Document, Path_
from rsrm_gen.errors import UserError, did_you_mean
from rsrm_gen.files import bundled

MAX_DEPTH = 4
MAX_FACTORS = 16
MAX_DIM = 24
SHORT = re.compile(r"\s*(?P<name>[A-Za-z]\w*)\s*(?:\((?P<parameters>.*)\))?\s*")

Read = Callable[[Path, Mapping[str, int | float | str], tuple[Path, ...]], Spec]


class ProductReader(FormulaReader):
    """Builds the spec of a product; `read` reads a factor's file, `inside` are the products that this one is part of."""

    schema: ProductFile

    def __init__(
        self,
        document: Document,
        schema: ProductFile,
        overrides: Mapping[str, int | float | str],
        read: Read,
        inside: tuple[Path, ...],
    ) -> None:
        super().__init__(document, schema, overrides)
        self.read = read
        self.inside = (*inside, Path(document.source.name))

    def spec(self) -> ProductSpec:
        """The product with all its factors."""
        schema, span = self.schema, self.document.key_span(("product",))
        if len(schema.product) > MAX_FACTORS:
            raise UserError(f"a product of {len(schema.product)} factors; at most {MAX_FACTORS} are compiled", span)
        factors = [factor for name in schema.product for factor in self.factors(name)]
        spec = ProductSpec(
            name=schema.manifold,
            doc=schema.doc.strip(),
            symbols=self.read_symbols([]),
            parameters=tuple(self.parameters.items()),
            overridden=self.overridden,
            scale=self.length(schema.scale, ("scale",)),
            source=self.document.source,
            content_hash=self.content_hash(*(factor.spec.content_hash for factor in factors)),
            factors=tuple(factors),
            section=section("product", span),
        )
        if len(factors) > MAX_FACTORS or spec.dim > MAX_DIM:
            raise UserError(
                f"a product of {len(factors)} factors and {spec.dim} dimensions; "
                f"at most {MAX_FACTORS} and {MAX_DIM} are compiled",
                span,
            )
        return spec

    def factors(self, name: str) -> list[Factor]:
        """A factor, or its copies: `arm`, or `arm1` and `arm2`."""
        path = ("product", name)
        given = self.schema.product[name]
        given = self.short(given, path) if isinstance(given, str) else given
        parameters = {key: str(self.value(text, (*path, "parameters", key))) for key, text in given.parameters.items()}
        power = integer(f.parse(given.power, self.document.span((*path, "power"))), self.parameters)
        if not 1 <= power <= MAX_FACTORS:
            raise UserError(
                f"a power of {power}; 1 to {MAX_FACTORS} are compiled", self.document.span((*path, "power"))
            )
        spec = self.read_factor(self.file(given.manifold, path), parameters, path)
        weight = self.length(given.weight, (*path, "weight"))
        return [Factor(f"{name}{i + 1}" if power > 1 else name, spec, weight) for i in range(power)]

    def read_factor(self, file: Path, parameters: Mapping[str, str], path: Path_) -> Spec:
        """A factor's own spec; what is wrong with the parameters it is given is wrong in this file."""
        try:
            return self.read(file, parameters, self.inside)
        except UserError as error:
            raise UserError(error.message, error.span or self.document.span(path), error.hint) from None

    def short(self, text: str, path: Path_) -> FactorSection:
        """`torus(n=6)` as the mapping it stands for."""
        match = SHORT.fullmatch(text)
        given = [item.partition("=") for item in (match["parameters"] or "").split(",")] if match else []
        given = [item for item in given if any(item)]
        if match is None or not all(equals and key.strip() and value.strip() for key, equals, value in given):
            raise UserError(
                f"`{text}` is not a factor", self.document.span(path), "write the name of a manifold, like torus(n=6)"
            )
        parameters = {key.strip(): value.strip() for key, _, value in given}
        return FactorSection(manifold=match["name"], parameters=parameters, weight=None, power="1")

    def value(self, text: str, path: Path_) -> object:
        """A factor's parameter: a number in the parameters of the product."""
        return constant(f.parse(text, self.document.span(path)), self.parameters)

    def file(self, name: str, path: Path_) -> Path:
        """The file of a factor: beside this one, or bundled. A name is no path, so no other file can be reached."""
        span = self.document.span((*path, "manifold"))
        here = Path(self.document.source.name).parent
        folders = [folder for folder in (here, bundled("manifolds")) if folder.is_dir()]
        found = next((folder / f"{name}.yaml" for folder in folders if (folder / f"{name}.yaml").is_file()), None)
        if found is None:
            known = {file.stem for file in bundled("manifolds").glob("*.yaml")}
            raise UserError(
                f"there is no manifold `{name}` beside this file or bundled", span, did_you_mean(name, known)
            )
        if len(self.inside) > MAX_DEPTH or any(found.resolve() == other.resolve() for other in self.inside):
            raise UserError(f"`{name}` is part of itself, or products are nested deeper than {MAX_DEPTH} levels", span)
        return found
