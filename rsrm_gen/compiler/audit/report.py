"""What stage 5 gives: every check with its worst point and its tolerance."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass, field

from rsrm_gen.compiler.emit import Measurement
from rsrm_gen.errors import Span, UserError


@dataclass(frozen=True)
class Check:
    """One promise, tried at `points` places: kept if the worst error is at most the tolerance.

    Errors are relative, counted in `unit`s: of 1, or where code is judged, of the rounding of its numbers; what is no error
    of numbers, but a count or a statistic, has no unit. A promise that is `exact` was seen to hold everywhere by symbols,
    and tried nowhere.
    """

    name: str
    promise: str
    worst: float
    tolerance: float
    points: int
    where: str = ""  # the worst place, in words
    span: Span | None = field(default=None, compare=False)  # the formula to blame first
    hint: str | None = None  # what to write instead, where that is known
    unit: float | None = 1.0
    exact: bool = False

    @property
    def digits(self) -> int | None:
        """Decimal digits that agree at the worst place, at most the 15 of a double; None where there is no unit."""
        if self.unit is None:
            return None
        bound = _power_of_ten(self.worst * self.unit)
        return max(0, round(-math.log10(bound)))

    @property
    def passed(self) -> bool:
        """Whether the promise was kept; an error that is not a number breaks it."""
        return self.worst <= self.tolerance


@dataclass(frozen=True)
class AuditReport:
    """All checks of one manifold, and the accuracy measured on the way."""

    manifold: str
    content_hash: str
    checks: tuple[Check, ...]
    measured: tuple[Measurement, ...]

    @property
    def passed(self) -> bool:
        """Whether every promise was kept."""
        return all(check.passed for check in self.checks)

    def require(self) -> None:
        """Raise a `UserError` that lists what failed, at the formula to blame for the first."""
        failed = [check for check in self.checks if not check.passed]
        if not failed:
            return
        first = failed[0]
        error = f"the error is {first.worst:.2g} (at most {first.tolerance:.3g}) {first.where}"
        message = f"the audit refuses `{self.manifold}`: {first.promise}, but {error}"
        others = ", ".join(check.name for check in failed[1:])
        hints = [first.hint, f"also failed: {others}" if others else None]
        raise UserError(message.rstrip(), first.span, "; ".join(filter(None, hints)) or None)

    def json(self) -> str:
        """The report for `audit.json`: errors rounded up to powers of ten, so that machines agree on the bytes."""
        checks = [
            {
                "check": c.name,
                "promise": c.promise,
                "points": c.points,
                "exactly": c.exact,
                "error_below": _power_of_ten(c.worst),
                "digits": c.digits,
                "tolerance": c.tolerance,
                "passed": c.passed,
                **({} if c.passed else {"worst": c.where}),  # of a promise that is kept it is noise, and differs
            }
            for c in self.checks
        ]
        accuracy = [
            {"function": m.routine, "precision": m.precision, "error_at_most": m.bound, "points": m.points}
            for m in self.measured
        ]
        document = {
            "manifold": self.manifold,
            "content_hash": self.content_hash,
            "passed": self.passed,
            "checks": checks,
            "accuracy": accuracy,
        }
        return json.dumps(document, indent=2) + "\n"


def _power_of_ten(x: float) -> float:
    """The smallest power of ten above an error, no smaller than 1e-15; errors of double precision differ between machines."""
    bound = 1e-15
    while not x < bound and bound < 1e15:
        bound = float(f"{bound * 10:.0e}")
    return bound
