"""Every training of the benchmark in a folder of its own: what it was given, how far it is, what came out.

OUT/METHOD/torus-1/       a run folder, as `rsrm train` makes them
OUT/METHOD/torus-1.yaml   its scene file; `rsrm train` takes it too, where the model is splats
OUT/METHOD/torus-1/job.json   what was asked for; a folder with another one is begun again
OUT/METHOD/torus-1/row.json   what came out, written last
"""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import yaml

from rsrm_gen.bench.paper.methods import Method
from rsrm_gen.bench.paper.published import NetworkShape, place
from rsrm_gen.bench.paper.rows import VERSION, Row, read_row
from rsrm_gen.document import read_document
from rsrm_gen.errors import UserError
from rsrm_gen.files import bundled, write_text_whole
from rsrm_gen.trainer.run import RunFolder
from rsrm_gen.trainer.scene import Scene, read_scene
from rsrm_gen.trainer.settings import EikonalTraining

NAME = re.compile(r"(?P<manifold>\w+)-(?P<seed>\d+)")


@dataclass(frozen=True)
class SceneFile:
    """One of the experiments: `torus-1.yaml`."""

    path: Path
    manifold: str
    seed: int


@dataclass(frozen=True)
class Job:
    """One training: a method on a scene."""

    method: Method
    file: SceneFile
    output: Path  # of the whole benchmark
    quick: bool = False

    @property
    def name(self) -> str:
        """For a person."""
        return f"{self.file.path.stem} by {self.method.key}"

    @property
    def folder(self) -> RunFolder:
        """Where it is trained."""
        return RunFolder(self.output / self.method.key / self.file.path.stem)

    @property
    def row_file(self) -> Path:
        """Where its result is written."""
        return self.folder.path / "row.json"

    @cached_property
    def scene(self) -> Scene:
        """The scene with the training of the method, read from a file that is written first."""
        given = read_scene(self.file.path)
        document = dict(read_document(self.file.path).data)
        if given.manifold_choice.is_path:
            document["manifold"] = {**given.manifold_choice.model_dump(), "spec": self._beside_the_scene(given)}
        document["training"] = dict(
            self.method.training(document.get("training", {}), given.manifold, self.file.seed, self.quick)
        )
        path = self.output / self.method.key / f"{self.file.path.stem}.yaml"
        write_text_whole(path, yaml.safe_dump(document, sort_keys=False, allow_unicode=True))
        scene = read_scene(path, given.manifold)
        if self.method.recipe and not isinstance(scene.training, EikonalTraining):
            hint = "give it `objective: eikonal`, or choose --method ours"
            raise UserError(f"{self.file.path} is no scene for the paper's recipe: it has another objective", hint=hint)
        return scene

    def _beside_the_scene(self, scene: Scene) -> str:
        return str((self.file.path.parent / scene.manifold_choice.spec).resolve())

    @cached_property
    def network(self) -> NetworkShape | None:
        """What is trained in the place of splats."""
        return self.method.network(self.scene.manifold)

    @property
    def asked(self) -> dict[str, Any]:
        """Everything that the result depends on, but for the machine and the code."""
        return {
            "version": VERSION,
            "scene": self.scene.source.text,
            "content_hash": self.scene.manifold.content_hash,
            "training": self.scene.training.model_dump(mode="json"),
            "network": self.network and self.network.model_dump(),
        }

    def is_asked_for(self) -> bool:
        """Whether the folder holds this training, finished or not, and not an older one with other settings."""
        try:
            return bool(json.loads((self.folder.path / "job.json").read_text(encoding="utf-8")) == self.asked)
        except (OSError, ValueError):
            return False

    def note_asked(self) -> None:
        """Keep what is asked for beside the training."""
        write_text_whole(self.folder.path / "job.json", json.dumps(self.asked, indent=1) + "\n")

    def finished(self) -> Row | None:
        """Its result, where there is one."""
        return read_row(self.row_file) if self.row_file.exists() and self.is_asked_for() else None

    def kept(self) -> Row | None:
        """The result that its folder holds, whatever was asked for."""
        return read_row(self.row_file) if self.row_file.exists() else None

    def keep(self, row: Row) -> None:
        """The result; whoever reads meanwhile sees none or all of it."""
        write_text_whole(self.row_file, json.dumps(asdict(row), indent=1) + "\n")


def scene_files(folder: Path | None, manifolds: Sequence[str], seeds: Sequence[int]) -> list[SceneFile]:
    """The experiments in a folder (those of the paper, where none is given) on these manifolds and seeds; empty: all."""
    folder = folder or bundled("examples") / "paper"
    found = []
    for path in folder.glob("*.yaml"):
        match = NAME.fullmatch(path.stem)
        if match:
            found.append(SceneFile(path, match["manifold"], int(match["seed"])))
    for what, chosen, known in (
        ("manifold", manifolds, {file.manifold for file in found}),
        ("seed", seeds, {file.seed for file in found}),
    ):
        for choice in chosen:
            if choice not in known:
                there = (
                    ", ".join(sorted(map(str, known), key=lambda word: (len(word), word)))
                    or "none named like torus-1.yaml"
                )
                raise UserError(f"no scene in {folder} has the {what} {choice}", hint=f"there are: {there}")
    if not found:
        raise UserError(
            f"{folder} holds no scenes", hint="they are named like torus-1.yaml; give a folder with --scenes"
        )
    kept = [f for f in found if (not manifolds or f.manifold in manifolds) and (not seeds or f.seed in seeds)]
    return sorted(kept, key=lambda f: (place(f.manifold), f.seed))
