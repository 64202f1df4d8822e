"""geoopt: its manifold classes in torch. It has no rotations, no torus in angles and no determinants.

Its Lorentz model has the time coordinate first and, with k = 1, curvature -1, as ours; so has its ball, with c = 1. Its
symmetric positive definite matrices have the affine-invariant metric unless another is asked for.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import geoopt
import torch

from rsrm_gen.bench.ambient import PositiveDefinite, square
from rsrm_gen.bench.peers import Evaluate, bundled_name
from rsrm_gen.compiler.spec import Spec


def functions(spec: Spec, precision: str) -> Mapping[str, Evaluate]:
    """Exp, Log and the distance of spheres, of hyperbolic spaces in two models and of SPD(n)."""
    dtype = getattr(torch, precision)
    makers: dict[str | None, Callable[[], Any]] = {
        "sphere": geoopt.Sphere,
        "hyperbolic": lambda: geoopt.Lorentz().to(dtype),
        # Its curvature is the softplus of a number: made in float32 and then converted, it would be -1 to 8 digits.
        "poincare": lambda: geoopt.PoincareBall(c=torch.tensor(1.0, dtype=dtype)),
    }
    name = bundled_name(spec)
    if name == "spd":
        return _positive_definite(geoopt.SymmetricPositiveDefinite(), precision)
    if name not in makers:
        return {}
    manifold = makers[name]()
    return {"exp": _rows(manifold.expmap), "log": _rows(manifold.logmap), "distance": _rows(manifold.dist)}


def _positive_definite(manifold: Any, precision: str) -> Mapping[str, Evaluate]:
    exp, log, distance = (_rows(f) for f in (manifold.expmap, manifold.logmap, manifold.dist))
    frame = PositiveDefinite
    return {
        "exp": lambda p, v: exp(square(p), frame.ambient(p, v).astype(precision)),
        "log": lambda p, q: frame.components(p, log(square(p), square(q))),
        "distance": lambda p, q: distance(square(p), square(q)),
    }


def _rows(function: Callable[..., Any]) -> Evaluate:
    def evaluate(a: Any, b: Any) -> Any:
        with torch.no_grad():
            return function(torch.as_tensor(a), torch.as_tensor(b)).numpy()

    return evaluate
