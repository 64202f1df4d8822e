"""Labels from paths: arrival times that are the costs of real curves, the cheapest of many.

Every label is an upper bound of the arrival time, up to a stated error. The curves come from a roadmap of the points, each is
relaxed (curves.py), and neighbours exchange them: where the way over a neighbour is cheaper, or goes elsewhere and
is not much dearer, it is relaxed too, and the cheaper one kept. So a label only ever falls. The curve's first direction
is the label's gradient. Neither a grid nor a reference solution enters, and nothing depends on the dimension.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields

import numpy as np
import torch
from torch import Tensor

from rsrm_gen.trainer.curves import Array, Curves, Relaxation, Terrain
from rsrm_gen.trainer.roadmap import Neighbourhood, Roadmap, roadmap, segment_costs
from rsrm_gen.trainer.threads import one_thread

# Lengths and times in units of the spacing of the curves, and of what it takes along it in the open.
APART = 1.2  # farther from one another than their starts, two curves are ways round different sides
CLOSE = 1.5  # a neighbour that goes round another side and is not later by more is worth trying
BETTER = 1e-5  # part of the time by which a neighbour's curve must be cheaper to be tried
NEIGHBOURS = 8  # that curves are exchanged with
ROUNDS = 8  # of the exchange, at most
SETTLED = 5e-4  # part of the labels; when a round changes fewer, the exchange ends
PLACES = 9  # along two curves at which they are compared
THOROUGH = 4  # every so many levels of the roadmap's tree are relaxed with all steps of differences
CHUNK = 4096  # curves between two signs of progress

Progress = Callable[[str, int, int], None]  # what is done, how many of how many


def silent(what: str, done: int, whole: int) -> None:
    """No progress is shown."""


@dataclass(frozen=True)
class Labels:
    """N points and what is known of the arrival time there, in float64."""

    x: Array  # (N, D)
    time: Array  # (N,) never less than the arrival time by more than `error`
    gradient: Array  # (N, T) of the arrival time, a tangent vector as long as the slowness
    error: Array  # (N,) of the time: what the curve itself costs more
    curves: Curves  # N, from the points to the goal

    def __len__(self) -> int:
        return len(self.x)

    def arrays(self) -> dict[str, Array]:
        """All of it as a plain mapping, which `from_arrays` takes back."""
        plain = {field.name: getattr(self, field.name) for field in fields(self) if field.name != "curves"}
        return {**plain, "nodes": self.curves.nodes, "offsets": self.curves.offsets}

    @classmethod
    def from_arrays(cls, arrays: Mapping[str, Array]) -> Labels:
        """The labels that `arrays` gave."""
        plain = {field.name: arrays[field.name] for field in fields(cls) if field.name != "curves"}
        return cls(**plain, curves=Curves(arrays["nodes"], arrays["offsets"]))

    def take(self, rows: Array) -> Labels:
        """Those of the points with these indices (R,)."""
        return Labels(self.x[rows], self.time[rows], self.gradient[rows], self.error[rows], self.curves.take(rows))

    def joined(self, others: Labels) -> Labels:
        """These, and the others after them."""
        return _joined([self, others])


@one_thread()
def label(terrain: Terrain, x: Tensor, progress: Progress = silent) -> Labels:
    """Labels of the points x (N, D)."""
    x = terrain.manifold.project(x.detach().double().cpu()).contiguous()
    found = roadmap(terrain, x)
    labels = _along(terrain, found, x.numpy(), progress)
    nearby = found.index[:, :NEIGHBOURS], found.through[:, :NEIGHBOURS]
    return _exchanged(terrain, labels, *nearby, np.ones(len(x), bool), progress)


@one_thread()
def offered(terrain: Terrain, labels: Labels, rows: Array, curves: Curves, progress: Progress = silent) -> Labels:
    """The same labels, or cheaper ones at the points with indices `rows` (R,), each at most once, after R curves from
    elsewhere have been relaxed; these may begin and end a little off, and are led to the point and to the goal."""
    x, goal = labels.x[rows], terrain.scene.goal.numpy()
    candidates = labels_of(terrain, _pinned(curves, x, goal), "relax offered curves", progress)
    better = candidates.time < labels.time[rows]
    return _replaced(labels, rows[better], candidates.take(np.flatnonzero(better)))


@one_thread()
def extended(terrain: Terrain, labels: Labels, x: Tensor, progress: Progress = silent) -> Labels:
    """The same labels with those of more points x (M, D) after them, whose curves start with their neighbours'. Where the
    new points show the old ones a cheaper way, these fall."""
    x = terrain.manifold.project(x.detach().double().cpu()).contiguous()
    around = Neighbourhood(terrain.manifold, torch.from_numpy(labels.x))
    index, _ = around.nearest(x, NEIGHBOURS)
    p = np.repeat(x.numpy(), index.shape[1], axis=0)
    through = terrain.segments(p, labels.x[index.reshape(-1)])[0].reshape(index.shape)
    whole = through + labels.time[index]
    best = index[np.arange(len(x)), np.where(np.isfinite(whole), whole, np.inf).argmin(1)]
    curves = labels.curves.take(best).from_(x.numpy())
    new = labels_of(terrain, curves, "relax more points", progress, terrain.usual.quick)
    is_new = np.arange(len(labels) + len(x)) >= len(labels)
    return exchanged(terrain, labels.joined(new), is_new, progress)


@one_thread()
def exchanged(terrain: Terrain, labels: Labels, changed: Array, progress: Progress = silent) -> Labels:
    """The same labels, after neighbours have exchanged their curves where one of the two has `changed` (N,) of bool."""
    index, _ = Neighbourhood(terrain.manifold, torch.from_numpy(labels.x)).nearest_others(NEIGHBOURS)
    return _exchanged(terrain, labels, index, segment_costs(terrain, labels.x, index), changed, progress)


def _along(terrain: Terrain, found: Roadmap, x: Array, progress: Progress) -> Labels:
    """Labels of the roadmap's points x (N, D). The curve of a point starts as the relaxed one of the point that its way goes
    to next: little of it is left to relax, so that all steps of differences are gone through at some levels only."""
    parts: list[Labels] = []
    order, done = [], 0
    position = np.empty(len(x), np.int64)
    for level, rows in enumerate(found.levels()):
        progress("relax", done, len(x))
        if level:
            curves = parts[-1].curves.take(position[found.next[rows]]).from_(x[rows])
        else:
            curves = Curves.between(x[rows], terrain.scene.goal.numpy())
        usual = terrain.usual
        parts.append(_labelled(terrain, curves, usual.quick if level % THOROUGH else usual))
        order.append(rows)
        position[rows] = np.arange(len(rows))
        done += len(rows)
    progress("relax", done, len(x))
    return _joined(parts).take(np.argsort(np.concatenate(order)))


def labels_of(
    terrain: Terrain, curves: Curves, what: str, progress: Progress, settings: Relaxation | None = None
) -> Labels:
    """Labels of the first nodes of curves."""
    parts = []
    for start in range(0, max(len(curves), 1), CHUNK):
        progress(what, start, len(curves))
        part = curves.take(np.arange(start, min(start + CHUNK, len(curves))))
        parts.append(_labelled(terrain, part, settings))
    progress(what, len(curves), len(curves))
    return _joined(parts)


def _labelled(terrain: Terrain, curves: Curves, settings: Relaxation | None) -> Labels:
    relaxed = terrain.relaxed(curves, settings)
    gradient = terrain.gradients(relaxed.curves)
    return Labels(relaxed.curves.starts, relaxed.cost, gradient, relaxed.error, relaxed.curves)


def _joined(parts: list[Labels]) -> Labels:
    whole = {
        field.name: np.concatenate([getattr(part, field.name) for part in parts])
        for field in fields(Labels)
        if field.name != "curves"
    }
    return Labels(**whole, curves=Curves.joined(*(part.curves for part in parts)))


def _pinned(curves: Curves, starts: Array, goal: Array) -> Curves:
    """The curves, led to the points `starts` (R, D) and to the goal in the place of their first and last nodes."""
    nodes = curves.nodes.copy()
    nodes[curves.offsets[:-1]], nodes[curves.offsets[1:] - 1] = starts, goal
    return Curves(nodes, curves.offsets)


def _replaced(labels: Labels, rows: Array, others: Labels) -> Labels:
    """The labels, the others in the place of those with indices `rows`."""
    if not len(rows):
        return labels
    time, gradient, error = labels.time.copy(), labels.gradient.copy(), labels.error.copy()
    time[rows], gradient[rows], error[rows] = others.time, others.gradient, others.error
    return Labels(labels.x, time, gradient, error, labels.curves.replaced(rows, others.curves))


def _exchanged(
    terrain: Terrain, labels: Labels, index: Array, through: Array, changed: Array, progress: Progress
) -> Labels:
    """The labels, after points have tried the curves of their neighbours `index` (N, k), which to reach costs `through`.

    Only pairs of which one has `changed` (N,) are looked at; what changes is looked at again in the next round.
    """
    for number in range(1, ROUNDS + 1):
        rows, neighbours = _worth_trying(terrain, labels, index, through, changed)
        changed = np.zeros(len(labels), bool)
        if not len(rows):
            break
        candidates = labels_of(
            terrain, labels.curves.take(neighbours).from_(labels.x[rows]), f"exchange, round {number}", progress
        )
        better = candidates.time < labels.time[rows]
        rows, candidates = _cheapest(rows[better], candidates.take(np.flatnonzero(better)))
        worth = (labels.time[rows] - candidates.time) > BETTER * labels.time[rows]
        changed[rows[worth]] = True
        labels = _replaced(labels, rows, candidates)
        if changed.sum() <= SETTLED * len(labels):
            break
    return labels


def _cheapest(rows: Array, candidates: Labels) -> tuple[Array, Labels]:
    """Of the candidates (R,) for the points `rows` (R,), the cheapest for each."""
    order = np.lexsort((candidates.time, rows))
    rows = rows[order]
    first = np.ones(len(rows), bool)
    first[1:] = rows[1:] != rows[:-1]
    return rows[first], candidates.take(order[first])


def _worth_trying(
    terrain: Terrain, labels: Labels, index: Array, through: Array, changed: Array
) -> tuple[Array, Array]:
    """Points and neighbours (R,), (R,) whose curves they should try: for each point the neighbour that makes it cheapest,
    if one does, and of those that go another way and are not much later the cheapest."""
    usual = terrain.usual
    spacing, free = usual.spacing, min(terrain.scene.law.free, terrain.scene.law.obstacle)
    whole = through + labels.time[index]
    whole = np.where(np.isfinite(whole) & (changed[:, None] | changed[index]), whole, np.inf)
    pick = np.arange(len(labels))
    best = whole.argmin(1)
    cheaper = whole[pick, best] < (1 - BETTER) * labels.time
    close = labels.time[index] < labels.time[:, None] + CLOSE * spacing * free
    elsewhere = np.isfinite(whole) & close
    rows, columns = np.nonzero(elsewhere)
    apart = _apart(terrain, labels, rows, index[rows, columns]) > APART * spacing
    elsewhere[rows[~apart], columns[~apart]] = False
    other = np.where(elsewhere, whole, np.inf)
    second = other.argmin(1)
    different = elsewhere.any(1) & ~(cheaper & (second == best))
    rows = np.concatenate([pick[cheaper], pick[different]])
    columns = np.concatenate([best[cheaper], second[different]])
    return rows, index[rows, columns]


def _apart(terrain: Terrain, labels: Labels, rows: Array, others: Array) -> Array:
    """How much farther the curves of two points (R,), (R,) are from one another, somewhere, than the points: (R,)."""
    places = terrain.resampled(labels.curves, np.full(len(labels), PLACES)).nodes.reshape(len(labels), PLACES, -1)
    along = torch.from_numpy(places)
    apart = np.empty(len(rows))
    for start in range(0, len(rows), CHUNK):
        part = slice(start, start + CHUNK)
        distance = terrain.manifold.distance(along[rows[part]], along[others[part]])
        apart[part] = (distance.amax(1) - distance[:, 0]).numpy()
    return apart


def weighed(terrain: Terrain, x: Tensor) -> Array:
    """How much points x (N, D) matter in a fit, (N,): 1 in the open and at an obstacle's surface, little just inside,
    hardly anything deeper."""
    depth = -terrain.scene.signed_distance(x.detach().double().cpu()).numpy() / terrain.unit
    weights: Array = np.select([depth <= 0.02, depth <= 0.1], [1.0, 0.1], 0.01)
    return weights
