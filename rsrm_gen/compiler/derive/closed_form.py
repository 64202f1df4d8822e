"""A closed form of |det D Log|: c * prod s_i^k_i over quantities s_i that Log computes, or that stand beside them.

On many manifolds the determinant is such a product, (t / |w|)^(n-1) on the sphere. Which quantities are tried follows
from the formulas of Log alone: the author's scalars, what the elementary functions are taken of and what their derivatives
divide by (1 + x^2 for asinh x), 1 +- s and 1 +- s^2, and the volume of the metric at either point. Exponents are
sought in double precision, found in 60 digits, and believed only when they hold to 40 digits at pairs of points that were
not used to find them. Of all products that hold, the one is taken that double precision computes best.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import mpmath as mp
import numpy as np
import sympy as sp

from rsrm_gen.compiler.budget import spend
from rsrm_gen.compiler.derive.determinant import StagedJacobian, Volumes, metric_determinant
from rsrm_gen.compiler.derive.geometry import Choose, Function
from rsrm_gen.compiler.derive.numeric import DIGITS, TINY, run, tape_of
from rsrm_gen.compiler.derive.operators import Operators
from rsrm_gen.compiler.derive.sampling import Sampler
from rsrm_gen.errors import UserError

FITTED, FRESH = 12, 6  # pairs of points at which exponents are found, and at which they are tried
MAX_FACTORS = 3
MAX_QUANTITIES = 80
MAX_PRODUCTS = 40  # that are looked at in 60 digits
FAR = (2, 3, 6, 10, 15, 20, 30)  # distances in the manifold's unit of length, where there is no cut locus

MIDDLE = tuple(mp.mpf(k) / 8 for k in range(1, 8))  # distances, of the injectivity radius

HALF = sp.Rational(1, 2)

# What the derivative of an elementary function of x divides by.
DERIVATIVE_FACTORS = {
    sp.asinh: lambda x: 1 + x**2,
    sp.acosh: lambda x: x**2 - 1,
    sp.atanh: lambda x: 1 - x**2,
    sp.acos: lambda x: 1 - x**2,
    sp.tan: lambda x: 1 + sp.tan(x) ** 2,
}


@dataclass(frozen=True)
class ClosedForm:
    """|det D Log| = constant * product of quantity^exponent."""

    constant: Fraction
    exponents: tuple[tuple[sp.Expr, Fraction], ...]

    def log(self) -> sp.Expr:
        """Its logarithm: the factors under one logarithm where their exponents are alike, or one twice the other."""
        exponentials = sp.Add(*(_exact(k) * s.exp for s, k in self.exponents if isinstance(s, sp.exp)))
        factors = [(s, k) for s, k in self.exponents if not isinstance(s, sp.exp)]
        if not factors:
            return exponentials + sp.log(_exact(self.constant))
        power = max(abs(k) for _, k in factors)
        alike = {k: _exact(k) for k in (Fraction(1), Fraction(1, 2))}
        together = [(s, k) for s, k in factors if abs(k) / power in alike]
        quotient = sp.Mul(*(s ** (alike[abs(k) / power] * (1 if k > 0 else -1)) for s, k in together))
        constant = _exact(self.constant)
        root = constant ** (1 / _exact(power))
        if root.is_Rational:  # log(t / (2 |s|)) is more exact than log(t / |s|) - log(2)
            quotient, constant = root * quotient, sp.Integer(1)
        apart = (_exact(k) * sp.log(s) for s, k in factors if abs(k) / power not in alike)
        return _exact(power) * sp.log(quotient) + sp.Add(*apart) + exponentials + sp.log(constant)


@dataclass(frozen=True)
class Samples:
    """Values of quantities: in 60 digits at pairs of points, and in both precisions at places near the ends of the manifold."""

    target: list[Any]  # log |det D Log| at each pair
    logs: list[list[Any]]  # of each quantity at each pair
    exact: list[list[Any]]  # of each quantity at each place
    rounded: Any  # (quantities, places): in double precision, of points rounded to it


def closed_form(
    jacobian: StagedJacobian, log: Function, scalars: Sequence[sp.Symbol], operators: Operators, sampler: Sampler
) -> ClosedForm | None:
    """The determinant as a product of powers of at most three quantities, if it is one."""
    rng = random.Random(2)
    volumes = Volumes(operators)
    pairs = [sampler.pair(rng) for _ in range(FITTED + FRESH)]
    target = [volumes.log_det(p, q, run(jacobian.function, p, q)[0]) for p, q in pairs]
    if not all(mp.isfinite(x) for x in target):
        raise UserError("D Log_p(q) is singular: Log does not tell points apart", operators.spec.log.value.span)
    if all(abs(x) < TINY for x in target):
        return ClosedForm(Fraction(1), ())
    places = list(_places(sampler, rng))
    tried = list(_quantities(log, scalars, operators))[:MAX_QUANTITIES]
    quantities, samples = _sampled(tried, log, pairs, places, target)
    quantities, samples = _independent(quantities, samples)
    found = [
        ClosedForm(constant, tuple((quantities[i], k) for i, k in zip(chosen, exponents, strict=True)))
        for chosen in _products(samples)[:MAX_PRODUCTS]
        for constant, exponents in _exponents(target, [samples.logs[i] for i in chosen])
    ]
    return min(found, key=_Rank(found, log, places)) if found else None


def _exact(x: Fraction) -> sp.Rational:
    return sp.Rational(x.numerator, x.denominator)


# Which quantities are tried.


def _quantities(log: Function, scalars: Sequence[sp.Symbol], operators: Operators) -> Iterator[sp.Expr]:
    """Candidates, each once, the simple ones first."""
    seen: set[sp.Expr] = set()
    plain = [*scalars, *_inside(log, scalars)]
    shifted = [e for s in plain for e in (1 + s**2, 1 - s**2, 1 + s, 1 - s)]
    p, q = (argument.symbols for argument in log.arguments)
    volume = metric_determinant(operators.metric)
    volumes = [volume, volume.xreplace(dict(zip(p, q, strict=True)))] if volume is not None else []
    for expression in [*plain, *volumes, *shifted]:
        if not expression.is_number and expression not in seen and -expression not in seen:
            seen.add(expression)
            yield expression


def _inside(log: Function, scalars: Sequence[sp.Symbol]) -> Iterator[sp.Expr]:
    """What elementary functions are taken of in the definitions of scalars, and what their derivatives divide by."""
    chosen = set(scalars)
    for assignment in log.assignments:
        if assignment.symbol not in chosen or assignment.expression.has(Choose):
            continue
        for part in sp.preorder_traversal(assignment.expression):
            if part.is_Function and len(part.args) == 1:
                yield part.args[0]
                if part.func in DERIVATIVE_FACTORS:
                    yield DERIVATIVE_FACTORS[part.func](part.args[0])
            elif part.is_Pow and part.exp == HALF:
                yield part.base
            elif isinstance(part, sp.atan2):
                yield sp.Add(*(x**2 for x in part.args))


# What they are at random pairs, and in double precision at the ends of the manifold.


def _places(sampler: Sampler, rng: random.Random) -> Iterator[tuple[list[Any], list[Any]]]:
    """Pairs of points in the middle, and near the cut locus or far away."""
    whole = sampler.reach * 2
    middle = [whole * fraction for fraction in MIDDLE]
    last = (
        [whole * (1 - mp.mpf(10) ** -k) for k in range(1, 10)] if sampler.bounded else [sampler.reach * r for r in FAR]
    )
    for r in middle + last:
        p, q = sampler.pair(rng, r)
        if all(sampler.inside([mp.mpf(float(c)) for c in x]) for x in (p, q)):  # far points may round out of a chart
            yield p, q


def _sampled(
    quantities: Sequence[sp.Expr], log: Function, pairs: Sequence[Any], places: Sequence[Any], target: list[Any]
) -> tuple[list[sp.Expr], Samples]:
    """Those quantities that vary and have one sign, which is made positive; and their values."""
    function = replace(log, results=tuple(quantities))
    at_pairs = [run(function, p, q)[0] for p, q in pairs]
    at_places = [run(function, p, q)[0] for p, q in places]
    rounded = in_double(function, places)
    kept, logs, exact, rows = [], [], [], []
    for i, expression in enumerate(quantities):
        values = [row[i] for row in at_pairs + at_places]
        sign = 1 if values[0] > 0 else -1
        if not all(mp.isfinite(x) and sign * x > TINY for x in values) or all(
            abs(x - values[0]) < TINY for x in values
        ):
            continue
        kept.append(sign * expression)
        with mp.workdps(DIGITS):
            logs.append([mp.log(sign * row[i]) for row in at_pairs])
            exact.append([sign * row[i] for row in at_places])
        rows.append(sign * rounded[i])
    return kept, Samples(target, logs, exact, np.array(rows))


def in_double(function: Function, places: Sequence[tuple[Sequence[Any], Sequence[Any]]]) -> Any:
    """The results of a function at rounded places in double precision: (results, places)."""
    tape, _, results = tape_of(function)
    columns = np.array([[float(c) for c in (*p, *q)] for p, q in places]).T
    slots = tape.run_in_double([np.full(len(places), 2.0**-52), *columns])
    return np.array([np.broadcast_to(slots[slot], len(places)) for slot in results])


def _independent(quantities: list[sp.Expr], samples: Samples) -> tuple[list[sp.Expr], Samples]:
    """One quantity of each kind, where powers of one another are of one kind: the one that double precision knows best."""
    if not quantities:
        return quantities, samples
    logs = np.array([[float(x) for x in row] for row in samples.logs])
    unit = _unit_columns(logs.T)
    digits = [_digits_lost(exact, rounded) for exact, rounded in zip(samples.exact, samples.rounded, strict=True)]
    kept: list[int] = []
    for i in range(len(quantities)):
        twin = next((k for k, j in enumerate(kept) if abs(abs(unit[:, i] @ unit[:, j]) - 1) < 1e-11), None)
        if twin is None:
            kept.append(i)
        elif digits[i] < digits[kept[twin]]:
            kept[twin] = i
    chosen = Samples(
        samples.target,
        [samples.logs[i] for i in kept],
        [samples.exact[i] for i in kept],
        samples.rounded[kept],
    )
    return [quantities[i] for i in kept], chosen


def _digits_lost(exact: Sequence[Any], rounded: Any) -> int:
    """Decimal digits that a quantity lacks in double precision at the worst place, beyond the first two."""
    worst = max((float(abs(float(b) / a - 1)) if np.isfinite(b) else 1.0) for a, b in zip(exact, rounded, strict=True))
    return max(0, round(float(np.log10(max(worst, 1e-16))) + 14))


# Which products of them are the determinant.


def _unit_columns(matrix: Any) -> Any:
    centred = matrix - matrix.mean(axis=0)
    return centred / np.maximum(np.linalg.norm(centred, axis=0), 1e-300)


def _products(samples: Samples) -> list[tuple[int, ...]]:
    """The sets of quantities by whose logarithms the target is explained in double precision, the small sets first."""
    if not samples.logs:
        return []
    columns = _unit_columns(np.array([[float(x) for x in row[:FITTED]] for row in samples.logs]).T)
    target = _unit_columns(np.array([[float(x)] for x in samples.target[:FITTED]]))[:, 0]
    hits: list[tuple[int, ...]] = []

    def extend(chosen: tuple[int, ...], rest: Any, others: Any, spanned: set[int]) -> None:
        spend()
        norms = np.linalg.norm(others, axis=0)
        usable = norms > 1e-5
        directions = others / np.where(usable, norms, 1)
        left = rest[:, None] - directions * (rest @ directions)
        explained = (np.linalg.norm(left, axis=0) < 1e-9) & usable
        start = chosen[-1] + 1 if chosen else 0
        hits.extend((*chosen, int(j)) for j in np.flatnonzero(explained) if j >= start)
        if len(chosen) + 1 == MAX_FACTORS:
            return
        alone = spanned | set(map(int, np.flatnonzero(explained)))
        for j in range(start, others.shape[1]):
            if usable[j] and j not in alone:
                e = directions[:, j]
                extend((*chosen, j), left[:, j], others - e[:, None] * (e @ others), alone)

    extend((), target, columns, set())
    return sorted((hit for hit in hits if not _is_redundant(hit, hits)), key=lambda hit: (len(hit), hit))


def _is_redundant(hit: tuple[int, ...], hits: Sequence[tuple[int, ...]]) -> bool:
    return any(len(other) < len(hit) and set(other) < set(hit) for other in hits)


def _exponents(target: Sequence[Any], logs: Sequence[Any]) -> Iterator[tuple[Fraction, list[Fraction]]]:
    """Rational exponents and a rational constant with target = log constant + sum of exponent * log, at all samples."""
    size = len(logs) + 1
    with mp.workdps(DIGITS):
        matrix = mp.matrix([[1, *(x[i] for x in logs)] for i in range(size)])
        try:
            solution = mp.lu_solve(matrix, mp.matrix(list(target[:size])))
        except ZeroDivisionError:
            return
        exponents = [k for k in (rational(solution[i]) for i in range(1, size)) if k]
        constant = rational(mp.exp(solution[0]))
        if len(exponents) < len(logs) or not constant:
            return
        for i, exact in enumerate(target):
            terms = (mp.mpf(k.numerator) / k.denominator * x[i] for k, x in zip(exponents, logs, strict=True))
            if abs(mp.fsum(terms) + mp.log(mp.mpf(constant.numerator) / constant.denominator) - exact) > TINY:
                return
    yield constant, exponents


def rational(x: Any) -> Fraction | None:
    """The simple fraction that x is to 30 digits, or None."""
    for denominator in (1, 2, 3, 4, 6, 8, 9, 16, 27, 32, 64):
        nearest = mp.nint(x * denominator)
        if abs(x * denominator - nearest) < mp.mpf(10) ** -30 and abs(nearest) < 10**6:
            return Fraction(int(nearest), denominator)
    return None


class _Rank:
    """Orders closed forms: by their error in double precision beside the best one's, then by how short they are."""

    def __init__(self, forms: Sequence[ClosedForm], log: Function, places: Sequence[Any]) -> None:
        function = replace(log, results=tuple(form.log() for form in forms))
        exact = np.array([[float(x) for x in run(function, p, q)[0]] for p, q in places]).T
        errors = np.abs(in_double(function, places) - exact)
        errors = np.where(np.isfinite(errors), errors, 1e300)
        floor = np.maximum(2.0**-53 * np.abs(exact).max(axis=0), 2.0**-60)  # what rounding the result costs
        ratios = np.log2((errors + floor) / (errors.min(axis=0) + floor))
        middle, last = ratios[:, : len(MIDDLE)], ratios[:, len(MIDDLE) :]
        worst = np.maximum(middle.mean(axis=1), last.mean(axis=1)) if last.size else middle.mean(axis=1)
        self.worst = {form: float(x) for form, x in zip(forms, worst, strict=True)}

    def __call__(self, form: ClosedForm) -> tuple[int, int, int, str]:
        """Bits lost, in pairs; factors; length."""
        text = str(form.log())
        return int(self.worst[form] / 2), len(form.exponents), len(text), text
