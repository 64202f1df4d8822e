"""Where the time of a training step goes: every phase of a step ends with a lap of a clock, which is stopped or runs."""

from __future__ import annotations

import statistics
import time
from collections import defaultdict
from dataclasses import dataclass

from rich.table import Table


class Clock:
    """A clock that is stopped: a lap costs nothing."""

    def lap(self, phase: str) -> None:
        """The time since the last lap was spent on this phase."""

    def step(self) -> None:
        """A step ends here."""


NO_CLOCK = Clock()


class StopWatch(Clock):
    """A clock that runs."""

    def __init__(self, warm: int = 0) -> None:
        """It starts at once; so many first steps do not count."""
        self.steps = -warm
        self.seconds: dict[str, list[float]] = defaultdict(list)  # of every step in which a phase occurred
        self._step: dict[str, float] = {}
        self._last = time.perf_counter()

    def lap(self, phase: str) -> None:
        """The time since the last lap was spent on this phase."""
        now = time.perf_counter()
        self._step[phase] = self._step.get(phase, 0.0) + now - self._last
        self._last = now

    def step(self) -> None:
        """Keep the laps of this step."""
        self.steps += 1
        for phase, seconds in self._step.items():
            self.seconds[phase] += [seconds] if self.steps > 0 else []
        self._step.clear()
        self._last = time.perf_counter()

    def typical(self) -> dict[str, Phase]:
        """Every phase by name: robust against what else the machine does."""
        return {name: Phase(statistics.median(s), len(s) / self.steps) for name, s in self.seconds.items()}


@dataclass(frozen=True)
class Phase:
    """The median seconds of a phase in the steps in which it occurs, and their share of all steps."""

    median: float
    frequency: float

    @property
    def per_step(self) -> float:
        """Seconds of an average step."""
        return self.median * self.frequency


def table(watch: StopWatch) -> Table:
    """The phases of a step in the order of their first lap, with their shares; the kernel's are those of the splats."""
    phases = watch.typical()
    total = sum(phase.per_step for phase in phases.values())
    shown = Table(box=None, pad_edge=False, header_style="dim")
    for heading in ("phase", "median ms", "every .. steps", "ms a step", "share"):
        shown.add_column(heading, justify="left" if heading == "phase" else "right", no_wrap=True)

    def row(name: str, median: str, every: str, seconds: float) -> None:
        shown.add_row(name, median, every, f"{1000 * seconds:.3f}", f"{100 * seconds / total:.1f} %")

    for name, phase in phases.items():
        row(name, f"{1000 * phase.median:.3f}", f"{1 / phase.frequency:.3g}", phase.per_step)
    row("a step", "", "", total)
    row("outside the kernel", "", "", sum(p.per_step for name, p in phases.items() if not name.startswith("kernel")))
    return shown
