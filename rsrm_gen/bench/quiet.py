"""How busy a machine is with something else: figures that were taken beside other programs are none."""

from __future__ import annotations

import time
from pathlib import Path

SETTLE, WATCH = 0.02, 0.1  # seconds until our own threads have gone to sleep, and to watch the others
LOUD = 0.15  # cores used by others above which a run is disturbed: more than one tick of the watch


def busy_cores() -> float | None:
    """The cores that programs use while this one and its workers wait; None where the system does not say."""
    time.sleep(SETTLE)
    before = _ticks()
    time.sleep(WATCH)
    after = _ticks()
    if before is None or after is None:
        return None
    total, cores = sum(after[0]) - sum(before[0]), after[1]
    idle = sum(after[0][3:5]) - sum(before[0][3:5])  # idle, and waiting for a disk
    return cores * (1 - idle / total) if total > 0 else 0.0


def _ticks() -> tuple[list[int], int] | None:
    """What all cores did so far (user, nice, system, idle, iowait, ...), and how many they are."""
    try:
        lines = Path("/proc/stat").read_text(encoding="utf-8").splitlines()
    except OSError:
        return None
    words = lines[0].split()[1:9]  # guests are counted as users
    return [int(word) for word in words], sum(line.startswith("cpu") for line in lines) - 1
