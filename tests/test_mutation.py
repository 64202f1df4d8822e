"""No small change to a formula passes the audit and changes what the manifold computes.

The formulas of the bundled manifolds are mutated as syntax trees: a number, a sign, an operator, a function, a name, an
index, a term. A mutant must be refused, by reading, deriving or auditing its formulas, or change no value by more than
1e-6. What is left is another manifold and no mistake: see `is_another_manifold`.

    pytest -m slow tests/test_mutation.py          every single mutant, and many of two changes
    python tests/test_mutation.py [NAME[:STEP] ...]    every (STEP-th) single mutant, as a table of what refuses them
"""

from __future__ import annotations

import random
import sys
import time
import traceback
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache
from typing import Any

import mpmath as mp
import pytest
import yaml
from compiled import MANIFOLDS
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rsrm_gen.compiler.audit.geodesics import is_straight
from rsrm_gen.compiler.audit.given import transport_checks
from rsrm_gen.compiler.audit.laws import DIGITS, Laws
from rsrm_gen.compiler.audit.readings import check_readings
from rsrm_gen.compiler.audit.report import Check
from rsrm_gen.compiler.derive import Geometry, derive, derive_as_written
from rsrm_gen.compiler.derive.numeric import largest
from rsrm_gen.compiler.derive.sampling import sampler_of
from rsrm_gen.compiler.lower import Program, interpret, lower
from rsrm_gen.compiler.spec import ManifoldSpec, read_spec
from rsrm_gen.compiler.spec import formula as f
from rsrm_gen.compiler.spec.unparse import written
from rsrm_gen.document import parse_document
from rsrm_gen.errors import Source, Span, UserError

SAME = 1e-6
PAIRS = 12
HERE = Span(Source("<mutant>", ""), 1, 1)
# The formulas of a file. Not among them: parameters and constants (another value is another manifold of the same kind),
# lengths that are stated and not computed with, and `sample`, which is judged by its code.
KEYS = ("metric", "exp", "log", "norm", "distance", "log_det", "transport", "frame")
WITHIN = {"embedded": ("constraint", "project", "domain", "equivalent"), "cut_locus": ("where", "log", "log_det")}
TWINS = (("sin", "cos"), ("sinh", "cosh"), ("sinc", "sinhc"), ("asinh", "atanh"), ("sin", "sinh"), ("cos", "cosh"),
         ("log", "exp"), ("sqrt", "abs"), ("max", "min"), ("acos", "acosh"), ("tan", "tanh"))  # fmt: skip
LETTERS = ("p", "q", "u", "v")

Path = tuple[str | int, ...]


@cache
def data_of(name: str) -> Any:
    return yaml.safe_load((MANIFOLDS / f"{name}.yaml").read_text())


NAMES = sorted(p.stem for p in MANIFOLDS.glob("*.yaml") if "exp" in yaml.safe_load(p.read_text()))


@dataclass(frozen=True)
class Mutant:
    """A bundled manifold with formulas replaced: each where it stands and as it reads now."""

    manifold: str
    changes: tuple[tuple[Path, str], ...]

    def text(self) -> str:
        data = yaml.safe_load((MANIFOLDS / f"{self.manifold}.yaml").read_text())
        for path, formula in self.changes:
            at = data
            for key in path[:-1]:
                at = at[key]
            at[path[-1]] = formula
        return str(yaml.safe_dump(data, sort_keys=False, width=10**6))

    def __str__(self) -> str:
        changes = (f"{'.'.join(map(str, path))}: {formula}" for path, formula in self.changes)
        return f"{self.manifold}: {'; '.join(changes)}"


def formulas(name: str) -> dict[Path, str]:
    """The formulas of a bundled file, by their paths in it."""
    data = data_of(name)
    sections: dict[Path, Any] = {(key,): data[key] for key in KEYS if key in data}
    for section, keys in WITHIN.items():
        sections |= {(section, key): data[section][key] for key in keys if key in data.get(section, {})}
    found: dict[Path, str] = {}
    for path, section in sections.items():
        if isinstance(section, dict):
            found |= {(*path, "let", key): str(text) for key, text in section.get("let", {}).items()}
            found[(*path, "value")] = str(section["value"])
        elif isinstance(section, list):
            found |= {(*path, i): str(text) for i, text in enumerate(section)}
        else:
            found[path] = str(section)
    return found


def single_mutants(name: str) -> list[Mutant]:
    """Every manifold that differs from a bundled one by one small change."""
    mutants = []
    for path, text in formulas(name).items():
        scope = [key for key in (*LETTERS, *_lets(name, path)) if key != path[-1]]
        seen = {text, written(f.parse(text, HERE))}
        for tree in mutations(f.parse(text, HERE), tuple(scope)):
            formula = written(tree)
            if formula not in seen:
                seen.add(formula)
                mutants.append(Mutant(name, ((path, formula),)))
    return mutants


def _lets(name: str, path: Path) -> list[str]:
    section = data_of(name).get(path[0])
    return list(section.get("let", {})) if isinstance(section, dict) else []


def mutations(tree: f.Tree, scope: tuple[str, ...]) -> Iterator[f.Tree]:
    """The tree with one change, at its root or in one of its branches."""
    yield from _at_root(tree, scope)
    match tree:
        case f.Negate():
            yield from (replace(tree, operand=x) for x in mutations(tree.operand, scope))
        case f.Binary("^"):
            yield from (replace(tree, left=x) for x in mutations(tree.left, scope))
            yield from (replace(tree, right=x) for x in mutations(tree.right, ()))
        case f.Binary() | f.Compare():
            yield from (replace(tree, left=x) for x in mutations(tree.left, scope))
            yield from (replace(tree, right=x) for x in mutations(tree.right, scope))
        case f.Call():
            for i, argument in enumerate(tree.arguments):
                for x in mutations(argument, scope):
                    yield replace(tree, arguments=(*tree.arguments[:i], x, *tree.arguments[i + 1 :]))
        case f.Stack() | f.Rows():
            for i, item in enumerate(tree.items):
                for x in mutations(item, scope):
                    yield replace(tree, items=(*tree.items[:i], x, *tree.items[i + 1 :]))
        case f.Index():
            yield from (replace(tree, base=x) for x in mutations(tree.base, scope))


def _at_root(tree: f.Tree, scope: tuple[str, ...]) -> Iterator[f.Tree]:
    one = f.Number(Fraction(1), HERE)
    match tree:
        case f.Number(value):
            for other in (value + 1, value - 1, value * 2, value / 2, value + Fraction(1, 1000)):
                yield replace(tree, value=other) if other >= 0 else f.Negate(replace(tree, value=-other), HERE)
        case f.Name(name):
            yield from (replace(tree, name=other) for other in scope if other != name)
            yield f.Negate(tree, HERE)
            yield f.Binary("*", f.Number(Fraction(1001, 1000), HERE), tree, HERE)
        case f.Negate():
            yield tree.operand
        case f.Binary(operator, left, right):
            yield left
            if operator == "^":
                return
            yield f.Negate(right, HERE) if operator == "-" else right
            yield from (replace(tree, operator=other) for other in "+-*/" if other != operator)
            if operator in "-/":
                yield replace(tree, left=right, right=left)
        case f.Call(function, arguments):
            for a, b in TWINS:
                if function in (a, b):
                    yield replace(tree, function=b if function == a else a)
            if len(arguments) == 1:
                yield arguments[0]
                yield f.Call("norm", (one, *arguments)[1:], HERE)
            if len(arguments) > 1:
                yield replace(tree, arguments=(*arguments[:-2], arguments[-1], arguments[-2]))
            if function == "where":
                yield from arguments[1:]
            yield f.Negate(tree, HERE)
        case f.Compare(operator):
            others = {"<": ">", "<=": ">=", ">": "<", ">=": "<=", "=": "<="}
            yield replace(tree, operator=others[operator])
        case f.Stack(items) | f.Rows(items):
            for i in range(len(items) - 1):
                yield replace(tree, items=(*items[:i], items[i + 1], items[i], *items[i + 2 :]))
        case f.Index(_, start, stop, is_slice):
            if not is_slice and isinstance(start, f.Number):
                yield replace(tree, start=replace(start, value=start.value + 1))
                yield replace(tree, start=replace(start, value=abs(start.value - 1)))
            if is_slice and start is not None:
                yield replace(
                    tree, start=stop and None, stop=f.Binary("-", stop, one, HERE) if stop else f.Negate(one, HERE)
                )


@dataclass(frozen=True)
class Values:
    """What a manifold computes at the sampled places of a bundled one."""

    exp: list[list[Any]]  # points
    log: list[Any]
    lengths: list[Any]  # inner products, distances, gradients, determinants: what the metric enters


@cache
def original(name: str) -> tuple[Laws, Values]:
    geometry = derive(read_spec(MANIFOLDS / f"{name}.yaml"))
    program = lower(geometry)
    return Laws(geometry, program), values(program, name)


@cache
def places(name: str) -> list[tuple[Any, Any, Any, Any, Any]]:
    """p, q, v, w tangent at p, and partial derivatives; points from close by to nearly the injectivity radius."""
    rng = random.Random(99)
    geometry = derive(read_spec(MANIFOLDS / f"{name}.yaml"))
    sampler = sampler_of(geometry)
    found = []
    for k in range(PAIRS):
        p, q = sampler.pair(rng, sampler.reach * mp.mpf(2 * k + 1) / PAIRS * mp.mpf("0.98"))
        v, w = sampler.direction(rng, p), sampler.direction(rng, p)
        found.append((p, q, [c * sampler.reach for c in v], w, sampler.gaussian(rng, geometry.spec.point_size)))
    return found


def values(program: Program, name: str) -> Values:
    def call(routine: str, *arguments: Any) -> list[Any]:
        return interpret(program[routine], *arguments, digits=30)[0]

    exp, log, lengths = [], [], []
    for p, q, v, w, df in places(name):
        exp.append(call("exp", p, v))
        log += call("log", p, q)
        lengths += [*call("inner", p, v, w), *call("distance", p, q), *call("log_abs_det", p, q)]
        lengths += call("riemannian_gradient", p, df)
        if any(routine.name == "transport" for routine in program):
            lengths += call("transport", p, q, w)
    return Values(exp, log, lengths)


def differs(a: list[Any], b: list[Any]) -> bool:
    return not (largest(x - y for x, y in zip(a, b, strict=True)) <= SAME * (1 + largest(b)))


def fate(mutant: Mutant) -> str:
    """What becomes of a mutant: who refuses it, `same` if it computes the same, or `HOLE`."""
    try:
        spec = read_spec(parse_document(mutant.text(), "mutant.yaml"))
    except UserError:
        return "unreadable"
    try:
        broken = next((check for check in checks(spec) if not check.passed), None)
    except UserError:
        return "underivable"
    if broken is not None:
        return broken.name
    geometry = derive(spec)
    return verdict(mutant, geometry, values(lower(geometry), mutant.manifold))


def checks(spec: ManifoldSpec) -> Iterator[Check]:
    """What the audit asks of formulas, the cheap first: of most mutants no determinant needs to be derived."""
    geometry = derive_as_written(spec)
    yield from Laws(geometry, lower(geometry), as_written=True).each()
    geometry = derive(spec)
    program = lower(geometry)
    laws = Laws(geometry, program)
    with mp.workdps(DIGITS):
        yield laws.exp_inverts_log()
        yield from (check for law in laws.laws_of_the_determinant() if (check := law()) is not None)
        yield laws.splat_gradient_is_its_derivative()
        yield from transport_checks(laws)
    yield from check_readings(geometry, program)


def verdict(mutant: Mutant, geometry: Geometry, found: Values) -> str:
    """Of a mutant that passes."""
    laws, expected = original(mutant.manifold)
    moved = largest(laws.apart(x, y) for x, y in zip(found.exp, expected.exp, strict=True))  # another name is no move
    maps_differ = not moved <= SAME or differs(found.log, expected.log)
    if not maps_differ and not differs(found.lengths, expected.lengths):
        return "same"
    return "another manifold" if not maps_differ and is_another_manifold(mutant, geometry) else "HOLE"


def is_another_manifold(mutant: Mutant, geometry: Geometry) -> bool:
    """Whether a mutant that passes is right as it stands: only its metric was changed, and the rest does not depend on it.

    Straight lines are geodesics of every constant metric, and a retraction is one for every metric: such a file
    describes Euclidean space in other axes, or another arm.
    """
    only_metric = all(path[0] == "metric" for path, _ in mutant.changes)
    unmeasured = geometry.spec.diameter is None  # which the metric would contradict
    return only_metric and unmeasured and (is_straight(geometry) or geometry.spec.maps == "retraction")


def pairs_of(first: Mutant, second: Mutant) -> Mutant:
    return Mutant(first.manifold, (first.changes + second.changes)[:2])


ONE = {name: single_mutants(name) for name in NAMES}
single = st.sampled_from([mutant for mutants in ONE.values() for mutant in mutants])
double = st.sampled_from(NAMES).flatmap(
    lambda name: st.builds(pairs_of, st.sampled_from(ONE[name]), st.sampled_from(ONE[name]))
)
QUIET = {"deadline": None, "database": None, "derandomize": True, "suppress_health_check": list(HealthCheck)}


@settings(max_examples=40, **QUIET)
@given(single)
def test_no_mutant_passes_that_changes_a_value(mutant: Mutant) -> None:
    assert fate(mutant) != "HOLE", str(mutant)


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_no_single_mutant_passes(name: str) -> None:
    holes = [str(mutant) for mutant in ONE[name] if fate(mutant) == "HOLE"]
    assert holes == []


@pytest.mark.slow
@settings(max_examples=400, **QUIET)
@given(double)
def test_no_double_mutant_passes(mutant: Mutant) -> None:
    assert fate(mutant) != "HOLE", str(mutant)


@pytest.mark.parametrize("name", NAMES)
def test_mutants_are_made_of_what_the_file_says(name: str) -> None:
    assert len(ONE[name]) > 10
    for text in formulas(name).values():  # trees are written as they read, so that only the change changes
        tree = f.parse(text, HERE)
        assert written(f.parse(written(tree), HERE)) == written(tree)
    assert fate(Mutant(name, ())) == "same"


def main(names: list[str]) -> int:
    """The table: how many single mutants of each manifold there are, and what becomes of them."""
    holes = 0
    for name, _, step in (argument.partition(":") for argument in names or NAMES):
        start, fates = time.process_time(), Counter()
        mutants = ONE[name][:: int(step or 1)]
        for mutant in mutants:
            began = time.process_time()
            try:
                found = fate(mutant)
            except Exception as error:
                found = f"CRASH {error!r}"
                traceback.print_exc(limit=-4)
            fates[found] += 1
            took = time.process_time() - began
            if found.split()[0] in ("HOLE", "CRASH") or took > 5:
                print(f"    {found} {mutant} ({took:.1f} s)", flush=True)
        holes += fates["HOLE"]
        refused = len(mutants) - fates["HOLE"] - fates["same"] - fates["another manifold"]
        print(
            f"{name}: {refused} of {len(mutants)} refused in {time.process_time() - start:.0f} s; {dict(fates.most_common())}"
        )
    return 1 if holes else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
