"""`rsrm-gen audit` judges the code that is there, by what it computes."""

from __future__ import annotations

import json
import re
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from commands import Command, runner
from compiled import MANIFOLDS, needs_compiler

from rsrm_gen.compiler.driver import compile_manifold
from rsrm_gen.compiler.output import contents, write


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two manifold files with their code, one of them with a parameter."""
    folder = tmp_path_factory.mktemp("made")
    for name, parameters in (("torus", {}), ("euclidean", {"n": "2"})):
        (folder / "files").mkdir(exist_ok=True)
        shutil.copy(MANIFOLDS / f"{name}.yaml", folder / "files")
        compiled = compile_manifold(folder / "files" / f"{name}.yaml", parameters)
        write(contents(compiled), folder / "generated" / compiled.program.name)
    return folder


@pytest.fixture
def folder(made: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy to change."""
    work = tmp_path / "work"
    shutil.copytree(made, work)
    monkeypatch.chdir(work)
    return work


@pytest.fixture
def run(folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Command:
    return runner(capsys, monkeypatch)


def edit(path: Path, old: str, new: str) -> None:
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new))


def test_every_check_is_a_row_with_points_error_tolerance_and_place(run: Command) -> None:
    ran = run("audit", "files/torus.yaml")
    assert (ran.code, ran.err) == (0, "")
    heading, *rows = ran.out.splitlines()
    assert heading.split() == ["check", "points", "worst", "error", "tolerance", "digits", "passed", "where"]
    assert re.search(r"(?m)^log\(exp\) +16 +\d(\.\d)?e-\d+ +1e-12 +\d+ +yes +at p = \(", ran.out)
    assert re.search(r"(?m)^distance torch float32 +\d+ +[\d.e-]+ +64 +\d+ +yes", ran.out)
    assert re.search(r"(?m)^log_abs_det +<= \d+ +<= \d+ +\d+$", ran.out)
    assert re.search(
        r"(?m)^generated/torus: the code is what its manifold file gives; (\d+) of \1 checks passed$", ran.out
    )
    assert len(rows) > 40


def test_several_are_one_table_of_the_accuracy_of_every_function(run: Command) -> None:
    ran = run("audit", "generated")
    assert (ran.code, ran.err) == (0, "")
    heading, *rows = ran.out.splitlines()
    columns = [f"{routine} {p}" for routine in ("exp", "log", "distance", "log_abs_det") for p in ("f64", "f32")]
    assert re.split(r"  +", heading.strip()) == ["manifold", "checks", *columns, "code"]
    for name, row in zip(("euclidean_n2", "torus"), rows, strict=False):
        assert re.match(rf"{name} +(\d+) of \1( +<= \d+){{8}} +up to date", row)


SAME = {
    "a folder of code": ["generated/torus"],
    "its name": ["torus"],
    "a manifold file": ["files/torus.yaml"],
    "a folder of code, and its file": ["generated/torus", "--spec", "files/torus.yaml"],
    "twice the same": ["generated/torus", "files/torus.yaml"],
}


@pytest.mark.parametrize("arguments", SAME.values(), ids=SAME)
def test_what_is_meant_is_found(run: Command, monkeypatch: pytest.MonkeyPatch, arguments: list[str]) -> None:
    seen = audited_folders(monkeypatch)
    run("audit", *arguments)
    assert [path.name for path, _ in seen] == ["torus"]


def test_a_folder_of_manifold_files_means_their_code(
    run: Command, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (folder / "generated/euclidean_n2").rename(folder / "generated/euclidean")
    seen = audited_folders(monkeypatch)
    run("audit", "files")
    assert [path.name for path, _ in seen] == ["euclidean", "torus"]


def test_parameters_are_taken_from_the_manifest(run: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    seen = audited_folders(monkeypatch)
    run("audit", "generated/euclidean_n2")
    run("audit", "files/euclidean.yaml", "-p", "n=2")
    assert [(path.name, spec.dim) for path, spec in seen] == [("euclidean_n2", 2)] * 2


def audited_folders(monkeypatch: pytest.MonkeyPatch) -> list:
    """Which folders are audited against which specs, without doing it."""
    seen: list = []

    def audit_folder(folder: Path, spec: object, seconds_allowed: float) -> object:
        seen.append((folder, spec))
        return Nothing(folder)

    monkeypatch.setattr("rsrm_gen.compiler.reaudit.audit_folder", audit_folder)
    return seen


class Nothing:
    """A verdict on nothing."""

    def __init__(self, folder: Path) -> None:
        from rsrm_gen.compiler.audit import AuditReport

        self.folder, self.stale = folder, None
        self.report = AuditReport(folder.name, "", (), ())


# Edited code: what each edit breaks, and what is said of it. The promise is broken, or it is not.

TORUS = "generated/torus/torus"
EDITS: dict[str, tuple[Callable[[Path], None], str]] = {
    "torch": (lambda f: edit(f / f"{TORUS}.py", "p0 + v0", "p0 + 1.001 * v0"), "exp torch float64"),
    "C": (lambda f: edit(f / f"{TORUS}.c", "p[0] + v[0]", "p[0] + 1.001 * v[0]"), "exp C float64"),
    "the sums in C": (lambda f: edit(f / f"{TORUS}_splats.c", "= gaussian_each(", "= 1.01 * gaussian_each("), "sums C float64"),
}  # fmt: skip


@needs_compiler
@pytest.mark.parametrize("case", EDITS)
def test_edited_code_that_is_wrong_fails_by_the_check_that_sees_it(run: Command, folder: Path, case: str) -> None:
    change, check = EDITS[case]
    change(folder)
    ran = run("audit", "torus")
    assert ran.code == 1
    assert re.search(rf"(?m)^{check} .* NO", ran.out)
    assert "was edited by hand" in ran.out
    assert re.search(r"error: .* but the error is", ran.out)
    assert "Traceback" not in ran.out + ran.err


def test_edited_code_that_is_right_passes_and_is_called_edited(run: Command, folder: Path) -> None:
    edit(folder / f"{TORUS}.py", "def log(", "def log(  # the logarithm\n        ")
    ran = run("audit", "torus")
    assert ran.code == 0
    assert "torus.py was edited by hand" in ran.out
    assert "NO" not in ran.out


BROKEN: dict[str, tuple[Callable[[Path], None], str]] = {
    "a syntax error": (lambda f: edit(f / f"{TORUS}.py", "def log(", "def log(("), "SyntaxError"),
    "a function that is gone": (lambda f: edit(f / f"{TORUS}.py", "def log(", "def logarithm("), "log"),
    "C that does not compile": (lambda f: edit(f / f"{TORUS}.c", "return", "retur"), "error"),
    "a file that is gone": (lambda f: (f / f"{TORUS}.h").unlink(), "there is no torus.h"),
    "a function that raises": (lambda f: edit(f / f"{TORUS}.py", "import math", "import math\nraise ValueError('no')"), "no"),
}  # fmt: skip


@needs_compiler
@pytest.mark.parametrize("case", BROKEN)
def test_code_that_does_not_run_fails_a_check_of_its_own(run: Command, folder: Path, case: str) -> None:
    change, message = BROKEN[case]
    change(folder)
    ran = run("audit", "torus")
    assert ran.code == 1
    assert re.search(rf"(?m)^code runs .* NO .*{re.escape(message)}", ran.out), ran.out
    assert "Traceback" not in ran.out + ran.err


def test_stale_code_is_called_so_and_judged_by_the_file_of_today(run: Command, folder: Path) -> None:
    edit(folder / "files/torus.yaml", "period: 2 * pi", "period: 4")
    edit(folder / "files/torus.yaml", "wrap(p + v)", "wrap(p + v, 4)")
    edit(folder / "files/torus.yaml", "log: wrap(q - p)", "log: wrap(q - p, 4)")
    edit(folder / "files/torus.yaml", "injectivity_radius: pi", "injectivity_radius: 2")
    edit(folder / "files/torus.yaml", "diameter: pi", "diameter: 2")
    edit(folder / "files/torus.yaml", "max(abs(wrap(q - p))) = pi", '"max(abs(wrap(q - p, 4))) = 2"')
    ran = run("audit", "files/torus.yaml")
    assert ran.code == 1
    assert "stale: the manifold file or its parameters changed" in ran.out
    assert re.search(r"(?m)^exp\(log\) .* yes", ran.out)  # the new file is right
    assert re.search(r"(?m)^log torch float64 .* NO", ran.out)  # the code is not of it


def test_json_says_the_same_to_a_program(run: Command, folder: Path) -> None:
    edit(folder / f"{TORUS}.py", "p0 + v0", "p0 + 1.001 * v0")
    ran = run("audit", "generated", "--json")
    assert ran.code == 1
    document = json.loads(ran.out)
    assert document["passed"] is False
    flat, torus = document["reports"]
    assert (flat["manifold"], flat["passed"], flat["stale"]) == ("euclidean_n2", True, None)
    assert (torus["manifold"], torus["passed"], torus["stale"]) == ("torus", False, "torus.py was edited by hand")
    failed = [check for check in torus["checks"] if not check["passed"]]
    assert {"exp torch float64", "exp torch float32"} <= {check["check"] for check in failed}
    for check in flat["checks"]:
        assert check["exactly"] or check["points"] > 0
        assert 0 <= check["worst"] <= check["tolerance"]
    assert {(m["function"], m["precision"]) for m in flat["accuracy"]} == {
        (f, p) for f in ("exp", "log", "distance", "log_abs_det") for p in ("float64", "float32")
    }


MISTAKES: dict[str, tuple[list[str], str]] = {
    "nothing of that name": (["tours"], "did you mean `torus`"),
    "no such file": (["tours.yaml"], "there is no file tours.yaml"),
    "code that was not generated": (["files/torus.yaml", "-p", "n=7"], "no generated code of `torus_n7`"),
    "a folder with nothing in it": (["."], "neither manifold files nor folders of generated code"),
    "a file of another manifold": (["generated/torus", "--spec", "nowhere.yaml"], "there is no file nowhere.yaml"),
    "half a parameter": (["torus", "-p", "n"], "`n` does not set a parameter"),
}  # fmt: skip


@pytest.mark.parametrize("case", MISTAKES)
def test_a_mistake_is_told_and_is_no_failed_check(run: Command, folder: Path, case: str) -> None:
    arguments, message = MISTAKES[case]
    ran = run("audit", *arguments)
    assert ran.code == 2
    assert message in ran.err


def test_code_whose_file_is_nowhere_needs_to_be_told_it(run: Command, folder: Path) -> None:
    # A manifold that is not bundled, its file far away.
    (folder / "far").mkdir()
    text = (folder / "files/euclidean.yaml").read_text().replace("euclidean", "plain")
    (folder / "far/plain.yaml").write_text(text)
    assert run("far/plain.yaml", "-p", "n=2").code == 0
    ran = run("audit", "generated/plain_n2")
    assert ran.code == 2
    assert "--spec" in ran.err
    assert run("audit", "generated/plain_n2", "--spec", "far/plain.yaml").code == 0
