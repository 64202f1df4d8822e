"""RRT* and BIT* of OMPL on a scene: its states are a layout's numbers, its costs are those of the manifold's geodesics.

OMPL's Python package lets one define objectives and constraints, but no state space; so a layout's numbers are kept in OMPL's own
spaces: real vectors, circles, rotations, or an ambient space with a constraint that the generated projection meets.
Nothing that OMPL owns may refer to its own owner from Python: such circles are never freed.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import torch
from ompl import base, geometric, util

from rsrm_gen.bench.planners.contest import Found
from rsrm_gen.bench.planners.layout import Ambient, Angles, Layout, NormalCoordinates, Quaternions
from rsrm_gen.bench.planners.motion import Key, Motions
from rsrm_gen.trainer.curves import Array

PLANNERS: dict[str, Callable[[Any], Any]] = {"RRT*": geometric.RRTstar, "BIT*": geometric.BITstar}
COARSE, FINE = (
    0.99,
    0.005,
)  # part of the extent between checks along a motion: where there is nothing to check, and obstacles
STEP = 0.05  # of interpolation under a constraint, times the extent of the ambient box over that of the unit sphere

Read = Callable[[Any], Key]
Write = Callable[[Any, Sequence[float]], None]


@dataclass(frozen=True)
class _Space:
    """A space of OMPL and how the numbers of its states are read and written."""

    space: Any
    information: Any
    read: Read
    write: Write


def search(planner: str, layout: Layout, start: Array, budgets: Sequence[float]) -> list[Found]:
    """The best path after each of the times (seconds, rising), of one search that goes on."""
    util.setLogLevel(util.LOG_NONE)
    motions = Motions(layout)
    made = _space(layout)
    information, read = made.information, made.read
    information.setStateValidityChecker(lambda state: motions.inside(read(state)))
    information.setStateValidityCheckingResolution(FINE if layout.scene.forbid_obstacles else COARSE)
    information.setup()
    problem = _problem(made, layout, start)
    problem.setOptimizationObjective(_Slowness(information, motions, read))
    searching = PLANNERS[planner](information)
    searching.setProblemDefinition(problem)
    searching.setup()
    found, spent = [], 0.0
    for budget in budgets:
        begun = time.thread_time()
        searching.solve(base.PlannerTerminationCondition(lambda end=begun + budget - spent: time.thread_time() >= end))
        spent += time.thread_time() - begun
        found.append(Found(spent, _path(problem, motions, read), motions.count))
    return found


def _problem(made: _Space, layout: Layout, start: Array) -> Any:
    problem = base.ProblemDefinition(made.information)
    states = []
    for x in (torch.from_numpy(start), layout.scene.goal):
        state = made.information.allocState()
        made.write(state, layout.numbers(x))
        states.append(state)
    problem.setStartAndGoalStates(*states)
    return problem  # which has copies of them; Python frees these


class _Slowness(base.OptimizationObjective):  # type: ignore[misc]
    """The integral of the slowness along geodesics."""

    def __init__(self, information: Any, motions: Motions, read: Read) -> None:
        super().__init__(information)
        self.motions, self.read = motions, read

    def stateCost(self, state: Any) -> Any:  # noqa: N802
        return base.Cost(0.0)

    def motionCost(self, a: Any, b: Any) -> Any:  # noqa: N802
        return base.Cost(self.motions.cost(self.read(a), self.read(b)))

    def motionCostHeuristic(self, a: Any, b: Any) -> Any:  # noqa: N802
        return base.Cost(self.motions.bound(self.read(a), self.read(b)))


class _OnManifold(base.Constraint):  # type: ignore[misc]
    """Zero on the manifold, which the generated projection leads to."""

    def __init__(self, layout: Ambient) -> None:
        M = layout.scene.manifold
        super().__init__(M.point_size, M.point_size - M.dim)
        self.layout = layout

    def function(self, x: Array, out: Array) -> None:
        out[:] = np.linalg.norm(_projected(self.layout, x) - x)

    def project(self, x: Array) -> bool:
        x[:] = _projected(self.layout, x)
        return bool(np.isfinite(x).all())


def _path(problem: Any, motions: Motions, read: Read) -> tuple[Array, ...]:
    if not problem.hasExactSolution():
        return ()
    return tuple(motions.point(read(state)) for state in problem.getSolutionPath().getStates())


def _space(layout: Layout) -> _Space:
    match layout:
        case NormalCoordinates():
            d = layout.scene.manifold.dim
            return _reals([-layout.radius] * d, [layout.radius] * d)
        case Angles():
            return _circles(layout.weights)
        case Quaternions():
            space = base.SO3StateSpace()
            return _Space(space, base.SpaceInformation(space), _read_quaternion, _write_quaternion)
        case Ambient():
            return _constrained(layout)


def _reals(low: Sequence[float], high: Sequence[float]) -> _Space:
    space = _box(low, high)
    size = len(low)
    return _Space(space, base.SpaceInformation(space), lambda state: tuple(state[0:size]), _write_reals)


def _box(low: Sequence[float], high: Sequence[float]) -> Any:
    space, bounds = base.RealVectorStateSpace(len(low)), base.RealVectorBounds(len(low))
    for i, (least, most) in enumerate(zip(low, high, strict=True)):
        bounds.setLow(i, least)
        bounds.setHigh(i, most)
    space.setBounds(bounds)
    return space


def _circles(weights: Sequence[float]) -> _Space:
    space, axes = base.CompoundStateSpace(), range(len(weights))
    for weight in weights:
        space.addSubspace(base.SO2StateSpace(), weight)

    def write(state: Any, numbers: Sequence[float]) -> None:
        for i in axes:
            state[i].value = numbers[i]

    return _Space(space, base.SpaceInformation(space), lambda state: tuple([state[i].value for i in axes]), write)


def _constrained(layout: Ambient) -> _Space:
    size = layout.scene.manifold.point_size
    space = base.ProjectedStateSpace(_box(layout.low, layout.high), _OnManifold(layout))
    space.setDelta(STEP * max(high - low for low, high in zip(layout.low, layout.high, strict=True)) / 2)
    information = base.ConstrainedSpaceInformation(space)
    return _Space(
        space,
        information,
        lambda state: tuple([state[i] for i in range(size)]),
        lambda state, numbers: state.copy(np.array(numbers)),
    )


def _projected(layout: Ambient, x: Array) -> Array:
    """The point (D,) of the manifold that the numbers (D,) stand for."""
    projected: Array = layout.scene.manifold.project(torch.tensor(x)).numpy()
    return projected


def _write_reals(state: Any, numbers: Sequence[float]) -> None:
    for i, number in enumerate(numbers):
        state[i] = number


def _read_quaternion(state: Any) -> Key:
    return state.w, state.x, state.y, state.z


def _write_quaternion(state: Any, numbers: Sequence[float]) -> None:
    state.w, state.x, state.y, state.z = numbers
