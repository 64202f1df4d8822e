"""An MLP in the place of the sum of splats: its value, and its gradient in the point by a reverse sweep written out.

Written out, because the loss holds that gradient: what autograd would differentiate twice is here an ordinary function
of the weights, differentiated once. Sine activations, as in the paper's networks.
"""

from __future__ import annotations

import math
from itertools import pairwise

import torch
from torch import Tensor

from rsrm_gen.bench.paper.published import NetworkShape
from rsrm_gen.manifold import Manifold
from rsrm_gen.trainer.model import SplatField


class Network(SplatField):
    """f(x) by an MLP, behind the interface of a field: one of no splats."""

    def __init__(self, manifold: Manifold, shape: NetworkShape, dtype: torch.dtype = torch.float32) -> None:
        """All weights are zero until `begin` or `fill`."""
        super().__init__(manifold, 0, dtype)
        self.shape = shape
        sizes = [shape.inputs(manifold.point_size), *[shape.width] * shape.depth, 1]
        self.weights = [torch.zeros(sizes_, dtype=dtype, requires_grad=True) for sizes_ in pairwise(sizes)]
        self.biases = [torch.zeros(size, dtype=dtype, requires_grad=True) for size in sizes[1:]]

    @property
    def parameters(self) -> list[Tensor]:
        """All weights, then all biases."""
        return [*self.weights, *self.biases]

    @property
    def parameter_count(self) -> int:
        """How many numbers are trained."""
        return sum(t.numel() for t in self.parameters)

    @torch.no_grad()
    def begin(self, generator: torch.Generator) -> None:
        """Random weights, uniform within a bound for each layer; biases stay zero."""
        for layer, weight in enumerate(self.weights):
            fan_in = len(weight)
            bound = math.sqrt(6 / fan_in) / self.shape.divisor if layer else 1 / fan_in
            weight.uniform_(-bound, bound, generator=generator)

    def value_and_partials(self, x: Tensor) -> tuple[Tensor, Tensor]:
        """f (N,) and its partial derivatives (N, D) at x (N, D), both differentiable in the weights."""
        features, slopes = self._features(x)
        activation, cosines = features, []
        for weight, bias in zip(self.weights[:-1], self.biases[:-1], strict=True):
            angle = torch.addmm(bias, activation, weight)
            activation = angle.sin()
            cosines.append(angle.cos())
        value = torch.addmm(self.biases[-1], activation, self.weights[-1])[:, 0]
        slope = self.weights[-1].T  # df / d activation: one row for all points
        for weight, cosine in zip(self.weights[-2::-1], reversed(cosines), strict=True):
            slope = (slope * cosine) @ weight.T
        return value, (slopes * slope).view(len(x), -1, x.shape[1]).sum(1)

    def value_and_gradient(self, x: Tensor) -> tuple[Tensor, Tensor]:
        """f (N,) and its Riemannian gradient (N, T) at x (N, D)."""
        value, partials = self.value_and_partials(x)
        return value, self.manifold.riemannian_gradient(x, partials)

    def _features(self, x: Tensor) -> tuple[Tensor, Tensor]:
        """What the first layer takes, and the derivative of each feature in its coordinate: (N, F), (N, F)."""
        frequency = self.shape.frequency
        if frequency is None:
            return x, torch.ones_like(x)
        sine, cosine = torch.sin(frequency * x), torch.cos(frequency * x)
        return torch.cat((sine, cosine), 1), torch.cat((cosine, -sine), 1) * frequency
