"""Values of sympy expressions and staged functions in high precision, by mpmath."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import lru_cache
from typing import Any

import mpmath as mp
import sympy as sp
from mpmath import libmp

from rsrm_gen.compiler.budget import spend
from rsrm_gen.compiler.derive.geometry import EPS, Choose, Function, Polynomial, Wrap
from rsrm_gen.compiler.derive.matrix_functions import Eigenvalue, MatrixFunction
from rsrm_gen.compiler.derive.tape import Tape, number, raw

DIGITS = 60  # of every value computed here
PRECISION = libmp.dps_to_prec(DIGITS)
TINY = mp.mpf(10) ** -40  # what counts as zero among numbers of size 1 with so many digits
HALF = sp.Rational(1, 2)

Values = Mapping[sp.Symbol, Any]

ELEMENTARY = {
    sp.exp: "exp", sp.log: "log", sp.sin: "sin", sp.cos: "cos", sp.tan: "tan", sp.sinh: "sinh", sp.cosh: "cosh",
    sp.tanh: "tanh", sp.asinh: "asinh", sp.acosh: "acosh", sp.acos: "acos", sp.atanh: "atanh", sp.Abs: "abs",
    sp.atan2: "atan2",
}  # fmt: skip
CONDITIONS = ("less", "less_equal", "equal")  # by the kind of a `Choose`


def value(expression: sp.Expr, values: Mapping[sp.Symbol, Any]) -> Any:
    """The value of an expression; NaN where it is singular."""
    if expression.is_Symbol:
        return values.get(EPS, mp.mpf(2) ** -52) if expression == EPS else values[expression]
    tape, symbols, slot = _tape_of_expression(expression)
    given = [raw(values.get(EPS, mp.mpf(2) ** -52) if s == EPS else values[s]) for s in symbols]
    return number(tape.run(given, PRECISION)[slot])


def run(function: Function, *arguments: Sequence[Any], eps: float = 2.0**-52) -> tuple[list[Any], Values]:
    """The results of a staged function, unguarded, and the values of all its symbols."""
    spend()
    tape, symbols, results = tape_of(function)
    flat = [x for declared, given in zip(function.arguments, arguments, strict=True) for x in _entries(declared, given)]
    slots = tape.run([raw(eps), *map(raw, flat)], PRECISION)
    return [number(slots[slot]) for slot in results], _InSlots(symbols, slots)


class _InSlots(Mapping[sp.Symbol, Any]):
    """The values of symbols, as mpmath's numbers when they are asked for: most are not."""

    def __init__(self, symbols: Mapping[sp.Symbol, int], slots: Sequence[Any]) -> None:
        self.symbols = symbols
        self.slots = slots

    def __getitem__(self, symbol: sp.Symbol) -> Any:
        return number(self.slots[self.symbols[symbol]])

    def __iter__(self) -> Iterator[sp.Symbol]:
        return iter(self.symbols)

    def __len__(self) -> int:
        return len(self.symbols)


def _entries(declared: Any, given: Sequence[Any]) -> Sequence[Any]:
    if len(given) != len(declared.symbols):
        raise ValueError(f"`{declared.name}` has {len(declared.symbols)} entries, not {len(given)}")
    return given


@lru_cache(maxsize=4096)
def _tape_of_expression(expression: sp.Expr) -> tuple[Tape, tuple[sp.Symbol, ...], int]:
    symbols = tuple(sorted(expression.free_symbols, key=str))
    tape = Tape(len(symbols))
    slot = Writer(tape, {s: i for i, s in enumerate(symbols)}).slot(expression)
    return tape, symbols, slot


@lru_cache(maxsize=128)
def tape_of(function: Function) -> tuple[Tape, dict[sp.Symbol, int], tuple[int, ...]]:
    """A staged function as a tape, the slots of its symbols, and those of its results; the first input is EPS."""
    arguments = function.symbols()
    tape = Tape(1 + len(arguments))
    writer = Writer(tape, {EPS: 0} | {s: i + 1 for i, s in enumerate(arguments)})
    for assignment in function.assignments:
        writer.slots[assignment.symbol] = writer.slot(assignment.expression)
    results = tuple(writer.slot(result) for result in function.results)
    symbols = {a.symbol for a in function.assignments} | {EPS, *arguments}
    return tape, {s: slot for s, slot in writer.slots.items() if s in symbols}, results


class Writer:
    """Writes sympy expressions on a tape; `slots` knows the symbols, and what was written already."""

    def __init__(self, tape: Tape, slots: dict[sp.Expr, int]) -> None:
        self.tape = tape
        self.slots = slots

    def slot(self, expression: sp.Expr) -> int:
        """The slot of an expression."""
        if expression not in self.slots:
            self.slots[expression] = self.written(expression)
        return self.slots[expression]

    def written(self, expression: sp.Expr) -> int:
        tape = self.tape
        if not expression.args:
            return tape.constant(expression)
        if expression.is_Pow:
            return self.power(self.slot(expression.base), expression.exp)
        if isinstance(expression, MatrixFunction | Eigenvalue):
            return self.of_matrix(expression)
        if isinstance(expression, Choose):
            kind, a, b, x, y = expression.args
            condition = tape.write(CONDITIONS[int(kind)], self.slot(a), self.slot(b))
            return tape.write("select", condition, self.slot(x), self.slot(y))
        arguments = [self.slot(a) for a in expression.args]
        if expression.is_Add or expression.is_Mul:
            pair = "add" if expression.is_Add else "mul"
            return tape.write(pair if len(arguments) == 2 else "sum" if expression.is_Add else "product", *arguments)
        if isinstance(expression, Wrap):
            x, period = arguments
            turns = tape.write("round", tape.write("div", x, period))
            return tape.write("sub", x, tape.write("mul", period, turns))
        if isinstance(expression, Polynomial):
            return tape.write("polynomial", *arguments)
        if isinstance(expression, sp.sign):
            return tape.write("sign", *arguments, function=mp.sign)
        return tape.write(ELEMENTARY[expression.func], *arguments)

    def of_matrix(self, expression: Any) -> int:
        """An entry of a function of symmetric matrices, or an eigenvalue: all are computed at once."""
        head, index = expression.HEAD, expression.args[expression.INDEX]
        entries = [self.slot(e) for e in expression.args[head:]]
        name = f"{expression.func.__name__}{[expression.args[i] for i in range(head) if i != expression.INDEX]}"
        several = self.tape.write(name, *entries, function=lambda *values: expression.values(values))
        return self.tape.pick(several, int(index))

    def power(self, base: int, exponent: sp.Expr) -> int:
        tape = self.tape
        if exponent == HALF:
            return tape.write("sqrt", base)
        if exponent.is_number and exponent.is_negative:
            return tape.write("div", tape.constant(sp.Integer(1)), self.power(base, -exponent))
        if exponent == 1:
            return base
        if exponent == 2:
            return tape.write("mul", base, base)
        return tape.write("power", base, self.slot(exponent))


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
