"""From formulas in vectors and matrices to assignments in scalars.

A scalar factor or divisor of a vector is kept beside it until the vector's entries are needed, so that `t * w / norm(w)`
meets its 0/0 as one scalar, t / norm(w), which can be looked at and removed.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Set
from dataclasses import replace
from functools import reduce
from typing import Any, TypeAlias

import mpmath as mp
import sympy as sp

from rsrm_gen.compiler.budget import blamed, spend
from rsrm_gen.compiler.derive.bounds import determinant, exponential, inverse, require_real
from rsrm_gen.compiler.derive.geometry import (
    EPS,
    EQUAL,
    LESS,
    LESS_EQUAL,
    Argument,
    Choose,
    Function,
    Guard,
    Wrap,
    argument,
)
from rsrm_gen.compiler.derive.matrix_functions import Eigenvalue
from rsrm_gen.compiler.derive.matrix_words import SYMMETRIC, MatrixWords
from rsrm_gen.compiler.derive.naming import call_name, symbol_name, tree_name
from rsrm_gen.compiler.derive.numeric import value
from rsrm_gen.compiler.derive.series import even_series
from rsrm_gen.compiler.derive.trace import Trace
from rsrm_gen.compiler.derive.values import Truth, Vector, choose
from rsrm_gen.compiler.spec import ManifoldSpec, Map, Spec
from rsrm_gen.compiler.spec import formula as f
from rsrm_gen.compiler.spec.shapes import bounds, constant, unit_size
from rsrm_gen.compiler.spec.vocabulary import Shape
from rsrm_gen.errors import Span, UserError

Value: TypeAlias = Any  # a scalar (sympy expression), a `Vector` or a `Truth`; sympy has no types

FUNCTIONS = {
    "sqrt": sp.sqrt, "exp": exponential, "log": sp.log, "sin": sp.sin, "cos": sp.cos, "tan": sp.tan, "sinh": sp.sinh,
    "cosh": sp.cosh, "tanh": sp.tanh, "asinh": sp.asinh, "acos": sp.acos, "acosh": sp.acosh, "atanh": sp.atanh, "abs": sp.Abs,
}  # fmt: skip


MAX_OPEN_LETS = 8
MAX_PERIOD = mp.mpf(10) ** 30


class Reading(MatrixWords):
    """Reads the maps of a spec into a trace; names are looked up in `let`s only when they are used."""

    def __init__(self, spec: Spec, trace: Trace) -> None:
        self.parameters = dict(spec.parameters)
        self.shapes = spec.argument_shapes
        self.trace = trace
        self.lets: dict[str, tuple[f.Tree, Value | None]] = {}
        self.open_lets = 0

    def read(self, chart_map: Map) -> Value:
        """The value of a map whose arguments are those of the trace."""
        for name, formula in chart_map.lets:
            self.lets.setdefault(name, (formula.tree, None))
        with blamed(chart_map.value.span):
            result = self.value(chart_map.value.tree)
        if isinstance(result, Truth):
            return result
        rough: set[sp.Symbol] = set()
        for a in self.trace.assignments:
            rough |= {a.symbol} if _is_rough(a.expression, rough) else set()
        if any(_is_rough(e, rough) for e in _parts(result) if isinstance(e, sp.Expr)):
            raise UserError(
                "eigenvalues are only compared: where two of them meet they have no derivative",
                chart_map.value.span,
                "a smooth function of all of them is trace(logm(A)), det(A), norm(A) and the like",
            )
        return result

    def entries(self, chart_map: Map) -> tuple[sp.Expr, ...]:
        """The entries of a map's value in row-major order; a scalar has one."""
        result = self.read(chart_map)
        return self.materialise(result) if isinstance(result, Vector) else (result,)

    def value(self, tree: f.Tree) -> Value:
        """The value of a formula; a `UserError` where it is no finite real number whatever the arguments are."""
        result = self.plain_value(tree)
        parts = _parts(result)
        self.trace.sizes.check(parts, tree.span)
        require_real(parts, tree.span)
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
                rows = [self.materialise(self.value(item)) for item in tree.items]
                return Vector(tuple(e for row in rows for e in row), columns=len(rows[0]))
            case f.Index():
                return self.index(tree)
            case f.Call():
                return self.call(tree)

    def name(self, name: str) -> Value:
        if name in self.trace.arguments:
            shape = self.shapes.get(name, ())
            return Vector(self.trace.arguments[name].symbols, columns=shape[1] if len(shape) == 2 else None)
        if name in self.lets:
            return self.let(name)
        if name in self.parameters:
            number = self.parameters[name]
            return sp.Rational(number.numerator, number.denominator)
        return {"pi": sp.pi, "eps": EPS}[name]

    def let(self, name: str) -> Value:
        if self.lets[name][1] is None:
            self.open_lets += 1
            for needed in self.foundations(name) if self.open_lets > MAX_OPEN_LETS else (name,):
                self.define_let(needed)
            self.open_lets -= 1
        return self.lets[name][1]

    def foundations(self, name: str) -> Iterator[str]:
        """A `let` after those on which it stands: hundreds, perhaps, too many to be open at once."""
        waiting = [name]
        while waiting:
            names = (n for n in f.names(self.lets[waiting[-1]][0]) if n in self.lets)
            missing = next((n for n in names if self.lets[n][1] is None), None)
            if missing is None:
                yield waiting.pop()
            else:
                waiting.append(missing)

    def define_let(self, name: str) -> None:
        """The value of a `let` whose parts are known, its entries under names."""
        tree, result = self.lets[name]
        if result is None:
            result = self.call(tree, name) if isinstance(tree, f.Call) else self.value(tree)
            if isinstance(result, Vector):
                entries = (self.trace.define(f"{name}{result.suffix(i)}", e) for i, e in enumerate(result.entries))
                result = replace(result, entries=tuple(entries))
            elif isinstance(result, sp.Expr):
                result = self.quantity(name, result)
            self.lets[name] = tree, result

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
            return Vector(tuple(a + b for a, b in pairs), columns=x.columns)
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
        if isinstance(x, Vector):
            return self.matrix_product(x, y)
        return x * y

    def matrix_product(self, x: Vector, y: Vector) -> Vector:
        """A matrix times a matrix or a vector; factors and divisors stay beside the entries."""
        assert x.columns is not None
        spend(x.rows * x.columns * (y.columns or 1))
        rows = [x.entries[i * x.columns : (i + 1) * x.columns] for i in range(x.rows)]
        columns = [y.entries[j :: y.columns or 1] for j in range(y.columns or 1)]
        entries = tuple(sp.Add(*(a * b for a, b in zip(r, c, strict=True))) for r in rows for c in columns)
        return Vector(entries, x.factors + y.factors, x.divisors + y.divisors, y.columns)

    def over(self, x: Value, y: Value) -> Value:
        assert isinstance(y, sp.Expr)
        if isinstance(x, Vector):
            return (
                replace(x, entries=tuple(e / y for e in x.entries))
                if y.is_number
                else replace(x, divisors=(*x.divisors, y))
            )
        return self.ratio(x, y)

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
        names = ["_".join(symbol_name(e) for e in es) for es in (numerators, denominators)]
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
        assert isinstance(base, Vector)
        start, stop = bounds(tree, base.rows, self.parameters)
        if base.columns is None and not tree.slice:
            return self.materialise(base)[start]
        width = base.columns or 1
        part = replace(base, entries=base.entries[start * width : stop * width])
        return part if tree.slice else replace(part, columns=None)

    def call(self, tree: f.Call, name: str = "") -> Value:
        """The value of a call; a scalar becomes a named quantity."""
        if tree.function == "eye":
            return self.unit_matrix(unit_size(tree, self.parameters))
        arguments = [self.value(argument) for argument in tree.arguments]
        name = name or call_name(tree)
        method = getattr(self, f"call_{tree.function}", None)
        if tree.function in ("dot", "norm"):
            result: Value = self.product(tree, arguments, name)
        elif tree.function == "det":
            result = determinant(self.named_matrix(arguments[0]), tree.span)
        elif tree.function == "inv":
            entries = inverse(self.named_matrix(arguments[0]), tree.span)
            result = Vector(tuple(entries), columns=arguments[0].columns)
        elif tree.function in SYMMETRIC:
            result = self.of_symmetric(tree, arguments[0], name)
        elif method is not None:
            if tree.function == "wrap" and len(arguments) == 2:
                self.check_period(arguments[1], tree.arguments[1].span)
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
        slug = tree_name(tree)
        hint = slug if len(slug) <= 20 and slug.isidentifier() else "part"
        return tuple(self.trace.define(f"{hint}{i}", e) for i, e in enumerate(entries))

    def call_sum(self, x: Vector) -> sp.Expr:
        return sp.Add(*self.materialise(x))

    def call_max(self, x: Vector) -> sp.Expr:
        def larger(a: sp.Expr, b: sp.Expr) -> sp.Expr:
            return choose(Truth(LESS, a, b), b, a)

        return reduce(lambda a, b: larger(self.so_far("largest", a), b), self.materialise(x))

    def call_min(self, x: Vector) -> sp.Expr:
        def smaller(a: sp.Expr, b: sp.Expr) -> sp.Expr:
            return choose(Truth(LESS, a, b), a, b)

        return reduce(lambda a, b: smaller(self.so_far("smallest", a), b), self.materialise(x))

    def so_far(self, name: str, chosen: sp.Expr) -> sp.Expr:
        """A choice that will be read twice, under a name: written out, it would double with every entry."""
        return self.trace.define(name, chosen) if isinstance(chosen, Choose) else chosen

    def call_cross(self, x: Vector, y: Vector) -> Vector:
        (a, b, c), (d, e, g) = self.materialise(x), self.materialise(y)
        return Vector((b * g - c * e, c * d - a * g, a * e - b * d))

    def call_outer(self, x: Vector, y: Vector) -> Vector:
        rows, columns = self.materialise(x), self.materialise(y)
        return Vector(tuple(a * b for a in rows for b in columns), columns=len(columns))

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
            return Vector(tuple(choose(condition, a, b) for a, b in pairs), columns=x.columns)
        return choose(condition, x, y)

    def call_wrap(self, x: Value, period: sp.Expr = 2 * sp.pi) -> Value:
        if isinstance(x, Vector):
            return Vector(tuple(Wrap(e, period) for e in self.materialise(x)))
        return Wrap(x, period)

    def check_period(self, period: sp.Expr, span: Span) -> None:
        """Refuse a period that is no positive number: turns are counted in it."""
        if not period.is_number or not 1 / MAX_PERIOD < value(period, {}) < MAX_PERIOD:
            hint = "make it of numbers, parameters and pi, like wrap(x, 2 * pi)"
            raise UserError("the period of `wrap` must be a positive number", span, hint)

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
        return self.trace.define(f"{name}_{symbol_name(x)}", expression, guard)

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


def scalarised(spec: Spec, name: str, chart_map: Map, arguments: Sequence[Argument], shape: Shape) -> Function:
    """A map of the spec as a staged function, without looking for singularities."""
    trace = Trace(arguments)
    results = Reading(spec, trace).entries(chart_map)
    return Function(name, tuple(arguments), tuple(trace.assignments), results, shape, chart_map.value.text).pruned()


def constraint_of(spec: ManifoldSpec) -> Function:
    """The constraints c(p) of an embedded manifold as a staged function."""
    assert spec.constraint is not None
    return scalarised(spec, "constraint", spec.constraint, (argument("p", spec.point_size),), ())


def number(spec: Spec, chart_map: Map | None) -> sp.Expr:
    """The value of a map of nothing; infinity where there is none."""
    return sp.oo if chart_map is None else Reading(spec, Trace(())).entries(chart_map)[0]


def _parts(result: Value) -> tuple[sp.Expr, ...]:
    """The expressions of which a value is made."""
    if isinstance(result, Vector):
        return result.entries + result.factors + result.divisors
    if isinstance(result, Truth):
        return result.a, result.b
    return (result,)


def _is_rough(expression: sp.Expr, rough: Set[sp.Symbol]) -> bool:
    """Whether an eigenvalue, or a symbol that is `rough`, stands outside of a comparison."""
    parts = expression.args[3:] if isinstance(expression, Choose) else expression.args
    return expression in rough or isinstance(expression, Eigenvalue) or any(_is_rough(e, rough) for e in parts)
