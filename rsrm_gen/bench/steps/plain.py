"""The formulas that one writes down first: Log and log |det D Log| of each manifold, safe where points coincide.

`xp` is torch or jax.numpy; both have all that is used, by the same names. Points x (N, 1, D) and centres mu (1, K, D)
broadcast. What is returned is Log_mu(x) (N, K, T) and the logarithm of its determinant (N, K), or None where that is 0.
"""

from __future__ import annotations

import math
from typing import Any

TINY = 1e-12  # squares of distances below this count as 0, where the quotients have their limits


def field(xp: Any, name: str, x: Any, mu: Any, W: Any, amplitude: Any) -> Any:
    """f (N,) at x (N, D): the sum of wrapped Gaussians mu (K, D), W (K, d, T), amplitude (K) (RSRM eq. 3)."""
    log, log_det = LOGS[name](xp, mu[None], x[:, None])
    z = xp.einsum("kit,nkt->nki", W, log)
    exponent = -(z * z).sum(-1) / 2
    return (amplitude * xp.exp(exponent if log_det is None else exponent + log_det)).sum(-1)


def torus(xp: Any, mu: Any, x: Any) -> tuple[Any, Any]:
    """Angles modulo 2 pi."""
    v = x - mu
    return v - 2 * math.pi * xp.round(v / (2 * math.pi)), None


def sphere(xp: Any, mu: Any, x: Any) -> tuple[Any, Any]:
    """Unit vectors; the angle from the chords to x and to its antipode."""
    v, s = x - mu, x + mu
    vv, ss = (v * v).sum(-1), (s * s).sum(-1)
    near = vv < TINY
    chord, other = xp.sqrt(xp.where(near, 1.0, vv)), xp.sqrt(ss)
    ratio = xp.where(near, 1.0, 4 * xp.arctan2(chord, other) / (chord * other))  # angle / its sine
    log = ratio[..., None] * (v + (vv / 2)[..., None] * mu)
    return log, (x.shape[-1] - 2) * xp.log(ratio)


def hyperbolic(xp: Any, mu: Any, x: Any) -> tuple[Any, Any]:
    """The hyperboloid, time coordinate first; the distance from the chord, whose square is 4 sinh^2(r / 2)."""
    v = x - mu
    vv = (v[..., 1:] * v[..., 1:]).sum(-1) - v[..., 0] * v[..., 0]
    near = vv < TINY
    ww = xp.where(near, 1.0, vv)
    ratio = xp.where(near, 1.0, 2 * xp.arcsinh(xp.sqrt(ww) / 2) / xp.sqrt(ww * (1 + ww / 4)))  # r / sinh r
    log = ratio[..., None] * (v - (vv / 2)[..., None] * mu)
    return log, (x.shape[-1] - 2) * xp.log(ratio)


def so3(xp: Any, mu: Any, x: Any) -> tuple[Any, Any]:
    """Unit quaternions (w, x, y, z); the rotation vector of conj(mu) x in the body's frame."""
    a, b = mu[..., 1:], x[..., 1:]
    w = (mu * x).sum(-1)
    v = mu[..., :1] * b - x[..., :1] * a - xp.linalg.cross(*_broadcast(xp, a, b))
    vv = (v * v).sum(-1)
    near = vv < TINY
    s = xp.sqrt(xp.where(near, 1.0, vv))
    ratio = xp.where(near, 2.0, 2 * xp.arctan2(s, xp.abs(w)) / s)
    return (xp.sign(w) * ratio)[..., None] * v, 2 * xp.log(ratio / 2)


def se3(xp: Any, mu: Any, x: Any) -> tuple[Any, Any]:
    """Position and unit quaternion."""
    turn, log_det = so3(xp, mu[..., 3:], x[..., 3:])
    return xp.concatenate([x[..., :3] - mu[..., :3], turn], -1), log_det


def _broadcast(xp: Any, a: Any, b: Any) -> tuple[Any, Any]:
    whole, _ = xp.broadcast_arrays(a, b) if hasattr(xp, "broadcast_arrays") else xp.broadcast_tensors(a, b)
    return whole, xp.broadcast_to(b, whole.shape)


LOGS = {"torus": torus, "sphere": sphere, "hyperbolic": hyperbolic, "so3": so3, "se3": se3}


def to_gradient(xp: Any, name: str, x: Any, df: Any) -> Any:
    """The Riemannian gradient (N, T) from partial derivatives df (N, D) at x (N, D)."""
    if name == "sphere":
        return df - (x * df).sum(-1)[:, None] * x
    if name == "hyperbolic":
        raised = xp.concatenate([-df[:, :1], df[:, 1:]], -1)
        return raised + (x * df).sum(-1)[:, None] * x
    if name == "so3":
        return _body_components(xp, x, df)
    if name == "se3":
        return xp.concatenate([df[:, :3], _body_components(xp, x[:, 3:], df[:, 3:])], -1)
    return df


def _body_components(xp: Any, x: Any, df: Any) -> Any:
    """The derivatives along the velocities x (0, e_i) / 2."""
    a, b = x[:, 1:], df[:, 1:]
    return (x[:, :1] * b - df[:, :1] * a - xp.linalg.cross(a, b)) / 2


def residuals(xp: Any, name: str, points: Any, f: Any, df: Any) -> Any:
    """(|grad T|_g - s)^2 (N,) with T = d exp(f); `points` are x (N, D), d (N,), grad d (N, T), s (N,); df is (N, T)."""
    _, d, away, slowness = points
    gradient = xp.exp(f)[:, None] * (away + d[:, None] * df)
    square = (gradient * gradient).sum(-1)
    if name == "hyperbolic":
        square = square - 2 * gradient[:, 0] ** 2
    return (xp.sqrt(square) - slowness) ** 2


def splats(xp: Any, v: Any, A: Any, E: Any) -> tuple[Any, Any]:
    """W (K, d, T) and the amplitude (K) of v (K), A (K, d, d) and flattened frames E (K, d, T)."""
    inverse = xp.linalg.inv(A)
    return inverse @ E, v * ((2 * math.pi) ** (-A.shape[-1] / 2) * xp.abs(xp.linalg.det(inverse)))
