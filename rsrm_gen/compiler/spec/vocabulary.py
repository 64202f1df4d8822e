"""The words of the language: constants and functions, with the shapes they take and give.

A shape is () for a scalar, (n,) for a vector, (m, n) for a matrix. What a word means is defined twice, independently:
in `derive/scalarise.py` for sympy and in `audit/second_reading.py` for CasADi.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

Shape = tuple[int, ...]
TRUTH: Shape = (-1,)  # the "shape" of a comparison

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


def _same_vectors(x: Shape, y: Shape) -> Shape | None:
    return () if len(x) == 1 and x == y else None


def _vector_to_scalar(x: Shape) -> Shape | None:
    return () if len(x) == 1 else None


def _square(x: Shape) -> Shape | None:
    return x if len(x) == 2 and x[0] == x[1] else None


def _where(condition: Shape, x: Shape, y: Shape) -> Shape | None:
    return x if condition == TRUTH and x == y else None


def _wrap(x: Shape, period: Shape = ()) -> Shape | None:
    return x if len(x) <= 1 and period == () else None


def _scalar_function(name: str, meaning: str) -> Word:
    return Word(f"{name}(x)", f"{meaning}; of a vector, of each of its entries", (1,), _elementwise)


WORDS: dict[str, Word] = {
    "dot": Word("dot(a, b)", "the sum of the products of entries", (2,), _same_vectors),
    "norm": Word("norm(a)", "sqrt(dot(a, a))", (1,), _vector_to_scalar),
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
