"""Which splats come and go during training: strategies with one small interface."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import torch
from torch import Tensor

from rsrm_gen.manifold import Manifold
from rsrm_gen.trainer.model import SplatField
from rsrm_gen.trainer.settings import EikonalTraining

Propose = Callable[[int], Tensor]  # a number k of new splats to at most k centres (k, D), the most needed first


@dataclass(frozen=True)
class Change:
    """What was done to the splats: the indices (before) of those kept, in their order, then so many new ones."""

    kept: Tensor
    added: int


class DensityControl(Protocol):
    """Changes the splats of a field between two steps."""

    def update(self, step: int, field: SplatField, propose: Propose) -> Change | None:
        """After that many steps; None when nothing changed."""
        ...


@dataclass(frozen=True)
class Fixed:
    """The splats at first are the splats at the end."""

    def update(self, step: int, field: SplatField, propose: Propose) -> Change | None:
        """Nothing changes."""
        return None


@dataclass(frozen=True)
class PruneAndAdd:
    """The paper's: every so many steps splats with a small |v| go and new ones come at the largest residuals."""

    every: int
    add: int
    prune_below: float
    shape: float
    last: int  # the last step at which anything changes

    def update(self, step: int, field: SplatField, propose: Propose) -> Change | None:
        """Prune first, so that there is room; at least one splat stays."""
        if step % self.every or step > self.last:
            return None
        weights = field.v.detach()[: field.count].abs()
        kept = torch.nonzero(weights >= self.prune_below)[:, 0]
        if not len(kept):
            kept = weights.argmax()[None]
        field.keep(kept)
        wanted = min(self.add, field.capacity - field.count)
        added = field.append(propose(wanted), self.shape) if wanted else 0
        return Change(kept, added)


def make_density(training: EikonalTraining) -> DensityControl:
    """The strategy that the settings describe."""
    s = training.splats
    if s.add == 0 and s.prune_below == 0:
        return Fixed()
    return PruneAndAdd(s.every, s.add, s.prune_below, s.shape, training.last_change)


def pick_apart(manifold: Manifold, points: Tensor, priority: Tensor, count: int, separation: float) -> Tensor:
    """Greedily at most `count` of points (N, D), by falling priority (N,), no two closer than `separation`: (k, D)."""
    # Eight candidates for each one wanted keep the table of distances small.
    points = points[priority.argsort(descending=True, stable=True)[: 8 * count]]
    close = manifold.distance(points[:, None], points[None, :]) < separation
    free = torch.ones(len(points), dtype=torch.bool)
    chosen: list[int] = []
    for i in range(len(points)):
        if free[i] and len(chosen) < count:
            chosen.append(i)
            free &= ~close[i]
    return points[chosen]


def pick_spread(manifold: Manifold, points: Tensor, count: int) -> Tensor:
    """Farthest-point choice of `count` of points (N, D), starting with the first: (count, D)."""
    chosen = [0]
    nearest = manifold.distance(points, points[:1])
    while len(chosen) < count:
        chosen.append(int(nearest.argmax()))
        nearest = torch.minimum(nearest, manifold.distance(points, points[chosen[-1]][None]))
    return points[chosen]
