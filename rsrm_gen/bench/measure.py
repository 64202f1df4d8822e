"""How wrong a code is on a band of pairs, in units of the error that nobody can avoid."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import mpmath as mp
import numpy as np

from rsrm_gen.bench.peers import Evaluate
from rsrm_gen.bench.rows import Band, Truth
from rsrm_gen.compiler.audit.numbers import PRECISIONS, ROUTINES
from rsrm_gen.compiler.derive.numeric import largest

DETERMINANT = "abs_det"
FUNCTIONS = (*ROUTINES, DETERMINANT)
LOST = 2.0**20  # units: six digits that the inputs determine are gone


@dataclass(frozen=True)
class Score:
    """The errors of one function of one code on one band, in units; a result that is not finite is infinitely wrong.

    `raised` rows raise alone; `batch_raised` says that all of them did together, for whatever row it was.
    """

    rows: int
    worst: float
    median: float
    not_finite: int = 0
    raised: int = 0
    batch_raised: bool = False
    lost: int = 0  # finite results that are more than 2^20 units wrong


def measure(functions: Mapping[str, Evaluate], band: Band) -> dict[str, Score | None]:
    """The score of every function that has a truth on a band; None where the code has no such function."""
    measured = [name for name in ROUTINES if name in band.truths]
    scores: dict[str, Score | None] = dict.fromkeys([*measured, DETERMINANT])
    for name in measured:
        if name in functions:
            found, batch_raised = _evaluated(functions[name], *band.inputs(name))
            scores[name] = _score(found, errors(found, band.truths[name]), batch_raised)
            if name == "log_abs_det":
                wrong = determinant_errors(found, band.truths[name], band.precision)
                scores[DETERMINANT] = _score(found, wrong, batch_raised)
    return scores


def errors(found: Sequence[Any], truth: Truth) -> Any:
    """The largest error of each row in its unit; infinite where the result is missing or not finite."""
    worst = [
        float(largest(mp.mpf(float(a)) - b for a, b in zip(row, exact, strict=True))) / unit
        if _is_finite(row)
        else np.inf
        for row, exact, unit in zip(found, truth.values, truth.units, strict=True)
    ]
    return np.array(worst)


def determinant_errors(found: Sequence[Any], truth: Truth, precision: str) -> Any:
    """The errors as factors of |det D Log| itself: at least the rounding unit, also where the logarithm vanishes.

    A code that computes the determinant cannot know its logarithm better than to the rounding unit, which where points
    are close is many of the logarithm's own units, and harms nobody.
    """
    return errors(found, Truth(truth.values, truth.units + 2 * PRECISIONS[precision][2]))


def _evaluated(function: Evaluate, a: Any, b: Any) -> tuple[list[Any], bool]:
    """The rows of results, None for one that raises; and whether the batch as a whole raised."""
    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("ignore")  # what matters of them is in the results
        try:
            return list(_flat(function(a, b), len(a))), False
        except Exception:  # any: it is the peer's, and the measurement
            return [_alone(function, a[i : i + 1], b[i : i + 1]) for i in range(len(a))], True


def _alone(function: Evaluate, a: Any, b: Any) -> Any:
    try:
        return _flat(function(a, b), 1)[0]
    except Exception:  # as above
        return None


def _flat(results: Any, rows: int) -> Any:
    return np.asarray(results).reshape(rows, -1)


def _is_finite(row: Any) -> bool:
    return row is not None and bool(np.all(np.isfinite(row)))


def _score(found: Sequence[Any], wrong: Any, batch_raised: bool) -> Score:
    raised = sum(row is None for row in found)
    return Score(
        rows=len(found),
        worst=float(wrong.max()),
        median=float(np.median(wrong)),
        not_finite=sum(row is not None and not _is_finite(row) for row in found),
        raised=raised,
        batch_raised=batch_raised,
        lost=int(np.sum(np.isfinite(wrong) & (wrong > LOST))),
    )
