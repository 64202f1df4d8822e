"""Functions of mpmath's raw numbers that stay quick at any argument.

exp(exp(exp(50))) has more digits than a machine has memory, and the sine of a number of a million digits needs all of
them. Such numbers are beyond every floating-point format: they count as infinite here, and have no sine.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from mpmath import libmp

EXPONENTIAL_BITS = 64  # exp of 2^64 has an exponent beyond every format
PERIODIC_BITS = 4096  # the precision that a sine takes to bring its argument into a period

Raw = Any  # mpmath's (sign, mantissa, exponent, bits)
Function = Callable[[Raw, int, str], Raw]  # of a number, a precision and a rounding


def _bounded(function: Function, bits: int, above: Raw, below: Raw) -> Function:
    """The function; of an argument of 2^bits or more, the value `above`, and `below` of its negative."""

    def bounded(x: Raw, precision: int, rounding: str) -> Raw:
        sign, mantissa, exponent, length = x
        if mantissa and exponent + length > bits:
            return below if sign else above
        return function(x, precision, rounding)

    return bounded


exp = _bounded(libmp.mpf_exp, EXPONENTIAL_BITS, libmp.finf, libmp.fzero)
sinh = _bounded(libmp.mpf_sinh, EXPONENTIAL_BITS, libmp.finf, libmp.fninf)
cosh = _bounded(libmp.mpf_cosh, EXPONENTIAL_BITS, libmp.finf, libmp.finf)
tanh = _bounded(libmp.mpf_tanh, EXPONENTIAL_BITS, libmp.fone, libmp.fnone)
sin = _bounded(libmp.mpf_sin, PERIODIC_BITS, libmp.fnan, libmp.fnan)
cos = _bounded(libmp.mpf_cos, PERIODIC_BITS, libmp.fnan, libmp.fnan)
tan = _bounded(libmp.mpf_tan, PERIODIC_BITS, libmp.fnan, libmp.fnan)
