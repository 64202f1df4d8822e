"""The audit again, on generated code as it lies on disk: as it was written, edited by hand, or older than its file.

The manifold file is read, derived and lowered afresh; only the code that is run is that of the folder. So an edit is
judged by what it computes, not by being one.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from rsrm_gen.compiler.audit import AuditReport, Check, audit
from rsrm_gen.compiler.audit.product import check_formulas
from rsrm_gen.compiler.budget import SECONDS, limited, spend
from rsrm_gen.compiler.derive import Geometry
from rsrm_gen.compiler.driver import derived
from rsrm_gen.compiler.emit import emit
from rsrm_gen.compiler.lower import Program, lower
from rsrm_gen.compiler.output import Overrides, staleness
from rsrm_gen.compiler.spec import Spec, read_spec
from rsrm_gen.errors import UserError

CODE = (".py", ".h", ".c")


@dataclass(frozen=True)
class Verdict:
    """What the audit says of the code in a folder, and in words why the code is not what the file gives (or None)."""

    folder: Path
    spec: Spec
    report: AuditReport
    stale: str | None


def audit_file(file: Path, parameters: Overrides | None = None, seconds_allowed: float = SECONDS) -> AuditReport:
    """The audit of the code that a manifold file gives today; nothing is written. Raises `UserError` for a wrong file."""
    with limited("read", seconds_allowed):
        spec = read_spec(file, parameters)
    return _audit(spec, None, seconds_allowed)


def audit_folder(folder: Path, spec: Spec, seconds_allowed: float = SECONDS) -> Verdict:
    """The audit of the code in a folder against a spec; raises `UserError` where there is no code."""
    try:
        files = {path.name: path.read_text(encoding="utf-8") for path in folder.iterdir() if path.suffix in CODE}
    except (OSError, ValueError) as error:
        raise UserError(f"cannot read the code in {folder}: {error}") from None
    if not files:
        raise UserError(f"there is no generated code in {folder}", hint=f"generate it: rsrm-gen {spec.source.name}")
    return Verdict(folder, spec, _audit(spec, files, seconds_allowed), staleness(spec, folder))


def _audit(spec: Spec, files: Mapping[str, str] | None, seconds: float) -> AuditReport:
    with limited("derive", seconds):
        geometry = derived(spec)
    with limited("lower", seconds):
        program = lower(geometry)
    with limited("emit", seconds):
        fresh = emit(geometry, program)
    with limited("audit", seconds):
        return audit(geometry, program, fresh) if files is None else _audited(geometry, program, fresh, files)


def _audited(geometry: Geometry, program: Program, fresh: Mapping[str, str], files: Mapping[str, str]) -> AuditReport:
    """The audit of files that should be the fresh ones."""
    missing = sorted(fresh.keys() - files.keys())
    try:
        if missing:
            raise UserError(f"there is no {missing[0]}")
        return audit(geometry, program, {name: files[name] for name in fresh})
    except Exception as error:  # whatever code that anybody may have edited raises, and the C compiler's complaints
        spend()  # but where the budget is used up, that is no fault of the code
        formulas = check_formulas(geometry, program)
        return AuditReport(program.name, geometry.spec.content_hash, (*formulas, _does_not_run(error)), ())


def _does_not_run(error: Exception) -> Check:
    """The promise that is broken before any other can be tried."""
    message = error.message if isinstance(error, UserError) else f"{type(error).__name__}: {error}"
    first, *rest = message.splitlines()
    why = next((line for line in rest if "error" in line), first)
    return Check("code runs", "the generated code can be imported, compiled and called", float("inf"), 0.0, 1, why)
