"""The grammar of formulas: text -> syntax tree, each node knowing its place.

    formula    := sum [("=" | "==" | "<" | "<=" | ">" | ">=") sum]
    sum        := product (("+" | "-") product)*
    product    := unary (("*" | "/") unary)*
    unary      := "-" unary | power
    power      := item [("^" | "**") unary]            right-associative, binds tighter than unary minus
    item       := primary ("[" index "]")*
    primary    := number | name | name "(" formula ("," formula)* ")" | "(" formula ")" | "[" formula ("," formula)* "]"
    index      := sum | [sum] ":" [sum]

A formula is data: it is parsed by these rules and never handed to Python or sympy as text.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction

from rsrm_gen.compiler.spec.characters import ONE_COMPARISON, advice
from rsrm_gen.errors import Span, UserError

MAX_CHARACTERS = 4000
MAX_DEPTH = 40
MAX_TERMS = 40
MAX_HEIGHT = 120
BLANK = " \t\r\n"
LET = "name its parts with `let`"

TOKEN = re.compile(
    r"[ \t\r\n]*(?:(?P<number>[0-9]+\.?[0-9]*(?:[eE][+-]?[0-9]+)?)|(?P<name>[A-Za-z_][A-Za-z_0-9]*)"
    r"|(?P<op>\*\*|[<>=]=|[-+*/^()\[\],:<>=]))"
)
COMPARISONS = ("=", "==", "<", "<=", ">", ">=")


@dataclass(frozen=True)
class Number:
    """A literal, kept exactly."""

    value: Fraction
    span: Span


@dataclass(frozen=True)
class Name:
    """An argument, a parameter, a `let` or a constant."""

    name: str
    span: Span


@dataclass(frozen=True)
class Call:
    """A function of the vocabulary, applied."""

    function: str
    arguments: tuple[Tree, ...]
    span: Span


@dataclass(frozen=True)
class Negate:
    """-x."""

    operand: Tree
    span: Span


@dataclass(frozen=True)
class Binary:
    """x + y, x - y, x * y, x / y, x ^ y."""

    operator: str
    left: Tree
    right: Tree
    span: Span


@dataclass(frozen=True)
class Compare:
    """x < y and its kin; "=" is exact equality."""

    operator: str
    left: Tree
    right: Tree
    span: Span


@dataclass(frozen=True)
class Stack:
    """[a, b, ...]: scalars and vectors joined to a vector."""

    items: tuple[Tree, ...]
    span: Span


@dataclass(frozen=True)
class Rows:
    """[[a, b], [c, d]]: vectors of one length as the rows of a matrix."""

    items: tuple[Tree, ...]
    span: Span


@dataclass(frozen=True)
class Index:
    """x[i], or x[start:stop] when `slice` is set; the bounds are constant formulas."""

    base: Tree
    start: Tree | None
    stop: Tree | None
    slice: bool
    span: Span


Tree = Number | Name | Call | Negate | Binary | Compare | Stack | Rows | Index


def parse(text: str, span: Span) -> Tree:
    """Parse one formula that stands at `span`; raises `UserError` at the offending character."""
    if len(text) > MAX_CHARACTERS:
        raise UserError(f"a formula of {len(text)} characters; at most {MAX_CHARACTERS} are read", span)
    parser = _Parser(_tokens(text, span), span.inner(len(text)))
    tree = parser.formula()
    parser.end()
    _require_height(tree)
    return tree


def children(tree: Tree) -> tuple[Tree, ...]:
    """The formulas of which a formula is made, from left to right."""
    match tree:
        case Call():
            return tree.arguments
        case Negate():
            return (tree.operand,)
        case Binary() | Compare():
            return tree.left, tree.right
        case Stack() | Rows():
            return tree.items
        case Index():
            return tuple(part for part in (tree.base, tree.start, tree.stop) if part is not None)
    return ()


def names(tree: Tree) -> Iterator[str]:
    """The names in a formula, from left to right."""
    if isinstance(tree, Name):
        yield tree.name
    for child in children(tree):
        yield from names(child)


def _require_height(tree: Tree) -> None:
    """Refuse what is too deep to be walked: long chains inside long chains, though neither is too long by itself."""
    level, height = [tree], 1
    while level:
        if height > MAX_HEIGHT:
            raise UserError("a formula with too many operations inside one another", level[0].span, LET)
        level, height = [child for parent in level for child in children(parent)], height + 1


@dataclass(frozen=True)
class _Token:
    kind: str
    text: str
    span: Span


def _tokens(text: str, span: Span) -> list[_Token]:
    tokens, at = [], 0
    while text[at:].strip(BLANK):
        match = TOKEN.match(text, at)
        if match is None:
            at += len(text[at:]) - len(text[at:].lstrip(BLANK))
            raise UserError(_complaint(text[at]), span.inner(at), advice(text[at]))
        kind = str(match.lastgroup)
        tokens.append(_Token(kind, match[kind], span.inner(match.start(kind), len(match[kind]))))
        at = match.end()
    return tokens


def _complaint(character: str) -> str:
    name = "" if character.isascii() else f" ({unicodedata.name(character, 'without a name').lower()})"
    return f"the character {character!r}{name} has no meaning in a formula"


class _Parser:
    """Recursive descent over the tokens, one method for each rule of the grammar."""

    def __init__(self, tokens: list[_Token], end: Span) -> None:
        self.tokens = tokens
        self.position = 0
        self.depth = 0
        self.last = end

    def formula(self) -> Tree:
        self.deeper(
            self.tokens[min(self.position, len(self.tokens) - 1)] if self.tokens else _Token("end", "", self.last)
        )
        left = self.sum()
        if self.peek() in COMPARISONS:
            token = self.take()
            left = Compare("=" if token.text == "==" else token.text, left, self.sum(), token.span)
        self.depth -= 1
        return left

    def sum(self) -> Tree:
        return self.chain(self.product, ("+", "-"))

    def product(self) -> Tree:
        return self.chain(self.unary, ("*", "/"))

    def chain(self, operand: Callable[[], Tree], operators: tuple[str, ...]) -> Tree:
        left, terms = operand(), 1
        while self.peek() in operators:
            token = self.take()
            left, terms = Binary(token.text, left, operand(), token.span), terms + 1
            if terms > MAX_TERMS:
                raise UserError(f"more than {MAX_TERMS} terms in a row", token.span, LET)
        return left

    def unary(self) -> Tree:
        signs = []
        while self.peek() in ("-", "+"):
            signs.append(self.take())
            if len(signs) > MAX_DEPTH:
                raise UserError("too many signs in a row", signs[-1].span)
        tree = self.power()
        for token in reversed(signs):
            tree = Negate(tree, token.span) if token.text == "-" else tree
        return tree

    def power(self) -> Tree:
        base = self.item()
        if self.peek() not in ("^", "**"):
            return base
        token = self.deeper(self.take())
        exponent = self.unary()
        self.depth -= 1
        return Binary("^", base, exponent, token.span)

    def deeper(self, token: _Token) -> _Token:
        """Count one level of nesting."""
        self.depth += 1
        if self.depth > MAX_DEPTH:
            raise UserError(f"a formula nested deeper than {MAX_DEPTH} levels", token.span, LET)
        return token

    def item(self) -> Tree:
        tree, indices = self.primary(), 0
        while self.peek() == "[":
            tree, indices = self.index(tree), indices + 1
            if indices > 2:
                raise UserError("nothing has more than two indices", self.tokens[self.position - 1].span)
        return tree

    def index(self, base: Tree) -> Tree:
        span = self.deeper(self.take()).span
        start = None if self.peek() == ":" else self.sum()
        stop, is_slice = None, self.peek() == ":"
        if is_slice:
            self.take()
            stop = None if self.peek() == "]" else self.sum()
        self.expect("]")
        self.depth -= 1
        return Index(base, start, stop, is_slice, span)

    def primary(self) -> Tree:
        if self.position == len(self.tokens):
            raise UserError("the formula ends where a value is expected", self.last)
        token = self.take()
        if token.kind == "number":
            return Number(_exact(token), token.span)
        if token.kind == "name":
            if self.peek() != "(":
                return Name(token.text, token.span)
            self.take()
            return Call(token.text, self.items(")"), token.span)
        if token.text == "(":
            tree = self.formula()
            self.expect(")")
            return tree
        if token.text == "[":
            items = self.items("]")
            rows = all(isinstance(item, Stack) for item in items)
            return Rows(items, token.span) if rows else Stack(items, token.span)
        raise UserError(f"`{token.text}` stands where a value is expected", token.span)

    def items(self, closing: str) -> tuple[Tree, ...]:
        items = [self.formula()]
        while self.peek() == ",":
            self.take()
            items.append(self.formula())
        self.expect(closing)
        return tuple(items)

    def end(self) -> None:
        if self.position < len(self.tokens):
            token = self.tokens[self.position]
            raise UserError(f"`{token.text}` is not expected here", token.span, self.advice())

    def advice(self) -> str | None:
        """What to write instead of the token that is not expected."""
        token = self.tokens[self.position] if self.position < len(self.tokens) else None
        if token is None:
            return "close every bracket that is opened"
        if token.text in (*COMPARISONS, "and", "or", "not"):
            return ONE_COMPARISON
        return "write `*` between two factors" if token.kind != "op" or token.text in "([" else None

    def expect(self, text: str) -> None:
        if self.peek() != text:
            found = f"`{self.peek()}`" if self.peek() else "the end of the formula"
            raise UserError(f"expected `{text}`, found {found}", self.span, self.advice())
        self.take()

    def peek(self) -> str:
        return self.tokens[self.position].text if self.position < len(self.tokens) else ""

    def take(self) -> _Token:
        self.position += 1
        return self.tokens[self.position - 1]

    @property
    def span(self) -> Span:
        return self.tokens[self.position].span if self.position < len(self.tokens) else self.last


def _exact(token: _Token) -> Fraction:
    exponent = re.search(r"[eE]([+-]?\d+)$", token.text)
    if exponent and abs(int(exponent[1])) > 300:
        raise UserError("a number out of the range of floating point", token.span)
    value = Fraction(token.text)
    if abs(value) >= 2**1024 or 0 < value < Fraction(1, 2**1074):
        raise UserError("a number out of the range of floating point", token.span)
    return value
