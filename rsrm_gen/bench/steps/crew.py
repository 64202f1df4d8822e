"""Worker processes, one a contender, and what the parent asks of them."""

from __future__ import annotations

import contextlib
import json
import os
import queue
import subprocess
import sys
import threading
from collections.abc import Mapping
from types import TracebackType
from typing import Any, Self

from rsrm_gen.bench.steps import Contender
from rsrm_gen.files import PACKAGE

COMMAND = (sys.executable, "-m", "rsrm_gen.bench.steps.worker")
START = 120.0  # seconds that a worker may take beyond what a request may: to start, and to import its libraries


class FailedError(Exception):
    """What a contender could not do, in words for a table."""


class Crew:
    """A worker for each contender that is asked for something, all on the same number of cores; a context manager."""

    def __init__(self, threads: int) -> None:
        self.threads = threads
        self.workers: dict[str, _Process] = {}

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        for worker in self.workers.values():
            worker.stop()
        self.workers.clear()

    def ask(self, contender: Contender, seconds: float, **request: Any) -> dict[str, Any]:
        """The answer to a request; raises `FailedError` if it is an error or takes longer than so many seconds."""
        fresh = contender.key not in self.workers
        if fresh:
            self.workers[contender.key] = _Process(contender.key, self.threads)
        answer = self.workers[contender.key].ask(request, seconds + START * fresh)
        if answer is None:
            self.workers.pop(contender.key).stop()
            raise FailedError(f"stopped after {seconds:g} s, or died")
        if "error" in answer:
            raise FailedError(str(answer["error"]))
        return answer


class _Process:
    def __init__(self, key: str, threads: int) -> None:
        self.process = subprocess.Popen(
            [*COMMAND, key, str(threads)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
            env=environment(threads),
        )
        self.lines: queue.Queue[str] = queue.Queue()
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self) -> None:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            self.lines.put(line)
        self.lines.put("")  # the worker is gone

    def ask(self, request: Mapping[str, Any], seconds: float) -> dict[str, Any] | None:
        """The answer, or None if there is none in time."""
        assert self.process.stdin is not None
        try:
            self.process.stdin.write(json.dumps(request) + "\n")
            self.process.stdin.flush()
            line = self.lines.get(timeout=seconds)
        except (OSError, queue.Empty):
            return None
        answer: dict[str, Any] | None = json.loads(line) if line else None
        return answer

    def stop(self) -> None:
        """End the process."""
        self.process.kill()
        self.process.wait()
        for pipe in (self.process.stdin, self.process.stdout):
            assert pipe is not None
            with contextlib.suppress(OSError):  # of a dead process
                pipe.close()


def environment(threads: int) -> dict[str, str]:
    """The variables by which libraries are told how many threads to take; JAX counts the cores that it may use."""
    paths = [str(PACKAGE.parent), *filter(None, [os.environ.get("PYTHONPATH")])]
    counts = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), str(threads))
    return {
        **os.environ,
        **counts,
        "PYTHONPATH": os.pathsep.join(paths),
        "JAX_PLATFORMS": "cpu",
        "JAX_ENABLE_X64": "1",  # float32 arrays stay float32
        "TORCHINDUCTOR_FORCE_DISABLE_CACHES": "1",  # or the time to compile would be that of an earlier run
    }
