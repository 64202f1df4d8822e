"""What the paper reports: published.yaml as data."""

from __future__ import annotations

from functools import cache
from itertools import pairwise
from pathlib import Path

from pydantic import BaseModel, ConfigDict, TypeAdapter

from rsrm_gen.document import read_document
from rsrm_gen.errors import UserError, did_you_mean

FILE = Path(__file__).with_name("published.yaml")


class _Part(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class Figures(_Part):
    """A row of the paper's table: means over five seeds."""

    loss: float
    error: float  # RMS over the free cells of its grid, in units of T
    parameters: int
    milliseconds: float  # a step
    seconds: float  # of training


class NetworkShape(_Part):
    """An MLP with one output: so many hidden layers of one width, behind features of the coordinates."""

    width: int
    depth: int
    learning_rate: float
    divisor: float = 30  # of the first weights sqrt(6 / fan-in), as in the authors' released code
    frequency: float | None = None  # of sin and cos of each coordinate; None: the coordinates themselves

    def inputs(self, point_size: int) -> int:
        """How many features there are of a point of D numbers."""
        return point_size if self.frequency is None else 2 * point_size

    def parameters(self, point_size: int) -> int:
        """All weights and biases."""
        sizes = [self.inputs(point_size), *[self.width] * self.depth, 1]
        return sum((before + 1) * after for before, after in pairwise(sizes))

    def shrunk_to(self, parameters: int, point_size: int) -> NetworkShape:
        """The same depth with the width whose number of parameters is closest.

        With the first weights undivided: divided by 30, so narrow a network does not get away from T = d.
        """
        candidates = (self.model_copy(update={"width": width, "divisor": 1}) for width in range(1, self.width + 1))
        return min(candidates, key=lambda shape: abs(shape.parameters(point_size) - parameters))


class Published(_Part):
    """What is published of the experiments on one manifold."""

    rsrm: Figures
    mlp: Figures
    distance_error: float  # of T = d
    network: NetworkShape


@cache
def published() -> dict[str, Published]:
    """By the name of the manifold."""
    return TypeAdapter(dict[str, Published]).validate_python(read_document(FILE).data)


def published_on(manifold: str) -> Published:
    """Of one manifold; a `UserError` where the paper has none."""
    known = published()
    if manifold not in known:
        raise UserError(f"the paper has no experiment on `{manifold}`", hint=did_you_mean(manifold, known))
    return known[manifold]


def place(manifold: str) -> tuple[int, str]:
    """By which manifolds are sorted: as in the paper, others after them."""
    order = list(published())
    return (order.index(manifold) if manifold in order else len(order), manifold)
