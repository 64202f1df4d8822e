"""The steps of a pair's function: each reads what is there, and nothing slow is waited for within one."""

from __future__ import annotations

from collections.abc import Sequence

import pytest
from compiled import NAMES, program

from rsrm_gen.compiler.emit.c_vector import reads
from rsrm_gen.compiler.emit.steps import SLOW, Step, expression, steps
from rsrm_gen.compiler.lower import Node, Routine
from rsrm_gen.compiler.lower.ir import CONDITIONS, SEVERAL, Graph


def names_of(graph: Graph, found: Sequence[Step]) -> list[tuple[list[str], list[str]]]:
    return [([graph.names[n] for n in step.nodes], [graph.names[n] for n in step.kept]) for step in found]


def test_a_root_and_an_exponential_part_a_chain_and_little_is_kept() -> None:
    graph = Graph()
    x, y = graph.input("x"), graph.input("y")
    near = graph.named("near", graph.node("less", x, y))
    square = graph.named("square", graph.mul(x, x))
    w = graph.named("w", graph.function("sqrt", graph.add(square, y)))
    early = graph.named("early", graph.mul(y, y))
    e = graph.named("e", graph.function("exp", w))
    chosen = graph.named("chosen", graph.select(near, e, w))
    late = graph.named("late", graph.mul(chosen, early))
    named = [near, square, w, early, e, chosen, late]
    found = steps(named, [late], reads, {*named, x, y})
    assert names_of(graph, found) == [
        (["square", "w"], []),
        (["e"], ["w"]),
        (["near", "early", "chosen", "late"], ["w", "e"]),
    ]


def test_nothing_slow_is_one_step() -> None:
    graph = Graph()
    x = graph.input("x")
    double = graph.named("double", graph.add(x, x))
    assert names_of(graph, steps([double], [double], reads, {x, double})) == [(["double"], [])]


def vectors_of(routine: Routine) -> set[Node]:
    found = {node for p in routine.parameters if p.name != "S" for node in p.nodes}
    for node in routine.nodes:
        if any(a in found for a in node.arguments):
            found.add(node)
    return found


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("routine", ["value", "forward", "backward"])
def test_what_a_step_reads_is_kept_or_its_own_and_not_slow(name: str, routine: str) -> None:
    pair: Routine = getattr(program(name).pairs, routine)
    named, vectors = [node for _, node in pair.body], vectors_of(pair)
    results = [node for result in pair.results for node in result.nodes]
    found = steps(named, results, reads, vectors)
    known = set(named)
    done: set[Node] = set()
    for step in found:
        assert set(step.kept) <= done
        assert not set(step.kept) & set(step.nodes)
        own: set[Node] = set()
        for node in step.nodes:
            read = {n for n in expression(reads(node), reads, known) if n in known}
            assert read <= own | set(step.kept)
            waits = {n for n in read & own if n.op in SLOW and n in vectors}
            assert not waits or any(n.op in SEVERAL for n in named)
            own.add(node)
        done |= {n for n in own if n.op not in CONDITIONS}
    assert {n for n in expression(results, reads, known) if n in known} <= own | set(found[-1].kept)
