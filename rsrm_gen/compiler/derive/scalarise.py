"""From formulas in vectors to assignments in scalars.

A scalar factor or divisor of a vector is kept beside it until the vector's entries are needed, so that `t * w / norm(w)`
meets its 0/0 as one scalar, t / norm(w), which can be looked at and removed.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from copy import copy
from dataclasses import dataclass, replace
from functools import reduce
from typing import Any, TypeAlias

import mpmath as mp
import sympy as sp

from rsrm_gen.compiler.derive.geometry import (
    EPS,
    EQUAL,
    LESS,
    LESS_EQUAL,
    Argument,
    Assignment,
    Choose,
    Function,
    Guard,
    Wrap,
)
from rsrm_gen.compiler.derive.numeric import TINY, Values, value
from rsrm_gen.compiler.derive.series import even_series
from rsrm_gen.compiler.spec import Map, Spec
from rsrm_gen.compiler.spec import formula as f
from rsrm_gen.compiler.spec.shapes import bounds, constant
from rsrm_gen.compiler.spec.vocabulary import Shape
from rsrm_gen.errors import UserError


@dataclass(frozen=True)
class Vector:
    """entries * product(factors) / product(divisors), not multiplied out."""

    entries: tuple[sp.Expr, ...]
    factors: tuple[sp.Expr, ...] = ()
    divisors: tuple[sp.Expr, ...] = ()


@dataclass(frozen=True)
class Truth:
    """A comparison: a < b, a <= b or a == b by kind."""

    kind: sp.Integer
    a: sp.Expr
    b: sp.Expr


Value: TypeAlias = Any  # a scalar (sympy expression), a `Vector`, a sympy matrix or a `Truth`; sympy has no types

FUNCTIONS = {
    "sqrt": sp.sqrt, "exp": sp.exp, "log": sp.log, "sin": sp.sin, "cos": sp.cos, "tan": sp.tan, "sinh": sp.sinh,
    "cosh": sp.cosh, "tanh": sp.tanh, "asinh": sp.asinh, "acos": sp.acos, "acosh": sp.acosh, "atanh": sp.atanh, "abs": sp.Abs,
}  # fmt: skip


class Trace:
    """The assignments written down while formulas are read.

    `probe` holds the values of the arguments where the author's formulas may be 0/0 (coincident points, a zero
    vector); a quotient of two quantities that vanish there is recorded in `quotients`, to be removed.
    """

    def __init__(self, arguments: Sequence[Argument], probe: Values | None = None) -> None:
        self.arguments = {a.name: a for a in arguments}
        self.assignments: list[Assignment] = []
        self.quotients: list[sp.Symbol] = []
        self.scalars: list[sp.Symbol] = []  # quantities of the author's: candidates for closed forms
        self.probe = dict(probe) if probe else None
        self.known: dict[sp.Expr, sp.Symbol] = {}
        self.taken = {str(s) for a in arguments for s in a.symbols} | {a.name for a in arguments}

    def define(self, hint: str, expression: sp.Expr, guard: Guard | None = None) -> sp.Expr:
        """A symbol for an expression; numbers and symbols stand for themselves, and nothing is defined twice."""
        if expression.is_number or expression.is_Symbol:
            return expression
        if expression not in self.known:
            symbol = sp.Symbol(self.fresh(hint), real=True)
            self.known[expression] = symbol
            self.assignments.append(Assignment(symbol, expression, guard))
            if self.probe is not None:
                self.probe[symbol] = value(guard.near if guard else expression, self.probe)
        return self.known[expression]

    def extended(self, *arguments: Argument) -> Trace:
        """This trace itself, or a copy that knows further arguments."""
        if not arguments:
            return self
        trace = copy(self)
        trace.arguments = self.arguments | {a.name: a for a in arguments}
        trace.assignments, trace.quotients = list(self.assignments), list(self.quotients)
        trace.scalars, trace.known = list(self.scalars), dict(self.known)
        trace.taken = self.taken | {str(s) for a in arguments for s in a.symbols} | {a.name for a in arguments}
        trace.probe = self.probe and {**self.probe, **{s: mp.mpf(1) for a in arguments for s in a.symbols}}
        return trace

    def fresh(self, hint: str) -> str:
        """An unused name that begins with the hint."""
        name, count = hint, 1
        while name in self.taken:
            count += 1
            name = f"{hint}_{count}"
        self.taken.add(name)
        return name

    def vanishes(self, expression: sp.Expr) -> bool:
        """Whether the expression is zero at the probe."""
        return self.probe is not None and not expression.is_number and abs(value(expression, self.probe)) < TINY

    def unfolded(self, expression: sp.Expr) -> sp.Expr:
        """An expression in the arguments alone."""
        for assignment in reversed(self.assignments):
            expression = expression.xreplace({assignment.symbol: assignment.expression})
        return expression

    def definition(self, symbol: sp.Expr) -> sp.Expr | None:
        """The expression that a symbol was defined as."""
        return next((a.expression for a in self.assignments if a.symbol == symbol), None)


class Reading:
    """Reads the maps of a spec into a trace; names are looked up in `let`s only when they are used."""

    def __init__(self, spec: Spec, trace: Trace) -> None:
        self.parameters = dict(spec.parameters)
        self.trace = trace
        self.lets: dict[str, tuple[f.Tree, Value | None]] = {}

    def read(self, chart_map: Map) -> Value:
        """The value of a map whose arguments are those of the trace."""
        for name, formula in chart_map.lets:
            self.lets.setdefault(name, (formula.tree, None))
        return self.value(chart_map.value.tree)

    def entries(self, chart_map: Map) -> tuple[sp.Expr, ...]:
        """The entries of a map's value in row-major order; a scalar has one."""
        result = self.read(chart_map)
        if isinstance(result, Vector):
            return self.materialise(result)
        return tuple(result) if isinstance(result, sp.MatrixBase) else (result,)

    def value(self, tree: f.Tree) -> Value:
        """The value of a formula; a `UserError` where it is no finite real number whatever the arguments are."""
        result = self.plain_value(tree)
        parts = result.entries if isinstance(result, Vector) else (result,)
        if any(isinstance(e, sp.Expr) and not _may_be_real(e) for e in parts):
            raise UserError("this is no finite real number", tree.span)
        return result

    def plain_value(self, tree: f.Tree) -> Value:
        match tree:
            case f.Number():
                return sp.Rational(tree.value.numerator, tree.value.denominator)
            case f.Name():
                return self.name(tree.name)
            case f.Negate():
                return self.times(self.value(tree.operand), sp.Integer(-1))
            case f.Binary():
                return self.binary(tree)
            case f.Compare():
                return self.compare(tree)
            case f.Stack():
                return self.stack(tree)
            case f.Rows():
                return sp.Matrix([list(self.materialise(self.value(item))) for item in tree.items])
            case f.Index():
                return self.index(tree)
            case f.Call():
                return self.call(tree)

    def name(self, name: str) -> Value:
        if name in self.trace.arguments:
            return Vector(self.trace.arguments[name].symbols)
        if name in self.lets:
            return self.let(name)
        if name in self.parameters:
            number = self.parameters[name]
            return sp.Rational(number.numerator, number.denominator)
        return {"pi": sp.pi, "eps": EPS}[name]

    def let(self, name: str) -> Value:
        tree, result = self.lets[name]
        if result is None:
            result = self.call(tree, name) if isinstance(tree, f.Call) else self.value(tree)
            if isinstance(result, Vector):
                entries = (self.trace.define(f"{name}{i}", e) for i, e in enumerate(result.entries))
                result = replace(result, entries=tuple(entries))
            elif isinstance(result, sp.Expr):
                result = self.quantity(name, result)
            self.lets[name] = tree, result
        return result

    def quantity(self, hint: str, expression: sp.Expr) -> sp.Expr:
        """A scalar of the author's, under a name."""
        symbol = self.trace.define(hint, expression)
        if symbol.is_Symbol and symbol not in self.trace.scalars:
            self.trace.scalars.append(symbol)
        return symbol

    def binary(self, tree: f.Binary) -> Value:
        if tree.operator == "^":
            exponent = constant(tree.right, self.parameters)
            return self.value(tree.left) ** sp.Rational(exponent.numerator, exponent.denominator)
        left, right = self.value(tree.left), self.value(tree.right)
        if tree.operator == "*":
            return self.times(left, right)
        if tree.operator == "/":
            return self.over(left, right)
        return self.plus(left, right if tree.operator == "+" else self.times(right, sp.Integer(-1)))

    def plus(self, x: Value, y: Value) -> Value:
        if isinstance(x, Vector) and isinstance(y, Vector):
            pairs = zip(self.materialise(x), self.materialise(y), strict=True)
            return Vector(tuple(a + b for a, b in pairs))
        return x + y

    def times(self, x: Value, y: Value) -> Value:
        if isinstance(y, Vector) and isinstance(x, sp.Expr):
            x, y = y, x
        if isinstance(x, Vector) and isinstance(y, sp.Expr):
            return (
                replace(x, entries=tuple(y * e for e in x.entries))
                if y.is_number
                else replace(x, factors=(*x.factors, y))
            )
        if isinstance(x, sp.MatrixBase) and isinstance(y, Vector):
            return Vector(tuple(x * sp.Matrix(self.materialise(y))))
        return x * y

    def over(self, x: Value, y: Value) -> Value:
        assert isinstance(y, sp.Expr)
        if isinstance(x, Vector):
            return (
                replace(x, entries=tuple(e / y for e in x.entries))
                if y.is_number
                else replace(x, divisors=(*x.divisors, y))
            )
        return self.ratio(x, y) if isinstance(x, sp.Expr) else x / y

    def materialise(self, vector: Vector) -> tuple[sp.Expr, ...]:
        """The entries, multiplied out; what is 0/0 among the scalars becomes one quotient."""
        scale = self.ratio(sp.Mul(*vector.factors), sp.Mul(*vector.divisors))
        if not scale.is_number and not scale.is_Symbol and len(vector.entries) > 1:
            scale = self.trace.define("scale", scale)
        return tuple(scale * e for e in vector.entries)

    def ratio(self, x: sp.Expr, y: sp.Expr) -> sp.Expr:
        """x / y, with the factors that make it 0/0 at the probe kept together in one quotient."""
        small = [d for d in sp.Mul.make_args(y) if self.trace.vanishes(d)]
        if not small:
            return x / y
        vanishing = [n for n in sp.Mul.make_args(x) if self.trace.vanishes(n)]
        rest = (x / sp.Mul(*vanishing)) / (y / sp.Mul(*small))
        return rest * self.quotient(tuple(vanishing), tuple(small))

    def quotient(self, numerators: tuple[sp.Expr, ...], denominators: tuple[sp.Expr, ...]) -> sp.Expr:
        """A named quotient that is 0/0 at the probe."""
        names = ["_".join(_slug(e) for e in es) for es in (numerators, denominators)]
        hint = "_over_".join(names) if all(names) else "quotient"
        symbol = self.quantity(hint, sp.Mul(*numerators) / sp.Mul(*denominators))
        if symbol.is_Symbol and symbol not in self.trace.quotients:
            self.trace.quotients.append(symbol)
        return symbol

    def compare(self, tree: f.Compare) -> Truth:
        a, b = self.value(tree.left), self.value(tree.right)
        if tree.operator in (">", ">="):
            a, b = b, a
        kind = {"<": LESS, ">": LESS, "<=": LESS_EQUAL, ">=": LESS_EQUAL, "=": EQUAL}[tree.operator]
        return Truth(kind, a, b)

    def stack(self, tree: f.Stack) -> Value:
        parts = [self.value(item) for item in tree.items]
        entries = [self.materialise(part) if isinstance(part, Vector) else (part,) for part in parts]
        return Vector(tuple(e for part in entries for e in part))

    def index(self, tree: f.Index) -> Value:
        base = self.value(tree.base)
        length = base.rows if isinstance(base, sp.MatrixBase) else len(base.entries)
        start, stop = bounds(tree, length, self.parameters)
        if isinstance(base, sp.MatrixBase):
            return base[start:stop, :] if tree.slice else Vector(tuple(base[start, :]))
        assert isinstance(base, Vector)
        return replace(base, entries=base.entries[start:stop]) if tree.slice else self.materialise(base)[start]

    def call(self, tree: f.Call, name: str = "") -> Value:
        """The value of a call; a scalar becomes a named quantity."""
        arguments = [self.value(argument) for argument in tree.arguments]
        name = name or _hint(tree)
        method = getattr(self, f"call_{tree.function}", None)
        if tree.function in ("dot", "norm"):
            result: Value = self.product(tree, arguments, name)
        elif method is not None:
            result = method(*arguments)
        elif isinstance(arguments[0], Vector):
            entries = (FUNCTIONS[tree.function](e) for e in self.materialise(arguments[0]))
            result = Vector(tuple(entries))
        elif tree.function == "atan2":
            result = sp.atan2(*arguments)
        else:
            result = FUNCTIONS[tree.function](arguments[0])
        if isinstance(result, sp.Expr) and tree.function not in ("where", "sum", "max", "min", "sign", "wrap"):
            return self.quantity(name, result)
        return result

    def product(self, tree: f.Call, vectors: list[Vector], name: str) -> sp.Expr:
        """dot(a, b) or norm(a); the entries of what is not a name are named first."""
        entries = [self.named_entries(t, self.materialise(v)) for t, v in zip(tree.arguments, vectors, strict=True)]
        total = sp.Add(*(a * b for a, b in zip(entries[0], entries[-1], strict=True)))
        return sp.sqrt(self.trace.define(f"{name}_squared", total)) if tree.function == "norm" else total

    def named_entries(self, tree: f.Tree, entries: tuple[sp.Expr, ...]) -> tuple[sp.Expr, ...]:
        slug = _tree_slug(tree)
        hint = slug if len(slug) <= 20 and slug.isidentifier() else "part"
        return tuple(self.trace.define(f"{hint}{i}", e) for i, e in enumerate(entries))

    def call_sum(self, x: Vector) -> sp.Expr:
        return sp.Add(*self.materialise(x))

    def call_max(self, x: Vector) -> sp.Expr:
        return reduce(lambda a, b: choose(Truth(LESS, a, b), b, a), self.materialise(x))

    def call_min(self, x: Vector) -> sp.Expr:
        return reduce(lambda a, b: choose(Truth(LESS, a, b), a, b), self.materialise(x))

    def call_cross(self, x: Vector, y: Vector) -> Vector:
        (a, b, c), (d, e, g) = self.materialise(x), self.materialise(y)
        return Vector((b * g - c * e, c * d - a * g, a * e - b * d))

    def call_outer(self, x: Vector, y: Vector) -> sp.MatrixBase:
        return sp.Matrix([[a * b for b in self.materialise(y)] for a in self.materialise(x)])

    def call_qmul(self, x: Vector, y: Vector) -> Vector:
        (a, b, c, d), (w, i, j, k) = self.materialise(x), self.materialise(y)
        return Vector((
            a * w - b * i - c * j - d * k,
            a * i + b * w + c * k - d * j,
            a * j - b * k + c * w + d * i,
            a * k + b * j - c * i + d * w,
        ))  # fmt: skip

    def call_conj(self, x: Vector) -> Vector:
        return Vector((x.entries[0], *(-e for e in x.entries[1:])), x.factors, x.divisors)

    def call_transpose(self, x: sp.MatrixBase) -> sp.MatrixBase:
        return x.T

    def call_det(self, x: sp.MatrixBase) -> sp.Expr:
        return x.det(method="berkowitz")

    def call_inv(self, x: sp.MatrixBase) -> sp.MatrixBase:
        return x.inv(method="ADJ")

    def call_orthogonal(self, x: Vector) -> Vector:
        # Of the first two axes, one is at 45 degrees or more to a unit vector: its part at right angles to the vector
        # is no shorter than 1/sqrt 2.
        a = self.materialise(x)

        def part(axis: int) -> list[sp.Expr]:
            length = self.trace.define(f"sine_to_axis{axis}", sp.sqrt(1 - a[axis] ** 2))
            return [((1 if i == axis else 0) - a[axis] * e) / length for i, e in enumerate(a)]

        pairs = zip(part(0), part(1), strict=True)
        nearer = Truth(LESS, a[0] ** 2, sp.Rational(1, 2))
        return Vector(tuple(choose(nearer, x0, x1) for x0, x1 in pairs))

    def call_where(self, condition: Truth, x: Value, y: Value) -> Value:
        if isinstance(x, Vector) and isinstance(y, Vector):
            pairs = zip(self.materialise(x), self.materialise(y), strict=True)
            return Vector(tuple(choose(condition, a, b) for a, b in pairs))
        if isinstance(x, sp.MatrixBase):
            return sp.Matrix(*x.shape, [choose(condition, a, b) for a, b in zip(x, y, strict=True)])
        return choose(condition, x, y)

    def call_wrap(self, x: Value, period: sp.Expr = 2 * sp.pi) -> Value:
        if isinstance(x, Vector):
            return Vector(tuple(Wrap(e, period) for e in self.materialise(x)))
        return Wrap(x, period)

    def call_sign(self, x: Value) -> Value:
        if isinstance(x, Vector):
            return Vector(tuple(self.call_sign(e) for e in self.materialise(x)))
        return choose(Truth(LESS, x, sp.Integer(0)), sp.Integer(-1), sp.Integer(1))

    def call_cos(self, x: Value) -> Value:
        return self.even("cos", sp.cos, x)

    def call_cosh(self, x: Value) -> Value:
        return self.even("cosh", sp.cosh, x)

    def even(self, name: str, function: Any, x: Value) -> Value:
        """cos(r) or cosh(r) is smooth in r^2: of a norm that may vanish, whose own derivatives would be lost there."""
        if isinstance(x, Vector):
            return Vector(tuple(self.even(name, function, e) for e in self.materialise(x)))
        return self.guarded(name, function(x), x) if self.trace.vanishes(x) and self.is_root(x) else function(x)

    def call_sinc(self, x: Value) -> Value:
        return self.cardinal("sinc", sp.sin, x)

    def call_sinhc(self, x: Value) -> Value:
        return self.cardinal("sinhc", sp.sinh, x)

    def cardinal(self, name: str, function: Any, x: Value) -> Value:
        """sin(x)/x or sinh(x)/x with its removable singularity removed, in the smooth variable x^2."""
        if isinstance(x, Vector):
            return Vector(tuple(self.cardinal(name, function, e) for e in self.materialise(x)))
        if x.is_number:
            return function(x) / x if x != 0 else sp.Integer(1)
        return self.guarded(name, function(x) / x, x)

    def guarded(self, name: str, expression: sp.Expr, x: sp.Expr) -> sp.Expr:
        """An even function of x, near 0 by its polynomial in x^2."""
        series, square = even_series(name), self.square(x)
        guard = Guard(square, series.threshold, series(square), series.error)
        return self.trace.define(f"{name}_{_slug(x)}", expression, guard)

    def is_root(self, x: sp.Expr) -> bool:
        """Whether x is a norm or a multiple of one: not smooth where it vanishes, though its square is."""
        return bool(self.square(x) != sp.expand(x**2))

    def square(self, x: sp.Expr) -> sp.Expr:
        """x^2 without the root, where x is a norm or a multiple of one."""
        if x.is_Mul:
            return sp.Mul(*(self.square(factor) for factor in x.args))
        definition = self.trace.definition(x) if x.is_Symbol else None
        root = (
            definition if definition is not None and definition.is_Pow and definition.exp == sp.Rational(1, 2) else None
        )
        return root.base if root is not None else x**2


def choose(condition: Truth, x: sp.Expr, y: sp.Expr) -> sp.Expr:
    """x where the condition holds, else y; decided here when it compares numbers."""
    a, b = condition.a, condition.b
    if not (a - b).is_number or (a - b).has(EPS):
        return Choose(condition.kind, a, b, x, y)
    difference = value(a - b, {})
    holds = {LESS: difference < 0, LESS_EQUAL: difference <= 0, EQUAL: difference == 0}[condition.kind]
    return x if holds else y


def scalarised(spec: Spec, name: str, chart_map: Map, arguments: Sequence[Argument], shape: Shape) -> Function:
    """A map of the spec as a staged function, without looking for singularities."""
    trace = Trace(arguments)
    results = Reading(spec, trace).entries(chart_map)
    return Function(name, tuple(arguments), tuple(trace.assignments), results, shape, chart_map.value.text).pruned()


def number(spec: Spec, chart_map: Map | None) -> sp.Expr:
    """The value of a map of nothing; infinity where there is none."""
    return sp.oo if chart_map is None else Reading(spec, Trace(())).entries(chart_map)[0]


def _may_be_real(expression: sp.Expr) -> bool:
    """Whether an expression can be a finite real number."""
    if expression.has(sp.zoo, sp.nan, sp.oo, sp.I):
        return False
    return not expression.is_number or expression.has(EPS) or expression.is_extended_real is not False


def _hint(tree: f.Call) -> str:
    """A name for a call that a reader recognises: norm_w, dot_p_d, sinh_r."""
    words = _tree_slug(tree)
    return words if len(words) <= 20 and words.isidentifier() else f"{tree.function}_value"


def _tree_slug(tree: f.Tree) -> str:
    match tree:
        case f.Name():
            return tree.name
        case f.Number():
            return str(tree.value).replace("/", "_over_")
        case f.Negate():
            return "minus_" + _tree_slug(tree.operand)
        case f.Binary():
            word = {"+": "plus", "-": "minus", "*": "times", "/": "over", "^": "to"}[tree.operator]
            return f"{_tree_slug(tree.left)}_{word}_{_tree_slug(tree.right)}"
        case f.Index():
            return _tree_slug(tree.base) + ("s" if tree.slice else f"{_tree_slug(tree.start)}" if tree.start else "")
        case f.Call():
            return "_".join([tree.function, *(_tree_slug(argument) for argument in tree.arguments)])
    return "of"


def _slug(expression: sp.Expr) -> str:
    text = str(expression) if expression.is_Symbol or expression.is_number else ""
    return text if re.fullmatch(r"\w{1,12}", text) else ""
