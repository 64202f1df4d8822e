"""The audit of one manifold, as a table of contents."""

from __future__ import annotations

from collections.abc import Mapping

from rsrm_gen.compiler.audit.digits import digits_lost
from rsrm_gen.compiler.audit.given import sample_checks
from rsrm_gen.compiler.audit.interface import check_interface
from rsrm_gen.compiler.audit.kernels import check_kernels
from rsrm_gen.compiler.audit.laws import Laws
from rsrm_gen.compiler.audit.numbers import Code, check_numbers
from rsrm_gen.compiler.audit.product import check_formulas
from rsrm_gen.compiler.audit.report import AuditReport
from rsrm_gen.compiler.derive import Geometry, derive, derive_as_written
from rsrm_gen.compiler.lower import Program, lower
from rsrm_gen.compiler.lower.lower import routine_of
from rsrm_gen.compiler.spec import ProductSpec, Spec
from rsrm_gen.errors import UserError


def audit(geometry: Geometry, program: Program, files: Mapping[str, str]) -> AuditReport:
    """Check the laws of geometry, the two readings, and the numbers of the generated files."""
    formulas = check_formulas(geometry, program)
    if not all(check.passed for check in formulas):  # numbers of wrong formulas say nothing
        return AuditReport(program.name, geometry.spec.content_hash, tuple(formulas), ())
    code = Code(geometry, program, files)
    numbers, measured = check_numbers(code)
    kernels = [*check_kernels(code), *check_interface(code), *sample_checks(code)]
    return AuditReport(program.name, geometry.spec.content_hash, (*formulas, *numbers, *kernels), measured)


def explained(spec: Spec, error: UserError) -> UserError:
    """Why a spec could not be derived: a law that its formulas break says more than a 0/0 that it led to."""
    if isinstance(spec, ProductSpec):
        return _of_a_factor(spec) or error
    try:
        geometry = derive_as_written(spec)
        laws = Laws(geometry, lower(geometry), as_written=True).checks()
        AuditReport(spec.identifier, spec.content_hash, tuple(laws), ()).require()
    except UserError as reason:
        return reason
    routines = ((name, routine_of(geometry[name])) for name in ("exp", "log"))
    lost = next(filter(None, (digits_lost(geometry, name, routine) for name, routine in routines)), None)
    return UserError(error.message, lost.span, lost.advice) if lost else error


def _of_a_factor(spec: ProductSpec) -> UserError | None:
    """The same of the first factor that could not be derived."""
    for factor in spec.distinct():
        try:
            derive(factor.spec)
        except UserError as error:
            return explained(factor.spec, error)
    return None
