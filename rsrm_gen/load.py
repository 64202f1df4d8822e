"""`load("so3")`: a generated module as a `Manifold`, compiled and audited first when it was not yet."""

from __future__ import annotations

import hashlib
import sys
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path

from rsrm_gen.compiler.native import compiler
from rsrm_gen.compiler.output import contents, staleness, write
from rsrm_gen.compiler.spec import Spec, read_spec
from rsrm_gen.errors import UserError, did_you_mean
from rsrm_gen.files import bundled, cache_folder, imported
from rsrm_gen.kernels import accelerated
from rsrm_gen.manifold import Manifold

PACKAGE = Path(__file__).parent


def load(manifold: str | Path, **parameters: int | float | str) -> Manifold:
    """The torch object of a bundled manifold (by name) or of a manifold file (by path), its parameters overridden.

    Taken from the bundled generated code or from the cache where that is what the file gives today; else compiled and
    audited, which takes some seconds. Raises `UserError` for an unknown name, a wrong file or a refused audit.
    """
    path = _file(manifold)
    spec = read_spec(path, parameters)
    return _loaded(_generated(spec, path, parameters), spec.content_hash)


def _file(manifold: str | Path) -> Path:
    path = Path(manifold)
    if path.suffix in (".yaml", ".yml") or len(path.parts) > 1:
        return path
    folder = bundled("manifolds")
    names = sorted(p.stem for p in folder.glob("*.yaml"))
    if str(manifold) not in names:
        raise UserError(
            f"there is no bundled manifold `{manifold}`",
            hint=f"{did_you_mean(str(manifold), names)}; or give the path of a manifold file, ending in .yaml",
        )
    return folder / f"{manifold}.yaml"


def _generated(spec: Spec, path: Path, parameters: Mapping[str, int | float | str]) -> Path:
    """A folder with up-to-date generated code of the spec."""
    committed = bundled("generated") / spec.identifier
    if staleness(spec, committed) is None:
        return committed
    cached = cache_folder() / "generated" / _generator() / spec.content_hash[:32] / spec.identifier
    if staleness(spec, cached) is not None:
        from rsrm_gen.compiler.driver import compile_manifold  # sympy and CasADi, which fresh code does not need

        write(contents(compile_manifold(path, parameters)), cached)
    return cached


@lru_cache
def _generator() -> str:
    """A hash of the compiler's own source, so that code of an older compiler is not taken from the cache."""
    sources = sorted((PACKAGE / "compiler").rglob("*.py"))
    return hashlib.sha256(b"\0".join(source.read_bytes() for source in sources)).hexdigest()[:16]


@lru_cache
def _loaded(folder: Path, content_hash: str) -> Manifold:
    # The hash is in the key of the cache alone: a folder that was generated again is another manifold.
    manifold: Manifold = imported(folder / f"{folder.name}.py").manifold
    if compiler() is None:
        print("no C compiler found: sums of splats run in torch, many times slower", file=sys.stderr)
        return manifold
    return accelerated(manifold, folder)
