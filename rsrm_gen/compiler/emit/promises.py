"""What each emitted function promises, in one line, the same in every language."""

from __future__ import annotations

from dataclasses import replace

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
    "splat": "A wrapped Gaussian and its Riemannian gradient in x (RSRM eq. 3).",
}


def public(program: Program) -> Program:
    """The functions for users; the adjoint of the splat is inside its kernel."""
    return replace(program, routines=tuple(r for r in program if r.name in PROMISES))
