"""Sympy's reading of the file against CasADi's: a wrong derivation or a wrong lowering shows as a difference."""

from __future__ import annotations

import itertools
import random
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from rsrm_gen.compiler.audit.blame import span_of
from rsrm_gen.compiler.audit.report import Check
from rsrm_gen.compiler.audit.second_reading import read_again
from rsrm_gen.compiler.audit.worst import Worst, at
from rsrm_gen.compiler.derive import Geometry
from rsrm_gen.compiler.derive.sampling import sampler_of
from rsrm_gen.compiler.lower import Program, interpret

PAIRS = 12
TOLERANCE = 1e-9  # CasADi's reading is double precision and does not mend singularities: middling distances only
NAMES = {
    "exp": ("p", "v"),
    "log": ("p", "q"),
    "distance": ("p", "q"),
    "log_abs_det": ("p", "q"),
    "riemannian_gradient": ("p", "df"),
}


def check_readings(geometry: Geometry, program: Program) -> list[Check]:
    """One check a function."""
    reading = read_again(geometry.spec)
    sampler = sampler_of(geometry)
    rng = random.Random(5)
    pairs = [sampler.pair(rng) for _ in range(PAIRS)]
    places = [([float(c) for c in p], [float(c) for c in q]) for p, q in pairs]
    partials = np.random.default_rng(3).normal(size=geometry.spec.point_size)
    functions: dict[str, tuple[Callable[..., Any], Callable[..., Sequence[Any]]]] = {
        "exp": (reading.exp, lambda p, q: (p, np.asarray(reading.log(p, q)).ravel())),
        "log": (reading.log, lambda p, q: (p, q)),
        "distance": (reading.distance, lambda p, q: (p, q)),
        "log_abs_det": (reading.log_abs_det, lambda p, q: (p, q)),
        "riemannian_gradient": (reading.riemannian_gradient, lambda p, q: (p, partials)),
    }
    return [
        _compare(name, theirs, [inputs(p, q) for p, q in places], geometry, program)
        for name, (theirs, inputs) in functions.items()
    ]


def _compare(
    name: str, theirs: Callable[..., Any], inputs: list[Sequence[Any]], geometry: Geometry, program: Program
) -> Check:
    worst = Worst()
    for arguments in inputs:
        ours = np.array([float(x) for x in interpret(program[name], *arguments, digits=30)[0]])
        other = np.asarray(theirs(*arguments), dtype=float).ravel()
        error = float(np.max(np.abs(ours - other)) / (1 + np.max(np.abs(ours))))
        worst = worst.with_error(error, at(*itertools.chain(*zip(NAMES[name], arguments, strict=True))))
    promise = f"{name} is the same in both readings of the file, by sympy and by CasADi"
    span = span_of(geometry.spec, name)
    return Check(f"{name} second reading", promise, worst.error, TOLERANCE, worst.points, worst.where, span)
