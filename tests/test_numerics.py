"""Values and derivatives of the generated code against closed forms and differences in 60 digits, on every kind of place.

The unit of an error is what rounding the inputs and the output costs (`sens` + eps |value|); 64 of them pass.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from typing import Any

import mpmath as mp
import numpy as np
import pytest
import torch
from closed_forms import CASES, ClosedForm, Point, plus, times
from compiled import call_batch, files, geometry, needs_compiler, program, shared_library, torch_module

from rsrm_gen.compiler.lower import interpret

DIGITS = 60
EPS = {"float64": 2.0**-53, "float32": 2.0**-24}
DTYPES = {"float64": torch.float64, "float32": torch.float32}


@pytest.fixture(autouse=True)
def _sixty_digits() -> Iterator[None]:
    with mp.workdps(DIGITS):
        yield


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Any:
    return tmp_path_factory.mktemp("numerics")


@dataclass(frozen=True)
class Rows:
    """Places as doubles that are numbers of the precision: p, q, and v from the one to the other."""

    p: np.ndarray
    q: np.ndarray
    v: np.ndarray
    kind: list[str]


@cache
def rows(case: str, precision: str) -> Rows:
    """Coincident, near, in the middle, and near the cut locus or far away."""
    with mp.workdps(DIGITS):
        form, rng = CASES[case], random.Random(31)
        whole = mp.mpf(form.cut or 2)
        lengths = [("near", mp.mpf(10) ** -k) for k in range(2, 13)] + [("middle", whole * k / 9) for k in range(1, 9)]
        if form.cut:
            lengths += [("cut", whole * (1 - mp.mpf(10) ** -k)) for k in range(1, 10 if precision == "float64" else 5)]
        else:
            lengths += [("far", mp.mpf(r)) for r in ((4, 8, 16, 30) if precision == "float64" else (4, 8))]
        kind, found = [], []
        for name, r in lengths:
            p = rounded(form.point(rng), precision)
            u = form.unit(rng, form.project(p))
            q = rounded(form.exp(form.project(p), times(r, u)), precision)
            kind.append(name)
            found.append((p, q, rounded(times(r, u), precision)))
            if name == "middle":
                kind.append("coincident")
                found.append((p, p, times(mp.mpf(0), u)))
        columns = (np.array([[float(c) for c in x] for x in column]) for column in zip(*found, strict=True))
        return Rows(*columns, kind)


def rounded(x: Point, precision: str) -> Point:
    return [mp.mpf(float(np.float32(float(c)) if precision == "float32" else float(c))) for c in x]


def torch_manifold(case: str, folder: Any) -> Any:
    form = CASES[case]
    identifier = geometry(form.name, **form.parameters).spec.identifier
    return torch_module(files(form.name, **form.parameters), identifier, folder).manifold


TRUTH: dict[str, Callable[[ClosedForm, Point, Point], Point]] = {
    "log": lambda form, p, q: form.log(form.project(p), form.project(q)),
    "distance": lambda form, p, q: [form.distance(form.project(p), form.project(q))],
    "log_abs_det": lambda form, p, q: [form.log_det(form.distance(form.project(p), form.project(q)))],
    "exp": lambda form, p, v: form.exp(form.project(p), v),
}


def largest(x: Any) -> float:
    return float(max((abs(c) for c in x), default=mp.mpf(0)))


def unit_and_truth(case: str, function: str, precision: str) -> tuple[np.ndarray, list[Point]]:
    form, at, rng = CASES[case], rows(case, precision), random.Random(32)
    units, truths = [], []
    for p, second in zip(at.p, at.v if function == "exp" else at.q, strict=True):
        given = [[mp.mpf(c) for c in x] for x in (p, second)]
        exact = TRUTH[function](form, *given)
        moved = 0.0
        for _ in range(4):
            shaken = [[c * (1 + EPS[precision] * rng.choice((-1, 1))) for c in x] for x in given]
            moved = max(moved, largest(a - b for a, b in zip(TRUTH[function](form, *shaken), exact, strict=True)))
        units.append(moved + 2 * EPS[precision] * largest(exact) + 1e-300)
        truths.append(exact)
    return np.array(units), truths


def check(found: np.ndarray, truths: list[Point], units: np.ndarray, kinds: list[str]) -> None:
    found = found.reshape(len(truths), -1)
    assert np.isfinite(found).all(), [kinds[i] for i in np.flatnonzero(~np.isfinite(found).all(axis=1))]
    errors = [
        largest(mp.mpf(float(a)) - b for a, b in zip(row, exact, strict=True))
        for row, exact in zip(found, truths, strict=True)
    ]
    ratio = np.array(errors) / units
    worst = int(np.argmax(ratio))
    assert ratio[worst] <= 64, f"row {worst} ({kinds[worst]}): {ratio[worst]:.3g} units"


@pytest.mark.parametrize("precision", EPS)
@pytest.mark.parametrize("function", TRUTH)
@pytest.mark.parametrize("case", CASES)
def test_torch_is_as_exact_as_its_inputs_allow(case: str, function: str, precision: str, folder: Any) -> None:
    at = rows(case, precision)
    second = at.v if function == "exp" else at.q
    arguments = (torch.from_numpy(x).to(DTYPES[precision]) for x in (at.p, second))
    units, truths = unit_and_truth(case, function, precision)
    check(getattr(torch_manifold(case, folder), function)(*arguments).double().numpy(), truths, units, at.kind)


@needs_compiler
@pytest.mark.parametrize("precision", EPS)
@pytest.mark.parametrize("case", CASES)
def test_c_is_as_exact_as_its_inputs_allow(case: str, precision: str, folder: Any) -> None:
    form, at = CASES[case], rows(case, precision)
    identifier = geometry(form.name, **form.parameters).spec.identifier
    library = shared_library(files(form.name, **form.parameters), identifier, folder)
    dtype = np.float32 if precision == "float32" else np.float64
    for function in TRUTH:
        second = at.v if function == "exp" else at.q
        routine = program(form.name, **form.parameters)[function]
        (found,) = call_batch(library, identifier, routine, at.p, second, dtype=dtype)
        units, truths = unit_and_truth(case, function, precision)
        check(found.astype(np.float64), truths, units, at.kind)


# Derivatives.

SCALARS: dict[str, Callable[[Any, torch.Tensor, torch.Tensor], torch.Tensor]] = {
    "log": lambda m, p, q: m.log(p, q),
    "exp": lambda m, p, v: m.exp(p, v),
    "squared distance": lambda m, p, q: m.distance(p, q)[..., None] ** 2,
    "log_abs_det": lambda m, p, q: m.log_abs_det(p, q)[..., None],
    "splat": lambda m, p, q: m.splat(q, p, *splat_parameters(m, p))[0][..., None],
}


def splat_parameters(m: Any, p: torch.Tensor) -> tuple[torch.Tensor, torch.Tensor]:
    W = torch.from_numpy(splat_matrix(m.dim, m.tangent_size)).to(p)
    return W.expand(*p.shape[:-1], m.dim, m.tangent_size), torch.ones(p.shape[:-1], dtype=p.dtype)


def splat_matrix(dim: int, tangent_size: int) -> np.ndarray:
    return np.round(np.random.default_rng(33).normal(size=(dim, tangent_size)) * 8) / 16


def interpreted(case: str, function: str, p: Point, second: Point) -> Point:
    form = CASES[case]
    made = program(form.name, **form.parameters)
    if function == "splat":
        spec = geometry(form.name, **form.parameters).spec
        W = splat_matrix(spec.dim, spec.tangent_size).ravel()
        return interpret(made["splat"], second, p, W.tolist(), [1], digits=DIGITS)[0]
    if function == "squared distance":
        return [interpret(made["distance"], p, second, digits=DIGITS)[0][0] ** 2]
    return interpret(made[function], p, second, digits=DIGITS)[0]


def directions(size: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Two directions in which inputs move, and the weights of the results: numbers of few digits."""
    rng = np.random.default_rng(34)
    return tuple(np.round(rng.normal(size=size) * 8) / 8 for _ in range(3))  # type: ignore[return-value]


def differences(case: str, function: str, p: Point, second: Point) -> tuple[Any, Any]:
    """The first derivative along one direction and the second along two, of the weighted sum of the results."""
    h, size = mp.mpf(10) ** -14, len(p)
    d, e, _ = directions(len(p) + len(second))

    def at(s: int, t: int) -> Any:
        moved = plus([*p, *second], plus(times(s * h, [mp.mpf(x) for x in d]), times(t * h, [mp.mpf(x) for x in e])))
        result = interpreted(case, function, moved[:size], moved[size:])
        weights = directions(len(result))[2]
        return mp.fsum(w * r for w, r in zip(weights, result, strict=True))

    first = (at(1, 0) - at(-1, 0)) / (2 * h)
    return first, (at(1, 1) - at(1, -1) - at(-1, 1) + at(-1, -1)) / (4 * h * h)


def by_autograd(manifold: Any, function: str, p: np.ndarray, second: np.ndarray, dtype: torch.dtype) -> np.ndarray:
    """The same two numbers for every row: (rows, 2)."""
    size = p.shape[1]
    z = torch.from_numpy(np.concatenate([p, second], 1)).to(dtype).requires_grad_()
    d, e, _ = (torch.from_numpy(x).to(dtype) for x in directions(z.shape[1]))
    result = SCALARS[function](manifold, z[:, :size], z[:, size:])
    weights = torch.from_numpy(directions(result.shape[1])[2]).to(dtype)
    if not result.requires_grad:
        return np.zeros((len(p), 2))
    (slope,) = torch.autograd.grad((result * weights).sum(), z, create_graph=True)
    first = (slope * d).sum(-1)
    if not first.requires_grad:
        return np.stack([first.double().numpy(), np.zeros(len(p))], 1)
    (bend,) = torch.autograd.grad(first.sum(), z)
    return np.stack([first.detach().double().numpy(), (bend * e).sum(-1).double().numpy()], 1)
