"""What each emitted function promises, in one line, the same in every language."""

from __future__ import annotations

from dataclasses import replace

from rsrm_gen.compiler.derive import Geometry
from rsrm_gen.compiler.lower import Program

PROMISES = {
    "project": "Numbers near the manifold to the point they stand for.",
    "to_tangent": "The tangent part at p of an ambient vector.",
    "inner": "The metric <u, v>_p.",
    "norm": "The length |v|_p.",
    "flat": "The covector <v, .>_p.",
    "exp": "Exp_p(v).",
    "log": "Log_p(q), the shortest v with Exp_p(v) = q.",
    "distance": "The geodesic distance.",
    "log_abs_det": "log |det D Log_p(q)| between the Riemannian volumes at q and p.",
    "riemannian_gradient": "The gradient in the metric from the partial derivatives df.",
    "gradient_norm": "The length of the gradient from the partial derivatives df.",
    "other_name": "The other numbers that stand for the same point.",
    "transport": "The tangent vector v at p, carried along the geodesic to q.",
    "sample": "A point uniform in volume, from standard normal numbers and numbers uniform in [0, 1).",
    "splat": "A wrapped Gaussian and its Riemannian gradient in x (RSRM eq. 3).",
}

OF_A_RETRACTION = {
    "exp": "The retraction of v at p: Exp_p(v) to first order.",
    "log": "The v whose retraction at p is q.",
    "distance": "The length of log(p, q): near the geodesic distance where p and q are near.",
    "log_abs_det": "log |det D log_p(q)| of the inverse retraction, between the Riemannian volumes at q and p.",
}


def promise(geometry: Geometry, routine: str) -> str:
    """What a function promises on a manifold whose maps may be a retraction."""
    return (OF_A_RETRACTION if geometry.spec.maps == "retraction" else {}).get(routine) or PROMISES[routine]


def public(program: Program) -> Program:
    """The functions for users; the adjoint of the splat is inside its kernel."""
    return replace(program, routines=tuple(r for r in program if r.name in PROMISES))
