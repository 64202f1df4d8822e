"""CasADi: the same manifold file by its own symbols, with its own automatic differentiation.

It has no rule for 0/0 and nothing but double precision; the determinant is that of its Jacobian. It has no
eigen-decomposition of symbols: what the audit writes out for functions of symmetric matrices would be our rotations.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from rsrm_gen.bench.peers import Evaluate
from rsrm_gen.compiler.audit.second_reading import read_again
from rsrm_gen.compiler.derive.matrix_words import SYMMETRIC
from rsrm_gen.compiler.spec import ProductSpec, Spec
from rsrm_gen.compiler.spec.formula import Call, Tree, children


def functions(spec: Spec, precision: str) -> Mapping[str, Evaluate]:
    """All four functions of any manifold without functions of symmetric matrices, in float64."""
    if precision != "float64" or _decomposes(spec):
        return {}
    reading = read_again(spec)
    return {
        "exp": _by_rows(reading.exp),
        "log": _by_rows(reading.log),
        "distance": _by_rows(reading.distance),
        "log_abs_det": _by_rows(reading.log_abs_det),
    }


def _decomposes(spec: Spec) -> bool:
    """Whether Exp, Log, the distance or the determinant needs eigenvalues or eigenvectors."""
    if isinstance(spec, ProductSpec):
        return any(_decomposes(factor.spec) for factor in spec.factors)
    parts = [part for part in (spec.exp, spec.log, spec.distance, spec.log_det) if part is not None]
    formulas = [formula for part in parts for formula in (part.value, *dict(part.lets).values())]
    return any(word in SYMMETRIC for formula in formulas for word in _words(formula.tree))


def _words(tree: Tree) -> Iterator[str]:
    """The functions that a formula calls."""
    if isinstance(tree, Call):
        yield tree.function
    for child in children(tree):
        yield from _words(child)


def _by_rows(function: Callable[[Sequence[float], Sequence[float]], Any]) -> Evaluate:
    def evaluate(a: Any, b: Any) -> Any:
        return np.array([np.asarray(function(x, y), dtype=float).ravel() for x, y in zip(a, b, strict=True)])

    return evaluate
