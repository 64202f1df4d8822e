"""The chart must be the textbook's on the model spaces, agree with the manifold's own lengths, and refuse the rest."""

from __future__ import annotations

import math
from collections.abc import Callable

import plain_manifolds as plain
import pytest
import torch
from torch import Tensor

from rsrm_gen.errors import UserError
from rsrm_gen.manifold import Manifold
from rsrm_gen.trainer.conformal import ConformalChart, conformal_chart


def case(name: str) -> tuple[Manifold, Callable[[Tensor], Tensor]]:
    return {
        "plane": (plain.Euclidean(2), lambda r: r),
        "torus": (plain.FlatTorus(2), lambda r: r),
        "sphere": (plain.Sphere(2), lambda r: 2 * torch.tan(r / 2)),
        "sphere3": (plain.Sphere(3), lambda r: 2 * torch.tan(r / 2)),
        "hyperbolic": (plain.Hyperboloid(2), lambda r: 2 * torch.tanh(r / 2)),
        "hyperbolic3": (plain.Hyperboloid(3), lambda r: 2 * torch.tanh(r / 2)),
        "rotations": (plain.Rotations(), lambda r: 4 * torch.tan(r / 4)),
    }[name]


NAMES = ["plane", "torus", "sphere", "sphere3", "hyperbolic", "hyperbolic3", "rotations"]


def chart_around_somewhere(manifold: Manifold) -> ConformalChart:
    return conformal_chart(manifold, points_around(manifold, origin(manifold), 1)[0])


def origin(manifold: Manifold) -> Tensor:
    return manifold.project(torch.eye(manifold.point_size, dtype=torch.float64)[0])


def points_around(manifold: Manifold, center: Tensor, count: int) -> Tensor:
    generator = torch.Generator().manual_seed(3)
    return manifold.sample_ball(center, min(2.0, 0.95 * manifold.injectivity_radius), count, generator)


@pytest.mark.parametrize("name", NAMES)
def test_radius_is_the_textbook_one(name: str) -> None:
    manifold, rho = case(name)
    r = torch.linspace(0.0, 0.99 * min(manifold.injectivity_radius, 3.0), 50, dtype=torch.float64)
    chart = chart_around_somewhere(manifold)
    torch.testing.assert_close(chart.radius(r), rho(r), rtol=1e-11, atol=1e-13)


@pytest.mark.parametrize("name", NAMES)
def test_point_and_coordinates_are_inverse(name: str) -> None:
    manifold, _ = case(name)
    chart = chart_around_somewhere(manifold)
    x = torch.cat([chart.center[None], points_around(manifold, chart.center, 100)])
    assert manifold.distance(chart.point(chart.coordinates(x)), x).max() < 1e-7


@pytest.mark.parametrize("name", NAMES)
def test_lengths_of_curves_agree_with_the_metric_of_the_chart(name: str) -> None:
    manifold, _ = case(name)
    chart = chart_around_somewhere(manifold)
    ends = chart.coordinates(points_around(manifold, chart.center, 10))
    t = torch.linspace(0, 1, 2001, dtype=torch.float64)[:, None]
    line = ends[0] * (1 - t) + ends[1] * t
    polygon = manifold.distance(chart.point(line[:-1]), chart.point(line[1:])).sum()
    middle = (line[:-1] + line[1:]) / 2
    integral = (chart.factor(middle) * (line[1:] - line[:-1]).norm(dim=-1)).sum()
    torch.testing.assert_close(polygon, integral, rtol=1e-6, atol=0)


@pytest.mark.parametrize(("name", "copies"), [("plane", 1), ("torus", 9), ("sphere", 1), ("rotations", 2)])
def test_preimages_are_the_same_point(name: str, copies: int) -> None:
    manifold, _ = case(name)
    chart = chart_around_somewhere(manifold)
    x = points_around(manifold, chart.center, 30)
    preimages = chart.preimages(chart.coordinates(x))
    assert preimages.shape == (copies, 30, manifold.dim)
    assert manifold.distance(chart.point(preimages), x).max() < 1e-7
    apart = (preimages[:, None] - preimages[None, :]).norm(dim=-1) + 9 * torch.eye(copies)[..., None]
    assert apart.min() > 0.1


class Stretched(plain.Sphere):
    """A sphere whose metric is longer along one axis than its exp believes."""

    def inner(self, p: Tensor, u: Tensor, v: Tensor) -> Tensor:
        return (u * v * torch.tensor([1.0, 1.3, 1.0])).sum(-1)


class Cylinder(plain.FlatTorus):
    """The plane that says it had a finite injectivity radius, and no periods to explain it."""

    def __init__(self) -> None:
        super().__init__(2)
        self.periods = None


class Product:
    """A sphere times a line: geodesics and metric are right, but curvature depends on the direction."""

    name, dim, point_size, tangent_size = "product", 3, 4, 4
    injectivity_radius, diameter, periods = math.pi, math.inf, None

    def __init__(self) -> None:
        self.a = plain.Sphere(2)

    def exp(self, p: Tensor, v: Tensor) -> Tensor:
        return torch.cat([self.a.exp(p[..., :3], v[..., :3]), p[..., 3:] + v[..., 3:]], -1)

    def log(self, p: Tensor, q: Tensor) -> Tensor:
        return torch.cat([self.a.log(p[..., :3], q[..., :3]), q[..., 3:] - p[..., 3:]], -1)

    def inner(self, p: Tensor, u: Tensor, v: Tensor) -> Tensor:
        return (u * v).sum(-1)

    def log_abs_det(self, p: Tensor, q: Tensor) -> Tensor:
        return self.a.log_abs_det(p[..., :3], q[..., :3])

    def frame(self, p: Tensor) -> Tensor:
        top = torch.nn.functional.pad(self.a.frame(p[..., :3]), (0, 1))
        last = torch.zeros_like(top[..., :1, :])
        last[..., 3] = 1
        return torch.cat([top, last], -2)


@pytest.mark.parametrize("manifold", [Stretched(2), Cylinder(), Product()], ids=lambda m: type(m).__name__)
def test_a_manifold_that_is_not_isotropic_is_refused(manifold: Manifold) -> None:
    center = torch.zeros(manifold.point_size, dtype=torch.float64)
    center[0] = 1
    with pytest.raises(UserError, match="no reference solver for"):
        conformal_chart(manifold, center)
