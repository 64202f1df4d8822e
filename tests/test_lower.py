"""The graph: one node for one thing, what folds, derivatives against numerical ones in 50 digits, harmless branches."""

from __future__ import annotations

import keyword
import random
from collections.abc import Callable, Sequence
from typing import Any

import mpmath as mp
import pytest
import sympy as sp
from compiled import NAMES, program, spec_of

from rsrm_gen.compiler.derive import derive
from rsrm_gen.compiler.lower import Node, Parameter, Routine, interpret, lower
from rsrm_gen.compiler.lower.differentiate import RULES, gradient
from rsrm_gen.compiler.lower.ir import CONDITIONS, FUNCTIONS, Graph, Result, reachable
from rsrm_gen.compiler.lower.pairs import undeclared
from rsrm_gen.compiler.lower.protect import protect
from rsrm_gen.compiler.lower.schedule import schedule

DIGITS = 50


def values(graph: Graph, nodes: Sequence[Node], inputs: Sequence[Node], at: Sequence[Any]) -> list[Any]:
    """The values of some nodes, by the interpreter."""
    parameter = Parameter("x", (len(inputs),), tuple(inputs))
    routine = schedule(graph, "f", (parameter,), (Result("y", (len(nodes),), tuple(nodes)),), "")
    return interpret(routine, at, digits=DIGITS)[0]


def two_inputs() -> tuple[Graph, Node, Node]:
    graph = Graph()
    return graph, graph.input("a"), graph.input("b")


# Hash-consing and folding.


def test_the_same_expression_is_the_same_node() -> None:
    g, a, b = two_inputs()
    assert g.input("a") is a
    assert g.constant(2) is g.constant(sp.Integer(2))
    assert g.add(a, b) is g.add(b, a)
    assert g.mul(a, b) is g.mul(b, a)
    assert g.sub(a, b) is not g.sub(b, a)
    assert g.div(a, b) is not g.div(b, a)
    assert g.function("sin", g.add(a, b)) is g.function("sin", g.add(b, a))
    assert g.polynomial(a, (sp.Integer(1), sp.Integer(2))) is g.polynomial(a, (sp.Integer(1), sp.Integer(2)))


Fold = Callable[[Graph, Node, Node], tuple[Node, Node]]

FOLDS: dict[str, Fold] = {
    "a + 0": lambda g, a, b: (g.add(a, g.constant(0)), a),
    "0 + a": lambda g, a, b: (g.add(g.constant(0), a), a),
    "a - 0": lambda g, a, b: (g.sub(a, g.constant(0)), a),
    "0 - a": lambda g, a, b: (g.sub(g.constant(0), a), g.neg(a)),
    "a - a": lambda g, a, b: (g.sub(a, a), g.constant(0)),
    "a + -b": lambda g, a, b: (g.add(a, g.neg(b)), g.sub(a, b)),
    "-a + b": lambda g, a, b: (g.add(g.neg(a), b), g.sub(b, a)),
    "a - -b": lambda g, a, b: (g.sub(a, g.neg(b)), g.add(a, b)),
    "1 a": lambda g, a, b: (g.mul(g.constant(1), a), a),
    "0 a": lambda g, a, b: (g.mul(g.constant(0), a), g.constant(0)),
    "-1 a": lambda g, a, b: (g.mul(g.constant(-1), a), g.neg(a)),
    "(-a) (-b)": lambda g, a, b: (g.mul(g.neg(a), g.neg(b)), g.mul(a, b)),
    "(-a) b": lambda g, a, b: (g.mul(g.neg(a), b), g.neg(g.mul(a, b))),
    "2 (3 a)": lambda g, a, b: (g.mul(g.constant(2), g.mul(g.constant(3), a)), g.mul(g.constant(6), a)),
    "a / 1": lambda g, a, b: (g.div(a, g.constant(1)), a),
    "a / 4": lambda g, a, b: (g.div(a, g.constant(4)), g.mul(g.constant(sp.Rational(1, 4)), a)),
    "0 / a": lambda g, a, b: (g.div(g.constant(0), a), g.constant(0)),
    "(-a) / b": lambda g, a, b: (g.div(g.neg(a), b), g.neg(g.div(a, b))),
    "-(-a)": lambda g, a, b: (g.neg(g.neg(a)), a),
    "-(a - b)": lambda g, a, b: (g.neg(g.sub(a, b)), g.sub(b, a)),
    "root(a) root(a)": lambda g, a, b: (g.mul(g.function("root", a), g.function("root", a)), a),
    "2 + 3": lambda g, a, b: (g.add(g.constant(2), g.constant(3)), g.constant(5)),
    "2 - 3": lambda g, a, b: (g.sub(g.constant(2), g.constant(3)), g.constant(-1)),
    "1/3 exactly": lambda g, a, b: (g.div(g.constant(1), g.constant(3)), g.constant(sp.Rational(1, 3))),
    "select with one branch": lambda g, a, b: (g.select(g.node("less", a, b), a, a), a),
    "polynomial of degree 0": lambda g, a, b: (g.polynomial(a, (sp.Integer(7),)), g.constant(7)),
}


@pytest.mark.parametrize("fold", FOLDS.values(), ids=FOLDS)
def test_what_is_trivially_simpler_is_folded(fold: Fold) -> None:
    g, a, b = two_inputs()
    found, expected = fold(g, a, b)
    assert found is expected


def test_folding_keeps_the_value() -> None:
    rng = random.Random(3)
    for _ in range(200):
        g, a, b = two_inputs()
        nodes = [(a, mp.mpf("0.7")), (b, mp.mpf("-1.3")), (g.constant(0), 0), (g.constant(1), 1), (g.constant(-2), -2)]
        for _ in range(12):
            (x, vx), (y, vy) = rng.choice(nodes), rng.choice(nodes)
            made = [(g.add(x, y), vx + vy), (g.sub(x, y), vx - vy), (g.mul(x, y), vx * vy), (g.neg(x), -vx)]
            with mp.workdps(DIGITS):
                made += [(g.div(x, y), mp.mpf(vx) / vy)] if vy else []
            nodes.append(rng.choice(made))
        with mp.workdps(DIGITS):
            at = [mp.mpf("0.7"), mp.mpf("-1.3")]
            for (_, expected), found in zip(nodes, values(g, [n for n, _ in nodes], [a, b], at), strict=True):
                assert abs(found - expected) <= mp.mpf(10) ** -12 * (1 + abs(expected))


# Differentiation.

POLYNOMIAL = (sp.Rational(1, 3), sp.Integer(-2), sp.Rational(5, 7), sp.Integer(4))
Build = Callable[[Graph, Node, Node], Node]

OPERATIONS: dict[str, tuple[Build, tuple[str, str]]] = {
    "neg": (lambda g, a, b: g.node("neg", a), ("0.7", "0")),
    "add": (lambda g, a, b: g.node("add", a, b), ("0.7", "-1.2")),
    "sub": (lambda g, a, b: g.node("sub", a, b), ("0.7", "-1.2")),
    "mul": (lambda g, a, b: g.node("mul", a, b), ("0.7", "-1.2")),
    "mul by itself": (lambda g, a, b: g.node("mul", a, a), ("0.7", "0")),
    "div": (lambda g, a, b: g.node("div", a, b), ("0.7", "-1.2")),
    "div by itself": (lambda g, a, b: g.node("div", g.function("sin", a), a), ("0.7", "0")),
    "sqrt": (lambda g, a, b: g.function("sqrt", a), ("0.7", "0")),
    "root": (lambda g, a, b: g.function("root", a), ("0.7", "0")),
    "exp": (lambda g, a, b: g.function("exp", a), ("-0.7", "0")),
    "log": (lambda g, a, b: g.function("log", a), ("0.7", "0")),
    "sin": (lambda g, a, b: g.function("sin", a), ("0.7", "0")),
    "cos": (lambda g, a, b: g.function("cos", a), ("0.7", "0")),
    "tan": (lambda g, a, b: g.function("tan", a), ("0.7", "0")),
    "sinh": (lambda g, a, b: g.function("sinh", a), ("-0.7", "0")),
    "cosh": (lambda g, a, b: g.function("cosh", a), ("-0.7", "0")),
    "tanh": (lambda g, a, b: g.function("tanh", a), ("-0.7", "0")),
    "asinh": (lambda g, a, b: g.function("asinh", a), ("-0.7", "0")),
    "acosh": (lambda g, a, b: g.function("acosh", a), ("1.7", "0")),
    "acos": (lambda g, a, b: g.function("acos", a), ("-0.3", "0")),
    "atanh": (lambda g, a, b: g.function("atanh", a), ("-0.3", "0")),
    "atan2": (lambda g, a, b: g.function("atan2", a, b), ("0.7", "-1.2")),
    "abs": (lambda g, a, b: g.function("abs", a), ("-0.7", "0")),
    "abs above": (lambda g, a, b: g.function("abs", a), ("0.7", "0")),
    "round": (lambda g, a, b: g.function("round", a), ("1.7", "0")),
    "polynomial": (lambda g, a, b: g.polynomial(a, POLYNOMIAL), ("0.7", "0")),
    "select, less": (lambda g, a, b: g.select(g.node("less", a, b), g.mul(a, b), g.sub(a, b)), ("0.7", "1.2")),
    "select, not less": (lambda g, a, b: g.select(g.node("less", a, b), g.mul(a, b), g.sub(a, b)), ("1.2", "0.7")),
    "select, less_equal": (lambda g, a, b: g.select(g.node("less_equal", a, b), g.mul(a, b), a), ("0.7", "1.2")),
    "select, not equal": (lambda g, a, b: g.select(g.node("equal", a, b), a, g.mul(b, b)), ("0.7", "1.2")),
}
DISTINCT = {name.split(",")[0].split(" ")[0] for name in OPERATIONS}


def test_the_table_of_operations_is_complete() -> None:
    assert {"neg", "add", "sub", "mul", "div", "polynomial", "select", *FUNCTIONS} == DISTINCT
    assert set(RULES) - {"declared"} <= DISTINCT


def test_a_declared_derivative_is_used_again_and_again() -> None:
    g, a, _ = two_inputs()
    root = g.declared(g.function("sqrt", a), a)
    g.slopes[root] = (g.div(g.constant(sp.Rational(1, 2)), root),)
    (first,) = gradient(g, root, [a])
    (second,) = gradient(g, first, [a])
    moved, known = undeclared(g, [first, second], [a])
    found = values(moved, [known[first], known[second]], [known[a]], [mp.mpf(3)])
    with mp.workdps(DIGITS):
        assert abs(found[0] - mp.sqrt(3) / 6) < 1e-40
        assert abs(found[1] + mp.sqrt(3) / 36) < 1e-40


@pytest.mark.parametrize("operation", OPERATIONS.values(), ids=OPERATIONS)
def test_derivatives_are_those_of_the_values(operation: tuple[Build, tuple[str, str]]) -> None:
    build, place = operation
    g, a, b = two_inputs()
    # Inside something, with the inputs used elsewhere too, so that adjoints are passed on and added up.
    output = g.mul(g.function("sin", build(g, a, b)), g.add(a, g.mul(g.constant(3), b)))
    partials = gradient(g, output, (a, b))
    with mp.workdps(DIGITS):
        at = [mp.mpf(x) for x in place]
        h = mp.mpf(10) ** -15
        for i, found in enumerate(values(g, partials, [a, b], at)):
            high, low = (
                values(g, [output], [a, b], [x + sign * h * (i == j) for j, x in enumerate(at)])[0] for sign in (1, -1)
            )
            assert abs(found - (high - low) / (2 * h)) < mp.mpf(10) ** -25


def test_the_derivative_of_a_root_is_finite_at_zero() -> None:
    g, a, b = two_inputs()
    length = g.function("root", g.add(g.mul(a, a), g.mul(b, b)))
    assert values(g, gradient(g, length, (a, b)), [a, b], [0, 0]) == [0, 0]


def test_what_does_not_occur_has_derivative_zero() -> None:
    g, a, b = two_inputs()
    assert gradient(g, g.function("sin", a), (a, b))[1] is g.constant(0)
    assert gradient(g, g.constant(3), (a, b)) == (g.constant(0), g.constant(0))


def test_second_derivatives_are_gradients_of_gradients() -> None:
    g, a, b = two_inputs()
    f = g.mul(g.function("exp", a), g.function("sin", g.mul(a, b)))
    (fa, _) = gradient(g, f, (a, b))
    (_, fab) = gradient(g, fa, (a, b))
    with mp.workdps(DIGITS):
        x, y = mp.mpf("0.4"), mp.mpf("1.1")
        expected = mp.diff(lambda s, t: mp.exp(s) * mp.sin(s * t), (x, y), (1, 1))
        assert abs(values(g, [fab], [a, b], [x, y])[0] - expected) < mp.mpf(10) ** -20


# Branches.


def test_a_branch_that_is_not_taken_divides_by_nothing_that_vanishes() -> None:
    g, a, b = two_inputs()
    near = g.node("less", a, g.constant(sp.Rational(1, 10)))
    far = g.div(g.function("log", a), g.function("sqrt", a))
    taken = g.select(near, g.constant(1), protect(g, far, near, True))
    (slope, _) = gradient(g, taken, (a, b))
    for node in reachable([taken, slope]):
        if node.op in ("div", "sqrt", "log"):
            endangered = node.arguments[1 if node.op == "div" else 0]
            assert values(g, [endangered], [a, b], [0, 0])[0] > 0, node
    assert values(g, [taken, slope], [a, b], [0, 0]) == [1, 0]


def test_protection_changes_no_value_where_the_branch_is_taken() -> None:
    g, a, b = two_inputs()
    near = g.node("less", a, g.constant(sp.Rational(1, 10)))
    branch = g.div(g.function("log", g.add(a, b)), g.mul(g.function("sqrt", a), g.function("acosh", g.add(b, a))))
    for when, at in ((True, ["0.7", "1.9"]), (False, ["0.05", "1.9"])):
        protected = protect(g, branch, near, when)
        assert protected is not branch
        plain, safe = values(g, [branch, protected], [a, b], [mp.mpf(x) for x in at])
        assert plain == safe


def test_only_what_may_vanish_is_protected() -> None:
    g, a, b = two_inputs()
    near = g.node("less", a, b)
    branch = g.div(g.function("sqrt", b), a)
    protected = protect(g, branch, near, True, lambda node: node is a)
    assert protected.op == "div"
    assert protected.arguments[0] is g.function("sqrt", b)
    assert protected.arguments[1].op == "select"


def test_a_condition_is_known_inside_its_own_branch() -> None:
    g, a, b = two_inputs()
    near = g.node("less", a, b)
    assert protect(g, g.select(near, a, g.neg(b)), near, True) is g.neg(b)
    assert protect(g, g.select(near, a, g.neg(b)), near, False) is a


# The interpreter.


def test_the_interpreter_has_the_digits_that_are_asked_for() -> None:
    g, a, b = two_inputs()
    third = g.div(a, g.add(b, g.constant(sp.Rational(1, 3))))
    parameter = Parameter("x", (2,), (a, b))
    routine = schedule(g, "f", (parameter,), (Result("y", (), (third,)),), "")
    for digits in (15, 60, 120):
        with mp.workdps(digits + 5):
            error = abs(interpret(routine, [1, 0], digits=digits)[0][0] - 3)
            assert error < mp.mpf(10) ** (1 - digits)


def test_the_interpreter_says_nan_where_there_is_no_value() -> None:
    g, a, b = two_inputs()
    for node in (g.div(a, b), g.node("div", g.constant(0), b)):
        assert mp.isnan(values(g, [node], [a, b], [1, 0])[0])


# Schedules.

C_WORDS = {
    "auto", "break", "case", "char", "const", "continue", "default", "do", "double", "else", "enum", "extern", "float",
    "for", "goto", "if", "inline", "int", "long", "register", "restrict", "return", "short", "signed", "sizeof",
    "static", "struct", "switch", "typedef", "union", "unsigned", "void", "volatile", "while", "NULL", "NAN",
    "INFINITY", "HUGE_VAL", "DBL_EPSILON", "FLT_EPSILON",
}  # fmt: skip


def check_names(routine: Routine) -> None:
    names = [str(n.value) for p in routine.parameters for n in p.nodes] + [name for name, _ in routine.body]
    names += [p.name for p in routine.parameters if p.shape]
    assert len(names) == len(set(names))
    for name in names:
        assert name.isidentifier(), name
        assert name.isascii(), name
        assert not keyword.iskeyword(name), name
        assert name not in C_WORDS, name


@pytest.mark.parametrize("name", NAMES)
def test_names_are_unique_and_names_in_python_and_c(name: str) -> None:
    for routine in program(name):
        check_names(routine)


@pytest.mark.parametrize("name", NAMES)
def test_every_schedule_computes_before_it_uses(name: str) -> None:
    for routine in program(name):
        named = [node for _, node in routine.body]
        assert len(set(named)) == len(named)
        place = {node: i for i, node in enumerate(named)}
        for node in named:
            assert all(place[x] < place[node] for x in reachable(node.arguments) if x in place)
        conditions = [n for n in routine.nodes if n.op in CONDITIONS]
        users = [
            u
            for u in routine.nodes
            for i, x in enumerate(u.arguments)
            if x in conditions and (u.op, i) != ("select", 0)
        ]
        assert users == []


AWKWARD = [
    "case", "do", "goto", "default", "lambda", "print", "NAN", "NULL", "INFINITY", "DBL_EPSILON", "None", "i", "count",
    "value", "math", "torch", "self", "double", "near", "x0", "p0", "v0", "like", "polynomial", "j1", "I", "M_PI",
]  # fmt: skip

AUTHORS = """\
manifold: m
doc: R^2, written by an author with unusual taste in names.
chart: {{space: R^2}}
metric: dot(u, v)
exp: p + v
log:
  let:
    {name}: "sin(q[0]) + 2"
    {name}{name}: "norm(q - p)"
  value: (q - p) * where({name} > {name}{name}, {name} / ({name} + 1), {name} / ({name} + 1))
distance: {name}{name} * exp({name}) * {name} / exp({name}) / {name}
injectivity_radius: infinity
"""


@pytest.mark.parametrize("name", AWKWARD)
def test_authors_may_choose_any_name(name: str) -> None:
    for routine in lower(derive(spec_of(AUTHORS.format(name=name)))):
        check_names(routine)


@pytest.mark.parametrize(
    "formula", ["norm(2 * q - 2 * p) / 2", "norm(1/2 * (q - p)) * 2", "sqrt(dot(3 * (q - p), q - p) / 3)"]
)
def test_formulas_give_names_that_are_names(formula: str) -> None:
    text = AUTHORS.format(name="a").replace("aa * exp(a) * a / exp(a) / a", formula)
    for routine in lower(derive(spec_of(text))):
        check_names(routine)
