"""How many arithmetic operations the kernel does for a pair of a point and a splat, counted from its routines.

Additions, subtractions, multiplications, divisions and roots count 1, so that a multiply-add is 2; a polynomial counts 2 a
step, of the degree that the precision has; exp and every other function count as reducing the argument and a polynomial.
Comparisons, choices, signs and absolute values count nothing, nor does loading. Every result is added to a sum: 1.
That is less than what runs: a division or root costs many times more than its 1.
"""

from __future__ import annotations

from rsrm_gen.compiler.emit.series import in_single
from rsrm_gen.compiler.lower import Node, Program, Routine

ONE = {"add", "sub", "mul", "div", "sqrt", "root"}
NOTHING = {
    "input",
    "constant",
    "eps",
    "entry",
    "neg",
    "abs",
    "round",
    "select",
    "less",
    "less_equal",
    "equal",
    "declared",
}
# x / log 2 rounded, twice subtracted with its low part, then a polynomial of degree 11, or 5.
FUNCTION = {"float64": 1 + 4 + 22, "float32": 1 + 4 + 10}


def pair_operations(program: Program, precision: str) -> int:
    """Operations of the forward and the backward pass for one pair."""
    return sum(_of_routine(routine, precision) for routine in (program.pairs.forward, program.pairs.backward))


def _of_routine(routine: Routine, precision: str) -> int:
    sums = sum(len(result.nodes) for result in routine.results)
    return sums + sum(_of_node(node, precision) for node in routine.nodes)


def _of_node(node: Node, precision: str) -> int:
    if node.op in ONE:
        return 1
    if node.op in NOTHING:
        return 0
    if node.op == "polynomial":
        coefficients: tuple[object, ...] = node.value  # type: ignore[assignment]
        degree = in_single(coefficients).degree if precision == "float32" else len(coefficients) - 1
        return 2 * degree
    return FUNCTION[precision]
