"""Elementary functions of vectors in generated C, inlined: a call would cost more than most of them compute.

The polynomials are fitted here, when code is generated: interpolation at Chebyshev's points in 40 digits, which is within
a small factor of the best. Denormal numbers count as zero.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from functools import lru_cache

import mpmath as mp

from rsrm_gen.compiler.emit.c_language import horner
from rsrm_gen.compiler.emit.c_precision import FLOAT, Precision
from rsrm_gen.compiler.emit.c_vector import spelled

DIGITS = 40

BY_LANES = """
/* {name} of every lane; one instruction where the machine has it. */
INLINE vector@ {name}_each@(vector@ x) {{
    EACH_LANE for (size_t i = 0; i < LANES@; ++i) LANE(x, i) = {function}%(LANE(x, i));
    return x;
}}"""

BITS = """
/* The bits of a vector as integers, and back. */
INLINE vector_bits@ vector_to_bits@(vector@ x) {
    vector_bits@ bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}
INLINE vector@ vector_from_bits@(vector_bits@ bits) {
    vector@ x;
    memcpy(&x, &bits, sizeof x);
    return x;
}"""

# Two additions, of which the first often is one with a multiplication, where the machine's own instruction is two more.
ROUND = """
/* round to even, of numbers below $ENOUGH; of larger ones, a whole number close by. */
INLINE vector@ round_each@(vector@ x) { return (x + $MAGIC%) - $MAGIC%; }"""

# 2^k: k is the last bits of x / log 2 + magic, where magic is so large that nothing is left behind the point. It is
# made as twice 2^(k - 1), which is finite wherever the result is.
EXP = """
/* exp = 2^k exp(r), |r| <= log(2) / 2, within 1 unit in the last place; below $TINY it is 0. */
INLINE vector@ exp_each@(vector@ x) {
    const vector@ shifted = x * $INVERSE% + $MAGIC%, k = shifted - $MAGIC%;
    const vector@ r = (x - k * $HIGH%) - k * $LOW%;
    const vector@ part = r + r * r * ($POLYNOMIAL);
    const vector@ scale = vector_from_bits@((vector_to_bits@(shifted) + $BIAS) << $BITS); /* 2^(k - 1) */
    const vector@ y = vector_select@(x > $LARGEST%, vector_of@($INFINITY), (scale + scale * part) * 2);
    return vector_select@(x < $SMALLEST%, vector_of@(0), y);
}"""

# The same where the argument is -s / 2 and never above 0: no overflow, and 2^k at once. The bias of exponents is in the
# magic number; what is rounded is r = -2 (argument - k log 2).
GAUSSIAN = """
/* exp(-s / 2) of s >= 0, as 2^k exp(-r / 2), |r| <= log(2), within 1 unit in the last place; below $TINY it is 0. */
INLINE vector@ gaussian_each@(vector@ s) {
    const vector@ shifted = s * $HALFINVERSE% + $MAGIC%, k = shifted - $MAGIC%;
    const vector@ r = (s + k * $HIGH%) + k * $LOW%;
    const vector@ part = r * ($POLYNOMIAL);
    const vector@ scale = vector_from_bits@(vector_to_bits@(shifted) << $BITS); /* 2^k */
    return vector_select@(s > $FAR%, vector_of@(0), scale + scale * part);
}"""

# As fdlibm writes it: log(1 + f) = f - (f^2 / 2 - s (f^2 / 2 + R(s^2))) with s = f / (2 + f). The exponent of x / sqrt(1/2)
# is read from bits.
LOG = """
/* log = k log 2 + log m, sqrt(1/2) <= m < sqrt(2), within 1 unit in the last place. */
INLINE vector@ log_each@(vector@ x) {
    const vector_bits@ bits = vector_to_bits@(x), biased = (bits + $SHIFT) >> $BITS; /* k + $BIAS */
    const vector@ k = vector_from_bits@(biased + $MAGICBITS) - $MAGICBIAS%;
    const vector@ f = vector_from_bits@(bits - (biased << $BITS) + $ONE) - 1, s = f / (2 + f), z = s * s;
    const vector@ half = f * f * 0.5%;
    const vector@ rest = z * ($POLYNOMIAL);
    const vector@ y = k * $HIGH% - ((half - (s * (half + rest) + k * $LOW%)) - f);
    const vector@ small = vector_select@(x < 0, vector_of@(NAN), vector_of@(-$INFINITY));
    const vector@ finite = vector_select@(x > $SMALLEST%, y, small);
    return vector_select@(x <= $LARGEST%, finite, x);
}"""


# 1 + x is rounded; what that loses is put back: log(1 + x) = log(u) + (x - (u - 1)) / u.
LOG1P = """
/* log(1 + x), within 2 units in the last place. */
INLINE vector@ log1p_each@(vector@ x) {
    const vector@ u = 1 + x;
    return vector_select@(x <= $LARGEST%, log_each@(u) + (x - (u - 1)) / u, x);
}"""

EXPM1 = """
/* exp(x) - 1 = (2^k - 1) + 2^k (exp(r) - 1) for |x| < $LIMIT, within 2 units in the last place. */
INLINE vector@ expm1_each@(vector@ x) {
    const vector@ shifted = x * $INVERSE% + $MAGIC%, k = shifted - $MAGIC%;
    const vector@ r = (x - k * $HIGH%) - k * $LOW%;
    const vector@ part = r + r * r * ($POLYNOMIAL);
    const vector@ scale = vector_from_bits@((vector_to_bits@(shifted) + $BIAS) << $BITS); /* 2^k */
    return (scale - 1) + scale * part;
}"""

SIGNED = """
/* x >= 0 with the sign of another. */
INLINE vector@ signed_each@(vector@ x, vector@ sign) {
    return vector_from_bits@(vector_to_bits@(x) | (vector_to_bits@(sign) & $SIGN));
}"""

# What is large is exp(|x| / 2)^2 / 2, in two steps that do not overflow before the result does.
SINH = """
/* sinh, within 3 units in the last place. */
INLINE vector@ sinh_each@(vector@ x) {
    const vector@ a = abs_each@(x), half = exp_each@(a * 0.5%);
    const vector@ e = expm1_each@(vector_select@(a > $FAR%, vector_of@($FAR%), a));
    return signed_each@(vector_select@(a > $FAR%, half * 0.5% * half, (e + e / (e + 1)) * 0.5%), x);
}"""

COSH = """
/* cosh, within 3 units in the last place. */
INLINE vector@ cosh_each@(vector@ x) {
    const vector@ a = abs_each@(x), half = exp_each@(a * 0.5%);
    const vector@ e = exp_each@(a);
    return vector_select@(a > $FAR%, half * 0.5% * half, e * 0.5% + 0.5% / e);
}"""

TANH = """
/* tanh, within 3 units in the last place. */
INLINE vector@ tanh_each@(vector@ x) {
    const vector@ a = abs_each@(x), e = expm1_each@(vector_select@(a > $ONE%, vector_of@($ONE%), a) * 2);
    return signed_each@(vector_select@(a > $ONE%, vector_of@(1), e / (e + 2)), x);
}"""

ASINH = """
/* asinh, within 3 units in the last place. */
INLINE vector@ asinh_each@(vector@ x) {
    const vector@ a = abs_each@(x), square = a * a;
    const vector@ near = log1p_each@(a + square / (1 + sqrt_each@(1 + square)));
    return signed_each@(vector_select@(a > $FAR%, log_each@(a) + $LOG2%, near), x);
}"""

ACOSH = """
/* acosh, within 3 units in the last place. */
INLINE vector@ acosh_each@(vector@ x) {
    const vector@ t = x - 1, near = log1p_each@(t + sqrt_each@(2 * t + t * t));
    return vector_select@(x > $FAR%, log_each@(x) + $LOG2%, near);
}"""

ATANH = """
/* atanh, within 3 units in the last place. */
INLINE vector@ atanh_each@(vector@ x) {
    const vector@ a = abs_each@(x);
    return signed_each@(0.5% * log1p_each@(2 * a / (1 - a)), x);
}"""

# Cody and Waite: pi/2 in three parts, of which integers up to the limit multiply the first two exactly.
SINCOS = """
/* $NAME: x = k pi/2 + r, |r| <= pi/4, within 2 units in the last place; beyond $LIMIT, by the library. */
INLINE vector@ $NAME_each@(vector@ x) {
    const vector@ shifted = x * $INVERSE% + $MAGIC%, k = shifted - $MAGIC%;
    const vector@ r = ((x - k * $HIGH%) - k * $MIDDLE%) - k * $LOW%, z = r * r;
    const vector_bits@ quarter = vector_to_bits@(shifted)$ADD;
    const vector@ sine = r + r * z * ($SINE);
    const vector@ cosine = 1 - (0.5% * z - z * z * ($COSINE));
    const vector@ part = vector_select@((quarter & 1) == 0, sine, cosine);
    vector@ y = vector_from_bits@(vector_to_bits@(part) ^ ((quarter & 2) << $LAST));
    int far = 0;
    for (size_t i = 0; i < LANES@; ++i) far |= fabs%(LANE(x, i)) > $LIMIT%;
    if (far)
        for (size_t i = 0; i < LANES@; ++i) LANE(y, i) = $NAME%(LANE(x, i));
    return y;
}"""

# atan(t) for t = min / max of |x|, |y|, by pi/4 - atan((1 - t) / (1 + t)) where t is large; then by octants.
ATAN2 = """
/* atan2, within 3 units in the last place. */
INLINE vector@ atan2_each@(vector@ y, vector@ x) {
    const vector@ a = abs_each@(y), b = abs_each@(x), one = vector_of@(1);
    const vector@ less = vector_select@(a > b, b, a), more = vector_select@(a > b, a, b);
    const vector@ low = vector_select@(less > $LARGEST%, one, less);
    const vector@ high = vector_select@(less > $LARGEST%, one, vector_select@(more == 0, one, more));
    const vector@ top = vector_select@(low > $TANGENT% * high, low - high, low);
    const vector@ bottom = vector_select@(low > $TANGENT% * high, low * 0.5% + high * 0.5%, high * 0.5%);
    const vector@ t = top / bottom * 0.5%, z = t * t;
    const vector@ angle = t + t * z * ($POLYNOMIAL);
    const vector@ first = vector_select@(low > $TANGENT% * high, $QUARTER% + (angle + $QUARTERLOW%), angle);
    const vector@ second = vector_select@(a > b, $HALF% - (first - $HALFLOW%), first);
    const vector@ third = vector_select@((vector_to_bits@(x) & $SIGN) != 0, $WHOLE% - (second - $WHOLELOW%), second);
    return signed_each@(third, y);
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
        "SIGN": "0x80000000" if single else "0x8000000000000000",
        "LOG2": repr(math.log(2)),
        "LARGEST": "3.4028234663852886e38" if single else "1.7976931348623157e308",
        "INFINITY": "HUGE_VALF" if single else "HUGE_VAL",
    }
    known = {**common, **parts}
    for name in sorted(known, key=len, reverse=True):
        text = text.replace(f"${name}", known[name])
    return text


def _polynomial(
    function: Callable[[mp.mpf], mp.mpf], degree: int, low: str, high: str, x: str, precision: Precision
) -> str:
    coefficients = fitted(function, degree, low, high)
    return horner([repr(c) + precision.suffix for c in coefficients], x)


def _split(value: mp.mpf, bits: int) -> tuple[str, str]:
    """A number as the sum of one with few bits, which small integers multiply exactly, and the rest."""
    high, rest = _split_exactly(value, bits)
    return repr(float(high)), repr(float(rest))


def _split_exactly(value: mp.mpf, bits: int) -> tuple[mp.mpf, mp.mpf]:
    scale = mp.mpf(2) ** (bits - 1 - mp.floor(mp.log(abs(value), 2)))
    high = mp.nint(value * scale) / scale
    return high, value - high


def _exp(precision: Precision, text: str = EXP) -> str:
    single = precision is FLOAT
    with mp.workdps(DIGITS):
        high, low = _split(mp.log(2), 15 if single else 40)
        inverse = repr(float(1 / mp.log(2)))
    polynomial = _polynomial(_exp_rest, 4 if single else 9, "-0.3466", "0.3466", "r", precision)
    return _replaced(
        text,
        precision,
        TINY="1.6e-38" if single else "3e-308",
        INVERSE=inverse,
        MAGIC="12582912.0" if single else "6755399441055744.0",
        HIGH=high,
        LOW=low,
        POLYNOMIAL=polynomial,
        BIAS=str((127 if single else 1023) - (text is EXP)),
        LIMIT="80" if single else "700",
        LARGEST="88.722839" if single else "709.782712893384",
        SMALLEST="-86.9" if single else "-707.9",
    )


def _gaussian(precision: Precision) -> str:
    single = precision is FLOAT
    with mp.workdps(DIGITS):
        high, low = _split(2 * mp.log(2), 15 if single else 40)
        inverse = repr(float(-1 / (2 * mp.log(2))))
    rest = fitted(_gaussian_rest, 4 if single else 9, "-0.6932", "0.6932")
    return _replaced(
        GAUSSIAN,
        precision,
        TINY="1.8e-38" if single else "3.8e-308",
        HALFINVERSE=inverse,
        MAGIC="12583039.0" if single else "6755399441056767.0",
        HIGH=high,
        LOW=low,
        POLYNOMIAL=horner([repr(c) + precision.suffix for c in (-0.5, *rest)], "r"),
        FAR="173.8" if single else "1415.8",
    )


def _gaussian_rest(r: mp.mpf) -> mp.mpf:
    return mp.hyp1f1(1, 3, -r / 2) / 8  # (exp(-r / 2) - 1 + r / 2) / r^2


def _exp_rest(r: mp.mpf) -> mp.mpf:
    return mp.hyp1f1(1, 3, r) / 2  # (exp(r) - 1 - r) / r^2


def _log(precision: Precision) -> str:
    single = precision is FLOAT
    with mp.workdps(DIGITS):
        high, low = _split(mp.log(2), 15 if single else 40)
    one, half = (0x3F800000, 0x3F3504F3) if single else (0x3FF0000000000000, 0x3FE6A09E667F3BCD)
    return _replaced(
        LOG,
        precision,
        SHIFT=hex(one - half),
        ONE=hex(one),
        BIAS="127" if single else "1023",
        MAGICBITS="0x4b400000" if single else "0x4338000000000000",
        MAGICBIAS="12583039.0" if single else "6755399441056767.0",
        HIGH=high,
        LOW=low,
        POLYNOMIAL=_polynomial(_log_rest, 3 if single else 7, "0", "0.02945", "z", precision),
        SMALLEST="1.17549421e-38" if single else "2.2250738585072009e-308",
    )


def _sincos(name: str, precision: Precision) -> str:
    single = precision is FLOAT
    bits = 17 if single else 36
    with mp.workdps(DIGITS):
        high, rest = _split_exactly(mp.pi / 2, bits)
        middle, low = _split_exactly(rest, bits)
        inverse = repr(float(2 / mp.pi))
    return _replaced(
        SINCOS,
        precision,
        NAME=name,
        LIMIT="100.0" if single else "1e5",
        INVERSE=inverse,
        MAGIC="12582912.0" if single else "6755399441055744.0",
        HIGH=repr(float(high)),
        MIDDLE=repr(float(middle)),
        LOW=repr(float(low)),
        ADD=" + 1" if name == "cos" else "",
        LAST="30" if single else "62",
        SINE=_polynomial(_sine_rest, 3 if single else 6, "0", "0.6169", "z", precision),
        COSINE=_polynomial(_cosine_rest, 3 if single else 6, "0", "0.6169", "z", precision),
    )


def _sine_rest(z: mp.mpf) -> mp.mpf:
    """(sin(r) / r - 1) / r^2 with z = r^2."""
    return mp.nsum(lambda k: (-1) ** (k + 1) * z**k / mp.factorial(2 * k + 3), [0, 20])


def _cosine_rest(z: mp.mpf) -> mp.mpf:
    """(cos(r) - 1 + r^2 / 2) / r^4 with z = r^2."""
    return mp.nsum(lambda k: (-1) ** k * z**k / mp.factorial(2 * k + 4), [0, 20])


def _atan2(precision: Precision) -> str:
    single = precision is FLOAT
    bits = 24 if single else 53
    with mp.workdps(DIGITS):
        parts = {name: _split(mp.pi / n, bits) for name, n in (("QUARTER", 4), ("HALF", 2), ("WHOLE", 1))}
    return _replaced(
        ATAN2,
        precision,
        TANGENT="0.4142135623730951",
        POLYNOMIAL=_polynomial(_atan_rest, 5 if single else 11, "0", "0.17158", "z", precision),
        **{name: high for name, (high, _) in parts.items()},
        **{name + "LOW": low for name, (_, low) in parts.items()},
    )


def _atan_rest(z: mp.mpf) -> mp.mpf:
    """(atan(t) / t - 1) / t^2 with z = t^2."""
    t = mp.sqrt(z)
    return (mp.atan(t) / t - 1) / z


def _plain(text: str, single: Mapping[str, str], double: Mapping[str, str]) -> Callable[[Precision], str]:
    """A function whose parts are numbers."""
    return lambda precision: _replaced(text, precision, **(single if precision is FLOAT else double))


def _log_rest(z: mp.mpf) -> mp.mpf:
    """(log((1 + s) / (1 - s)) / s - 2) / z with z = s^2."""
    if z < mp.mpf(10) ** -12:
        return mp.mpf(2) / 3 + 2 * z / 5
    s = mp.sqrt(z)
    return (mp.log((1 + s) / (1 - s)) / s - 2) / z


def _lanes(name: str, function: str) -> Callable[[Precision], str]:
    return lambda precision: BY_LANES.format(name=name, function=function)


NEEDS = {
    "exp": ("bits",),
    "log": ("bits",),
    "log1p": ("log",),
    "gaussian": ("bits",),
    "expm1": ("bits",),
    "signed": ("bits",),
    "sinh": ("abs", "exp", "expm1", "signed"),
    "cosh": ("abs", "exp"),
    "tanh": ("abs", "expm1", "signed"),
    "asinh": ("abs", "log1p", "sqrt", "signed"),
    "acosh": ("log1p", "sqrt"),
    "atanh": ("abs", "log1p", "signed"),
    "sin": ("bits",),
    "cos": ("bits",),
    "atan2": ("abs", "signed"),
}
ORDER: dict[str, Callable[[Precision], str]] = {
    "bits": lambda precision: BITS,
    "signed": lambda precision: _replaced(SIGNED, precision),
    "abs": _lanes("abs", "fabs"),
    "round": _plain(
        ROUND, {"MAGIC": "12582912.0", "ENOUGH": "2^22"}, {"MAGIC": "6755399441055744.0", "ENOUGH": "2^51"}
    ),
    "sqrt": _lanes("sqrt", "sqrt"),
    "exp": _exp,
    "gaussian": _gaussian,
    "expm1": lambda precision: _exp(precision, EXPM1),
    "log": _log,
    "log1p": lambda precision: _replaced(LOG1P, precision),
    "sinh": _plain(SINH, {"FAR": "30.0"}, {"FAR": "40.0"}),
    "cosh": _plain(COSH, {"FAR": "30.0"}, {"FAR": "40.0"}),
    "tanh": _plain(TANH, {"ONE": "10.0"}, {"ONE": "20.0"}),
    "asinh": _plain(ASINH, {"FAR": "4096.0"}, {"FAR": "134217728.0"}),
    "acosh": _plain(ACOSH, {"FAR": "4096.0"}, {"FAR": "134217728.0"}),
    "atanh": lambda precision: _replaced(ATANH, precision),
    "sin": lambda precision: _sincos("sin", precision),
    "cos": lambda precision: _sincos("cos", precision),
    "atan2": _atan2,
    "tan": _lanes("tan", "tan"),
    "acos": _lanes("acos", "acos"),
}
