"""The contract between the two halves: what every generated torch module offers, and all that the trainer knows.

Points have shape (..., D) with D = `point_size`, tangent vectors (..., T) with T = `tangent_size`; leading dimensions
broadcast. A tangent vector is ambient (T = D) or, where the manifold has a frame of its own (Lie groups), a list of
components in it (T = d). Lengths are in the units of the metric, angles in radians.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol, runtime_checkable

if TYPE_CHECKING:
    from torch import Generator, Tensor


@runtime_checkable
class Manifold(Protocol):
    """A Riemannian manifold (M, g) of dimension d with closed-form exponential and logarithm maps."""

    @property
    def name(self) -> str:
        """The name in the YAML file, with the parameters that differ from its defaults."""
        ...

    @property
    def content_hash(self) -> str:
        """A hash of the manifold file and its parameters: two manifolds with the same one are the same."""
        ...

    @property
    def dim(self) -> int:
        """d, the dimension of the manifold."""
        ...

    @property
    def point_size(self) -> int:
        """D, how many numbers store a point."""
        ...

    @property
    def tangent_size(self) -> int:
        """T, how many numbers store a tangent vector."""
        ...

    @property
    def injectivity_radius(self) -> float:
        """Exp_p is a diffeomorphism on the open ball of this radius, for every p; `inf` where it is one everywhere."""
        ...

    @property
    def diameter(self) -> float:
        """The largest distance between two points; `inf` when the manifold is not compact."""
        ...

    @property
    def periods(self) -> tuple[float | None, ...] | None:
        """For a chart, each coordinate's period (None: not periodic); None as a whole for an embedded manifold."""
        ...

    @property
    def maps(self) -> str:
        """ "geodesic", or "retraction" where exp and log are a retraction of the metric and its inverse."""
        ...

    def exp(self, p: Tensor, v: Tensor) -> Tensor:
        """Exp_p(v): points (..., D) and tangent vectors (..., T) to points (..., D)."""
        ...

    def log(self, p: Tensor, q: Tensor) -> Tensor:
        """Log_p(q), the shortest tangent vector at p with Exp_p(Log_p(q)) = q: (..., T)."""
        ...

    def distance(self, p: Tensor, q: Tensor) -> Tensor:
        """Geodesic distance: (...)."""
        ...

    def log_abs_det(self, p: Tensor, q: Tensor) -> Tensor:
        """log |det D Log_p(q)| between the Riemannian volumes at q and p: (...)."""
        ...

    def project(self, x: Tensor) -> Tensor:
        """Numbers (..., D) near the manifold to the point they stand for: (..., D)."""
        ...

    def to_tangent(self, p: Tensor, x: Tensor) -> Tensor:
        """The tangent part at p of an ambient vector (..., D), as a tangent vector (..., T)."""
        ...

    def inner(self, p: Tensor, u: Tensor, v: Tensor) -> Tensor:
        """<u, v>_p: (...)."""
        ...

    def norm(self, p: Tensor, v: Tensor) -> Tensor:
        """|v|_p: (...)."""
        ...

    def flat(self, p: Tensor, v: Tensor) -> Tensor:
        """The covector <v, .>_p as numbers (..., T): `(flat(p, v) * w).sum(-1) == inner(p, v, w)`."""
        ...

    def frame(self, p: Tensor) -> Tensor:
        """An orthonormal basis of T_p M: (..., d, T), one tangent vector a row. Not continuous in p where none is."""
        ...

    def riemannian_gradient(self, p: Tensor, df: Tensor) -> Tensor:
        """The gradient in the metric, (..., T), of a function with the partial derivatives df (..., D) at p."""
        ...

    def gradient_norm(self, p: Tensor, df: Tensor) -> Tensor:
        """|grad f|_p from the partial derivatives df (..., D): (...)."""
        ...

    def transport(self, p: Tensor, q: Tensor, v: Tensor) -> Tensor:
        """v at p, carried in parallel along the geodesic to q: (..., T); where the manifold file gives it."""
        ...

    def sample(self, count: int, generator: Generator | None = None, like: Tensor | None = None) -> Tensor:
        """Points uniform in volume, (count, D), with the dtype and device of `like`; compact manifolds only."""
        ...

    def sample_ball(self, center: Tensor, radius: float, count: int, generator: Generator | None = None) -> Tensor:
        """Points uniform in volume in the geodesic ball around `center` (D): (count, D)."""
        ...

    def splat(self, x: Tensor, mu: Tensor, W: Tensor, amplitude: Tensor) -> tuple[Tensor, Tensor]:
        """One wrapped Gaussian and its Riemannian gradient in x (RSRM eq. 3).

        phi(x) = amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)|, with W (..., d, T) the product of A^-1 and
        the flattened orthonormal frame at mu (..., D), and amplitude (...) = v (2 pi)^(-d/2) |det A^-1|.
        Returns the value (...) and the gradient (..., T) as a tangent vector at x.
        """
        ...

    def splats(
        self, x: Tensor, mu: Tensor, W: Tensor, amplitude: Tensor, width: Tensor | None = None
    ) -> tuple[Tensor, Tensor]:
        """The sum of K splats at N points and its Riemannian gradient (RSRM eq. 4), differentiable once.

        Shapes: x (N, D), mu (K, D), W (K, d, T), amplitude (K) to (N), (N, T). Any floating-point dtype; the derivatives
        are those in mu, W and amplitude. A point that is not finite spoils its own row, and the derivatives, which are
        sums over all points; a splat that is not finite spoils all rows, and of the derivatives its own.

        With `width` (K), at least the largest |v| / |W v| of each splat (the largest singular value of A, if W = A^-1 E),
        pairs too far apart to count may be left out, where that pays: see docs/kernels.md.
        """
        ...

    def splats_value(self, x: Tensor, mu: Tensor, W: Tensor, amplitude: Tensor) -> Tensor:
        """The values of `splats` alone: (N)."""
        ...

    def splats_rows(
        self, x: Tensor, mu: Tensor, W: Tensor, amplitude: Tensor, value_bar: Tensor, gradient_bar: Tensor
    ) -> Tensor:
        """The derivatives of value_n value_bar_n + <gradient_n, gradient_bar_n> for each point n by itself.

        Shapes: value_bar (N) and gradient_bar (N, T) to (N, K, D + d T + 1): the derivatives in mu, W (row by row) and
        amplitude of each splat, whose sums over N the backward pass of `splats` gives. Not differentiable.
        """
        ...

    def kernels(self, like: Tensor) -> str:
        """What computes `splats` for tensors like this one: "C, AVX-512, 2 threads", "torch, cuda"."""
        ...


def not_finite(**tensors: Tensor) -> str | None:
    """The first row that is not finite of the first tensor that has one, by its name; None where all is finite."""
    for name, tensor in tensors.items():
        bad = ~tensor.detach().isfinite().flatten(1).all(1) if tensor.dim() > 1 else ~tensor.detach().isfinite()
        if bool(bad.any()):
            row = int(bad.flatten().int().argmax())
            count = int(bad.sum())
            numbers = ", ".join(f"{c:g}" for c in tensor.detach()[row].flatten()[:8].tolist())
            return f"{name}[{row}] is not finite: [{numbers}] ({count} of {len(bad)} rows)"
    return None
