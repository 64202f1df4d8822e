"""The splat split for sums is the splat: values, gradients and all derivatives in 60 digits, in every form it has."""

from __future__ import annotations

import random
from typing import Any

import mpmath as mp
import pytest
from compiled import NAMES, geometry, program

from rsrm_gen.compiler.derive import Geometry
from rsrm_gen.compiler.derive.numeric import largest, run
from rsrm_gen.compiler.derive.radial import ratio
from rsrm_gen.compiler.derive.sampling import sampler_of
from rsrm_gen.compiler.lower import Node, interpret
from rsrm_gen.compiler.lower.ir import reachable
from rsrm_gen.compiler.spec import ProductSpec

# Polynomials are exact to 2^-56 each; the second derivatives of those in the routines of a single splat, to some 1e-13.
TOLERANCE = mp.mpf(10) ** -12

CASES: list[tuple[str, dict[str, Any]]] = [
    *((name, {}) for name in NAMES),
    ("sphere", {"n": 5}),
    ("hyperbolic", {"n": 5, "curvature": -4}),
    ("torus", {"n": 6}),
]
REDUCED = {"sphere", "hyperbolic", "so3", "se3"}


class Place:
    """A point, a splat and adjoints of a manifold, all random."""

    def __init__(self, g: Geometry, seed: int, antipodal: bool = False) -> None:
        rng = random.Random(seed)
        self.mu, self.x = sampler_of(g).pair(rng)
        if antipodal:
            self.x = [-c for c in self.mu]
        if seed % 2:
            self.x = other_name(g, self.x)

        def draw(count: int) -> list[Any]:
            return [mp.mpf(rng.gauss(0, 1)) for _ in range(count)]

        self.W: list[Any] = []
        for _ in range(g.spec.dim):  # rows that are covectors of tangent vectors
            row = draw(g.spec.tangent_size)
            if g.spec.tangent_size == g.spec.point_size:
                row = run(g["flat"], self.mu, run(g["to_tangent"], self.mu, row)[0])[0]
            self.W += row
        self.amplitude, self.value_bar = draw(1), draw(1)
        self.gradient_bar = draw(g.spec.tangent_size)


def other_name(g: Geometry, x: list[Any]) -> list[Any]:
    """The same point by its other name, in every factor that has one."""
    if isinstance(g.spec, ProductSpec):
        known = {factor.spec.content_hash: factor for _, factor in g.factors}
        parts, start = [], 0
        for factor in g.spec.factors:
            parts += other_name(known[factor.spec.content_hash], x[start : start + factor.spec.point_size])
            start += factor.spec.point_size
        return parts
    return run(g["other_name"], x)[0] if "other_name" in g else x


def split(name: str, parameters: dict[str, Any], at: Place) -> dict[str, list[Any]]:
    """Value, gradient and derivatives by the routines of `pairs`."""
    pairs = program(name, **parameters).pairs
    own = at.mu, at.W, at.amplitude
    (X,), (S,) = interpret(pairs.features, at.x), interpret(pairs.constants, *own)
    value, slope = interpret(pairs.forward, X, S)
    assert interpret(pairs.value, X, S) == [value]
    (gradient,) = interpret(pairs.gradient, at.x, slope)
    (slope_bar,) = interpret(pairs.gradient_vjp, at.x, at.gradient_bar)
    (sums,) = interpret(pairs.backward, X, S, at.value_bar, slope_bar)
    mu_bar, W_bar, amplitude_bar = interpret(pairs.constants_vjp, *own, sums)
    return {"value": value, "gradient": gradient, "mu": mu_bar, "W": W_bar, "amplitude": amplitude_bar}


def whole(name: str, parameters: dict[str, Any], at: Place) -> dict[str, list[Any]]:
    """The same by the routines of a single splat."""
    p = program(name, **parameters)
    value, gradient = interpret(p["splat"], at.x, at.mu, at.W, at.amplitude)
    bars = interpret(p["splat_vjp"], at.x, at.mu, at.W, at.amplitude, at.value_bar, at.gradient_bar)
    return {"value": value, "gradient": gradient, **dict(zip(("mu", "W", "amplitude"), bars, strict=True))}


@pytest.mark.parametrize(("name", "parameters"), CASES)
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_split_splat_is_the_splat(name: str, parameters: dict[str, Any], seed: int) -> None:
    g = geometry(name, **parameters)
    at = Place(g, seed)
    found, expected = split(name, parameters, at), whole(name, parameters, at)
    for results in (found, expected):  # off the manifold, formulas may differ: what counts is the gradient on it
        results["mu"] = run(g["riemannian_gradient"], at.mu, results["mu"])[0]
    for key, truth in expected.items():
        with mp.workdps(60):
            error = largest(a - b for a, b in zip(found[key], truth, strict=True)) / largest(truth)
        assert error < TOLERANCE, f"{key}: {mp.nstr(error, 3)}"


@pytest.mark.parametrize("name", ["sphere"])
def test_policy_on_the_cut_locus_is_the_authors(name: str) -> None:
    at = Place(geometry(name), 3, antipodal=True)
    found, expected = split(name, {}, at), whole(name, {}, at)
    assert abs(found["value"][0] / expected["value"][0] - 1) < TOLERANCE
    assert all(c == 0 for c in found["gradient"])
    assert abs(found["amplitude"][0] / expected["amplitude"][0] - 1) < TOLERANCE


@pytest.mark.parametrize("name", NAMES)
def test_quadrics_of_constant_curvature_are_reduced_and_nothing_else(name: str) -> None:
    entries = [str(node.value) for node in program(name).pairs.forward.parameters[1].nodes]
    assert any(entry.endswith("R0_0") for entry in entries) == (name in REDUCED)


def test_the_function_of_the_reduced_form_continues_beyond_one() -> None:
    with mp.workdps(40):
        assert abs(ratio(mp.mpf("0.5")) - mp.pi / 3 / mp.sqrt(mp.mpf("0.75"))) < 1e-35
        assert abs(ratio(mp.mpf(2)) - mp.acosh(2) / mp.sqrt(3)) < 1e-35
        beside = mp.mpf(10) ** -12
        assert abs(ratio(1 + beside) + ratio(1 - beside) - 2) < 1e-20
        assert ratio(mp.mpf(1)) == 1


def test_a_split_does_not_repeat_for_pairs_what_belongs_to_one_side() -> None:
    pairs = program("spd").pairs
    assert sum(node.op == "eigh" for node in pairs.constants.nodes) == 1
    assert all(_reads(node, "x0") for node in pairs.forward.nodes if node.op == "eigh")


def _reads(node: Node, name: str) -> bool:
    return any(n.op == "input" and n.value == name for n in reachable([node]))
