"""Straight-line programs of real numbers: written once, run often, in any precision.

Formulas are evaluated thousands of times in 60 digits while they are derived and audited. A tape holds them as a list of
operations on numbered slots, each written once; it runs on mpmath's raw numbers, or on arrays of doubles.
An operation without a real value gives NaN, and what is computed from it does too.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import reduce
from typing import Any

import mpmath as mp
import numpy as np
import sympy as sp
from mpmath import libmp

from rsrm_gen.compiler.derive import magnitudes

Raw = Any  # mpmath's (sign, mantissa, exponent, bits); a truth value for a comparison

NEAREST = "n"
REFUSED = (ZeroDivisionError, ValueError, TypeError, OverflowError)  # what mpmath raises where there is no real value

# Each of (arguments..., precision, rounding), or of (arguments...) for a comparison.
UNARY: dict[str, Callable[..., Raw]] = {
    "neg": libmp.mpf_neg, "sqrt": libmp.mpf_sqrt, "root": libmp.mpf_sqrt, "exp": magnitudes.exp, "log": libmp.mpf_log,
    "sin": magnitudes.sin, "cos": magnitudes.cos, "tan": magnitudes.tan, "sinh": magnitudes.sinh, "cosh": magnitudes.cosh,
    "tanh": magnitudes.tanh, "asinh": libmp.mpf_asinh, "acosh": libmp.mpf_acosh, "acos": libmp.mpf_acos,
    "atanh": libmp.mpf_atanh, "abs": libmp.mpf_abs, "round": libmp.mpf_nint,
}  # fmt: skip
BINARY: dict[str, Callable[..., Raw]] = {
    "add": libmp.mpf_add, "sub": libmp.mpf_sub, "mul": libmp.mpf_mul, "div": libmp.mpf_div, "atan2": libmp.mpf_atan2,
    "power": libmp.mpf_pow,
}  # fmt: skip
COMPARISONS: dict[str, Callable[..., bool]] = {
    "less": libmp.mpf_lt,
    "less_equal": libmp.mpf_le,
    "equal": libmp.mpf_eq,
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


def _sum(precision: int, *terms: Raw) -> Raw:
    return libmp.mpf_sum(list(terms), precision, NEAREST)


def _product(precision: int, *factors: Raw) -> Raw:
    total = factors[0]
    for factor in factors[1:]:
        total = libmp.mpf_mul(total, factor, precision, NEAREST)
    return total


def _polynomial(precision: int, x: Raw, *coefficients: Raw) -> Raw:
    total = coefficients[-1]
    for c in coefficients[-2::-1]:
        total = libmp.mpf_add(libmp.mpf_mul(total, x, precision, NEAREST), c, precision, NEAREST)
    return total


MANY: dict[str, Callable[..., Raw]] = {"sum": _sum, "product": _product, "polynomial": _polynomial}

Instruction = tuple[int, Callable[..., Raw] | None, Any, int, int]  # kind, function, slots of up to three arguments


class Tape:
    """Operations in slots: first the inputs, then in the order of writing. What is written twice has one slot."""

    def __init__(self, inputs: int) -> None:
        self.size = inputs
        self.operations: list[tuple[str, tuple[int, ...]]] = []  # a constant is ("constant", (its number,))
        self.constants: list[Any] = []
        self.functions: dict[str, Callable[..., Any]] = {}  # of mpmath's numbers: operations not in the tables here
        self.known: dict[Any, int] = {}
        self.instructions: list[Instruction] = []
        self.constants_at: dict[int, list[Raw]] = {}

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

    def run(self, inputs: Sequence[Raw], precision: int) -> list[Raw]:
        """All slots, for raw inputs, with a binary precision."""
        slots = list(inputs)
        append = slots.append
        exact = self.rounded(precision)
        for kind, function, i, j, k in self.instructions:
            try:
                if kind == 2:
                    append(function(slots[i], slots[j], precision, NEAREST))  # type: ignore[misc]
                elif kind == 1:
                    append(function(slots[i], precision, NEAREST))  # type: ignore[misc]
                elif kind == 4:
                    append(exact[i])
                elif kind == 3:
                    append(slots[j] if slots[i] else slots[k])
                elif kind == 5:
                    append(function(slots[i], slots[j]))  # type: ignore[misc]
                else:
                    append(function(precision, *[slots[a] for a in i]))  # type: ignore[misc]
            except REFUSED:
                append(libmp.fnan)
        return slots

    def rounded(self, precision: int) -> list[Raw]:
        """The constants in a precision."""
        known = self.constants_at.setdefault(precision, [])
        known += [_raw_constant(c, precision) for c in self.constants[len(known) :]]
        return known

    def run_in_double(self, inputs: Sequence[Any]) -> list[Any]:
        """All slots, for arrays of doubles of one shape, rounded like the emitted code rounds."""
        slots = list(inputs)
        with np.errstate(all="ignore"):
            for operation, arguments in self.operations:
                if operation == "constant":
                    slots.append(libmp.to_float(self.rounded(100)[arguments[0]]))
                else:
                    function = IN_DOUBLE.get(operation) or _each(self.functions[operation])
                    slots.append(function(*(slots[a] for a in arguments)))
        return slots


def _instruction(operation: str, slots: tuple[int, ...], function: Callable[..., Any] | None) -> Instruction:
    if operation in UNARY:
        return 1, UNARY[operation], slots[0], 0, 0
    if operation in BINARY:
        return 2, BINARY[operation], slots[0], slots[1], 0
    if operation == "select":
        return 3, None, slots[0], slots[1], slots[2]
    if operation in COMPARISONS:
        return 5, COMPARISONS[operation], slots[0], slots[1], 0
    if operation in MANY:
        return 6, MANY[operation], slots, 0, 0
    assert function is not None, operation
    return 6, _wrapped(function), slots, 0, 0


def _wrapped(function: Callable[..., Any]) -> Callable[..., Raw]:
    """A function of mpmath's numbers as one of raw numbers; several numbers, of or from a function, are a list."""

    def raw_function(precision: int, *arguments: Raw) -> Raw:
        with mp.workprec(precision):
            result = function(*(tuple(a) if isinstance(a, list) else number(a) for a in arguments))
            return list(result) if isinstance(result, tuple) else raw(result)

    return raw_function


def _each(function: Callable[..., Any]) -> Callable[..., Any]:
    """A function of mpmath's numbers as one of arrays of doubles."""

    def value(*numbers: float) -> float:
        try:
            return float(function(*map(mp.mpf, numbers)))
        except REFUSED:
            return float("nan")

    return np.vectorize(value, otypes=[float])


def _raw_constant(exact: Any, precision: int) -> Raw:
    with mp.workprec(precision):
        return mp.mpf(exact._to_mpmath(precision + 10) if isinstance(exact, sp.Basic) else exact)._mpf_


def number(raw: Raw) -> Any:
    """A raw number as mpmath's own."""
    return mp.make_mpf(raw) if isinstance(raw, tuple) else raw


def raw(x: Any) -> Raw:
    """A number as a raw one, unrounded where it is mpmath's."""
    return x._mpf_ if isinstance(x, mp.mpf) else mp.mpf(x)._mpf_
