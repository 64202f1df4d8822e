"""The medians of `rsrm bench kernels` as a picture: bars on a log axis, and what the peak of this machine would give."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import matplotlib
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rsrm_gen.bench.kernels import Kernels, Size
from rsrm_gen.files import write_whole

COLORS = {
    "eager": "#c44e52",
    "analytic": "#dd8452",
    "compiled": "#ccb974",
    "jax": "#8172b3",
    "jax-analytic": "#b3a9d0",
    "ours": "#2a7f62",
    "kernel": "#8fc9b3",
    "culled": "#c9e8dc",
}
STYLE: Any = {"font.size": 8, "axes.spines.top": False, "axes.spines.right": False, "svg.hashsalt": "rsrm"}
WIDTH = 0.84  # of a manifold's bars together


def draw(result: Kernels, path: Path) -> None:
    """A panel for each size and precision, with the most threads; the suffix of the file chooses the format."""
    threads = max(what[2] for what in result.timed)
    sizes = list(dict.fromkeys(what[3] for what in result.timed))
    precisions = list(dict.fromkeys(what[1] for what in result.timed))
    with matplotlib.rc_context(STYLE):
        figure = Figure(figsize=(max(6.5, 4.6 * len(precisions)), 2.4 * len(sizes) + 0.8), layout="constrained")
        panels: Any = figure.subplots(len(sizes), len(precisions), squeeze=False, sharey="row")
        for row, size in zip(panels, sizes, strict=True):
            for axes, precision in zip(row, precisions, strict=True):
                _panel(axes, result, precision, threads, size)
            row[0].set_ylabel("ms a step")
        handles, labels = panels[0][0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=3, frameon=False)
        write_whole(path, lambda file: figure.savefig(file, format=path.suffix.lstrip(".") or "png", dpi=160))


def _panel(axes: Axes, result: Kernels, precision: str, threads: int, size: Size) -> None:
    manifolds = list(dict.fromkeys(what[0] for what in result.timed))
    width = WIDTH / len(result.contenders)
    for k, contender in enumerate(result.contenders):
        places, heights = [], []
        for i, manifold in enumerate(manifolds):
            median = result.median((manifold, precision, threads, size), contender.key)
            if median is not None:
                places.append(i + (k + 0.5) * width - WIDTH / 2)
                heights.append(1e3 * median)
        axes.bar(places, heights, width, label=contender.name, color=COLORS[contender.key])
    for i, manifold in enumerate(manifolds):
        limit = result.at_peak((manifold, precision, threads, size))
        if limit is not None:
            label = "the kernel's operations at the measured peak" if i == 0 else "_"
            axes.hlines(1e3 * limit, i - WIDTH / 2, i + WIDTH / 2, colors="black", linewidth=1.2, label=label)
    axes.set_yscale("log")
    axes.set_xticks(range(len(manifolds)), [name.replace("_", " ") for name in manifolds])
    count = "one thread" if threads == 1 else f"{threads} threads"
    axes.set_title(f"{size[0]} points, {size[1]} splats, {precision}, {count}", loc="left")
