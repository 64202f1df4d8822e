"""docs/scenes.md tells the truth: its examples are scenes, its tables name every key and no other."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from rsrm_gen.trainer.scene import read_scene
from rsrm_gen.trainer.settings import BellmanTraining, EikonalTraining, PathsTraining, SceneDocument

PAGE = (Path(__file__).parent.parent / "docs" / "scenes.md").read_text()
EXAMPLES = re.findall(r"^```yaml\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
KEYS = {
    key for cell in re.findall(r"^\| ((?:`\w+`(?:, )?)+) \|", PAGE, re.MULTILINE) for key in re.findall(r"\w+", cell)
}


@pytest.mark.parametrize("text", EXAMPLES)
def test_an_example_is_a_scene(tmp_path: Path, text: str) -> None:
    path = tmp_path / "scene.yaml"
    path.write_text(text)
    assert read_scene(path).training.objective.kind == "paths"


def test_the_tables_name_every_key() -> None:
    models = (SceneDocument, PathsTraining, BellmanTraining, EikonalTraining)
    assert {name for model in models for name in model.model_fields} == KEYS
