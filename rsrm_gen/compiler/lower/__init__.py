"""Stage 3: `Geometry` -> `Program`. Straight-line code over a shared graph: branches guarded, splats differentiated."""

from rsrm_gen.compiler.lower.interpret import interpret
from rsrm_gen.compiler.lower.ir import Culling, Node, Parameter, Program, Routine
from rsrm_gen.compiler.lower.lower import lower

__all__ = ["Culling", "Node", "Parameter", "Program", "Routine", "interpret", "lower"]
