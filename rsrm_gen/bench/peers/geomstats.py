"""geomstats: its manifold classes with their default metrics, on numpy. It has no torus in angles and no determinants.

Its rotations are matrices; our quaternions are turned into them, and its results back, in high precision and then
rounded, as tangent vectors are (`bench/ambient.py`). Its bi-invariant metric measures a rotation by its angle, and its metric
of symmetric positive definite matrices is the affine-invariant one, as ours are; curvatures are -1.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import mpmath as mp
import numpy as np
from geomstats.geometry.hyperboloid import Hyperboloid
from geomstats.geometry.hypersphere import Hypersphere
from geomstats.geometry.poincare_ball import PoincareBall
from geomstats.geometry.poincare_half_space import PoincareHalfSpace
from geomstats.geometry.spd_matrices import SPDMatrices
from geomstats.geometry.special_orthogonal import SpecialOrthogonal

from rsrm_gen.bench.ambient import PositiveDefinite, Rotations, axial, exact, rounded, skew, square
from rsrm_gen.bench.peers import Evaluate, bundled_name
from rsrm_gen.compiler.spec import Spec


def functions(spec: Spec, precision: str) -> Mapping[str, Evaluate]:
    """Exp, Log and the distance of spheres, hyperbolic spaces in three models, SO(3) and SPD(n)."""
    match bundled_name(spec):
        case "sphere":
            return _ambient(Hypersphere(spec.dim).metric)
        case "hyperbolic":
            return _ambient(Hyperboloid(spec.dim).metric)
        case "poincare":
            return _ambient(PoincareBall(spec.dim).metric)
        case "half_space":
            return _ambient(PoincareHalfSpace(spec.dim).metric)
        case "so3":
            return _quaternions(_matrices(SpecialOrthogonal(3).metric, Rotations, precision), precision)
        case "so3_matrix":
            return _matrices(SpecialOrthogonal(3).metric, Rotations, precision)
        case "spd":
            n = dict(spec.parameters)["n"]
            return _matrices(SPDMatrices(n).metric, PositiveDefinite, precision)
    return {}


def _ambient(metric: Any) -> Mapping[str, Evaluate]:
    """A metric whose points and tangent vectors are stored as ours."""
    return {
        "exp": lambda p, v: metric.exp(v, p),
        "log": lambda p, q: metric.log(q, p),
        "distance": metric.dist,
    }


def _matrices(metric: Any, frame: type[Rotations | PositiveDefinite], precision: str) -> Mapping[str, Evaluate]:
    """A metric whose points are stored as ours, and whose tangent vectors are matrices."""

    def exp(p: Any, v: Any) -> Any:
        return metric.exp(frame.ambient(p, v).astype(precision), square(p))

    def log(p: Any, q: Any) -> Any:
        return frame.components(p, np.real(metric.log(square(q), square(p))))  # complex for some float32 rotations

    def distance(p: Any, q: Any) -> Any:
        return np.real(metric.dist(square(p), square(q)))

    return {"exp": exp, "log": log, "distance": distance}


def _quaternions(rotations: Mapping[str, Evaluate], precision: str) -> Mapping[str, Evaluate]:
    """The functions of rotation matrices, of quaternions."""

    def stored(quaternions: Any) -> Any:
        return rounded(_rotations(quaternions)).astype(precision)

    def exp(p: Any, v: Any) -> Any:
        found = exact(square(np.reshape(rotations["exp"](stored(p), v), (len(p), 9))))
        return rounded([_quaternion(R, near) for R, near in zip(found, exact(p), strict=True)])

    return {
        "exp": exp,
        "log": lambda p, q: rotations["log"](stored(p), stored(q)),
        "distance": lambda p, q: rotations["distance"](stored(p), stored(q)),
    }


def _rotations(quaternions: Any) -> Any:
    """The rotation matrices (N, 3, 3) of quaternions (N, 4), in high precision."""
    identity = exact(np.eye(3))
    matrices = []
    with mp.workdps(40):
        for w, x, y, z in exact(quaternions):
            S = skew((x, y, z))
            matrices.append(identity + 2 * (w * S + S @ S) / (w * w + x * x + y * y + z * z))
    return np.array(matrices)


def _quaternion(R: Any, near: Any) -> Any:
    """The unit quaternion of a rotation matrix, of the two the one on the side of `near`."""
    if not all(mp.isfinite(x) for x in R.ravel()):
        return np.full(4, mp.nan)
    with mp.workdps(40):
        squares = [1 + sum(sign * R[i, i] for i, sign in enumerate(signs)) for signs in DIAGONALS]  # 4 w^2, 4 x^2, ...
        x, y, z = (2 * component for component in axial(R))  # 4 w x, 4 w y, 4 w z
        a, b, c = (R[i, j] + R[j, i] for i, j in ((0, 1), (0, 2), (1, 2)))  # 4 x y, 4 x z, 4 y z
        rows = ((squares[0], x, y, z), (x, squares[1], a, b), (y, a, squares[2], c), (z, b, c, squares[3]))
        q = np.array(max(rows, key=lambda row: abs(row[rows.index(row)])), dtype=object)
        q = q / mp.sqrt(sum(q * q))
        return q if sum(q * near) >= 0 else -q


DIAGONALS = ((1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1))
