"""Other tools, each used as its own users would, measured on the same rows as the generated code.

A peer is a file here with `functions(spec, precision)`: those of its functions that are ours, by our names, or none.
Each takes two arrays of rows in our conventions (points (N, D), then points or tangent vectors) in the precision, and
gives rows in our conventions. What a peer has no function for is absent; nothing is computed for it by other means.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib import import_module
from importlib.metadata import PackageNotFoundError, version
from typing import Any

from rsrm_gen.compiler.spec import Spec
from rsrm_gen.files import bundled

Evaluate = Callable[[Any, Any], Any]  # two arrays of rows -> array of rows
Functions = Callable[[Spec, str], Mapping[str, Evaluate]]


@dataclass(frozen=True)
class Peer:
    """Another tool: its name for a reader, the package that pip knows, and the functions it has of a manifold."""

    name: str
    package: str
    functions: Functions

    @property
    def version(self) -> str:
        """The version that is installed; empty if none is."""
        try:
            return version(self.package)
        except PackageNotFoundError:
            return ""

    def unusable(self, spec: Spec) -> str | None:
        """Why the peer cannot be measured here, or None if it can."""
        if not self.version:
            return "not installed"
        try:
            self.functions(spec, "float64")
        except ImportError as error:  # installed beside something that it does not go with
            return str(error)
        return None


def bundled_name(spec: Spec) -> str | None:
    """The name of a manifold that comes with this project, in any dimension `n`; None for any other.

    Peers know manifolds by their names, so that a file of the user's, or another radius, must not go by a name.
    """
    own = bundled("manifolds") / f"{spec.name}.yaml"
    same = own.is_file() and own.read_text(encoding="utf-8") == spec.source.text
    return spec.name if same and set(spec.overridden) <= {"n"} else None


def _lazily(module: str) -> Functions:
    def functions(spec: Spec, precision: str) -> Mapping[str, Evaluate]:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of a peer about its own code
            found: Mapping[str, Evaluate] = import_module(f"{__name__}.{module}").functions(spec, precision)
        return found

    return functions


PEERS = tuple(
    Peer(name, name.lower(), _lazily(name.lower()))
    for name in ("CasADi", "SymForce", "wrenfold", "geoopt", "geomstats")
)
