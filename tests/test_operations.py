"""docs/operations.md is what the compiler gives today: a change that costs operations is seen as one."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import pytest
from compiled import MANIFOLDS, NAMES, program

from rsrm_gen.compiler.operations import main, operations, page, read_page

PAGE = Path(__file__).parent.parent / "docs" / "operations.md"
COMMITTED = read_page(PAGE.read_text(encoding="utf-8"))


def difference(name: str, committed: Mapping[str, int], today: Mapping[str, int]) -> str:
    """What a person sees: every function whose count changed, and what to do if that was meant."""
    changed = [
        f"  {function}: {committed.get(function, 'none')} -> {today.get(function, 'none')}"
        for function in dict.fromkeys([*committed, *today])
        if committed.get(function) != today.get(function)
    ]
    lines = [f"the operations of `{name}` changed; `make update` writes docs/operations.md, if they should:", *changed]
    return "\n".join(lines) if changed else ""


@pytest.mark.parametrize("name", NAMES)
def test_operations_are_those_of_the_table(name: str) -> None:
    if changed := difference(name, COMMITTED.get(name, {}), operations(program(name))):
        pytest.fail(changed, pytrace=False)


def test_the_table_has_every_manifold_and_nothing_else() -> None:
    assert sorted(COMMITTED) == NAMES


def test_the_page_is_as_it_is_written() -> None:
    assert PAGE.read_text(encoding="utf-8") == page(COMMITTED)


def test_a_page_is_read_back_with_functions_that_only_some_have() -> None:
    counts = {"a": {"exp": 1, "log": 22}, "b": {"exp": 3, "transport": 4}}
    assert "| a | 1 | 22 | - |\n| b | 3 | - | 4 |\n" in page(counts)
    assert read_page(page(counts)) == counts


def test_a_difference_names_the_functions_and_the_command() -> None:
    shown = difference("sphere", {"exp": 20, "log": 30, "old": 1}, {"exp": 20, "log": 31, "new": 2})
    assert shown.splitlines()[1:] == ["  log: 30 -> 31", "  old: 1 -> none", "  new: none -> 2"]
    assert "make update" in shown
    assert difference("sphere", {"exp": 20}, {"exp": 20}) == ""


def test_the_counts_are_of_what_is_computed() -> None:
    counts = operations(program("euclidean"))
    assert counts["exp"] == 3  # three sums
    assert counts["inner"] == 5  # three products, two sums
    assert counts["flat"] == 0


def test_the_command_writes_the_page(tmp_path: Path) -> None:
    main([str(tmp_path / "page.md"), str(MANIFOLDS / "torus.yaml")])
    assert (tmp_path / "page.md").read_text() == page({"torus": operations(program("torus"))})


def test_a_wrong_file_is_a_message_and_leaves_the_page_alone(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "page.md").write_text("as it was")
    with pytest.raises(SystemExit) as refused:
        main([str(tmp_path / "page.md"), str(MANIFOLDS / "none.yaml")])
    assert refused.value.code == 2
    assert "there is no file" in capsys.readouterr().err
    assert (tmp_path / "page.md").read_text() == "as it was"
