"""The two precisions of generated C."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Precision:
    """One of the two instances of every function."""

    type: str
    suffix: str  # of C function names and literals
    tag: str  # of our function names
    eps: str


DOUBLE = Precision("double", "", "", "DBL_EPSILON")
FLOAT = Precision("float", "f", "_f", "FLT_EPSILON")
PRECISIONS = (DOUBLE, FLOAT)
