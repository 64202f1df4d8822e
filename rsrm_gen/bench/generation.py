"""How long rsrm-gen takes: cold, in a fresh process with an empty cache, and again when nothing has changed.

Cold is counted in CPU seconds on one core, the C compiler's included, so that a busy machine gives the same figure; the
unchanged run is what a person waits for, in seconds on the wall.
"""

from __future__ import annotations

import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from rsrm_gen.bench.table import Table, machine
from rsrm_gen.compiler.spec import ProductSpec, read_spec
from rsrm_gen.errors import UserError

Parameters = Mapping[str, int | float | str]
COMMAND = (sys.executable, "-c", "from rsrm_gen.compiler.cli import main; main()")
COLD, LARGE, UNCHANGED = (
    5.0,
    30.0,
    0.3,
)  # seconds: what is aimed at; LARGE is for products and more than eight dimensions
LARGE_DIMENSION = 8
ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")


@dataclass(frozen=True)
class Generation:
    """The seconds of every run of one manifold, and what is aimed at for the cold ones; or why it was not generated."""

    manifold: str
    target: float
    cold: tuple[float, ...] = ()
    unchanged: tuple[float, ...] = ()
    failure: str | None = None


def generation(
    cases: Sequence[tuple[Path, Parameters]], runs: int, say: Callable[[str], None] = lambda words: None
) -> list[Generation]:
    """Time `runs` cold generations of every manifold, and as many of it unchanged."""
    return [_of_manifold(file, parameters, runs, say) for file, parameters in cases]


def tables(results: Sequence[Generation]) -> list[Table]:
    """The medians beside what is aimed at."""
    headings = ("manifold", "cold, CPU s", "aimed at", "unchanged, wall s", "aimed at")
    rows = [(r.manifold, _median(r.cold), f"{r.target:g}", _median(r.unchanged), f"{UNCHANGED:g}") for r in results]
    return [Table("Generation", headings, tuple(rows))]


def foot(results: Sequence[Generation]) -> str:
    """What is needed to read the table and to repeat it."""
    failures = "".join(f"{r.manifold} is not generated: {r.failure}\n\n" for r in results if r.failure)
    runs = max((len(r.cold) for r in results), default=0)
    counted = f"Medians of {runs} runs" if runs > 1 else "One run"
    return (
        f"{failures}{counted}. Cold: CPU seconds on one core, in a fresh process with an empty cache, audit and C compiler "
        f"included. Unchanged: seconds until the same command, said again, is done. {machine()}."
    )


def document(results: Sequence[Generation]) -> dict[str, Any]:
    """Plain data for JSON."""
    return {"machine": machine(), "unchanged_target": UNCHANGED, "manifolds": [asdict(result) for result in results]}


def _median(seconds: Sequence[float]) -> str:
    return f"{statistics.median(seconds):.2f}" if seconds else "fails"


def _of_manifold(file: Path, parameters: Parameters, runs: int, say: Callable[[str], None]) -> Generation:
    spec = read_spec(file, parameters)
    target = LARGE if spec.dim > LARGE_DIMENSION or isinstance(spec, ProductSpec) else COLD
    cold, unchanged = [], []
    for run in range(runs):
        say(f"{spec.identifier}: run {run + 1} of {runs}")
        with tempfile.TemporaryDirectory() as folder:
            try:
                cold.append(_seconds(file, parameters, Path(folder))[0])
                unchanged.append(_seconds(file, parameters, Path(folder))[1])
            except UserError as error:
                return Generation(spec.identifier, target, failure=error.message)
    return Generation(spec.identifier, target, tuple(cold), tuple(unchanged))


def _seconds(file: Path, parameters: Parameters, folder: Path) -> tuple[float, float]:
    """The CPU seconds, children's included, and the wall seconds of one generation into a folder; raises if it fails."""
    options = [word for name, value in parameters.items() for word in ("-p", f"{name}={value}")]
    command = [*COMMAND, str(file.resolve()), *options, "-o", str(folder / "generated")]
    environment = {**os.environ, **ONE_THREAD, "RSRM_GEN_CACHE": str(folder / "cache"), "COLUMNS": "200"}
    start, before = time.perf_counter(), _children()
    made = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    wall, cpu = time.perf_counter() - start, _children() - before
    if made.returncode:
        raise UserError(made.stderr.strip())
    return cpu, wall


def _children() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime
