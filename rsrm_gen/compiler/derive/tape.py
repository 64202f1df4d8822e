"""Straight-line programs of real numbers: written once, run often, in any precision.

Formulas are evaluated thousands of times in 60 digits while they are derived and audited. A tape holds them as a list of
operations on numbered slots, each written once; it runs on gmpy2's real numbers, or on arrays of doubles.
An operation without a real value gives NaN, and what is computed from it does too.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Sequence
from contextlib import nullcontext
from dataclasses import dataclass
from functools import reduce
from typing import Any

import gmpy2
import mpmath as mp
import numpy as np
import sympy as sp

from rsrm_gen.compiler.derive import reals
from rsrm_gen.compiler.derive.reals import NAN, Raw, Real, from_mpmath, in_precision, to_mpmath

REFUSED = (ZeroDivisionError, ValueError, TypeError, OverflowError)  # what mpmath raises where there is no real value

UNARY: dict[str, Callable[[Real], Real]] = {
    "neg": operator.neg, "sqrt": gmpy2.sqrt, "root": gmpy2.sqrt, "exp": gmpy2.exp, "log": gmpy2.log,
    "sin": reals.sin, "cos": reals.cos, "tan": reals.tan, "sinh": gmpy2.sinh, "cosh": gmpy2.cosh,
    "tanh": gmpy2.tanh, "asinh": gmpy2.asinh, "acosh": gmpy2.acosh, "acos": gmpy2.acos,
    "atanh": gmpy2.atanh, "abs": operator.abs, "round": gmpy2.rint,
}  # fmt: skip
BINARY: dict[str, Callable[[Real, Real], Any]] = {
    "add": operator.add, "sub": operator.sub, "mul": operator.mul, "div": reals.divide, "atan2": reals.atan2,
    "power": reals.power, "less": operator.lt, "less_equal": operator.le, "equal": operator.eq,
}  # fmt: skip
MANY: dict[str, Callable[..., Real]] = {
    "sum": reals.sum_of,
    "product": reals.product_of,
    "polynomial": reals.polynomial,
}

IN_DOUBLE: dict[str, Callable[..., Any]] = {
    "neg": np.negative, "sqrt": np.sqrt, "root": np.sqrt, "exp": np.exp, "log": np.log, "sin": np.sin, "cos": np.cos,
    "tan": np.tan, "sinh": np.sinh, "cosh": np.cosh, "tanh": np.tanh, "asinh": np.arcsinh, "acosh": np.arccosh,
    "acos": np.arccos, "atanh": np.arctanh, "abs": np.abs, "round": np.rint, "add": np.add, "sub": np.subtract,
    "mul": np.multiply, "div": np.divide, "atan2": np.arctan2, "power": np.power, "less": np.less,
    "less_equal": np.less_equal, "equal": np.equal, "select": np.where,
    "sum": lambda *terms: reduce(np.add, terms),
    "product": lambda *factors: reduce(np.multiply, factors),
    "polynomial": lambda x, *coefficients: reduce(lambda total, c: total * x + c, coefficients[::-1]),
}  # fmt: skip


Instruction = tuple[int, Callable[..., Any] | None, Any, int, int]  # kind, function, slots of up to three arguments


class Tape:
    """Operations in slots: first the inputs, then in the order of writing. What is written twice has one slot."""

    def __init__(self, inputs: int) -> None:
        self.size = inputs
        self.operations: list[tuple[str, tuple[int, ...]]] = []  # a constant is ("constant", (its number,))
        self.constants: list[Any] = []
        self.functions: dict[str, Callable[..., Any]] = {}  # of mpmath's numbers: operations not in the tables here
        self.known: dict[Any, int] = {}
        self.instructions: list[Instruction] = []
        self.constants_at: dict[int, list[Real]] = {}

    def constant(self, number: Any) -> int:
        """The slot of an exact number: sympy's or mpmath's."""
        key = ("constant", number)
        if key not in self.known:
            self.known[key] = self.size
            self.append("constant", (len(self.constants),), (4, None, len(self.constants), 0, 0))
            self.constants.append(number)
        return self.known[key]

    def write(self, operation: str, *slots: int, function: Callable[..., Any] | None = None) -> int:
        """The slot of an operation on slots; one that is not in the tables here by its function of mpmath numbers."""
        key = (operation, slots)
        if key not in self.known:
            self.known[key] = self.size
            if function is not None:
                self.functions[operation] = function
            self.append(operation, slots, _instruction(operation, slots, function))
        return self.known[key]

    def append(self, operation: str, slots: tuple[int, ...], instruction: Instruction) -> None:
        self.operations.append((operation, slots))
        self.instructions.append(instruction)
        self.size += 1

    def pick(self, several: int, index: int) -> int:
        """The slot of one of the numbers that a function has."""
        return self.write(f"number {index}", several, function=_Pick(index))

    def run(self, inputs: Sequence[Raw], precision: int) -> list[Real]:
        """All slots, for raw inputs, with a binary precision."""
        with in_precision(max(precision, reals.widest(inputs))):
            slots = [from_mpmath(x) for x in inputs]
        append = slots.append
        with in_precision(precision), mp.workprec(precision) if self.functions else nullcontext():
            exact = self.rounded(precision)
            for kind, function, i, j, k in self.instructions:
                try:
                    if kind == 2:
                        append(function(slots[i], slots[j]))  # type: ignore[misc]
                    elif kind == 1:
                        append(function(slots[i]))  # type: ignore[misc]
                    elif kind == 4:
                        append(exact[i])
                    elif kind == 3:
                        append(slots[j] if slots[i] else slots[k])
                    else:
                        append(function(*[slots[a] for a in i]))  # type: ignore[misc]
                except REFUSED:
                    append(NAN)
        return slots

    def rounded(self, precision: int) -> list[Real]:
        """The constants in the precision, which is that in force."""
        known = self.constants_at.setdefault(precision, [])
        known += [from_mpmath(_raw_constant(c, precision)) for c in self.constants[len(known) :]]
        return known

    def run_in_double(self, inputs: Sequence[Any]) -> list[Any]:
        """All slots, for arrays of doubles of one shape, rounded like the emitted code rounds."""
        slots = list(inputs)
        with in_precision(100), np.errstate(all="ignore"):
            exact = self.rounded(100)
            for operation, arguments in self.operations:
                if operation == "constant":
                    slots.append(float(exact[arguments[0]]))
                else:
                    function = IN_DOUBLE.get(operation) or _each(self.functions[operation])
                    slots.append(_as_doubles(function(*(slots[a] for a in arguments))))
        return slots


def _instruction(operation: str, slots: tuple[int, ...], function: Callable[..., Any] | None) -> Instruction:
    if operation in UNARY:
        return 1, UNARY[operation], slots[0], 0, 0
    if operation in BINARY:
        return 2, BINARY[operation], slots[0], slots[1], 0
    if operation == "select":
        return 3, None, slots[0], slots[1], slots[2]
    if operation in MANY:
        return 5, MANY[operation], slots, 0, 0
    assert function is not None, operation
    if isinstance(function, _Pick):
        return 1, function.of_mpmath, slots[0], 0, 0
    return 5, _wrapped(function), slots, 0, 0


@dataclass(frozen=True)
class _Pick:
    """Takes one of several numbers."""

    index: int

    def __call__(self, numbers: Sequence[Any]) -> Any:
        return numbers[self.index]

    def of_mpmath(self, numbers: Sequence[Any]) -> Real:
        """It as a real number; of a slot that has no several numbers this raises `TypeError`."""
        return from_mpmath(numbers[self.index]._mpf_)


def _wrapped(function: Callable[..., Any]) -> Callable[..., Any]:
    """A function of mpmath's numbers as one of real ones; several numbers, of or from a function, stay mpmath's."""

    def real_function(*arguments: Any) -> Any:
        result = function(*map(number, arguments))
        return result if isinstance(result, tuple) else from_mpmath(raw(result))

    return real_function


def _each(function: Callable[..., Any]) -> Callable[..., Any]:
    """A function of mpmath's numbers as one of arrays of doubles; several numbers, of or from it, are a tuple."""

    def value(*numbers: Any) -> Any:
        try:
            result = function(*(a if isinstance(a, tuple) else mp.mpf(a) for a in numbers))
            return result if isinstance(result, tuple) else float(result)
        except REFUSED:
            return float("nan")

    return np.vectorize(value, otypes=[object])


def _as_doubles(values: Any) -> Any:
    """Values of a function of one number as doubles; where it has several, they stay tuples."""
    return values if values.dtype != object or isinstance(values.flat[0], tuple) else values.astype(float)


def _raw_constant(exact: Any, precision: int) -> Raw:
    with mp.workprec(precision):
        return raw(mp.mpf(exact._to_mpmath(precision + 10) if isinstance(exact, sp.Basic) else exact))


def number(slot: Any) -> Any:
    """What is in a slot as a number of mpmath; other things are left as they are."""
    return to_mpmath(slot) if isinstance(slot, gmpy2.mpfr) else slot


def raw(x: Any) -> Raw:
    """A number as a raw one, unrounded where it is mpmath's."""
    found: Raw = (x if isinstance(x, mp.mpf) else mp.mpf(x))._mpf_
    return found
