"""Numbers for the page's script: arrays in 16 bits, lines end to end."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from typing import Any

import numpy as np

from rsrm_gen.trainer.views.plane import Array

STEPS = 65534  # 65535 stands for NaN


def packed(values: Array) -> dict[str, Any]:
    """Numbers of any shape as `low`, `high` and base64 of little-endian integers; infinite ones become the largest."""
    flat = np.asarray(values, dtype=np.float64).reshape(-1)
    finite = flat[np.isfinite(flat)]
    low, high = (float(finite.min()), float(finite.max())) if len(finite) else (0.0, 0.0)
    shares = (np.clip(np.nan_to_num(flat, nan=low), low, high) - low) / ((high - low) or 1.0)
    steps = np.where(np.isnan(flat), STEPS + 1, np.round(STEPS * shares)).astype("<u2")
    return {"low": low, "high": high, "data": base64.b64encode(steps.tobytes()).decode()}


def packed_lines(lines: Sequence[Array]) -> dict[str, Any]:
    """Lines (k, n) end to end, with the index at which each starts."""
    starts = np.cumsum([0, *(len(line) for line in lines)])[:-1]
    size = lines[0].shape[-1] if lines else 3
    return {"starts": starts.tolist(), **packed(np.concatenate(lines) if lines else np.zeros((0, size)))}
