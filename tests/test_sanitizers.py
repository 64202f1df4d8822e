"""The generated C under sanitizers, at the oracle's rows and at random bytes; and in both languages by both compilers."""

from __future__ import annotations

import os
import shutil
import subprocess
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from c_drivers import driver, oracle_rows, rows
from compiled import NAMES, files, program

SANITIZE = ("-fsanitize=address,undefined,float-cast-overflow", "-fno-sanitize-recover=all")
STRICT = ("-Wall", "-Wextra", "-Werror", "-pedantic")


@cache
def sanitizer_is_missing() -> str | None:
    """Why no C program runs under the sanitizers here, if none does."""
    cc = shutil.which(os.environ.get("CC") or "cc")
    if cc is None:
        return "no C compiler on this machine"
    with_main = [cc, *SANITIZE, "-x", "c", "-", "-o", "/dev/null"]
    made = subprocess.run(with_main, input="int main(void) { return 0; }", capture_output=True, text=True, check=False)
    return None if made.returncode == 0 else "the C compiler has no runtime library of the sanitizers"


@pytest.fixture(scope="module")
def sanitized(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Drivers that were built, by manifold."""
    return {}


def built(name: str, known: dict[str, Path], folder: Path) -> Path:
    """The driver of a manifold under the sanitizers."""
    if name not in known:
        for file, text in {**files(name), "driver.c": driver(program(name))}.items():
            (folder / file).write_text(text, encoding="utf-8")
        sources = ["driver.c", f"{name}.c", f"{name}_splats.c"]
        command = [os.environ.get("CC") or "cc", "-std=c99", *SANITIZE, *sources, "-o", "driver", "-lm"]
        made = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
        assert made.returncode == 0, made.stderr
        known[name] = folder / "driver"
    return known[name]


@pytest.mark.parametrize("inputs", ["oracle", "bytes"])
@pytest.mark.parametrize("name", NAMES)
def test_no_function_reads_or_writes_beyond_its_arguments_whatever_they_are(
    name: str, inputs: str, sanitized: dict[str, Path], tmp_path: Path
) -> None:
    if sanitizer_is_missing():
        pytest.skip(str(sanitizer_is_missing()))
    binary = built(name, sanitized, tmp_path)
    data = rows(program(name), oracle_rows(name))
    if inputs == "bytes":  # every bit pattern: NaN, infinities, denormal numbers
        data = np.random.default_rng(1).bytes(len(data))
    (tmp_path / "rows").write_bytes(data)
    environment = {**os.environ, "ASAN_OPTIONS": "detect_leaks=0", "UBSAN_OPTIONS": "print_stacktrace=1"}
    ran = subprocess.run(
        [str(binary), str(tmp_path / "rows")], env=environment, capture_output=True, text=True, check=False
    )
    assert (ran.returncode, ran.stderr) == (0, "")


def test_the_sanitizers_see_a_number_too_many(tmp_path: Path) -> None:
    if sanitizer_is_missing():
        pytest.skip(str(sanitizer_is_missing()))
    texts = {**files("torus"), "driver.c": driver(program("torus"))}
    texts["torus.c"] = texts["torus.c"].replace("v_out[1] = ", "v_out[2] = ", 1)
    for file, text in texts.items():
        (tmp_path / file).write_text(text, encoding="utf-8")
    command = [os.environ.get("CC") or "cc", "-std=c99", "-O1", *SANITIZE, "driver.c", "torus.c", "torus_splats.c"]
    subprocess.run([*command, "-o", "driver", "-lm"], cwd=tmp_path, check=True)
    (tmp_path / "rows").write_bytes(rows(program("torus"), {}))
    ran = subprocess.run([str(tmp_path / "driver"), "rows"], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert ran.returncode != 0
    assert "heap-buffer-overflow" in ran.stderr


LANGUAGES = {"C99": ("-std=c99",), "C++17": ("-x", "c++", "-std=c++17")}


@pytest.mark.parametrize("compiler", ["gcc", "clang"])
@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("name", NAMES)
def test_the_code_is_clean_in_both_languages_and_compilers(
    name: str, language: str, compiler: str, tmp_path: Path
) -> None:
    if shutil.which(compiler) is None:
        pytest.skip(f"no {compiler} on this machine")
    for file, text in files(name).items():
        (tmp_path / file).write_text(text, encoding="utf-8")
    command = [compiler, *LANGUAGES[language], *STRICT, "-fsyntax-only", f"{name}.c", f"{name}_splats.c"]
    made = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (made.returncode, made.stderr) == (0, "")
