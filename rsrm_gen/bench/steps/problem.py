"""The points and splats that are timed, from a seed: always the same, and no point near the cut locus of a splat."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Any

import numpy as np

from rsrm_gen.files import write_whole
from rsrm_gen.manifold import Manifold

SEED = 11
RADII = {"hyperbolic": 2.9}  # of the ball that points and splats lie in; where nothing is said, RADIUS
RADIUS = 1.2  # two of them are less than the injectivity radius pi
SIGMAS = {"sphere": 0.25, "torus": 0.35, "hyperbolic": 0.35}  # in two dimensions
SIGMA = 0.45  # in more
LARGEST = 1.0  # of |f|: T = d exp(f) neither overflows nor is d


@dataclass(frozen=True)
class Problem:
    """N points, K splats: what a step needs, as numpy arrays of one dtype."""

    x: Any  # (N, D)
    d: Any  # (N,): distance to the goal
    away: Any  # (N, T): its gradient
    slowness: Any  # (N,)
    v: Any  # (K,)
    mu: Any  # (K, D)
    A: Any  # (K, d, d)
    frame: Any  # (K, d, T): orthonormal bases at the centres
    flat_frame: Any  # (K, d, T): as covectors

    @property
    def points(self) -> tuple[Any, Any, Any, Any]:
        """What belongs to the points: x, d, away, slowness."""
        return self.x, self.d, self.away, self.slowness

    def part(self, points: int, splats: int | None = None) -> Problem:
        """The first points and splats."""
        cut = {name: getattr(self, name)[:points] for name in ("x", "d", "away", "slowness")}
        cut |= {name: getattr(self, name)[:splats] for name in ("v", "mu", "A", "frame", "flat_frame")}
        return replace(self, **cut)

    def save(self, path: Path) -> None:
        """Into a file that `read_problem` reads."""
        arrays: Mapping[str, Any] = {field.name: getattr(self, field.name) for field in fields(self)}
        write_whole(path, lambda file: np.savez(file, **arrays))


def read_problem(path: Path, precision: str) -> Problem:
    """What `save` wrote, in a precision."""
    with np.load(path, allow_pickle=False) as arrays:
        return Problem(**{field.name: arrays[field.name].astype(precision) for field in fields(Problem)})


def problem(manifold: Manifold, name: str, points: int, splats: int, width: float | None = None) -> Problem:
    """Points and splats in a ball of a manifold with that name in its file, in float64; `width` of the splats, or ours."""
    import torch

    generator = torch.Generator().manual_seed(SEED)

    def draw(*shape: int) -> Any:
        return torch.randn(*shape, generator=generator, dtype=torch.float64)

    d = manifold.dim
    middle = manifold.project(0.3 * draw(manifold.point_size))
    radius, sigma = RADII.get(name, RADIUS), SIGMAS.get(name, SIGMA) if d == 2 else SIGMA
    sigma = width or sigma
    mu = manifold.sample_ball(middle, radius, splats, generator)
    x = manifold.sample_ball(middle, radius, points, generator)
    A = sigma * (torch.eye(d, dtype=torch.float64) + 0.2 * draw(splats, d, d))
    frame = manifold.frame(mu)
    flat = manifold.flat(mu[:, None], frame)
    v = draw(splats)
    goal = middle.expand_as(x)
    distance = manifold.distance(x, goal)
    away = -manifold.log(x, goal) / distance[:, None]
    slowness = 1 + 0.5 * torch.rand(points, generator=generator, dtype=torch.float64)
    inverse = torch.linalg.inv(A)
    amplitude = v * (2 * torch.pi) ** (-d / 2) * torch.linalg.det(inverse).abs()
    v = v * (LARGEST / manifold.splats(x[:512], mu, inverse @ flat, amplitude)[0].abs().max())
    return Problem(*(t.numpy() for t in (x, distance, away, slowness, v, mu, A, frame, flat)))
