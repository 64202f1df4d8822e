"""Which code is meant, and of which manifold file it is: by the manifests in generated folders."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rsrm_gen.compiler.output import AUDIT, NAME, manifest
from rsrm_gen.errors import UserError
from rsrm_gen.files import bundled, manifold_file

if TYPE_CHECKING:
    from rsrm_gen.compiler.spec import Spec


@dataclass(frozen=True)
class Target:
    """A folder of generated code and the spec that it is held against."""

    folder: Path
    spec: Spec


def targets(what: Sequence[str], parameters: Mapping[str, str], output: Path, spec: Path | None) -> list[Target]:
    """What the arguments of a command name; raises `UserError` where that is nothing, or not clear."""
    found: dict[Path, Target] = {}
    for argument in what:
        for target in _targets(argument, parameters, output, spec):
            found.setdefault(target.folder.resolve(), target)
    return list(found.values())


def _targets(argument: str, parameters: Mapping[str, str], output: Path, spec: Path | None) -> Iterator[Target]:
    path = Path(argument)
    if not path.exists() and not parameters and _is_generated(output / argument):
        path = output / argument
    if not path.is_dir():
        yield _of_file(manifold_file(argument), parameters, output)
        return
    if _is_generated(path):
        yield _of_folder(path, parameters, spec)
        return
    files = manifold_files(path)
    folders = [folder for folder in sorted(path.iterdir()) if folder.is_dir() and _is_generated(folder)]
    if not files and not folders:
        raise UserError(f"there are neither manifold files nor folders of generated code in {path}")
    for file in files:
        yield _of_file(file, parameters, output)
    if not files:
        for folder in folders:
            yield _of_folder(folder, parameters, spec)


def manifold_files(folder: Path) -> list[Path]:
    """The YAML files in a folder that begin a manifold."""
    return [file for file in sorted(folder.glob("*.y*ml")) if file.is_file() and NAME.search(_text(file))]


def _text(file: Path) -> str:
    try:
        return file.read_text(encoding="utf-8")
    except (OSError, ValueError):
        return ""


def _is_generated(folder: Path) -> bool:
    return (folder / AUDIT).is_file() or bool(list(folder.glob("*_splats.c")))


def _of_file(file: Path, parameters: Mapping[str, str], output: Path) -> Target:
    from rsrm_gen.compiler.spec import read_spec

    spec = read_spec(file, parameters)
    folders = [folder / spec.identifier for folder in (output, bundled("generated"))]
    for folder in folders:
        if folder.is_dir():
            return Target(folder, spec)
    options = "".join(f" -p {name}={value}" for name, value in parameters.items())
    raise UserError(
        f"there is no generated code of `{spec.identifier}` in {output}",
        hint=f"generate it: rsrm-gen {file}{options} -o {output}",
    )


def _of_folder(folder: Path, parameters: Mapping[str, str], file: Path | None) -> Target:
    """The folder with the file that its manifest was made of, or else with one of the same name."""
    document = manifest(folder)
    recorded: Mapping[str, Any] = {} if isinstance(document, str) else document
    values = recorded.get("parameters", {})
    chosen = {name: values[name] for name in recorded.get("overridden", ()) if name in values} | dict(parameters)
    if file is not None:
        from rsrm_gen.compiler.spec import read_spec

        return Target(folder, read_spec(file, chosen))
    specs = [spec for path in _candidates(folder) if (spec := _read(path, chosen)) is not None]
    for spec in specs:
        if spec.content_hash == recorded.get("content_hash"):
            return Target(folder, spec)
    for spec in specs:
        if spec.identifier == recorded.get("manifold", folder.resolve().name):
            return Target(folder, spec)
    raise UserError(
        f"no manifold file was found that gives the code in {folder}", hint="name it: --spec path/to/the/file.yaml"
    )


def _candidates(folder: Path) -> Iterator[Path]:
    """Manifold files beside generated code and above it, then the bundled ones."""
    here = folder.resolve()
    for place in (here, *list(here.parents)[:2], Path.cwd(), Path.cwd() / "manifolds", bundled("manifolds")):
        if place.is_dir():
            yield from manifold_files(place)


def _read(file: Path, parameters: Mapping[str, str]) -> Spec | None:
    """The spec of a file, if it is one with these parameters."""
    from rsrm_gen.compiler.spec import read_spec

    try:
        return read_spec(file, parameters)
    except UserError:
        return None
