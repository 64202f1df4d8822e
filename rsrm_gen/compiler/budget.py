"""What a compilation may cost, in seconds of the processor and in operations: a file that explodes ends in an error.

    with limited(seconds=60):             the driver, around a stage
        with blamed(formula.span):        whoever works on a formula
            spend(operations=27)          wherever work is done

The budget in force is found by its context and not passed along, for every loop of every stage would have to carry it. It
takes nothing from one stage to the next: it can only end a compilation. Outside of a `with limited` nothing is limited; a
budget belongs to one thread and is gone when its `with` ends.

What cannot be interrupted is bounded beforehand, by the size of what it is given: see `derive/bounds.py`.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass

from rsrm_gen.errors import Span, UserError

SECONDS = 60.0
OPERATIONS = 1_000_000  # bundled manifolds take up to 15,000 of one stage (dual_arm, lower)
HINT = "write it with fewer operations, name parts that are used twice with `let`, give `log_det:` in closed form"


@dataclass
class _Budget:
    """What is left, and which formula is being worked on."""

    stage: str
    seconds: float
    operations: int
    deadline: float
    left: int
    blamed: Span | None = None


_in_force: ContextVar[_Budget | None] = ContextVar("budget", default=None)


@contextmanager
def limited(stage: str, seconds: float = SECONDS, operations: int = OPERATIONS) -> Iterator[None]:
    """Let what is done inside take so many seconds of this thread and so many operations, or raise `UserError`."""
    budget = _Budget(stage, seconds, operations, time.thread_time() + seconds, operations)
    token = _in_force.set(budget)
    try:
        yield
    finally:
        _in_force.reset(token)


@contextmanager
def blamed(span: Span) -> Iterator[None]:
    """Name the formula to point at if the budget runs out inside."""
    budget = _in_force.get()
    if budget is None:
        yield
        return
    before, budget.blamed = budget.blamed, span
    try:
        yield
    finally:
        budget.blamed = before


def spend(operations: int = 0) -> None:
    """Take some operations, and the time that has passed, from the budget; raises `UserError` when either is used up."""
    budget = _in_force.get()
    if budget is None:
        return
    budget.left -= operations
    if budget.left < 0:
        raise UserError(f"this takes more than {budget.operations} operations to {budget.stage}", budget.blamed, HINT)
    if time.thread_time() > budget.deadline:
        hint = f"{HINT}; or allow more than {budget.seconds:g} s with --budget"
        raise UserError(f"this takes more than {budget.seconds:g} s to {budget.stage}", budget.blamed, hint)


def seconds_left() -> float | None:
    """How many seconds are left, at least one; None where nothing is limited."""
    budget = _in_force.get()
    return None if budget is None else max(budget.deadline - time.thread_time(), 1.0)
