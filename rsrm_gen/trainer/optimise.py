"""AdamW on the splats: moments in buffers beside theirs, a row a splat, so that splats can come and go.

A centre has no coordinates of its own to keep moments in: its gradient, its moments and its step are components in the
frame it carries along, and it moves by Exp. So the training does not depend on how a manifold is stored.
"""

from __future__ import annotations

import torch
from torch import Tensor

from rsrm_gen.trainer.clock import NO_CLOCK, Clock
from rsrm_gen.trainer.density import Change
from rsrm_gen.trainer.model import SplatField


class AdamW:
    """Adam with decoupled weight decay on v, A and the centres' frame components, a column of 1 + d^2 + d numbers a splat."""

    def __init__(self, field: SplatField, weight_decay: float, gradient_clip: float) -> None:
        """The clip is the largest norm of all gradients together."""
        self.field = field
        self.weight_decay = weight_decay
        self.gradient_clip = gradient_clip
        # In the last row, the moments of a gradient that is always 1: what the others lack because they began with 0.
        # A splat that came late has its own, and is not thrown by its first steps.
        self.first = field.numbers.new_zeros(len(field.numbers) + field.manifold.dim + 1, field.capacity)
        self.second = torch.zeros_like(self.first)

    def buffers_of_splats(self) -> dict[str, Tensor]:
        """The buffers whose rows are splats, by name."""
        return {"first": self.first.T, "second": self.second.T}

    def step(self, gradient: Tensor, learning_rate: float, clock: Clock = NO_CLOCK) -> None:
        """One step along a gradient (1 + d^2 + d, K), as `SplatField.gradient` has it.

        A gradient that is not finite is a `FloatingPointError`, and nothing has moved.
        """
        field = self.field
        moments = self.first, self.second
        steps = field.arithmetic.adam(
            gradient, self.gradient_clip, learning_rate, self.weight_decay, *moments, field.numbers
        )
        clock.lap("optimiser")
        field.move_centers(steps)
        clock.lap("projection")

    @torch.no_grad()
    def follow(self, change: Change) -> None:
        """Rearrange the moments as the splats were; new splats start with none."""
        kept = len(change.kept)
        for rows in self.buffers_of_splats().values():
            rows[:kept] = rows[change.kept]
            rows[kept : kept + change.added] = 0
