"""Functions in high precision that stay quick at any argument.

exp(exp(exp(50))) has more digits than a machine has memory, and the sine of a number of a million digits needs all of
them. Such numbers are beyond every floating-point format: they count as infinite here, and have no sine.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import mpmath as mp

EXPONENTIAL_BITS = 64  # exp of 2^64 has an exponent beyond every format
PERIODIC_BITS = 4096  # the precision that a sine takes to bring its argument into a period

Function = Callable[[Any], Any]


def _bounded(function: Function, bits: int, beyond: Function) -> Function:
    """The function; where its argument is 2^bits or more, `beyond` of it."""

    def bounded(x: Any) -> Any:
        if isinstance(x, mp.mpc) and max(_bits(x.real), _bits(x.imag)) > bits:
            return mp.nan
        return beyond(x) if isinstance(x, mp.mpf) and _bits(x) > bits else function(x)

    return bounded


def _bits(x: Any) -> int:
    """The number b with 2^(b-1) <= |x| < 2^b; small for zero and for what is not finite."""
    _, mantissa, exponent, length = x._mpf_
    return int(exponent + length) if mantissa else 0


def _nowhere(x: Any) -> Any:
    return mp.nan


exp = _bounded(mp.exp, EXPONENTIAL_BITS, lambda x: mp.inf if x > 0 else mp.mpf(0))
sinh = _bounded(mp.sinh, EXPONENTIAL_BITS, lambda x: mp.inf * mp.sign(x))
cosh = _bounded(mp.cosh, EXPONENTIAL_BITS, lambda x: mp.inf)
tanh = _bounded(mp.tanh, EXPONENTIAL_BITS, mp.sign)
sin = _bounded(mp.sin, PERIODIC_BITS, _nowhere)
cos = _bounded(mp.cos, PERIODIC_BITS, _nowhere)
tan = _bounded(mp.tan, PERIODIC_BITS, _nowhere)
