"""Closed forms in mpmath, written down from textbooks and independent of the formulas in manifolds/.

All models of hyperbolic space go through the hyperboloid and acosh, spheres through acos, rotations through the angle of a
quaternion: formulas that lose digits in double precision and are exact enough in sixty.
"""

from __future__ import annotations

import random
from dataclasses import dataclass
from typing import Any

import mpmath as mp

Point = list[Any]


def dot(x: Point, y: Point) -> Any:
    """The sum of products."""
    return mp.fsum(a * b for a, b in zip(x, y, strict=True))


def gauss(rng: random.Random, size: int) -> Point:
    """Normal variates."""
    return [mp.mpf(rng.gauss(0, 1)) for _ in range(size)]


def times(k: Any, x: Point) -> Point:
    """k x."""
    return [k * c for c in x]


def plus(x: Point, y: Point) -> Point:
    """x + y."""
    return [a + b for a, b in zip(x, y, strict=True)]


class ClosedForm:
    """A manifold in closed form; points are projected first, for doubles are not quite on it."""

    name: str
    n: int
    cut: float | None = None  # the injectivity radius

    @property
    def parameters(self) -> dict[str, int]:
        """Of the bundled file."""
        return {"n": self.n}

    def point(self, rng: random.Random) -> Point:
        """A random point."""
        raise NotImplementedError

    def project(self, x: Point) -> Point:
        """The point that some numbers stand for."""
        return x

    def unit(self, rng: random.Random, p: Point) -> Point:
        """A random unit tangent vector at p."""
        raise NotImplementedError

    def exp(self, p: Point, v: Point) -> Point:
        """Exp_p(v)."""
        raise NotImplementedError

    def log(self, p: Point, q: Point) -> Point:
        """Log_p(q)."""
        raise NotImplementedError

    def distance(self, p: Point, q: Point) -> Any:
        """The distance."""
        raise NotImplementedError

    def log_det(self, t: Any) -> Any:
        """log |det D Log| at the distance t."""
        return mp.mpf(0)


@dataclass
class Sphere(ClosedForm):
    """S^n."""

    n: int
    name: str = "sphere"
    cut: float | None = float(mp.pi)

    def point(self, rng: random.Random) -> Point:
        return self.project(gauss(rng, self.n + 1))

    def project(self, x: Point) -> Point:
        return times(1 / mp.sqrt(dot(x, x)), x)

    def unit(self, rng: random.Random, p: Point) -> Point:
        x = gauss(rng, self.n + 1)
        return self.project(plus(x, times(-dot(p, x), p)))

    def exp(self, p: Point, v: Point) -> Point:
        r = mp.sqrt(dot(v, v))
        return plus(times(mp.cos(r), p), times(mp.sin(r) / r if r else 1, v))

    def distance(self, p: Point, q: Point) -> Any:
        return mp.acos(min(mp.mpf(1), dot(p, q)))

    def log(self, p: Point, q: Point) -> Point:
        t = self.distance(p, q)
        return times(t / mp.sin(t) if t else 1, plus(q, times(-mp.cos(t), p)))

    def log_det(self, t: Any) -> Any:
        return (self.n - 1) * mp.log(t / mp.sin(t)) if t else mp.mpf(0)


@dataclass
class Hyperboloid(ClosedForm):
    """H^n, time coordinate first."""

    n: int
    name: str = "hyperbolic"

    def lorentz(self, x: Point, y: Point) -> Any:
        """The indefinite product."""
        return dot(x[1:], y[1:]) - x[0] * y[0]

    def point(self, rng: random.Random) -> Point:
        return self.project([mp.mpf(0), *gauss(rng, self.n)])

    def project(self, x: Point) -> Point:
        return [mp.sqrt(1 + dot(x[1:], x[1:])), *x[1:]]

    def unit(self, rng: random.Random, p: Point) -> Point:
        x = gauss(rng, self.n + 1)
        v = plus(x, times(self.lorentz(p, x), p))
        return times(1 / mp.sqrt(self.lorentz(v, v)), v)

    def exp(self, p: Point, v: Point) -> Point:
        r = mp.sqrt(max(mp.mpf(0), self.lorentz(v, v)))
        return plus(times(mp.cosh(r), p), times(mp.sinh(r) / r if r else 1, v))

    def distance(self, p: Point, q: Point) -> Any:
        return mp.acosh(max(mp.mpf(1), -self.lorentz(p, q)))

    def log(self, p: Point, q: Point) -> Point:
        t = self.distance(p, q)
        return times(t / mp.sinh(t) if t else 1, plus(q, times(-mp.cosh(t), p)))

    def log_det(self, t: Any) -> Any:
        return (self.n - 1) * mp.log(t / mp.sinh(t)) if t else mp.mpf(0)


class Model(ClosedForm):
    """Another model of hyperbolic space: everything is carried to the hyperboloid and back."""

    def __init__(self, n: int) -> None:
        self.n = n
        self.space = Hyperboloid(n)

    def lift(self, x: Point) -> Point:
        """The point of the hyperboloid."""
        raise NotImplementedError

    def lower(self, X: Point) -> Point:
        """The point of the model."""
        raise NotImplementedError

    def carried(self, X: Point, V: Point) -> Point:
        """The components of a tangent vector of the hyperboloid."""
        raise NotImplementedError

    def lifted(self, x: Point, v: Point) -> Point:
        """The tangent vector of the hyperboloid that has components v: the differential of `lift`."""
        h = mp.mpf(10) ** -25
        ahead, behind = (self.lift(plus(x, times(s * h, v))) for s in (1, -1))
        return [(a - b) / (2 * h) for a, b in zip(ahead, behind, strict=True)]

    def point(self, rng: random.Random) -> Point:
        return self.lower(self.space.point(rng))

    def unit(self, rng: random.Random, p: Point) -> Point:
        P = self.lift(p)
        return self.carried(P, self.space.unit(rng, P))

    def exp(self, p: Point, v: Point) -> Point:
        return self.lower(self.space.exp(self.lift(p), self.lifted(p, v)))

    def distance(self, p: Point, q: Point) -> Any:
        return self.space.distance(self.lift(p), self.lift(q))

    def log(self, p: Point, q: Point) -> Point:
        P = self.lift(p)
        return self.carried(P, self.space.log(P, self.lift(q)))

    def log_det(self, t: Any) -> Any:
        return self.space.log_det(t)


class Ball(Model):
    """The Poincare ball."""

    name = "poincare"

    def lift(self, x: Point) -> Point:
        s = dot(x, x)
        return [(1 + s) / (1 - s), *times(2 / (1 - s), x)]

    def lower(self, X: Point) -> Point:
        return times(1 / (1 + X[0]), X[1:])

    def carried(self, X: Point, V: Point) -> Point:
        return plus(times(1 / (1 + X[0]), V[1:]), times(-V[0] / (1 + X[0]) ** 2, X[1:]))


class HalfSpace(Model):
    """The upper half space."""

    name = "half_space"

    def lift(self, x: Point) -> Point:
        s, y = dot(x, x), x[-1]
        return [(1 + s) / (2 * y), *times(1 / y, x[:-1]), (s - 1) / (2 * y)]

    def lower(self, X: Point) -> Point:
        y = 1 / (X[0] - X[-1])
        return [*times(y, X[1:-1]), y]

    def carried(self, X: Point, V: Point) -> Point:
        y = 1 / (X[0] - X[-1])
        dy = -(y**2) * (V[0] - V[-1])
        return [*plus(times(y, V[1:-1]), times(dy, X[1:-1])), dy]


@dataclass
class Torus(ClosedForm):
    """Angles modulo 2 pi, and lengths: coordinates scaled by `scales`, periodic where `periodic`."""

    n: int
    name: str = "torus"
    cut: float | None = float(mp.pi)

    def point(self, rng: random.Random) -> Point:
        return [mp.mpf(rng.uniform(-9, 9)) for _ in range(self.n)]

    def unit(self, rng: random.Random, p: Point) -> Point:
        x = gauss(rng, self.n)
        return times(1 / mp.sqrt(dot(x, x)), x)

    def turned(self, i: int, x: Any) -> Any:
        """A coordinate in (-pi, pi]."""
        return x - 2 * mp.pi * mp.nint(x / (2 * mp.pi))

    def exp(self, p: Point, v: Point) -> Point:
        return [self.turned(i, x) for i, x in enumerate(plus(p, v))]

    def log(self, p: Point, q: Point) -> Point:
        return [self.turned(i, b - a) for i, (a, b) in enumerate(zip(p, q, strict=True))]

    def distance(self, p: Point, q: Point) -> Any:
        v = self.log(p, q)
        return mp.sqrt(dot(v, v))


class Cylinder(Torus):
    """An angle and a height, of radius 1."""

    @property
    def parameters(self) -> dict[str, int]:
        return {}

    def turned(self, i: int, x: Any) -> Any:
        return super().turned(i, x) if i == 0 else x


@dataclass
class Circle(ClosedForm):
    """Unit complex numbers."""

    n: int = 1
    name: str = "circle"
    cut: float | None = float(mp.pi)
    parameters = {}  # type: ignore[assignment]  # noqa: RUF012

    def point(self, rng: random.Random) -> Point:
        return self.project(gauss(rng, 2))

    def project(self, x: Point) -> Point:
        return times(1 / mp.sqrt(dot(x, x)), x)

    def unit(self, rng: random.Random, p: Point) -> Point:
        return [mp.mpf(rng.choice((-1, 1)))]

    def exp(self, p: Point, v: Point) -> Point:
        z = mp.mpc(*p) * mp.expj(v[0])
        return [z.real, z.imag]

    def log(self, p: Point, q: Point) -> Point:
        return [mp.arg(mp.mpc(*q) / mp.mpc(*p))]

    def distance(self, p: Point, q: Point) -> Any:
        return abs(self.log(p, q)[0])


@dataclass
class Rotations(ClosedForm):
    """Unit quaternions w, x, y, z up to sign; rotation vectors in the body frame."""

    n: int = 3
    name: str = "so3"
    cut: float | None = float(mp.pi)
    parameters = {}  # type: ignore[assignment]  # noqa: RUF012

    @staticmethod
    def product(a: Point, b: Point) -> Point:
        """Hamilton's product."""
        (s, *u), (t, *v) = a, b
        cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
        return [s * t - dot(u, v), *plus(plus(times(s, v), times(t, u)), cross)]

    def point(self, rng: random.Random) -> Point:
        return self.project(gauss(rng, 4))

    def project(self, x: Point) -> Point:
        return times(1 / mp.sqrt(dot(x, x)), x)

    def unit(self, rng: random.Random, p: Point) -> Point:
        x = gauss(rng, 3)
        return times(1 / mp.sqrt(dot(x, x)), x)

    def exp(self, p: Point, v: Point) -> Point:
        r = mp.sqrt(dot(v, v))
        return self.product(p, [mp.cos(r / 2), *times(mp.sin(r / 2) / r if r else mp.mpf(1) / 2, v)])

    def log(self, p: Point, q: Point) -> Point:
        w, *s = self.product([p[0], *times(-1, p[1:])], q)
        if w < 0:
            w, s = -w, times(-1, s)
        half = mp.acos(min(mp.mpf(1), w))
        return times(2 * half / mp.sin(half) if half else 2, s)

    def distance(self, p: Point, q: Point) -> Any:
        v = self.log(p, q)
        return mp.sqrt(dot(v, v))

    def log_det(self, t: Any) -> Any:
        return 2 * mp.log(t / 2 / mp.sin(t / 2)) if t else mp.mpf(0)


CASES: dict[str, ClosedForm] = {
    "S2": Sphere(2),
    "S5": Sphere(5),
    "T7": Torus(7),
    "H2": Hyperboloid(2),
    "H5": Hyperboloid(5),
    "ball2": Ball(2),
    "ball3": Ball(3),
    "half2": HalfSpace(2),
    "half4": HalfSpace(4),
    "SO3": Rotations(),
    "circle": Circle(),
    "cylinder": Cylinder(2, "cylinder"),
}
