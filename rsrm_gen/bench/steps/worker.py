"""A process that runs the steps of one contender on so many cores: `python -m rsrm_gen.bench.steps.worker KEY THREADS`.

It reads a request a line, as JSON, and answers each with a line:

    {"do": "prepare", "problem": file, "precision", "manifold", "name", "parameters", "chunk": points, or null to try}
        -> {"chunk", "loss", "first": seconds of the first step, compilation included, "seconds": of the next}
    {"do": "save", "file"}     -> {}: loss and gradients of the prepared step, into a file for numpy
    {"do": "time", "steps"}    -> {"seconds": of one step, the mean of so many}

What fails is answered with {"error": words}, and the process lives on.
"""

from __future__ import annotations

import gc
import json
import os
import sys
import time
import warnings
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from rsrm_gen.bench.steps.problem import Problem, read_problem

PAIRS = (2**15, 2**17, 2**19)  # of a point and a splat: chunks that are tried
Step = Callable[[], tuple[Any, tuple[Any, ...]]]
Make = Callable[[Problem, int], Step]


def main() -> None:
    """Answer requests until there are no more."""
    key, threads = sys.argv[1], int(sys.argv[2])
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)  # what libraries print is no answer
    confine(threads)
    warnings.simplefilter("ignore")
    worker = Worker(key)
    for line in sys.stdin:
        try:
            answer = worker.answer(json.loads(line))
        except Exception as error:  # any: it is the contender's, and what the table says of it
            answer = {"error": f"{type(error).__name__}: {str(error).strip().partition(chr(10))[0]}"}
        print(json.dumps(answer), file=answers, flush=True)


def confine(threads: int) -> None:
    """This process onto so many cores, before any library counts them."""
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, set(sorted(os.sched_getaffinity(0))[:threads]))


class Worker:
    """The step that is prepared, and what is asked of it."""

    def __init__(self, key: str) -> None:
        self.key = key
        self.step: Step | None = None

    def answer(self, request: Mapping[str, Any]) -> dict[str, Any]:
        """One request."""
        if request["do"] == "prepare":
            self.step = None
            gc.collect()
            problem = read_problem(Path(request["problem"]), request["precision"])
            return self.prepare(maker(self.key, request), problem, request["chunk"])
        assert self.step is not None
        if request["do"] == "save":
            loss, gradients = self.step()
            v, mu, A = map(np.asarray, gradients)
            np.savez(request["file"], loss=np.asarray(loss), v=v, mu=mu, A=A)
            return {}
        return {"seconds": timed(self.step, request["steps"])}

    def prepare(self, make: Make, problem: Problem, chunk: int | None) -> dict[str, Any]:
        """A step of all points, in chunks of a given size or of that which is the fastest on one chunk."""
        points, splats = len(problem.x), len(problem.v)
        if chunk is None:
            sizes = sorted({divisor(points, pairs // splats) for pairs in PAIRS})
            chunk = min(sizes, key=lambda n: _trial(make, problem, n)) if len(sizes) > 1 else sizes[0]
        start = time.perf_counter()
        self.step = make(problem, chunk)
        loss = float(self.step()[0])
        first = time.perf_counter() - start
        return {"chunk": chunk, "loss": loss, "first": first, "seconds": timed(self.step, 1)}


def divisor(count: int, most: int) -> int:
    """The largest divisor of a count that is at most a number: chunks of one size."""
    return next(n for n in range(max(1, min(most, count)), 0, -1) if count % n == 0)


def timed(step: Step, steps: int) -> float:
    """Seconds a step: the mean of so many, after one that wakes threads and fills caches if that is cheap."""
    gc.collect()
    gc.disable()
    try:
        if steps > 1:
            step()
        start = time.perf_counter()
        for _ in range(steps):
            step()
        return (time.perf_counter() - start) / steps
    finally:
        gc.enable()


def maker(key: str, request: Mapping[str, Any]) -> Make:
    """What makes a contender's step of a problem and a chunk."""
    name = request["name"]
    if key in ("ours", "kernel", "culled"):
        from rsrm_gen.bench.steps import ours
        from rsrm_gen.load import load

        manifold, make = load(request["manifold"], **request["parameters"]), getattr(ours, _FUNCTIONS[key])
        return lambda problem, chunk: make(manifold, problem)
    if key.startswith("jax"):
        from rsrm_gen.bench.steps import in_jax as module
    else:
        from rsrm_gen.bench.steps import in_torch as module  # type: ignore[no-redef]
    make = getattr(module, _FUNCTIONS[key])
    return lambda problem, chunk: make(name, problem, chunk)


_FUNCTIONS = {
    "eager": "eager",
    "analytic": "analytic",
    "compiled": "compiled",
    "jax": "doubly",
    "jax-analytic": "analytic",
    "ours": "whole",
    "kernel": "kernel",
    "culled": "culled",
}


def _trial(make: Make, problem: Problem, chunk: int) -> float:
    """Seconds a point, of one chunk: the better of two steps after the first."""
    part = problem.part(chunk, len(problem.v))
    step = make(part, chunk)
    step()
    return min(timed(step, 1) for _ in range(2)) / chunk


if __name__ == "__main__":
    main()
