"""The coefficient tables of a program: every polynomial once, under the name of what it approximates.

Single precision gets polynomials of its own: those of double precision, economised to the lowest degree at which they
still agree to an eighth of its rounding unit. All are in the scaled variable u in [0, 1].
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache

from rsrm_gen.compiler.derive.series import ERROR
from rsrm_gen.compiler.lower import Routine

Coefficients = tuple[object, ...]

SINGLE = Fraction(1, 2**27)  # relative: an eighth of the rounding unit of single precision
GRID = 256  # points at which a polynomial is bounded from below


@dataclass(frozen=True)
class Economised:
    """A polynomial of lower degree, and how far it is at most from the one it stands for, relative to that, on [0, 1]."""

    coefficients: tuple[float, ...]  # lowest first
    error: float

    @property
    def degree(self) -> int:
        """The highest power."""
        return len(self.coefficients) - 1

    @property
    def bits(self) -> str:
        """The error as a power of two, rounded up."""
        return _bits(self.error)


def _bits(error: float) -> str:
    return f"2^{math.ceil(math.log2(error))}" if error else "0"


def tables(routines: Iterable[Routine]) -> dict[Coefficients, str]:
    """Coefficients of polynomials to the names of their tables, in the order of their first use."""
    found: dict[Coefficients, str] = {}
    for routine in routines:
        names = {node: name for name, node in routine.body}
        for node in routine.nodes:
            if node.op == "polynomial" and node.value not in found:
                found[node.value] = _fresh(names.get(node, "series").upper(), found)  # type: ignore[index]
    return found


def _fresh(hint: str, found: dict[Coefficients, str]) -> str:
    name, count = hint, 1
    while name in found.values():
        count += 1
        name = f"{hint}_{count}"
    return name


def in_double(coefficients: Coefficients) -> tuple[float, ...]:
    """The coefficients, lowest first, as the nearest doubles."""
    return tuple(float(c.evalf(25)) for c in coefficients)  # type: ignore[attr-defined]


def spelled(coefficients: tuple[float, ...], suffix: str = "") -> list[str]:
    """Coefficients as literals that read back as the same doubles."""
    return [repr(c) + suffix for c in coefficients]


def described(name: str, coefficients: Coefficients) -> str:
    """The degree in double precision, and what it is exact to."""
    exact = "the derivative of a polynomial" if "_SLOPE" in name else f"its relative error below {_bits(float(ERROR))}"
    return f"of degree {len(coefficients) - 1} on [0, 1], {exact}"


def in_single(coefficients: Coefficients) -> Economised:
    """The polynomial for single precision."""
    return _economised(in_double(coefficients))


@lru_cache(maxsize=256)
def _economised(coefficients: tuple[float, ...]) -> Economised:
    """Lanczos economisation: take away the leading term as a multiple of a Chebyshev polynomial on [0, 1], again and again.

    T_n*(u) leads with 2^(2n-1) u^n and is at most 1, so that each step costs |c_n| / 2^(2n-1) at most. Exact arithmetic,
    so that machines agree on the digits.
    """
    left, taken = [Fraction(c) for c in coefficients], Fraction(0)
    least = _lower_bound(left)
    while len(left) > 2:
        n = len(left) - 1
        factor = left[n] / 2 ** (2 * n - 1)
        if not taken + abs(factor) <= SINGLE * least:
            break
        taken += abs(factor)
        left = [c - factor * t for c, t in zip(left, _chebyshev(n), strict=True)][:-1]
    return Economised(tuple(map(float, left)), float(taken / least) if taken else 0.0)


def _lower_bound(coefficients: list[Fraction]) -> Fraction:
    """A lower bound of |p| on [0, 1]: its least value on a grid, less what it can change between; 0 if p may vanish."""
    doubles = [float(c) for c in coefficients]
    values = []
    for k in range(GRID + 1):
        total = 0.0
        for c in reversed(doubles):
            total = total * (k / GRID) + c
        values.append(total)
    if min(values) < 0 < max(values):
        return Fraction(0)
    change = sum((abs(k * c) for k, c in enumerate(coefficients)), Fraction(0)) / (2 * GRID)
    return max(Fraction(0), Fraction(min(map(abs, values))) - change)


@lru_cache
def _chebyshev(n: int) -> tuple[int, ...]:
    """The coefficients of T_n(2 u - 1), lowest first."""
    older, newer = [1], [-1, 2]
    if n == 0:
        return (1,)
    for _ in range(n - 1):
        doubled = [0, *(4 * c for c in newer)]
        for i, c in enumerate(newer):
            doubled[i] -= 2 * c
        for i, c in enumerate(older):
            doubled[i] -= c
        older, newer = newer, doubled
    return tuple(newer)
