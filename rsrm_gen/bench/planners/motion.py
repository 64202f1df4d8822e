"""What a motion costs, for planners that ask for one at a time and by the million: the generated C code and little around it."""

from __future__ import annotations

import ctypes
import math
from collections.abc import Sequence

import numpy as np
import torch

from rsrm_gen.bench.planners.layout import Layout, NormalCoordinates
from rsrm_gen.rows import addresses
from rsrm_gen.trainer.curves import Array, Curves, Terrain

Key = tuple[float, ...]
CLOSE = 0.02  # between points where the clearance of a path is looked at; in units of the scene's smallest length
DISTANCE = ctypes.CFUNCTYPE(ctypes.c_double, ctypes.c_void_p, ctypes.c_void_p)


class Motions:
    """Motions between points that a planner names by its own numbers: each point is computed once."""

    def __init__(self, layout: Layout) -> None:
        scene = layout.scene
        self.layout, self.terrain = layout, Terrain(scene)
        self._least = min(scene.law.free, scene.law.obstacle) if len(scene.radii) else scene.law.free
        # A retraction is no shortest way, so that its length bounds nothing from below.
        self._bounded = scene.manifold.maps == "geodesic"
        self._distance = DISTANCE(addresses(scene.manifold, ["distance"])["distance"])
        self._segment = self.terrain.one_by_one()
        self._points: dict[Key, tuple[Array, int]] = {}
        forbidden = scene.radii.tolist() if scene.forbid_obstacles else []
        self._forbidden = [
            (center.numpy(), r) for center, r in zip(scene.centers.contiguous(), forbidden, strict=False)
        ]
        # Of the ball in normal coordinates, where points are sampled; those on its rim are still inside.
        self._radius = (1 + 1e-9) * layout.radius if isinstance(layout, NormalCoordinates) else None

    @property
    def count(self) -> int:
        """How many points were asked about."""
        return len(self._points)

    def cost(self, a: Key, b: Key) -> float:
        """The integral of the slowness along the geodesic from a to b."""
        return self._segment(self._address(a), self._address(b))

    def bound(self, a: Key, b: Key) -> float:
        """No path from a to b costs less: the least slowness times their distance."""
        return self._least * self._distance(self._address(a), self._address(b)) if self._bounded else 0.0

    def inside(self, a: Key) -> bool:
        """Whether a is in the domain, and outside of obstacles where the scene forbids them."""
        if self._radius is not None and math.hypot(*a) > self._radius:
            return False
        return all(self._from(a, center) >= radius for center, radius in self._forbidden)

    def point(self, a: Key) -> Array:
        """The point (D,) of the manifold."""
        self._address(a)
        return self._points[a][0]

    def path_cost(self, path: Sequence[Array]) -> float:
        """The exact cost of points (D,) joined by geodesics."""
        return float(self.terrain.cost(Curves.of([np.stack(path)]))[0]) if len(path) > 1 else 0.0

    def clearance(self, path: Sequence[Array]) -> float:
        """The least signed distance along points (D,) joined by geodesics."""
        spaced = self.terrain.spaced(Curves.of([np.stack(path)]), CLOSE * self.terrain.unit)
        return float(self.layout.scene.signed_distance(torch.from_numpy(spaced.nodes)).min())

    def _from(self, a: Key, center: Array) -> float:
        return float(self._distance(self._address(a), center.ctypes.data))

    def _address(self, a: Key) -> int:
        found = self._points.get(a)
        if found is None:
            x = np.ascontiguousarray(self.layout.point(a).numpy())
            found = self._points[a] = (x, x.ctypes.data)
        return found[1]
