"""The committed code in generated/ is what the compiler makes of manifolds/ today, to the byte."""

from __future__ import annotations

import difflib
import re
from collections.abc import Mapping

import pytest
from compiled import MANIFOLDS, NAMES, needs_compiler

from rsrm_gen.compiler.driver import compile_manifold
from rsrm_gen.compiler.output import contents

GENERATED = MANIFOLDS.parent / "generated"
SHOWN = 60  # lines of a difference


def committed(name: str) -> dict[str, str]:
    return {path.name: path.read_bytes().decode() for path in (GENERATED / name).iterdir() if path.is_file()}


def difference(old: Mapping[str, str], new: Mapping[str, str]) -> str:
    """What a person sees who forgot to generate again; empty if there is nothing to see."""
    lines: list[str] = []
    for file in sorted({*old, *new}):
        before, after = (texts.get(file, "").splitlines(keepends=True) for texts in (old, new))
        lines += difflib.unified_diff(before, after, f"committed/{file}", f"generated/{file}")
    return "".join(lines[:SHOWN])


@needs_compiler  # the heading tells the measured accuracy of both back ends
@pytest.mark.parametrize("name", NAMES)
def test_generating_again_gives_the_committed_bytes(name: str) -> None:
    old, new = committed(name), contents(compile_manifold(MANIFOLDS / f"{name}.yaml"))
    if old != new:
        pytest.fail(
            f"generated/{name} is not what the compiler makes; `make update` writes it.\n{difference(old, new)}",
            pytrace=False,
        )


def test_a_difference_is_shown_short_and_with_its_file() -> None:
    shown = difference({"a.h": "same\nold\n", "b.c": "x\n"}, {"a.h": "same\nnew\n", "b.c": "y\n" * 200})
    assert "committed/a.h" in shown
    assert "-old\n+new\n" in shown
    assert shown.count("\n") == SHOWN
    assert difference({"a.h": "same\n"}, {"a.h": "same\n"}) == ""


def test_every_manifold_is_there_and_nothing_else() -> None:
    assert sorted(path.name for path in GENERATED.iterdir()) == NAMES
    for name in NAMES:
        assert {*committed(name)} == {f"{name}.py", f"{name}.h", f"{name}.c", f"{name}_splats.c", "audit.json"}


@pytest.mark.parametrize("name", NAMES)
def test_no_file_holds_a_path_or_a_date(name: str) -> None:
    for file, text in committed(name).items():
        assert str(MANIFOLDS.parent) not in text, file
        assert not re.search(r"/(home|tmp|usr|root|var|Users)/|[A-Z]:\\", text), file
        assert not re.search(r"\b(19|20)\d\d-\d\d-\d\d|\b\d\d:\d\d:\d\d\b", text), file


def test_headings_tell_the_accuracy_that_the_audit_measured() -> None:
    for name in NAMES:
        for file in (f"{name}.py", f"{name}.h"):
            head = (GENERATED / name / file).read_text()[:4000]
            assert re.search(r"\blog_abs_det +\d+ +<= \d+ +<= \d+\n", head), file


def test_generated_code_is_plain_text_for_every_tool() -> None:
    for path in (GENERATED / name / file for name in NAMES for file in committed(name)):
        data = path.read_bytes()
        assert data.endswith(b"\n"), path.name
        assert b"\r" not in data, path.name
        assert b"\t" not in data, path.name
