"""The compiler's driver. The pipeline, stage by stage:

    spec     YAML text -> Spec             formulas parsed, names and shapes checked, every error with its place
    derive   Spec -> Geometry              tangent spaces, gradients, |det D Log|; removable singularities removed
    lower    Geometry -> Program           a shared graph of scalar operations; the splat differentiated; branches guarded
    emit     Program -> text               a torch module, a C header and source; no algebra
    audit    all of these -> AuditReport   the laws of geometry, a second reading by CasADi, the numbers of the code

No stage reaches back and nothing passes by a global. A failed audit fails the build.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from rsrm_gen.compiler.audit import AuditReport, audit, explained
from rsrm_gen.compiler.budget import SECONDS, limited, spend
from rsrm_gen.compiler.derive import Geometry, derive
from rsrm_gen.compiler.emit import emit
from rsrm_gen.compiler.lower import Program, lower
from rsrm_gen.compiler.spec import Spec, read_spec
from rsrm_gen.errors import UserError

STAGES = ("spec", "derive", "lower", "emit", "audit")


@dataclass(frozen=True)
class Compiled:
    """A manifold, compiled and audited: the files to write, and what each stage made and took."""

    spec: Spec
    geometry: Geometry
    program: Program
    report: AuditReport
    files: Mapping[str, str]
    seconds: Mapping[str, float]


def compile_manifold(
    file: Path,
    parameters: Mapping[str, int | float | str] | None = None,
    progress: Callable[[str], None] = lambda stage: None,
    seconds_allowed: float = SECONDS,
) -> Compiled:
    """Compile one manifold file; raises `UserError` for a wrong file and for one that the audit refuses.

    Each of the stages may take `seconds_allowed` of the processor, and operations as `budget.OPERATIONS` has it.
    """
    seconds: dict[str, float] = {}

    @contextmanager
    def stage(name: str) -> Iterator[None]:
        progress(name)
        start = time.perf_counter()
        with limited("read" if name == "spec" else name, seconds_allowed):
            yield
        seconds[name] = seconds.get(name, 0.0) + time.perf_counter() - start

    with stage("spec"):
        spec = read_spec(file, parameters)
    with stage("derive"):
        geometry = derived(spec)
    with stage("lower"):
        program = lower(geometry)
    with stage("emit"):
        files = emit(geometry, program)
    with stage("audit"):
        report = audit(geometry, program, files)
        report.require()
    with stage("emit"):
        files = emit(geometry, program, report.measured)  # the same code, its measured accuracy in the heading
    return Compiled(spec, geometry, program, report, files, seconds)


def derived(spec: Spec) -> Geometry:
    """The geometry of a spec; where there is none, the audit of its formulas as they stand says why."""
    try:
        return derive(spec)
    except UserError as error:
        reason = explained(spec, error)
        try:
            spend()
        except UserError:  # what was used up is the reason
            reason = error
        raise reason from error
