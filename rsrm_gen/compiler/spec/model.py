"""What stage 1 gives: a manifold as its author described it, checked.

The letters are the geometer's: p a base point, q another point, u and v tangent vectors at p.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from rsrm_gen.compiler.spec.formula import Tree
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
class ManifoldSpec:
    """A Riemannian manifold with closed-form Exp and Log; D = point_size, T = tangent_size, d = dim."""

    name: str
    doc: str
    parameters: tuple[tuple[str, Fraction], ...]  # all of them, with the values in force
    overridden: tuple[str, ...]  # those that differ from the file's own values
    point_size: int
    tangent_size: int
    dim: int
    constraint: Map | None  # of p, shape (number of constraints,); None for a chart
    project: Map | None  # of p, shape (D,)
    domain: Map | None  # a comparison in p
    equivalent: Map | None  # of p, shape (D,): the other name of the same point
    periods: tuple[Map | None, ...] | None  # of nothing; None for an embedded manifold
    frame: Map | None  # of p, shape (d, D): the vectors that tangent components multiply
    metric: Map  # of p, u, v, a scalar; or of p alone, a (T, T) matrix
    exp: Map  # of p, v, shape (D,)
    log: Map  # of p, q, shape (T,)
    norm: Map | None  # of p, v, a scalar
    distance: Map | None  # of p, q, a scalar
    log_det: Map | None  # of p, q, a scalar
    injectivity_radius: Map | None  # of nothing; None for infinity
    diameter: Map | None
    cut_locus: CutLocus | None
    source: Source
    content_hash: str

    @property
    def embedded(self) -> bool:
        """Whether points are ambient vectors under constraints, not coordinates of a chart."""
        return self.constraint is not None

    @property
    def ambient_tangents(self) -> bool:
        """Whether tangent vectors are stored as D ambient numbers that must obey the constraints."""
        return self.embedded and self.frame is None

    @property
    def identifier(self) -> str:
        """The name in file and C names: `sphere`, or `sphere_n5` when a parameter differs from the file's value."""
        values = dict(self.parameters)
        suffixes = (f"_{name}{_spell(values[name])}" for name in self.overridden)
        return self.name + "".join(suffixes)


def _spell(value: Fraction) -> str:
    text = str(value.numerator) if value.denominator == 1 else repr(float(value))
    return text.replace("-", "m").replace(".", "p").replace("+", "")
