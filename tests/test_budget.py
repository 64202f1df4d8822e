"""Budgets: what explodes ends, says where, and leaves nothing behind."""

from __future__ import annotations

import itertools
import threading
import time
from pathlib import Path

import pytest
from commands import runner
from compiled import MANIFOLDS, NAMES, bundled_spec, spec_of

from rsrm_gen.compiler import budget
from rsrm_gen.compiler.budget import blamed, limited, seconds_left, spend
from rsrm_gen.compiler.derive import derive
from rsrm_gen.compiler.driver import compile_manifold
from rsrm_gen.compiler.lower import lower
from rsrm_gen.errors import Source, Span, UserError

HERE = Span(Source("file.yaml", "exp: p + v\n"), 1, 6, 5)


def test_nothing_is_limited_outside_a_budget() -> None:
    spend(10**12)
    assert seconds_left() is None


def test_operations_beyond_the_budget_are_refused_at_the_formula_to_blame() -> None:
    with limited("derive", 60, 100), blamed(HERE):
        spend(60)
        with pytest.raises(UserError, match="more than 100 operations to derive") as error:
            spend(60)
    assert error.value.span == HERE


def test_seconds_beyond_the_budget_are_refused_and_tell_of_the_option() -> None:
    with limited("derive", 0.05):
        end = time.thread_time() + 0.1
        while time.thread_time() < end:
            pass
        with pytest.raises(UserError, match=r"more than 0.05 s to derive") as error:
            spend()
    assert "--budget" in str(error.value.hint)


def test_sleeping_costs_nothing() -> None:
    with limited("derive", 0.2):
        time.sleep(0.3)
        spend()


def test_a_budget_ends_with_its_block_and_an_inner_one_with_its_own() -> None:
    with limited("derive", 60, 10):
        with limited("audit", 60, 1000):
            spend(500)
        spend(5)
        with pytest.raises(UserError, match="more than 10 operations"):
            spend(6)
    spend(10**9)


def test_a_budget_that_is_used_up_does_not_reach_the_next_compilation() -> None:
    for _ in range(2):
        with pytest.raises(UserError), limited("derive", 60, 1):
            spend(2)
    with limited("derive", 60, 1):
        spend(1)
    assert seconds_left() is None


def test_blame_goes_back_to_the_outer_formula() -> None:
    other = Span(HERE.source, 1, 1)
    with limited("derive", 60, 10), blamed(other):
        with blamed(HERE):
            pass
        with pytest.raises(UserError) as error:
            spend(11)
    assert error.value.span == other


def test_a_thread_has_no_part_in_the_budget_of_another() -> None:
    left: list[float | None] = []
    with limited("derive", 60, 1):
        thread = threading.Thread(target=lambda: left.append(seconds_left()))
        thread.start()
        thread.join()
    assert left == [None]


@pytest.mark.parametrize("name", NAMES)
def test_bundled_manifolds_take_a_small_part_of_the_budget(name: str) -> None:
    with limited("derive", 60, budget.OPERATIONS // 100):
        geometry = derive(bundled_spec(name))
    with limited("lower", 60, budget.OPERATIONS // 40):
        lower(geometry)


def test_the_command_line_says_what_took_too_long(tmp_path: Path) -> None:
    with pytest.raises(UserError, match=r"more than 0\.01 s to (read|derive)") as error:
        compile_manifold(MANIFOLDS / "hyperbolic.yaml", seconds_allowed=0.01)
    assert "--budget" in str(error.value.hint)


@pytest.mark.parametrize("command", ["explain", "audit"])
def test_other_commands_have_a_budget_too(
    command: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("time.thread_time", itertools.count(step=1000).__next__)
    ran = runner(capsys, monkeypatch)(command, "hyperbolic", "--budget", "600")
    assert ran.code == 2
    assert "more than 600 s to derive" in ran.err


FLAT = """
manifold: m
doc: d
chart: {{space: R^2}}
metric: dot(u, v)
exp: p + v
log:
  let: {{{lets}}}
  value: {value}
injectivity_radius: infinity
"""


def test_lets_that_double_are_no_longer_than_they_are_written() -> None:
    lets = "a0: 'sqrt(1 + p[0]^2)', " + ", ".join(f"a{i + 1}: '(a{i} + 1) / (a{i} + 2)'" for i in range(60))
    with limited("derive", 20, 50_000):
        geometry = derive(spec_of(FLAT.format(lets=lets, value="(q - p) * a60")))
    assert len(lower(geometry)["log"].nodes) < 400


def test_branches_in_branches_are_protected_once_each() -> None:
    lets = "a0: 'abs(p[0])', " + ", ".join(f"a{i + 1}: '(a{i} + 1) * (a{i} + 2)'" for i in range(25))
    value = "(q - p) * where(p[0] < 1, sqrt(1 + a25), 2 + a25)"
    with limited("lower", 20, 100_000):
        lower(derive(spec_of(FLAT.format(lets=lets, value=value))))
