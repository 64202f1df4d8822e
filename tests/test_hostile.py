"""A hostile file reaches nothing: watched by Python's own audit hook while it is compiled in a process of its own."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from compiled import MANIFOLDS

import rsrm_gen

WATCHER = """
import json, os, sys

writing = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_APPEND
changes = ("os.mkdir", "os.rename", "os.remove", "os.rmdir", "os.link", "os.symlink", "os.truncate", "os.chmod")
seen = {}

def watch(event, arguments):
    if event == "open" and arguments[2] & writing:
        seen["written"].append(os.path.abspath(str(arguments[0])))
    elif event in changes:
        inside = isinstance(arguments[-1], int) and arguments[-1] >= 0  # relative to a folder that is being removed
        seen["written"] += [os.path.abspath(a) for a in arguments[:2] if isinstance(a, str) and not inside]
    elif event in ("subprocess.Popen", "os.exec", "os.spawn", "os.posix_spawn"):
        seen["started"].append([str(a) for a in arguments[1]])
    elif event in ("os.system", "os.fork", "socket.connect", "socket.bind", "urllib.Request", "pty.spawn"):
        seen["other"].append(event)

from rsrm_gen.compiler import cli  # what is loaded before is not the file's doing
import casadi, sympy, torch
files, answers = sys.argv[1:], []
sys.addaudithook(watch)
for file in files:
    seen.update(file=file, written=[], started=[], other=[])
    sys.argv = ["rsrm-gen", file, "-o", "out"]
    try:
        cli.main()
    except SystemExit as end:
        answers.append({**seen, "code": end.code or 0})
sys.stdout.write(chr(10) + json.dumps(answers))
"""

HOSTILE = {
    "a tag that calls": "exp: !!python/object/apply:os.system ['touch HACKED']",
    "a tag that names": "exp: !!python/name:os.system p",
    "an import": "exp: \"__import__('os').system('touch HACKED')\"",
    "an attribute": 'exp: "p.__class__"',
    "a call of the host": 'exp: "exec(1)"',
    "open": 'exp: "open(p)"',
    "a path as a factor": "product: {a: ../../../../etc/passwd}",
    "a comment that ends": 'doc: "*/ #error HACKED"',
    "a docstring that ends": 'doc: \'""" + open("HACKED", "w") #\'',
    "an include": 'doc: "d\\n#include \\"/etc/passwd\\""',
    "a line that ends": 'doc: "d\\r\\n*/ int x = 1/0; /*\\\\"',
    "a trigraph": 'doc: "??/"',
    "a macro": 'doc: "__FILE__ @ $(touch HACKED) `touch HACKED` %s {0}"',
    "a name of a path": "manifold: ../../HACKED",
}


def changed(line: str) -> str:
    key = line.partition(":")[0]
    text = (MANIFOLDS / "euclidean.yaml").read_text(encoding="utf-8").splitlines()
    kept = [old for old in text if not old.startswith(f"{key}:")]
    return "\n".join([*kept, line]) + "\n"


@pytest.fixture(scope="module")
def watched(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict[str, Any]]:
    """The folder in which all files were compiled, and what was seen at each."""
    home = tmp_path_factory.mktemp("hostile")
    for folder in ("work", "temporary", "cache"):
        (home / folder).mkdir()
    cases = {**{case: changed(line) for case, line in HOSTILE.items()}, "a good one": changed("doc: Good.")}
    for i, text in enumerate(cases.values()):
        (home / "work" / f"m{i}.yaml").write_text(text.replace("euclidean", f"m{i}"), encoding="utf-8")
    environment = {
        **os.environ,
        "PYTHONPATH": str(Path(rsrm_gen.__file__).parent.parent),
        "PYTHONDONTWRITEBYTECODE": "1",
        "RSRM_GEN_CACHE": str(home / "cache"),
        "TMPDIR": str(home / "temporary"),
        "OMP_NUM_THREADS": "1",
    }
    ran = subprocess.run(
        [sys.executable, "-c", WATCHER, *(f"m{i}.yaml" for i in range(len(cases)))],
        cwd=home / "work", env=environment, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert ran.returncode == 0, ran.stderr
    return home, dict(zip(cases, json.loads(ran.stdout.splitlines()[-1]), strict=True))


@pytest.mark.parametrize("case", HOSTILE)
def test_a_hostile_file_writes_nothing_elsewhere_and_starts_nothing_but_the_compiler(
    case: str, watched: tuple[Path, dict[str, Any]]
) -> None:
    home, answers = watched
    seen = answers[case]
    allowed = (str(home / "work" / "out"), str(home / "temporary"), str(home / "cache"), os.devnull)
    assert [path for path in seen["written"] if not path.startswith(allowed)] == []
    assert [command for command in seen["started"] if command[0] != (os.environ.get("CC") or "cc")] == []
    assert seen["other"] == []
    assert seen["code"] == (0 if HOSTILE[case].startswith("doc") else 2)


def test_no_hostile_file_left_anything(watched: tuple[Path, dict[str, Any]]) -> None:
    home, answers = watched
    assert not [path for path in home.rglob("*") if "HACKED" in path.name]
    made = {f"m{i}" for i, seen in enumerate(answers.values()) if seen["code"] == 0}
    assert {path.name for path in (home / "work" / "out").iterdir()} == made
    assert {path.suffix for path in (home / "work").iterdir()} == {".yaml", ""}


def test_the_watcher_sees_what_a_file_could_do(watched: tuple[Path, dict[str, Any]]) -> None:
    home, answers = watched
    assert answers["a good one"]["code"] == 0
    assert any(path.startswith(str(home / "work" / "out")) for path in answers["a good one"]["written"])
