"""The most multiply-adds that this machine does in a second, measured by a loop that does nothing else."""

from __future__ import annotations

import ctypes
import time
from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache

from rsrm_gen.compiler.native import FAST, compiled

SOURCE = """
#include <stddef.h>
#if defined(__AVX512F__)
#define BYTES 64
#elif defined(__AVX__)
#define BYTES 32
#else
#define BYTES 16
#endif
/* Twelve independent sums: more than the latency of a multiply-add times how many begin in a cycle, fewer than registers. */
#define SUMS(OF) OF(0) OF(1) OF(2) OF(3) OF(4) OF(5) OF(6) OF(7) OF(8) OF(9) OF(10) OF(11)
#define BEGIN(i) vector a##i = one * (number)(i + 1);
#define STEP(i) a##i = a##i * b + c;
#define ADD(i) one += a##i;
#define PEAK(name, number_type)                                               \\
  double name(size_t count, double factor) {                                  \\
    typedef number_type number;                                               \\
    typedef number vector __attribute__((vector_size(BYTES)));                \\
    vector one, b, c;                                                         \\
    for (size_t i = 0; i < BYTES / sizeof(number); i++) one[i] = 1;           \\
    b = one * (number)factor;                                                 \\
    c = one - b;                                                              \\
    SUMS(BEGIN)                                                               \\
    for (size_t k = 0; k < count; k++) { SUMS(STEP) }                         \\
    SUMS(ADD)                                                                 \\
    double sum = 0;                                                           \\
    for (size_t i = 0; i < BYTES / sizeof(number); i++) sum += (double)one[i]; \\
    return sum;                                                               \\
  }                                                                           \\
  size_t name##_operations(void) { return 2 * 12 * (BYTES / sizeof(number_type)); }
PEAK(peak_float64, double)
PEAK(peak_float32, float)
"""
SECONDS = 0.1  # that one loop should take
ATTEMPTS = 5  # of which the best counts: what disturbs a loop never makes it faster


def fma_peak(precision: str, threads: int) -> float:
    """Operations in a second, of so many threads together; a multiply-add is two."""
    once = max(_rate(precision, threads, 10**5) for _ in range(2))
    count = max(10**5, int(SECONDS * once / threads / _operations(precision)))
    return max(_rate(precision, threads, count) for _ in range(ATTEMPTS))


def _rate(precision: str, threads: int, count: int) -> float:
    loop = getattr(_library(), f"peak_{precision}")
    loop.restype = ctypes.c_double
    with ThreadPoolExecutor(threads) as pool:
        list(pool.map(lambda _: loop(ctypes.c_size_t(1), ctypes.c_double(0.5)), range(threads)))  # the threads exist
        start = time.perf_counter()
        list(pool.map(lambda _: loop(ctypes.c_size_t(count), ctypes.c_double(0.5)), range(threads)))
        seconds = time.perf_counter() - start
    return _operations(precision) * count * threads / seconds


def _operations(precision: str) -> int:
    """Of one turn of the loop."""
    function = getattr(_library(), f"peak_{precision}_operations")
    function.restype = ctypes.c_size_t
    return int(function())


@lru_cache
def _library() -> ctypes.CDLL:
    return compiled({"peak.c": SOURCE}, "peak.c", FAST)
