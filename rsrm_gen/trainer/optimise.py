"""AdamW on the splats: moments in buffers beside theirs, a row a splat, so that splats can come and go.

A centre has no coordinates of its own to keep moments in: its gradient, its moments and its step are components in the
frame it carries along, and it moves by Exp. So the training does not depend on how a manifold is stored.
"""

from __future__ import annotations

import torch
from torch import Tensor

from rsrm_gen.trainer.density import Change
from rsrm_gen.trainer.model import SplatField

BETA1, BETA2, EPSILON = 0.9, 0.999, 1e-8


class AdamW:
    """Adam with decoupled weight decay on v (C), the centres' frame components (C, d) and A (C, d, d)."""

    def __init__(self, field: SplatField, weight_decay: float, gradient_clip: float) -> None:
        """The clip is the largest norm of all gradients together."""
        self.field = field
        self.weight_decay = weight_decay
        self.gradient_clip = gradient_clip
        centers = field.frame.new_zeros(field.capacity, field.manifold.dim)
        like = {"v": field.v.detach(), "mu": centers, "A": field.A.detach()}
        self.first = {name: torch.zeros_like(rows) for name, rows in like.items()}
        self.second = {name: torch.zeros_like(rows) for name, rows in like.items()}
        # A splat's own age corrects the bias of its moments: one that came late is not thrown by its first steps.
        self.age = torch.zeros(field.capacity, dtype=torch.int64)

    def buffers_of_splats(self) -> dict[str, Tensor]:
        """The buffers whose rows are splats, by name."""
        first = {f"first_{name}": rows for name, rows in self.first.items()}
        second = {f"second_{name}": rows for name, rows in self.second.items()}
        return {**first, **second, "age": self.age}

    @torch.no_grad()
    def step(self, learning_rate: float) -> None:
        """One step along the gradients in the field's parameters, which are then cleared.

        A gradient that is not finite is a `FloatingPointError`, and nothing has moved.
        """
        field, count = self.field, self.field.count
        gradients = self._clipped_gradients()
        self.age[:count] += 1
        age = self.age[:count].to(field.v.dtype)
        correction1, correction2 = 1 - BETA1**age, 1 - BETA2**age
        moves = {}
        for name, g in gradients.items():
            m, s = self.first[name][:count], self.second[name][:count]
            m.lerp_(g, 1 - BETA1)
            s.lerp_(g * g, 1 - BETA2)
            rows = (-1, *[1] * (g.dim() - 1))
            root = (s / correction2.view(rows)).sqrt_().add_(EPSILON)
            moves[name] = -learning_rate * (m / correction1.view(rows)) / root
        for name, parameter in (("v", field.v), ("A", field.A)):
            parameter[:count].mul_(1 - learning_rate * self.weight_decay).add_(moves[name])
        field.move_centers(moves["mu"])

    def _clipped_gradients(self) -> dict[str, Tensor]:
        field, count = self.field, self.field.count
        assert field.v.grad is not None
        assert field.A.grad is not None
        gradients = {"v": field.v.grad[:count], "mu": field.center_gradient(), "A": field.A.grad[:count]}
        norm = torch.stack([g.norm() for g in gradients.values()]).norm()
        if not torch.isfinite(norm):
            raise FloatingPointError("the gradient is not finite")
        scale = (self.gradient_clip / norm.clamp_min(1e-30)).clamp_max(1.0)
        field.zero_grad(set_to_none=True)
        return {name: g * scale for name, g in gradients.items()}

    @torch.no_grad()
    def follow(self, change: Change) -> None:
        """Rearrange the moments as the splats were; new splats start with none."""
        kept = len(change.kept)
        for rows in self.buffers_of_splats().values():
            rows[:kept] = rows[change.kept]
            rows[kept : kept + change.added] = 0
