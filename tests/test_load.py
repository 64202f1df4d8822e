"""`load`: by name, by path, with parameters; from what is generated already, and compiled only if it must be."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
import torch
from compiled import MANIFOLDS, NAMES

import rsrm_gen
from rsrm_gen import Manifold, UserError, load


@pytest.fixture
def no_compiling(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whoever compiles a manifold from here on fails."""

    def compiles(*arguments: object) -> None:
        raise AssertionError(f"{arguments} is compiled although it was already")

    monkeypatch.setattr("rsrm_gen.compiler.driver.compile_manifold", compiles)


@pytest.fixture
def own_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A manifold that is not bundled, and an empty cache."""
    monkeypatch.setenv("RSRM_GEN_CACHE", str(tmp_path / "cache"))
    text = (MANIFOLDS / "euclidean.yaml").read_text()
    file = tmp_path / "plane.yaml"
    file.write_text(text.replace("manifold: euclidean", "manifold: plane").replace("n: 3", "n: 2"))
    return file


@pytest.mark.usefixtures("no_compiling")
@pytest.mark.parametrize("name", NAMES)
def test_a_bundled_manifold_is_there_at_once(name: str) -> None:
    m = load(name)
    assert isinstance(m, Manifold)
    assert m.name == name
    p = m.project(torch.randn(m.point_size, dtype=torch.float64, generator=torch.Generator().manual_seed(1)))
    v = 0.5 * m.frame(p)[0]
    torch.testing.assert_close(m.log(p, m.exp(p, v)), v, rtol=0, atol=1e-13)
    assert type(m).__name__ == type(m).__mro__[1].__name__  # the kernel does not show


def test_parameters_make_another_manifold(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("RSRM_GEN_CACHE", str(tmp_path))
    m = load("torus", n=3)
    assert isinstance(m, Manifold)
    assert (m.name, m.dim) == ("torus_n3", 3)
    assert load("torus").dim == 2
    assert m.distance(torch.zeros(3), torch.tensor([3.0, 4.0 - 2 * torch.pi, 0.0])).item() == pytest.approx(
        (3**2 + (2 * torch.pi - 4) ** 2) ** 0.5
    )


@pytest.mark.usefixtures("no_compiling")
def test_a_parameter_at_its_default_changes_nothing() -> None:
    assert load("torus", n=2).name == "torus"
    assert load("torus", n="2").name == "torus"


def test_a_file_is_compiled_once(own_file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    first = load(own_file)
    assert isinstance(first, Manifold)
    assert (first.name, first.dim) == ("plane", 2)
    monkeypatch.setattr("rsrm_gen.compiler.driver.compile_manifold", lambda *_: pytest.fail("compiled again"))
    assert load(str(own_file)) is first


def test_a_changed_file_is_compiled_again(own_file: Path) -> None:
    assert load(own_file).dim == 2
    own_file.write_text(own_file.read_text().replace("n: 2", "n: 4"))
    assert load(own_file).dim == 4


def test_code_in_the_cache_that_was_edited_is_made_again(own_file: Path, tmp_path: Path) -> None:
    load(own_file)
    (code,) = (tmp_path / "cache").rglob("plane.py")
    good = code.read_text()
    code.write_text(good.replace("def log", "def logarithm"))
    load(own_file)
    assert code.read_text() == good


def test_a_wrong_file_leaves_nothing_in_the_cache(own_file: Path, tmp_path: Path) -> None:
    own_file.write_text(own_file.read_text().replace("exp: p + v", "exp: p + 2 * v"))
    with pytest.raises(UserError, match="the audit refuses"):
        load(own_file)
    assert not list((tmp_path / "cache" / "generated").rglob("*"))


@pytest.mark.parametrize(("wanted", "hint"), [("tours", "did you mean `torus`"), ("klein", "known here: arm2, ")])
def test_an_unknown_name_is_told_from_a_misspelt_one(wanted: str, hint: str) -> None:
    with pytest.raises(UserError, match=f"no bundled manifold `{wanted}`") as caught:
        load(wanted)
    assert hint in str(caught.value.hint)


def test_a_missing_file_and_an_unknown_parameter_are_told(tmp_path: Path) -> None:
    with pytest.raises(UserError, match=r"nowhere\.yaml"):
        load(tmp_path / "nowhere.yaml")
    with pytest.raises(UserError, match="no parameter `m`"):
        load("torus", m=3)


IMPORTS = """
import sys
import rsrm_gen
rsrm_gen.load("so3")
print(sorted({"sympy", "casadi", "mpmath", "matplotlib", "scipy"} & set(sys.modules)))
"""


def test_to_import_the_package_takes_no_time() -> None:
    script = "import sys, rsrm_gen; print(sorted({'torch', 'numpy', 'sympy', 'pydantic', 'yaml'} & set(sys.modules)))"
    root = str(Path(rsrm_gen.__file__).parent.parent)
    environment = {**os.environ, "PYTHONPATH": root}
    ran = subprocess.run([sys.executable, "-c", script], env=environment, capture_output=True, text=True, check=True)
    assert ran.stdout == "[]\n"


def test_what_is_compiled_needs_no_compiler_of_formulas() -> None:
    root = str(Path(rsrm_gen.__file__).parent.parent)
    ran = subprocess.run(
        [sys.executable, "-c", IMPORTS],
        env={**os.environ, "PYTHONPATH": root},
        capture_output=True,
        text=True,
        check=True,
    )
    assert ran.stdout == "[]\n"
