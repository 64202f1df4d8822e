"""Polynomials that stand for an expression near its removable singularity, with a threshold from their error."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any

import mpmath as mp
import sympy as sp

from rsrm_gen.compiler.derive.geometry import Polynomial
from rsrm_gen.compiler.derive.numeric import DIGITS, largest

MAX_DEGREE = 14
TESTS = 10
ERROR = mp.mpf(2) ** -56  # relative: a sixteenth of the rounding unit in double precision
SHRINK = mp.mpf("0.8")

Curve = Callable[[Any], tuple[Any, Any]]


@dataclass(frozen=True)
class Fit:
    """y ~ x^order * (c0 + c1 u + ...), u = x / threshold, on [0, threshold], with the largest relative error measured.

    In u the coefficients are of the order of y, whatever the units of length are.
    """

    order: int
    coefficients: tuple[sp.Float, ...]
    threshold: sp.Rational
    error: float

    def __call__(self, variable: sp.Expr) -> sp.Expr:
        """The polynomial of a variable."""
        return variable**self.order * Polynomial(variable / self.threshold, *self.coefficients)


def fit(curve: Curve, reach: Any, order: int) -> Fit | None:
    """Fit y(x) along a curve r -> (x, y), with x ~ r^2 at 0, on the longest r-interval on which it is exact enough.

    `reach` is the r to begin with. Interpolates y / x^order in Chebyshev points (in r^2, so nearly in x) with 60 digits,
    by a polynomial of the lowest degree that is exact enough.
    """
    curve = cache(curve)  # polynomials of several degrees are tried against the same points
    with mp.workdps(DIGITS):
        for _ in range(24):
            found = _fit_to(curve, reach, order, MAX_DEGREE)
            if found is not None and found.error <= ERROR:
                return _of_lowest_degree(curve, reach, order, found)
            reach *= SHRINK
    return None


def _of_lowest_degree(curve: Curve, reach: Any, order: int, best: Fit) -> Fit:
    low, high = 2, MAX_DEGREE  # the lowest degree is in (low, high]
    while high - low > 1:
        middle = (low + high) // 2
        found = _fit_to(curve, reach, order, middle)
        if found is not None and found.error <= ERROR:
            high, best = middle, found
        else:
            low = middle
    return best


def _fit_to(curve: Curve, reach: Any, order: int, degree: int) -> Fit | None:
    nodes = [reach * mp.sqrt((1 + mp.cos(mp.pi * (k + mp.mpf(1) / 2) / (degree + 1))) / 2) for k in range(degree + 1)]
    points = [curve(r) for r in nodes]
    if not all(mp.isfinite(x) and mp.isfinite(y) and x > 0 for x, y in points) or len({x for x, _ in points}) <= degree:
        return None
    coefficients = _interpolate([x for x, _ in points], [y / x**order for x, y in points])
    tests = [curve(reach * mp.sqrt(mp.mpf(k) / TESTS)) for k in range(1, TESTS + 1)]
    if any(y == 0 for _, y in tests):
        return None
    errors = [mp.polyval(coefficients[::-1], x) * x**order / y - 1 for x, y in tests]
    threshold = sp.Rational(mp.nstr(points[0][0], 6))  # exact, for exact is what it divides
    scale = mp.mpf(threshold.p) / threshold.q
    scaled = tuple(sp.Float(c * scale**k, 30) for k, c in enumerate(coefficients))
    return Fit(order, scaled, threshold, float(largest(errors)))


def interpolated(function: Callable[[Any], Any], degree: int) -> list[Any]:
    """The polynomial on [0, 1] that agrees with a function in Chebyshev points, lowest coefficient first."""
    nodes = [(1 + mp.cos(mp.pi * (k + mp.mpf(1) / 2) / (degree + 1))) / 2 for k in range(degree + 1)]
    return _interpolate(nodes, list(map(function, nodes)))


def _interpolate(x: list[Any], y: list[Any]) -> list[Any]:
    """Monomial coefficients of the polynomial through the points, lowest first (Newton's divided differences)."""
    newton = list(y)
    for level in range(1, len(x)):
        for i in range(len(x) - 1, level - 1, -1):
            newton[i] = (newton[i] - newton[i - 1]) / (x[i] - x[i - level])
    coefficients = [newton[-1]]
    for i in range(len(x) - 2, -1, -1):
        shifted = [mp.mpf(0), *coefficients]
        coefficients = [a - x[i] * b for a, b in zip(shifted, [*coefficients, mp.mpf(0)], strict=True)]
        coefficients[0] += newton[i]
    return coefficients


EVEN: dict[str, Callable[[Any], Any]] = {
    "sinc": lambda r: mp.sin(r) / r,
    "sinhc": lambda r: mp.sinh(r) / r,
    "cos": mp.cos,
    "cosh": mp.cosh,
}


@cache
def even_series(name: str) -> Fit:
    """An even function of r as a polynomial in r^2."""
    evaluate = EVEN[name]
    found = fit(lambda r: (r**2, evaluate(r)), mp.mpf(1), 0)
    assert found is not None  # all are entire functions
    return found
