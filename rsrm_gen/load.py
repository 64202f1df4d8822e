"""`load("so3")`: a generated module as a `Manifold`, compiled and audited first when it was not yet.

What takes long to import (torch, the schema of manifold files, the compiler) is imported when it is needed, so that
`import rsrm_gen` takes no time and `load` of what is compiled already needs no compiler.
"""

from __future__ import annotations

import logging
import os
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rsrm_gen.compiler.output import contents, generator, manifest, staleness, write
from rsrm_gen.errors import UserError
from rsrm_gen.files import bundled, cache_folder, imported, manifold_file
from rsrm_gen.manifold import Manifold

if TYPE_CHECKING:
    from rsrm_gen.compiler.spec import Spec

CHOICES = ("auto", "c", "torch")
CULLING = ("auto", "on", "off")

log = logging.getLogger("rsrm_gen")


def load(
    manifold: str | Path, kernels: str | None = None, culling: str | None = None, **parameters: int | float | str
) -> Manifold:
    """The torch object of a bundled manifold (by name) or of a manifold file (by path), its parameters overridden.

    Taken from the bundled generated code or from the cache where that is what the file gives today; else compiled and
    audited, which takes some seconds. Raises `UserError` for an unknown name, a wrong file or a refused audit.

    `kernels` says what computes sums of splats: "c", "torch", or "auto", which is C for what C can do; left out, what the
    environment variable RSRM_KERNELS says, or "auto". `Manifold.kernels` tells which it is.

    `culling` says whether C, in sums of splats that are given widths, leaves out the pairs that are too far apart to count:
    "on", "off", or "auto", which is where it pays; left out, what RSRM_CULLING says, or "auto".
    """
    from rsrm_gen.compiler.spec import read_spec

    choice = _choice("kernels", kernels, CHOICES), _choice("culling", culling, CULLING)
    path = manifold_file(manifold)
    spec = read_spec(path, parameters)
    return _loaded(_generated(spec, path, parameters), spec.content_hash, *choice)


def _choice(name: str, given: str | None, choices: tuple[str, ...]) -> str:
    """What is given, else what the environment says, else "auto"."""
    place = name if given else f"RSRM_{name.upper()}"
    chosen = given or os.environ.get(place) or "auto"
    if chosen not in choices:
        raise UserError(f"{place} is `{chosen}`", hint=f"one of {', '.join(choices)}")
    return chosen


def load_in_rows(manifold: str | Path, kernels: str | None = None, **parameters: int | float | str) -> Manifold:
    """The same, and where no derivative of them is asked for, its functions of points run in C: see `rows.py`."""
    from rsrm_gen.compiler.spec import read_spec

    choice = _choice("kernels", kernels, CHOICES), _choice("culling", None, CULLING)
    path = manifold_file(manifold)
    spec = read_spec(path, parameters)
    return _loaded(_generated(spec, path, parameters), spec.content_hash, *choice, in_rows=True)


def read_audit(manifold: str | Path, **parameters: int | float | str) -> dict[str, Any]:
    """What the audit of a manifold's generated code found, as its audit.json says; compiled first when it was not yet."""
    from rsrm_gen.compiler.spec import read_spec

    path = manifold_file(manifold)
    found = manifest(_generated(read_spec(path, parameters), path, parameters))
    if isinstance(found, str):
        raise UserError(f"there is no audit of {manifold}: {found}")
    return found


def _generated(spec: Spec, path: Path, parameters: Mapping[str, int | float | str]) -> Path:
    """A folder with up-to-date generated code of the spec."""
    committed = bundled("generated") / spec.identifier
    if staleness(spec, committed, by_source=False) is None:
        return committed
    cached = cache_folder() / "generated" / generator() / spec.content_hash[:32] / spec.identifier
    if staleness(spec, cached) is not None:
        from rsrm_gen.compiler.driver import compile_manifold  # sympy and CasADi, which fresh code does not need

        write(contents(compile_manifold(path, parameters)), cached)
    return cached


@lru_cache
def _loaded(folder: Path, content_hash: str, choice: str, culling: str, in_rows: bool = False) -> Manifold:
    # The hash is in the key of the cache alone: a folder that was generated again is another manifold.
    from rsrm_gen.compiler.native import compiler

    manifold: Manifold = imported(folder / f"{folder.name}.py").manifold
    if choice == "torch":
        return manifold
    if compiler() is None:
        hint = "install one, or name it in CC"
        if choice == "c":
            raise UserError("C is wanted for sums of splats, but there is no C compiler", hint=hint)
        log.warning("no C compiler found: sums of splats run in torch, many times slower; %s", hint)
        return manifold
    from rsrm_gen.kernels import accelerated

    if in_rows:
        from rsrm_gen.rows import in_rows as by_rows

        manifold = by_rows(manifold, folder)
    return accelerated(manifold, folder, always=choice == "c", culling=culling)
