"""Manifolds of constant curvature as quadrics: Log is one function of one number times a linear map of the query.

On the points of a quadric <x, x> = 1 (a unit sphere, a unit hyperboloid, unit quaternions) with c = <mu, x>,

    Log_mu(x) = a (tangent part of x at mu),     |det D Log_mu(x)| = a^power,
    a = A(w) / w,  w = sqrt((1 + c) / 2),        or, where x and -x are one point,  a = sign(c) A(w),  w = |c|,
    A(w) = acos(w) / sqrt(1 - w^2),              which is analytic for all w > -1: 1 at w = 1, acosh(w) / sqrt(w^2 - 1) beyond.

No name of a manifold enters: that it is so is found by comparison, in 60 digits, at random pairs of points. Sums over many
pairs of points and splats are computed in this form; single functions keep the author's.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from functools import cache
from typing import Any

import mpmath as mp
import sympy as sp

from rsrm_gen.compiler.derive.closed_form import rational
from rsrm_gen.compiler.derive.geometry import Function, Geometry, Radial
from rsrm_gen.compiler.derive.numeric import DIGITS, TINY, largest, run
from rsrm_gen.compiler.derive.sampling import Sampler, sampler_of
from rsrm_gen.compiler.derive.scalarise import constraint_of
from rsrm_gen.compiler.derive.series import ERROR, interpolated
from rsrm_gen.compiler.spec import ManifoldSpec

PAIRS = 6  # of points, at which the form is compared
NEAR = sp.Rational(5, 4)  # w up to which polynomials stand for A on a hyperboloid: cosh(r / 2), r = 1.39


def radial(geometry: Geometry) -> Radial | None:
    """The radial form of a manifold, if it has one."""
    spec = geometry.spec
    if not isinstance(spec, ManifoldSpec) or spec.constraint is None:
        return None
    with mp.workdps(DIGITS):
        form = _form(constraint_of(spec), spec.point_size)
        return _Search(geometry, form).found() if form else None


def _form(constraint: Function, size: int) -> list[list[Any]] | None:
    """The matrix F of a constraint that is k (x . F x - 1) for some k; None for any other."""
    if len(constraint.results) != 1:
        return None

    def at(*indices: int) -> Any:
        return run(constraint, [mp.mpf(indices.count(i)) for i in range(size)])[0][0]

    zero = at()
    if not mp.isfinite(zero) or abs(zero) < TINY:
        return None
    form = [[(at(i, j) - at(i) - at(j) + zero) / (-2 * zero) for j in range(size)] for i in range(size)]
    sampler = random.Random(5)
    for _ in range(2):  # is it quadratic at all?
        x = [mp.mpf(sampler.gauss(0, 1)) for _ in range(size)]
        if not abs(run(constraint, x)[0][0] / zero - 1 + _product(form, x, x)) < TINY:
            return None
    return form


def _product(form: Sequence[Sequence[Any]], x: Sequence[Any], y: Sequence[Any]) -> Any:
    return mp.fsum(a * f * b for a, row in zip(x, form, strict=True) for f, b in zip(row, y, strict=True))


class _Search:
    """Compares the functions of a manifold with the radial form."""

    def __init__(self, geometry: Geometry, form: list[list[Any]]) -> None:
        self.geometry = geometry
        self.form = form
        self.places = [self.seen(p, q) for p, q in self.pairs(sampler_of(geometry))]

    def pairs(self, sampler: Sampler) -> Iterator[tuple[list[Any], list[Any]]]:
        rng = random.Random(4)
        for k in range(PAIRS):
            p, q = sampler.pair(rng, sampler.reach * (mp.mpf(3 * k + 1) / (2 * PAIRS)))
            yield p, q
            if "other_name" in self.geometry:
                yield p, run(self.geometry["other_name"], q)[0]

    def seen(self, p: list[Any], q: list[Any]) -> tuple[Any, Any, Any]:
        """c, a and log |det D Log| of a pair; a is NaN where Log is no multiple of the tangent part of q."""
        v = run(self.geometry["log"], p, q)[0]
        tangent = run(self.geometry["to_tangent"], p, q)[0]
        square = mp.fsum(x * x for x in tangent)
        a = mp.fsum(x * y for x, y in zip(v, tangent, strict=True)) / square if square > TINY else mp.nan
        if not largest(x - a * y for x, y in zip(v, tangent, strict=True)) < TINY * largest(v):
            a = mp.nan
        return _product(self.form, p, q), a, run(self.geometry["log_abs_det"], p, q)[0][0]

    def found(self) -> Radial | None:
        """The form, when all pairs have it."""
        unbounded = all(c > 1 for c, _, _ in self.places)
        for folded in (False, True):
            if all(self.agrees(c, a, folded) for c, a, _ in self.places):
                power = self.power()
                numbers = [[rational(x) for x in row] for row in self.form]
                if power is None or any(x is None for row in numbers for x in row):
                    return None
                exact = tuple(
                    tuple(sp.Rational(x.numerator, x.denominator) for x in row if x is not None) for row in numbers
                )
                return Radial(exact, folded, unbounded, power)
        return None

    @staticmethod
    def agrees(c: Any, a: Any, folded: bool) -> bool:
        """Whether a is the function of c that it should be."""
        if folded:
            return bool(abs(c) <= 1 and abs(a - mp.sign(c) * ratio(abs(c))) < TINY)
        w = mp.sqrt((1 + c) / 2)
        return bool(c > -1 and abs(a - ratio(w) / w) < TINY)

    def power(self) -> int | None:
        """The whole number k with log |det D Log| = k log |a| at all pairs."""
        _, a, log_det = self.places[0]
        power = int(mp.nint(log_det / mp.log(abs(a))))
        alike = all(abs(log_det - power * mp.log(abs(a))) < TINY for _, a, log_det in self.places)
        return power if alike else None


def ratio(w: Any) -> Any:
    """A(w) = acos(w) / sqrt(1 - w^2), by its continuation where w > 1."""
    if w == 1:
        return mp.mpf(1)
    return mp.acos(w) / mp.sqrt(1 - w * w) if w < 1 else mp.acosh(w) / mp.sqrt(w * w - 1)


Coefficients = tuple[sp.Float, ...]


@cache
def profile(unbounded: bool) -> tuple[Coefficients, Coefficients]:
    """The derivative in w of log A, and the derivative of that, as polynomials with a relative error below 2^-56.

    Of 1 - w on [0, 1]; for `unbounded`, of (w - 1) / (NEAR - 1) on [0, 1]: around w = 1, where no terms cancel.
    """

    def place(t: Any) -> Any:
        t = max(t, mp.mpf(10) ** -18)  # at w = 1 itself, the derivatives are 0 / 0
        return 1 + t * (NEAR - 1).p / (NEAR - 1).q if unbounded else 1 - t

    with mp.workdps(2 * DIGITS):  # for 0 / 0 close to w = 1
        return _shortest(lambda t: _slope(place(t))), _shortest(lambda t: _slope_of_slope(place(t)))


def _slope(w: Any) -> Any:
    """d log A / dw, from (1 - w^2) A' = w A - 1."""
    return (w - 1 / ratio(w)) / (1 - w * w)


def _slope_of_slope(w: Any) -> Any:
    slope = _slope(w)
    return (1 + 2 * w * slope + slope / ratio(w)) / (1 - w * w)


def _shortest(function: Any) -> Coefficients:
    """The polynomial of the lowest degree on [0, 1] with a relative error below 2^-56."""
    tests = [mp.mpf(k) / 40 for k in range(41)]
    truth = [function(t) for t in tests]

    def fits(degree: int) -> bool:
        coefficients = interpolated(function, degree)[::-1]
        return bool(largest(mp.polyval(coefficients, t) / y - 1 for t, y in zip(tests, truth, strict=True)) < ERROR)

    low, high = 3, 32  # the lowest degree is in (low, high]
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if fits(middle) else (middle, high)
    return tuple(sp.Float(c, 30) for c in interpolated(function, high))
