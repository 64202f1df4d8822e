"""`rsrm-gen new` writes what compiles as it is; `rsrm-gen list` shows what there is."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from commands import Command, runner, tree
from compiled import MANIFOLDS, NAMES, bundled_spec

from rsrm_gen.compiler.driver import compile_manifold


@pytest.fixture
def run(tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Command:
    monkeypatch.chdir(tmp_path)
    return runner(capsys, monkeypatch)


def test_points_are_embedded_unless_one_says_otherwise(run: Command, tmp_path: Path) -> None:
    assert run("new", "mine", "-o", "a").code == run("new", "mine", "-o", "b", "--embedded").code == 0
    assert (tmp_path / "a/mine.yaml").read_text() == (tmp_path / "b/mine.yaml").read_text()


@pytest.mark.parametrize("kind", ["--embedded", "--chart", "--product"])
def test_a_start_compiles_as_it_is_and_passes_the_audit(run: Command, tmp_path: Path, kind: str) -> None:
    ran = run("new", "mine", kind)
    assert (ran.code, ran.err) == (0, "")
    assert "rsrm-gen mine.yaml" in ran.out
    text = (tmp_path / "mine.yaml").read_text()
    assert text.count("#") > 8  # it explains itself
    assert "NAME" not in text.replace("NAME.yaml beside", "")
    compiled = compile_manifold(tmp_path / "mine.yaml")
    assert compiled.report.passed
    assert compiled.program.name == "mine"


def test_a_start_is_written_where_one_says(run: Command, tmp_path: Path) -> None:
    assert run("new", "mine", "-o", "some/where").code == 0
    assert list(tree(tmp_path)) == ["some/where/mine.yaml"]


def test_nothing_is_written_over(run: Command, tmp_path: Path) -> None:
    (tmp_path / "mine.yaml").write_text("mine")
    ran = run("new", "mine")
    assert ran.code == 2
    assert "mine.yaml is there already" in ran.err
    assert tree(tmp_path) == {"mine.yaml": "mine"}


@pytest.mark.parametrize("name", ["2d", "my-arm", "a b", "", "../x", "é", "a" * 41])
def test_a_wrong_name_is_refused(run: Command, tmp_path: Path, name: str) -> None:
    ran = run("new", name)
    assert ran.code == 2
    assert "no name for a manifold" in ran.err
    assert tree(tmp_path) == {}


def test_two_kinds_at_once_are_refused(run: Command) -> None:
    ran = run("new", "mine", "--chart", "--product")
    assert ran.code == 2
    assert "one of" in ran.err


def test_the_list_shows_every_bundled_manifold(run: Command) -> None:
    ran = run("list")
    assert (ran.code, ran.err) == (0, "")
    rows = ran.out.splitlines()[1:]
    assert [row.split()[0] for row in rows] == NAMES
    for name, row in zip(NAMES, rows, strict=True):
        spec = bundled_spec(name)
        assert re.match(rf"{name} +{spec.dim} ", row)
        assert row.rstrip().endswith(spec.doc[-60:])
        for parameter, value in spec.parameters:
            assert f"{parameter} = {value}" in row


def test_the_list_says_what_is_generated_and_what_is_stale(run: Command, tmp_path: Path) -> None:
    (tmp_path / "torus.yaml").write_text((MANIFOLDS / "torus.yaml").read_text())
    (tmp_path / "flat.yaml").write_text((MANIFOLDS / "euclidean.yaml").read_text().replace("euclidean", "flat"))
    (tmp_path / "notes.yaml").write_text("a: 1\n")
    (tmp_path / "wrong.yaml").write_text("manifold: wrong\nmetric: dot(u, v)\n")
    assert run("torus.yaml").code == 0
    ran = run("list", ".")
    assert re.search(r"(?m)^torus .* up to date ", ran.out)
    assert re.search(r"(?m)^flat .* not generated ", ran.out)
    assert re.search(r"(?m)^wrong .* cannot be read: `doc` is missing", ran.out)
    assert "notes" not in ran.out
    path = tmp_path / "generated/torus/torus.c"
    path.write_text(path.read_text() + "\n")
    assert re.search(r"(?m)^torus .* torus.c was edited by hand ", run("list", ".").out)


@pytest.mark.parametrize(
    ("folder", "message"), [("nowhere", "there is no folder nowhere"), (".", "no manifold files in")]
)
def test_a_list_of_nothing_is_a_mistake(run: Command, folder: str, message: str) -> None:
    ran = run("list", folder)
    assert ran.code == 2
    assert message in ran.err
