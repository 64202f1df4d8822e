"""How the arrival time T depends on the distance d to the goal and on the field f: two forms with one interface.

The partial derivatives are written out, so that grad T = dT/dd grad d + dT/df grad f needs no differentiation by the
framework; the second ones, so that the derivative of the loss needs none either.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import torch
from torch import Tensor

from rsrm_gen.trainer.settings import LinkChoice


class Link(Protocol):
    """T(d, f), zero at d = 0 and growing with d; d and f have one shape (...)."""

    def value(self, d: Tensor, f: Tensor) -> Tensor:
        """T: (...)."""
        ...

    def partials(self, d: Tensor, f: Tensor) -> tuple[Tensor, Tensor]:
        """dT/dd and dT/df: (...), (...)."""
        ...

    def second_partials(self, d: Tensor, f: Tensor) -> tuple[Tensor, Tensor]:
        """d^2T/dd df and d^2T/df^2: (...), (...)."""
        ...


@dataclass(frozen=True)
class Exponential:
    """T = d exp(f): free space, f = 0, is exact, and f is the logarithm of the mean slowness on the way."""

    def value(self, d: Tensor, f: Tensor) -> Tensor:
        """T: (...)."""
        return d * torch.exp(f)

    def partials(self, d: Tensor, f: Tensor) -> tuple[Tensor, Tensor]:
        """dT/dd and dT/df: (...), (...)."""
        factor = torch.exp(f)
        return factor, d * factor

    def second_partials(self, d: Tensor, f: Tensor) -> tuple[Tensor, Tensor]:
        """d^2T/dd df and d^2T/df^2: (...), (...); the first derivatives again."""
        return self.partials(d, f)


@dataclass(frozen=True)
class Quotient:
    """T = d / tau with tau = floor + (1 - floor) sigmoid(f + offset), a mean speed (RSRM eq. 7)."""

    offset: float = 4.0
    floor: float = 0.0

    def _speed(self, f: Tensor) -> tuple[Tensor, Tensor]:
        """tau and d tau / df."""
        sigmoid = torch.sigmoid(f + self.offset)
        return self.floor + (1 - self.floor) * sigmoid, (1 - self.floor) * sigmoid * (1 - sigmoid)

    def value(self, d: Tensor, f: Tensor) -> Tensor:
        """T: (...)."""
        return d / self._speed(f)[0]

    def partials(self, d: Tensor, f: Tensor) -> tuple[Tensor, Tensor]:
        """dT/dd and dT/df: (...), (...)."""
        tau, slope = self._speed(f)
        return 1 / tau, -d * slope / tau**2

    def second_partials(self, d: Tensor, f: Tensor) -> tuple[Tensor, Tensor]:
        """d^2T/dd df and d^2T/df^2: (...), (...)."""
        tau, slope = self._speed(f)
        by_df = -slope / tau**2
        # slope' = slope (1 - 2 sigmoid), and sigmoid = (tau - floor) / (1 - floor)
        bend = 1 - 2 * (tau - self.floor) / (1 - self.floor)
        return by_df, d * by_df * (bend - 2 * slope / tau)


def make_link(choice: LinkChoice) -> Link:
    """The link that the settings name."""
    return Exponential() if choice.kind == "exponential" else Quotient(choice.offset, choice.floor)
