"""geomstats: its manifold classes with their default metrics, on numpy. It has no torus in angles and no determinants.

Its rotations are matrices. Ours are turned into them, and its results back, in high precision and then rounded: that
costs it about one unit. Its bi-invariant metric measures a rotation by its angle, as ours does.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any

import mpmath as mp
import numpy as np
from geomstats.geometry.hyperboloid import Hyperboloid
from geomstats.geometry.hypersphere import Hypersphere
from geomstats.geometry.poincare_ball import PoincareBall
from geomstats.geometry.special_orthogonal import SpecialOrthogonal

from rsrm_gen.bench.peers import Evaluate, bundled_name
from rsrm_gen.compiler.spec import Spec


def functions(spec: Spec, precision: str) -> Mapping[str, Evaluate]:
    """Exp, Log and the distance of spheres, hyperbolic spaces in two models and SO(3)."""
    match bundled_name(spec):
        case "sphere":
            return _ambient(Hypersphere(spec.dim).metric)
        case "hyperbolic":
            return _ambient(Hyperboloid(spec.dim).metric)
        case "poincare":
            return _ambient(PoincareBall(spec.dim).metric)
        case "so3":
            return _rotations(SpecialOrthogonal(3).metric, precision)
    return {}


def _ambient(metric: Any) -> Mapping[str, Evaluate]:
    """A metric whose points and tangent vectors are stored as ours, the curvature of its hyperbolic spaces -1."""
    return {
        "exp": lambda p, v: metric.exp(v, p),
        "log": lambda p, q: metric.log(q, p),
        "distance": metric.dist,
    }


def _rotations(metric: Any, precision: str) -> Mapping[str, Evaluate]:
    def exp(p: Any, v: Any) -> Any:
        at = _matrices(p)
        tangent = np.array([R @ _skew(_exact(w)) for R, w in zip(at, v, strict=True)])
        found = metric.exp(tangent.astype(precision), at.astype(precision))
        return _rows([_quaternion(R, _exact(near)) for R, near in zip(_exact(found), p, strict=True)])

    def log(p: Any, q: Any) -> Any:
        at = _matrices(p).astype(precision)
        found = np.real(metric.log(_matrices(q).astype(precision), at))  # complex for some float32 matrices
        return _rows([_axial(R.T @ L) for R, L in zip(_exact(at), _exact(found), strict=True)])

    def distance(p: Any, q: Any) -> Any:
        return np.real(metric.dist(_matrices(p).astype(precision), _matrices(q).astype(precision)))

    return {"exp": exp, "log": log, "distance": distance}


@partial(np.vectorize, otypes=[object])
def _exact(x: Any) -> Any:
    """Numbers that lose nothing by what is done to them."""
    return mp.mpf(float(x))


def _rows(exact: list[Any]) -> Any:
    return np.array([[float(x) for x in row] for row in exact])


def _matrices(quaternions: Any) -> Any:
    """The rotation matrices (N, 3, 3) of quaternions (N, 4), in high precision."""
    identity = _exact(np.eye(3))
    matrices = []
    with mp.workdps(40):
        for w, x, y, z in _exact(quaternions):
            S = _skew((x, y, z))
            matrices.append(identity + 2 * (w * S + S @ S) / (w * w + x * x + y * y + z * z))
    return np.array(matrices)


def _skew(v: Any) -> Any:
    x, y, z = v
    zero = mp.mpf(0)
    return np.array([[zero, -z, y], [z, zero, -x], [-y, x, zero]], dtype=object)


def _axial(A: Any) -> tuple[Any, Any, Any]:
    """The vector of the antisymmetric part of a matrix."""
    return (A[2, 1] - A[1, 2]) / 2, (A[0, 2] - A[2, 0]) / 2, (A[1, 0] - A[0, 1]) / 2


def _quaternion(R: Any, near: Any) -> Any:
    """The unit quaternion of a rotation matrix, of the two the one on the side of `near`."""
    if not all(mp.isfinite(x) for x in R.ravel()):
        return np.full(4, mp.nan)
    with mp.workdps(40):
        squares = [1 + sum(sign * R[i, i] for i, sign in enumerate(signs)) for signs in DIAGONALS]  # 4 w^2, 4 x^2, ...
        x, y, z = (2 * component for component in _axial(R))  # 4 w x, 4 w y, 4 w z
        a, b, c = (R[i, j] + R[j, i] for i, j in ((0, 1), (0, 2), (1, 2)))  # 4 x y, 4 x z, 4 y z
        rows = ((squares[0], x, y, z), (x, squares[1], a, b), (y, a, squares[2], c), (z, b, c, squares[3]))
        q = np.array(max(rows, key=lambda row: abs(row[rows.index(row)])), dtype=object)
        q = q / mp.sqrt(sum(q * q))
        return q if sum(q * near) >= 0 else -q


DIAGONALS = ((1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1))
