"""The words of the language: constants and functions, with the shapes they take and give.

A shape is () for a scalar, (n,) for a vector, (m, n) for a matrix. What a word means is defined twice, independently:
in `derive/scalarise.py` for sympy and in `audit/second_reading.py` for CasADi.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

Shape = tuple[int, ...]
TRUTH: Shape = (-1,)  # the "shape" of a comparison
MAX_MATRIX = 8  # rows of a matrix of which functions are taken

CONSTANTS = {
    "pi": "the circle constant",
    "eps": "the rounding unit of the numbers in use (2^-52 in double precision)",
    "infinity": "without bound; only as an injectivity radius or a diameter",
}


@dataclass(frozen=True)
class Word:
    """A function: how it is written, what it is, and its shape rule (None when the arguments do not fit)."""

    signature: str
    meaning: str
    arity: tuple[int, ...]
    shape: Callable[..., Shape | None]


def _elementwise(x: Shape) -> Shape | None:
    return x if len(x) <= 1 else None


def _scalars(*shapes: Shape) -> Shape | None:
    return () if all(s == () for s in shapes) else None


def _alike(x: Shape, y: Shape) -> Shape | None:
    return () if _entries(x) and x == y else None


def _to_scalar(x: Shape) -> Shape | None:
    return () if _entries(x) else None


def _entries(x: Shape) -> bool:
    return len(x) in (1, 2) and x != TRUTH


def _vector_to_scalar(x: Shape) -> Shape | None:
    return () if len(x) == 1 and x != TRUTH else None


def _square(x: Shape) -> Shape | None:
    return x if len(x) == 2 and x[0] == x[1] else None


def _symmetric(x: Shape) -> Shape | None:
    return x if _square(x) and x[0] <= MAX_MATRIX else None


def _triangle(diagonal: bool) -> Callable[[Shape], Shape | None]:
    """A square matrix to the vector of its entries above the diagonal, or on and above it."""

    def rule(x: Shape) -> Shape | None:
        if not _square(x) or (x[0] == 1 and not diagonal):
            return None
        return (x[0] * (x[0] + (1 if diagonal else -1)) // 2,)

    return rule


def _smat(x: Shape) -> Shape | None:
    n = (math.isqrt(8 * x[0] + 1) - 1) // 2 if len(x) == 1 and x != TRUTH else 0
    return (n, n) if n and n * (n + 1) // 2 == x[0] else None


def _ad_squared(x: Shape) -> Shape | None:
    pairs = _triangle(False)(x) if _symmetric(x) else None
    return pairs and pairs * 2


def _fixed(x: Shape, y: Shape) -> Callable[[Shape], Shape | None]:
    return lambda given: y if given == x else None


def _where(condition: Shape, x: Shape, y: Shape) -> Shape | None:
    return x if condition == TRUTH and x == y else None


def _wrap(x: Shape, period: Shape = ()) -> Shape | None:
    return x if len(x) <= 1 and period == () else None


def _scalar_function(name: str, meaning: str) -> Word:
    return Word(f"{name}(x)", f"{meaning}; of a vector, of each of its entries", (1,), _elementwise)


def _matrix_function(name: str, meaning: str) -> Word:
    return Word(f"{name}(A)", f"{meaning} of a symmetric matrix", (1,), _symmetric)


WORDS: dict[str, Word] = {
    "dot": Word("dot(a, b)", "the sum of the products of entries", (2,), _alike),
    "norm": Word("norm(a)", "sqrt(dot(a, a))", (1,), _to_scalar),
    "sum": Word("sum(a)", "the sum of the entries", (1,), _vector_to_scalar),
    "max": Word("max(a)", "the largest entry", (1,), _vector_to_scalar),
    "min": Word("min(a)", "the smallest entry", (1,), _vector_to_scalar),
    "cross": Word("cross(a, b)", "the vector product in R^3", (2,), lambda x, y: (3,) if x == y == (3,) else None),
    "outer": Word("outer(a, b)", "the matrix a_i b_j", (2,), lambda x, y: x + y if len(x) == len(y) == 1 else None),
    "qmul": Word(
        "qmul(a, b)", "the product of quaternions (w, x, y, z)", (2,), lambda x, y: (4,) if x == y == (4,) else None
    ),
    "conj": Word("conj(a)", "the conjugate quaternion (w, -x, -y, -z)", (1,), lambda x: x if x == (4,) else None),
    "transpose": Word("transpose(A)", "the transposed matrix", (1,), lambda x: x[::-1] if len(x) == 2 else None),
    "det": Word("det(A)", "the determinant", (1,), lambda x: () if _square(x) else None),
    "inv": Word("inv(A)", "the inverse matrix", (1,), _square),
    "trace": Word("trace(A)", "the sum of the entries on the diagonal", (1,), lambda x: () if _square(x) else None),
    "eye": Word("eye(n)", "the n x n unit matrix, n a constant", (1,), lambda x: None),  # its shape is in its value
    "above": Word("above(A)", "the entries above the diagonal of a square matrix, row by row", (1,), _triangle(False)),
    "upper": Word("upper(A)", "the entries on and above the diagonal of a square matrix", (1,), _triangle(True)),
    "svec": Word(
        "svec(A)",
        "the entries of upper(A), those off the diagonal times sqrt(2): |svec(A)| = |A|",
        (1,),
        _triangle(True),
    ),
    "smat": Word("smat(a)", "the symmetric matrix A with svec(A) = a, of n (n + 1) / 2 entries", (1,), _smat),
    "hat": Word("hat(a)", "the matrix of b -> cross(a, b)", (1,), _fixed((3,), (3, 3))),
    "vee": Word("vee(A)", "the vector a with hat(a) = A, A skew-symmetric", (1,), _fixed((3, 3), (3,))),
    "rotation": Word("rotation(q)", "the rotation matrix of a unit quaternion", (1,), _fixed((4,), (3, 3))),
    "quaternion": Word("quaternion(R)", "a unit quaternion of a rotation matrix", (1,), _fixed((3, 3), (4,))),
    "expm": _matrix_function("expm", "the exponential"),
    "logm": _matrix_function("logm", "the logarithm"),
    "sqrtm": _matrix_function("sqrtm", "the square root"),
    "invsqrtm": _matrix_function("invsqrtm", "the inverse of the square root"),
    "log_sinhc_sqrtm": _matrix_function("log_sinhc_sqrtm", "log(sinh(sqrt x) / sqrt x)"),
    "eigh": Word(
        "eigh(A)",
        "the eigenvalues of a symmetric matrix, ascending; only to be compared",
        (1,),
        lambda x: x[:1] if _symmetric(x) else None,
    ),
    "ad_squared": Word(
        "ad_squared(A)",
        "the matrix of X -> [A, [A, X]] on the entries above(X) of skew-symmetric X; A is symmetric",
        (1,),
        _ad_squared,
    ),
    "orthogonal": Word(
        "orthogonal(a)",
        "a unit vector at right angles to the unit vector a",
        (1,),
        lambda x: x if len(x) == 1 and x[0] > 1 else None,
    ),
    "where": Word("where(c, x, y)", "x where the comparison c holds, else y", (3,), _where),
    "wrap": Word("wrap(x) or wrap(x, L)", "x less the nearest multiple of the period L (2 pi)", (1, 2), _wrap),
    "atan2": Word("atan2(y, x)", "the angle of the point (x, y)", (2,), _scalars),
    "sqrt": _scalar_function("sqrt", "the square root"),
    "exp": _scalar_function("exp", "the exponential"),
    "log": _scalar_function("log", "the natural logarithm"),
    "sin": _scalar_function("sin", "the sine"),
    "cos": _scalar_function("cos", "the cosine"),
    "tan": _scalar_function("tan", "the tangent"),
    "sinh": _scalar_function("sinh", "the hyperbolic sine"),
    "cosh": _scalar_function("cosh", "the hyperbolic cosine"),
    "tanh": _scalar_function("tanh", "the hyperbolic tangent"),
    "asinh": _scalar_function("asinh", "the inverse hyperbolic sine"),
    "acos": _scalar_function("acos", "the arc cosine"),
    "acosh": _scalar_function("acosh", "the inverse hyperbolic cosine"),
    "atanh": _scalar_function("atanh", "the inverse hyperbolic tangent"),
    "abs": _scalar_function("abs", "the absolute value"),
    "sign": _scalar_function("sign", "1 for x >= 0, else -1 (never 0)"),
    "sinc": _scalar_function("sinc", "sin(x) / x, and 1 at 0"),
    "sinhc": _scalar_function("sinhc", "sinh(x) / x, and 1 at 0"),
}
