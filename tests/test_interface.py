"""Generated code that was edited does not keep its promises: what is not a formula of the file is held to them too."""

from __future__ import annotations

import re
from typing import Any

import pytest
from compiled import files, geometry, needs_compiler, program

from rsrm_gen.compiler.audit.interface import check_interface
from rsrm_gen.compiler.audit.kernels import check_kernels
from rsrm_gen.compiler.audit.numbers import Code

EDITS = {
    "the gradient of a splat in torch": ("py", r"gradient1 = df1 - (?=x1)", "gradient1 = df1 + ", "functions torch"),
    "a mean for a sum": ("py", r"\.sum\(dim\) for", ".mean(dim) for", "sums torch"),
    "a frame of any length": ("py", r"row = row / self\.norm\(base, row\)\.unsqueeze\(-1\)", "row = 2 * row", "frame torch"),
    "points crowded at the centre": ("py", r"\*\* \(1 / self\.dim\)", "** 1.5", "sample ball"),
    "another diameter": ("py", r"\n    diameter = .*", "\n    diameter = 0.5", "constants"),
    "another radius": ("py", r"\n    injectivity_radius = .*", "\n    injectivity_radius = 9.0", "constants"),
    "periods that there are not": ("py", r"\n    periods = .*", "\n    periods = (1.0, None, None)", "constants"),
    "another dimension in C": ("h", r"SPHERE_DIM 2", "SPHERE_DIM 3", "constants"),
}  # fmt: skip
C_EDITS = {
    "the gradient of a splat in C": ("c", r"gradient1 = df1 - (?=x\[1\])", "gradient1 = df1 + ", "functions C"),
    "a frame twice as long in C": ("c", r"e\[j\] = left\[longest\]\[j\]", "e[j] = 2 * left[longest][j]", "frame C"),
}  # fmt: skip


def failures(suffix: str, old: str, new: str, check: Any = check_interface) -> set[str]:
    texts = dict(files("sphere"))
    edited, count = re.subn(old, new, texts[f"sphere.{suffix}"], count=1)
    assert count == 1, "the generated code no longer looks like this"
    texts[f"sphere.{suffix}"] = edited
    code = Code(geometry("sphere"), program("sphere"), texts)
    return {found.name for found in check(code) if not found.passed}


def test_code_as_it_was_generated_keeps_every_promise() -> None:
    assert failures("py", r"\A", "") == failures("py", r"\A", "", check_kernels) == set()


@pytest.mark.parametrize("name", EDITS)
def test_edited_code_is_caught(name: str) -> None:
    *edit, check = EDITS[name]
    found = failures(*edit, check_kernels if check.startswith("functions") else check_interface)
    assert found, "no check failed"
    assert any(failed.startswith(check) for failed in found)


@needs_compiler
@pytest.mark.parametrize("name", C_EDITS)
def test_edited_c_is_caught(name: str) -> None:
    *edit, check = C_EDITS[name]
    found = failures(*edit, check_kernels if check.startswith("functions") else check_interface)
    assert any(failed.startswith(check) for failed in found)
