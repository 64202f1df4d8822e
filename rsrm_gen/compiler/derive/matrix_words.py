"""The words of the language for matrices, as methods of the reader of formulas."""

from __future__ import annotations

import itertools
from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping
from dataclasses import replace

import sympy as sp

from rsrm_gen.compiler.derive.geometry import LESS
from rsrm_gen.compiler.derive.matrix_functions import Eigenvalue, MatrixFunction
from rsrm_gen.compiler.derive.matrix_numeric import places, size_of
from rsrm_gen.compiler.derive.naming import tree_name
from rsrm_gen.compiler.derive.trace import Trace
from rsrm_gen.compiler.derive.values import Symmetry, Truth, Vector, choose
from rsrm_gen.compiler.spec import formula as f

SYMMETRIC = ("expm", "logm", "sqrtm", "invsqrtm", "log_sinhc_sqrtm", "eigh", "ad_squared")  # of symmetric matrices only


class MatrixWords(ABC):
    """Each method is a word: its arguments are values, a matrix a `Vector` with columns."""

    trace: Trace

    @abstractmethod
    def materialise(self, vector: Vector) -> tuple[sp.Expr, ...]:
        """The entries, multiplied out."""

    def unit_matrix(self, n: int) -> Vector:
        return Vector(tuple(sp.Integer(int(i == j)) for i in range(n) for j in range(n)), columns=n)

    def matrix(self, x: Vector) -> sp.Matrix:
        """A matrix, multiplied out, as sympy's."""
        return sp.Matrix(x.rows, x.columns, list(self.materialise(x)))

    def call_transpose(self, x: Vector) -> Vector:
        assert x.columns is not None
        entries = tuple(x.entry(i, j) for j in range(x.columns) for i in range(x.rows))
        return replace(x, entries=entries, columns=x.rows)

    def named_matrix(self, x: Vector) -> sp.Matrix:
        """A matrix of symbols and numbers, for what has many more terms than entries."""
        return self.matrix(x).applyfunc(lambda e: self.trace.define("entry", e))

    def call_trace(self, x: Vector) -> sp.Expr:
        return sp.Add(*self.materialise(x)[:: x.rows + 1])

    def call_above(self, x: Vector) -> Vector:
        return self.entries_at(x, itertools.combinations(range(x.rows), 2))

    def call_upper(self, x: Vector) -> Vector:
        return self.entries_at(x, places(x.rows))

    def entries_at(self, x: Vector, where: Iterable[tuple[int, int]]) -> Vector:
        """Some entries of a matrix, as a vector."""
        return replace(x, entries=tuple(x.entry(i, j) for i, j in where), columns=None)

    def call_svec(self, x: Vector) -> Vector:
        entries = (x.entry(i, j) * (1 if i == j else sp.sqrt(2)) for i, j in places(x.rows))
        return replace(x, entries=tuple(entries), columns=None)

    def call_smat(self, x: Vector) -> Vector:
        n = size_of(len(x.entries))
        scaled = {
            place: e * (1 if place[0] == place[1] else 1 / sp.sqrt(2))
            for place, e in zip(places(n), x.entries, strict=True)
        }
        return replace(x, entries=_symmetric(scaled, n), columns=n)

    def call_hat(self, x: Vector) -> Vector:
        a, b, c = x.entries
        zero = sp.Integer(0)
        return replace(x, entries=(zero, -c, b, c, zero, -a, -b, a, zero), columns=3)

    def call_vee(self, x: Vector) -> Vector:
        pairs = ((2, 1), (0, 2), (1, 0))
        return replace(x, entries=tuple((x.entry(i, j) - x.entry(j, i)) / 2 for i, j in pairs), columns=None)

    def call_rotation(self, x: Vector) -> Vector:
        w, i, j, k = self.materialise(x)
        return Vector((
            1 - 2 * (j * j + k * k), 2 * (i * j - w * k), 2 * (i * k + w * j),
            2 * (i * j + w * k), 1 - 2 * (i * i + k * k), 2 * (j * k - w * i),
            2 * (i * k - w * j), 2 * (j * k + w * i), 1 - 2 * (i * i + j * j),
        ), columns=3)  # fmt: skip

    def call_quaternion(self, x: Vector) -> Vector:
        # 4 q q^T is linear in R. Its row with the largest diagonal entry, 4 q_k^2 >= 1, is q times 4 q_k.
        entries = [self.trace.define(f"R{x.suffix(i)}", e) for i, e in enumerate(self.materialise(x))]
        R = sp.Matrix(3, 3, entries)
        scalar = [R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]
        square = sp.zeros(4, 4)
        square[0, 0] = 1 + R.trace()
        for i in range(3):
            square[0, i + 1] = square[i + 1, 0] = scalar[i]
            for j in range(3):
                square[i + 1, j + 1] = 1 - R.trace() + 2 * R[i, i] if i == j else R[i, j] + R[j, i]
        for k in range(4):
            square[k, k] = self.trace.define(f"square{k}", square[k, k])
        largest, row = square[0, 0], list(square.row(0))
        for k in range(1, 4):
            larger = Truth(LESS, largest, square[k, k])
            row = [self.trace.define("row", choose(larger, b, a)) for a, b in zip(row, square.row(k), strict=True)]
            largest = self.trace.define("largest", choose(larger, square[k, k], largest))
        length = self.trace.define("row_length", sp.sqrt(sp.Add(*(e**2 for e in row))))
        return Vector(tuple(e / length for e in row))

    def of_symmetric(self, tree: f.Call, x: Vector, name: str) -> Vector:
        """A function of a symmetric matrix; that it is symmetric is noted, to be looked at later."""
        n = x.rows
        packed = self.packed(tree, x)
        if tree.function == "eigh":
            return Vector(tuple(Eigenvalue(sp.Integer(n), sp.Integer(i), *packed) for i in range(n)))
        if tree.function == "ad_squared":
            return Vector(_ad_squared(dict(zip(places(n), packed, strict=True)), n), columns=n * (n - 1) // 2)
        entries = {
            (i, j): self.trace.define(f"{name}{i}_{j}", MatrixFunction.entry(tree.function, k, packed))
            for k, (i, j) in enumerate(places(n))
        }
        return Vector(_symmetric(entries, n), columns=n)

    def packed(self, tree: f.Call, x: Vector) -> tuple[sp.Expr, ...]:
        """The entries on and above the diagonal, each the mean of the two that should be equal, under names."""
        square = replace(x, entries=self.materialise(x), factors=(), divisors=())
        slug = tree_name(tree.arguments[0])
        hint = slug if len(slug) <= 12 and slug.isidentifier() else "entry"
        entries, pairs = [], []
        for i, j in places(x.rows):
            a, b = square.entry(i, j), square.entry(j, i)
            entries.append(self.trace.define(f"{hint}_{i}_{j}", a if a == b else (a + b) / 2))
            pairs += [] if a == b else [(a, b)]
        if pairs:
            self.trace.symmetries.append(Symmetry(tuple(pairs), tree.span))
        return tuple(entries)


def _symmetric(entries: Mapping[tuple[int, int], sp.Expr], n: int) -> tuple[sp.Expr, ...]:
    """All entries of a symmetric matrix, row by row."""
    return tuple(entries[min(i, j), max(i, j)] for i in range(n) for j in range(n))


def _ad_squared(entries: Mapping[tuple[int, int], sp.Expr], n: int) -> tuple[sp.Expr, ...]:
    """The products <[L, X_a], [L, X_b]> / 2, X_a with 1 above the diagonal and -1 below.

    Sums of products of differences, in which nothing cancels: a multiple of the unit matrix in L drops out at once.
    """
    L = sp.Matrix(n, n, list(_symmetric(entries, n)))
    brackets = []
    for i, j in itertools.combinations(range(n), 2):
        X = sp.zeros(n, n)
        X[i, j], X[j, i] = 1, -1
        brackets.append(L * X - X * L)
    return tuple(sp.Add(*(x * y for x, y in zip(a, b, strict=True))) / 2 for a in brackets for b in brackets)
