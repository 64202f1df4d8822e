"""How the arrival time T depends on the distance d to the goal and on the field f: two forms with one interface.

What stands for the distance (base.py) takes the place of d.

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

    def field(self, d: Tensor, time: Tensor) -> Tensor:
        """The f with T(d, f) = time: (...). Not a number at d = 0; the nearest that is finite where no f gives it."""
        ...

    def partials(self, d: Tensor, f: Tensor) -> tuple[Tensor, Tensor]:
        """dT/dd and dT/df: (...), (...)."""
        ...

    def derivatives(self, d: Tensor, f: Tensor) -> tuple[Tensor, Tensor, Tensor, Tensor]:
        """dT/dd, dT/df, d^2T/dd df and d^2T/df^2, each (...)."""
        ...


@dataclass(frozen=True)
class Exponential:
    """T = d exp(f): free space, f = 0, is exact, and f is the logarithm of the mean slowness on the way."""

    def value(self, d: Tensor, f: Tensor) -> Tensor:
        """T: (...)."""
        return d * torch.exp(f)

    def field(self, d: Tensor, time: Tensor) -> Tensor:
        """log(time / d): (...)."""
        return torch.log(time / d)

    def partials(self, d: Tensor, f: Tensor) -> tuple[Tensor, Tensor]:
        """dT/dd and dT/df: (...), (...)."""
        factor = torch.exp(f)
        return factor, d * factor

    def derivatives(self, d: Tensor, f: Tensor) -> tuple[Tensor, Tensor, Tensor, Tensor]:
        """dT/dd, dT/df, d^2T/dd df and d^2T/df^2, each (...); the second ones are the first ones again."""
        by_d, by_f = self.partials(d, f)
        return by_d, by_f, by_d, by_f


@dataclass(frozen=True)
class Quotient:
    """T = d / tau with tau = floor + (1 - floor) sigmoid(f + offset), a mean speed (RSRM eq. 7)."""

    offset: float = 4.0
    floor: float = 0.0

    def _speed(self, f: Tensor) -> tuple[Tensor, Tensor]:
        """tau and the sigmoid in it."""
        sigmoid = torch.sigmoid(f + self.offset)
        return self.floor + (1 - self.floor) * sigmoid, sigmoid

    def value(self, d: Tensor, f: Tensor) -> Tensor:
        """T: (...)."""
        return d / self._speed(f)[0]

    def field(self, d: Tensor, time: Tensor) -> Tensor:
        """From the sigmoid, which is kept 1e-6 away from 0 and 1: (...)."""
        sigmoid = (d / time - self.floor) / (1 - self.floor)
        return torch.logit(sigmoid, eps=1e-6) - self.offset

    def partials(self, d: Tensor, f: Tensor) -> tuple[Tensor, Tensor]:
        """dT/dd and dT/df: (...), (...)."""
        return self.derivatives(d, f)[:2]

    def derivatives(self, d: Tensor, f: Tensor) -> tuple[Tensor, Tensor, Tensor, Tensor]:
        """dT/dd, dT/df, d^2T/dd df and d^2T/df^2, each (...)."""
        tau, sigmoid = self._speed(f)
        slope = (tau - self.floor) * (1 - sigmoid)  # d tau / df
        by_d = 1 / tau
        relative = slope * by_d
        by_df = -relative * by_d
        return by_d, d * by_df, by_df, d * by_df * (1 - 2 * (sigmoid + relative))


def make_link(choice: LinkChoice) -> Link:
    """The link that the settings name."""
    return Exponential() if choice.kind == "exponential" else Quotient(choice.offset, choice.floor)
