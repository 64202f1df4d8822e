"""Stage 1: YAML text -> `ManifoldSpec`. Names, shapes and types are checked here; later stages trust them."""

from rsrm_gen.compiler.spec.model import CutLocus, ManifoldSpec, Map
from rsrm_gen.compiler.spec.read import read_spec

__all__ = ["CutLocus", "ManifoldSpec", "Map", "read_spec"]
