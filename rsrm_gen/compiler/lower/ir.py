"""The intermediate representation: a hash-consed graph of scalar operations.

Two nodes that compute the same are the same object, so common subexpressions are found as they are built. A node is one
of

    input      a scalar argument                      constant   an exact number: a sympy expression without symbols
    eps        the rounding unit of the precision      neg, add, sub, mul, div
    sqrt       of what is known to be positive        root       of what may be zero: its derivative there is 0, not infinite
    exp log sin cos tan sinh cosh tanh asinh acosh acos atanh atan2 abs round
    polynomial c0 + c1 x + ..., exact coefficients     select     (condition, x, y)
    less, less_equal, equal   conditions, only as the first argument of a select
    declared   (value, variables...): the value, with derivatives in the variables that the graph keeps; gone once differentiated

and, for functions of symmetric matrices, two nodes of several values and one that picks from them:

    eigh       of the entries on and above the diagonal, row by row ("packed"): eigenvalues, ascending, and eigenvectors
    spectral   (function, order m) of an eigh and the packed entries of m matrices E: D^m f(A)[E1, ..., Em], packed
    entry      one value: of a spectral, a packed entry; of an eigh, an eigenvalue

What it does not have: loops, arrays, assignments. Those belong to the back ends.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, fields
from functools import cached_property

import sympy as sp

from rsrm_gen.compiler.budget import spend
from rsrm_gen.compiler.derive.matrix_numeric import size_of
from rsrm_gen.compiler.spec.vocabulary import Shape

FUNCTIONS = (
    "sqrt",
    "root",
    "exp",
    "log",
    "sin",
    "cos",
    "tan",
    "sinh",
    "cosh",
    "tanh",
    "asinh",
    "acosh",
    "acos",
    "atanh",
    "atan2",
    "abs",
    "round",
)
CONDITIONS = ("less", "less_equal", "equal")
SEVERAL = ("eigh", "spectral")  # the operations of more than one value

# Beyond the one that every operation counts, where a processor computes many at once.
VECTOR_WORK = {
    "div": 4, "sqrt": 4, "root": 4, "exp": 14, "log": 16, "sin": 18, "cos": 18, "tan": 24, "sinh": 20, "cosh": 20, "tanh": 20,
    "asinh": 24, "acosh": 24, "acos": 24, "atanh": 24, "atan2": 28, "abs": 0, "round": 0, "select": 1,
}  # fmt: skip

Packed = tuple["Node", ...]


@dataclass(frozen=True, eq=False)
class Node:
    """One operation. Identity is equality: the graph never holds two nodes that are alike."""

    op: str
    arguments: tuple[Node, ...] = ()
    # input: its name; constant: a sympy number; polynomial: its coefficients; spectral: function and order; entry: which
    value: object = None
    number: int = field(default=0, compare=False)  # the order of creation: arguments come before their users

    @property
    def is_constant(self) -> bool:
        """Whether this is an exact number."""
        return self.op == "constant"

    def is_number(self, x: int) -> bool:
        """Whether this is that number."""
        return self.op == "constant" and bool(self.value == x)

    @property
    def rows(self) -> int:
        """The rows of the matrix of an eigh or a spectral."""
        return size_of(len(self.arguments)) if self.op == "eigh" else self.arguments[0].rows

    @property
    def function(self) -> tuple[str, int]:
        """Which function of a matrix a spectral is, and its order."""
        use: tuple[str, int] = self.value  # type: ignore[assignment]
        return use

    @property
    def index(self) -> int:
        """Which value an entry picks."""
        return int(self.value)  # type: ignore[call-overload,no-any-return]

    @property
    def directions(self) -> list[Packed]:
        """The matrices E of a spectral."""
        size = len(self.arguments[0].arguments)
        return [self.arguments[k : k + size] for k in range(1, len(self.arguments), size)]


class Graph:
    """Makes nodes; keeps one of each, and folds what is trivially simpler."""

    def __init__(self) -> None:
        self.nodes: dict[tuple[str, tuple[Node, ...], object], Node] = {}
        self.names: dict[Node, str] = {}  # what a person would call a node
        self.slopes: dict[Node, tuple[Node, ...]] = {}  # the derivatives of declared nodes in their variables
        self.forms: dict[Node, Node] = {}  # of some declared nodes, what they are said to be, in their variables

    def node(self, op: str, *arguments: Node, value: object = None) -> Node:
        """The node of an operation, without simplification."""
        key = (op, arguments, value)
        if key not in self.nodes:
            spend(1)
            self.nodes[key] = Node(op, arguments, value, len(self.nodes))
        return self.nodes[key]

    def named(self, name: str, node: Node) -> Node:
        """Remember a name for a node that computes something; the first name stays."""
        if node.arguments:
            self.names.setdefault(node, name)
        return node

    def input(self, name: str) -> Node:
        """A scalar argument."""
        return self.node("input", value=name)

    def constant(self, value: sp.Expr | int) -> Node:
        """An exact number."""
        return self.node("constant", value=sp.Integer(value) if isinstance(value, int) else value)

    def neg(self, x: Node) -> Node:
        """-x."""
        if x.is_constant:
            return self.constant(-x.value)  # type: ignore[operator]
        if x.op == "neg":
            return x.arguments[0]
        if x.op == "sub":
            return self.node("sub", x.arguments[1], x.arguments[0])
        return self.node("neg", x)

    def add(self, x: Node, y: Node) -> Node:
        """x + y."""
        if x.is_number(0):
            return y
        if y.is_number(0):
            return x
        if x.is_constant and y.is_constant:
            return self.constant(x.value + y.value)  # type: ignore[operator]
        if y.op == "neg":
            return self.sub(x, y.arguments[0])
        if x.op == "neg":
            return self.sub(y, x.arguments[0])
        return self.node("add", *self.ordered(x, y))

    def sub(self, x: Node, y: Node) -> Node:
        """x - y."""
        if y.is_number(0):
            return x
        if x.is_number(0):
            return self.neg(y)
        if x is y:
            return self.constant(0)
        if x.is_constant and y.is_constant:
            return self.constant(x.value - y.value)  # type: ignore[operator]
        if y.op == "neg":
            return self.add(x, y.arguments[0])
        return self.node("sub", x, y)

    def mul(self, x: Node, y: Node) -> Node:
        """x y."""
        x, y = self.ordered(x, y)
        if x.is_constant and y.is_constant:
            return self.constant(x.value * y.value)  # type: ignore[operator]
        for a, b in ((x, y), (y, x)):
            if a.is_number(0):
                return a
            if a.is_number(1):
                return b
            if a.is_number(-1):
                return self.neg(b)
        if x.op == "neg" and y.op == "neg":
            return self.mul(x.arguments[0], y.arguments[0])
        if x.op == "neg":
            return self.neg(self.mul(x.arguments[0], y))
        if y.op == "neg":
            return self.neg(self.mul(x, y.arguments[0]))
        if x is y and x.op in ("sqrt", "root"):
            return x.arguments[0]
        if x.is_constant and y.op == "mul" and y.arguments[0].is_constant:
            return self.mul(self.constant(x.value * y.arguments[0].value), y.arguments[1])  # type: ignore[operator]
        if x.op == "mul" and y.op == "mul" and x.arguments[0].is_constant and y.arguments[0].is_constant:
            product = x.arguments[0].value * y.arguments[0].value  # type: ignore[operator]
            if product in (1, -1):  # the numbers cancel
                return self.mul(self.constant(product), self.mul(x.arguments[1], y.arguments[1]))
        return self.node("mul", x, y)

    def div(self, x: Node, y: Node) -> Node:
        """x / y."""
        if y.is_constant and not y.is_number(0):
            return self.mul(self.constant(1 / y.value), x)  # type: ignore[operator]
        if x.is_number(0):
            return x
        if x.op == "neg":
            return self.neg(self.div(x.arguments[0], y))
        return self.node("div", x, y)

    def function(self, name: str, *arguments: Node) -> Node:
        """One of `FUNCTIONS`."""
        if name in ("sqrt", "root") and (arguments[0].is_number(0) or arguments[0].is_number(1)):
            return arguments[0]
        return self.node(name, *arguments)

    def polynomial(self, x: Node, coefficients: tuple[sp.Expr, ...]) -> Node:
        """c0 + c1 x + c2 x^2 + ..."""
        return (
            self.constant(coefficients[0]) if len(coefficients) == 1 else self.node("polynomial", x, value=coefficients)
        )

    def select(self, condition: Node, x: Node, y: Node) -> Node:
        """x where the condition holds, else y."""
        if _is_true(condition):
            return x
        return x if x is y else self.node("select", condition, x, y)

    def declared(self, value: Node, *variables: Node) -> Node:
        """A value known to be a function of some variables, however it is computed; `slopes` must be told its derivatives.

        The derivatives may be made of declared nodes, this one too.
        """
        return self.node("declared", value, *variables)

    def eigh(self, matrix: Packed) -> Node:
        """The eigenvalues and eigenvectors of a symmetric matrix."""
        return self.node("eigh", *matrix)

    def eigenvalue(self, matrix: Packed, index: int) -> Node:
        """One eigenvalue, the smallest first."""
        return self.node("entry", self.eigh(matrix), value=index)

    def spectral(self, name: str, eigh: Node, directions: Iterable[Packed] = ()) -> Packed:
        """The entries of D^m f(A)[E1, ..., Em], whose order does not matter."""
        ordered = sorted(directions, key=lambda e: [node.number for node in e])
        whole = self.node("spectral", eigh, *(node for e in ordered for node in e), value=(name, len(ordered)))
        return tuple(self.node("entry", whole, value=i) for i in range(len(eigh.arguments)))

    @staticmethod
    def ordered(x: Node, y: Node) -> tuple[Node, Node]:
        """The operands of a commutative operation in one order: constants first, then the older."""
        key = (not x.is_constant, x.number), (not y.is_constant, y.number)
        return (x, y) if key[0] <= key[1] else (y, x)


@dataclass(frozen=True)
class Parameter:
    """An argument of a routine: its shape and the input nodes of its entries in row-major order."""

    name: str
    shape: Shape
    nodes: tuple[Node, ...]


@dataclass(frozen=True)
class Result:
    """A result of a routine: its shape and its entries in row-major order."""

    name: str
    shape: Shape
    nodes: tuple[Node, ...]


@dataclass(frozen=True, eq=False)
class Routine:
    """A function as a schedule: nodes worth a name, in the order in which they are computed, and the results.

    Every node that is not in `body` is written inside the expression of the one that uses it. Identity is equality.
    """

    name: str
    parameters: tuple[Parameter, ...]
    body: tuple[tuple[str, Node], ...]
    results: tuple[Result, ...]
    formula: str

    @cached_property
    def nodes(self) -> list[Node]:
        """All nodes that the results need, arguments before users."""
        return reachable(n for result in self.results for n in result.nodes)

    @cached_property
    def operations(self) -> int:
        """How many arithmetic operations one call takes: every node but inputs and numbers; a polynomial counts its steps."""
        return sum(_cost(node) for node in self.nodes)

    @cached_property
    def inputs(self) -> set[str]:
        """The names of the scalars that are read."""
        return {str(node.value) for node in self.nodes if node.op == "input"}

    @property
    def reads_eps(self) -> bool:
        """Whether the rounding unit occurs."""
        return any(node.op == "eps" for node in self.nodes)


@dataclass(frozen=True)
class Pairs:
    """A splat split by what its parts depend on: the point, the splat, or the pair of them (see `pairs.py`)."""

    features: Routine
    constants: Routine
    value: Routine
    forward: Routine
    gradient: Routine
    gradient_vjp: Routine
    backward: Routine
    constants_vjp: Routine

    def __iter__(self) -> Iterator[Routine]:
        return (getattr(self, field.name) for field in fields(self))

    @property
    def work(self) -> int:
        """What a pair costs, forward and backward, in multiplications: roughly, to compare one form with another."""
        nodes = [*self.forward.nodes, *self.backward.nodes]
        return sum(_cost(node) + VECTOR_WORK.get(node.op, 0) for node in nodes)


@dataclass(frozen=True)
class Culling:
    """A bound of |det D Log_mu(x)|, so that splats too far from a point may be left out of a sum: see `culling.py`."""

    log_bound: float  # the logarithm of the bound
    radius: float  # the distance between mu and x up to which it holds; infinite on most manifolds


@dataclass(frozen=True)
class Program:
    """All routines of a manifold, and its splat split for sums over many points and splats."""

    name: str
    routines: tuple[Routine, ...]
    pairs: Pairs
    culling: Culling | None = None  # None where nothing bounds what a far splat adds

    def __getitem__(self, name: str) -> Routine:
        found = next((routine for routine in self.routines if routine.name == name), None)
        if found is None:
            raise KeyError(name)  # and not StopIteration, which would end whatever loop asks
        return found

    def __iter__(self) -> Iterator[Routine]:
        return iter(self.routines)


def _is_true(condition: Node) -> bool:
    """Whether this says 0 <= c eps: at an exact antipode, as below some rounding."""
    x, y = condition.arguments
    return (
        condition.op == "less_equal"
        and x.is_number(0)
        and all(n.op == "eps" or _is_positive(n) for n in reachable([y]))
    )


def _is_positive(node: Node) -> bool:
    return node.op == "mul" or (node.is_constant and bool(node.value > 0))  # type: ignore[operator]


def dot(graph: Graph, x: Iterable[Node], y: Iterable[Node]) -> Node:
    """The sum of the products of two rows of one length."""
    total = graph.constant(0)
    for a, b in zip(x, y, strict=True):
        total = graph.add(total, graph.mul(a, b))
    return total


def reachable(roots: Iterable[Node]) -> list[Node]:
    """All nodes that the roots need, arguments before users."""
    seen: dict[Node, None] = {}
    stack = list(roots)
    while stack:
        node = stack.pop()
        if node not in seen:
            seen[node] = None
            stack.extend(node.arguments)
    return sorted(seen, key=lambda node: node.number)


def _cost(node: Node) -> int:
    if node.op in ("input", "constant", "eps", "entry"):
        return 0
    if node.op == "eigh":
        return 40 * node.rows**3  # about what the sweeps of Jacobi's method take
    if node.op == "spectral":  # the directions into the eigenbasis, the sum over all paths, and out again
        n, m = node.rows, len(node.directions)
        paths: int = n ** (m + 1)
        return 4 * (m + 1) * n**3 + 2 * (m + 1) * math.factorial(m) * paths
    return 2 * (len(node.value) - 1) if node.op == "polynomial" else 1  # type: ignore[arg-type]
