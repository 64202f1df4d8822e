"""Functions of symmetric matrices and their derivatives in high precision.

f(A) = V f(lambda) V^T, and by Daleckii and Krein the m-th derivative in the directions E_1, ..., E_m is

    V (sum over orders of the E and over i, ..., j of f[lambda_i, ..., lambda_j] E_ik ... E_lj) V^T,    E = V^T E V,

with the divided differences f[...], which stay finite where eigenvalues meet. Here they are computed by their definition,
from eigenvalues that are split by far less than the precision and with the digits that this costs in addition.

A symmetric matrix is a tuple of its entries on and above the diagonal, row by row ("packed").
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from operator import mul
from typing import Any

import gmpy2
import mpmath as mp
from gmpy2 import isqrt, mpz
from mpmath.libmp import from_man_exp

from rsrm_gen.compiler.derive.reals import Raw, Real, in_precision

GUARD = 140  # bits beyond the working precision: eigenvalues 1e-40 of the largest one keep all their digits
MAX_SWEEPS = 60

Packed = tuple[Any, ...]  # of mpmath's numbers
RawPacked = tuple[Raw, ...]  # the same, which are compared and hashed much faster
Square = list[list[Any]]  # of fixed-point numbers: gmpy2's integers


def _log_sinhc_sqrt(x: Real) -> Real:
    """log(sinh(sqrt x) / sqrt x), which is x / 6 near 0 and log(sin / .) for x < 0."""
    if not x:
        return x
    lost = max(0, -2 * gmpy2.get_exp(x))  # the bits that 1 + x / 6 loses of x
    with in_precision(gmpy2.get_context().precision + lost + 20):
        root = gmpy2.sqrt(abs(x))
        return gmpy2.log((gmpy2.sinh(root) if x > 0 else gmpy2.sin(root)) / root)


FUNCTIONS: dict[str, Callable[[Real], Real]] = {
    "exp": gmpy2.exp,
    "log": gmpy2.log,
    "sqrt": gmpy2.sqrt,
    "invsqrt": lambda x: 1 / gmpy2.sqrt(x),
    "log_sinhc_sqrt": _log_sinhc_sqrt,
}
NAMES = tuple(FUNCTIONS)


def size_of(count: int) -> int:
    """n, from the number n (n + 1) / 2 of packed entries."""
    return (math.isqrt(8 * count + 1) - 1) // 2


def places(n: int) -> list[tuple[int, int]]:
    """Row and column of every packed entry."""
    return [(i, j) for i in range(n) for j in range(i, n)]


@dataclass(frozen=True)
class Eigen:
    """Eigenvalues k 2^exponent, ascending, and orthonormal eigenvectors as the columns of a matrix of fixed-point numbers."""

    values: tuple[Any, ...]
    exponent: int
    vectors: tuple[tuple[Any, ...], ...]
    bits: int


def eigenvalues(matrix: Packed) -> tuple[Any, ...]:
    """The eigenvalues, ascending, in the working precision; NaN for a matrix with entries that are not finite."""
    eigen = _eigen(_raw(matrix), mp.mp.prec)
    if eigen is None:
        return (mp.nan,) * size_of(len(matrix))
    return tuple(_to_float(k, eigen.exponent, eigen.bits) for k in eigen.values)


def derivative(name: str, matrix: Packed, directions: tuple[Packed, ...] = ()) -> Packed:
    """D^m f(A)[E_1, ..., E_m], packed, in the working precision; f(A) itself without directions; NaN where it is not real."""
    return _derivative(name, _raw(matrix), tuple(map(_raw, directions)), mp.mp.prec)


def _raw(packed: Packed) -> RawPacked:
    return tuple(x._mpf_ for x in packed)


@lru_cache(maxsize=4096)
def _derivative(name: str, matrix: RawPacked, directions: tuple[RawPacked, ...], prec: int) -> Packed:
    undefined = (mp.nan,) * len(matrix)
    eigen = _eigen(matrix, prec)
    if eigen is None or not all(map(_are_finite, directions)):
        return undefined
    differences = _divided_differences(name, eigen, len(directions), prec)
    if not all(map(gmpy2.is_finite, differences.values())):
        return undefined
    return _contracted(eigen, differences, directions, prec)


@lru_cache(maxsize=4096)
def _eigen(matrix: RawPacked, prec: int) -> Eigen | None:
    """Cyclic Jacobi in fixed-point numbers, which are multiplied much faster than mpmath's."""
    if not _are_finite(matrix):
        return None
    n, bits = size_of(len(matrix)), prec + GUARD
    fixed, exponent = _to_fixed(map(_mantissa_and_exponent, matrix), bits)
    a = _unpacked(fixed, n)
    v = [[mpz(i == j) << bits for j in range(n)] for i in range(n)]
    for _ in range(MAX_SWEEPS):
        pairs = [(p, q) for p in range(n) for q in range(p + 1, n) if abs(a[p][q]) > 2]
        if not pairs:
            break
        for p, q in pairs:
            _rotate(a, v, p, q, bits)
    order = sorted(range(n), key=lambda i: a[i][i])
    return Eigen(tuple(a[i][i] for i in order), exponent - bits, tuple(zip(*(v[i] for i in order), strict=True)), bits)


def _rotate(a: Square, v: Square, p: int, q: int, bits: int) -> None:
    """The rotation in the plane of two axes that makes a[p][q] zero; the rows of v turn with the axes."""
    gap, twice = a[q][q] - a[p][p], 2 * a[p][q]
    length = isqrt(gap * gap + twice * twice)
    t = (twice << bits) // (gap + length if gap >= 0 else gap - length)
    c = (mpz(1) << (2 * bits)) // isqrt((mpz(1) << (2 * bits)) + t * t)
    s = (t * c) >> bits
    moved = (t * a[p][q]) >> bits
    a[p][p], a[q][q] = a[p][p] - moved, a[q][q] + moved
    a[p][q] = a[q][p] = mpz(0)
    for r, row in enumerate(a):
        if r not in (p, q):
            x, y = row[p], row[q]
            a[p][r] = row[p] = (c * x - s * y) >> bits
            a[q][r] = row[q] = (s * x + c * y) >> bits
    v[p], v[q] = (
        [(c * x - s * y) >> bits for x, y in zip(v[p], v[q], strict=True)],
        [(s * x + c * y) >> bits for x, y in zip(v[p], v[q], strict=True)],
    )


def _divided_differences(name: str, eigen: Eigen, order: int, prec: int) -> dict[tuple[int, ...], Real]:
    """f[lambda_i, ..., lambda_j] for all ascending indices i <= ... <= j; not finite where f is not real."""
    n, count = len(eigen.values), order + 1
    function = FUNCTIONS[name]
    with in_precision(prec + GUARD + order * (prec + 60)):
        scale = gmpy2.exp2(eigen.exponent)
        values = [k * scale for k in eigen.values]
        step = (max(map(abs, values)) or 1) * gmpy2.exp2(-(prec + 40))
        # The r-th repetition of the i-th eigenvalue: all different, and in ascending order.
        points = [[x + (count * i + r) * step if order else x for r in range(count)] for i, x in enumerate(values)]
        known: dict[tuple[tuple[int, int], ...], Real] = {}

        def difference(nodes: tuple[tuple[int, int], ...]) -> Real:
            if nodes not in known:
                (i, r), (j, k) = nodes[0], nodes[-1]
                if len(nodes) == 1:
                    known[nodes] = function(points[i][r])
                else:
                    rise = difference(nodes[1:]) - difference(nodes[:-1])
                    known[nodes] = rise / (points[j][k] - points[i][r])
            return known[nodes]

        ascending = itertools.combinations_with_replacement(range(n), count)
        return {
            indices: difference(tuple((i, indices[:at].count(i)) for at, i in enumerate(indices)))
            for indices in ascending
        }


def _contracted(
    eigen: Eigen, differences: dict[tuple[int, ...], Real], directions: tuple[RawPacked, ...], prec: int
) -> Packed:
    """The sum of the divided differences times the entries of the directions, back out of the eigenbasis."""
    n, bits = len(eigen.values), eigen.bits
    fixed, exponent = _to_fixed((x.as_mantissa_exp() for x in differences.values()), bits)
    weight = dict(zip(differences, fixed, strict=True))
    v = [list(row) for row in eigen.vectors]
    turned = []
    for direction in directions:
        entries, size = _to_fixed(map(_mantissa_and_exponent, direction), bits)
        exponent += size
        turned.append(_product(_product(_transposed(v), _unpacked(entries, n), bits), v, bits))
    total = [[0] * n for _ in range(n)]
    for ordered in itertools.permutations(turned):
        for path in itertools.product(range(n), repeat=len(turned) + 1):
            term = weight[tuple(sorted(path))]
            for e, (i, j) in zip(ordered, itertools.pairwise(path), strict=True):
                term = (term * e[i][j]) >> bits
            total[path[0]][path[-1]] += term
    result = _product(_product(v, total, bits), _transposed(v), bits)
    return tuple(_to_float(result[i][j], exponent - bits, prec) for i, j in places(n))


def _are_finite(numbers: RawPacked) -> bool:
    return all(mantissa or not exponent for _, mantissa, exponent, _ in numbers)


def _mantissa_and_exponent(x: Raw) -> tuple[Any, int]:
    sign, mantissa, exponent, _ = x
    return mpz(-mantissa if sign else mantissa), exponent


def _to_fixed(numbers: Iterable[tuple[Any, int]], bits: int) -> tuple[list[Any], int]:
    """Integers k with mantissa 2^its exponent = k 2^(exponent - bits), the largest of them of about that many bits."""
    given = [(mantissa, int(exponent)) for mantissa, exponent in numbers]
    exponent = max((mantissa.bit_length() + e for mantissa, e in given if mantissa), default=0)
    shifts = [e + bits - exponent for _, e in given]
    return [k << shift if shift >= 0 else k >> -shift for (k, _), shift in zip(given, shifts, strict=True)], exponent


def _to_float(k: Any, exponent: int, prec: int) -> Any:
    return mp.make_mpf(from_man_exp(k, exponent, prec, "n"))


def _unpacked(entries: Sequence[int], n: int) -> Square:
    square = [[0] * n for _ in range(n)]
    for (i, j), x in zip(places(n), entries, strict=True):
        square[i][j] = square[j][i] = x
    return square


def _transposed(a: Square) -> Square:
    return [list(column) for column in zip(*a, strict=True)]


def _product(a: Square, b: Square, bits: int) -> Square:
    columns = _transposed(b)
    return [[sum(map(mul, row, column)) >> bits for column in columns] for row in a]
