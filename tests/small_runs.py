"""Runs of small scenes: made, broken off and compared, for the tests of training."""

from __future__ import annotations

import signal
from pathlib import Path

import numpy as np

from rsrm_gen.trainer.run import Arrays, Metric, RunFolder
from rsrm_gen.trainer.scene import Scene
from rsrm_gen.trainer.train import Outcome, train


def new_run(scene: Scene, path: Path) -> RunFolder:
    """The folder of a training that has not begun."""
    folder = RunFolder(path)
    folder.create(scene)
    return folder


def same(a: Arrays, b: Arrays) -> bool:
    """Whether two checkpoints are, but for the seconds."""
    timeless = a.keys() - {"seconds"}
    return a.keys() == b.keys() and all(np.array_equal(a[name], b[name]) for name in timeless)


def interrupted_after(step: int, scene: Scene, folder: RunFolder) -> Outcome:
    """A training with Ctrl-C after so many steps."""

    def ctrl_c(metric: Metric) -> None:
        if metric.step == step:
            signal.raise_signal(signal.SIGINT)

    return train(scene, folder, progress=ctrl_c)
