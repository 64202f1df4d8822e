"""Generated files on disk: written whole or not at all, and recognised again.

`audit.json` is the manifest too: it says what the files were made of (the manifold file's text, the parameters, the
compiler's own source) and what they must hash to. So `unchanged` can tell that there is nothing to do without reading a
formula; this module imports nothing that takes time.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rsrm_gen.errors import UserError
from rsrm_gen.files import PACKAGE, bundled, cache_folder
from rsrm_gen.version import __version__

if TYPE_CHECKING:
    from rsrm_gen.compiler.driver import Compiled
    from rsrm_gen.compiler.spec import Spec

AUDIT = "audit.json"
NAME = re.compile(r"""^manifold\s*:\s*["']?([A-Za-z]\w*)""", re.MULTILINE)

Overrides = Mapping[str, int | float | str]


def contents(compiled: Compiled) -> dict[str, str]:
    """All files of a compiled manifold; the audit says what they were made of and what they must hash to."""
    spec = compiled.spec
    document = json.loads(compiled.report.json())
    document["generator"] = generator()
    document["source"] = _text_hash(spec.source.text)
    document["parameters"] = {name: str(value) for name, value in spec.parameters}
    document["overridden"] = list(spec.overridden)
    if factors := dict(_factor_files(spec)):
        document["factors"] = factors
    document["files"] = {name: _hash(text) for name, text in compiled.files.items()}
    return {**compiled.files, AUDIT: json.dumps(document, indent=2) + "\n"}


def _factor_files(spec: Spec) -> Iterator[tuple[str, str]]:
    """The files of all factors of a product, theirs included, by name, with their hashes."""
    for factor in getattr(spec, "factors", ()):
        yield Path(factor.spec.source.name).name, _text_hash(factor.spec.source.text)
        yield from _factor_files(factor.spec)


def write(files: Mapping[str, str], folder: Path) -> None:
    """Write all files into a folder: first beside it under temporary names, then renamed, by one process at a time."""
    import tempfile  # not needed by who only looks

    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=folder, prefix=".writing-") as temporary:
            for name, text in files.items():
                (Path(temporary) / name).write_text(text, encoding="utf-8")
            with _alone(folder):
                for name in files:
                    os.replace(Path(temporary) / name, folder / name)
    except OSError as error:
        raise UserError(f"cannot write to {folder}: {error.strerror}", hint="choose another folder with -o") from None


@contextmanager
def _alone(folder: Path) -> Iterator[None]:
    """While this holds, no other process renames files into the folder; the lock lies in the cache, not in the way."""
    from filelock import FileLock

    locks = cache_folder() / "locks"
    try:
        locks.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        hint = "set RSRM_GEN_CACHE to a folder that can be written"
        raise UserError(f"cannot write to {locks}: {error.strerror}", hint=hint) from None
    with FileLock(locks / f"{_hash(str(folder.resolve()))[:32]}.lock"):
        yield


@lru_cache
def generator() -> str:
    """The version with a hash of the compiler's own source: `0.1.0+` and 16 digits. Printing is no part of it."""
    compiler = PACKAGE / "compiler"
    sources = sorted(path for path in compiler.rglob("*.py") if "cli" not in path.relative_to(compiler).parts)
    texts = [path.read_bytes().replace(b"\r\n", b"\n") for path in (PACKAGE / "document.py", *sources)]
    digest = hashlib.sha256(b"\0".join(texts)).hexdigest()
    return f"{__version__}+{digest[:16]}"


def staleness(spec: Spec, folder: Path, by_source: bool = True) -> str | None:
    """Why the files in a folder are not what the spec would give, or None if they are.

    Without `by_source`, code of the same version of the compiler is fresh whatever its source is.
    """
    document = manifest(folder)
    if isinstance(document, str):
        return document
    if document.get("content_hash") != spec.content_hash:
        return "stale: the manifold file or its parameters changed"
    return _other_generator(document, by_source) or edited(document, folder)


def unchanged(file: Path, overrides: Overrides, output: Path) -> Path | None:
    """The folder below `output` that holds what the file gives with these overrides, if nothing changed since.

    Compares texts and parameters with what the manifests in `output` say; None means that one has to look closer.
    """
    try:
        text = file.read_text(encoding="utf-8")
    except (OSError, ValueError):
        return None
    name = NAME.search(text)
    for path in sorted(output.glob(f"{name[1]}*/{AUDIT}")) if name else ():
        document = manifest(path.parent)
        if isinstance(document, str) or not _made_of(document, file, text, overrides):
            continue
        if _other_generator(document, by_source=True) is None and edited(document, path.parent) is None:
            return path.parent
    return None


def manifest(folder: Path) -> dict[str, Any] | str:
    """The audit of a folder of generated code, or in words why there is none."""
    try:
        document = json.loads((folder / AUDIT).read_text(encoding="utf-8"))
    except OSError:
        return "not generated yet"
    except ValueError:
        return f"{AUDIT} is damaged"
    whole = isinstance(document, dict) and isinstance(document.get("files"), dict)
    return document if whole else f"{AUDIT} is damaged"


def edited(document: Mapping[str, Any], folder: Path) -> str | None:
    """Which file of a folder is not the one that was written, in words."""
    for name, expected in document["files"].items():
        try:
            text = (folder / name).read_text(encoding="utf-8")
        except FileNotFoundError:
            return f"{name} is missing"
        except (OSError, ValueError):
            return f"{name} cannot be read"
        if _hash(text) != expected:
            return f"{name} was edited by hand"
    return None


def _other_generator(document: Mapping[str, Any], by_source: bool) -> str | None:
    version, _, source = str(document.get("generator")).partition("+")
    if version != __version__:
        return f"stale: generated by version {version}, this is {__version__}"
    if by_source and f"{version}+{source}" != generator():
        return "stale: the compiler itself changed"
    return None


def _made_of(document: Mapping[str, Any], file: Path, text: str, overrides: Overrides) -> bool:
    """Whether the manifest is of this text with these parameters."""
    if document.get("source") != _text_hash(text):
        return False
    factors = document.get("factors", {})
    return _same_parameters(document, overrides) and all(_factor(file, name) == h for name, h in factors.items())


def _same_parameters(document: Mapping[str, Any], overrides: Overrides) -> bool:
    recorded, overridden = document.get("parameters", {}), document.get("overridden", [])
    if not set(overridden) <= set(overrides) <= set(recorded):
        return False
    if not overrides:
        return True
    from fractions import Fraction

    try:
        return all(Fraction(str(value)) == Fraction(recorded[name]) for name, value in overrides.items())
    except (ValueError, ZeroDivisionError):
        return False  # whoever reads the file says what is wrong


def _factor(product: Path, name: str) -> str | None:
    """The hash of the file of a product's factor: beside the product, or bundled."""
    for folder in (product.parent, bundled("manifolds")):
        if (folder / name).is_file():
            return _text_hash((folder / name).read_text(encoding="utf-8"))
    return None


def _text_hash(text: str) -> str:
    return _hash(text.replace("\r\n", "\n"))


def _hash(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()
