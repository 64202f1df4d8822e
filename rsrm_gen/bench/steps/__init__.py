"""One step of training, written in several ways: the loss and its gradient in v (K), mu (K, D) and A (K, d, d).

The loss is the Eikonal one, squared: the mean over N points of (|grad T|_g - s)^2 with T = d exp(f), d the distance to a
goal. What depends on the points alone (d, its gradient and s) is computed once, for everyone. `plain.py` and `closed.py`
are formulas for torch and JAX alike; `in_torch.py`, `in_jax.py` and `ours.py` make steps of them; `worker.py` runs one
contender in a process of its own, which `crew.py` talks to.
"""

from __future__ import annotations

from dataclasses import dataclass
from importlib.util import find_spec


@dataclass(frozen=True)
class Contender:
    """A way to compute a step: `key` in options and JSON, its `name` for a reader, and the package that it needs."""

    key: str
    name: str
    package: str = "torch"
    chunked: bool = True  # whether it takes the points in chunks, of a size that is tried out
    whole: bool = True  # a whole step; else only the sum of splats, forward and backward
    needs_formulas: bool = True  # ours takes any manifold; the others know those in `FORMULAS`

    @property
    def missing(self) -> str | None:
        """Why it cannot run here, or None."""
        return None if find_spec(self.package) else f"{self.package} is not installed"


CONTENDERS = (
    Contender("eager", "eager torch"),
    Contender("analytic", "analytic torch"),
    Contender("compiled", "torch.compile"),
    Contender("jax", "JAX jit", "jax"),
    Contender("jax-analytic", "JAX jit, analytic", "jax"),
    Contender("ours", "rsrm-gen", chunked=False, needs_formulas=False),
    Contender("kernel", "its kernel alone", chunked=False, whole=False, needs_formulas=False),
    Contender("culled", "its kernel, told the widths", chunked=False, whole=False, needs_formulas=False),
)
FORMULAS = ("torus", "sphere", "hyperbolic", "so3", "se3")  # bundled manifolds, in any dimension `n`
