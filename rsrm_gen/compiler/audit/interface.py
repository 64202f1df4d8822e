"""What generated code offers beside its formulas: constants, frames, sums of splats in torch, samples of a ball."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from typing import Any

import numpy as np
import torch

from rsrm_gen.compiler.audit.numbers import PRECISIONS, Code, Rows
from rsrm_gen.compiler.audit.report import Check
from rsrm_gen.compiler.derive import Geometry
from rsrm_gen.compiler.derive.numeric import value
from rsrm_gen.compiler.derive.sampling import reach_of
from rsrm_gen.compiler.lower import Program, interpret
from rsrm_gen.compiler.native import EXACT, compiled, compiler, pointer

EXACTLY = 1e-12
TOLERANCE = {"float64": 1e-9, "float32": 1e-2}
BALL, DEVIATIONS = 4000, 5.0


def check_interface(code: Code) -> list[Check]:
    """The parts of the code that are not made of formulas of the file."""
    geometry, program, files, manifold, rows = code.geometry, code.program, code.files, code.manifold, code.middling
    checks = [_constants(geometry, program, files, manifold)]
    checks += [_frames(program, "torch", p, rows[p], _torch_frames(manifold, rows[p], p)) for p in PRECISIONS]
    if compiler() is not None:
        checks += [
            _frames(program, "C", p, rows[p], _native_frames(geometry, program, files, rows[p], p)) for p in PRECISIONS
        ]
    checks.append(_torch_sums(manifold, rows["float64"]))
    if all(check.passed for check in checks):  # thinning by a wrong frame could take for ever
        checks.append(_ball(geometry, manifold, rows["float64"]))
    return checks


def _constants(geometry: Geometry, program: Program, files: Mapping[str, str], manifold: Any) -> Check:
    """The attributes of the torch class and the macros of the header."""
    spec = geometry.spec
    lengths = {"injectivity_radius": geometry.injectivity_radius, "diameter": geometry.diameter}
    expected = {name: float(value(x, {})) if x.is_finite else math.inf for name, x in lengths.items()}
    expected |= {"dim": spec.dim, "point_size": spec.point_size, "tangent_size": spec.tangent_size}
    header = dict(re.findall(rf"#define {program.name.upper()}_(\w+) (\S+)", files[f"{program.name}.h"]))
    macros = {name: math.inf if text == "HUGE_VAL" else _number(text) for name, text in header.items()}
    wrong = [name for name, x in expected.items() if not getattr(manifold, name, None) == x == macros.get(name.upper())]
    periods = geometry.periods and tuple(None if p is None else float(value(p, {})) for p in geometry.periods)
    wrong += [name for name, x in {"periods": periods, "maps": spec.maps}.items() if getattr(manifold, name, None) != x]
    promise = "the constants of the code are those of the manifold"
    return Check(
        "constants", promise, float(len(wrong)), 0.0, len(expected) + 2, f"(in {', '.join(wrong)})" if wrong else ""
    )


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return math.nan


def _frames(program: Program, backend: str, precision: str, rows: Rows, frames: Any) -> Check:
    """<e_i, e_j> = delta_ij, in high precision."""
    worst = 0.0
    for p, frame in zip(rows.p, frames, strict=True):
        at = [float(c) for c in p]
        vectors = [[float(c) for c in e] for e in frame]
        for i, a in enumerate(vectors):
            for j, b in enumerate(vectors[: i + 1]):
                error = abs(float(interpret(program["inner"], at, a, b)[0][0]) - (i == j))
                worst = error if not error <= worst else worst
    promise = f"`frame` of the {backend} code in {precision} is orthonormal in the metric"
    return Check(f"frame {backend} {precision}", promise, worst, TOLERANCE[precision], len(rows.p))


def _torch_frames(manifold: Any, rows: Rows, precision: str) -> Any:
    return manifold.frame(torch.as_tensor(rows.p, dtype=PRECISIONS[precision][1])).numpy()


def _native_frames(geometry: Geometry, program: Program, files: Mapping[str, str], rows: Rows, precision: str) -> Any:
    library = compiled(files, f"{program.name}.c", EXACT)
    function = getattr(library, f"{program.name}_frame" + ("_f" if precision == "float32" else ""))
    function.restype = None
    dtype = PRECISIONS[precision][0]
    frames = np.empty((len(rows.p), geometry.spec.dim, geometry.spec.tangent_size), dtype)
    for p, frame in zip(np.ascontiguousarray(rows.p, dtype), frames, strict=True):
        function(pointer(np.ascontiguousarray(p)), pointer(frame))
    return frames


def _torch_sums(manifold: Any, rows: Rows) -> Check:
    """`splats` against the splats one by one, which `kernels.py` holds to their formula."""
    generator = torch.Generator().manual_seed(41)
    x, mu = (torch.as_tensor(points, dtype=torch.float64) for points in (rows.q, rows.p[:3]))
    size = len(mu), manifold.dim, manifold.tangent_size
    W = torch.randn(size, generator=generator, dtype=torch.float64) / (1 + float(np.abs(rows.v).mean()))
    amplitude = torch.randn(len(mu), generator=generator, dtype=torch.float64)
    found = manifold.splats(x, mu, W, amplitude)
    single = [manifold.splat(x, *splat) for splat in zip(mu, W, amplitude, strict=True)]
    exact = [torch.stack(parts).sum(0) for parts in zip(*single, strict=True)]
    errors = [float((a - b).abs().max() / (1 + b.abs().max())) for a, b in zip(found, exact, strict=True)]
    worst = max(errors) if all(map(math.isfinite, errors)) else math.inf
    return Check("sums torch float64", "`splats` of the torch code is the sum of its splats", worst, EXACTLY, len(x))


def _ball(geometry: Geometry, manifold: Any, rows: Rows) -> Check:
    """`sample_ball` is uniform: weighted by |det D Log|, half of the points are in the tangent ball of half the volume."""
    generator = torch.Generator().manual_seed(43)
    center = torch.as_tensor(rows.p[0], dtype=torch.float64)
    radius = float(reach_of(geometry.injectivity_radius, geometry.unit))
    points = manifold.sample_ball(center, radius, BALL, generator)
    weight = torch.exp(manifold.log_abs_det(center, points))
    inner = weight * (manifold.distance(center, points) < radius * 0.5 ** (1 / geometry.spec.dim))
    share = float(inner.sum() / weight.sum())
    effective = float(weight.sum() ** 2 / weight.square().sum())
    worst = abs(share - 0.5) * 2 * math.sqrt(effective)
    promise = "`sample_ball` is uniform in volume (in standard deviations)"
    return Check("sample ball", promise, worst if math.isfinite(worst) else math.inf, DEVIATIONS, BALL)
