"""Runs a routine in mpmath: the reference for every back end, and with 60 digits the truth."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import Any

import mpmath as mp
from mpmath import libmp

from rsrm_gen.compiler.budget import spend
from rsrm_gen.compiler.derive.matrix_numeric import derivative, eigenvalues
from rsrm_gen.compiler.derive.tape import Tape, number, raw
from rsrm_gen.compiler.lower.ir import SEVERAL, Node, Routine

EPS = 2.0**-52


def interpret(routine: Routine, *arguments: Sequence[Any], digits: int = 60) -> list[list[Any]]:
    """The entries of every result for flat arguments; NaN where an operation has no value."""
    spend()
    tape, inputs, results = _tape_of(routine)
    given = {
        node: raw(x)
        for parameter, entries in zip(routine.parameters, arguments, strict=True)
        for node, x in zip(parameter.nodes, entries, strict=True)
    }
    slots = tape.run([given[node] for node in inputs], libmp.dps_to_prec(digits))
    return [[number(slots[slot]) for slot in result] for result in results]


def values_at(nodes: Sequence[Node], place: Mapping[Node, Any], digits: int = 60) -> list[Any]:
    """The values of some nodes where the inputs have given ones; NaN where they have none."""
    inputs = tuple(place)
    tape = Tape(len(inputs))
    slots = _written(tape, nodes, {node: i for i, node in enumerate(inputs)})
    values = tape.run([raw(place[node]) for node in inputs], libmp.dps_to_prec(digits))
    return [number(values[slots[node]]) for node in nodes]


@lru_cache(maxsize=64)
def _tape_of(routine: Routine) -> tuple[Tape, tuple[Node, ...], list[list[int]]]:
    inputs = tuple(node for parameter in routine.parameters for node in parameter.nodes)
    tape = Tape(len(inputs))
    slots = _written(tape, routine.nodes, {node: i for i, node in enumerate(inputs)})
    return tape, inputs, [[slots[node] for node in result.nodes] for result in routine.results]


def _written(tape: Tape, nodes: Sequence[Node], slots: dict[Node, int]) -> dict[Node, int]:
    """The slots of some nodes, arguments before users; an input that is not given is NaN."""
    for node in nodes:
        if node in slots:
            continue
        arguments = [slots[a] for a in node.arguments]
        if node.op == "constant":
            slots[node] = tape.constant(node.value)
        elif node.op in ("eps", "input"):
            slots[node] = tape.constant(mp.mpf(EPS) if node.op == "eps" else mp.nan)
        elif node.op == "polynomial":
            coefficients = [tape.constant(c) for c in node.value]  # type: ignore[attr-defined]
            slots[node] = tape.write("polynomial", *arguments, *coefficients)
        elif node.op in SEVERAL or node.op == "entry":
            name = f"{node.op} {node.number}"
            slots[node] = tape.write(
                name, *arguments, function=lambda *values, node=node: _matrix_operation(node, values)
            )
        else:
            slots[node] = tape.write(node.op, *arguments)
    return slots


def _matrix_operation(node: Node, arguments: Sequence[Any]) -> Any:
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
