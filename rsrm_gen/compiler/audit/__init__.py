"""Stage 5: everything before it -> `AuditReport`. Checks the mathematics of the manifold file and the numbers of the code.

A check that fails fails the build. What is compared with what:

    laws        the author's formulas against what geometry demands of them, in 50 digits; a broken law names its culprit
    readings    the same file read by sympy and our graph, and independently by CasADi
    numbers     exp, log, distance and log det of the torch and C code, in double and in float, against 60 digits
    kernels     every other function, and the C sums of splats forward and backward, against exact ones
"""

from rsrm_gen.compiler.audit.audit import audit, explained
from rsrm_gen.compiler.audit.report import AuditReport, Check

__all__ = ["AuditReport", "Check", "audit", "explained"]
