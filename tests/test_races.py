"""The generated C on several threads under the thread sanitizer.

The sanitizer does not know the compiler's OpenMP library, and would take its barriers for none. So the programs are
linked with another one, in which the threads and their barriers are plain POSIX ones.
"""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest
from c_drivers import driver, oracle_rows, rows
from compiled import NAMES, files, program

SPLATS = (1, 70)  # fewer than a vector has, and enough for every thread
THREADS = 4
SANITIZE = ("-std=gnu11", "-O1", "-g", "-fsanitize=thread")

# What gcc makes of `omp parallel` and `omp for schedule(dynamic)`. Chunks go round the threads, so that all of them work
# however short a loop is, and only barriers keep them from each other's numbers.
OPENMP = """
#include <pthread.h>
#include <stdbool.h>
#include <stdlib.h>

typedef unsigned long long number;

static struct {
    unsigned threads;
    pthread_barrier_t barrier;
    void (*body)(void *);
    void *data;
} team;
static _Thread_local number thread, next, last, step;

static void *member(void *index) {
    thread = (number)(size_t)index;
    team.body(team.data);
    return NULL;
}

void GOMP_parallel(void (*body)(void *), void *data, unsigned threads, unsigned flags) {
    (void)flags;
    pthread_t others[64];
    team.threads = threads;
    team.body = body;
    team.data = data;
    pthread_barrier_init(&team.barrier, NULL, threads);
    for (size_t i = 1; i < threads; ++i)
        if (pthread_create(others + i, NULL, member, (void *)i)) abort();
    member(NULL);
    for (size_t i = 1; i < threads; ++i) pthread_join(others[i], NULL);
    pthread_barrier_destroy(&team.barrier);
}

bool GOMP_loop_ull_nonmonotonic_dynamic_next(number *from, number *to) {
    if (next >= last) return false;
    *from = next;
    *to = next + step < last ? next + step : last;
    next += step * team.threads;
    return true;
}

bool GOMP_loop_ull_nonmonotonic_dynamic_start(
    bool up, number start, number end, number increment, number chunk, number *from, number *to) {
    if (!up) abort();
    step = increment * chunk;
    next = start + thread * step;
    last = end;
    return GOMP_loop_ull_nonmonotonic_dynamic_next(from, to);
}

void GOMP_loop_end_nowait(void) {}

void GOMP_loop_end(void) { pthread_barrier_wait(&team.barrier); }
"""


def sanitizer_is_missing(folder: Path) -> str | None:
    """Why no C program runs under the thread sanitizer here, if none does."""
    source = "#include <pthread.h>\nint main(void) { return 0; }\n"
    (folder / "empty.c").write_text(source, encoding="utf-8")
    try:
        subprocess.run(["gcc", *SANITIZE, "empty.c", "-o", "empty"], cwd=folder, capture_output=True, check=True)
        subprocess.run([folder / "empty"], capture_output=True, check=True)
    except FileNotFoundError:
        return "no gcc on this machine"
    except subprocess.CalledProcessError:
        return "programs under gcc's thread sanitizer do not run here"
    return None


def reported(name: str, texts: dict[str, str], folder: Path) -> str:
    """What the sanitizer says of a program that runs all functions on several threads."""
    if why := sanitizer_is_missing(folder):
        pytest.skip(why)
    texts = {**texts, "driver.c": driver(program(name), SPLATS, THREADS), "openmp.c": OPENMP}
    for file, text in texts.items():
        (folder / file).write_text(text, encoding="utf-8")
    # Compiled with OpenMP, linked without its library.
    for source in ("driver", name, f"{name}_splats", "openmp"):
        command = ["gcc", *SANITIZE, *(["-fopenmp"] if source.endswith("_splats") else []), "-c", f"{source}.c"]
        made = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
        assert made.returncode == 0, made.stderr
    objects = [f"{source}.o" for source in ("driver", name, f"{name}_splats", "openmp")]
    command = ["gcc", "-fsanitize=thread", *objects, "-o", "driver", "-lm", "-lpthread"]
    made = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert made.returncode == 0, made.stderr
    (folder / "rows").write_bytes(rows(program(name), oracle_rows(name)))
    environment = {**os.environ, "TSAN_OPTIONS": "exitcode=9 halt_on_error=1"}
    ran = subprocess.run(
        [folder / "driver", "rows"], cwd=folder, env=environment, capture_output=True, text=True, check=False
    )
    assert ran.returncode in (0, 9), ran.stderr
    return ran.stderr


@pytest.mark.parametrize("name", NAMES)
def test_threads_keep_off_each_others_numbers(name: str, tmp_path: Path) -> None:
    assert reported(name, files(name), tmp_path) == ""


@pytest.mark.parametrize("function", ["splats", "splats_vjp", "splats_rows"])
def test_the_sanitizer_sees_a_barrier_that_is_missing(function: str, tmp_path: Path) -> None:
    texts = files("torus")
    text = texts["torus_splats.c"]
    start = text.index(f"void torus_{function}(")
    barriers = "OMP(omp for schedule(dynamic, 8))" if function == "splats_vjp" else "OMP(omp for schedule(dynamic))"
    assert barriers in text[start:]
    loose = text[start:].replace(barriers, barriers[:-1] + " nowait)", 1)
    assert "data race" in reported("torus", {**texts, "torus_splats.c": text[:start] + loose}, tmp_path)
