"""When nothing changed, nothing is done, at once; what is written is whole, whoever else writes."""

from __future__ import annotations

import itertools
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from commands import Command, in_a_process, runner, started, tree
from compiled import MANIFOLDS

import rsrm_gen
from rsrm_gen.compiler import output
from rsrm_gen.compiler.driver import compile_manifold
from rsrm_gen.compiler.output import contents, generator, staleness, unchanged, write
from rsrm_gen.compiler.spec import read_spec
from rsrm_gen.errors import UserError

SECONDS = 0.3
HEAVY = ("sympy", "casadi", "torch", "numpy", "mpmath", "pydantic", "yaml", "typer", "rich")


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with two manifold files, one of them generated twice, with and without a parameter."""
    folder = tmp_path_factory.mktemp("made")
    for name in ("torus", "euclidean"):
        shutil.copy(MANIFOLDS / f"{name}.yaml", folder)
    for parameters in ({}, {"n": "3"}):
        compiled = compile_manifold(folder / "torus.yaml", parameters)
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


@pytest.mark.parametrize(
    ("overrides", "found"),
    [({}, "torus"), ({"n": "2"}, "torus"), ({"n": 2.0}, "torus"), ({"n": "3"}, "torus_n3"), ({"n": "6/2"}, "torus_n3")],
)
def test_what_did_not_change_is_found_by_its_manifest(folder: Path, overrides: dict[str, str], found: str) -> None:
    assert unchanged(folder / "torus.yaml", overrides, folder / "generated") == folder / "generated" / found


@pytest.mark.parametrize(
    ("file", "overrides"),
    [("torus", {"n": "4"}), ("torus", {"m": "2"}), ("torus", {"n": "x"}), ("torus", {"n": "1/0"}), ("euclidean", {}),
     ("nowhere", {})],
)  # fmt: skip
def test_what_was_never_made_is_not_found(folder: Path, file: str, overrides: dict[str, str]) -> None:
    assert unchanged(folder / f"{file}.yaml", overrides, folder / "generated") is None


CHANGES = {
    "a word of the manifold file": lambda f: _replace(f / "torus.yaml", "angles", "corners"),
    "a space": lambda f: _replace(f / "torus.yaml", "wrap(p + v)", "wrap(p  + v)"),
    "the torch code": lambda f: _replace(f / "generated/torus/torus.py", "def log", "def  log"),
    "the C code": lambda f: _replace(f / "generated/torus/torus.c", ";", " ;"),
    "a missing header": lambda f: (f / "generated/torus/torus.h").unlink(),
    "no manifest": lambda f: (f / "generated/torus/audit.json").unlink(),
    "a damaged manifest": lambda f: (f / "generated/torus/audit.json").write_text("[]"),
    "another compiler": lambda f: _replace(f / "generated/torus/audit.json", generator(), "0.1.0+0000000000000000"),
}


def _replace(path: Path, old: str, new: str) -> None:
    assert old in path.read_text()
    path.write_text(path.read_text().replace(old, new))


@pytest.mark.parametrize("change", CHANGES)
def test_whatever_changed_is_noticed(folder: Path, change: str) -> None:
    CHANGES[change](folder)
    assert unchanged(folder / "torus.yaml", {}, folder / "generated") is None
    assert staleness(read_spec(folder / "torus.yaml"), folder / "generated" / "torus") is not None


def test_what_changed_is_made_again(folder: Path, run: Command) -> None:
    CHANGES["a word of the manifold file"](folder)
    CHANGES["the C code"](folder)
    ran = run("torus.yaml")
    assert ran.code == 0
    assert "checks passed" in ran.out
    assert staleness(read_spec(folder / "torus.yaml"), folder / "generated" / "torus") is None
    assert run("torus.yaml").out == "generated/torus: up to date\n"


def test_a_change_of_a_factor_of_a_product_is_noticed(folder: Path) -> None:
    (folder / "line.yaml").write_text((folder / "euclidean.yaml").read_text().replace("euclidean", "line"))
    (folder / "pair.yaml").write_text("manifold: pair\ndoc: Two.\nproduct: {a: line(n=1), b: torus(n=1)}\n")
    compiled = compile_manifold(folder / "pair.yaml")
    write(contents(compiled), folder / "generated" / "pair")
    assert unchanged(folder / "pair.yaml", {}, folder / "generated") == folder / "generated" / "pair"
    for name in ("line", "torus"):
        text = (folder / f"{name}.yaml").read_text()
        (folder / f"{name}.yaml").write_text(text + "# a remark\n")
        assert unchanged(folder / "pair.yaml", {}, folder / "generated") is None
        (folder / f"{name}.yaml").write_text(text)
    assert unchanged(folder / "pair.yaml", {}, folder / "generated") is not None
    (folder / "torus.yaml").unlink()  # the bundled one has the same text
    assert unchanged(folder / "pair.yaml", {}, folder / "generated") is not None
    (folder / "line.yaml").unlink()
    assert unchanged(folder / "pair.yaml", {}, folder / "generated") is None


def test_other_line_endings_are_no_change(folder: Path) -> None:
    text = (folder / "torus.yaml").read_bytes()
    (folder / "torus.yaml").write_bytes(text.replace(b"\n", b"\r\n"))
    assert unchanged(folder / "torus.yaml", {}, folder / "generated") is not None


def test_a_change_of_the_compiler_is_noticed(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    package = folder / "package"
    shutil.copytree(output.PACKAGE, package, ignore=shutil.ignore_patterns("__pycache__"))
    monkeypatch.setattr(output, "PACKAGE", package)
    seen = {generator.__wrapped__()}
    assert seen == {generator()}
    for file in ("compiler/emit/c.py", "compiler/derive/series.py", "document.py"):
        path = package / file
        path.write_text(path.read_text() + "# another line\n")
        seen.add(generator.__wrapped__())
    assert len(seen) == 4
    (package / "compiler/cli/new.py").write_text("")  # printing is no part of what is generated
    assert generator.__wrapped__() in seen


def test_code_of_the_same_version_can_be_loaded_whatever_the_source_was(folder: Path) -> None:
    _replace(folder / "generated/torus/audit.json", generator(), f"{rsrm_gen.__version__}+0000000000000000")
    spec = read_spec(folder / "torus.yaml")
    assert "compiler itself changed" in str(staleness(spec, folder / "generated/torus"))
    assert staleness(spec, folder / "generated/torus", by_source=False) is None


def test_nothing_is_written_when_nothing_changed(folder: Path, run: Command) -> None:
    before = {path: path.stat().st_mtime_ns for path in (folder / "generated").rglob("*")}
    assert run("torus.yaml").out == "generated/torus: up to date\n"
    assert run("torus.yaml", "-p", "n=3").out == "generated/torus_n3: up to date\n"
    assert {path: path.stat().st_mtime_ns for path in (folder / "generated").rglob("*")} == before


def test_to_find_that_nothing_changed_imports_next_to_nothing(folder: Path) -> None:
    script = f"import sys; sys.argv[1:] = ['torus.yaml']; from rsrm_gen.compiler.cli import main\n" \
             f"try: main()\nfinally: print(sorted(set({HEAVY!r}) & set(sys.modules)))"  # fmt: skip
    environment = {**os.environ, "PYTHONPATH": str(output.PACKAGE.parent)}
    ran = subprocess.run([sys.executable, "-c", script], env=environment, capture_output=True, text=True, check=True)
    assert ran.stdout == "generated/torus: up to date\n[]\n"


def test_to_find_that_nothing_changed_takes_a_third_of_a_second(folder: Path) -> None:
    resource = pytest.importorskip("resource")
    for arguments in (["torus.yaml"], ["torus.yaml", "-p", "n=3", "-o", "generated"]):
        seconds = []
        for _ in range(5):  # of the processor: others may be at work
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            assert in_a_process(folder, *arguments).out.endswith("up to date\n")
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            seconds.append(after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime)
        assert min(seconds) <= SECONDS, arguments


def test_a_manifest_says_what_the_files_were_made_of(folder: Path) -> None:
    document = json.loads((folder / "generated/torus_n3/audit.json").read_text())
    assert document["generator"] == generator()
    assert generator().startswith(f"{rsrm_gen.__version__}+")
    assert document["parameters"] == {"n": "3"}
    assert document["overridden"] == ["n"]
    assert set(document["files"]) == {"torus_n3.py", "torus_n3.h", "torus_n3.c", "torus_n3_splats.c"}


def test_several_processes_at_once_leave_one_whole_result(folder: Path) -> None:
    # Two different manifolds of the same name, written into one folder by two processes each, from an empty cache.
    shutil.rmtree(folder / "generated")
    texts = {"one": "angles", "two": "corners"}
    for place, word in texts.items():
        (folder / place).mkdir()
        (folder / place / "torus.yaml").write_text((folder / "torus.yaml").read_text().replace("angles", word))
    cache = str(folder / "cache")
    jobs = [started(folder, f"{place}/torus.yaml", "--force", RSRM_GEN_CACHE=cache) for place in [*texts, *texts]]
    results = [job.communicate() for job in jobs]
    assert [job.returncode for job in jobs] == [0] * 4, results
    specs = [read_spec(folder / place / "torus.yaml") for place in texts]
    assert sorted(staleness(spec, folder / "generated/torus") is None for spec in specs) == [False, True]
    assert {path.name for path in (folder / "generated").iterdir()} == {"torus"}
    assert len(list((folder / "generated/torus").iterdir())) == 5


def test_a_folder_is_whole_while_it_is_written_over_and_over(folder: Path, tmp_path: Path) -> None:
    # Whoever writes, writes all of one thing: files that name their writer are never mixed.
    target = tmp_path / "target"
    script = (
        "import sys; from pathlib import Path; from rsrm_gen.compiler.output import write\n"
        "for turn in range(40):\n"
        "    text = f'{sys.argv[1]} {turn}'\n"
        "    write({name: text for name in 'abcdefgh'}, Path(sys.argv[2]))\n"
    )
    environment = {**os.environ, "PYTHONPATH": str(output.PACKAGE.parent)}
    jobs = [
        subprocess.Popen([sys.executable, "-c", script, who, str(target)], env=environment) for who in ("one", "two")
    ]
    assert [job.wait() for job in jobs] == [0, 0]
    assert len(set(tree(target).values())) == 1
    assert sorted(tree(target)) == list("abcdefgh")


def test_names_that_only_begin_alike_are_not_confused(folder: Path) -> None:
    names = [path.name for path in (folder / "generated").iterdir()]
    assert sorted(names) == ["torus", "torus_n3"]
    for name, other in itertools.permutations(names, 2):
        (folder / "generated" / name / "audit.json").rename(folder / "kept")
        parameters = {"n": "3"} if name == "torus_n3" else {}
        assert unchanged(folder / "torus.yaml", parameters, folder / "generated") is None, (name, other)
        (folder / "kept").rename(folder / "generated" / name / "audit.json")


def test_a_cache_that_cannot_be_written_is_told(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (folder / "cache").write_text("a file")
    monkeypatch.setenv("RSRM_GEN_CACHE", str(folder / "cache"))
    with pytest.raises(UserError, match="cannot write to") as caught:
        write({"a": "text"}, folder / "target")
    assert "RSRM_GEN_CACHE" in str(caught.value.hint)
    assert not list((folder / "target").iterdir())
