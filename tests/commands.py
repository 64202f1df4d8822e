"""Commands as a person runs them, for the tests of the command lines."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest

import rsrm_gen
from rsrm_gen.compiler import cli


@dataclass(frozen=True)
class Ran:
    """What a command left behind."""

    code: int
    out: str
    err: str


Command = Callable[..., Ran]


def runner(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Command:
    """Runs `rsrm-gen ARGUMENTS` in this process."""

    def run(*arguments: str) -> Ran:
        monkeypatch.setattr(sys, "argv", ["rsrm-gen", *arguments])
        with pytest.raises(SystemExit) as caught:
            cli.main()
        printed = capsys.readouterr()
        return Ran(int(caught.value.code or 0), printed.out, printed.err)

    return run


def started(folder: Path, *arguments: str, **environment: str) -> subprocess.Popen[str]:
    """The command as a shell starts it."""
    variables = {
        **os.environ, "PYTHONPATH": str(Path(rsrm_gen.__file__).parent.parent), "OMP_NUM_THREADS": "1", **environment
    }  # fmt: skip
    return subprocess.Popen(
        [sys.executable, "-W", "error", "-m", "rsrm_gen.compiler.cli", *arguments],
        cwd=folder, env=variables, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip


def in_a_process(folder: Path, *arguments: str, **environment: str) -> Ran:
    """Runs the command as a shell does."""
    process = started(folder, *arguments, **environment)
    out, err = process.communicate()
    return Ran(process.returncode, out, err)


def tree(folder: Path) -> dict[str, str]:
    """Every file below a folder, hidden ones too, with its content."""
    return {str(p.relative_to(folder)): p.read_text() for p in sorted(folder.rglob("*")) if p.is_file()}
