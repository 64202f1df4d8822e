"""The generated C on another processor: compiled for 64-bit ARM, run in an emulator, held to what it gives here."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
import torch
from c_drivers import ROWS, driver, rows
from compiled import files, program

from rsrm_gen.load import load
from rsrm_gen.manifold import Manifold

CROSS, EMULATOR = "aarch64-linux-gnu-gcc", "qemu-aarch64"
SPLATS = (0, 1, 70)
# The emulator is slow: all but two by name, `pytest -m slow tests/test_other_processor.py`.
SLOW = ("sphere", "hyperbolic", "se3", "spd", "arm2")
MANIFOLDS = ["torus", "so3", *(pytest.param(name, marks=pytest.mark.slow) for name in SLOW)]
# Of rounding: a processor may fuse other products into sums, and has other exp and sin in its library.
CLOSE = {"double": 1e-9, "float": 2e-3}

pytestmark = pytest.mark.skipif(
    not (shutil.which(CROSS) and shutil.which(EMULATOR)), reason=f"{CROSS} and {EMULATOR} are not here"
)


def arguments(manifold: Manifold) -> dict[str, np.ndarray]:
    """Points near each other, tangent vectors between them, splats a quarter wide."""
    generator = torch.Generator().manual_seed(0)
    center = torch.full((manifold.point_size,), 0.1, dtype=torch.float64)
    center[0] = center[-1] = 1  # a matrix like this is positive and has a rotation near it
    radius = min(0.8, manifold.injectivity_radius / 4)
    x, mu = (manifold.sample_ball(manifold.project(center), radius, ROWS, generator) for _ in range(2))
    log = manifold.log(mu, x)
    covectors = manifold.flat(mu[:, None], manifold.frame(mu))
    given = {"p": mu, "mu": mu, "q": x, "x": x, "u": log, "v": log, "W": 4 * covectors.flatten(1)}
    return {name: tensor.numpy() for name, tensor in given.items()}


@pytest.mark.parametrize("name", MANIFOLDS)
def test_it_gives_the_same_numbers(name: str, tmp_path: Path) -> None:
    for file, text in {**files(name), "driver.c": driver(program(name), SPLATS)}.items():
        (tmp_path / file).write_text(text, encoding="utf-8")
    (tmp_path / "rows").write_bytes(rows(program(name), arguments(load(name))))
    sources = ["driver.c", f"{name}.c", f"{name}_splats.c"]
    found = {}
    for here, (cc, run) in {"native": ("cc", []), "arm": (CROSS, [EMULATOR])}.items():
        subprocess.run([cc, "-std=c99", "-O2", "-static", *sources, "-o", here, "-lm"], cwd=tmp_path, check=True)
        shown = [f"{here}.{precision}" for precision in CLOSE]
        subprocess.run([*run, f"./{here}", "rows", *shown], cwd=tmp_path, check=True)
        found[here] = [
            np.fromfile(tmp_path / f"{here}.{p}", dtype) for p, dtype in zip(CLOSE, ("f8", "f4"), strict=True)
        ]
    for close, ours, theirs in zip(CLOSE.values(), *found.values(), strict=True):
        assert len(ours) > 1000
        np.testing.assert_allclose(theirs, ours, rtol=close, atol=close)
