"""Points in compact blocks, so that what is near a block can be told from what is far by the triangle inequality.

Points are halved at the median of the stored coordinate that spreads most, which needs nothing of a manifold; how compact
the blocks are decides about speed alone.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import torch
from torch import Tensor

from rsrm_gen.manifold import Manifold


@dataclass(frozen=True)
class Block:
    """Some of the points."""

    index: Tensor  # (n,), which
    center: Tensor  # (D,), one in the middle
    radius: float  # how far the others are from it at most
    probes: Tensor  # (m, D), some that stand for all
    cover: float  # how far any is from the nearest probe


def blocks(manifold: Manifold, x: Tensor, size: int, probes: int) -> list[Block]:
    """The points x (N, D) in blocks of at most `size`, all of about the same size, each with about so many probes."""
    return [_block(manifold, x, index, probes) for index in halves(x, size)]


def halves(x: Tensor, size: int) -> Iterator[Tensor]:
    """The indices of the points x (N, D), halved until no part has more than `size`."""
    waiting = [torch.arange(len(x))]
    while waiting:
        index = waiting.pop()
        if len(index) <= size:
            yield index
            continue
        part = x[index]
        axis = int((part.amax(0) - part.amin(0)).argmax())
        order = part[:, axis].argsort(stable=True)
        middle = len(index) // 2
        waiting += [index[order[middle:]], index[order[:middle]]]


def _block(manifold: Manifold, x: Tensor, index: Tensor, count: int) -> Block:
    part = x[index]
    center = part[int((part - part.mean(0)).square().sum(-1).argmin())]
    radius = float(manifold.distance(part, center.expand_as(part)).amax())
    smaller = halves(part, max(len(part) // count, 1))
    probes = torch.stack([part[int(some[len(some) // 2])] for some in smaller])
    cover = float(manifold.distance(part[:, None], probes[None]).amin(1).amax())
    return Block(index, center, radius, probes, cover)
