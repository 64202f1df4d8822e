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
seen = {"written": [], "started": [], "other": []}

def watch(event, arguments):
    if event == "open" and arguments[2] & writing:
        seen["written"].append(os.path.abspath(str(arguments[0])))
    elif event in ("os.mkdir", "os.rename", "os.remove", "os.link", "os.symlink", "os.truncate", "os.chmod"):
        seen["written"] += [os.path.abspath(str(a)) for a in arguments[:2] if isinstance(a, (str, bytes, os.PathLike))]
    elif event in ("subprocess.Popen", "os.exec", "os.spawn", "os.posix_spawn"):
        seen["started"].append([str(a) for a in arguments[1]])
    elif event in ("os.system", "os.fork", "socket.connect", "socket.bind", "urllib.Request", "pty.spawn"):
        seen["other"].append(event)

from rsrm_gen.compiler import cli  # what is loaded before is not the file's doing
import casadi, sympy, torch
sys.argv = ["rsrm-gen", *sys.argv[2:]]
sys.addaudithook(watch)
try:
    cli.main()
except SystemExit as end:
    code = end.code or 0
with open(os.environ["SEEN"], "w") as file:
    json.dump({"code": code, **seen}, file)
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


def watched(tmp_path: Path, text: str) -> dict[str, Any]:
    work = tmp_path / "work"
    for folder in (work, tmp_path / "temporary", tmp_path / "cache"):
        folder.mkdir()
    (work / "m.yaml").write_text(text, encoding="utf-8")
    environment = {
        **os.environ,
        "PYTHONPATH": str(Path(rsrm_gen.__file__).parent.parent),
        "PYTHONDONTWRITEBYTECODE": "1",
        "RSRM_GEN_CACHE": str(tmp_path / "cache"),
        "TMPDIR": str(tmp_path / "temporary"),
        "SEEN": str(tmp_path / "seen.json"),
        "OMP_NUM_THREADS": "1",
    }
    ran = subprocess.run(
        [sys.executable, "-c", WATCHER, "m.yaml", "m.yaml", "-o", "out"],
        cwd=work, env=environment, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert "Traceback" not in ran.stderr, ran.stderr
    seen: dict[str, Any] = json.loads((tmp_path / "seen.json").read_text())
    return {**seen, "err": ran.stderr}


def changed(line: str) -> str:
    key = line.partition(":")[0]
    text = (MANIFOLDS / "euclidean.yaml").read_text(encoding="utf-8").splitlines()
    kept = [old for old in text if not old.startswith(f"{key}:")]
    return "\n".join([*kept, line]) + "\n"


@pytest.mark.parametrize("case", HOSTILE)
def test_a_hostile_file_writes_nothing_elsewhere_and_starts_nothing_but_the_compiler(case: str, tmp_path: Path) -> None:
    seen = watched(tmp_path, changed(HOSTILE[case]))
    allowed = [str(tmp_path / "work" / "out"), str(tmp_path / "temporary"), str(tmp_path / "cache"), os.devnull]
    assert [path for path in seen["written"] if not path.startswith(tuple(allowed))] == []
    compilers = {os.environ.get("CC") or "cc"}
    assert [command for command in seen["started"] if command[0] not in compilers] == []
    assert seen["other"] == []
    assert not [path for path in tmp_path.rglob("*") if "HACKED" in path.name]
    if case.startswith(("a comment", "a docstring", "an include", "a line", "a trigraph", "a macro")):
        assert seen["code"] == 0, seen["err"]
    else:
        assert seen["code"] == 2
        assert {path.name for path in (tmp_path / "work").iterdir()} == {"m.yaml"}


def test_the_watcher_sees_what_a_file_could_do(tmp_path: Path) -> None:
    seen = watched(tmp_path, (MANIFOLDS / "euclidean.yaml").read_text(encoding="utf-8"))
    assert seen["code"] == 0
    assert any(path.startswith(str(tmp_path / "work" / "out")) for path in seen["written"])
