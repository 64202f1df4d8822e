"""Points to learn from: evenly spread over a scene, fewer of them deep inside obstacles, some just beyond the rim."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import torch
from torch import Generator, Tensor
from torch.quasirandom import SobolEngine

from rsrm_gen.manifold import Manifold
from rsrm_gen.trainer.curves import length_unit
from rsrm_gen.trainer.roadmap import Neighbourhood
from rsrm_gen.trainer.scene import Scene

# In units of `length_unit`.
RIM = 0.15  # beyond a domain's boundary points are drawn too: a field is worst at the edge of what it has seen
SHELL = 0.1  # to this depth obstacles are drawn from like the open

DEEPER = 0.1  # part of the points deeper than that which is kept
DRAWN = 2  # times as many points are drawn as are wanted; the most crowded ones go
CROWD = 8  # neighbours by which a crowd is told
SHARPNESS = 8  # of the weight of a neighbour, as its distance falls


def sample_points(scene: Scene, count: int, generator: Generator, polar: float = 0.0) -> Tensor:
    """Points (count, D) in float64, evenly spread in volume; a part `polar` of them is uniform in the distance from the
    goal and the direction there instead, which puts more near the goal."""
    scene = scene.in_double()
    near = round(polar * count)
    pool = _drawn(scene, DRAWN * (count - near), lambda n: _in_volume(scene, n, generator), generator)
    points = [_thinned_in_parts(scene, pool, count - near)]
    if near:
        seed = int(torch.randint(2**31, (), generator=generator))
        engine = SobolEngine(1 + scene.manifold.dim, scramble=True, seed=seed)  # type: ignore[no-untyped-call]
        points.append(_drawn(scene, near, lambda n: _about_goal(scene, engine, n), generator)[:near])
    return torch.cat(points)


def _drawn(scene: Scene, count: int, draw: Callable[[int], Tensor], generator: Generator) -> Tensor:
    """At least so many of the points that `draw` gives, with fewer of the deep ones."""
    found = [scene.goal.new_empty(0, len(scene.goal))]
    while sum(map(len, found)) < count:
        x = draw(max(count, 64))
        lucky = torch.rand(len(x), generator=generator, dtype=torch.float64) < DEEPER
        found.append(x[~_is_deep(scene, x) | lucky])
    return torch.cat(found)


def _is_deep(scene: Scene, x: Tensor) -> Tensor:
    return scene.signed_distance(x) < -SHELL * length_unit(scene)


def _reach(scene: Scene, radius: float) -> float:
    """A radius, and the rim beyond it, as far as Exp goes."""
    return min(radius + RIM * length_unit(scene), scene.manifold.injectivity_radius)


def _in_volume(scene: Scene, count: int, generator: Generator) -> Tensor:
    if scene.domain is None:
        return scene.sample(count, generator)
    radius = _reach(scene, scene.domain.radius)
    return scene.manifold.sample_ball(scene.domain.center, radius, count, generator)


def _about_goal(scene: Scene, engine: SobolEngine, count: int) -> Tensor:
    """Exp_goal(r u), r uniform, as far as the domain goes; u a unit vector, uniform in direction."""
    M, domain = scene.manifold, scene.domain
    farthest = M.injectivity_radius
    if domain is not None:
        farthest = _reach(scene, domain.radius + float(M.distance(domain.center, scene.goal)))
    numbers = engine.draw(count, dtype=torch.float64).clamp(1e-9, 1 - 1e-9)
    normal = torch.erfinv(2 * numbers[:, 1:] - 1)
    direction = normal / normal.norm(dim=1, keepdim=True).clamp_min(1e-30)
    x = M.project(M.exp(scene.goal.expand(count, -1), farthest * numbers[:, :1] * (direction @ M.frame(scene.goal))))
    if domain is None:
        return x
    return x[M.distance(x, domain.center) <= _reach(scene, domain.radius)]


def _thinned_in_parts(scene: Scene, x: Tensor, count: int) -> Tensor:
    """So many of the points (N, D), the crowded ones gone; as large a part of them deep as before."""
    deep = _is_deep(scene, x)
    left = round(count * float(deep.double().mean())) if len(x) else 0
    return torch.cat([_thinned(scene.manifold, x[~deep], count - left), _thinned(scene.manifold, x[deep], left)])


def _thinned(manifold: Manifold, x: Tensor, count: int) -> Tensor:
    """So many of the points x (N, D), without those in the thickest crowds. Each round takes away the points that are more
    crowded than all their neighbours, the most crowded first (sample elimination: Yuksel 2015, by rounds)."""
    if count >= len(x):
        return x[:count]
    if count < 1:
        return x[:0]
    index, distance = Neighbourhood(manifold, x).nearest_others(CROWD)
    reach = np.median(distance[:, -1]) * (len(x) / count) ** (1 / manifold.dim)
    closeness = np.clip(1 - distance / reach, 0, None) ** SHARPNESS
    alive = np.ones(len(x), bool)
    while (excess := int(alive.sum()) - count) > 0:
        crowding = np.where(alive, (closeness * alive[index]).sum(1), -1.0)
        top = alive & (crowding >= np.where(alive[index], crowding[index], -1.0).max(1))
        chosen = np.flatnonzero(top)
        alive[chosen[np.argsort(-crowding[chosen], kind="stable")[:excess]]] = False
    return x[torch.from_numpy(alive)]
