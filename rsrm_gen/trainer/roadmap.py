"""A first guess of every arrival time: the shortest ways over a graph of nearby points, on any manifold.

Neighbours are looked up in a KD-tree in the coordinates x -> (d(x, l_1), ..., d(x, l_L)), the distances to some landmarks:
no coordinate changes faster than the distance itself, whatever the manifold, so that near points are near there. The
candidates so found are then measured with the manifold's own distance.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import torch
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra
from scipy.spatial import cKDTree
from torch import Tensor

from rsrm_gen.manifold import Manifold
from rsrm_gen.trainer.curves import Array, Terrain

CANDIDATES = 3  # times as many as neighbours: nearness to landmarks is not the distance
AROUND = 4  # landmarks, and two more for each dimension
CHOSEN_FROM = 2000  # points, for the landmarks
GOAL_REACH = 6  # spacings of the curves: so far around the goal points are joined to it
GOAL_NEIGHBOURS = 48  # or so many of the nearest, if there are fewer so near
UNREACHED = -9999  # what scipy calls a node without a predecessor


class Neighbourhood:
    """Points (N, D) among which the nearest to others are found."""

    def __init__(self, manifold: Manifold, x: Tensor) -> None:
        self.manifold, self.x = manifold, x
        self.landmarks = _landmarks(manifold, x[:CHOSEN_FROM], AROUND + 2 * manifold.dim)
        self.tree = cKDTree(self._coordinates(x))

    def _coordinates(self, x: Tensor) -> Array:
        distances: Array = self.manifold.distance(self.landmarks[:, None], x).T.contiguous().numpy()
        return distances

    def nearest(self, y: Tensor, count: int) -> tuple[Array, Array]:
        """The indices and distances of the nearest points to each of y (M, D), nearest first: (M, k), k <= count.

        A point that is among those searched is its own nearest.
        """
        count = min(count, len(self.x))
        wanted = min(CANDIDATES * count, len(self.x))
        _, index = self.tree.query(self._coordinates(y), wanted, workers=torch.get_num_threads())
        index = index.reshape(len(y), wanted)
        distance = self.manifold.distance(y[:, None], self.x[index]).numpy()
        order = np.argsort(distance, axis=1, kind="stable")[:, :count]
        return np.take_along_axis(index, order, 1), np.take_along_axis(distance, order, 1)

    def nearest_others(self, count: int) -> tuple[Array, Array]:
        """The same for the points themselves, without each of them: (N, k)."""
        index, distance = self.nearest(self.x, count + 1)
        own = index == np.arange(len(index))[:, None]
        own[~own.any(1), -1] = True  # a point with as many twins: one of them stands in for it
        rows = len(index), index.shape[1] - 1
        return index[~own].reshape(rows), distance[~own].reshape(rows)


def _landmarks(manifold: Manifold, x: Tensor, count: int) -> Tensor:
    """Points of x far from one another: each the farthest from those before it."""
    chosen = [0]
    nearest = manifold.distance(x, x[0])
    for _ in range(min(count, len(x)) - 1):
        chosen.append(int(nearest.argmax()))
        nearest = torch.minimum(nearest, manifold.distance(x, x[chosen[-1]]))
    return x[chosen]


@dataclass(frozen=True)
class Roadmap:
    """The shortest ways from N points over a graph of segments to the goal."""

    cost: Array  # (N,)
    next: Array  # (N,) of int64: the point that the way goes to next; N: the goal
    index: Array  # (N, k) of int64: the neighbours of each
    through: Array  # (N, k), what the segments to them cost

    def levels(self) -> Iterator[Array]:
        """The indices (n,) of the points from which the goal is one segment away, then of those from which it is two, ..."""
        within = np.append(np.zeros(len(self.cost), bool), True)  # at first the goal alone
        while len(rows := np.flatnonzero(within[self.next])):
            yield rows
            within[:] = False
            within[rows] = True


def roadmap(terrain: Terrain, x: Tensor, neighbours: int = 24) -> Roadmap:
    """The shortest ways from x (N, D) over segments to so many neighbours each. All reach the goal: points that the graph
    does not join to it are joined by geodesics."""
    goal, points = terrain.scene.goal, x.numpy()
    index, _ = Neighbourhood(terrain.manifold, x).nearest_others(neighbours)
    through = segment_costs(terrain, points, index)
    to_goal = terrain.manifold.distance(x, goal).numpy()
    reach = max(GOAL_REACH * terrain.usual.spacing, np.sort(to_goal)[: GOAL_NEIGHBOURS + 1][-1])
    joined = to_goal <= reach
    while True:
        rows = np.flatnonzero(joined)
        at_goal, _ = terrain.segments(points[rows], goal.numpy()[None])
        cost, following = _shortest(through, index, rows, at_goal)
        if joined.all() or np.isfinite(cost).all():
            return Roadmap(cost, following, index, through)
        joined |= ~np.isfinite(cost)


def segment_costs(terrain: Terrain, x: Array, index: Array) -> Array:
    """The costs (N, k) of the segments from each point of x (N, D) to those with the indices (N, k)."""
    from_ = np.repeat(np.arange(len(x)), index.shape[1])
    to = index.reshape(-1)
    low, high = np.minimum(from_, to), np.maximum(from_, to)  # one for both ways
    pairs, inverse = np.unique(low * len(x) + high, return_inverse=True)
    costs, _ = terrain.segments(x[pairs // len(x)], x[pairs % len(x)])
    return costs[inverse].reshape(index.shape)


def _shortest(through: Array, index: Array, rows: Array, at_goal: Array) -> tuple[Array, Array]:
    """Costs to the goal and next points, from the costs of segments between points, and from some rows to the goal."""
    count, width = index.shape
    heads = np.concatenate([np.repeat(np.arange(count), width), rows])
    tails = np.concatenate([index.reshape(-1), np.full(len(rows), count)])
    costs = np.concatenate([through.reshape(-1), at_goal])
    usable = np.isfinite(costs)
    least = np.finfo(np.float64).tiny  # a segment of no length is one all the same
    heads, tails, costs = heads[usable], tails[usable], np.maximum(costs[usable], least)
    low, high = np.minimum(heads, tails), np.maximum(heads, tails)
    _, first = np.unique(low * (count + 1) + high, return_index=True)  # coo adds up what is given twice
    graph = coo_array((costs[first], (low[first], high[first])), shape=(count + 1, count + 1)).tocsr()
    cost, before = dijkstra(graph, directed=False, indices=count, return_predecessors=True)
    return cost[:count], np.where(before[:count] == UNREACHED, count, before[:count]).astype(np.int64)
