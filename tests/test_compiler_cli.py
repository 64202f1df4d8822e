"""`rsrm-gen` as a person meets it: what it writes and prints, and its exit code."""

from __future__ import annotations

import re
import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path

import pytest
from commands import Command, Ran, in_a_process, runner, tree
from compiled import MANIFOLDS, needs_compiler

from rsrm_gen import __version__
from rsrm_gen.compiler.driver import compile_manifold
from rsrm_gen.compiler.output import contents, generator, write

FILES = ("{0}.py", "{0}.h", "{0}.c", "{0}_splats.c", "audit.json")


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Where the command runs: copies of two manifold files, and a place of its own for temporary files."""
    work = tmp_path / "work"
    (tmp_path / "temporary").mkdir()
    work.mkdir()
    for name in ("euclidean", "torus"):
        (work / f"{name}.yaml").write_text((MANIFOLDS / f"{name}.yaml").read_text())
    monkeypatch.chdir(work)
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "temporary"))
    return work


@pytest.fixture
def rsrm_gen_command(folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Command:
    """Runs `rsrm-gen ARGUMENTS` in this process, in the folder."""
    return runner(capsys, monkeypatch)


def names(folder: Path) -> set[str]:
    return {path.name for path in folder.iterdir()}


def files(name: str) -> set[str]:
    return {file.format(name) for file in FILES}


# What it writes.


@needs_compiler
def test_one_file_becomes_one_folder_of_code(folder: Path) -> None:
    ran = in_a_process(folder, "torus.yaml")
    assert (ran.code, ran.err) == (0, "")
    assert names(folder / "generated") == {"torus"}
    assert names(folder / "generated" / "torus") == files("torus")
    assert (folder / "generated/torus/torus.py").read_text() == (
        MANIFOLDS.parent / "generated/torus/torus.py"
    ).read_text()
    assert re.search(r"(?m)^torus +2 +\d+ +<= \d+ +<= \d+ +\d+ checks passed +\d+\.\d", ran.out)


def test_several_files_are_rows_of_one_table(rsrm_gen_command: Command, folder: Path) -> None:
    ran = rsrm_gen_command("torus.yaml", "euclidean.yaml", "--timings", "-o", "some/where")
    assert ran.code == 0
    assert names(folder / "some/where") == {"torus", "euclidean"}
    assert not (folder / "generated").exists()
    heading, *rows = ran.out.splitlines()
    assert heading.split()[-6:] == ["spec", "derive", "lower", "emit", "audit", "seconds"]
    assert [row.split()[0] for row in rows[:2]] == ["torus", "euclidean"]
    assert all(len(re.findall(r"\b\d+\.\d\d\b", row)) == 5 for row in rows[:2])


def test_parameters_are_part_of_the_name(rsrm_gen_command: Command, folder: Path) -> None:
    assert rsrm_gen_command("torus.yaml", "-p", "n=3").code == 0
    assert names(folder / "generated" / "torus_n3") == files("torus_n3")
    assert rsrm_gen_command("torus.yaml", "-p", "n=3", "--check").code == 0
    assert rsrm_gen_command("torus.yaml", "--check").code == 2  # another manifold, not generated yet


def test_generating_again_changes_no_byte(rsrm_gen_command: Command, folder: Path) -> None:
    assert rsrm_gen_command("euclidean.yaml").code == 0
    before = tree(folder)
    ran = rsrm_gen_command("euclidean.yaml", "--force")
    assert ran.code == 0
    assert "checks passed" in ran.out
    assert tree(folder) == before
    assert names(folder / "generated" / "euclidean") == files("euclidean")


def test_what_was_right_before_a_mistake_is_kept(rsrm_gen_command: Command, folder: Path) -> None:
    (folder / "wrong.yaml").write_text((folder / "torus.yaml").read_text().replace("wrap(p + v)", "wrap(p + w)"))
    ran = rsrm_gen_command("euclidean.yaml", "wrong.yaml", "torus.yaml")
    assert ran.code == 2
    assert "wrong.yaml:" in ran.err
    assert "euclidean" in ran.out
    assert names(folder / "generated") == {"euclidean"}


def test_version_and_help(rsrm_gen_command: Command) -> None:
    assert rsrm_gen_command("--version") == Ran(0, f"rsrm-gen {__version__}\n", "")
    ran = rsrm_gen_command("--help")
    assert ran.code == 0
    for example in (
        "rsrm-gen mine.yaml",
        "-p n=5",
        "--check",
        "manifolds/*.yaml",
        "audit",
        "explain",
        "schema",
        "list",
    ):
        assert example in ran.out
    for command in ("compile", "new", "list", "explain", "audit", "schema"):
        ran = rsrm_gen_command(command, "--help")
        assert ran.code == 0
        assert f"Usage: rsrm-gen {command}" in ran.out


# What it checks.


@pytest.fixture(scope="session")
def euclidean(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Generated code of a small manifold, made once."""
    folder = tmp_path_factory.mktemp("made") / "euclidean"
    write(contents(compile_manifold(MANIFOLDS / "euclidean.yaml")), folder)
    return folder


@pytest.fixture
def fresh(folder: Path, euclidean: Path) -> Path:
    """A folder in which everything is up to date."""
    shutil.copytree(euclidean, folder / "generated" / "euclidean")
    return folder


def test_check_says_that_all_is_up_to_date(rsrm_gen_command: Command, fresh: Path) -> None:
    assert rsrm_gen_command("euclidean.yaml", "--check") == Ran(0, "generated/euclidean: up to date\n", "")


def edited(file: str, old: str, new: str) -> Callable[[Path], None]:
    def edit(folder: Path) -> None:
        text = (folder / file).read_text()
        assert old in text
        (folder / file).write_text(text.replace(old, new))

    return edit


CODE = "generated/euclidean/euclidean"
STALE: dict[str, tuple[Callable[[Path], None], str]] = {
    "the manifold file changed": (edited("euclidean.yaml", "n: 3", "n: 4"), "stale"),
    "a formula changed": (edited("euclidean.yaml", "log: q - p", "log: -p + q"), "stale"),
    "torch edited": (edited(f"{CODE}.py", "def log", "def  log"), "euclidean.py was edited by hand"),
    "C edited": (edited(f"{CODE}.c", ";", " ;"), "euclidean.c was edited by hand"),
    "a file is missing": (lambda folder: (folder / f"{CODE}.h").unlink(), "euclidean.h is missing"),
    "no audit": (lambda folder: (folder / "generated/euclidean/audit.json").unlink(), "not generated yet"),
    "damaged audit": (edited("generated/euclidean/audit.json", "{", "["), "audit.json is damaged"),
    "older generator": (
        edited("generated/euclidean/audit.json", f'"{__version__}+', '"0.0.0+'), "generated by version 0.0.0"
    ),
    "generator of another source": (
        edited("generated/euclidean/audit.json", generator(), f"{__version__}+0123456789abcdef"), "the compiler itself changed"
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", STALE)
def test_check_says_what_is_not_up_to_date_and_changes_nothing(
    rsrm_gen_command: Command, fresh: Path, case: str
) -> None:
    change, reason = STALE[case]
    change(fresh)
    before = tree(fresh)
    ran = rsrm_gen_command("euclidean.yaml", "--check")
    assert ran.code == 2
    assert re.search(rf"(?m)^generated/euclidean: .*{re.escape(reason)}", ran.out)
    assert "rsrm-gen euclidean.yaml" in ran.err  # what to do about it
    assert tree(fresh) == before


def test_check_looks_at_every_file(rsrm_gen_command: Command, fresh: Path) -> None:
    ran = rsrm_gen_command("torus.yaml", "euclidean.yaml", "--check")
    assert ran.code == 2
    assert ran.out == "generated/torus: not generated yet\ngenerated/euclidean: up to date\n"


# What is wrong.

LOG = "log: q - p"
WRONG_FILES = {
    "a misspelt function": ("log: norn(q - p) * q", r"8:6: error: unknown function `norn`", "did you mean `norm`?"),
    "a misspelt name": ("log: q - pp", r"8:10: error: .*`pp`", ""),
    "shapes that do not fit": ("log: q - p[1:]", r"8:8: error: .*3.*2", ""),
    "the wrong size of a result": ("log: q[1:] - p[1:]", r"8:6: error: ", ""),
    "a broken formula": ("log: q - (p", r"8:\d+: error: ", ""),
    "a key of no meaning": (
        "log: q - p\ndistanse: norm(q - p)",
        r"9:1: error: .*`distanse`",
        "did you mean `distance`?",
    ),
    "a Log that Exp does not undo": ("log: 2 * (q - p)", r"\d+:\d+: error: .*Exp_p\(Log_p\(q\)\) = q", ""),
}


@pytest.mark.parametrize("case", WRONG_FILES)
def test_a_wrong_file_is_refused_with_its_place_and_nothing_is_written(
    rsrm_gen_command: Command, folder: Path, case: str
) -> None:
    line, message, hint = WRONG_FILES[case]
    edited("euclidean.yaml", LOG, line)(folder)
    before = tree(folder)
    ran = rsrm_gen_command("euclidean.yaml")
    assert ran.code == 2
    assert ran.out == ""
    assert re.match(rf"euclidean\.yaml:{message}", ran.err), ran.err
    first, source, caret, *_ = ran.err.splitlines()
    column = int(first.split(":")[2])
    assert source[2:] in (folder / "euclidean.yaml").read_text().splitlines()
    assert caret.index("^") == 2 + column - 1
    assert hint in ran.err
    assert "Traceback" not in ran.err
    assert tree(folder) == before
    assert names(folder) == {"euclidean.yaml", "torus.yaml"}
    assert not names(folder.parent / "temporary")


WRONG_COMMANDS = {
    "a missing file": (["euclidan.yaml"], "no file euclidan.yaml", "did you mean `euclidean.yaml`?"),
    "a folder": (["."], "", ""),
    "a command or a manifold that is not there": (["klein"], "no command or bundled manifold `klein`", "--help"),
    "a misspelt command": (["adit", "so3"], "no command or bundled manifold `adit`", "did you mean `rsrm-gen audit`?"),
    "a misspelt manifold": (["spere"], "no command or bundled manifold `spere`", "did you mean `sphere`?"),
    "half a parameter": (["euclidean.yaml", "-p", "n"], "`n` does not set a parameter", "-p NAME=VALUE"),
    "no parameter": (["euclidean.yaml", "-p", "n="], "`n=` does not set a parameter", "-p NAME=VALUE"),
    "an unknown parameter": (["euclidean.yaml", "-p", "m=3"], "no parameter `m`", "known here: n"),
    "a word for a number": (["euclidean.yaml", "-p", "n=many"], "`n` must be a number", ""),
    "half a dimension": (["euclidean.yaml", "-p", "n=1.5"], "whole number", ""),
    "a file in the way": (["euclidean.yaml", "-o", "torus.yaml"], "cannot write to torus.yaml/euclidean", "-o"),
}


@pytest.mark.parametrize("case", WRONG_COMMANDS)
def test_a_wrong_command_is_a_message_and_nothing_is_written(
    rsrm_gen_command: Command, folder: Path, case: str
) -> None:
    arguments, message, hint = WRONG_COMMANDS[case]
    before = tree(folder)
    ran = rsrm_gen_command(*arguments)
    assert ran.code == 2
    assert message in ran.err
    assert hint in ran.err
    assert "error: " in ran.err
    assert "Traceback" not in ran.out + ran.err
    assert tree(folder) == before
    assert names(folder) == {"euclidean.yaml", "torus.yaml"}
    assert not names(folder.parent / "temporary")


def test_a_mistake_ends_a_real_process_with_code_2(folder: Path) -> None:
    edited("euclidean.yaml", LOG, "log: q - pp")(folder)
    ran = in_a_process(folder, "euclidean.yaml")
    assert ran.code == 2
    assert ran.out == ""
    assert ran.err.startswith("euclidean.yaml:8:10: error: ")
    assert "Traceback" not in ran.err


def test_without_a_c_compiler_the_code_is_written_and_a_line_says_so(folder: Path) -> None:
    ran = in_a_process(folder, "torus.yaml", CC=str(folder / "none"), COLUMNS="160")
    assert ran.code == 0
    assert names(folder / "generated" / "torus") == files("torus")
    assert ran.err.startswith("no C compiler found")
    assert ran.err.count("\n") == 1
    compile((folder / "generated/torus/torus.py").read_text(), "torus.py", "exec")
    assert "<= " in ran.out  # torch is audited and measured all the same
