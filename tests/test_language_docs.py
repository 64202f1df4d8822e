"""docs/language.md tells the truth: its examples run, its tables are complete.

The rule of its examples, by what stands after `yaml` on the opening line:

    (nothing)          a complete file: compiled and audited
    in NAME            its keys replace those of the bundled manifold NAME: compiled and audited
    refused in NAME    the same, refused with the message in the `text` block that follows
    matrices           a complete file, once the language has words for matrices
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import mpmath as mp
import pytest
from compiled import MANIFOLDS

from rsrm_gen.compiler.derive.geometry import argument
from rsrm_gen.compiler.derive.numeric import value
from rsrm_gen.compiler.derive.scalarise import Reading, Trace
from rsrm_gen.compiler.driver import compile_manifold
from rsrm_gen.compiler.spec import formula as f
from rsrm_gen.compiler.spec import formulas, product, read, read_spec
from rsrm_gen.compiler.spec.editors import json_schema
from rsrm_gen.compiler.spec.shapes import shape_of
from rsrm_gen.compiler.spec.vocabulary import CONSTANTS, WORDS
from rsrm_gen.document import parse_document
from rsrm_gen.errors import Source, Span, UserError

PAGE = (MANIFOLDS.parent / "docs" / "language.md").read_text()
BLOCK = re.compile(
    r"^```yaml *(?P<rule>.*)\n(?P<text>(?:.*\n)*?)```\n(?:\n```text\n(?P<message>.*)\n```)?", re.MULTILINE
)
ROW = re.compile(r"^\| `(?P<signature>\w+\(.*?\))` \| (?P<meaning>.*?) \| `(?P<example>.*)` \|$", re.MULTILINE)


@dataclass(frozen=True)
class Example:
    """A block of the page."""

    rule: str
    text: str
    message: str | None
    line: int

    def __str__(self) -> str:
        return f"line {self.line} {self.rule}".strip()


EXAMPLES = [
    Example(m["rule"], m["text"], m["message"], PAGE[: m.start()].count("\n") + 1) for m in BLOCK.finditer(PAGE)
]
ACCEPTED = [example for example in EXAMPLES if not example.rule.startswith("refused")]
REFUSED = [example for example in EXAMPLES if example.rule.startswith("refused")]


def complete(example: Example) -> str:
    """A fragment in its place: its top-level keys instead of those of the bundled manifold."""
    name = example.rule.removeprefix("refused").strip().removeprefix("in ")
    if not example.rule or example.rule == "matrices":
        return example.text
    text = (MANIFOLDS / f"{name}.yaml").read_text()
    for key in re.findall(r"^(\w+):", example.text, re.MULTILINE):
        text = re.sub(rf"^{key}:.*\n(?:[ #].*\n)*", "", text, flags=re.MULTILINE)
    return text + example.text


def test_there_are_examples_of_every_kind() -> None:
    rules = [example.rule.split(" in ")[0].split()[0] if example.rule else "" for example in EXAMPLES]
    assert rules.count("") >= 5
    assert rules.count("in") >= 5
    assert rules.count("refused") >= 6
    assert len(EXAMPLES) == PAGE.count("```yaml")
    assert all(example.message for example in REFUSED)


@pytest.mark.parametrize("example", ACCEPTED, ids=str)
def test_an_example_compiles_and_passes_the_audit(example: Example, tmp_path: Path) -> None:
    if example.rule == "matrices" and "expm" not in WORDS:
        pytest.skip("matrices are not in the language yet")
    file = tmp_path / "example.yaml"
    file.write_text(complete(example))
    assert compile_manifold(file).report.passed


@pytest.mark.parametrize("example", REFUSED, ids=str)
def test_an_example_of_a_mistake_is_refused_as_the_page_says(example: Example, tmp_path: Path) -> None:
    file = tmp_path / "example.yaml"
    file.write_text(complete(example))
    with pytest.raises(UserError, match=re.escape(str(example.message))):
        compile_manifold(file)


# The tables.


@cache
def rows() -> dict[str, tuple[str, str]]:
    """signature -> (meaning, example)."""
    return {m["signature"]: (m["meaning"], m["example"]) for m in ROW.finditer(PAGE)}


def test_every_word_is_on_the_page_as_it_is_written() -> None:
    documented = set(rows())
    for name, word in WORDS.items():
        assert set(word.signature.split(" or ")) <= documented, name
    for constant in CONSTANTS:
        assert f"`{constant}`" in PAGE


@pytest.mark.parametrize("signature", rows())
def test_every_word_on_the_page_is_one_and_its_example_holds(signature: str) -> None:
    name = signature.split("(")[0]
    assert name in WORDS
    example = rows()[signature][1]
    assert f"{name}(" in example
    tree = f.parse(example, Span(Source("page", example), 1, 1, len(example)))
    assert isinstance(tree, f.Compare)
    shape_of(tree, {}, {})
    reading = Reading(read_spec(MANIFOLDS / "euclidean.yaml"), trace := Trace([argument("p", 3)]))
    left, right = (reading.value(side) for side in (tree.left, tree.right))
    with mp.workdps(30):
        assert abs(value(trace.unfolded(left - right, tree.span), {})) < 1e-20


def test_every_key_is_on_the_page() -> None:
    keys = {key for d in json_schema()["$defs"].values() for key in d.get("properties", {})}
    assert {"manifold", "weight", "policy", "period"} <= keys
    for key in keys - {"value"}:
        assert f"`{key}:`" in PAGE, key
    assert re.search(r"(?m)^  value: ", PAGE)


def test_the_keys_in_the_first_table_are_all_of_a_file() -> None:
    table = PAGE[PAGE.index("## The keys") : PAGE.index("## Formulas")]
    listed = re.findall(r"(?m)^\| `(\w+):` \|", table)
    definitions = json_schema()["$defs"]
    assert set(listed) == {*definitions["ManifoldFile"]["properties"], *definitions["ProductFile"]["properties"]}


def test_the_reserved_names_are_on_the_page() -> None:
    for name in formulas.RESERVED - set(WORDS):
        assert f"`{name}`" in PAGE, name


def test_the_limits_are_those_of_the_code() -> None:
    limits = PAGE[PAGE.index("## Limits") :]
    told = [int(number) for number in re.findall(r"\d+", limits)]
    assert told == [
        f.MAX_CHARACTERS, f.MAX_DEPTH, f.MAX_TERMS, 1, read.MAX_DIM, product.MAX_DIM, product.MAX_FACTORS,
    ]  # fmt: skip
    assert "four levels" in limits
    assert product.MAX_DEPTH == 4


def test_the_operators_bind_as_the_page_says() -> None:
    for text, meaning in {"2^-1": "1/2", "-2^2": "0 - 4", "2^3^2": "512", "-2 * 3": "0 - 6", "2 * -3": "0 - 6"}.items():
        assert exactly(text) == exactly(meaning), text


def exactly(text: str) -> object:
    from rsrm_gen.compiler.spec.shapes import constant

    return constant(f.parse(text, Span(Source("page", text), 1, 1, len(text))), {})


def test_parse_document_takes_the_first_line_that_editors_read() -> None:
    line = re.search(r"(?m)^    (# yaml-language-server: .*)$", PAGE)
    assert line is not None
    text = (MANIFOLDS / "torus.yaml").read_text()
    assert read_spec(parse_document(f"{line[1]}\n{text}")).name == "torus"
