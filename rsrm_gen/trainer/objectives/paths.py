"""`objective: paths`, the default: labels, which are costs of real paths to the goal, and Gauss-Newton on the splats.

    labels     half of the points get labels (labels.py)
    fit        the first part of the iterations brings the splats to them (fit.py), some moved to where they are needed more
    refine     the other points get labels too, beginning with their neighbours' paths; in more than two dimensions, where a
               roadmap of so many points is coarse, the field leads the way and its paths are relaxed as well
    fit        the other iterations use all labels

Neither the residual of the equation nor a reference solution enters.
"""

from __future__ import annotations

import math
from functools import cached_property
from pathlib import Path

import numpy as np
import torch
from torch import Tensor

from rsrm_gen.trainer.curves import Curves, Terrain
from rsrm_gen.trainer.fit import Fit, Schedule, Targets, two_parts
from rsrm_gen.trainer.labels import Labels, exchanged, extended, label, offered, weighed
from rsrm_gen.trainer.objectives.objective import Tell, random_numbers, width_bounds
from rsrm_gen.trainer.plan import plan
from rsrm_gen.trainer.response import Arrival
from rsrm_gen.trainer.run import Arrays, first_rows, new_arrival
from rsrm_gen.trainer.sampling import sample_points
from rsrm_gen.trainer.scene import Scene
from rsrm_gen.trainer.settings import PathsTraining

STEP = 0.1  # of a descent whose path is relaxed afterwards; a length
LED = 4096  # descents at a time


class Paths:
    """The labels, the field, and one iteration of the fit."""

    def __init__(self, scene: Scene, tell: Tell) -> None:
        """At step 0, without labels and splats."""
        assert isinstance(scene.training, PathsTraining)
        self.scene = scene
        self.settings = scene.training
        self.tell = tell
        self.step, self.steps = 0, scene.training.steps
        self.phase = "labels"
        self.terrain = Terrain(scene)
        self.arrival = new_arrival(scene, scene.training.capacity)
        self.labels: Labels | None = None
        self.fit: Fit | None = None

    @property
    def first(self) -> int:
        """How many iterations the first part has."""
        return two_parts(self.steps)[0][0]

    def begin(self) -> None:
        """Nothing yet: labels take long, and belong to the first step."""

    def advance(self) -> float:
        """One iteration, after the labels that it needs: the RMS error of the labels in the open."""
        if self.labels is None:
            self.labels = label(self.terrain, self.points[: len(self.points) // 2], self._progress)
        elif self.step == self.first:
            self.labels = self._refined(self.labels, self.points[len(self.labels) :])
            targets = self._targets()
            self._fit().aim(targets, self._schedule(self.step, targets))
        fit = self._fit()
        if not self.arrival.field.count:
            fit.place(self.settings.splats.count)
        self.tell("fit", 0.0)
        record = fit.advance()
        if not math.isfinite(record.free_rms):
            raise FloatingPointError(f"the error of the labels is {record.free_rms}")
        self.step += 1
        self.phase = "fit"
        return record.free_rms

    def _fit(self) -> Fit:
        if self.fit is None:
            self.fit = self._new_fit(self.step)
        return self.fit

    def _new_fit(self, step: int) -> Fit:
        """A fit in the part of the training that this step belongs to."""
        targets = self._targets()
        return Fit(self.arrival.field, Arrival(self.arrival), targets, self._schedule(step, targets))

    def _targets(self) -> Targets:
        assert self.labels is not None
        x = torch.from_numpy(self.labels.x)
        weight = torch.from_numpy(weighed(self.terrain, x))
        return Targets(*(t.to(self.scene.goal.dtype) for t in (x, torch.from_numpy(self.labels.time), weight)))

    def _schedule(self, step: int, targets: Targets) -> Schedule:
        count, relocate = two_parts(self.steps)[step >= self.first]
        return Schedule(count, relocate, width_bounds(self.scene.manifold, self.settings.splats, targets.x))

    @cached_property
    def points(self) -> Tensor:
        """All points that get labels, in an order of which every part is spread out: (N, D), float64."""
        generator = random_numbers(self.settings.seed)
        x = sample_points(self.scene, self.settings.labelled, generator)
        return x[torch.randperm(len(x), generator=generator)]

    def _refined(self, labels: Labels, x: Tensor) -> Labels:
        self.phase = "labels"
        if self.scene.manifold.dim > 2:
            labels = self._led(labels)
        return extended(self.terrain, labels, x, self._progress)

    def _led(self, labels: Labels) -> Labels:
        """The labels, after the paths on which the field leads to the goal were relaxed and offered."""
        before = labels.time
        for start in range(0, len(labels), LED):
            self._progress("paths of the field", start, len(labels))
            rows = np.arange(start, min(start + LED, len(labels)))
            paths = plan(self.arrival, self.scene, torch.from_numpy(labels.x[rows]).to(self.scene.goal.dtype), STEP)
            reached = np.flatnonzero(paths.reached.numpy())
            if len(reached):
                curves = Curves.of([paths.points[i].double().numpy() for i in reached.tolist()])
                labels = offered(self.terrain, labels, rows[reached], curves)
        return exchanged(self.terrain, labels, labels.time < before, self._progress)

    def _progress(self, what: str, done: int, whole: int) -> None:
        self.tell(what, done / max(whole, 1))

    def final_loss(self) -> float:
        """The RMS error of the labels in the open."""
        return self._fit().errors()[1]

    def arrays(self) -> Arrays:
        """The splats, the damping, and the labels with their paths."""
        field = self.arrival.field
        fit = self.fit.arrays() if self.fit else first_rows(field.buffers_of_splats(), field.count)
        labels = {f"label_{name}": rows for name, rows in self.labels.arrays().items()} if self.labels else {}
        return {**fit, **labels, "step": np.array(self.step)}

    def restore(self, arrays: Arrays, path: Path) -> None:
        """Go back to what `arrays` gave; it was read from `path`."""
        self.step = int(arrays["step"])
        if self.step == 0:
            return
        known = {name.removeprefix("label_"): rows for name, rows in arrays.items() if name.startswith("label_")}
        self.labels = Labels.from_arrays(known)
        # The phase of the fit that the last iteration belonged to; the next one may begin another.
        self.fit = self._new_fit(self.step - 1)
        self.fit.restore(arrays, path)
