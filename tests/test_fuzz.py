"""Whatever stands in a file: it is read and derived, or refused with a `UserError`. No other exception, and no hang.

Derandomised: the same examples each time.
"""

from __future__ import annotations

import signal
import string
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from rsrm_gen.compiler.budget import limited
from rsrm_gen.compiler.derive import derive
from rsrm_gen.compiler.spec import read_spec
from rsrm_gen.compiler.spec.vocabulary import CONSTANTS, WORDS
from rsrm_gen.document import parse_document
from rsrm_gen.errors import UserError

MANIFOLDS = Path(__file__).parent.parent / "manifolds"
NAMES = ("euclidean", "sphere", "torus", "hyperbolic", "so3")
TEXTS = [(MANIFOLDS / f"{name}.yaml").read_text(encoding="utf-8") for name in NAMES]
LINES = sorted({line for text in TEXTS for line in text.splitlines()})
SECONDS = 8  # of the processor, far more than any example takes
BUDGET = 0.3  # of the processor, for a derivation


def fuzz(examples: int) -> settings:
    return settings(
        derandomize=True, database=None, deadline=None, max_examples=examples, suppress_health_check=list(HealthCheck)
    )


@contextmanager
def within_seconds(seconds: int = SECONDS) -> Iterator[None]:
    """What hangs fails here instead."""

    def stop(*_: object) -> None:
        raise TimeoutError(f"this took longer than {seconds} seconds")

    before = signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


def survives(text: str, derived: bool = False) -> bool:
    """Whether a text is a manifold; anything but an answer or a `UserError` is raised."""
    with within_seconds():
        try:
            with limited("read", BUDGET):
                spec = read_spec(parse_document(text, "file.yaml"))
            if derived:
                with limited("derive", BUDGET, 20_000):
                    derive(spec)
        except UserError as error:
            said = str(error)
        else:
            return True
    assert said.startswith(("file.yaml", "error: "))
    assert "\x1b" not in said
    return False


def flat(exp: str = "p + v", metric: str = "dot(u, v)", lets: str = "", domain: str = "p[0] < 9") -> str:
    return (
        f'manifold: m\ndoc: d\nparameters: {{n: 3}}\nchart:\n  space: R^3\n  domain: "{domain}"\n'
        f'metric: "{metric}"\nexp:\n  let: {{{lets}}}\n  value: "{exp}"\nlog: q - p\ninjectivity_radius: infinity\n'
    )


def test_the_files_that_are_changed_here_are_manifolds() -> None:
    assert all(survives(text) for text in TEXTS)
    assert survives(flat(), derived=True)


@fuzz(120)
@given(st.text(max_size=300))
@example("\x00")
@example("\ufeffmanifold: m")
@example("? [a]\n: b")
@example("!!python/object/apply:os.system [ls]")
@example("a: &a [*a]")
@example("%YAML 9.9\n---\na: 1")
@example("1:1:1:1: 1_0")
@example("- - - - -")
@example("a: !!int 'x'")
@example("a: !!float '.'")
@example("a: 0x_")
@example("a: =")
@example("<<: {a: b}")
@example("\U0001f600: \u2028 \x85 x")
def test_any_text_is_answered(text: str) -> None:
    survives(text)


def mutated(text: str, edits: list[tuple[int, int, str, str]]) -> str:
    """Bytes changed, lines left out, repeated or taken from another file, tokens put in."""
    for kind, at, token, line in edits:
        lines = text.split("\n")
        i, place = at % len(lines), at % (len(text) + 1)
        if kind == 0:
            text = (
                text[:place] + chr((ord(text[place : place + 1] or " ") ^ (1 << at % 7)) % 0x110000) + text[place + 1 :]
            )
        elif kind == 1:
            text = "\n".join(lines[:i] + lines[i + 1 :])
        elif kind == 2:
            text = "\n".join([*lines[:i], lines[i], *lines[i:]])
        elif kind == 3:
            text = text[:place] + token + text[place:]
        elif kind == 4:
            text = text[:place] + text[place + 1 + at % 5 :]
        else:
            text = "\n".join([*lines[:i], line, *lines[i + 1 :]])
    return text


TOKENS = st.sampled_from(
    [*WORDS, *CONSTANTS, *"pquvn0123456789+-*/^()[]{},:<>=\"'&!|%@#\t\u2212\u0440\u00a0", "**", "1e9", "[0]", "^64"]
)
EDITS = st.lists(
    st.tuples(st.integers(0, 5), st.integers(0, 5000), TOKENS, st.sampled_from(LINES)), min_size=1, max_size=4
)


@fuzz(200)
@given(st.sampled_from(TEXTS), EDITS)
def test_any_change_of_a_manifold_is_answered(text: str, edits: list[tuple[int, int, str, str]]) -> None:
    survives(mutated(text, edits))


@fuzz(15)
@given(st.sampled_from(TEXTS[:3]), EDITS)
def test_any_change_of_a_manifold_that_can_be_read_is_derived_or_refused(
    text: str, edits: list[tuple[int, int, str, str]]
) -> None:
    survives(mutated(text, edits), derived=True)


ATOMS = st.sampled_from(
    ["p", "v", "p[0]", "v[1:]", "n", "pi", "eps", "0", "1", "2", "1/3", "-1", "1e300", "[1, 2, 3]", "outer(p, v)"]
)


def compound(inner: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    calls = st.tuples(st.sampled_from(sorted(WORDS)), st.lists(inner, min_size=1, max_size=3))
    return st.one_of(
        calls.map(lambda parts: f"{parts[0]}({', '.join(parts[1])})"),
        st.tuples(inner, st.sampled_from("+-*/^"), inner).map(lambda parts: "({} {} {})".format(*parts)),
        st.lists(inner, min_size=1, max_size=3).map(lambda items: f"[{', '.join(items)}]"),
        inner.map(lambda x: f"{x}[0]"),
        inner.map(lambda x: f"-{x}"),
        st.tuples(inner, inner, inner).map(lambda parts: "where({} < {}, {}, v)".format(*parts)),
    )


FORMULAS = st.recursive(ATOMS, compound, max_leaves=8)


@fuzz(200)
@given(FORMULAS)
def test_any_formula_is_read_or_refused(formula: str) -> None:
    survives(flat(f"p + {formula}"))


FITTING = st.sampled_from(
    [
        "v",
        "p",
        "v * p[0]",
        "cross(p, v)",
        "orthogonal(v)",
        "p / norm(v)",
        "wrap(v)",
        "exp(p)",
        "log(p)",
        "sqrt(-p)",
        "acos(v)",
        "sinc(v)",
        "v * norm(v)",
        "sign(v) * 2^64",
        "inv(outer(v, v)) * p",
        "where(v[0] < 0, p, v)",
        "conj([1, v])[1:]",
    ]
)
SCALARS = st.sampled_from(
    [
        "1",
        "0",
        "n",
        "eps",
        "norm(v)",
        "p[0]",
        "det(outer(p, v))",
        "max(p)",
        "exp(exp(exp(p[0])))",
        "1/p[1]",
        "log(-1 - p[0]^2)",
        "atan2(p[0], v[0])",
        "p[2]^64",
        "(1 - 1)",
    ]
)


@fuzz(20)
@given(st.lists(st.tuples(FITTING, SCALARS), min_size=1, max_size=2), SCALARS)
def test_any_exp_of_the_right_shape_is_derived_or_refused(terms: list[tuple[str, str]], factor: str) -> None:
    total = " + ".join(f"({scalar}) * ({vector})" for vector, scalar in terms)
    survives(flat(f"p + ({factor}) * ({total})"), derived=True)


@fuzz(12)
@given(SCALARS, SCALARS)
def test_any_metric_and_domain_is_derived_or_refused(factor: str, bound: str) -> None:
    in_p = [x.replace("v", "p") for x in (factor, bound)]
    survives(flat(metric=f"dot(u, v) + ({in_p[0]}) * u[0] * v[0]", domain=f"p[0] < 9 + {in_p[1]}"), derived=True)


def lets(pattern: str, count: int) -> str:
    """Names that stand on one another: a1 of a0, a2 of a1, ..."""
    return 'a0: "p[0]", ' + ", ".join(f'a{i + 1}: "{pattern.format(f"a{i}")}"' for i in range(count))


HUGE = {
    "characters": flat("p" + " " * 10**6),
    "characters in a formula": flat("p" + "+v" * 50_000),
    "digits": flat("9" * 100_000 + " * v"),
    "brackets": flat("[" * 100_000),
    "closed brackets": flat("(" * 50_000 + "p" + ")" * 50_000),
    "indices": flat("p" + "[0]" * 30_000),
    "yaml lists": "a: " + "[" * 100_000,
    "yaml mappings": "a: " + "{a: " * 20_000,
    "yaml indentation": "\n".join(" " * i + "a:" for i in range(500)),
    "yaml aliases": "a0: &a0 [x]\n" + "".join(f"a{i + 1}: &a{i + 1} [*a{i}, *a{i}]\n" for i in range(60)),
    "yaml merges": "a0: &a0 {x: y}\n" + "".join(f"a{i + 1}: &a{i + 1} {{<<: [*a{i}, *a{i}]}}\n" for i in range(60)),
    "yaml keys": "".join(f"{c}{i}: 1\n" for i in range(1500) for c in string.ascii_lowercase[:4]),
    "hexadecimal": flat().replace("{n: 3}", "{n: 0x" + "f" * 100_000 + "}"),
    "sexagesimal": flat().replace("{n: 3}", "{n: 1" + ":59" * 30_000 + "}"),
    "binary": flat().replace("{n: 3}", "{n: 0b" + "1" * 100_000 + "}"),
    "octal": flat().replace("{n: 3}", "{n: 0" + "7" * 100_000 + "}"),
    "exponent": flat("p + 1e999999999999 * v"),
    "exponents": flat("p + 2^10^10^10 * v"),
    "exponents of exponents": flat("p + ((((3^64)^64)^64)^64)^64 * v"),
    "exponents of names": flat("p + (((((2*p[0])^64)^64)^64)^64)^64 * v"),
    "exponentials": flat("p + exp(exp(exp(exp(exp(9))))) * v"),
    "exponentials of names": flat("p + exp(exp(exp(exp(exp(p[0]))))) * v"),
    "sines": flat("p + sin(exp(exp(exp(exp(p[0]))))) * v"),
    "exponentials of logarithms": flat("p + exp(1e300 * log(2)) * v"),
    "radicals": flat("p + abs(sqrt(5 + 2 * sqrt(6)) - sqrt(2) - sqrt(3)) * v"),
    "heights": flat("(" * 30 + "p" + ("+v" * 30 + ")") * 30),
    "lets that double": flat("p + a60 * v", lets=lets("({0} + 1) * ({0} + 2)", 60)),
    "lets that branch": flat("p + a40 * v", lets=lets("where({0} < 1, sqrt({0}), 1 / {0})", 40)),
    "lets in a row": flat("p + a2000 * v", lets=lets("sin({0})", 2000)),
    "matrices": flat(" * ".join(["outer(p, v)"] * 30) + " * v"),
    "matrices of lets": flat("A12 * v", lets='A0: "outer(p, v)", ' + ", ".join(f'A{i + 1}: "A{i} * A{i}"' for i in range(12))),
    "determinants": flat().replace("R^3", "R^16").replace("q - p", "det(outer(p, q) + outer(q, q)) * (q - p)"),
    "inverses": flat("inv(inv(inv(outer(p, v) + outer(v, v)))) * v"),
    "largest entries": flat("p + max([max(p), max(v), max(p) * v] * max(p * max(v))) * v"),
    "metrics that double": flat(metric="dot(u, v) + u[0] * v[0] * (" + " * ".join(["(1 + p[0] + p[1])^64"] * 20) + ")"),
}  # fmt: skip


@pytest.mark.parametrize("case", HUGE)
def test_what_is_huge_is_refused_and_not_worked_on(case: str) -> None:
    survives(HUGE[case], derived=True)
