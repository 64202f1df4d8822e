"""The audit of one manifold, as a table of contents."""

from __future__ import annotations

from collections.abc import Mapping

from rsrm_gen.compiler.audit.given import sample_checks
from rsrm_gen.compiler.audit.kernels import check_kernels
from rsrm_gen.compiler.audit.numbers import check_numbers
from rsrm_gen.compiler.audit.product import check_formulas
from rsrm_gen.compiler.audit.report import AuditReport
from rsrm_gen.compiler.derive import Geometry
from rsrm_gen.compiler.lower import Program


def audit(geometry: Geometry, program: Program, files: Mapping[str, str]) -> AuditReport:
    """Check the laws of geometry, the two readings, and the numbers of the generated files."""
    formulas = check_formulas(geometry, program)
    if not all(check.passed for check in formulas):  # numbers of wrong formulas say nothing
        return AuditReport(program.name, geometry.spec.content_hash, tuple(formulas), ())
    numbers, measured = check_numbers(geometry, program, files)
    kernels = [*check_kernels(geometry, program, files), *sample_checks(geometry, program, files)]
    return AuditReport(program.name, geometry.spec.content_hash, (*formulas, *numbers, *kernels), measured)
