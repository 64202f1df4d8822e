"""What the training loop asks of an objective, and what several objectives share."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Protocol

import numpy as np
import torch
from torch import Tensor

from rsrm_gen.manifold import Manifold
from rsrm_gen.trainer.fit import shape_bounds
from rsrm_gen.trainer.model import ArrivalTime
from rsrm_gen.trainer.run import Arrays
from rsrm_gen.trainer.settings import Splats

Tell = Callable[[str, float], None]  # what is being done within a step, and which part of it is done


class Objective(Protocol):
    """How a field is brought closer to the arrival time: begun once, advanced step by step, kept and restored exactly."""

    arrival: ArrivalTime
    step: int  # how many were made
    steps: int  # how many there are in all
    phase: str  # what the last step was part of

    def begin(self) -> None:
        """At step 0: place the first splats."""
        ...

    def advance(self) -> float:
        """One step: its loss. What is not finite is a `FloatingPointError`, and nothing moved."""
        ...

    def final_loss(self) -> float:
        """The loss of the field as it is, at many points."""
        ...

    def arrays(self) -> Arrays:
        """Everything that changes, as plain arrays; `step` and the splats' `v`, `mu`, `A`, `frame` among them."""
        ...

    def restore(self, arrays: Arrays, path: Path) -> None:
        """Go back to what `arrays` gave; it was read from `path`."""
        ...


def random_numbers(*entropy: int) -> torch.Generator:
    """A generator that follows from these numbers alone: the seed, and what it is for."""
    state = np.random.SeedSequence(entropy).generate_state(1, np.uint64)
    return torch.Generator().manual_seed(int(state[0]))


def width_bounds(manifold: Manifold, splats: Splats, x: Tensor) -> tuple[float, float]:
    """The least and the largest singular value that a splat's A may have, for a fit at points x (N, D); lengths."""
    least, largest = shape_bounds(manifold, x)
    least = splats.min_width or min(least, splats.max_width or math.inf)
    return least, max(splats.max_width or largest, least)
