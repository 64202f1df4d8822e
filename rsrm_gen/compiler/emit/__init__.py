"""Stage 4: `Program` -> text. One back end a file; none of them does algebra."""

from __future__ import annotations

from rsrm_gen.compiler.derive import Geometry
from rsrm_gen.compiler.emit import c, c_splats, torch
from rsrm_gen.compiler.emit.heading import Measurement, heading
from rsrm_gen.compiler.lower import Program

__all__ = ["Measurement", "emit"]


def emit(geometry: Geometry, program: Program, measured: tuple[Measurement, ...] = ()) -> dict[str, str]:
    """The generated files by name; `measured` is the accuracy that their headings state."""
    lines = heading(geometry, program, measured)
    return {
        f"{program.name}.py": torch.module(geometry, program, lines),
        f"{program.name}.h": c.header(geometry, program, lines),
        f"{program.name}.c": c.source(geometry, program, lines),
        f"{program.name}_splats.c": c_splats.source(program, lines[0]),
    }
