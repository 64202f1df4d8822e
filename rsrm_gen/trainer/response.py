"""What is fitted through: the value that a field f gives at a point, f itself or the arrival time made of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import torch
from torch import Tensor

from rsrm_gen.trainer.model import ArrivalTime


class Response(Protocol):
    """A value y(x, f), strictly monotonic in f where it depends on it at all."""

    def at(self, x: Tensor) -> Tensor:
        """What y needs to know of the points x (N, D), which does not change with f: (N,)."""
        ...

    def value(self, known: Tensor, f: Tensor) -> Tensor:
        """y: (N,)."""
        ...

    def slope(self, known: Tensor, f: Tensor) -> Tensor:
        """dy/df: (N,)."""
        ...

    def field(self, known: Tensor, value: Tensor) -> Tensor:
        """The f that gives these values, (N,); not finite where none does."""
        ...


@dataclass(frozen=True)
class Affine:
    """y = offset + scale f: f itself, or so that it is of size 1."""

    offset: float = 0.0
    scale: float = 1.0

    def at(self, x: Tensor) -> Tensor:
        """Nothing."""
        return x.new_zeros(len(x))

    def value(self, known: Tensor, f: Tensor) -> Tensor:
        """y."""
        return self.offset + self.scale * f

    def slope(self, known: Tensor, f: Tensor) -> Tensor:
        """The scale."""
        return torch.full_like(f, self.scale)

    def field(self, known: Tensor, value: Tensor) -> Tensor:
        """f."""
        return (value - self.offset) / self.scale


@dataclass(frozen=True)
class Arrival:
    """y = T = link(b(x), f)."""

    arrival: ArrivalTime

    def at(self, x: Tensor) -> Tensor:
        """b."""
        return self.arrival.base.value(x)

    def value(self, known: Tensor, f: Tensor) -> Tensor:
        """T."""
        return self.arrival.link.value(known, f)

    def slope(self, known: Tensor, f: Tensor) -> Tensor:
        """dT/df."""
        return self.arrival.link.partials(known, f)[1]

    def field(self, known: Tensor, value: Tensor) -> Tensor:
        """Where T is the value."""
        return self.arrival.link.field(known, value)
