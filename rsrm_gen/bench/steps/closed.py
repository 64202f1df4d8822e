"""The value of f and its gradient in closed form, so that the loss is differentiated once: what an expert writes by hand.

On spheres, hyperboloids and rotations Log is phi(c) times something linear in x, where c = <mu, x> (on the hyperboloid
minus Lorentz', of rotations its absolute value) and phi = t / sin t = t / sinh t, analytic at c = 1; so the sums over
splats begin and end with products of matrices. `xp` is torch or jax.numpy; x (N, D), mu (K, D), W (K, d, T),
amplitude (K) to f (N,) and its partial derivatives (N, D).
"""

from __future__ import annotations

import math
from typing import Any

NEAR = 0.03  # |1 - c| below which phi is its series
# phi(c) = sum n! / (2n + 1)!! (1 - c)^n
SERIES = tuple(math.factorial(n) / math.prod(range(1, 2 * n + 2, 2)) for n in range(8))


def value_and_partials(xp: Any, name: str, x: Any, mu: Any, W: Any, amplitude: Any) -> tuple[Any, Any]:
    """f (N,) and its partial derivatives (N, D), up to a vector normal to the manifold."""
    return FIELDS[name](xp, x, mu, W, amplitude)


def torus(xp: Any, x: Any, mu: Any, W: Any, amplitude: Any) -> tuple[Any, Any]:
    """Angles modulo 2 pi."""
    v = x[:, None] - mu
    v = v - 2 * math.pi * xp.round(v / (2 * math.pi))
    z = xp.einsum("kij,nkj->nki", W, v)
    F = amplitude * xp.exp(-(z * z).sum(-1) / 2)
    return F.sum(-1), _times(-F[..., None] * z, W)


def sphere(xp: Any, x: Any, mu: Any, W: Any, amplitude: Any) -> tuple[Any, Any]:
    """Unit vectors."""
    return _of_constant_curvature(xp, x, mu, mu, W, amplitude)


def hyperbolic(xp: Any, x: Any, mu: Any, W: Any, amplitude: Any) -> tuple[Any, Any]:
    """The hyperboloid, time coordinate first."""
    return _of_constant_curvature(xp, x, mu, xp.concatenate([mu[:, :1], -mu[:, 1:]], -1), W, amplitude)


def so3(xp: Any, x: Any, mu: Any, W: Any, amplitude: Any) -> tuple[Any, Any]:
    """Unit quaternions."""
    f, _, by_x = _of_rotations(xp, x, mu, W, amplitude, 0)
    return f, by_x


def se3(xp: Any, x: Any, mu: Any, W: Any, amplitude: Any) -> tuple[Any, Any]:
    """Position and unit quaternion."""
    at = x[:, :3] @ _rows(W[..., :3]).T
    at = at.reshape(*at.shape[:1], *W.shape[:2]) - xp.einsum("kij,kj->ki", W[..., :3], mu[:, :3])
    f, by_z, by_x = _of_rotations(xp, x[:, 3:], mu[:, 3:], W[..., 3:], amplitude, at)
    return f, xp.concatenate([_times(by_z, W[..., :3]), by_x], -1)


def _of_constant_curvature(xp: Any, x: Any, mu: Any, covector: Any, W: Any, amplitude: Any) -> tuple[Any, Any]:
    """`covector` (K, D) gives c; Log is phi (x - c mu)."""
    m = x.shape[-1] - 2
    W = W - (W * mu[:, None]).sum(-1)[..., None] * covector[:, None]
    c = x @ covector.T
    p = (x @ _rows(W).T).reshape(*c.shape, -1)
    phi, eta = phi_and_slope(xp, c)
    square = phi * phi
    q = square * (p * p).sum(-1)
    F = amplitude * phi**m * xp.exp(-q / 2)
    return F.sum(-1), (F * eta * (m - q)) @ covector + _times(-(F * square)[..., None] * p, W)


def _of_rotations(xp: Any, x: Any, mu: Any, W: Any, amplitude: Any, at: Any) -> tuple[Any, Any, Any]:
    """f, df/dz (N, K, d) and df/dx of z = at + 2 sign phi W L x, with L (3, 4) the vector part of conj(mu) times x."""
    WL = W @ _left(xp, mu)
    g = x @ mu.T
    sign = xp.sign(g)
    phi, eta = phi_and_slope(xp, sign * g)
    r = (2 * sign * phi)[..., None] * (x @ _rows(WL).T).reshape(*g.shape, -1)
    z = at + r
    F = amplitude * phi**2 * xp.exp(-(z * z).sum(-1) / 2)
    by_z = -F[..., None] * z
    by_g = sign * eta * (2 * F + (by_z * r).sum(-1))
    by_x = by_g @ mu + _times((2 * sign * phi)[..., None] * by_z, WL)
    return F.sum(-1), by_z, by_x


def phi_and_slope(xp: Any, c: Any) -> tuple[Any, Any]:
    """phi(c) = acos(c) / sqrt(1 - c^2), for c > 1 acosh(c) / sqrt(c^2 - 1), and d log phi / dc."""
    s = 1 - c
    near, beyond = xp.abs(s) < NEAR, s < 0
    inside = xp.where(near | beyond, 0.5, c)
    outside = xp.where(near | (s > 0), 2.0, c)
    sine, sinh = xp.sqrt(1 - inside * inside), xp.sqrt(outside * outside - 1)
    far = xp.where(beyond, xp.log(outside + sinh) / sinh, xp.arctan2(sine, inside) / sine)
    squared = xp.where(near, 1.0, 1 - c * c)
    close = xp.where(near, s, 0.0)
    series, slope = _horner(SERIES, close), -_horner(tuple(n * a for n, a in enumerate(SERIES))[1:], close)
    return xp.where(near, series, far), xp.where(near, slope / series, (c - 1 / xp.where(near, 1.0, far)) / squared)


def _horner(coefficients: tuple[float, ...], x: Any) -> Any:
    total = 0 * x + coefficients[-1]
    for coefficient in coefficients[-2::-1]:
        total = coefficient + x * total
    return total


def _left(xp: Any, mu: Any) -> Any:
    """L (K, 3, 4): L x is the vector part of conj(mu) x."""
    w, a, b, c = (mu[:, i] for i in range(4))
    rows = [xp.stack(row, -1) for row in ((-a, w, c, -b), (-b, -c, w, a), (-c, b, -a, w))]
    return xp.stack(rows, 1)


def _rows(W: Any) -> Any:
    """(K, d, T) as (K d, T)."""
    return W.reshape(-1, W.shape[-1])


def _times(slopes: Any, W: Any) -> Any:
    """Slopes (N, K, d) in W x to those in x: (N, T)."""
    return slopes.reshape(slopes.shape[0], -1) @ _rows(W)


FIELDS = {"torus": torus, "sphere": sphere, "hyperbolic": hyperbolic, "so3": so3, "se3": se3}
