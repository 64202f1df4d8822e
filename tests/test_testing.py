"""The audit in a user's own tests: two lines, and a failure that says what is wrong."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import pytest
from compiled import MANIFOLDS

from rsrm_gen.compiler.audit import AuditReport
from rsrm_gen.compiler.driver import compile_manifold
from rsrm_gen.compiler.output import contents, write
from rsrm_gen.testing import assert_audited

pytest_plugins = ["pytester"]


@pytest.fixture
def theirs(pytester: pytest.Pytester) -> pytest.Pytester:
    """A user's folder with a right manifold and a wrong one."""
    text = (MANIFOLDS / "euclidean.yaml").read_text()
    (pytester.path / "flat.yaml").write_text(text.replace("euclidean", "flat"))
    (pytester.path / "wrong.yaml").write_text(text.replace("exp: p + v", "exp: p + 3 * v"))
    return pytester


def run(theirs: pytest.Pytester, test: str) -> pytest.RunResult:
    theirs.makepyfile(test)
    # Installed, the plugin is found by its entry point; here it is named.
    return theirs.runpytest_subprocess("-p", "rsrm_gen.testing", "-p", "no:cacheprovider")


def test_two_lines_are_enough(theirs: pytest.Pytester) -> None:
    ran = run(theirs, "def test_my_manifold(audited):\n    audited('flat.yaml', n=2)\n")
    ran.assert_outcomes(passed=1)


def test_a_broken_promise_fails_the_test_readably(theirs: pytest.Pytester) -> None:
    ran = run(theirs, "def test_my_manifold(audited):\n    audited('wrong.yaml')\n")
    ran.assert_outcomes(failed=1)
    shown = ran.stdout.str()
    assert "checks of `euclidean` fail:" in shown
    assert re.search(r"wrong\.yaml:7:6: error: .* but the error is .* at p = \(", shown)
    assert re.search(r"(?m)^E +exp: p \+ 3 \* v$", shown)
    assert re.search(r"(?m)^E +log\(exp\) +16 +\d(\.\d)? +1e-12 +-?\d+ +NO ", shown)
    assert "reaudit.py" not in shown  # none of our own frames


def test_a_mistake_in_the_file_fails_the_test_readably(theirs: pytest.Pytester) -> None:
    ran = run(theirs, "def test_my_manifold(audited):\n    audited('flat.yaml', m=2)\n")
    ran.assert_outcomes(failed=1)
    ran.stdout.fnmatch_lines(["E*error: `flat` has no parameter `m`"])


def test_without_fixtures_there_is_a_function(theirs: pytest.Pytester) -> None:
    ran = run(
        theirs,
        "from rsrm_gen.testing import assert_audited\n\ndef test_mine():\n    assert_audited('flat.yaml').passed\n",
    )
    ran.assert_outcomes(passed=1)


def test_the_report_is_returned_to_look_further() -> None:
    report = assert_audited("euclidean", n=1)
    assert isinstance(report, AuditReport)
    assert report.passed
    assert {m.bound for m in report.measured} == {1}


def test_code_that_lies_somewhere_can_be_audited_instead(tmp_path: Path) -> None:
    write(contents(compile_manifold(MANIFOLDS / "euclidean.yaml")), tmp_path / "code")
    assert_audited("euclidean", generated=tmp_path / "code")
    path = tmp_path / "code" / "euclidean.py"
    path.write_text(path.read_text().replace("p0 + v0", "p0 + 2 * v0"))
    with pytest.raises(AssertionError, match="exp torch float64"):
        assert_audited("euclidean", generated=tmp_path / "code")


def test_the_fixture_is_registered_for_whoever_installs() -> None:
    project = tomllib.loads((MANIFOLDS.parent / "pyproject.toml").read_text())["project"]
    # The name is the module's, so that `-p rsrm_gen.testing` does not register it twice.
    assert project["entry-points"]["pytest11"] == {"rsrm_gen.testing": "rsrm_gen.testing"}
