"""The tape's real numbers are mpmath's: exactly where mpmath rounds exactly, to the last bit elsewhere, NaN where it has none."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import mpmath as mp
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mpmath import libmp

from rsrm_gen.compiler.derive.reals import from_mpmath, in_precision, to_mpmath
from rsrm_gen.compiler.derive.tape import Tape, number, raw

BITS = 203
REFUSED = (ZeroDivisionError, ValueError, TypeError, OverflowError)

EXACT: dict[str, Callable[..., Any]] = {
    "neg": libmp.mpf_neg, "abs": libmp.mpf_abs, "sqrt": libmp.mpf_sqrt, "root": libmp.mpf_sqrt, "round": libmp.mpf_nint,
    "add": libmp.mpf_add, "sub": libmp.mpf_sub, "mul": libmp.mpf_mul, "div": libmp.mpf_div,
}  # fmt: skip
TO_THE_LAST_BIT: dict[str, Callable[..., Any]] = {
    "exp": libmp.mpf_exp, "log": libmp.mpf_log, "sin": libmp.mpf_sin, "cos": libmp.mpf_cos, "tan": libmp.mpf_tan,
    "sinh": libmp.mpf_sinh, "cosh": libmp.mpf_cosh, "tanh": libmp.mpf_tanh, "asinh": libmp.mpf_asinh,
    "acosh": libmp.mpf_acosh, "acos": libmp.mpf_acos, "atanh": libmp.mpf_atanh,
}  # fmt: skip
COMPARISONS = {"less": libmp.mpf_lt, "less_equal": libmp.mpf_le, "equal": libmp.mpf_eq}
BINARY = ("add", "sub", "mul", "div", *COMPARISONS)

SPECIAL = st.sampled_from([libmp.fnan, libmp.finf, libmp.fninf, libmp.fzero, libmp.fone, libmp.fnone])


def numbers(smallest: int, largest: int, bits: int = BITS) -> st.SearchStrategy[Any]:
    """Raw numbers of both signs between two powers of two."""
    mantissas = st.integers(-(2**bits) + 1, 2**bits - 1)
    exponents = st.integers(smallest - bits, largest - bits)
    return st.builds(lambda m, e: libmp.from_man_exp(m, e), mantissas, exponents)


ANY = SPECIAL | numbers(-20, 20) | numbers(-4000, 4000)
FINITE = numbers(-10, 10) | numbers(-20, 20, 3)


def on_a_tape(operation: str, *inputs: Any) -> Any:
    tape = Tape(len(inputs))
    slot = tape.write(operation, *range(len(inputs)))
    return number(tape.run(inputs, BITS)[slot])


def by_mpmath(function: Callable[..., Any], *inputs: Any, bits: int = 2 * BITS) -> Any:
    try:
        return mp.make_mpf(function(*inputs, bits, "n"))
    except REFUSED:
        return mp.nan


def alike(found: Any, expected: Any, within: float) -> bool:
    if not mp.isfinite(expected) or not mp.isfinite(found) or expected == 0:
        return found._mpf_ == expected._mpf_
    with mp.workprec(2 * BITS):
        return bool(abs(found - expected) <= within * mp.mpf(2) ** -BITS * abs(expected))


@pytest.mark.parametrize("operation", EXACT)
@settings(max_examples=150, deadline=None)
@given(st.tuples(ANY, ANY))
def test_arithmetic_is_mpmaths(operation: str, inputs: tuple[Any, Any]) -> None:
    arguments = inputs if operation in BINARY else inputs[:1]
    found = on_a_tape(operation, *arguments)
    assert alike(found, by_mpmath(EXACT[operation], *arguments, bits=BITS), 0)


@pytest.mark.parametrize("operation", TO_THE_LAST_BIT)
@settings(max_examples=150, deadline=None)
@given(SPECIAL | numbers(-20, 20) | numbers(-4000, 25))
def test_functions_are_mpmaths(operation: str, x: Any) -> None:
    assert alike(on_a_tape(operation, x), by_mpmath(TO_THE_LAST_BIT[operation], x), 1)


@pytest.mark.parametrize("operation", COMPARISONS)
@settings(max_examples=150, deadline=None)
@given(ANY, ANY)
def test_comparisons_are_mpmaths(operation: str, a: Any, b: Any) -> None:
    assert on_a_tape(operation, a, b) is bool(COMPARISONS[operation](a, b))
    assert on_a_tape(operation, a, a) is bool(COMPARISONS[operation](a, a))


@settings(max_examples=300, deadline=None)
@given(FINITE | st.just(libmp.fzero), FINITE | st.just(libmp.fzero))
def test_angles_and_powers_are_mpmaths(a: Any, b: Any) -> None:
    assert alike(on_a_tape("atan2", a, b), by_mpmath(libmp.mpf_atan2, a, b), 1)
    if a == libmp.fzero and libmp.mpf_lt(b, a):
        assert mp.isnan(on_a_tape("power", a, b))
    else:
        assert alike(on_a_tape("power", a, b), by_mpmath(libmp.mpf_pow, a, b), 1)


@settings(max_examples=300, deadline=None)
@given(st.lists(ANY, min_size=3, max_size=6))
def test_sums_and_products_are_mpmaths(terms: list[Any]) -> None:
    exactly = libmp.mpf_sum(terms)  # rounded on the way, it drops small terms that outlive large ones
    assert alike(on_a_tape("sum", *terms), mp.make_mpf(libmp.mpf_pos(exactly, BITS, "n")), 0)
    product = terms[0]
    for factor in terms[1:]:
        product = libmp.mpf_mul(product, factor, BITS, "n")
    assert alike(on_a_tape("product", *terms), mp.make_mpf(product), 0)


@settings(max_examples=300, deadline=None)
@given(ANY | numbers(-10, 10, 3 * BITS))
def test_numbers_come_back_as_they_went(x: Any) -> None:
    with in_precision(3 * BITS):
        assert to_mpmath(from_mpmath(x))._mpf_ == x


@pytest.mark.parametrize("bits", [53, 3 * BITS])
def test_inputs_are_not_rounded(bits: int) -> None:
    x = mp.make_mpf(libmp.from_man_exp(2**bits + 1, -bits))
    assert on_a_tape("sub", raw(x), libmp.fone) == mp.mpf(2) ** -bits


def test_there_is_one_zero() -> None:
    tape = Tape(1)
    zero = tape.write("neg", 0)
    angle = tape.write("atan2", zero, tape.constant(-1))
    assert abs(number(tape.run([libmp.fzero], BITS)[angle]) - mp.pi) < 1e-15


@pytest.mark.parametrize("word", ["sin", "cos", "tan"])
def test_there_is_no_sine_of_what_is_huge(word: str) -> None:
    assert mp.isnan(on_a_tape(word, libmp.from_man_exp(1, 10**9)))


@pytest.mark.parametrize(("word", "limit"), [("exp", mp.inf), ("cosh", mp.inf), ("tanh", mp.mpf(1)), ("sinh", mp.inf)])
def test_exponentials_of_what_is_huge_are_quick(word: str, limit: Any) -> None:
    assert on_a_tape(word, libmp.from_man_exp(1, 10**8)) == limit


def test_several_numbers_are_picked_from() -> None:
    tape = Tape(2)
    several = tape.write("both", 0, 1, function=lambda a, b: (a + b, a - b))
    slots = [tape.pick(several, 1), tape.pick(tape.write("log", 0), 0)]
    found = tape.run([raw(3), raw(5)], BITS)
    assert number(found[slots[0]]) == -2
    assert mp.isnan(number(found[slots[1]]))
