"""Real numbers of any precision as gmpy2 has them, several times as quick as mpmath's, and mpmath's made of them.

An operation rounds to nearest in the precision of the context in force; without a real value it gives NaN. There is one
zero. What is above 2^(2^30) is infinite, and what is below its inverse is zero: both are beyond every floating-point format.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from functools import lru_cache, reduce
from typing import Any

import gmpy2
import mpmath as mp
from mpmath import libmp

Real = Any  # gmpy2's mpfr
Raw = tuple[int, Any, int, int]  # mpmath's (sign, mantissa, exponent, bits), its numbers without their class

PERIODIC_BITS = 4096  # the sine of a larger number has as many digits of its argument to look at, maybe millions
NAN, ZERO = gmpy2.mpfr("nan"), gmpy2.mpfr(0)
HUGE = gmpy2.exp2(PERIODIC_BITS)


@lru_cache
def in_precision(bits: int) -> AbstractContextManager[Any]:
    """The context of operations that round to so many bits."""
    context: AbstractContextManager[Any] = gmpy2.context(precision=bits)
    return context


def from_mpmath(raw: Raw) -> Real:
    """A number of mpmath; exact if the precision in force has as many bits."""
    sign, mantissa, exponent, _ = raw
    if mantissa:
        return (-mantissa if sign else mantissa) * _power_of_two(exponent)
    return ZERO if raw == libmp.fzero else gmpy2.mpfr(libmp.to_float(raw))


@lru_cache(maxsize=4096)
def _power_of_two(exponent: int) -> Real:
    return gmpy2.exp2(exponent)


def to_mpmath(x: Real) -> Any:
    """The same number as mpmath's, unrounded."""
    try:
        mantissa, exponent = x.as_mantissa_exp()
        return mp.make_mpf(libmp.from_man_exp(mantissa, int(exponent)))
    except (ValueError, OverflowError):  # it is not finite
        return mp.mpf(float(x))


def divide(a: Real, b: Real) -> Real:
    """a / b; nothing is divided by zero."""
    return a / b if b else NAN


def power(base: Real, exponent: Real) -> Real:
    """base^exponent; zero has no negative powers."""
    if gmpy2.is_infinite(base) or gmpy2.is_infinite(exponent):
        return gmpy2.exp(exponent * gmpy2.log(base))
    return base**exponent if base or exponent >= 0 else NAN


def atan2(y: Real, x: Real) -> Real:
    """The angle of (x, y), which does not see the sign of a zero; there is none of two infinite numbers."""
    return NAN if gmpy2.is_infinite(x) and gmpy2.is_infinite(y) else gmpy2.atan2(y or ZERO, x or ZERO)


def sum_of(*terms: Real) -> Real:
    """The sum, rounded once."""
    return gmpy2.fsum(terms)


def product_of(*factors: Real) -> Real:
    """The product, rounded after every factor."""
    return reduce(gmpy2.mul, factors)


def polynomial(x: Real, *coefficients: Real) -> Real:
    """The sum of coefficients[i] x^i by Horner's rule."""
    total = coefficients[-1]
    for c in coefficients[-2::-1]:
        total = total * x + c
    return total


def _periodic(function: Callable[[Real], Real]) -> Callable[[Real], Real]:
    return lambda x: function(x) if -HUGE < x < HUGE else NAN


sin, cos, tan = _periodic(gmpy2.sin), _periodic(gmpy2.cos), _periodic(gmpy2.tan)


def widest(raws: Sequence[Raw]) -> int:
    """The most bits that one of some numbers of mpmath has."""
    return max((raw[3] for raw in raws), default=0)
