"""The keys of a manifold file. Formulas are still text here; `read.py` and `product.py` give them meaning."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, WithJsonSchema, model_validator


def _as_text(value: object) -> object:
    """A bare number is a formula too, and so is a YAML list of formulas: [[1, 0], [0, 1]]."""
    if isinstance(value, list) and all(isinstance(item, str | int | float | list) for item in _leaves(value)):
        return "[" + ", ".join(str(_as_text(item)) for item in value) + "]"
    return str(value) if isinstance(value, int | float) and not isinstance(value, bool) else value


def _leaves(value: object) -> Iterator[object]:
    """What stands in a list of lists; a truth value counts as none of a formula's parts."""
    if isinstance(value, list):
        for item in value:
            yield from _leaves(item)
    else:
        yield None if isinstance(value, bool) else value


def _no_truth(value: object) -> object:
    if isinstance(value, bool):
        raise ValueError("this is a truth value to YAML; a parameter is a number")
    return value


Number = Annotated[int | float | str, BeforeValidator(_no_truth)]
FORMULA = {"type": "string", "format": "formula"}  # what `editors.py` knows a formula by
FormulaText = Annotated[str, BeforeValidator(_as_text), Field(min_length=1), WithJsonSchema(FORMULA)]
Identifier = Annotated[str, Field(pattern=r"^[A-Za-z][A-Za-z0-9_]*$", max_length=40)]


class Section(BaseModel):
    """A mapping in the file: unknown keys are errors, nothing is guessed."""

    model_config = ConfigDict(extra="forbid", frozen=True)


class LetSection(Section):
    """A formula that names its parts first."""

    let: dict[Identifier, FormulaText] = Field({}, description="names for parts; each may use those before it")
    value: FormulaText = Field(description="the formula, in those names")


MapText = FormulaText | LetSection


class EmbeddedSection(Section):
    """Points are vectors of R^D under constraints."""

    space: FormulaText = Field(description="R^D, the ambient space; R^(n x n) for points that are matrices")
    constraint: MapText = Field(description="a formula in p that vanishes on the manifold, or a vector of them")
    project: MapText = Field(description="a formula in p that maps nearby vectors onto the manifold")
    domain: FormulaText | None = Field(None, description="a comparison in p that chooses a sheet, like p[0] > 0")
    equivalent: MapText | None = Field(None, description="the other name of the same point, like -p")


class ChartSection(Section):
    """Points are coordinates."""

    space: FormulaText = Field(description="R^d, the coordinates")
    domain: FormulaText | None = Field(None, description="a comparison in p that holds for valid coordinates")
    period: list[FormulaText | None] | FormulaText | None = Field(
        None, union_mode="left_to_right", description="of every coordinate, or of each"
    )


class CutLocusSection(Section):
    """Where shortest geodesics stop being unique, and what the code returns there."""

    where: FormulaText = Field(description="a comparison in p, q and the names of log")
    log: FormulaText | None = Field(None, description="what Log_p(q) is there")
    log_det: FormulaText | None = Field(None, description="what log |det D Log_p(q)| is there, with `log:`")
    policy: str | None = Field(
        None, pattern="^tie$", description="`tie`: the formula of log returns one of the shortest"
    )

    @model_validator(mode="after")
    def _one_policy(self) -> CutLocusSection:
        if (self.log is None) == (self.policy is None):
            raise ValueError("say what Log returns there: either `policy: tie` or a formula `log:`")
        if (self.log is None) != (self.log_det is None):
            raise ValueError("`log:` and `log_det:` say together what the code returns there: give both or neither")
        return self


class Heading(Section):
    """What every manifold file may say first."""

    manifold: Identifier = Field(description="the name of the manifold")
    doc: str = Field(min_length=1, description="one or two sentences: what it is, in which units")
    symbols: dict[Identifier, Annotated[str, Field(min_length=1)]] = Field(
        {}, description="what p, q, v, a parameter or a name of a `let` stands for, with its unit"
    )
    parameters: dict[Identifier, Number] = Field({}, description="numbers with their default values")
    scale: FormulaText | None = Field(None, description="a number: all lengths are multiplied by it")


class ManifoldFile(Heading):
    """A manifold file, key by key."""

    let: dict[Identifier, FormulaText] = Field({}, description="constants made of the parameters, for all formulas")
    embedded: EmbeddedSection | None = None
    chart: ChartSection | None = None
    frame: Annotated[list[FormulaText], Field(min_length=1)] | MapText | None = Field(
        None,
        union_mode="left_to_right",
        description="vectors in p; tangent vectors are components in it. Or the ambient vector, a formula in p and v",
    )
    metric: MapText = Field(description="<u, v>_p, a scalar formula in p, u, v; or a matrix formula in p")
    maps: Literal["geodesic", "retraction"] = Field(
        "geodesic", description="whether exp and log are those of the metric, or a retraction and its inverse"
    )
    exp: MapText | None = Field(None, description="Exp_p(v)")
    log: MapText | None = Field(None, description="Log_p(q)")
    norm: MapText | None = Field(None, description="a closed form of |v|_p, in p, v and the names of exp")
    distance: MapText | None = Field(None, description="a closed form, in p, q and the names of log")
    log_det: MapText | None = Field(None, description="a closed form of log |det D Log_p(q)|")
    transport: MapText | None = Field(
        None, description="v carried from p to q along the geodesic, in p, q, v and the names of log"
    )
    sample: MapText | None = Field(
        None, description="a point uniform in volume, in `normal` and `uniform`, as many random numbers as a point has"
    )
    injectivity_radius: MapText = Field(description="of every point; `infinity` if Exp_p is a diffeomorphism")
    diameter: MapText | None = Field(None, description="the largest distance; left out when not compact")
    cut_locus: CutLocusSection | None = None

    @model_validator(mode="after")
    def _embedded_or_chart(self) -> ManifoldFile:
        if (self.embedded is None) == (self.chart is None):
            raise ValueError("say how a point is stored: either `embedded:` or `chart:`")
        return self


class FactorSection(Section):
    """A factor of a product with what differs from its defaults."""

    manifold: Identifier = Field(description="a bundled manifold, or NAME.yaml beside this file")
    parameters: dict[Identifier, FormulaText] = Field({}, description="its parameters, in those of the product")
    weight: FormulaText | None = Field(None, description="a number: the factor's lengths are multiplied by it")
    power: FormulaText = Field("1", description="how many copies of the factor")


class ProductFile(Heading):
    """The file of a product of manifolds."""

    product: dict[Identifier, FactorSection | FormulaText] = Field(
        min_length=1, description="the factors by name: `arm: torus(n=6)`, or a mapping"
    )
