"""Errors at many places: the largest of them, where it was, and how it compares with what was expected."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import mpmath as mp

from rsrm_gen.compiler.derive.numeric import largest


@dataclass(frozen=True)
class Worst:
    """The largest error so far, where it was, the number of places, and found / expected at each where that says something."""

    error: float = 0.0
    where: str = ""
    points: int = 0
    ratios: tuple[Any, ...] = ()

    def with_error(self, error: Any, where: str, ratio: Any = None) -> Worst:
        """This with one more place; an error that is not a number is infinite."""
        number = float(error) if mp.isfinite(error) else float("inf")
        ratios = self.ratios if ratio is None else (*self.ratios, ratio)
        seen = replace(self, points=self.points + 1, ratios=ratios)
        return replace(seen, error=number, where=where) if number > self.error else seen

    def same_ratio(self, sentence: str) -> str | None:
        """The sentence with the ratio in it, if it is the same at every place, and a number other than 1."""
        first = self.ratios[0] if self.ratios else mp.nan
        if not all(abs(r - first) < mp.mpf(10) ** -12 * (1 + abs(first)) for r in self.ratios):
            return None
        known = mp.isfinite(first) and abs(first - 1) > mp.mpf(10) ** -12
        return sentence.format(mp.nstr(first, 6)) + " everywhere" if known else None


def difference(x: Sequence[Any], y: Sequence[Any]) -> list[Any]:
    """x - y."""
    return [a - b for a, b in zip(x, y, strict=True)]


def relative(errors: Sequence[Any], scale: Sequence[Any]) -> Any:
    """The largest error as a part of the largest of some numbers of the same unit."""
    error = largest(errors)
    return ratio(error, largest(scale)) if error else error


def ratio(a: Any, b: Any) -> Any:
    """a / b; 1 where both are zero, infinite where only b is."""
    if b == 0:
        return mp.mpf(1) if a == 0 else mp.inf
    return a / b


def at(*named: Any) -> str:
    """Places in words: `at p = (0.1, 0.2)`."""
    pairs = zip(named[::2], named[1::2], strict=True)
    return "at " + ", ".join(f"{name} = ({', '.join(mp.nstr(c, 4) for c in x)})" for name, x in pairs)
