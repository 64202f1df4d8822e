"""What a field is trained for: three objectives behind one interface, which the training loop drives step by step.

paths     labels from paths, then Gauss-Newton on the splats: T becomes the arrival time; the default
bellman   T(x) = min over u of T(Exp_x(h u)) + the cost of getting there, swept until it holds
eikonal   the residual of |grad T|_g = s, as in the RSRM paper; small residuals do not make T the arrival time
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Protocol

from rsrm_gen.trainer.clock import NO_CLOCK, Clock
from rsrm_gen.trainer.model import ArrivalTime
from rsrm_gen.trainer.objectives.eikonal import Eikonal
from rsrm_gen.trainer.run import Arrays
from rsrm_gen.trainer.scene import Scene

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


def make_objective(scene: Scene, clock: Clock = NO_CLOCK, tell: Tell = lambda what, part: None) -> Objective:
    """The objective that the scene's settings name, at step 0 and without splats."""
    return Eikonal(scene, clock)
