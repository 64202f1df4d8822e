"""Reports of the audit as tables and sentences."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from rsrm_gen.compiler.cli.screen import UNCUT, table
from rsrm_gen.errors import UserError

if TYPE_CHECKING:
    from rich.table import Table

    from rsrm_gen.compiler.audit import AuditReport, Check
    from rsrm_gen.compiler.emit import Measurement

PRECISIONS = ("float64", "float32")
SHORT = {"float64": "f64", "float32": "f32"}


def check_table(checks: Iterable[Check]) -> Table:
    """One row a check; digits are those that agree at the worst place, at most the 15 of a double."""
    columns = ("check", "points", "worst error", "tolerance", "digits", "passed", "where")
    rows = [
        (
            check.name,
            "all" if check.exact else str(check.points),
            f"{check.worst:.2g}",
            f"{check.tolerance:.3g}",
            str(check.digits),
            "yes" if check.passed else "NO",
            check.where or ("everywhere: seen by symbols" if check.exact else ""),
        )
        for check in checks
    ]
    return table(columns, rows, left=("check", "passed", "where"), cut="where")


def accuracy_table(measured: Sequence[Measurement]) -> Table:
    """One row a function: the worst error in both precisions."""
    bounds = {(m.routine, m.precision): m for m in measured}
    names = list(dict.fromkeys(m.routine for m in measured))
    rows = [
        (name, *(_bound(bounds.get((name, precision))) for precision in PRECISIONS), str(_points(measured, name)))
        for name in names
    ]
    return table(("function", *PRECISIONS, "points"), rows, left=("function",))


def summary_table(reports: Sequence[tuple[AuditReport, str | None]]) -> Table:
    """One row a manifold: how many checks passed, and the worst errors of every measured function."""
    routines = list(dict.fromkeys(m.routine for report, _ in reports for m in report.measured))
    columns = [f"{routine} {SHORT[precision]}" for routine in routines for precision in PRECISIONS]
    rows = []
    for report, stale in reports:
        bounds = {(m.routine, m.precision): m for m in report.measured}
        cells = [_bound(bounds.get((routine, precision))) for routine in routines for precision in PRECISIONS]
        rows.append((report.manifold, _count(report), *cells, _state(stale)))
    return table(("manifold", "checks", *columns, "code"), rows, left=("manifold", "code"), folds="code")


def summary(report: AuditReport, stale: str | None) -> str:
    """One sentence on the code and the audit of it."""
    code = "the code is what its manifold file gives" if stale is None else stale
    verdict = "checks passed" if report.passed else "checks passed: the code breaks its promises"
    return f"{code}; {_count(report)} {verdict}"


def complaint(check: Check, blame_file: bool = True) -> str:
    """A failed check as an error message, at the formula to blame unless the code was edited."""
    size = f"the error is {check.worst:.2g} (at most {check.tolerance:.3g}) {check.where}"
    message = f"{check.promise}, but {size if check.tolerance else check.where}"
    return str(UserError(message.rstrip(), check.span if blame_file else None, check.hint))


def _count(report: AuditReport) -> str:
    passed = sum(check.passed for check in report.checks)
    return f"{passed} of {len(report.checks)}"


def _state(stale: str | None) -> str:
    return stale or "up to date"


def _bound(measurement: Measurement | None) -> str:
    return f"<= {measurement.bound}" if measurement else ""


def _points(measured: Sequence[Measurement], name: str) -> int:
    return next(m.points for m in measured if m.routine == name)


def check_lines(checks: Iterable[Check]) -> list[str]:
    """The table of checks as plain lines."""
    from rich.console import Console

    console = Console(width=UNCUT, color_system=None)
    with console.capture() as captured:
        console.print(check_table(checks))
    return [line.rstrip() for line in captured.get().splitlines()]
