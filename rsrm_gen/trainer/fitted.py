"""What a model can hold: the same one, with as many splats, fitted to the reference itself at the points it is judged at.

Beside this, an error says how much of it the objective is to blame for, and how much the model.
"""

from __future__ import annotations

from collections.abc import Callable

from torch import Tensor

from rsrm_gen.trainer.fit import Fit, Schedule, Targets, shape_bounds, two_parts
from rsrm_gen.trainer.gauss_newton import effective_count
from rsrm_gen.trainer.model import ArrivalTime, SplatField
from rsrm_gen.trainer.response import Arrival

ITERATIONS = 34  # as many as `objective: paths` takes
MOST = 5000  # parameters, beyond which an iteration takes seconds


def can_be_fitted(arrival: ArrivalTime, points: int) -> bool:
    """Whether so many points determine the model's parameters, and these are few enough."""
    parameters = arrival.field.count * effective_count(arrival.manifold.dim)
    return 0 < parameters <= min(MOST, points)


def fitted(arrival: ArrivalTime, x: Tensor, time: Tensor, tell: Callable[[int, int], None]) -> ArrivalTime:
    """A model like this one, with other splats: those that give the times (N,) at x (N, D) best.

    `tell` hears how many of how many iterations are done.
    """
    old, manifold = arrival.field, arrival.manifold
    dtype = old.mu.dtype
    x = x.to(dtype)
    field = SplatField(manifold, old.count, dtype)
    model = ArrivalTime(field, arrival.link, manifold, arrival.goal, arrival.base)
    targets = Targets(x, time.to(dtype), x.new_ones(len(x)))
    (first, early), (_, late) = two_parts(ITERATIONS)
    moved = early | {first + iteration: share for iteration, share in late.items()}
    fit = Fit(field, Arrival(model), targets, Schedule(ITERATIONS, moved, shape_bounds(manifold, x)))
    fit.place(old.count)
    while not fit.done:
        tell(fit.iteration, ITERATIONS)
        fit.advance()
    return model
