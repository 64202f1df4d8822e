"""Values of sympy expressions and staged functions in high precision, by mpmath."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import mpmath as mp
import sympy as sp

from rsrm_gen.compiler.budget import spend
from rsrm_gen.compiler.derive import magnitudes
from rsrm_gen.compiler.derive.geometry import EPS, Choose, Function, Polynomial, Wrap

DIGITS = 60  # of every value computed here
TINY = mp.mpf(10) ** -40  # what counts as zero among numbers of size 1 with so many digits

Values = dict[sp.Symbol, Any]

ELEMENTARY = {
    sp.exp: magnitudes.exp, sp.log: mp.log, sp.sin: magnitudes.sin, sp.cos: magnitudes.cos, sp.tan: magnitudes.tan,
    sp.sinh: magnitudes.sinh, sp.cosh: magnitudes.cosh, sp.tanh: magnitudes.tanh, sp.asinh: mp.asinh, sp.acosh: mp.acosh,
    sp.acos: mp.acos, sp.atanh: mp.atanh, sp.Abs: abs, sp.atan2: mp.atan2, sp.sign: mp.sign,
}  # fmt: skip


def value(expression: sp.Expr, values: Mapping[sp.Symbol, Any]) -> Any:
    """The value of an expression; NaN where it is singular."""
    try:
        with mp.workdps(DIGITS):
            result = _value(expression, values)
    except (ZeroDivisionError, ValueError, TypeError, OverflowError):  # TypeError: complex numbers are not ordered
        return mp.nan
    return mp.nan if isinstance(result, mp.mpc) else result


def _value(expression: sp.Expr, values: Mapping[sp.Symbol, Any]) -> Any:
    if expression.is_Symbol:
        return values.get(EPS, mp.mpf(2) ** -52) if expression == EPS else values[expression]
    if not expression.args:
        return mp.mpf(expression._to_mpmath(mp.mp.prec + 10))
    if isinstance(expression, Choose):
        return _chosen(expression, values)
    arguments = [_value(a, values) for a in expression.args]
    if expression.is_Add:
        return mp.fsum(arguments)
    if expression.is_Mul:
        return mp.fprod(arguments)
    if expression.is_Pow:
        return mp.power(*arguments)
    if isinstance(expression, Wrap):
        x, period = arguments
        return x - period * mp.nint(x / period)
    if isinstance(expression, Polynomial):
        return mp.polyval(arguments[:0:-1], arguments[0])
    return ELEMENTARY[expression.func](*arguments)


def _chosen(expression: Choose, values: Mapping[sp.Symbol, Any]) -> Any:
    kind = int(expression.args[0])
    a, b = (_value(x, values) for x in expression.args[1:3])
    return _value(expression.args[3 if (a < b, a <= b, a == b)[kind] else 4], values)


def is_positive_definite(matrix: Any) -> bool:
    """Whether a symmetric matrix of numbers has a Cholesky decomposition."""
    try:
        with mp.workdps(DIGITS):
            factor = mp.cholesky(matrix, tol=TINY**2)
    except (ValueError, ZeroDivisionError):
        return False
    return all(mp.isfinite(x) for x in factor)


def largest(numbers: Iterable[Any]) -> Any:
    """The largest absolute value; infinite when one of the numbers is not finite, which max() would pass over."""
    sizes = [abs(x) if mp.isfinite(x) else mp.inf for x in numbers]
    return max(sizes, default=mp.mpf(0))


def determinant(matrix: Any) -> Any:
    """The determinant of a matrix of numbers; NaN where one is not finite, zero where elimination finds no pivot."""
    if not all(mp.isfinite(x) for x in matrix):
        return mp.nan
    try:
        return mp.det(matrix)
    except TypeError:  # mpmath's own stumbles over a column of zeros
        return mp.mpf(0)


def run(function: Function, *arguments: Sequence[Any], eps: float = 2.0**-52) -> tuple[list[Any], Values]:
    """The results of a staged function, unguarded, and the values of all its symbols."""
    spend()
    values: Values = {EPS: mp.mpf(eps)}
    for declared, given in zip(function.arguments, arguments, strict=True):
        values.update(zip(declared.symbols, given, strict=True))
    for assignment in function.assignments:
        values[assignment.symbol] = value(assignment.expression, values)
    return [value(result, values) for result in function.results], values
