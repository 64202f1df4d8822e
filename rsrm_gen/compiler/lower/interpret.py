"""Runs a routine in mpmath: the reference for every back end, and with 60 digits the truth."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import mpmath as mp

from rsrm_gen.compiler.budget import spend
from rsrm_gen.compiler.derive import magnitudes
from rsrm_gen.compiler.derive.matrix_numeric import derivative, eigenvalues
from rsrm_gen.compiler.lower.ir import SEVERAL, Node, Routine

EPS = 2.0**-52

OPERATIONS: dict[str, Callable[..., Any]] = {
    "neg": lambda x: -x,
    "add": lambda x, y: x + y,
    "sub": lambda x, y: x - y,
    "mul": lambda x, y: x * y,
    "div": lambda x, y: x / y,
    "sqrt": mp.sqrt, "root": mp.sqrt, "exp": magnitudes.exp, "log": mp.log, "sin": magnitudes.sin,
    "cos": magnitudes.cos, "tan": magnitudes.tan, "sinh": magnitudes.sinh, "cosh": magnitudes.cosh,
    "tanh": magnitudes.tanh, "asinh": mp.asinh, "acosh": mp.acosh, "acos": mp.acos, "atanh": mp.atanh, "atan2": mp.atan2,
    "abs": abs, "round": mp.nint,
    "less": lambda x, y: x < y,
    "less_equal": lambda x, y: x <= y,
    "equal": lambda x, y: x == y,
    "select": lambda condition, x, y: x if condition else y,
}  # fmt: skip


def interpret(routine: Routine, *arguments: Sequence[Any], digits: int = 60) -> list[list[Any]]:
    """The entries of every result for flat arguments; NaN where an operation has no value."""
    spend()
    with mp.workdps(digits):
        values: dict[Node, Any] = {}
        for parameter, given in zip(routine.parameters, arguments, strict=True):
            values.update(zip(parameter.nodes, map(mp.mpf, given), strict=True))
        for node in routine.nodes:
            if node not in values:
                values[node] = operate(node, [values[a] for a in node.arguments])
        return [[values[n] for n in result.nodes] for result in routine.results]


def operate(node: Node, arguments: list[Any]) -> Any:
    """The value of one operation in the working precision."""
    if node.op == "constant":
        return mp.mpf(node.value._to_mpmath(mp.mp.prec + 10))  # type: ignore[attr-defined]
    if node.op == "eps":
        return mp.mpf(EPS)
    if node.op == "polynomial":
        coefficients = [mp.mpf(str(c)) for c in node.value]  # type: ignore[attr-defined]
        return mp.polyval(coefficients[::-1], arguments[0])
    if node.op in SEVERAL or node.op == "entry":
        return _matrix_operation(node, arguments)
    try:
        result = OPERATIONS[node.op](*arguments)
    except (ZeroDivisionError, ValueError, TypeError, OverflowError):
        return mp.nan
    return mp.nan if isinstance(result, mp.mpc) else result


def _matrix_operation(node: Node, arguments: list[Any]) -> Any:
    """The value of an eigh is its matrix, decomposed only when something is picked from it."""
    if node.op == "eigh":
        return tuple(arguments)
    if node.op == "spectral":
        matrix, *entries = arguments
        size = len(matrix)
        directions = tuple(tuple(entries[k : k + size]) for k in range(0, len(entries), size))
        return derivative(node.function[0], matrix, directions)
    values = eigenvalues(arguments[0]) if node.arguments[0].op == "eigh" else arguments[0]
    return values[node.index]
