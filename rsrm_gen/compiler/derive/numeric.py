"""Values of sympy expressions and staged functions in high precision, by mpmath."""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import lru_cache, reduce
from typing import Any

import mpmath as mp
import sympy as sp

from rsrm_gen.compiler.budget import spend
from rsrm_gen.compiler.derive import magnitudes
from rsrm_gen.compiler.derive.geometry import EPS, Choose, Function, Polynomial, Wrap
from rsrm_gen.compiler.derive.matrix_functions import Eigenvalue, MatrixFunction

DIGITS = 60  # of every value computed here
TINY = mp.mpf(10) ** -40  # what counts as zero among numbers of size 1 with so many digits

Values = dict[sp.Symbol, Any]
Evaluation = Callable[[Mapping[sp.Symbol, Any]], Any]

ELEMENTARY = {
    sp.exp: magnitudes.exp, sp.log: mp.log, sp.sin: magnitudes.sin, sp.cos: magnitudes.cos, sp.tan: magnitudes.tan,
    sp.sinh: magnitudes.sinh, sp.cosh: magnitudes.cosh, sp.tanh: magnitudes.tanh, sp.asinh: mp.asinh, sp.acosh: mp.acosh,
    sp.acos: mp.acos, sp.atanh: mp.atanh, sp.Abs: abs, sp.atan2: mp.atan2, sp.sign: mp.sign,
}  # fmt: skip


def value(expression: sp.Expr, values: Mapping[sp.Symbol, Any]) -> Any:
    """The value of an expression; NaN where it is singular."""
    with mp.workdps(DIGITS):
        return _value(expression, values)


def _value(expression: sp.Expr, values: Mapping[sp.Symbol, Any]) -> Any:
    try:
        result = _compiled(expression)(values)
    except (ZeroDivisionError, ValueError, TypeError, OverflowError):  # TypeError: complex numbers are not ordered
        return mp.nan
    return mp.nan if isinstance(result, mp.mpc) else result


@lru_cache(maxsize=2**16)
def _compiled(expression: sp.Expr) -> Evaluation:
    """The expression as nested functions of the values of its symbols: several times faster than walking the tree."""
    if expression == EPS:
        return lambda values: values.get(EPS, mp.mpf(2) ** -52)
    if expression.is_Symbol:
        return lambda values: values[expression]
    if not expression.args:
        number = lru_cache(lambda prec: mp.mpf(expression._to_mpmath(prec + 10)))
        return lambda values: number(mp.mp.prec)
    if isinstance(expression, Choose):
        return _choice(expression)
    parts = [_compiled(a) for a in expression.args]
    if isinstance(expression, MatrixFunction):
        return lambda values: expression.value([part(values) for part in parts[3:]])
    if isinstance(expression, Eigenvalue):
        return lambda values: expression.value(tuple(part(values) for part in parts[2:]))
    if expression.is_Add:
        return lambda values: sum((part(values) for part in parts[1:]), parts[0](values))
    if expression.is_Mul:
        return lambda values: reduce(operator.mul, (part(values) for part in parts))
    if expression.is_Pow:
        return _power(parts[0], expression.exp, parts[1])
    if isinstance(expression, Wrap):
        return lambda values: _wrapped(parts[0](values), parts[1](values))
    if isinstance(expression, Polynomial):
        return lambda values: mp.polyval([part(values) for part in parts[:0:-1]], parts[0](values))
    function = ELEMENTARY[expression.func]
    return lambda values: function(*(part(values) for part in parts))


def _choice(expression: Choose) -> Evaluation:
    kind = int(expression.args[0])
    a, b, x, y = (_compiled(part) for part in expression.args[1:])
    holds = (operator.lt, operator.le, operator.eq)[kind]
    return lambda values: (x if holds(a(values), b(values)) else y)(values)


def _power(base: Evaluation, exponent: sp.Expr, power: Evaluation) -> Evaluation:
    if exponent.is_Integer:
        return lambda values: base(values) ** int(exponent)
    if exponent == sp.Rational(1, 2):
        return lambda values: mp.sqrt(base(values))
    return lambda values: mp.power(base(values), power(values))


def _wrapped(x: Any, period: Any) -> Any:
    return x - period * mp.nint(x / period)


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
    with mp.workdps(DIGITS):
        for assignment in function.assignments:
            values[assignment.symbol] = _value(assignment.expression, values)
        return [_value(result, values) for result in function.results], values
