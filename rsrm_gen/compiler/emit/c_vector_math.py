"""Elementary functions of vectors in generated C, inlined: a call would cost more than most of them compute.

The polynomials are fitted here, when code is generated: interpolation at Chebyshev's points in 40 digits, which is within
a small factor of the best. Denormal numbers count as zero.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import lru_cache

import mpmath as mp

from rsrm_gen.compiler.emit.c_language import horner
from rsrm_gen.compiler.emit.c_precision import FLOAT, Precision
from rsrm_gen.compiler.emit.c_vector import spelled

DIGITS = 40

BY_LANES = """
/* {name} of every lane; one instruction where the machine has it. */
INLINE vector@ vector_{name}@(vector@ x) {{
    for (size_t i = 0; i < LANES@; ++i) LANE(x, i) = {function}%(LANE(x, i));
    return x;
}}"""

BITS = """
/* The bits of a vector as integers, and back. */
INLINE vector_mask@ vector_bits@(vector@ x) {
    vector_mask@ bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}
INLINE vector@ vector_from_bits@(vector_mask@ bits) {
    vector@ x;
    memcpy(&x, &bits, sizeof x);
    return x;
}"""

# 2^k: k is the last bits of x / log 2 + magic, where magic is so large that nothing is left behind the point; one half
# of the result is in the polynomial's sum, so that 2^(k - 1) is finite wherever the result is.
EXP = """
/* exp = 2^k exp(r), |r| <= log(2) / 2, within $UNITS units in the last place; below $TINY it is 0. */
INLINE vector@ vector_exp@(vector@ x) {
    const vector@ shifted = x * $INVERSE% + $MAGIC%, k = shifted - $MAGIC%;
    const vector@ r = (x - k * $HIGH%) - k * $LOW%;
    const vector@ part = r + r * r * ($POLYNOMIAL);
    const vector@ scale = vector_from_bits@((vector_bits@(shifted) + $BIAS) << $BITS); /* 2^(k - 1) */
    const vector@ y = vector_select@(x > $LARGEST%, vector_of@($INFINITY), (scale + scale * part) * 2);
    return vector_select@(x < $SMALLEST%, vector_of@(0), y);
}"""

# As fdlibm writes it: log(1 + f) = f - (f^2 / 2 - s (f^2 / 2 + R(s^2))) with s = f / (2 + f).
LOG = """
/* log = k log 2 + log m, sqrt(1/2) <= m < sqrt(2), within $UNITS units in the last place. */
INLINE vector@ vector_log@(vector@ x) {
    const vector_mask@ bits = vector_bits@(x), shift = (bits - $HALF) >> $BITS;
    const vector@ k = vector_from_bits@(shift + $MAGICBITS) - $MAGIC%;
    const vector@ f = vector_from_bits@(bits - (shift << $BITS)) - 1, s = f / (2 + f), z = s * s;
    const vector@ half = f * f * 0.5%;
    const vector@ rest = z * ($POLYNOMIAL);
    const vector@ y = k * $HIGH% - ((half - (s * (half + rest) + k * $LOW%)) - f);
    const vector@ finite = vector_select@(x > $SMALLEST%, y, vector_select@(x < 0, vector_of@(NAN), vector_of@(-$INFINITY)));
    return vector_select@(x <= $LARGEST%, finite, x);
}"""


@lru_cache
def fitted(function: Callable[[mp.mpf], mp.mpf], degree: int, low: str, high: str) -> tuple[float, ...]:
    """The polynomial of a degree that equals a function at Chebyshev's points of an interval, lowest power first."""
    with mp.workdps(DIGITS):
        a, b, n = mp.mpf(low), mp.mpf(high), degree + 1
        points = [(a + b) / 2 + (b - a) / 2 * mp.cos(mp.pi * (2 * k + 1) / (2 * n)) for k in range(n)]
        powers = mp.matrix([[x**j for j in range(n)] for x in points])
        return tuple(float(c) for c in mp.lu_solve(powers, mp.matrix([function(x) for x in points])))


def functions(names: Iterable[str], precision: Precision) -> list[str]:
    """The functions that are called, and those that they call, in order."""
    wanted = [name for name in ORDER if name in _with_needs(names)]
    return [spelled(ORDER[name](precision), precision) for name in wanted]


def _with_needs(names: Iterable[str]) -> set[str]:
    found: set[str] = set()
    left = [{"root": "sqrt"}.get(name, name) for name in names]
    while left:
        name = left.pop()
        if name not in found:
            found.add(name)
            left += NEEDS.get(name, ())
    return found


def _replaced(text: str, precision: Precision, **parts: str) -> str:
    single = precision is FLOAT
    common = {
        "BITS": "23" if single else "52",
        "INFINITY": "HUGE_VALF" if single else "HUGE_VAL",
    }
    for name, part in {**parts, **common}.items():
        text = text.replace(f"${name}", part)
    return text


def _polynomial(
    function: Callable[[mp.mpf], mp.mpf], degree: int, low: str, high: str, x: str, precision: Precision
) -> str:
    coefficients = fitted(function, degree, low, high)
    return horner([repr(c) + precision.suffix for c in coefficients], x)


def _split(value: mp.mpf, bits: int) -> tuple[str, str]:
    """A number as the sum of one with few bits, which integers of that size may multiply exactly, and the rest."""
    scale = mp.mpf(2) ** (bits - 1 - mp.floor(mp.log(abs(value), 2)))
    high = mp.nint(value * scale) / scale
    return repr(float(high)), repr(float(value - high))


def _exp(precision: Precision) -> str:
    single = precision is FLOAT
    with mp.workdps(DIGITS):
        high, low = _split(mp.log(2), 15 if single else 40)
        inverse = repr(float(1 / mp.log(2)))
    polynomial = _polynomial(_exp_rest, 4 if single else 9, "-0.3466", "0.3466", "r", precision)
    return _replaced(
        EXP,
        precision,
        UNITS="1",
        TINY="1.6e-38" if single else "3e-308",
        INVERSE=inverse,
        MAGIC="12582912.0" if single else "6755399441055744.0",
        HIGH=high,
        LOW=low,
        POLYNOMIAL=polynomial,
        BIAS="126" if single else "1022",
        LARGEST="88.722839" if single else "709.782712893384",
        SMALLEST="-86.9" if single else "-707.9",
    )


def _exp_rest(r: mp.mpf) -> mp.mpf:
    return mp.hyp1f1(1, 3, r) / 2  # (exp(r) - 1 - r) / r^2


def _log(precision: Precision) -> str:
    single = precision is FLOAT
    with mp.workdps(DIGITS):
        high, low = _split(mp.log(2), 15 if single else 40)
    polynomial = _polynomial(_log_rest, 3 if single else 7, "0", "0.02945", "z", precision)
    return _replaced(
        LOG,
        precision,
        UNITS="1",
        HALF="0x3f3504f3" if single else "0x3fe6a09e667f3bcd",
        MAGICBITS="0x4b400000" if single else "0x4338000000000000",
        MAGIC="12582912.0" if single else "6755399441055744.0",
        HIGH=high,
        LOW=low,
        POLYNOMIAL=polynomial,
        SMALLEST="1.17549421e-38" if single else "2.2250738585072009e-308",
        LARGEST="3.4028234663852886e38" if single else "1.7976931348623157e308",
    )


def _log_rest(z: mp.mpf) -> mp.mpf:
    """(log((1 + s) / (1 - s)) / s - 2) / z with z = s^2."""
    if z < mp.mpf(10) ** -12:
        return mp.mpf(2) / 3 + 2 * z / 5
    s = mp.sqrt(z)
    return (mp.log((1 + s) / (1 - s)) / s - 2) / z


def _lanes(name: str, function: str) -> Callable[[Precision], str]:
    return lambda precision: BY_LANES.format(name=name, function=function)


ATAN2 = """
/* atan2 of every lane. */
INLINE vector@ vector_atan2@(vector@ y, vector@ x) {
    for (size_t i = 0; i < LANES@; ++i) LANE(y, i) = atan2%(LANE(y, i), LANE(x, i));
    return y;
}"""

NEEDS = {"exp": ("bits",), "log": ("bits",)}
ORDER: dict[str, Callable[[Precision], str]] = {
    "bits": lambda precision: BITS,
    "abs": _lanes("abs", "fabs"),
    "round": _lanes("round", "rint"),
    "sqrt": _lanes("sqrt", "sqrt"),
    "exp": _exp,
    "log": _log,
    **{
        name: _lanes(name, name)
        for name in ("sin", "cos", "tan", "sinh", "cosh", "tanh", "asinh", "acosh", "acos", "atanh")
    },
    "atan2": lambda precision: ATAN2,
}
