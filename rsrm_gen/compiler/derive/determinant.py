"""log |det D Log_p(q)| between tangent spaces, with the Riemannian volumes on both sides.

The determinant is staged: the Jacobian of Log by the chain rule over its assignments, entry by entry, then the determinant
of a matrix of symbols. Then a closed form is looked for: on many manifolds the determinant is a product of powers of
quantities that Log has computed already, (t / |w|)^(n-1) on the sphere. Exponents are found from values in 60 digits
and believed only when they hold to 40 digits at pairs of points that were not used to find them.
"""

from __future__ import annotations

import itertools
import random
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import mpmath as mp
import numpy as np
import sympy as sp

from rsrm_gen.compiler.budget import spend
from rsrm_gen.compiler.derive.bounds import Sizes
from rsrm_gen.compiler.derive.geometry import Assignment, Function
from rsrm_gen.compiler.derive.numeric import DIGITS, TINY, Values, determinant, run, value
from rsrm_gen.compiler.derive.operators import Operators
from rsrm_gen.compiler.derive.sampling import Sampler
from rsrm_gen.errors import UserError

MAX_STAGED = 6  # the determinant of a matrix of symbols has factorially many terms
MAX_TRIED = 10_000  # choices of one, of two and of three scalars
PAIRS = 12  # pairs of points at which exponents are found and tried


@dataclass(frozen=True)
class StagedJacobian:
    """Log with the derivatives of its results: `entries[i][j]` = d result_i / d q_j."""

    function: Function
    entries: tuple[tuple[sp.Expr, ...], ...]


@dataclass(frozen=True)
class ClosedForm:
    """|det D Log| = constant * product of symbol^exponent."""

    constant: Fraction
    exponents: tuple[tuple[sp.Symbol, Fraction], ...]

    def log(self) -> sp.Expr:
        """Its logarithm: one logarithm of a quotient for each size of exponent."""
        sizes = sorted({abs(k) for _, k in self.exponents})
        constant = sp.Rational(self.constant.numerator, self.constant.denominator)
        terms = []
        for size in sizes:
            power = sp.Rational(size.numerator, size.denominator)
            quotient = sp.Mul(*(s ** (1 if k > 0 else -1) for s, k in self.exponents if abs(k) == size))
            root = constant ** (1 / power)
            if root.is_Rational:  # log(t / (2 |s|)) is more exact than log(t / |s|) - log(2)
                quotient, constant = root * quotient, sp.Integer(1)
            terms.append(power * sp.log(quotient))
        return sp.Add(*terms) + sp.log(constant)


def staged_jacobian(log: Function) -> StagedJacobian:
    """The Jacobian of Log in q, by the chain rule over the assignments; guards are differentiated with their branches."""
    q = log.arguments[1].symbols
    assignments: list[Assignment] = []
    derivative: list[dict[sp.Symbol, sp.Expr]] = [{s: sp.Integer(int(s == c)) for s in log.symbols()} for c in q]

    sizes = Sizes()

    def chain(expression: sp.Expr, j: int) -> sp.Expr:
        spend(sizes.of(expression).operations)
        parts = ((s, derivative[j][s]) for s in sorted(expression.free_symbols & derivative[j].keys(), key=str))
        return sp.Add(*(sp.diff(expression, s) * ds for s, ds in parts if ds != 0))

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


def closed_form(
    jacobian: StagedJacobian, scalars: Sequence[sp.Symbol], operators: Operators, sampler: Sampler
) -> ClosedForm | None:
    """The determinant as a product of powers of at most three of the scalars, if it is one."""
    rng = random.Random(2)
    samples = [_sample(jacobian, operators, sampler, rng) for _ in range(PAIRS)]
    target = [log_det for log_det, _ in samples]
    if not all(mp.isfinite(x) for x in target):
        raise UserError("D Log_p(q) is singular: Log does not tell points apart", operators.spec.log.value.span)
    if all(abs(x) < TINY for x in target):
        return ClosedForm(Fraction(1), ())
    logs = {s: _logs(s, [values for _, values in samples]) for s in scalars}
    usable = [s for s in scalars if logs[s] is not None]
    for count in (1, 2, 3):
        for chosen in itertools.islice(itertools.combinations(usable, count), MAX_TRIED):
            spend()
            found = _exponents(target, [logs[s] for s in chosen])
            if found is not None:
                constant, exponents = found
                return ClosedForm(constant, tuple(zip(chosen, exponents, strict=True)))
    return None


def _sample(jacobian: StagedJacobian, operators: Operators, sampler: Sampler, rng: random.Random) -> tuple[Any, Values]:
    p, q = sampler.pair(rng)
    entries, values = run(jacobian.function, p, q)
    return log_det_value(operators, p, q, entries), values


def log_det_value(operators: Operators, p: Sequence[Any], q: Sequence[Any], jacobian_entries: Sequence[Any]) -> Any:
    """log |det| from the entries of the Jacobian: volumes of an image basis at p over those of the basis at q.

    For a basis b_j of T_q M: sqrt(det <D Log b_i, D Log b_j>_p / det <b_i, b_j>_q).
    """
    with mp.workdps(DIGITS):
        jacobian = mp.matrix(operators.spec.tangent_size, operators.spec.point_size)
        for k, entry in enumerate(jacobian_entries):
            jacobian[k // operators.spec.point_size, k % operators.spec.point_size] = entry
        ambient, stored = tangent_basis(operators, q)
        image = jacobian * ambient
        volumes = [_gram(operators, at, basis) for at, basis in ((p, image), (q, stored))]
        return mp.log(abs(volumes[0] / volumes[1])) / 2 if volumes[1] else mp.nan


def tangent_basis(operators: Operators, q: Sequence[Any]) -> tuple[Any, Any]:
    """A basis of T_q M as columns: as ambient vectors (D, d), and as the manifold stores tangent vectors (T, d)."""
    spec = operators.spec
    if spec.frame is not None:
        return _at(operators, operators.frame.T, q), mp.eye(spec.dim)
    if not spec.embedded:
        return mp.eye(spec.dim), mp.eye(spec.dim)
    basis = _null_space(_at(operators, operators.constraint_jacobian, q))
    return basis, basis


def _gram(operators: Operators, at: Sequence[Any], basis: Any) -> Any:
    return determinant(basis.T * _at(operators, operators.metric, at) * basis)


def _at(operators: Operators, matrix: sp.Matrix, point: Sequence[Any]) -> Any:
    values = dict(zip(operators.p.symbols, point, strict=True))
    return mp.matrix([[value(matrix[i, j], values) for j in range(matrix.cols)] for i in range(matrix.rows)])


def _null_space(rows: Any) -> Any:
    """Columns that span the null space of a matrix of full rank with few rows, by elimination with column pivots."""
    with mp.workdps(DIGITS):
        a = rows.copy()
        pivots: list[int] = []
        for i in range(a.rows):
            pivot = max((j for j in range(a.cols) if j not in pivots), key=lambda j, i=i: abs(a[i, j]))  # type: ignore[misc]
            pivots.append(pivot)
            a[i, :] = a[i, :] / a[i, pivot]
            for k in range(a.rows):
                if k != i:
                    a[k, :] = a[k, :] - a[i, :] * a[k, pivot]
        free = [j for j in range(a.cols) if j not in pivots]
        basis = mp.matrix(a.cols, len(free))
        for column, j in enumerate(free):
            basis[j, column] = 1
            for i, pivot in enumerate(pivots):
                basis[pivot, column] = -a[i, j]
        return basis


def _logs(symbol: sp.Symbol, samples: Sequence[Values]) -> list[Any] | None:
    """log of a symbol at the samples; None when it is constant, or not positive somewhere."""
    values = [samples_value[symbol] for samples_value in samples]
    if not all(mp.isfinite(x) and x > TINY for x in values) or all(abs(x - values[0]) < TINY for x in values):
        return None
    with mp.workdps(DIGITS):
        return [mp.log(x) for x in values]


def _exponents(target: Sequence[Any], logs: Sequence[Any]) -> tuple[Fraction, list[Fraction]] | None:
    """Rational exponents and a rational constant with target = log constant + sum of exponent * log, at all samples."""
    size = len(logs) + 1
    rough = np.array([[1.0, *(float(x[i]) for x in logs)] for i in range(PAIRS)])
    _, residual, rank, _ = np.linalg.lstsq(rough, np.array([float(t) for t in target]), rcond=None)
    if rank < size or residual.size == 0 or residual[0] > 1e-18:
        return None
    with mp.workdps(DIGITS):
        matrix = mp.matrix([[1, *(x[i] for x in logs)] for i in range(size)])
        solution = mp.lu_solve(matrix, mp.matrix(list(target[:size])))
        rationals = [_rational(solution[k]) for k in range(1, size)]
        constant = _rational(mp.exp(solution[0]))
        if constant is None or any(k is None or k == 0 for k in rationals):
            return None
        exponents = [k for k in rationals if k is not None]
        for i in range(PAIRS):
            sum_of_logs = mp.fsum(
                mp.mpf(k.numerator) / k.denominator * x[i] for k, x in zip(exponents, logs, strict=True)
            )
            if abs(sum_of_logs + mp.log(mp.mpf(constant.numerator) / constant.denominator) - target[i]) > TINY:
                return None
    return constant, exponents


def _rational(x: Any) -> Fraction | None:
    """The simple fraction that x is to 30 digits, or None."""
    for denominator in (1, 2, 3, 4, 6, 8, 9, 16, 27, 32, 64):
        nearest = mp.nint(x * denominator)
        if abs(x * denominator - nearest) < mp.mpf(10) ** -30 and abs(nearest) < 10**6:
            return Fraction(int(nearest), denominator)
    return None


def staged_log_det(jacobian: StagedJacobian, operators: Operators) -> Function:
    """log |det| as a determinant of a matrix of symbols, for manifolds of few dimensions."""
    spec = operators.spec
    size = spec.point_size if spec.ambient_tangents else spec.dim
    if size > MAX_STAGED:
        raise UserError(
            f"the determinant of D Log is {size} x {size}; beyond {MAX_STAGED} x {MAX_STAGED} it is not expanded",
            spec.log.value.span,
            "give its closed form as `log_det:`; the audit will check it",
        )
    assignments = list(jacobian.function.assignments)

    def staged(name: str, matrix: sp.Matrix) -> sp.Matrix:
        def entry(i: int, j: int) -> sp.Expr:
            if matrix[i, j].is_number or matrix[i, j].is_Symbol:
                return matrix[i, j]
            symbol = sp.Symbol(f"{name}{i}_{j}", real=True)
            assignments.append(Assignment(symbol, matrix[i, j]))
            return symbol

        return sp.Matrix(*matrix.shape, entry)

    entries = staged("J", sp.Matrix(jacobian.entries))
    matrix, volume_ratio = _square_form(entries, operators, jacobian.function)
    written_out = staged("M", matrix).det(method="berkowitz")
    result = sp.log(sp.Abs(written_out)) + sp.log(volume_ratio) / 2
    return Function(
        "log_abs_det", jacobian.function.arguments, tuple(assignments), (result,), (), "log |det D Log_p(q)|, staged"
    )


def _square_form(jacobian: sp.Matrix, operators: Operators, function: Function) -> tuple[sp.Matrix, sp.Expr]:
    """A square matrix and a factor: |det D Log| = |det matrix| * sqrt(factor).

    With frames or in charts, D Log in components. With ambient tangents, the ambient matrix that agrees with D Log
    on T_q M and takes the normals at q to the normals at p.
    """
    p, q = (argument.symbols for argument in function.arguments)
    to_q = dict(zip(p, q, strict=True))
    metric_p, metric_q = operators.metric, operators.metric.xreplace(to_q)
    volume_ratio = _determinant(metric_p) / _determinant(metric_q)
    if not operators.spec.ambient_tangents:
        return jacobian * operators.frame.xreplace(to_q).T, volume_ratio
    constraint_q = operators.constraint_jacobian.xreplace(to_q)
    normals_p = operators.normals()
    normals_q = normals_p.xreplace(to_q)
    gram_p, gram_q = operators.constraint_jacobian * normals_p, constraint_q * normals_q
    lower = gram_q.inv(method="ADJ") * constraint_q
    matrix = jacobian * (sp.eye(operators.spec.point_size) - normals_q * lower) + normals_p * lower
    return matrix, volume_ratio * gram_q.det() / gram_p.det()


def _determinant(matrix: sp.Matrix) -> sp.Expr:
    """Of a metric: the product of the diagonal where that is all there is, for it reads and rounds better."""
    return sp.Mul(*matrix.diagonal()) if matrix.is_diagonal() else matrix.det(method="berkowitz")
