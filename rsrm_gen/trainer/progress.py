"""What a person sees while a field is trained: a bar in a terminal, else a line every tenth."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, TextColumn, TimeRemainingColumn
from rich.progress import Progress as Bar

from rsrm_gen.trainer.run import Metric
from rsrm_gen.trainer.train import Progress


@contextmanager
def show_progress(console: Console, first: int, steps: int) -> Iterator[Progress]:
    """A callback for `train` that shows steps `first` to `steps`."""
    if not console.is_terminal:
        yield _lines(console, steps)
        return
    columns = (
        BarColumn(),
        MofNCompleteColumn(),
        TextColumn("loss {task.fields[loss]:.4f}  {task.fields[splats]} splats  {task.fields[pace]:.0f} steps/s"),
        TimeRemainingColumn(),
    )
    with Bar(*columns, console=console) as bar:
        task = bar.add_task("train", total=steps, completed=first, loss=float("nan"), splats=0, pace=0.0)

        def update(metric: Metric) -> None:
            pace = bar.tasks[task].speed or 0.0
            bar.update(task, completed=metric.step, loss=metric.loss, splats=metric.splats, pace=pace)

        yield update


def _lines(console: Console, steps: int) -> Progress:
    every = max(steps // 10, 1)

    def update(metric: Metric) -> None:
        if metric.step % every == 0 or metric.step == steps:
            left = metric.seconds / metric.step * (steps - metric.step)
            line = f"step {metric.step}/{steps}  loss {metric.loss:.4f}  {metric.splats} splats"
            pace = metric.step / max(metric.seconds, 1e-9)
            console.print(f"{line}  {pace:.0f} steps/s  {left:.0f} s left", highlight=False, soft_wrap=True)

    return update
