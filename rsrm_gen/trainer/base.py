"""What the link multiplies: b(x), near the goal its distance, and positive elsewhere (T = b exp(f), T = b / tau).

The distance d itself has a kink wherever two shortest geodesics to the goal meet, and no sum of splats takes that away
again. So where geometry allows, b is smooth there:

    a chart that has periods and a metric that is the same everywhere: each periodic component l of Log_goal(x), which jumps
    at half a period P, becomes (P / pi) sin(pi l / P), whose square is smooth and whose zero is the goal alone;
    a manifold on which every geodesic stops being shortest at one distance R, its diameter and its injectivity radius:
    b = (2 R / pi) sin(pi d / (2 R)), whose square is a function of cos(pi d / R), smooth where geodesics meet;
    any other: d.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import torch
from torch import Tensor

from rsrm_gen.manifold import Manifold


class Base(Protocol):
    """A function of points like the distance to a goal."""

    def value(self, x: Tensor) -> Tensor:
        """b (N,) at x (N, D)."""
        ...

    def value_and_gradient(self, x: Tensor) -> tuple[Tensor, Tensor]:
        """b (N,) and its Riemannian gradient (N, T) at x (N, D); that is zero at the goal itself, where b has a cone."""
        ...


@dataclass(frozen=True)
class Distance:
    """b = d."""

    manifold: Manifold
    goal: Tensor  # (D,)

    @torch.no_grad()
    def value(self, x: Tensor) -> Tensor:
        """d."""
        return self.manifold.distance(x, self.goal.expand_as(x))

    @torch.no_grad()
    def value_and_gradient(self, x: Tensor) -> tuple[Tensor, Tensor]:
        """d and grad d = -Log_x(goal) / d, which is so for geodesics alone."""
        if self.manifold.maps != "geodesic":
            return self._differentiated(x)
        d = self.value(x)
        toward = self.manifold.log(x, self.goal.expand_as(x))
        return d, toward / -torch.where(d > 0, d, 1.0)[:, None]

    def _differentiated(self, x: Tensor) -> tuple[Tensor, Tensor]:
        """The length of a retraction's inverse, and its gradient by the framework."""
        with torch.enable_grad():
            p = x.detach().clone().requires_grad_()
            d = self.manifold.distance(p, self.goal.expand_as(p))
            (by_x,) = torch.autograd.grad(d.sum(), p)
        return d.detach(), self.manifold.riemannian_gradient(x, by_x)


@dataclass(frozen=True)
class Chord:
    """b = (2 R / pi) sin(pi d / (2 R)), R the distance at which every geodesic from the goal stops being shortest."""

    distance: Distance
    radius: float

    def value(self, x: Tensor) -> Tensor:
        """b."""
        return self._of(self.distance.value(x))

    def value_and_gradient(self, x: Tensor) -> tuple[Tensor, Tensor]:
        """b and cos(pi d / (2 R)) grad d."""
        d, away = self.distance.value_and_gradient(x)
        return self._of(d), torch.cos(math.pi / (2 * self.radius) * d)[:, None] * away

    def _of(self, d: Tensor) -> Tensor:
        return 2 * self.radius / math.pi * torch.sin(math.pi / (2 * self.radius) * d)


@dataclass(frozen=True)
class PeriodicChord:
    """b = |c|_g, c the components of x - goal in a chart whose metric is constant, the periodic ones as chords."""

    manifold: Manifold
    goal: Tensor  # (D,)
    rates: Tensor  # (D,), pi / period; 0 where there is none

    @torch.no_grad()
    def value(self, x: Tensor) -> Tensor:
        """b."""
        return self._parts(x)[0]

    @torch.no_grad()
    def value_and_gradient(self, x: Tensor) -> tuple[Tensor, Tensor]:
        """b and its gradient: that of <c, c> / 2 is c with each component times its own derivative."""
        b, chord, slope = self._parts(x)
        by_coordinate = slope * self.manifold.flat(x, chord) / torch.where(b > 0, b, 1.0)[:, None]
        return b, self.manifold.riemannian_gradient(x, by_coordinate)

    def _parts(self, x: Tensor) -> tuple[Tensor, Tensor, Tensor]:
        """b (N,), c (N, D) and what each component of c gains with its coordinate (N, D)."""
        goal = self.goal.expand_as(x)
        away = self.manifold.log(goal, x)
        rate = torch.where(self.rates > 0, self.rates, 1.0)
        chord = torch.where(self.rates > 0, torch.sin(rate * away) / rate, away)
        slope = torch.where(self.rates > 0, torch.cos(rate * away), 1.0)
        return self.manifold.norm(goal, chord), chord, slope


def smooth_base(manifold: Manifold, goal: Tensor) -> Base:
    """The smoothest b known for the geometry, from what the manifold says of itself; goal is (D,)."""
    distance = Distance(manifold, goal)
    periods = manifold.periods or ()
    if any(periods) and manifold.tangent_size == manifold.point_size and _is_flat(manifold, goal):
        rates = [0.0 if period is None else math.pi / period for period in periods]
        return PeriodicChord(manifold, goal, goal.new_tensor(rates))
    if math.isfinite(manifold.diameter) and math.isclose(manifold.diameter, manifold.injectivity_radius, rel_tol=1e-6):
        return Chord(distance, manifold.diameter)
    return distance


def metric_varies(manifold: Manifold, p: Tensor) -> bool:
    """Whether <u, v>_p has p in its formula; p is any point (D,)."""
    p = p.detach().clone().requires_grad_()
    with torch.enable_grad():
        return manifold.flat(p, p.new_ones(manifold.tangent_size)).requires_grad


def _is_flat(manifold: Manifold, goal: Tensor) -> bool:
    """Whether the metric of a chart has no coordinate in its formula, and geodesics are straight lines."""
    if metric_varies(manifold, goal) or manifold.maps != "geodesic":
        return False
    v = torch.eye(len(goal), dtype=goal.dtype) / 8
    ends = manifold.exp(goal.expand_as(v), v)
    return torch.allclose(manifold.project(goal + v), manifold.project(ends), rtol=0, atol=1e-5)
