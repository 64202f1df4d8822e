"""`load("so3")`: a generated module as a `Manifold`, compiled and audited first when it was not yet."""

from __future__ import annotations

from pathlib import Path

from rsrm_gen.manifold import Manifold


def load(manifold: str | Path, **parameters: int | float | str) -> Manifold:
    """The torch module of a bundled manifold (by name) or of a YAML file (by path), with its parameters overridden."""
    raise NotImplementedError
