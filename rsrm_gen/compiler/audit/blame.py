"""Which formula is to blame when a law is broken.

A law that fails accuses every formula that it uses, and a law that holds speaks for those that it uses. One mistake is
what people make: the culprit is a formula that all broken laws use, as far as there is one; of several, the one with the
fewest kept promises.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

from rsrm_gen.compiler.audit.report import Check
from rsrm_gen.compiler.spec import ManifoldSpec, Map, ProductSpec, Spec
from rsrm_gen.errors import Span

# What the promise of each check is made of; a formula that the file does not give stands for those it is derived from.
USES: dict[str, tuple[str, ...]] = {
    "norm": ("norm", "metric"),
    "metric": ("metric", "norm"),
    "projection": ("project", "constraint"),
    "frame": ("frame", "constraint"),
    "exp on manifold": ("exp", "constraint"),
    "first order": ("exp", "frame"),
    "speed": ("exp", "metric", "frame"),
    "geodesic": ("exp", "metric", "frame"),
    "log tangent": ("log", "constraint"),
    "exp(log)": ("log", "exp"),
    "log(exp)": ("log", "exp", "injectivity_radius", "metric", "norm"),
    "exp(log) anywhere": ("log", "exp", "equivalent", "periods"),
    "quotient": ("equivalent", "log"),
    "period": ("periods", "log"),
    "cut locus": ("cut_log", "injectivity_radius", "metric", "norm"),
    "cut locus place": ("cut_locus", "injectivity_radius", "log"),
    "cut locus log det": ("cut_log_det",),
    "distance": ("distance", "log", "metric", "norm"),
    "symmetry": ("distance",),
    "eikonal": ("distance", "metric", "frame", "norm"),
    "gauss": ("distance", "log", "metric", "frame"),
    "triangle": ("distance",),
    "diameter": ("diameter", "log", "metric", "norm"),
    "log det": ("log_det", "log", "metric", "frame", "exp"),
    "splat gradient": ("metric", "exp", "frame"),
}
# Where nothing else decides: what is easily written wrong and needed by little comes first.
ORDER = (
    "log_det", "cut_log_det", "cut_log", "distance", "norm", "diameter", "cut_locus", "injectivity_radius", "equivalent",
    "periods", "project", "frame", "log", "exp", "metric", "constraint",
)  # fmt: skip

# The law that speaks most plainly of a formula; of others, the first that is broken.
OWN = {
    "equivalent": "quotient",
    "periods": "period",
    "cut_locus": "cut locus place",
    "distance": "distance",
    "diameter": "diameter",
    "log_det": "log det",
}


@dataclass(frozen=True)
class Verdict:
    """The formula to blame, and why."""

    formula: str
    reason: str


def blamed(checks: Sequence[Check], spec: ManifoldSpec, is_flow: Callable[[], bool]) -> list[Check]:
    """The checks, the failed one that speaks most plainly before the others, pointing to the culprit and saying why.

    `is_flow` tells whether Exp continues itself; it is asked only where Exp and the metric accuse one another.
    """
    failed = [check for check in checks if not check.passed]
    if not failed:
        return list(checks)
    verdict = judge(failed, [check for check in checks if check.passed], spec, is_flow)
    chosen = next((c for c in failed if c.name == OWN.get(verdict.formula)), None)
    chosen = chosen or next((c for c in failed if verdict.formula in _uses(c, spec)), failed[0])
    hints = [verdict.reason, chosen.hint, *(check.hint for check in failed if check.hint != chosen.hint)]
    span = _span(spec, verdict.formula) or chosen.span
    accused = replace(chosen, span=span, hint="; ".join([hint for hint in hints if hint][:3]))
    place = checks.index(failed[0])
    return [*checks[:place], accused, *(check for check in checks[place:] if check is not chosen)]


def judge(failed: Sequence[Check], passed: Sequence[Check], spec: ManifoldSpec, is_flow: Callable[[], bool]) -> Verdict:
    """The most likely culprit."""
    suspects = list(_uses(failed[0], spec))
    for check in failed[1:]:
        suspects = [s for s in suspects if s in _uses(check, spec)] or suspects
    if all(check.name != "cut locus place" for check in failed):  # it changes Log only where it should
        suspects = [s for s in suspects if s != "cut_locus"] or suspects
    if failed[0].name in ("speed", "geodesic"):  # what comes before them holds: Exp starts as it should
        return _exp_or_metric(suspects, failed, passed, spec, is_flow)
    return _least_vouched_for(suspects, failed, passed, spec)


def _least_vouched_for(
    suspects: Sequence[str], failed: Sequence[Check], passed: Sequence[Check], spec: ManifoldSpec
) -> Verdict:
    kept = {s: [check.name for check in passed if s in _uses(check, spec)] for s in suspects}
    formula = min(suspects, key=lambda s: (len(kept[s]), ORDER.index(s)))
    broken = [check.name for check in failed if formula in _uses(check, spec)]
    without = [check.name for check in passed if formula not in _uses(check, spec)]
    reason = f"look at `{SPELLING.get(formula, formula)}`: what is broken uses it ({', '.join(broken[:4])})"
    return Verdict(formula, reason + (f", and what does not is kept ({', '.join(without[:4])})" if without else ""))


def _exp_or_metric(
    suspects: Sequence[str],
    failed: Sequence[Check],
    passed: Sequence[Check],
    spec: ManifoldSpec,
    is_flow: Callable[[], bool],
) -> Verdict:
    """Exp is no geodesic of the metric: whose fault it is, Exp itself can tell."""
    if not {"exp", "metric"} & set(suspects):
        return _least_vouched_for(suspects, failed, passed, spec)
    if is_flow():
        text = "look at `metric`: Exp continues itself, so its curves are geodesics, but not of this metric"
        meant = "" if spec.embedded else "; if a retraction is meant, say so: `maps: retraction`"
        return Verdict("metric", text + meant)
    text = (
        "look at `exp`: a geodesic continues itself, out of any later point with its velocity there, and this does not; "
        "if a retraction is meant, say so: `maps: retraction`"
    )
    return Verdict("exp", text)


SPELLING = {
    "cut_log": "cut_locus: log",
    "cut_log_det": "cut_locus: log_det",
    "cut_locus": "cut_locus: where",
    "periods": "period",
}


def _uses(check: Check, spec: ManifoldSpec) -> tuple[str, ...]:
    """The formulas of the file in a check: the length of Log stands for a distance, sqrt(<v, v>) for a norm."""
    given = []
    for name in USES.get(check.name, ()):
        derived = {"distance": ("log", "metric", "norm"), "log_det": ("log",)}.get(name, ())
        given += [name] if _span(spec, name) else [d for d in derived if _span(spec, d)]
    if "log" in given and spec.cut_locus is not None and spec.cut_locus.log is not None:
        given.append("cut_locus")  # says where Log is another
    return tuple(dict.fromkeys(given)) or ("log", "exp", "metric")


def map_of(spec: ManifoldSpec, function: str) -> Map:
    """The map of the file that one of exp, log, distance and log_abs_det is computed by."""
    given = {"exp": spec.exp, "distance": spec.distance, "log_abs_det": spec.log_det}.get(function)
    return given or spec.log


def span_of(spec: Spec, function: str) -> Span:
    """The formula that a derived function is made of first; of a product, its section."""
    if isinstance(spec, ProductSpec):
        return spec.section.value.span
    named = {"log_abs_det": "log_det", "riemannian_gradient": "metric", "gradient_norm": "metric", "inner": "metric"}
    formula = {"flat": "metric", "to_tangent": "frame", "norm": "norm", **named}.get(function, function)
    fallback = "metric" if formula == "norm" else "constraint" if function == "to_tangent" else "log"
    return _span(spec, formula) or _span(spec, fallback) or spec.metric.value.span


def _span(spec: ManifoldSpec, formula: str) -> Span | None:
    """Where a formula stands in the file; None if it is not given."""
    cut = spec.cut_locus
    found: Any = {
        "cut_locus": cut and cut.where,
        "cut_log": cut and cut.log,
        "cut_log_det": cut and cut.log_det,
        "periods": next(filter(None, spec.periods or ()), None),
    }.get(formula, getattr(spec, formula, None))
    return found.value.span if found is not None else None
