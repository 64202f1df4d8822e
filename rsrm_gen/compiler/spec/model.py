"""What stage 1 gives: a manifold as its author described it, checked.

The letters are the geometer's: p a base point, q another point, u and v tangent vectors at p.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import TypeAlias

from rsrm_gen.compiler.spec.formula import Number, Tree
from rsrm_gen.compiler.spec.vocabulary import Shape
from rsrm_gen.errors import Source, Span


@dataclass(frozen=True)
class Formula:
    """A formula as written, its syntax tree, its shape, and where it stands."""

    text: str
    tree: Tree
    shape: Shape
    span: Span


@dataclass(frozen=True)
class Map:
    """A function of some of p, q, u, v: its value and the `let` names that the value may use, in their order."""

    arguments: tuple[str, ...]
    lets: tuple[tuple[str, Formula], ...]
    value: Formula


@dataclass(frozen=True)
class CutLocus:
    """Where Exp_p stops being minimising, and what the code returns there.

    `log` and `log_det` are the declared values where the comparison `where` holds; without them the formula for Log
    itself returns one of the several shortest vectors there (`policy: tie`).
    """

    where: Map
    log: Map | None
    log_det: Map | None


@dataclass(frozen=True)
class Heading:
    """What every manifold file begins with."""

    name: str
    doc: str
    symbols: tuple[tuple[str, str], ...]  # what a letter of the file stands for, in which units
    parameters: tuple[tuple[str, Fraction], ...]  # all of them, with the values in force
    overridden: tuple[str, ...]  # those that differ from the file's own values
    scale: Map | None  # of nothing: what all lengths are multiplied by
    source: Source
    content_hash: str

    @property
    def argument_shapes(self) -> Mapping[str, Shape]:
        """The shapes of p, q, u, v and what else formulas are functions of."""
        return {}

    @property
    def identifier(self) -> str:
        """The name in file and C names: `sphere`, or `sphere_n5` when a parameter differs from the file's value."""
        values = dict(self.parameters)
        suffixes = (f"_{name}{_spell(values[name])}" for name in self.overridden)
        return self.name + "".join(suffixes)


@dataclass(frozen=True)
class ManifoldSpec(Heading):
    """A Riemannian manifold with closed-form Exp and Log; D = point_size, T = tangent_size, d = dim.

    With `maps` "retraction", Exp is a retraction of the metric, right to first order at its base point, and Log its
    inverse; with "geodesic" both are what their names say.
    """

    maps: str
    point_shape: Shape  # (D,), or (n, n) for points that are matrices, stored row by row
    point_size: int
    tangent_size: int
    dim: int
    constraint: Map | None  # of p, shape (number of constraints,); None for a chart
    project: Map | None  # of p, shape (D,)
    domain: Map | None  # a comparison in p
    equivalent: Map | None  # of p, shape (D,): the other name of the same point
    periods: tuple[Map | None, ...] | None  # of nothing; None for an embedded manifold
    frame: Map | None  # of p, v, the shape of a point, linear in v: the ambient vector that components mean
    metric: Map  # of p, u, v, a scalar; or of p alone, a (T, T) matrix
    exp: Map  # of p, v, shape (D,)
    log: Map  # of p, q, shape (T,)
    norm: Map | None  # of p, v, a scalar
    distance: Map | None  # of p, q, a scalar
    log_det: Map | None  # of p, q, a scalar
    transport: Map | None  # of p, q, v, shape (T,)
    sample: Map | None  # of `normal` and `uniform`, D random numbers each, shape (D,)
    injectivity_radius: Map | None  # of nothing; None for infinity
    diameter: Map | None
    cut_locus: CutLocus | None

    @property
    def embedded(self) -> bool:
        """Whether points are ambient vectors under constraints, not coordinates of a chart."""
        return self.constraint is not None

    @property
    def tangent_shape(self) -> Shape:
        """What a tangent vector is in a formula: like a point, or a vector of components in the frame."""
        return self.point_shape if self.frame is None else (self.tangent_size,)

    @property
    def argument_shapes(self) -> Mapping[str, Shape]:
        """Those of points, tangent vectors, and of the random numbers of `sample`."""
        points, tangents = self.point_shape, self.tangent_shape
        return {"p": points, "q": points, "u": tangents, "v": tangents, "normal": points, "uniform": points}

    @property
    def ambient_tangents(self) -> bool:
        """Whether tangent vectors are stored as D ambient numbers that must obey the constraints."""
        return self.embedded and self.frame is None


@dataclass(frozen=True)
class Factor:
    """A factor of a product: its name there, and the number that its lengths are multiplied by (None: 1)."""

    name: str
    spec: Spec
    weight: Map | None


@dataclass(frozen=True)
class ProductSpec(Heading):
    """A product of manifolds: points and tangent vectors are those of the factors, one after the other.

    The squares of lengths add up. What is asked for as a formula, to show where an error comes from, is the section
    `product:` itself.
    """

    factors: tuple[Factor, ...]
    section: Map

    @property
    def maps(self) -> str:
        """ "geodesic" if the maps of all factors are."""
        return "retraction" if any(factor.spec.maps == "retraction" for factor in self.factors) else "geodesic"

    @property
    def point_size(self) -> int:
        """D, how many numbers store a point."""
        return sum(factor.spec.point_size for factor in self.factors)

    @property
    def tangent_size(self) -> int:
        """T, how many numbers store a tangent vector."""
        return sum(factor.spec.tangent_size for factor in self.factors)

    @property
    def dim(self) -> int:
        """d, the dimension."""
        return sum(factor.spec.dim for factor in self.factors)

    @property
    def embedded(self) -> bool:
        """Whether points of some factor obey constraints."""
        return any(factor.spec.embedded for factor in self.factors)

    @property
    def metric(self) -> Map:
        """The section `product:`."""
        return self.section

    exp = log = metric

    @property
    def distance(self) -> Map | None:
        """None: a product has no closed forms of its own."""
        return None

    log_det = norm = diameter = distance

    @property
    def cut_locus(self) -> CutLocus | None:
        """None: the cut loci are those of the factors."""
        return None

    def distinct(self) -> Iterator[Factor]:
        """The factors, each manifold once."""
        seen = set()
        for factor in self.factors:
            if factor.spec.content_hash not in seen:
                seen.add(factor.spec.content_hash)
                yield factor


Spec: TypeAlias = ManifoldSpec | ProductSpec


def section(text: str, span: Span) -> Map:
    """A map that stands for a whole section of the file, for errors to point at."""
    return Map((), (), Formula(text, Number(Fraction(0), span), (), span))


def _spell(value: Fraction) -> str:
    text = str(value.numerator) if value.denominator == 1 else repr(float(value))
    return text.replace("-", "m").replace(".", "p").replace("+", "")
