"""Curves on a manifold and what they cost in a scene: exact costs, equal spacing, relaxation to the least cost nearby.

A curve is a row of nodes joined by segments t -> Exp_p(t Log_p q); its cost, the integral of the slowness along it, is an
upper bound of the arrival time at its first node, up to the error of the quadrature. Relaxation moves the inner nodes
across the curve by Newton's method (curves.c). The slowness is 1 + ... of a *least* signed distance, so that it has
V-shaped valleys between obstacles, along which good curves slide; there derivatives say nothing of the valley's floor, and
differences over a large step do. So the steps of the differences begin large and become small.
"""

from __future__ import annotations

import ctypes
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
import torch

from rsrm_gen.compiler.native import FAST, compiled, compiler
from rsrm_gen.errors import UserError
from rsrm_gen.manifold import Manifold
from rsrm_gen.rows import addresses
from rsrm_gen.trainer.scene import Scene

Array = np.ndarray[Any, Any]

SOURCE = Path(__file__).with_name("curves.c")
BLOCK = 64  # as in curves.c
FEWEST = 4  # segments of a curve that is relaxed
MOST = 2000  # segments of one
MOVED = (
    0.02  # part of a cost: what doubling the nodes gains beyond is no error of polygons, the curve was still on its way
)
EVALUATIONS = 64  # of a segment while its curve is relaxed, at least
WORTH_WAKING = 4096  # segments to evaluate, for more than one thread
REPEATS = 3  # of the relaxation of such curves
GAUSS = np.polynomial.legendre.leggauss(5)

# A scene of the paper: what lengths below are in units of.
USUAL_WIDTH = 0.15
USUAL_RADIUS = 0.5


@dataclass(frozen=True)
class Curves:
    """B curves: curve b has the nodes offsets[b] to offsets[b + 1] - 1, two or more; the last is where it leads to."""

    nodes: Array  # (S, D) of float64, S = offsets[B]
    offsets: Array  # (B + 1,) of int64, from 0

    @classmethod
    def of(cls, curves: Sequence[Array]) -> Curves:
        """Curves from their nodes, (n_b, D) each, of which there must be one at least."""
        ends = np.cumsum([0, *map(len, curves)], dtype=np.int64)
        return cls(np.ascontiguousarray(np.concatenate(curves), np.float64), ends)

    @classmethod
    def between(cls, starts: Array, ends: Array) -> Curves:
        """The segments from starts to ends, (B, D)."""
        starts, ends = np.broadcast_arrays(starts, ends)
        nodes = np.stack([starts, ends], 1).reshape(-1, starts.shape[-1])
        return cls(nodes.astype(np.float64), np.arange(len(starts) + 1) * 2)

    def __len__(self) -> int:
        return len(self.offsets) - 1

    def __getitem__(self, b: int) -> Array:
        """The nodes of one curve, (n_b, D)."""
        return self.nodes[self.offsets[b] : self.offsets[b + 1]]

    @property
    def counts(self) -> Array:
        """How many nodes each has: (B,)."""
        return np.diff(self.offsets)

    @property
    def starts(self) -> Array:
        """Their first nodes, (B, D)."""
        return self.nodes[self.offsets[:-1]]

    def take(self, rows: Array) -> Curves:
        """Those with these indices (R,)."""
        counts = self.counts[rows]
        offsets = offsets_of(counts)
        index = np.arange(offsets[-1]) + np.repeat(self.offsets[:-1][rows] - offsets[:-1], counts)
        return Curves(self.nodes[index], offsets)

    def joined(self, *others: Curves) -> Curves:
        """These, and the others after them."""
        every = (self, *others)
        offsets = offsets_of(np.concatenate([curves.counts for curves in every]))
        return Curves(np.concatenate([curves.nodes for curves in every]), offsets)

    def replaced(self, rows: Array, others: Curves) -> Curves:
        """These, the ones with indices `rows` (R,) replaced by the R others."""
        order = np.arange(len(self))
        order[rows] = len(self) + np.arange(len(rows))
        return self.joined(others).take(order)

    def from_(self, starts: Array) -> Curves:
        """The same, with one more node (B, D) before the first of each."""
        where = self.offsets[:-1]
        return Curves(np.insert(self.nodes, where, starts, axis=0), self.offsets + np.arange(len(self) + 1))


def offsets_of(counts: Array) -> Array:
    """Where the curves with so many nodes (B,) begin, and the end: (B + 1,)."""
    return np.concatenate([np.zeros(1, np.int64), np.cumsum(counts, dtype=np.int64)])


@dataclass(frozen=True)
class Relaxation:
    """How curves are relaxed. Lengths are in the units of the metric."""

    spacing: float = 0.1  # of the nodes at first; then they are doubled
    coarse: tuple[float, ...] = (0.03, 0.008, 0.003)  # steps of differences, one after another, largest first
    fine: tuple[float, ...] = (0.004, 0.001)  # with twice the nodes
    iterations: int = 24  # of Newton's method, at most, for each of the steps
    resample_every: int = 4  # iterations
    tolerance: float = 1e-6  # a decrease, relative to the cost, below which a step is done
    reach: float = 0.3  # the longest displacement of a node in an iteration

    @property
    def quick(self) -> Relaxation:
        """The last of the steps alone, for curves that are nearly relaxed."""
        return replace(self, coarse=self.coarse[-1:], fine=self.fine[-1:])

    @classmethod
    def of(cls, scene: Scene) -> Relaxation:
        """The usual one, in units of what is smallest in the scene: the slowness's transition, or an obstacle."""
        unit = length_unit(scene)
        usual = cls()
        return cls(
            spacing=unit * usual.spacing,
            coarse=tuple(unit * step for step in usual.coarse),
            fine=tuple(unit * step for step in usual.fine),
            reach=unit * usual.reach,
        )


def length_unit(scene: Scene) -> float:
    """What lengths tuned on the paper's scenes are multiplied by in this one."""
    if len(scene.radii):
        return min(scene.law.width / USUAL_WIDTH, float(scene.radii.min()) / USUAL_RADIUS)
    extent = scene.domain.radius if scene.domain else scene.manifold.diameter
    return extent / math.pi


@dataclass(frozen=True)
class Relaxed:
    """What relaxation makes of B curves."""

    curves: Curves
    cost: Array  # (B,) the exact cost, with what doubling the nodes once more would still gain taken off
    error: Array  # (B,) how much was taken off: the cost of the curve itself is cost + error


class _Geometry(ctypes.Structure):
    _fields_ = (
        *((name, ctypes.c_void_p) for name in ("exp", "log", "norm", "distance", "inner", "frame")),
        ("geodesic", ctypes.c_int),
    )


class _Medium(ctypes.Structure):
    _fields_ = (
        ("balls", ctypes.c_size_t),
        ("centers", ctypes.c_void_p),
        ("radii", ctypes.c_void_p),
        ("free", ctypes.c_double),
        ("obstacle", ctypes.c_double),
        ("width", ctypes.c_double),
    )


class _Settings(ctypes.Structure):
    _fields_ = (
        ("iterations", ctypes.c_size_t),
        ("resample_every", ctypes.c_size_t),
        ("tolerance", ctypes.c_double),
        ("reach", ctypes.c_double),
    )


class Terrain:
    """A scene's slowness over its manifold, for curves. All in float64, on so many threads as torch has.

    Raises `UserError` where there is no C compiler. What is computed does not depend on the number of threads.
    """

    def __init__(self, scene: Scene) -> None:
        if compiler() is None:
            hint = "install one, or name it in CC; `objective: eikonal` needs none"
            raise UserError("labels from paths need a C compiler, and none was found", hint=hint)
        self.scene = scene = scene.in_double()
        self.manifold = M = scene.manifold
        self.unit = length_unit(scene)
        self.usual = Relaxation.of(scene)
        self.threads = torch.get_num_threads()
        self._library = _library(M.dim, M.point_size, M.tangent_size)
        self._geometry = _geometry(M)
        self._centers = np.repeat(scene.centers.numpy()[:, None], BLOCK, 1)  # kept: C has their addresses
        self._radii = np.ascontiguousarray(scene.radii.numpy())
        law = scene.law
        self._medium = _Medium(
            len(self._radii), _address(self._centers), _address(self._radii), law.free, law.obstacle, law.width
        )

    def _for(self, segments: int) -> int:
        """The threads that pay for so many segments: waking others takes as long as hundreds of them."""
        return self.threads if segments >= WORTH_WAKING else 1

    def segments(self, p: Array, q: Array) -> tuple[Array, Array]:
        """The costs (N,) and the lengths (N,) of the segments between the points p and q, (N, D), by Gauss's quadrature."""
        p, q = (np.ascontiguousarray(a, np.float64) for a in np.broadcast_arrays(p, q))
        node, weight = (GAUSS[0] + 1) / 2, GAUSS[1] / 2
        cost, length = np.empty(len(p)), np.empty(len(p))
        self._library.segments(
            len(p), *map(_address, (p, q)), self._geometry, self._medium, len(node), *map(_address, (node, weight)),
            3 * self.usual.spacing, self._for(len(p)), *map(_address, (cost, length)),
        )  # fmt: skip
        return cost, length

    def one_by_one(self) -> Callable[[int, int], float]:
        """`segments` for who asks for one at a time: the addresses of two points (D,) of float64 to a cost, in microseconds."""
        rule = (GAUSS[0] + 1) / 2, GAUSS[1] / 2  # kept: C has their addresses
        integrate, order, panel = self._library.segment, len(rule[0]), 3 * self.usual.spacing
        node, weight = map(_address, rule)
        geometry, medium = ctypes.byref(self._geometry), ctypes.byref(self._medium)

        def segment(p: int, q: int, rule: tuple[Array, Array] = rule) -> float:
            cost: float = integrate(p, q, geometry, medium, order, node, weight, panel)
            return cost

        return segment

    def measure(self, curves: Curves) -> tuple[Array, Array]:
        """The exact costs (B,) and the lengths (B,) of curves."""
        if not len(curves):
            return np.empty(0), np.empty(0)
        inside = np.ones(len(curves.nodes), bool)
        inside[curves.offsets[1:] - 1] = False  # no segment begins at a last node
        p = np.flatnonzero(inside)
        costs, lengths = self.segments(curves.nodes[p], curves.nodes[p + 1])
        first = curves.offsets[:-1] - np.arange(len(curves))
        return np.add.reduceat(costs, first), np.add.reduceat(lengths, first)

    def cost(self, curves: Curves) -> Array:
        """The exact costs of curves, (B,)."""
        return self.measure(curves)[0]

    def spaced(self, curves: Curves, spacing: float) -> Curves:
        """The same curves with nodes at equal distances of about `spacing`; a curve of no finite length gets the fewest."""
        length = self.measure(curves)[1]
        segments = np.ceil(np.where(np.isfinite(length), length, 0.0) / spacing)
        return self.resampled(curves, np.clip(segments, FEWEST, MOST).astype(np.int64) + 1)

    def resampled(self, curves: Curves, counts: Array) -> Curves:
        """The same curves with so many nodes (B,) each, two or more, at equal distances."""
        offsets = offsets_of(counts)
        nodes = np.empty((offsets[-1], self.manifold.point_size))
        given = [np.ascontiguousarray(a) for a in (curves.offsets, curves.nodes)]
        most = int(max(curves.counts.max(initial=0), 1))
        complete = self._library.resample(
            len(curves), *map(_address, (*given, offsets, nodes)), most, self._geometry, self._for(len(nodes))
        )
        _require(complete)
        return Curves(nodes, offsets)

    def settled(self, curves: Curves, differences: Sequence[float], settings: Relaxation | None = None) -> Curves:
        """The curves moved to the least cost nearby, with the nodes that they have; none becomes dearer by much.

        `differences`: the steps with which their costs are differentiated, one after another.
        """
        settings = settings or self.usual
        nodes = np.array(curves.nodes, np.float64, order="C")
        offsets, steps = np.ascontiguousarray(curves.offsets), np.array(differences, np.float64)
        most = int(max(curves.counts.max(initial=0), 1))
        chosen = _Settings(settings.iterations, settings.resample_every, settings.tolerance, settings.reach)
        complete = self._library.relax(
            len(curves), *map(_address, (offsets, nodes)), most, self._geometry, self._medium,
            len(steps), _address(steps), chosen, self._for(len(nodes) * EVALUATIONS),
        )  # fmt: skip
        _require(complete)
        return Curves(nodes, curves.offsets)

    def relaxed(self, curves: Curves, settings: Relaxation | None = None) -> Relaxed:
        """Curves respaced and relaxed, then with twice the nodes again: the cost that this leads to, and its error."""
        settings = settings or self.usual
        fine, cost, gain = self._doubled(curves, settings)
        for _ in range(REPEATS):
            again = np.flatnonzero(gain > MOVED * cost)
            if not len(again):
                break
            others, cost[again], gain[again] = self._doubled(fine.take(again), settings)
            fine = fine.replaced(again, others)
        # The cost of a polygon falls with the square of its sides: a third of what the last doubling gained is left.
        error = np.clip(gain, 0.0, MOVED * cost) / 3
        return Relaxed(fine, cost - error, error)

    def _doubled(self, curves: Curves, settings: Relaxation) -> tuple[Curves, Array, Array]:
        """Curves relaxed with few nodes, then with twice as many; their exact cost, and what the doubling gained."""
        coarse = self.settled(self.spaced(curves, settings.spacing), settings.coarse, settings)
        fine = self.settled(self.resampled(coarse, 2 * coarse.counts - 1), settings.fine, settings)
        cost = self.cost(fine)
        return fine, cost, self.cost(coarse) - cost

    def gradients(self, curves: Curves) -> Array:
        """The gradients of the arrival time at the curves' first nodes, (B, T), as they have it: with their other nodes
        where the cost is least, it changes with the first one as the cost of the first segment does, and is as
        long as the slowness."""
        M = self.manifold
        x, to = (torch.from_numpy(curves.nodes[curves.offsets[:-1] + k]) for k in (0, 1))
        frame = M.frame(x)
        step = self.usual.spacing * 1e-3
        sides = [M.exp(x[:, None], sign * step * frame) for sign in (1, -1)]
        ends = to[:, None].expand_as(sides[0]).flatten(0, 1).numpy()
        ahead, behind = (self.segments(side.flatten(0, 1).numpy(), ends)[0] for side in sides)
        slopes = torch.from_numpy(ahead - behind).view(len(x), M.dim, 1)
        slopes = slopes / slopes.norm(dim=1, keepdim=True).clamp_min(torch.finfo(torch.float64).tiny)
        gradient: Array = (self.scene.slowness(x)[:, None] * (slopes * frame).sum(1)).numpy()
        return gradient


def _require(complete: int) -> None:
    if not complete:
        raise MemoryError("there is no memory to relax curves")


def _geometry(manifold: Manifold) -> _Geometry:
    """The manifold's own functions, as curves.c takes them."""
    names = ("exp_batch", "log_batch", "norm_batch", "distance_batch", "inner", "frame")
    return _Geometry(*addresses(manifold, names).values(), manifold.maps == "geodesic")


@lru_cache
def _library(dim: int, point_size: int, tangent_size: int) -> ctypes.CDLL:
    # What changes goes into the text, not into the flags: with FAST alone threads are compiled in where there are any.
    # By the first name alone glibc's headers declare exp for vectors; it allows the compiler nothing.
    sizes = {"__FAST_MATH__": 1, "DIM": dim, "POINT": point_size, "TANGENT": tangent_size}
    defines = "".join(f"#define {name} {value}\n" for name, value in sizes.items())
    library = compiled({SOURCE.name: defines + SOURCE.read_text(encoding="utf-8")}, SOURCE.name, FAST)
    for name, types in _SIGNATURES.items():
        function = getattr(library, name)
        function.restype, function.argtypes = ctypes.c_int, [_TYPES[letter] for letter in types]
    library.segments.restype, library.segment.restype = None, ctypes.c_double
    return library


# What the C functions take. n: a size, i: an int, d: a double, p: an address, g, m, s: a structure.
_TYPES: dict[str, Any] = {
    "n": ctypes.c_size_t, "i": ctypes.c_int, "d": ctypes.c_double, "p": ctypes.c_void_p,
    "g": ctypes.POINTER(_Geometry), "m": ctypes.POINTER(_Medium), "s": ctypes.POINTER(_Settings),
}  # fmt: skip
_SIGNATURES = {"segments": "nppgmnppdipp", "segment": "ppgmnppd", "resample": "nppppngi", "relax": "nppngmnpsi"}


def _address(array: Array) -> int:
    """Where the numbers of a contiguous array lie; the caller keeps the array."""
    assert array.flags.c_contiguous
    return array.ctypes.data
