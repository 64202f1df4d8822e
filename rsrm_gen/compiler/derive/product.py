"""Products of manifolds, and manifolds whose lengths are multiplied by a number: made of finished geometries.

With lengths multiplied by w, inner products are multiplied by w^2 and gradients divided by it; Exp, Log and the
determinant between Riemannian volumes stay what they are. In a product, points and tangent vectors are those of the
factors one after the other, squares of lengths add up, and so do logarithms of determinants.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from itertools import accumulate

import sympy as sp

from rsrm_gen.compiler.derive.geometry import Argument, Assignment, Function, Geometry, Guard, argument, renamed
from rsrm_gen.compiler.derive.numeric import value
from rsrm_gen.compiler.derive.scalarise import number
from rsrm_gen.compiler.spec import ProductSpec

POWERS = {"inner": 2, "flat": 2, "norm": 1, "distance": 1, "riemannian_gradient": -2, "gradient_norm": -1}
SQUARED_LENGTHS = ("norm", "distance", "gradient_norm")  # sqrt of the sum of squares
SUMS = ("inner", "log_abs_det")
NOT_OF_PRODUCTS = ("other_name",)  # a point of a product with such a factor has more names than one other


def scaled(geometry: Geometry, length: sp.Expr) -> Geometry:
    """The same manifold with all lengths multiplied by a positive number."""
    if length == 1:
        return geometry

    def function(f: Function) -> Function:
        if f.name not in POWERS:
            return f
        factor = length ** POWERS[f.name]
        return replace(f, results=tuple(factor * e for e in f.results), formula=f"{_spelled(factor)} * ({f.formula})")

    return replace(
        geometry,
        functions=tuple(map(function, geometry)),
        injectivity_radius=length * geometry.injectivity_radius,
        diameter=length * geometry.diameter,
        unit=length * geometry.unit,
    )


def product(spec: ProductSpec, geometries: Mapping[str, Geometry]) -> Geometry:
    """The product of the factors, whose geometries are given by their content hashes."""
    factors = {factor.name: geometries[factor.spec.content_hash] for factor in spec.factors}
    weighted = {
        factor.name: scaled(factors[factor.name], number(spec, factor.weight) if factor.weight else sp.Integer(1))
        for factor in spec.factors
    }
    parts = _Parts(spec, weighted)
    first = next(iter(weighted.values()))
    names = [f.name for f in first if f.name not in NOT_OF_PRODUCTS and all(f.name in g for g in weighted.values())]
    periods = tuple(p for g in weighted.values() for p in g.periods or (None,) * g.spec.point_size)
    distinct = tuple((factor.name, factors[factor.name]) for factor in spec.distinct())
    return Geometry(
        spec,
        tuple(map(parts.function, names)),
        "product",
        _least(g.injectivity_radius for g in weighted.values()),
        sp.sqrt(sp.Add(*(g.diameter**2 for g in weighted.values()))),
        periods if any(periods) else None,
        parts.domain(),
        distinct,
        _least(g.unit for g in weighted.values()),
    )


def _least(lengths: Iterable[sp.Expr]) -> sp.Expr:
    """The smallest of some lengths, of which some may be infinite."""
    return min(lengths, key=lambda length: value(length, {}) if length.is_finite else float("inf"))


class _Parts:
    """The functions of the factors on their parts of the arguments, and what they make together."""

    def __init__(self, spec: ProductSpec, geometries: Mapping[str, Geometry]) -> None:
        self.spec = spec
        self.geometries = geometries

    def function(self, name: str) -> Function:
        """A function of the product."""
        functions = [geometry[name] for geometry in self.geometries.values()]
        arguments = tuple(
            argument(some[0].name, *(() if not some[0].shape else (sum(a.shape[0] for a in some),)))
            for some in zip(*(f.arguments for f in functions), strict=True)
        )
        moved = [
            _moved(f, f"{factor}_", _names(f.arguments, arguments, starts))
            for factor, f, starts in zip(self.geometries, functions, self.starts(functions), strict=True)
        ]
        assignments = tuple(a for f in moved for a in f.assignments)
        results, shape, formula = _joined(name, dict(zip(self.geometries, moved, strict=True)))
        return Function(name, arguments, assignments, results, shape, formula)

    @staticmethod
    def starts(functions: list[Function]) -> Iterable[tuple[int, ...]]:
        """For every factor, where its part of each argument begins."""
        sizes = [tuple(len(a.symbols) for a in f.arguments) for f in functions]
        columns = [list(accumulate(column, initial=0))[:-1] for column in zip(*sizes, strict=True)]
        return zip(*columns, strict=True)

    def domain(self) -> sp.Expr | None:
        """1 where the parts of a point are valid for all factors."""
        p = argument("p", self.spec.point_size).symbols
        conditions, start = [], 0
        for geometry in self.geometries.values():
            own = argument("p", geometry.spec.point_size).symbols
            if geometry.domain is not None:
                conditions.append(geometry.domain.xreplace(dict(zip(own, p[start:], strict=False))))
            start += len(own)
        return sp.Mul(*conditions) if conditions else None


def _names(
    own: tuple[Argument, ...], whole: tuple[Argument, ...], starts: tuple[int, ...]
) -> dict[sp.Symbol, sp.Symbol]:
    """The symbols of a factor's arguments to those of the product's."""
    return {
        symbol: all_of_it.symbols[start + i]
        for part, all_of_it, start in zip(own, whole, starts, strict=True)
        for i, symbol in enumerate(part.symbols)
    }


def _moved(function: Function, prefix: str, names: dict[sp.Symbol, sp.Symbol]) -> Function:
    """The function of other symbols, its assignments named after the factor."""
    own = {a.symbol: sp.Symbol(f"{prefix}{a.symbol}", real=True) for a in function.assignments}
    moved = renamed(function, {**names, **own})

    def placed(guard: Guard | None) -> Guard | None:
        return guard and replace(guard, place=tuple((names.get(s, s), x) for s, x in guard.place))

    return replace(
        moved, assignments=tuple(Assignment(a.symbol, a.expression, placed(a.guard)) for a in moved.assignments)
    )


def _joined(name: str, functions: Mapping[str, Function]) -> tuple[tuple[sp.Expr, ...], tuple[int, ...], str]:
    """The results, their shape and the formula of a function of the product."""
    results = [f.results for f in functions.values()]
    if name in SQUARED_LENGTHS:
        squares = " + ".join(f"{name}({factor})^2" for factor in functions)
        return (sp.sqrt(sp.Add(*(r[0] ** 2 for r in results))),), (), f"sqrt({squares})"
    if name in SUMS:
        return (sp.Add(*(r[0] for r in results)),), (), " + ".join(f"{name}({factor})" for factor in functions)
    entries = tuple(e for r in results for e in r)
    return entries, (len(entries),), ", ".join(f"{factor}: {f.formula}" for factor, f in functions.items())


def _spelled(number: sp.Expr) -> str:
    return str(number) if number.is_Rational and number.q == 1 else f"({number})"
