"""The audit in your own tests: in two lines, your manifold is derived, and everything `rsrm-gen` promises is checked.

    def test_my_manifold(audited):          # a fixture, there wherever rsrm-gen is installed with pytest
        audited("my.yaml", n=3)

or, where no fixtures are used,

    from rsrm_gen.testing import assert_audited
    assert_audited("my.yaml", n=3)
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from rsrm_gen.errors import UserError
from rsrm_gen.files import manifold_file

if TYPE_CHECKING:
    from rsrm_gen.compiler.audit import AuditReport, Check

Audited = Callable[..., "AuditReport"]


def assert_audited(
    manifold: str | Path, *, generated: str | Path | None = None, **parameters: int | float | str
) -> AuditReport:
    """Assert that a manifold passes the audit; an `AssertionError` says what failed, where, and by how much.

    `manifold` is the path of a manifold file or the name of a bundled one, with its parameters overridden. The code that
    is audited is what the file gives today, or what lies in the folder `generated`, edited or not. Returns the report.
    """
    __tracebackhide__ = True
    from rsrm_gen.compiler.reaudit import audit_file, audit_folder
    from rsrm_gen.compiler.spec import read_spec

    try:
        file = manifold_file(manifold)
        if generated is None:
            report = audit_file(file, parameters)
        else:
            report = audit_folder(Path(generated), read_spec(file, parameters)).report
    except UserError as error:
        raise AssertionError(str(error)) from None
    if not report.passed:
        raise AssertionError(refusal(report))
    return report


def refusal(report: AuditReport) -> str:
    """What a failed audit says: every failed check as an error at its formula, then the table of all checks."""
    from rsrm_gen.compiler.cli.report import check_lines, complaint

    failed = [check for check in report.checks if not check.passed]
    return "\n".join([_headline(report, failed), *map(complaint, failed), "", *check_lines(report.checks)])


def _headline(report: AuditReport, failed: list[Check]) -> str:
    return f"{len(failed)} of {len(report.checks)} checks of `{report.manifold}` fail:"


@pytest.fixture(scope="session")
def audited() -> Audited:
    """`audited("my.yaml", n=3)` asserts that a manifold passes the audit of rsrm-gen, and returns the report."""
    return assert_audited
