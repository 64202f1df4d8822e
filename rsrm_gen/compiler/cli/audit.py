"""`rsrm-gen audit SPEC|DIR...`: every check again, on the code as it lies on disk."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from rsrm_gen.compiler.budget import SECONDS
from rsrm_gen.compiler.cli.compile import progress
from rsrm_gen.compiler.cli.options import GENERATED, BudgetOption, OutputOption, ParameterOption
from rsrm_gen.compiler.cli.report import accuracy_table, check_table, complaint, summary, summary_table
from rsrm_gen.compiler.cli.screen import err, out
from rsrm_gen.compiler.cli.targets import targets
from rsrm_gen.files import assignments

if TYPE_CHECKING:
    from rsrm_gen.compiler.reaudit import Verdict

EXPLANATION = "worst errors in units of what rounding inputs and output costs, at most; below 64 passes"


def audit_command(
    what: Annotated[
        list[str],
        typer.Argument(
            metavar="SPEC|DIR",
            help="Manifold files or bundled names, folders of them, folders of generated code, or folders of those.",
            show_default=False,
        ),
    ],
    parameter: ParameterOption = [],  # noqa: B006
    output: OutputOption = GENERATED,
    spec: Annotated[
        Path | None, typer.Option("--spec", metavar="FILE", help="The manifold file that the code in DIR is of.")
    ] = None,
    budget: BudgetOption = SECONDS,
    as_json: Annotated[bool, typer.Option("--json", help="Print the reports as JSON.")] = False,
) -> None:
    """Audit generated code as it is on disk, edited or not.

    Reruns every check against that code and shows what was found. Exits with 1 when a check fails.
    """
    found = targets(what, assignments(parameter), output, spec)
    from rsrm_gen.compiler.native import compiler
    from rsrm_gen.compiler.reaudit import audit_folder

    if compiler() is None:
        err().print("no C compiler found: the C code is not audited", soft_wrap=True)
    verdicts = []
    with progress("audit") as tell:
        for target in found:
            tell(target.folder.name)
            verdicts.append(audit_folder(target.folder, target.spec, budget))
    passed = all(verdict.report.passed for verdict in verdicts)
    if as_json:
        print(json.dumps({"passed": passed, "reports": [_document(verdict) for verdict in verdicts]}, indent=2))
    else:
        _show(verdicts)
    if not passed:
        raise typer.Exit(1)


def _show(verdicts: list[Verdict]) -> None:
    if len(verdicts) == 1:
        out().print(check_table(verdicts[0].report.checks))
        if verdicts[0].report.measured:
            out().print()
            out().print(accuracy_table(verdicts[0].report.measured))
    else:
        out().print(summary_table([(v.report, v.stale) for v in verdicts]))
    if any(verdict.report.measured for verdict in verdicts):
        out().print(EXPLANATION, style="dim", soft_wrap=True)
    print()
    for verdict in verdicts:
        failed = [check for check in verdict.report.checks if not check.passed]
        for check in failed:
            print(complaint(check, blame_file=verdict.stale is None))
        if len(verdicts) == 1 or failed:
            print(f"{verdict.folder}: {summary(verdict.report, verdict.stale)}")


def _document(verdict: Verdict) -> dict[str, Any]:
    report = verdict.report
    return {
        "manifold": report.manifold,
        "folder": str(verdict.folder),
        "file": verdict.spec.source.name,
        "content_hash": report.content_hash,
        "stale": verdict.stale,
        "passed": report.passed,
        "checks": [
            {
                "check": check.name,
                "promise": check.promise,
                "points": check.points,
                "exactly": check.exact,
                "digits": check.digits,
                "worst": check.worst if check.worst < float("inf") else None,  # JSON has no infinity
                "tolerance": check.tolerance,
                "where": check.where,
                "passed": check.passed,
            }
            for check in report.checks
        ],
        "accuracy": [
            {"function": m.routine, "precision": m.precision, "error_at_most": m.bound, "points": m.points}
            for m in report.measured
        ],
    }
