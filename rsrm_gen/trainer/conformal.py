"""Isothermal coordinates of a manifold of constant curvature, found from its own exp, log and log-determinant.

Where all directions at all points look alike the curvature kappa is constant (Schur), and in geodesic polar coordinates
around any o the metric is dr^2 + sn(r)^2 dtheta^2 with |det D Log_o| = (r / sn(r))^(d-1): the log-determinant at one
point tells kappa. Then y = rho(r) * direction with

    rho = (2 / k) tan(k r / 2),  g = lambda^2 |dy|^2,  lambda = sn(r) / rho = 1 / (1 + kappa |y|^2 / 4)

with k = sqrt(kappa) (tanh for negative curvature, rho = r for none) is conformal. Nothing of this is taken on trust:
`conformal_chart` measures the pulled-back metric before it hands the chart out.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import torch
from torch import Generator, Tensor

from rsrm_gen.errors import UserError
from rsrm_gen.manifold import Manifold

PROBES = 64
TOLERANCE = 1e-5  # of the pulled-back metric; central differences with a step of 1e-4 leave about 1e-8
NEARLY = 1e-12  # how near to infinity the chart goes, as an angle
FLATNESS = 1e-9  # a smaller curvature, in units of the probing radius, is a rounding error of zero


@dataclass(frozen=True)
class ConformalChart:
    """Isothermal coordinates y (..., d) around `center` (D), along the orthonormal `frame` (d, T) there.

    They cover the universal cover of the manifold (less one point when it is closed): every point of the manifold has
    as many coordinates as `preimages` lists.
    """

    manifold: Manifold
    center: Tensor
    frame: Tensor
    curvature: float
    periods: Tensor  # (m, d): the translations that lead back to the same point of a flat manifold
    antipodal: bool  # y and its antipode in the cover are the same point

    @property
    def simply_connected(self) -> bool:
        """Whether every point has exactly one coordinate."""
        return not self.antipodal and len(self.periods) == 0

    @property
    def closed_by_a_point(self) -> bool:
        """Whether the cover is closed: |y| -> inf is one point, opposite the centre."""
        return self.curvature > 0

    def radius(self, r: Tensor | float) -> Tensor:
        """rho = |y| at the geodesic distance r from the centre (in the cover)."""
        r = torch.as_tensor(r, dtype=torch.float64)
        if self.curvature == 0:
            return r
        k = math.sqrt(abs(self.curvature))
        if self.curvature > 0:
            return 2 / k * torch.tan((k * r / 2).clamp_max(math.pi / 2 - NEARLY))
        return 2 / k * torch.tanh(k * r / 2)

    def geodesic_radius(self, rho: Tensor | float) -> Tensor:
        """The inverse of `radius`."""
        rho = torch.as_tensor(rho, dtype=torch.float64)
        if self.curvature == 0:
            return rho
        k = math.sqrt(abs(self.curvature))
        return 2 / k * (torch.atan(k * rho / 2) if self.curvature > 0 else torch.atanh(k * rho / 2))

    def factor(self, y: Tensor) -> Tensor:
        """lambda(y) of the metric lambda^2 |dy|^2: (..., d) to (...)."""
        return 1 / (1 + self.curvature / 4 * (y * y).sum(-1))

    def point(self, y: Tensor) -> Tensor:
        """The points (..., D) with coordinates y (..., d)."""
        rho = y.norm(dim=-1, keepdim=True)
        stretch: Tensor = torch.where(
            rho > 0, self.geodesic_radius(rho) / rho.clamp_min(torch.finfo(y.dtype).tiny), 1.0
        )
        return self.manifold.exp(self.center, (y * stretch) @ self.frame)

    def coordinates(self, x: Tensor) -> Tensor:
        """The coordinates (..., d) of the points x (..., D), of all preimages the one nearest to the centre."""
        v = self.manifold.log(self.center, x)
        a = self.manifold.inner(self.center, v.unsqueeze(-2), self.frame)
        length = a.norm(dim=-1, keepdim=True)
        # The distance, not |a|: opposite the centre the logarithm has no direction, and may have no length.
        r = self.manifold.distance(self.center, x).unsqueeze(-1)
        direction = torch.where(length > 0, a / length.clamp_min(torch.finfo(a.dtype).tiny), self._first_axis(a))
        return direction * self.radius(r)

    @staticmethod
    def _first_axis(like: Tensor) -> Tensor:
        return torch.eye(like.shape[-1], dtype=like.dtype)[0]

    def preimages(self, y: Tensor) -> Tensor:
        """The coordinates (copies, N, d) in the cover of the points with coordinates y (N, d), the nearest ones."""
        if self.antipodal:
            square = (y * y).sum(-1, keepdim=True).clamp_min(torch.finfo(y.dtype).tiny)
            return torch.stack([y, -4 / self.curvature * y / square])
        steps = list(itertools.product((0.0, -1.0, 1.0), repeat=len(self.periods)))
        shifts = torch.tensor(steps, dtype=y.dtype).reshape(len(steps), -1) @ self.periods
        return y + shifts[:, None, :]


def conformal_chart(manifold: Manifold, center: Tensor) -> ConformalChart:
    """The chart around a point (D), checked; a manifold that has none is a `UserError`."""
    center = center.double()
    frame = manifold.frame(center)
    curvature = _curvature(manifold, center, frame)
    periods = _period_vectors(manifold, center, frame)
    chart = ConformalChart(manifold, center, frame, curvature, periods, _is_antipodal(manifold, curvature))
    _check_metric(chart)
    _check_cover(chart)
    return chart


def _refusal(manifold: Manifold, why: str) -> UserError:
    message = f"no reference solver for {manifold.name}: its metric is not conformally flat around every point"
    return UserError(f"{message} ({why})", hint="planning and training work without a reference; evaluation does not")


def _probing_radius(manifold: Manifold) -> float:
    return min(manifold.injectivity_radius / 2, 1.0)


def _curvature(manifold: Manifold, center: Tensor, frame: Tensor) -> float:
    """Solves sn_kappa(r) / r = |det D Log|^(-1/(d-1)) for kappa, at one point at the distance r."""
    if manifold.dim == 1:
        return 0.0
    r = _probing_radius(manifold)
    log_det = manifold.log_abs_det(center, manifold.exp(center, r * frame[0]))
    shrink = math.exp(-float(log_det) / (manifold.dim - 1))
    low, high = -1e4, math.pi**2  # in units of 1/r^2; the ratio falls from huge to 0 between them
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if _sine_ratio(middle) > shrink else (low, middle)
    return 0.0 if abs(low) < FLATNESS else low / r**2


def _sine_ratio(t: float) -> float:
    """sn_kappa(r) / r as a function of t = kappa r^2."""
    if abs(t) < 1e-4:
        return 1 - t / 6 * (1 - t / 20 * (1 - t / 42))
    root = math.sqrt(abs(t))
    return (math.sin(root) if t > 0 else math.sinh(root)) / root


def _period_vectors(manifold: Manifold, center: Tensor, frame: Tensor) -> Tensor:
    """Components (m, d) in the frame of one period along each periodic coordinate."""
    periods = manifold.periods or ()
    unit = torch.eye(manifold.point_size, dtype=torch.float64)
    vectors = [period * unit[i] for i, period in enumerate(periods) if period is not None]
    if not vectors:
        return torch.zeros(0, manifold.dim, dtype=torch.float64)
    return manifold.inner(center, manifold.to_tangent(center, torch.stack(vectors)).unsqueeze(-2), frame)


def _is_antipodal(manifold: Manifold, curvature: float) -> bool:
    """Two closed spaces of positive curvature are known: the simply connected one, and it with antipodes joined."""
    if curvature <= 0:
        return False
    fraction = manifold.injectivity_radius * math.sqrt(curvature) / math.pi
    if min(abs(fraction - 1), abs(fraction - 0.5)) > 1e-6:
        raise _refusal(manifold, "or its shape in the large is not one that is known here")
    return abs(fraction - 0.5) < 1e-6


def _check_metric(chart: ConformalChart) -> None:
    """Central differences of `point` at random y must give lambda^2 times the identity, and so must other centres."""
    manifold, d = chart.manifold, chart.manifold.dim
    y = _probes(chart)
    step = 1e-4 * _probing_radius(manifold)
    x = chart.point(y)
    ahead, behind = (chart.point(y[:, None] + sign * step * torch.eye(d, dtype=y.dtype)) for sign in (1, -1))
    columns = (manifold.log(x[:, None], ahead) - manifold.log(x[:, None], behind)) / (2 * step)
    gram = manifold.inner(x[:, None, None], columns[:, :, None], columns[:, None, :])
    wanted = chart.factor(y)[:, None, None] ** 2 * torch.eye(d, dtype=y.dtype)
    if not bool(((gram - wanted).abs() <= TOLERANCE * wanted.amax(-1, keepdim=True)).all()):
        raise _refusal(manifold, "measured by differences of its exp")
    if any(abs(_curvature(manifold, o, manifold.frame(o)) - chart.curvature) > TOLERANCE for o in x[:4]):
        raise _refusal(manifold, "its curvature changes from point to point")


def _probes(chart: ConformalChart) -> Tensor:
    r = torch.linspace(0.02, 1, PROBES, dtype=torch.float64)[:, None] * _probing_radius(chart.manifold)
    return random_directions(PROBES, chart.manifold.dim) * chart.radius(r)


def random_directions(count: int, dim: int) -> Tensor:
    """Unit vectors (count, dim), uniform and every time the same."""
    v = torch.randn(count, dim, generator=Generator().manual_seed(0), dtype=torch.float64)
    length: Tensor = v.norm(dim=-1, keepdim=True)
    return v / length


def _check_cover(chart: ConformalChart) -> None:
    """All preimages of a point must be that point, and a finite injectivity radius must come from them."""
    y = _probes(chart)
    copies = chart.point(chart.preimages(y))
    if float(chart.manifold.distance(copies, copies[0]).max()) > TOLERANCE:
        raise _refusal(chart.manifold, "or its periods do not lead back to the same point")
    finite = math.isfinite(chart.manifold.injectivity_radius)
    if finite and chart.simply_connected and not chart.closed_by_a_point:
        raise _refusal(chart.manifold, "or its shape in the large is not one that is known here")
