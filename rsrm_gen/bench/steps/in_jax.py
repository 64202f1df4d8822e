"""Steps in JAX: one compiled function, a scan over chunks of points that adds their losses and gradients."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import jax
import jax.numpy as jnp

from rsrm_gen.bench.steps import closed, plain
from rsrm_gen.bench.steps.problem import Problem

Step = Callable[[], tuple[Any, tuple[Any, ...]]]


def doubly(name: str, problem: Problem, chunk: int) -> Step:
    """Plain formulas; grad f by JAX, and the loss' gradient through that."""

    def field(x: Any, *splats: Any) -> tuple[Any, Any]:
        f = plain.field(jnp, name, x, *splats)
        return f.sum(), f

    def value_and_partials(*arguments: Any) -> tuple[Any, Any]:
        df, f = jax.grad(field, has_aux=True)(*arguments)
        return f, df

    return _scanned(name, value_and_partials, problem, chunk)


def analytic(name: str, problem: Problem, chunk: int) -> Step:
    """The gradient of f in closed form."""
    return _scanned(name, lambda *a: closed.value_and_partials(jnp, name, *a), problem, chunk)


def _scanned(name: str, value_and_partials: Callable[..., tuple[Any, Any]], problem: Problem, chunk: int) -> Step:
    count = len(problem.x)

    def chunk_loss(leaves: tuple[Any, ...], points: tuple[Any, ...]) -> Any:
        f, df = value_and_partials(points[0], *leaves)
        return plain.residuals(jnp, name, points, f, plain.to_gradient(jnp, name, points[0], df)).sum() / count

    def add(leaves: Any, total: Any, points: Any) -> Any:
        return jax.tree.map(jnp.add, total, jax.value_and_grad(chunk_loss)(leaves, points)), None

    def whole(v: Any, mu: Any, A: Any, E: Any, parts: tuple[Any, ...]) -> Any:
        (W, amplitude), back = jax.vjp(lambda v, A: plain.splats(jnp, v, A, E), v, A)
        leaves = mu, W, amplitude
        zero = jnp.zeros((), v.dtype), jax.tree.map(jnp.zeros_like, leaves)
        (loss, (mu_bar, *bars)), _ = jax.lax.scan(lambda total, points: add(leaves, total, points), zero, parts)
        v_bar, A_bar = back(tuple(bars))
        return loss, (v_bar, mu_bar, A_bar)

    parts = tuple(jnp.asarray(a.reshape(-1, chunk, *a.shape[1:])) for a in problem.points)
    splats = tuple(jnp.asarray(a) for a in (problem.v, problem.mu, problem.A, problem.flat_frame))
    compiled = jax.jit(whole)
    return lambda: jax.block_until_ready(compiled(*splats, parts))
