"""Shape checking: every formula gets its shape, or an error at the word that does not fit."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from rsrm_gen.compiler.spec import formula as f
from rsrm_gen.compiler.spec.vocabulary import MAX_MATRIX, TRUTH, WORDS, Shape
from rsrm_gen.errors import Span, UserError, did_you_mean

MAX_EXPONENT = 64
MAX_SIZE = 64
MAX_BITS = 1000  # of a constant's numerator and denominator

Scope = Mapping[str, Shape]
Parameters = Mapping[str, Fraction]


def shape_of(tree: f.Tree, scope: Scope, parameters: Parameters) -> Shape:
    """The shape of a formula whose names have the shapes in `scope`; parameters are scalars."""
    match tree:
        case f.Number():
            return ()
        case f.Name():
            return _name(tree, scope, parameters)
        case f.Negate():
            return shape_of(tree.operand, scope, parameters)
        case f.Binary():
            return _binary(tree, scope, parameters)
        case f.Compare():
            return _compare(tree, scope, parameters)
        case f.Stack():
            return _stack(tree, [shape_of(item, scope, parameters) for item in tree.items])
        case f.Rows():
            return _rows(tree, [shape_of(item, scope, parameters) for item in tree.items])
        case f.Index():
            return _index(tree, shape_of(tree.base, scope, parameters), parameters)
        case f.Call():
            return _call(tree, scope, parameters)


def constant(tree: f.Tree, parameters: Parameters) -> Fraction:
    """The value of a formula of numbers and parameters, exactly."""
    match tree:
        case f.Number():
            return tree.value
        case f.Name() if tree.name in parameters:
            return parameters[tree.name]
        case f.Negate():
            return -constant(tree.operand, parameters)
        case f.Binary():
            return _fold(tree, constant(tree.left, parameters), constant(tree.right, parameters))
    hint = did_you_mean(tree.name, parameters) if isinstance(tree, f.Name) else None
    raise UserError("a number is expected here, made of numbers and parameters", tree.span, hint)


def integer(tree: f.Tree, parameters: Parameters) -> int:
    """The value of a constant formula that must be a whole number."""
    value = constant(tree, parameters)
    if value.denominator != 1:
        raise UserError(f"a whole number is expected here, this is {value}", tree.span)
    return int(value)


def bounds(tree: f.Index, length: int, parameters: Parameters) -> tuple[int, int]:
    """The entries [start, stop) that an index selects, checked."""
    if not tree.slice:
        assert tree.start is not None
        start = integer(tree.start, parameters)
        stop = start + 1
    else:
        start = integer(tree.start, parameters) if tree.start else 0
        stop = integer(tree.stop, parameters) if tree.stop else length
    if not 0 <= start < stop <= length:
        hint = "count from the start, like p[0]" if start < 0 else None
        hint = "a[i:j] are the entries i to j - 1" if tree.slice else hint
        raise UserError(f"there is no such entry: the vector has entries 0 to {length - 1}", tree.span, hint)
    return start, stop


def describe(shape: Shape) -> str:
    """A shape in words."""
    if shape == TRUTH:
        return "a comparison"
    return {0: "a scalar", 1: "a vector of {}", 2: "a {} x {} matrix"}[len(shape)].format(*shape)


def _fold(tree: f.Binary, x: Fraction, y: Fraction) -> Fraction:
    if tree.operator == "/" and y == 0:
        raise UserError("division by zero", tree.span)
    if tree.operator == "^":
        if y.denominator != 1 or abs(y) > MAX_EXPONENT or (x == 0 and y < 0):
            raise UserError(f"not a constant power: {x} ^ {y}", tree.span)
        if abs(y) * max(x.numerator.bit_length(), x.denominator.bit_length()) > MAX_BITS:
            raise UserError("a number out of the range of floating point", tree.span)
        return Fraction(x ** int(y))
    return {"+": lambda: x + y, "-": lambda: x - y, "*": lambda: x * y, "/": lambda: x / y}[tree.operator]()


def _name(tree: f.Name, scope: Scope, parameters: Parameters) -> Shape:
    if tree.name in scope:
        return scope[tree.name]
    if tree.name in parameters or tree.name in ("pi", "eps"):
        return ()
    if tree.name in WORDS:
        raise UserError(f"`{tree.name}` is a function", tree.span, f"write {WORDS[tree.name].signature}")
    if tree.name == "infinity":
        raise UserError("`infinity` stands alone: it is not a number to calculate with", tree.span)
    known = [*scope, *parameters, "pi", "eps"] if scope else [*parameters, "pi", "infinity"]
    raise UserError(f"unknown symbol `{tree.name}`", tree.span, did_you_mean(tree.name, known))


def _binary(tree: f.Binary, scope: Scope, parameters: Parameters) -> Shape:
    left, right = (shape_of(side, scope, parameters) for side in (tree.left, tree.right))
    shape = _binary_shape(tree.operator, left, right)
    if shape is None:
        hint = None
        if tree.operator == "*" and len(left) == len(right) == 1:
            hint = "a product of vectors is dot(a, b), cross(a, b) or outer(a, b)"
        elif tree.operator == "/" and len(right) == 1:
            hint = "divide by its length norm(a) or by an entry a[0]"
        elif tree.operator == "^" and len(left) == 1:
            hint = "the square of its length is dot(a, a)"
        raise UserError(f"`{tree.operator}` of {describe(left)} and {describe(right)}", tree.span, hint)
    if tree.operator == "^":
        _check_exponent(tree, parameters)
    return shape


def _binary_shape(operator: str, left: Shape, right: Shape) -> Shape | None:
    if TRUTH in (left, right):
        return None
    if operator in "+-":
        return left if left == right else None
    if operator == "/":
        return left if right == () else None
    if operator == "^":
        return () if left == right == () else None
    if left == () or right == ():
        return left or right
    if len(left) == 2 and left[1] == right[0]:  # matrix times vector or matrix
        return left[:1] + right[1:]
    return None


def _check_exponent(tree: f.Binary, parameters: Parameters) -> None:
    exponent = constant(tree.right, parameters)
    if abs(exponent) > MAX_EXPONENT or exponent.denominator > 4:
        raise UserError(
            f"the exponent {exponent} is out of range (at most {MAX_EXPONENT}, in quarters)", tree.right.span
        )


def _compare(tree: f.Compare, scope: Scope, parameters: Parameters) -> Shape:
    for side in (tree.left, tree.right):
        shape = shape_of(side, scope, parameters)
        if shape != ():
            raise UserError(f"only scalars are compared, this is {describe(shape)}", side.span)
    return TRUTH


def _stack(tree: f.Stack, shapes: list[Shape]) -> Shape:
    if any(s == TRUTH or len(s) > 1 for s in shapes):
        raise UserError("[ ] joins scalars and vectors", tree.span)
    return (_limited(sum(s[0] if s else 1 for s in shapes), tree.span),)


def _rows(tree: f.Rows, shapes: list[Shape]) -> Shape:
    if len(set(shapes)) > 1:
        raise UserError("the rows of a matrix must have one length", tree.span)
    return (len(shapes), *shapes[0])


def _limited(size: int, span: Span) -> int:
    if size > MAX_SIZE:
        raise UserError(f"a vector of {size} entries; at most {MAX_SIZE}", span)
    return size


def _index(tree: f.Index, base: Shape, parameters: Parameters) -> Shape:
    if len(base) not in (1, 2) or base == TRUTH:
        raise UserError(f"only vectors and matrices have entries, this is {describe(base)}", tree.span)
    start, stop = bounds(tree, base[0], parameters)
    return (stop - start, *base[1:]) if tree.slice else base[1:]


def _call(tree: f.Call, scope: Scope, parameters: Parameters) -> Shape:
    word = WORDS.get(tree.function)
    if word is None:
        raise UserError(f"unknown function `{tree.function}`", tree.span, did_you_mean(tree.function, WORDS))
    if len(tree.arguments) not in word.arity:
        raise UserError(f"`{tree.function}` is written {word.signature}", tree.span, word.meaning)
    if tree.function == "eye":
        return (unit_size(tree, parameters),) * 2
    shapes = [shape_of(argument, scope, parameters) for argument in tree.arguments]
    shape = word.shape(*shapes)
    if shape is None:
        given = ", ".join(describe(s) for s in shapes)
        raise UserError(f"{word.signature} does not take {given}", tree.span, _advice(tree.function, shapes))
    return shape


def unit_size(tree: f.Call, parameters: Parameters) -> int:
    """The rows of eye(n)."""
    n = integer(tree.arguments[0], parameters)
    if not 1 <= n <= MAX_MATRIX:
        raise UserError(f"a unit matrix of {n} rows; 1 to {MAX_MATRIX} are compiled", tree.span)
    return n


def _advice(function: str, shapes: list[Shape]) -> str:
    """What the function is, or which function of matrices was meant."""
    matrix = len(shapes) == 1 and len(shapes[0]) == 2
    if matrix and f"{function}m" in WORDS:
        return f"the function of a symmetric matrix is {function}m(A)"
    if matrix and shapes[0][0] == shapes[0][1] and shapes[0][0] > MAX_MATRIX:
        return f"functions of matrices are compiled for at most {MAX_MATRIX} rows"
    return WORDS[function].meaning
