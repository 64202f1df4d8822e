"""The JSON schema of manifold files: editors and the compiler agree on what a file may hold."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import jsonschema
import pytest
import yaml
from commands import in_a_process
from compiled import MANIFOLDS, NAMES

from rsrm_gen.compiler.cli.new import TEMPLATES
from rsrm_gen.compiler.spec import read_spec
from rsrm_gen.compiler.spec.editors import json_schema
from rsrm_gen.document import parse_document
from rsrm_gen.errors import UserError

SCHEMA = json_schema()
VALIDATOR = jsonschema.Draft202012Validator(SCHEMA)
FILES = [*(MANIFOLDS / f"{name}.yaml" for name in NAMES), *sorted(TEMPLATES.glob("*.yaml"))]

SPHERE = (MANIFOLDS / "sphere.yaml").read_text()
TORUS = (MANIFOLDS / "torus.yaml").read_text()
ARM = "manifold: arm\ndoc: An arm.\nproduct: {base: se2, wrist: {manifold: torus, parameters: {n: 3}, power: 2}}\n"


def test_the_schema_is_one() -> None:
    jsonschema.Draft202012Validator.check_schema(SCHEMA)


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_every_file_of_ours_fits(file: Path) -> None:
    VALIDATOR.validate(yaml.safe_load(file.read_text()))


GOOD = {
    "a number as a formula": TORUS.replace("period: 2 * pi", "period: 6"),
    "a matrix without quotes": TORUS.replace("dot(u, v)", "[[1, 0], [0, 2.5]]"),
    "a coordinate without a period": TORUS.replace("period: 2 * pi", "period: [2 * pi, null]"),
    "a let": SPHERE.replace("exp: cos(norm(v))", "exp:\n  let: {c: cos(norm(v))}\n  value: c"),
    "a product": ARM,
    "a factor in short": ARM.replace("base: se2", "base: torus(n=2)"),
    "a number as a parameter": SPHERE.replace("{n: 2}", "{n: 2.0}"),
}


@pytest.mark.parametrize("case", GOOD)
def test_what_the_compiler_reads_fits(case: str) -> None:
    VALIDATOR.validate(yaml.safe_load(GOOD[case]))
    read_spec(parse_document(GOOD[case], str(MANIFOLDS / "here.yaml")))


BAD = {
    "a misspelt key": SPHERE.replace("metric:", "metrik:"),
    "a misspelt key of a section": SPHERE.replace("project:", "projection:"),
    "no metric": TORUS.replace("metric: dot(u, v)\n", ""),
    "no exp": TORUS.replace("exp: wrap(p + v)\n", ""),
    "no injectivity radius": TORUS.replace("injectivity_radius: pi\n", ""),
    "no way to store a point": TORUS.replace("chart:\n  space: R^n\n  period: 2 * pi\n", ""),
    "two ways to store a point": SPHERE + "chart: {space: R^3}\n",
    "two policies": SPHERE.replace("  log: pi", "  policy: tie\n  log: pi"),
    "no policy": TORUS.replace(", policy: tie", ""),
    "half a policy": SPHERE.replace("  log_det: (n - 1) * log(pi / (4 * eps))\n", ""),
    "an unknown policy": TORUS.replace("policy: tie", "policy: coin"),
    "an unknown kind of maps": TORUS + "maps: projective\n",
    "a name with a blank": TORUS.replace("manifold: torus", "manifold: my torus"),
    "a name that is a number": TORUS.replace("manifold: torus", "manifold: 5"),
    "a truth for a formula": TORUS.replace("dot(u, v)", "true"),
    "a mapping for a formula": TORUS.replace("space: R^n", "space: {R: n}"),
    "a number as the description": TORUS.replace("doc: The flat torus T^n, n angles in radians, each modulo 2 pi.", "doc: 3"),
    "a let with a name that is none": TORUS.replace("log: wrap(q - p)", "log: {let: {1d: q - p}, value: q - p}"),
    "an empty formula": TORUS.replace("log: wrap(q - p)", 'log: ""'),
    "a let without a value": TORUS.replace("log: wrap(q - p)", "log: {let: {d: q - p}}"),
    "a product of nothing": "manifold: x\ndoc: X.\nproduct: {}\n",
    "a product with a metric": ARM + "metric: dot(u, v)\n",
    "a factor without a manifold": ARM.replace("manifold: torus, ", ""),
    "a factor with an unknown key": ARM.replace("power", "times"),
    "a list": "- manifold: x\n",
}  # fmt: skip


@pytest.mark.parametrize("case", BAD)
def test_what_the_compiler_refuses_for_its_form_does_not_fit(case: str) -> None:
    assert BAD[case] not in (SPHERE, TORUS, ARM), "the mistake is no longer made"
    assert not VALIDATOR.is_valid(yaml.safe_load(BAD[case]))
    with pytest.raises(UserError):
        read_spec(parse_document(BAD[case], str(MANIFOLDS / "here.yaml")))


def keys(schema: Any) -> Iterator[tuple[str, dict[str, Any]]]:
    """Every key that a file may have, with its schema."""
    for name, definition in schema["$defs"].items():
        for key, value in definition.get("properties", {}).items():
            yield f"{name}.{key}", value


@pytest.mark.parametrize(("key", "schema"), list(keys(SCHEMA)))
def test_every_key_says_what_it_is(key: str, schema: dict[str, Any]) -> None:
    assert schema["title"] == key.split(".")[1]
    assert key in {f"ManifoldFile.{section}" for section in ("embedded", "chart", "cut_locus")} or schema["examples"]
    assert len(schema["description"]) > 5


@pytest.mark.parametrize(("key", "schema"), list(keys(SCHEMA)))
def test_every_example_fits_its_key(key: str, schema: dict[str, Any]) -> None:
    validator = jsonschema.Draft202012Validator({**schema, "$defs": SCHEMA["$defs"]})
    for example in schema.get("examples", ()):
        validator.validate(example)


def test_the_command_prints_it(tmp_path: Path) -> None:
    ran = in_a_process(tmp_path, "schema")
    assert (ran.code, ran.err) == (0, "")
    assert json.loads(ran.out) == SCHEMA
