"""What a person sees while a field is trained: a bar in a terminal, else a line every tenth; and what a long step is at."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, TextColumn, TimeRemainingColumn
from rich.progress import Progress as Bar

from rsrm_gen.trainer.objectives import Tell
from rsrm_gen.trainer.run import Metric
from rsrm_gen.trainer.train import Progress


@contextmanager
def show_progress(console: Console, first: int, steps: int) -> Iterator[tuple[Progress, Tell]]:
    """Callbacks for `train` that show steps `first` to `steps`, and what is done within a long one."""
    if not console.is_terminal:
        yield _lines(console, steps), _headings(console)
        return
    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TextColumn("loss {task.fields[loss]:.5f}  {task.fields[splats]} splats  {task.fields[pace]}"),
        TimeRemainingColumn(),
    )
    with Bar(*columns, console=console) as bar:
        task = bar.add_task("train", total=steps, completed=first, loss=float("nan"), splats=0, pace="")

        def update(metric: Metric) -> None:
            speed = bar.tasks[task].speed or 0.0
            bar.update(task, completed=metric.step, description=metric.phase)
            bar.update(task, loss=metric.loss, splats=metric.splats, pace=pace(speed))

        def tell(what: str, part: float) -> None:
            bar.update(task, description=f"{what} {100 * part:.0f} %")

        yield update, tell


def pace(speed: float) -> str:
    """Steps in a second, or the seconds of a step, whichever is more than one."""
    if not speed:
        return ""
    return f"{speed:.0f} steps/s" if speed >= 1 else f"{1 / speed:.1f} s a step"


def _lines(console: Console, steps: int) -> Progress:
    every = max(steps // 10, 1)

    def update(metric: Metric) -> None:
        if metric.step % every == 0 or metric.step == steps:
            left = metric.seconds / metric.step * (steps - metric.step)
            line = f"step {metric.step}/{steps}  loss {metric.loss:.5f}  {metric.splats} splats"
            speed = pace(metric.step / max(metric.seconds, 1e-9))
            console.print(f"{line}  {speed}  {left:.0f} s left", highlight=False, soft_wrap=True)

    return update


def _headings(console: Console) -> Tell:
    """Each thing once."""
    said: set[str] = set()

    def tell(what: str, part: float) -> None:
        if what not in said:
            said.add(what)
            console.print(what, highlight=False, soft_wrap=True)

    return tell
