"""Where the bundled files are, files written whole or not at all, what is kept in a cache, Python files as modules."""

from __future__ import annotations

import hashlib
import importlib.util
import os
import sys
from collections.abc import Callable, Iterable
from pathlib import Path
from types import ModuleType
from typing import Any, BinaryIO

from rsrm_gen.errors import UserError, did_you_mean

PACKAGE = Path(__file__).parent


def cache_folder() -> Path:
    """Where compiled code and reference solutions are kept; `RSRM_GEN_CACHE` overrides the platform's place."""
    chosen = os.environ.get("RSRM_GEN_CACHE")
    if chosen:
        return Path(chosen)
    from platformdirs import user_cache_path

    return user_cache_path("rsrm-gen", appauthor=False)


def bundled(kind: str) -> Path:
    """The folder of bundled `manifolds` or `generated` code: in the installed package, or in the checkout."""
    inside = PACKAGE / "bundled" / kind
    return inside if inside.is_dir() else PACKAGE.parent / kind


def manifold_file(manifold: str | Path) -> Path:
    """The file of a bundled manifold (by name), or the path that was given; raises `UserError` for an unknown name."""
    path = Path(manifold)
    if path.suffix in (".yaml", ".yml") or len(path.parts) > 1 or path.is_file():
        return path
    folder = bundled("manifolds")
    names = sorted(p.stem for p in folder.glob("*.yaml"))
    if str(manifold) not in names:
        raise UserError(
            f"there is no bundled manifold `{manifold}`",
            hint=f"{did_you_mean(str(manifold), names)}; or give the path of a manifold file, ending in .yaml",
        )
    return folder / f"{manifold}.yaml"


def assignments(texts: Iterable[str]) -> dict[str, str]:
    """`["n=5"]` as `{"n": "5"}`."""
    return dict(_assignment(text) for text in texts)


def _assignment(text: str) -> tuple[str, str]:
    name, equals, value = text.partition("=")
    if not equals or not name or not value:
        raise UserError(f"`{text}` does not set a parameter", hint="write -p NAME=VALUE, like -p n=5")
    return name.strip(), value.strip()


def write_whole(path: Path, write: Callable[[BinaryIO], Any]) -> None:
    """Let `write` fill a file under a temporary name beside `path`, then rename it; the folder is made if need be."""
    temporary = path.with_name(f".{os.getpid()}.{path.name}")  # keeps the suffix, by which some writers choose a format
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with temporary.open("wb") as file:
            write(file)
        os.replace(temporary, path)
    except OSError as error:
        raise UserError(f"cannot write {path}: {error.strerror}") from None
    finally:
        if path.parent.is_dir():
            temporary.unlink(missing_ok=True)


def write_text_whole(path: Path, text: str) -> None:
    """`write_whole` for a text, in UTF-8."""
    write_whole(path, lambda file: file.write(text.encode()))


def imported(path: Path, keep: bool = True) -> ModuleType:
    """A Python file as a module; kept ones can be found again by their classes, as torch.compile does."""
    name = f"rsrm_gen_generated_{path.stem}_{hashlib.sha256(str(path).encode()).hexdigest()[:8]}"
    spec = importlib.util.spec_from_file_location(name, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    if keep:
        sys.modules[name] = module
    spec.loader.exec_module(module)
    return module
