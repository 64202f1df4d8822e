"""geoopt: its manifold classes in torch. It has no rotations, no torus in angles and no determinants.

Its Lorentz model has the time coordinate first and, with k = 1, curvature -1, as ours; so has its ball, with c = 1.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import geoopt
import torch

from rsrm_gen.bench.peers import Evaluate, bundled_name
from rsrm_gen.compiler.spec import Spec


def functions(spec: Spec, precision: str) -> Mapping[str, Evaluate]:
    """Exp, Log and the distance of spheres and of hyperbolic spaces in two models."""
    dtype = getattr(torch, precision)
    makers: dict[str | None, Callable[[], Any]] = {
        "sphere": geoopt.Sphere,
        "hyperbolic": lambda: geoopt.Lorentz().to(dtype),
        # Its curvature is the softplus of a number: made in float32 and then converted, it would be -1 to 8 digits.
        "poincare": lambda: geoopt.PoincareBall(c=torch.tensor(1.0, dtype=dtype)),
    }
    name = bundled_name(spec)
    if name not in makers:
        return {}
    manifold = makers[name]()
    return {"exp": _rows(manifold.expmap), "log": _rows(manifold.logmap), "distance": _rows(manifold.dist)}


def _rows(function: Callable[..., Any]) -> Evaluate:
    def evaluate(a: Any, b: Any) -> Any:
        with torch.no_grad():
            return function(torch.as_tensor(a), torch.as_tensor(b)).numpy()

    return evaluate
