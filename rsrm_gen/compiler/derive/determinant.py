"""log |det D Log_p(q)| between tangent spaces, with the Riemannian volumes on both sides.

The Jacobian of Log is staged: by the chain rule over its assignments, entry by entry. From its values follow those of the
determinant in 60 digits (`Volumes`), by which `closed_form.py` knows a closed form. Where none is found, the
determinant of a matrix of symbols is emitted: block by block of its nonzero pattern, small blocks expanded, larger ones
orthogonalised. Orthogonalising needs no pivots and is defined wherever the determinant is not zero.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import mpmath as mp
import sympy as sp
from sympy.utilities.iterables import strongly_connected_components

from rsrm_gen.compiler.budget import spend
from rsrm_gen.compiler.derive.bounds import Sizes
from rsrm_gen.compiler.derive.geometry import Assignment, Function
from rsrm_gen.compiler.derive.numeric import DIGITS, run
from rsrm_gen.compiler.derive.operators import Operators
from rsrm_gen.errors import UserError

EXPANDED = 3  # blocks up to this size are expanded; a determinant has factorially many terms
MAX_STAGED = 8  # beyond, the derivatives of the splat are more code than a C compiler likes

Matrix = list[list[Any]]


@dataclass(frozen=True)
class StagedJacobian:
    """Log with the derivatives of its results: `entries[i][j]` = d result_i / d q_j."""

    function: Function
    entries: tuple[tuple[sp.Expr, ...], ...]


def staged_jacobian(log: Function) -> StagedJacobian:
    """The Jacobian of Log in q, by the chain rule over the assignments; guards are differentiated with their branches."""
    q = log.arguments[1].symbols
    assignments: list[Assignment] = []
    derivative: list[dict[sp.Symbol, sp.Expr]] = [{s: sp.Integer(int(s == c)) for s in log.symbols()} for c in q]

    sizes = Sizes()

    @cache
    def partial(expression: sp.Expr, symbol: sp.Symbol) -> sp.Expr:  # the same for every column of the Jacobian
        return sp.diff(expression, symbol)

    def chain(expression: sp.Expr, j: int) -> sp.Expr:
        spend(sizes.of(expression).operations)
        parts = ((s, derivative[j][s]) for s in sorted(expression.free_symbols & derivative[j].keys(), key=str))
        return sp.Add(*(partial(expression, s) * ds for s, ds in parts if ds != 0))

    for a in log.assignments:
        assignments.append(a)
        for j, c in enumerate(q):
            expression = chain(a.expression, j)
            guard = a.guard and replace(a.guard, near=chain(a.guard.near, j))
            symbol = sp.Symbol(f"{a.symbol}_by_{c}", real=True)
            plain = guard is None and (expression.is_number or expression.is_Symbol)
            derivative[j][a.symbol] = expression if plain else symbol
            if not plain:
                assignments.append(Assignment(symbol, expression, guard))
    entries = tuple(tuple(chain(result, j) for j in range(len(q))) for result in log.results)
    flat = tuple(e for row in entries for e in row)
    function = Function(
        "log_jacobian", log.arguments, tuple(assignments), flat, (len(entries), len(q)), "d Log_p(q) / d q"
    )
    return StagedJacobian(function, entries)


class Volumes:
    """Determinants of D Log in 60 digits: volumes of an image basis at p over those of the basis at q.

    For a basis b_j of T_q M: sqrt(det <D Log b_i, D Log b_j>_p / det <b_i, b_j>_q).
    """

    def __init__(self, operators: Operators) -> None:
        self.spec = operators.spec
        self.p = operators.p
        self.metric = self.function("metric", operators.metric)
        self.frame = self.function("frame", operators.frame)
        self.normals = self.function("normals", operators.constraint_jacobian)

    def function(self, name: str, matrix: sp.Matrix) -> Function:
        """A matrix in the symbols of p as a function."""
        return Function(name, (self.p,), (), tuple(matrix), matrix.shape, "")

    def log_det(self, p: Sequence[Any], q: Sequence[Any], jacobian_entries: Sequence[Any]) -> Any:
        """log |det| from the entries of the Jacobian; NaN where it is singular."""
        size = self.spec.point_size
        jacobian = [list(jacobian_entries[i : i + size]) for i in range(0, len(jacobian_entries), size)]
        with mp.workdps(DIGITS):
            ambient, stored = self.bases(q)
            image = [[mp.fdot(row, b) for row in jacobian] for b in ambient]
            logs = [self.log_gram(at, basis) for at, basis in ((p, image), (q, stored))]
            return (logs[0] - logs[1]) / 2

    def bases(self, q: Sequence[Any]) -> tuple[Matrix, Matrix]:
        """d vectors that span T_q M: as ambient vectors, and as the manifold stores tangent vectors."""
        unit = [[mp.mpf(int(i == j)) for j in range(self.spec.dim)] for i in range(self.spec.dim)]
        if self.spec.frame is not None:
            return _at(self.frame, q), unit
        if not self.spec.embedded:
            return unit, unit
        basis = _null_space(_at(self.normals, q))
        return basis, basis

    def log_gram(self, at: Sequence[Any], basis: Matrix) -> Any:
        """log of the determinant of the inner products, by elimination: it is positive, and so is every pivot."""
        metric = _at(self.metric, at)
        lowered = [[mp.fdot(row, b) for row in metric] for b in basis]
        gram = [[mp.fdot(x, b) for b in basis] for x in lowered]
        total = mp.mpf(0)
        for k, row in enumerate(gram):
            if not row[k] > 0:
                return mp.nan
            total += mp.log(row[k])
            for other in gram[k + 1 :]:
                factor = other[k] / row[k]
                for j in range(k + 1, len(row)):
                    other[j] -= factor * row[j]
        return total


def _at(function: Function, point: Sequence[Any]) -> Matrix:
    entries = run(function, point)[0]
    columns = function.shape[1]
    return [entries[i : i + columns] for i in range(0, len(entries), columns)]


def _null_space(rows: Matrix) -> Matrix:
    """Vectors that span the null space of a matrix of full rank with few rows, by elimination with column pivots."""
    a = [list(row) for row in rows]
    columns = range(len(a[0]))
    pivots: list[int] = []
    for i, row in enumerate(a):
        pivot = max((j for j in columns if j not in pivots), key=lambda j, row=row: abs(row[j]))  # type: ignore[misc]
        pivots.append(pivot)
        a[i] = row = [x / row[pivot] for x in row]
        for k, other in enumerate(a):
            if k != i:
                a[k] = [x - other[pivot] * y for x, y in zip(other, row, strict=True)]
    basis = []
    for free in (j for j in columns if j not in pivots):
        vector = [mp.mpf(int(j == free)) for j in columns]
        for i, pivot in enumerate(pivots):
            vector[pivot] = -a[i][free]
        basis.append(vector)
    return basis


def staged_log_det(jacobian: StagedJacobian, operators: Operators) -> Function:
    """log |det| of a matrix of symbols."""
    return _Staging(jacobian, operators).function()


class _Staging:
    """Writes the determinant down as assignments after those of the Jacobian."""

    def __init__(self, jacobian: StagedJacobian, operators: Operators) -> None:
        self.jacobian = jacobian
        self.operators = operators
        self.assignments = list(jacobian.function.assignments)
        self.taken = {str(a.symbol) for a in self.assignments} | {str(s) for s in jacobian.function.symbols()}

    def function(self) -> Function:
        """The whole: a sum of logarithms, one a block, and the volumes of the metric and of the normals."""
        operators, function = self.operators, self.jacobian.function
        p, q = (argument.symbols for argument in function.arguments)
        to_q = dict(zip(p, q, strict=True))
        terms = [self.log_abs_det(self.named("J", self.bordered(to_q)))]
        terms += [self.log_abs_det(operators.metric) / 2, -self.log_abs_det(operators.metric.xreplace(to_q)) / 2]
        if operators.spec.ambient_tangents:
            gram = operators.on_manifold(operators.constraint_jacobian * operators.normals())
            terms += [-self.log_abs_det(gram) / 2, -self.log_abs_det(gram.xreplace(to_q)) / 2]
        text = "log |det D Log_p(q)|, staged"
        return Function("log_abs_det", function.arguments, tuple(self.assignments), (sp.Add(*terms),), (), text)

    def bordered(self, to_q: dict[sp.Symbol, sp.Symbol]) -> sp.Matrix:
        """A square matrix: D Log in components; with ambient tangents, bordered by the normals.

        [[D Log, N_p], [dc_q, 0]] with N = G^-1 dc^T, whose determinant is that of D Log between the tangent spaces times
        sqrt(det(dc N)_p det(dc N)_q det G_q / det G_p).
        """
        jacobian, operators = sp.Matrix(self.jacobian.entries), self.operators
        if not operators.spec.ambient_tangents:
            return jacobian * operators.frame.xreplace(to_q).T
        normals, constraint = operators.normals(), operators.constraint_jacobian.xreplace(to_q)
        return sp.Matrix([[jacobian, normals], [constraint, sp.zeros(constraint.rows, normals.cols)]])

    def log_abs_det(self, matrix: sp.Matrix) -> sp.Expr:
        """log |det matrix|, block by block."""
        blocks = _blocks(matrix)
        span = self.operators.spec.log.value.span
        if blocks is None:
            raise UserError("D Log_p(q) is singular: Log does not tell points apart", span)
        largest = max(block.rows for block in blocks)
        if largest > MAX_STAGED:
            raise UserError(
                f"no closed form of the determinant of D Log is found, and it is {largest} x {largest}; "
                f"beyond {MAX_STAGED} x {MAX_STAGED} it is not eliminated",
                span,
                "give its closed form as `log_det:`; the audit will check it",
            )
        return sp.Add(*(self.log_of(block) for block in blocks))

    def define(self, hint: str, expression: sp.Expr) -> sp.Expr:
        """A name for an expression."""
        if expression.is_number or expression.is_Symbol:
            return expression
        name, count = hint, 1
        while name in self.taken:
            count += 1
            name = f"{hint}_{count}"
        self.taken.add(name)
        symbol = sp.Symbol(name, real=True)
        self.assignments.append(Assignment(symbol, expression))
        return symbol

    def named(self, name: str, matrix: sp.Matrix) -> sp.Matrix:
        """The matrix with a name for every entry."""
        return sp.Matrix(*matrix.shape, lambda i, j: self.define(f"{name}{i}_{j}", matrix[i, j]))

    def log_of(self, block: sp.Matrix) -> sp.Expr:
        """log |det block|: of one expanded, or a sum, for the product of many lengths may leave the range of numbers."""
        if block.rows > EXPANDED:
            return sp.Add(*(sp.log(square) for square in self.orthogonalised(block))) / 2
        determinant = block.det(method="berkowitz")
        return sp.log(sp.Abs(determinant)) if determinant != 1 else sp.Integer(0)

    def orthogonalised(self, block: sp.Matrix) -> list[sp.Expr]:
        """The squared lengths of the rows, each made orthogonal to those before it (modified Gram-Schmidt)."""
        rows = [list(block.row(i)) for i in range(block.rows)]
        squares = []
        for i, row in enumerate(rows):
            square = self.define(f"row{i}_squared", sp.Add(*(x**2 for x in row)))
            squares.append(square)
            for k in range(i + 1, len(rows)):
                part = self.define(
                    f"row{k}_along_row{i}", sp.Add(*(x * y for x, y in zip(rows[k], row, strict=True))) / square
                )
                rows[k] = [
                    self.define(f"R{k}_{j}", y - part * x) for j, (x, y) in enumerate(zip(row, rows[k], strict=True))
                ]
        return squares


def _blocks(matrix: sp.Matrix) -> list[sp.Matrix] | None:
    """The diagonal blocks of the finest block-triangular form: rows are matched with columns, then grouped by need.

    None when no matching exists: then the determinant is zero by its pattern.
    """
    size = range(matrix.rows)
    columns = [[j for j in size if matrix[i, j] != 0] for i in size]
    column_of = _matching(columns)
    if column_of is None:
        return None
    row_of = {j: i for i, j in enumerate(column_of)}
    edges = [(i, row_of[j]) for i in size for j in columns[i]]
    groups = strongly_connected_components((list(size), edges))
    return [matrix.extract(sorted(group), sorted(column_of[i] for i in group)) for group in groups]


def _matching(columns: Sequence[Sequence[int]]) -> list[int] | None:
    """A column for every row, each once, by augmenting paths; the diagonal where it can be."""
    row_of: dict[int, int] = {i: i for i, found in enumerate(columns) if i in found}

    def place(i: int, seen: set[int]) -> bool:
        for j in columns[i]:
            if j not in seen:
                seen.add(j)
                if j not in row_of or place(row_of[j], seen):
                    row_of[j] = i
                    return True
        return False

    if not all(row_of.get(i) == i or place(i, set()) for i in range(len(columns))):
        return None
    column_of = {i: j for j, i in row_of.items()}
    return [column_of[i] for i in range(len(columns))]


def metric_determinant(metric: sp.Matrix) -> sp.Expr | None:
    """Of a metric whose blocks are small; None of another. A diagonal one's is the product, which reads and rounds best."""
    if metric.is_diagonal():
        return sp.Mul(*metric.diagonal())
    blocks = _blocks(metric)
    small = blocks is not None and all(block.rows <= EXPANDED for block in blocks)
    return sp.Mul(*(block.det(method="berkowitz") for block in blocks)) if blocks and small else None
