"""CasADi: the same manifold file by its own symbols, with its own automatic differentiation.

It has no rule for 0/0 and nothing but double precision; the determinant is that of its Jacobian.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from rsrm_gen.bench.peers import Evaluate
from rsrm_gen.compiler.audit.second_reading import read_again
from rsrm_gen.compiler.spec import Spec


def functions(spec: Spec, precision: str) -> Mapping[str, Evaluate]:
    """All four functions of any manifold, in float64."""
    if precision != "float64":
        return {}
    reading = read_again(spec)
    return {
        "exp": _by_rows(reading.exp),
        "log": _by_rows(reading.log),
        "distance": _by_rows(reading.distance),
        "log_abs_det": _by_rows(reading.log_abs_det),
    }


def _by_rows(function: Callable[[Sequence[float], Sequence[float]], Any]) -> Evaluate:
    def evaluate(a: Any, b: Any) -> Any:
        return np.array([np.asarray(function(x, y), dtype=float).ravel() for x, y in zip(a, b, strict=True)])

    return evaluate
