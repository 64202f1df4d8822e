"""Five manifolds written out by hand behind the `Manifold` protocol: the truth that tests compare with.

Nothing here is generated and nothing is fast. Each class states its geometry in closed form; the splat and its gradient
follow from `log`, `log_abs_det` and torch's autograd. Letters: p, q points, u, v tangent vectors, r or t a distance.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import torch
from torch import Generator, Tensor


class Plain:
    """What follows for every manifold from its own `exp`, `log`, `inner`, `frame`, `log_abs_det`."""

    name: str
    dim: int
    point_size: int
    tangent_size: int
    injectivity_radius: float
    diameter: float
    periods: tuple[float | None, ...] | None = None
    maps: str = "geodesic"

    @property
    def content_hash(self) -> str:
        return f"plain {self.name}"

    def exp(self, p: Tensor, v: Tensor) -> Tensor: ...
    def log(self, p: Tensor, q: Tensor) -> Tensor: ...
    def distance(self, p: Tensor, q: Tensor) -> Tensor: ...
    def log_abs_det(self, p: Tensor, q: Tensor) -> Tensor: ...
    def project(self, x: Tensor) -> Tensor: ...
    def to_tangent(self, p: Tensor, x: Tensor) -> Tensor: ...
    def flat(self, p: Tensor, v: Tensor) -> Tensor: ...
    def frame(self, p: Tensor) -> Tensor: ...
    def riemannian_gradient(self, p: Tensor, df: Tensor) -> Tensor: ...

    def sphere_area(self, r: Tensor) -> Tensor:
        """The area of the geodesic sphere of radius r, up to a constant factor."""

    def sample(self, count: int, generator: Generator | None = None, like: Tensor | None = None) -> Tensor:
        raise ValueError(f"{self.name} is not compact")

    def inner(self, p: Tensor, u: Tensor, v: Tensor) -> Tensor:
        return (self.flat(p, u) * v).sum(-1)

    def norm(self, p: Tensor, v: Tensor) -> Tensor:
        square = self.inner(p, v, v)
        zero = square <= 0
        return torch.where(zero, 0.0, torch.where(zero, 1.0, square).sqrt())

    def gradient_norm(self, p: Tensor, df: Tensor) -> Tensor:
        return self.norm(p, self.riemannian_gradient(p, df))

    def sample_ball(self, center: Tensor, radius: float, count: int, generator: Generator | None = None) -> Tensor:
        r = torch.linspace(0, radius, 4097, dtype=torch.float64)
        cdf = torch.cumulative_trapezoid(self.sphere_area(r), r)
        cdf = torch.cat([torch.zeros(1, dtype=cdf.dtype), cdf])
        drawn = torch.rand(count, generator=generator, dtype=torch.float64) * cdf[-1]
        after = torch.searchsorted(cdf, drawn).clamp(1, 4096)
        fraction = (drawn - cdf[after - 1]) / (cdf[after] - cdf[after - 1])
        lengths = (r[after - 1] + fraction * (r[1] - r[0])).to(center)
        directions = torch.randn(count, self.dim, generator=generator, dtype=torch.float64).to(center)
        directions = directions / directions.norm(dim=-1, keepdim=True)
        return self.exp(center.expand(count, -1), lengths[:, None] * (directions @ self.frame(center)))

    def _splat_values(self, x: Tensor, mu: Tensor, W: Tensor, amplitude: Tensor) -> Tensor:
        z = (W @ self.log(mu, x)[..., None])[..., 0]
        return amplitude * torch.exp(-(z * z).sum(-1) / 2 + self.log_abs_det(mu, x))

    def _with_gradient(self, value: Callable[[Tensor], Tensor], x: Tensor) -> tuple[Tensor, Tensor]:
        wanted = torch.is_grad_enabled()
        with torch.enable_grad():
            x = x if x.requires_grad else x.detach().requires_grad_()
            f = value(x)
            (df,) = torch.autograd.grad(f.sum(), x, create_graph=True)
            gradient = self.riemannian_gradient(x, df)
        return (f, gradient) if wanted else (f.detach(), gradient.detach())

    def splat(self, x: Tensor, mu: Tensor, W: Tensor, amplitude: Tensor) -> tuple[Tensor, Tensor]:
        shape = torch.broadcast_shapes(x.shape[:-1], mu.shape[:-1], W.shape[:-2], amplitude.shape)
        return self._with_gradient(lambda y: self._splat_values(y, mu, W, amplitude), x.expand(*shape, self.point_size))

    def splats(
        self, x: Tensor, mu: Tensor, W: Tensor, amplitude: Tensor, width: Tensor | None = None
    ) -> tuple[Tensor, Tensor]:
        return self._with_gradient(lambda y: self._splat_values(y[:, None], mu, W, amplitude).sum(1), x)

    def splats_value(self, x: Tensor, mu: Tensor, W: Tensor, amplitude: Tensor) -> Tensor:
        return self._splat_values(x[:, None], mu, W, amplitude).sum(1)

    def kernels(self, like: Tensor) -> str:
        return f"autograd, {like.device.type}"


class Euclidean(Plain):
    """R^n."""

    def __init__(self, n: int = 2) -> None:
        self.name = f"plain R^{n}"
        self.dim = self.point_size = self.tangent_size = n
        self.injectivity_radius = self.diameter = math.inf
        self.periods = (None,) * n

    def exp(self, p: Tensor, v: Tensor) -> Tensor:
        return self.project(p + v)

    def log(self, p: Tensor, q: Tensor) -> Tensor:
        return q - p

    def distance(self, p: Tensor, q: Tensor) -> Tensor:
        return self.norm(p, self.log(p, q))

    def log_abs_det(self, p: Tensor, q: Tensor) -> Tensor:
        return (0 * (p + q)).sum(-1)

    def project(self, x: Tensor) -> Tensor:
        return x

    def to_tangent(self, p: Tensor, x: Tensor) -> Tensor:
        return x + 0 * p

    def flat(self, p: Tensor, v: Tensor) -> Tensor:
        return v + 0 * p

    def frame(self, p: Tensor) -> Tensor:
        return torch.eye(self.dim, dtype=p.dtype).expand(*p.shape[:-1], -1, -1)

    def riemannian_gradient(self, p: Tensor, df: Tensor) -> Tensor:
        return df + 0 * p

    def sphere_area(self, r: Tensor) -> Tensor:
        return r ** (self.dim - 1)


class FlatTorus(Euclidean):
    """(R / 2 pi Z)^n, as angles in [-pi, pi)."""

    def __init__(self, n: int = 2) -> None:
        super().__init__(n)
        self.name = f"plain T^{n}"
        self.injectivity_radius = math.pi
        self.diameter = math.pi * math.sqrt(n)
        self.periods = (2 * math.pi,) * n

    def log(self, p: Tensor, q: Tensor) -> Tensor:
        return self.project(q - p)

    def project(self, x: Tensor) -> Tensor:
        return x - 2 * math.pi * torch.floor((x + math.pi) / (2 * math.pi)).detach()

    def sample(self, count: int, generator: Generator | None = None, like: Tensor | None = None) -> Tensor:
        x = math.pi * (2 * torch.rand(count, self.dim, generator=generator, dtype=torch.float64) - 1)
        return x.to(torch.get_default_dtype() if like is None else like.dtype)


class Sphere(Plain):
    """The unit sphere S^n in R^(n+1); tangent vectors are ambient."""

    def __init__(self, n: int = 2) -> None:
        self.name = f"plain S^{n}"
        self.dim = n
        self.point_size = self.tangent_size = n + 1
        self.injectivity_radius = self.diameter = math.pi

    def _angle(self, p: Tensor, q: Tensor) -> tuple[Tensor, Tensor]:
        """The angle t where the points are apart (1 elsewhere), and t / sin t, smooth also where they coincide."""
        chord2 = ((q - p) ** 2).sum(-1)
        near = chord2 < 1e-4
        sum2 = ((q + p) ** 2).sum(-1).clamp_min(1e-30)  # the antipode is the cut locus: finite there, no more
        t = 2 * torch.atan2(torch.where(near, 1.0, chord2).sqrt(), sum2.sqrt())
        t2 = chord2 + chord2**2 / 12 + chord2**3 / 90 + chord2**4 / 560
        series = 1 + t2 / 6 + 7 * t2**2 / 360 + 31 * t2**3 / 15120
        return t, torch.where(near, series, t / torch.sin(torch.where(near, 1.0, t)))

    def exp(self, p: Tensor, v: Tensor) -> Tensor:
        square = (v * v).sum(-1, keepdim=True)
        near = square < 1e-4
        t = torch.where(near, 1.0, square).sqrt()
        cos = torch.where(near, 1 - square / 2 + square**2 / 24 - square**3 / 720, torch.cos(t))
        sinc = torch.where(near, 1 - square / 6 + square**2 / 120 - square**3 / 5040, torch.sin(t) / t)
        return self.project(cos * p + sinc * v)

    def log(self, p: Tensor, q: Tensor) -> Tensor:
        return self._angle(p, q)[1][..., None] * (q - (p * q).sum(-1, keepdim=True) * p)

    def distance(self, p: Tensor, q: Tensor) -> Tensor:
        chord, total = (q - p).norm(dim=-1), (q + p).norm(dim=-1)
        return 2 * torch.atan2(chord, total)

    def log_abs_det(self, p: Tensor, q: Tensor) -> Tensor:
        return (self.dim - 1) * self._angle(p, q)[1].log()

    def project(self, x: Tensor) -> Tensor:
        return x / x.norm(dim=-1, keepdim=True)

    def to_tangent(self, p: Tensor, x: Tensor) -> Tensor:
        return x - (p * x).sum(-1, keepdim=True) * p

    def flat(self, p: Tensor, v: Tensor) -> Tensor:
        return v + 0 * p

    def frame(self, p: Tensor) -> Tensor:
        return torch.linalg.svd(p[..., None, :])[2][..., 1:, :]

    def riemannian_gradient(self, p: Tensor, df: Tensor) -> Tensor:
        return self.to_tangent(p, df)

    def sample(self, count: int, generator: Generator | None = None, like: Tensor | None = None) -> Tensor:
        x = torch.randn(count, self.point_size, generator=generator, dtype=torch.float64)
        return self.project(x).to(torch.get_default_dtype() if like is None else like.dtype)

    def sphere_area(self, r: Tensor) -> Tensor:
        return torch.sin(r) ** (self.dim - 1)


class Hyperboloid(Plain):
    """H^n as the sheet <p, p> = -1, p0 > 0 with <u, v> = -u0 v0 + u1 v1 + ...; the time coordinate is the first."""

    def __init__(self, n: int = 2) -> None:
        self.name = f"plain H^{n}"
        self.dim = n
        self.point_size = self.tangent_size = n + 1
        self.injectivity_radius = self.diameter = math.inf

    @staticmethod
    def lorentz(u: Tensor, v: Tensor) -> Tensor:
        return (u[..., 1:] * v[..., 1:]).sum(-1) - u[..., 0] * v[..., 0]

    def _distance(self, p: Tensor, q: Tensor) -> tuple[Tensor, Tensor, Tensor]:
        """The distance r where the points are apart (else of no meaning), r / sinh r, and cosh r - 1."""
        chord2 = self.lorentz(q - p, q - p)
        near = chord2 < 1e-4
        r = 2 * torch.asinh(torch.where(near, 1.0, chord2).sqrt() / 2)
        r2 = chord2 - chord2**2 / 12 + chord2**3 / 90 - chord2**4 / 560
        series = 1 - r2 / 6 + 7 * r2**2 / 360 - 31 * r2**3 / 15120
        return r, torch.where(near, series, r / torch.sinh(r)), chord2 / 2

    def exp(self, p: Tensor, v: Tensor) -> Tensor:
        square = self.lorentz(v, v)[..., None]
        near = square < 1e-4
        r = torch.where(near, 1.0, square).sqrt()
        cosh = torch.where(near, 1 + square / 2 + square**2 / 24 + square**3 / 720, torch.cosh(r))
        sinhc = torch.where(near, 1 + square / 6 + square**2 / 120 + square**3 / 5040, torch.sinh(r) / r)
        return self.project(cosh * p + sinhc * v)

    def log(self, p: Tensor, q: Tensor) -> Tensor:
        _, ratio, excess = self._distance(p, q)
        return ratio[..., None] * (q - p - excess[..., None] * p)

    def distance(self, p: Tensor, q: Tensor) -> Tensor:
        return 2 * torch.asinh(self.lorentz(q - p, q - p).clamp_min(0).sqrt() / 2)

    def log_abs_det(self, p: Tensor, q: Tensor) -> Tensor:
        return (self.dim - 1) * self._distance(p, q)[1].log()

    def project(self, x: Tensor) -> Tensor:
        space = x[..., 1:]
        return torch.cat([(1 + (space * space).sum(-1, keepdim=True)).sqrt(), space], -1)

    def to_tangent(self, p: Tensor, x: Tensor) -> Tensor:
        return x + self.lorentz(p, x)[..., None] * p

    def flat(self, p: Tensor, v: Tensor) -> Tensor:
        v = v + 0 * p
        return torch.cat([-v[..., :1], v[..., 1:]], -1)

    def frame(self, p: Tensor) -> Tensor:
        """The boost that takes the apex to p, applied to the basis at the apex."""
        space = p[..., 1:]
        eye = torch.eye(self.dim, dtype=p.dtype)
        return torch.cat(
            [space[..., :, None], eye + space[..., :, None] * space[..., None, :] / (1 + p[..., :1, None])], -1
        )

    def riemannian_gradient(self, p: Tensor, df: Tensor) -> Tensor:
        return self.to_tangent(p, torch.cat([-df[..., :1], df[..., 1:]], -1))

    def sphere_area(self, r: Tensor) -> Tensor:
        return torch.sinh(r) ** (self.dim - 1)


class Rotations(Plain):
    """SO(3) as unit quaternions (w, x, y, z), q ~ -q; tangent vectors are body angular velocities: q = p Exp(v)."""

    def __init__(self) -> None:
        self.name = "plain SO(3)"
        self.dim = self.tangent_size = 3
        self.point_size = 4
        self.injectivity_radius = self.diameter = math.pi

    @staticmethod
    def product(p: Tensor, q: Tensor) -> Tensor:
        p, q = torch.broadcast_tensors(p, q)
        w = p[..., :1] * q[..., :1] - (p[..., 1:] * q[..., 1:]).sum(-1, keepdim=True)
        v = p[..., :1] * q[..., 1:] + q[..., :1] * p[..., 1:] + torch.linalg.cross(p[..., 1:], q[..., 1:])
        return torch.cat([w, v], -1)

    @staticmethod
    def conjugate(p: Tensor) -> Tensor:
        return torch.cat([p[..., :1], -p[..., 1:]], -1)

    def _relative(self, p: Tensor, q: Tensor) -> tuple[Tensor, Tensor]:
        """The vector part n of p^-1 q with w >= 0, and (t / 2) / |n| with t the angle; smooth where p = q."""
        relative = self.product(self.conjugate(p), q)
        relative = torch.where(relative[..., :1] < 0, -relative, relative)
        w, n = relative[..., 0], relative[..., 1:]
        n2 = (n * n).sum(-1)
        near = n2 < 1e-4
        length = torch.where(near, 1.0, n2).sqrt()
        series = 1 + n2 / 6 + 3 * n2**2 / 40 + 15 * n2**3 / 336 + 105 * n2**4 / 3456
        return n, torch.where(near, series, torch.atan2(length, w) / length)

    def exp(self, p: Tensor, v: Tensor) -> Tensor:
        square = (v * v).sum(-1, keepdim=True) / 4
        near = square < 1e-4
        t = torch.where(near, 1.0, square).sqrt()
        cos = torch.where(near, 1 - square / 2 + square**2 / 24 - square**3 / 720, torch.cos(t))
        sinc = torch.where(near, 1 - square / 6 + square**2 / 120 - square**3 / 5040, torch.sin(t) / t)
        return self.project(self.product(p, torch.cat([cos, sinc * v / 2], -1)))

    def log(self, p: Tensor, q: Tensor) -> Tensor:
        n, ratio = self._relative(p, q)
        return 2 * ratio[..., None] * n

    def distance(self, p: Tensor, q: Tensor) -> Tensor:
        return self.norm(p, self.log(p, q))

    def log_abs_det(self, p: Tensor, q: Tensor) -> Tensor:
        return 2 * self._relative(p, q)[1].log()

    def project(self, x: Tensor) -> Tensor:
        return x / x.norm(dim=-1, keepdim=True)

    def to_tangent(self, p: Tensor, x: Tensor) -> Tensor:
        return 2 * self.product(self.conjugate(p), x)[..., 1:]

    def flat(self, p: Tensor, v: Tensor) -> Tensor:
        return v + 0 * p[..., :3]

    def frame(self, p: Tensor) -> Tensor:
        return torch.eye(3, dtype=p.dtype).expand(*p.shape[:-1], -1, -1)

    def riemannian_gradient(self, p: Tensor, df: Tensor) -> Tensor:
        """d/dv of f(p Exp(v)) at v = 0: the derivative of p Exp(v) is p (0, v / 2)."""
        return self.product(self.conjugate(p), df)[..., 1:] / 2

    def sample(self, count: int, generator: Generator | None = None, like: Tensor | None = None) -> Tensor:
        x = torch.randn(count, 4, generator=generator, dtype=torch.float64)
        return self.project(x).to(torch.get_default_dtype() if like is None else like.dtype)

    def sphere_area(self, r: Tensor) -> Tensor:
        return torch.sin(r / 2) ** 2


PLAIN = {"R2": Euclidean(2), "T2": FlatTorus(2), "S2": Sphere(2), "H2": Hyperboloid(2), "SO3": Rotations()}
