"""Components in our frames as the ambient matrices that peers work with, and back.

All is done in high precision and then rounded, by formulas of its own and not by those of the manifold files: that costs
a peer about one unit.
"""

from __future__ import annotations

import math
from functools import partial
from typing import Any

import mpmath as mp
import numpy as np

DIGITS = 60


@partial(np.vectorize, otypes=[object])
def exact(x: Any) -> Any:
    """Numbers that lose nothing by what is done to them."""
    return mp.mpf(float(x))


def rounded(rows: Any) -> Any:
    """Exact rows as numbers that numpy computes with."""
    return np.array([[float(x) for x in np.ravel(row)] for row in rows])


def square(rows: Any) -> Any:
    """Rows as square matrices (N, n, n)."""
    return np.asarray(rows).reshape(len(rows), *2 * (math.isqrt(np.shape(rows)[1]),))


def skew(v: Any) -> Any:
    """The antisymmetric matrix of the cross product with v."""
    x, y, z = v
    zero = mp.mpf(0)
    return np.array([[zero, -z, y], [z, zero, -x], [-y, x, zero]], dtype=object)


def axial(A: Any) -> tuple[Any, Any, Any]:
    """The vector of the antisymmetric part of a matrix."""
    return (A[2, 1] - A[1, 2]) / 2, (A[0, 2] - A[2, 0]) / 2, (A[1, 0] - A[0, 1]) / 2


class Rotations:
    """Points R (N, 9), components the body-frame rotation vector w (N, 3), ambient R [w] (N, 3, 3)."""

    @staticmethod
    def ambient(points: Any, vectors: Any) -> Any:
        """The matrices that components mean, exact."""
        with mp.workdps(DIGITS):
            return np.array([R @ skew(w) for R, w in zip(exact(square(points)), exact(vectors), strict=True)])

    @staticmethod
    def components(points: Any, matrices: Any) -> Any:
        """The components of tangent matrices."""
        with mp.workdps(DIGITS):
            pairs = zip(exact(square(points)), exact(matrices), strict=True)
            return rounded([axial(R.T @ L) for R, L in pairs])


class PositiveDefinite:
    """Points P (N, n^2), components the entries of S = P^-1/2 dP P^-1/2 on and above the diagonal, ambient dP.

    Entries above the diagonal are multiplied by sqrt 2, so that the norm of the components is that of S.
    """

    @staticmethod
    def ambient(points: Any, vectors: Any) -> Any:
        """The matrices that components mean, exact."""
        with mp.workdps(DIGITS):
            roots = [_power(P, mp.mpf(1) / 2) for P in exact(square(points))]
            return np.array([s @ _unpacked(v, len(s)) @ s for s, v in zip(roots, exact(vectors), strict=True)])

    @staticmethod
    def components(points: Any, matrices: Any) -> Any:
        """The components of tangent matrices."""
        with mp.workdps(DIGITS):
            inverses = [_power(P, -mp.mpf(1) / 2) for P in exact(square(points))]
            return rounded([_packed(r @ L @ r) for r, L in zip(inverses, exact(matrices), strict=True)])


def _power(P: Any, exponent: Any) -> Any:
    values, vectors = mp.eigsy(mp.matrix(((P + P.T) / 2).tolist()))
    V = np.array(vectors.tolist(), dtype=object).reshape(P.shape)
    return V * np.array([x**exponent for x in values], dtype=object) @ V.T


def _unpacked(v: Any, n: int) -> Any:
    S = np.empty((n, n), dtype=object)
    for (i, j), x in zip(zip(*np.triu_indices(n), strict=True), v, strict=True):
        S[i, j] = S[j, i] = x if i == j else x / mp.sqrt(2)
    return S


def _packed(S: Any) -> list[Any]:
    upper = zip(*np.triu_indices(len(S)), strict=True)
    return [S[i, j] if i == j else (S[i, j] + S[j, i]) / mp.sqrt(2) for i, j in upper]
