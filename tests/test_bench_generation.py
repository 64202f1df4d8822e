"""`rsrm bench generation` times real runs of the compiler, the children that they start included."""

from __future__ import annotations

import json
import statistics
from pathlib import Path

import pytest
from compiled import MANIFOLDS

from rsrm_gen.bench import generation
from rsrm_gen.bench.generation import COLD, LARGE, Generation, foot, tables
from rsrm_gen.trainer.cli import main


def test_one_manifold_is_generated_cold_and_again(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    files = tmp_path / "table.md", tmp_path / "seconds.json"
    with pytest.raises(SystemExit) as done:
        main(["bench", "generation", "euclidean", "--quick", "--markdown", str(files[0]), "--json", str(files[1])])
    assert done.value.code == 0
    assert "euclidean: run 1 of 1" in capsys.readouterr().err
    (measured,) = json.loads(files[1].read_text())["manifolds"]
    assert measured["failure"] is None
    assert 0.3 < measured["cold"][0] < 120  # sympy alone takes longer to import
    assert 0 < measured["unchanged"][0] < 120
    assert f"| euclidean | {measured['cold'][0]:.2f} | 5 |" in files[0].read_text()


def test_the_seconds_of_children_count(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    burn = "import subprocess, sys; subprocess.run([sys.executable, '-c', 'sum(range(10**7))'])"
    idle = "import subprocess, sys; subprocess.run([sys.executable, '-c', ''])"
    seconds = []
    for program in (idle, burn):
        monkeypatch.setattr(generation, "COMMAND", (generation.sys.executable, "-c", program))
        seconds.append(statistics.median(generation._seconds(tmp_path / "m.yaml", {}, tmp_path)[0] for _ in range(3)))
    assert seconds[1] > seconds[0] + 0.05


def test_a_manifold_that_fails_is_a_row_and_a_reason(tmp_path: Path) -> None:
    text = (MANIFOLDS / "sphere.yaml").read_text().replace("cos(norm(v)) * p + sinc", "cos(norm(v)) * p - sinc")
    (tmp_path / "wrong.yaml").write_text(text)
    (result,) = generation.generation([(tmp_path / "wrong.yaml", {})], 1)
    assert result.failure is not None
    assert "the audit refuses" in result.failure
    assert tables([result])[0].rows[0][1] == "fails"
    assert "sphere is not generated: " in foot([result])


def test_medians_stand_beside_what_is_aimed_at() -> None:
    (table,) = tables([Generation("m", COLD, (1.0, 9.0, 2.0), (0.5, 0.1, 0.2)), Generation("n", LARGE, (3.0,), (0.3,))])
    assert table.rows == (("m", "2.00", "5", "0.20", "0.3"), ("n", "3.00", "30", "0.30", "0.3"))
