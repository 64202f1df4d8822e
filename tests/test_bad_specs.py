"""Every way in which a manifold file can be wrong, and the whole message that it gets.

`tests/bad_specs/NAME.yaml` is a file with one mistake, NAME.txt what `rsrm-gen NAME.yaml` prints. After a message was
changed on purpose, `python tests/test_bad_specs.py` writes all .txt files again: read the difference before you commit it.
`python tests/test_bad_specs.py --table` prints the name of each and the first line of its message.
"""

from __future__ import annotations

import contextlib
import difflib
import io
import os
import re
import sys
import tempfile
import unicodedata
from pathlib import Path

import pytest

from rsrm_gen.compiler import cli
from rsrm_gen.errors import WIDTH, printable

FOLDER = Path(__file__).parent / "bad_specs"
SPECS = sorted(FOLDER.glob("*.yaml"))


def said(spec: Path, work: Path) -> tuple[int, str]:
    """The exit code and the message of `rsrm-gen NAME.yaml` in a folder with that one file."""
    (work / spec.name).write_bytes(spec.read_bytes())
    printed, arguments, folder = io.StringIO(), sys.argv, Path.cwd()
    try:
        os.chdir(work)
        sys.argv = ["rsrm-gen", spec.name]
        with contextlib.redirect_stderr(printed), contextlib.redirect_stdout(io.StringIO()):
            cli.main()
        code: object = 0
    except SystemExit as end:
        code = end.code or 0
    finally:
        sys.argv = arguments
        os.chdir(folder)
    assert isinstance(code, int)
    return code, printed.getvalue()


def difference(expected: str, found: str, name: str) -> str:
    lines = (text.splitlines(keepends=True) for text in (expected, found))
    return "".join(difflib.unified_diff(*lines, f"bad_specs/{name}.txt", "what is said"))


@pytest.mark.parametrize("spec", SPECS, ids=lambda spec: spec.stem)
def test_a_bad_spec_gets_its_whole_message_and_nothing_is_written(spec: Path, tmp_path: Path) -> None:
    code, message = said(spec, tmp_path)
    expected = spec.with_suffix(".txt").read_text(encoding="utf-8")
    if message != expected:
        hint = "If this is what it should say: python tests/test_bad_specs.py"
        pytest.fail(f"{difference(expected, message, spec.stem)}\n{hint}", pytrace=False)
    assert code == 2
    assert [path.name for path in tmp_path.iterdir()] == [spec.name]


@pytest.mark.parametrize("spec", SPECS, ids=lambda spec: spec.stem)
def test_every_message_says_where_and_speaks_of_the_file(spec: Path) -> None:
    message = spec.with_suffix(".txt").read_text(encoding="utf-8")
    first, *rest = message.splitlines()
    assert re.match(rf"{re.escape(spec.name)}:\d+:\d+: error: |error: {re.escape(spec.name)} ", first)
    if not first.startswith("error"):
        line, column = map(int, first.split(":")[1:3])
        text = spec.read_bytes().decode("utf-8-sig", errors="replace")
        lines = re.split(r"\r\n|[\n\r\x85\u2028\u2029]", text)
        shown = printable(lines[line - 1])
        if len(shown) <= WIDTH:  # a longer one is shown in part
            assert rest[0] == f"  {shown}"
            assert rest[1].index("^") == 1 + column + sum(
                unicodedata.east_asian_width(c) in "WF" for c in shown[: column - 1]
            )
    python = ("Traceback", "NoneType", "sympy", "pydantic", "<class", "functools", "site-packages", "``")
    assert not any(word in message for word in python)


def test_there_are_many_and_each_has_its_message() -> None:
    assert len(SPECS) >= 65
    assert {spec.stem for spec in SPECS} == {path.stem for path in FOLDER.glob("*.txt")}


def _write_again() -> None:
    for spec in SPECS:
        with tempfile.TemporaryDirectory() as work:
            code, message = said(spec, Path(work))
        if code != 2:
            print(f"{spec.stem}: exit code {code}: it is not refused")
        spec.with_suffix(".txt").write_text(message, encoding="utf-8")


def _print_table() -> None:
    for spec in SPECS:
        first = spec.with_suffix(".txt").read_text(encoding="utf-8").splitlines()[0]
        print(f"{spec.stem:36} {first.partition('error: ')[2]}")


if __name__ == "__main__":
    _print_table() if "--table" in sys.argv else _write_again()
