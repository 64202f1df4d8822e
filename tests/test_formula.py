"""The grammar of formulas: what binds how, where an error is said to be, and that nothing gets past it."""

from __future__ import annotations

import re
from fractions import Fraction

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from rsrm_gen.compiler.spec import formula as f
from rsrm_gen.compiler.spec.unparse import written
from rsrm_gen.errors import Source, Span, UserError


def parse(text: str) -> f.Tree:
    return f.parse(text, Span(Source("file.yaml", text), 1, 1, max(len(text), 1)))


def shown(tree: f.Tree) -> str:
    """A tree with every parenthesis written out."""
    match tree:
        case f.Number(value):
            return str(value)
        case f.Name(name):
            return name
        case f.Negate(operand):
            return f"(-{shown(operand)})"
        case f.Binary(operator, left, right) | f.Compare(operator, left, right):
            return f"({shown(left)} {operator} {shown(right)})"
        case f.Stack(items) | f.Rows(items):
            return f"[{', '.join(map(shown, items))}]"
        case f.Call(function, arguments):
            return f"{function}({', '.join(map(shown, arguments))})"
        case f.Index(base, start, stop, True):
            return f"{shown(base)}[{shown(start) if start else ''}:{shown(stop) if stop else ''}]"
        case f.Index(base, start, _, False):
            assert start is not None
            return f"{shown(base)}[{shown(start)}]"
    raise AssertionError(tree)


@pytest.mark.parametrize(
    ("text", "meaning"),
    [
        ("-x^2", "(-(x ^ 2))"),
        ("-x*y", "((-x) * y)"),
        ("a - -b", "(a - (-b))"),
        ("a/b*c", "((a / b) * c)"),
        ("a/b/c", "((a / b) / c)"),
        ("a - b - c", "((a - b) - c)"),
        ("a + b*c", "(a + (b * c))"),
        ("a*b^c", "(a * (b ^ c))"),
        ("a^b^c", "(a ^ (b ^ c))"),
        ("a**b", "(a ^ b)"),
        ("2^-1", "(2 ^ (-1))"),
        ("2^-x*y", "((2 ^ (-x)) * y)"),
        ("2^-3^2", "(2 ^ (-(3 ^ 2)))"),
        ("-p[0]^2", "(-(p[0] ^ 2))"),
        ("(a + b)*c", "((a + b) * c)"),
        ("+a", "a"),
        ("a < b + 1", "(a < (b + 1))"),
        ("a == b", "(a = b)"),
        ("a >= b", "(a >= b)"),
        ("p[1:]", "p[1:]"),
        ("p[:n-1][0]", "p[:(n - 1)][0]"),
        ("p[i+1:2*n]", "p[(i + 1):(2 * n)]"),
        ("[1, v]", "[1, v]"),
        ("[[1, 0], [0, 1]]", "[[1, 0], [0, 1]]"),
        ("where(a < b, x, -y)", "where((a < b), x, (-y))"),
        ("f (x)", "f(x)"),
        ("dot(\tp ,\n q )", "dot(p, q)"),
    ],
)
def test_operators_bind_as_in_mathematics(text: str, meaning: str) -> None:
    assert shown(parse(text)) == meaning


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("0.1", Fraction(1, 10)),
        ("1e-3", Fraction(1, 1000)),
        ("2.5E+2", Fraction(250)),
        ("3.", Fraction(3)),
        ("9007199254740993", Fraction(2**53 + 1)),
        ("0.30000000000000000001", Fraction(30000000000000000001, 10**20)),
        ("1e300", Fraction(10**300)),
    ],
)
def test_numbers_are_kept_exactly(text: str, value: Fraction) -> None:
    tree = parse(text)
    assert isinstance(tree, f.Number)
    assert tree.value == value


@pytest.mark.parametrize(
    ("text", "column", "fragment"),
    [
        ("", 1, "ends where a value is expected"),
        ("a +", 4, "ends where a value is expected"),
        ("a + * b", 5, "`*` stands where a value is expected"),
        ("2 a", 3, "`a` is not expected here"),
        ("a b", 3, "write `*` between two factors"),
        ("a = b = c", 7, "`=` is not expected here"),
        ("(a + b", 7, "expected `)`, found the end"),
        ("dot(p, q]", 9, "expected `)`, found `]`"),
        ("f()", 3, "`)` stands where a value is expected"),
        ("[1, ]", 5, "`]` stands where a value is expected"),
        ("p[]", 3, "`]` stands where a value is expected"),
        ("p[1", 4, "expected `]`"),
        ("p, q", 2, "`,` is not expected here"),
        ("a)", 2, "`)` is not expected here"),
        ("a $ b", 3, "the character '$' has no meaning"),
        ("x + |v|", 5, "norm(v)"),
        ("{a, b}", 1, "[a, b]"),
        ("1 + .5", 5, "0.5"),
        ("a; b", 2, "';'"),
        ("a != b", 3, "'!'"),
        ("'a'", 1, "has no meaning"),
        ("p.real", 2, "has no meaning"),
        ("lambda: 0", 7, "`:` is not expected here"),
        ("2 \u2212 1", 3, "plain ASCII"),  # a minus sign that is not a hyphen
        ("\u0440 + 1", 1, "plain ASCII"),  # a Cyrillic p
        ("p\u00b2", 2, "plain ASCII"),  # a superscript two
        ("\u0663 + 1", 1, "plain ASCII"),  # an Arabic three
        ("1e301", 1, "out of the range"),
        ("1 + 1e-400", 5, "out of the range"),
    ],
)
def test_errors_stand_under_the_character_that_is_wrong(text: str, column: int, fragment: str) -> None:
    with pytest.raises(UserError) as error:
        parse(text)
    assert error.value.span is not None
    assert (error.value.span.line, error.value.span.column) == (1, column)
    assert fragment in str(error.value)


def test_errors_keep_the_place_of_the_formula_in_its_file() -> None:
    source = Source("m.yaml", "manifold: m\nexp: p + + * v\n")
    with pytest.raises(UserError) as error:
        f.parse("p + + * v", Span(source, 2, 6, 9))
    assert str(error.value).splitlines() == [
        "m.yaml:2:12: error: `*` stands where a value is expected",
        "  exp: p + + * v",
        "             ^",
    ]


def test_every_word_of_a_formula_knows_its_place() -> None:
    text = "cos(norm(v)) * p + 12"
    tree = parse(text)
    assert isinstance(tree, f.Binary)
    assert (tree.span.column, tree.right.span.column, tree.right.span.length) == (18, 20, 2)
    product = tree.left
    assert isinstance(product, f.Binary)
    assert (product.left.span.column, product.left.span.length) == (1, 3)


DEEP = {
    "parentheses": "(" * 1000 + "a" + ")" * 1000,
    "calls": "f(" * 1000 + "a" + ")" * 1000,
    "stacks": "[" * 1000 + "a" + "]" * 1000,
    "indices in indices": "p[" * 1000 + "0" + "]" * 1000,
    "indices of indices": "p" + "[0]" * 1000,
    "powers": "^".join(["a"] * 1000),
    "signs": "-" * 1000 + "a",
    "signs in powers": "a^-" * 1000 + "a",
    "terms": "+".join(["a"] * 1000),
    "factors": "*".join(["a"] * 1000),
    "characters": "a" * 5000,
}


@pytest.mark.parametrize("text", DEEP.values(), ids=DEEP)
def test_formulas_beyond_what_a_person_writes_are_refused(text: str) -> None:
    with pytest.raises(UserError, match=r"deeper|more than|too many|at most|out of"):
        parse(text)


WORDS = st.sampled_from(
    [*"pquv+-*/^()[],:<>= .0123", "**", "==", "<=", "norm(", "dot(p, q)", "1e9", "p[", "[[", "]]", "\u0663", "\u2212"]
)


fuzz = settings(derandomize=True, database=None, deadline=None, max_examples=300)


@fuzz
@given(st.one_of(st.text(max_size=60), st.lists(WORDS, max_size=30).map("".join)))
@example("p[" * 1500)
@example("1e" + "9" * 3000)
def test_any_text_gives_a_tree_or_says_what_is_wrong(text: str) -> None:
    refused = None
    try:
        tree = parse(text)
    except UserError as error:
        refused = error.span
        assert refused is not None
    if refused:
        assert 1 <= refused.column <= len(text) + 1
    else:
        assert shown(tree)
        assert re.sub(r"\s", "", text).isascii()


def joined(inner: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    return st.tuples(inner, st.sampled_from("+-*/^"), inner).map(lambda parts: "({}) {} ({})".format(*parts))


@fuzz
@given(st.recursive(st.sampled_from(["p", "-q", "1/2", "norm(v)", "2", "w[1:]"]), joined, max_leaves=8))
def test_a_formula_with_all_its_parentheses_means_the_same(text: str) -> None:
    tree = parse(text)
    assert shown(parse(shown(tree))) == shown(tree)


@pytest.mark.parametrize(
    "text",
    ["a - (b - c)", "a / (b / c)", "-(a + b)^2", "(-a)^2", "(a^b)^c", "2 * -a", "-a * b", "(a * b)^-2", "x[1:]", "x[:n - 1]",
     "(a + b)[0]", "where(a < b + 1, 0.125, 1 / 3)", "[[a, -b], [0, 2.5]]", "[a, x[2:4]]", "1 / (2 * a)", "a * (b / c)"],
)  # fmt: skip
def test_a_tree_is_written_as_it_was_read(text: str) -> None:
    assert written(parse(text)) == text
