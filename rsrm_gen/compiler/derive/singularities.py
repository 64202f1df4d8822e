"""Removable singularities: found where the author's formulas are 0/0, and replaced by polynomials near there.

Two kinds of 0/0 are looked at: of Log at coincident points and of Exp at the zero vector. On a ray out of such a place
every quotient is a function of how far one went, and so of any smooth quantity that grows like the distance squared,
such as the square under a norm. That it is a function of this quantity *alone*, whatever the base point and the
direction, is checked before the polynomial is believed.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import mpmath as mp
import sympy as sp

from rsrm_gen.compiler.derive.geometry import Assignment, Function, Guard
from rsrm_gen.compiler.derive.numeric import DIGITS, TINY, Values, run, value
from rsrm_gen.compiler.derive.sampling import Sampler
from rsrm_gen.compiler.derive.series import ERROR, Fit, fit

WHOLE_OF_REACH = 3  # `reach` is a third of the injectivity radius

Ray = Callable[[random.Random], Callable[[Any], Values]]  # rng -> (r -> values of all symbols at distance r)


def log_ray(log: Function, sampler: Sampler) -> Ray:
    """Rays out of coincident points: p fixed, q = Exp_p(r u)."""

    def ray(rng: random.Random) -> Callable[[Any], Values]:
        p = sampler.point(rng)
        u = sampler.direction(rng, p)
        return lambda r: run(log, p, sampler.along(p, u, r))[1]

    return ray


def exp_ray(exp: Function, sampler: Sampler) -> Ray:
    """Rays out of the zero vector: p fixed, v = r u."""

    def ray(rng: random.Random) -> Callable[[Any], Values]:
        p = sampler.point(rng)
        u = sampler.direction(rng, p)
        return lambda r: run(exp, p, [r * c for c in u])[1]

    return ray


def smooth_squares(function: Function, at_zero: Values) -> list[sp.Expr]:
    """What stands under square roots and vanishes at the singular place: smooth there, and of the order r^2."""
    roots = (
        a.expression for a in function.assignments if a.expression.is_Pow and a.expression.exp == sp.Rational(1, 2)
    )
    found = [root.base for root in roots if abs(value(root.base, at_zero)) < TINY]
    return list(dict.fromkeys(found))


def remove(
    quantity: sp.Expr, squares: Sequence[sp.Expr], ray: Ray, reach: Any, place: Values, order: int = 0
) -> Guard | None:
    """A guard for a quantity that is 0/0 at a place, in the square in which its polynomial reaches furthest."""
    fits = [(square, _fit_along(quantity, square, ray, reach, order)) for square in squares]
    good = [(square, found) for square, found in fits if found is not None and _stays_above(square, found, ray, reach)]
    if not good:
        return None
    square, found = max(good, key=lambda pair: _distance_covered(pair[0], pair[1], ray))
    return Guard(square, found.threshold, found(square), found.error, tuple(place.items()))


def guarded(
    function: Function, quotients: Sequence[sp.Symbol], at_zero: Values, ray: Ray, reach: Any
) -> tuple[Function, list[sp.Symbol]]:
    """The function with its quotients guarded, and those quotients whose singularity could not be removed."""
    failed: list[sp.Symbol] = []
    squares = smooth_squares(function, at_zero)
    place = {s: at_zero[s] for s in function.symbols()}

    def guard(assignment: Assignment) -> Assignment:
        if assignment.symbol not in quotients:
            return assignment
        found = remove(assignment.symbol, squares, ray, reach, place)
        if found is None:
            failed.append(assignment.symbol)
        return replace(assignment, guard=found)

    return replace(function, assignments=tuple(guard(a) for a in function.assignments)), failed


def _fit_along(quantity: sp.Expr, square: sp.Expr, ray: Ray, reach: Any, order: int) -> Fit | None:
    def curve(at: Callable[[Any], Values]) -> Callable[[Any], tuple[Any, Any]]:
        def point(r: Any) -> tuple[Any, Any]:
            values = at(r)
            return value(square, values), value(quantity, values)

        return point

    rng = random.Random(1)
    found = fit(curve(ray(rng)), reach, order)
    if found is None or not all(_agrees(found, curve(ray(rng)), reach) for _ in range(3)):
        return None
    return found


def _agrees(found: Fit, curve: Callable[[Any], tuple[Any, Any]], reach: Any) -> bool:
    """Whether the polynomial holds on another ray too."""
    x, y = curve(reach * mp.mpf("0.07"))
    with mp.workdps(DIGITS):
        u = x * found.threshold.q / found.threshold.p
        polynomial = mp.polyval([mp.mpf(str(c)) for c in found.coefficients[::-1]], u) * x**found.order
        return bool(x < found.threshold and abs(polynomial - y) < 4 * ERROR * abs(y))


def _stays_above(square: sp.Expr, found: Fit, ray: Ray, reach: Any) -> bool:
    """Whether the square is small near the singular place only: sin(r)^2 is small at the antipode too."""
    along = ray(random.Random(1))
    values = [value(square, along(reach * mp.mpf(k) / 8)) for k in range(1, WHOLE_OF_REACH * 8)]
    above = [bool(x >= found.threshold) for x in values]
    return above[-1] and above == sorted(above)


def _distance_covered(square: sp.Expr, found: Fit, ray: Ray) -> Any:
    """Roughly how far from the singular place the threshold lies: squares grow like k r^2 with different k."""
    r = mp.mpf("1e-6")
    return found.threshold / value(square, ray(random.Random(1))(r)) * r**2
