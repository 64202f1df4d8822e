"""Stage 1: YAML text -> `Spec`. Names, shapes and types are checked here; later stages trust them."""

from rsrm_gen.compiler.spec.model import CutLocus, ManifoldSpec, Map, ProductSpec, Spec
from rsrm_gen.compiler.spec.read import read_spec

__all__ = ["CutLocus", "ManifoldSpec", "Map", "ProductSpec", "Spec", "read_spec"]
