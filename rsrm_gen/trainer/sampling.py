"""Points to learn from: evenly spread over a scene, fewer of them deep inside obstacles, some just beyond the rim."""

from __future__ import annotations

import numpy as np
import torch
from torch import Generator, Tensor

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


def sample_points(scene: Scene, count: int, generator: Generator) -> Tensor:
    """Points (count, D) in float64, evenly spread in volume."""
    scene = scene.in_double()
    return _thinned_in_parts(scene, _drawn(scene, DRAWN * count, generator), count)


def _drawn(scene: Scene, count: int, generator: Generator) -> Tensor:
    """At least so many random points, with fewer of the deep ones."""
    found = [scene.goal.new_empty(0, len(scene.goal))]
    while sum(map(len, found)) < count:
        x = _in_volume(scene, max(count, 64), generator)
        lucky = torch.rand(len(x), generator=generator, dtype=torch.float64) < DEEPER
        found.append(x[~_is_deep(scene, x) | lucky])
    return torch.cat(found)


def _is_deep(scene: Scene, x: Tensor) -> Tensor:
    return scene.signed_distance(x) < -SHELL * length_unit(scene)


def _in_volume(scene: Scene, count: int, generator: Generator) -> Tensor:
    if scene.domain is None:
        return scene.sample(count, generator)
    # The rim too, as far as Exp goes.
    radius = min(scene.domain.radius + RIM * length_unit(scene), scene.manifold.injectivity_radius)
    return scene.manifold.sample_ball(scene.domain.center, radius, count, generator)


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
