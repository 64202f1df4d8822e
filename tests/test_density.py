"""Which splats go, which come, and that the optimiser's moments go with them."""

from __future__ import annotations

from pathlib import Path

import pytest
import torch
from plain_manifolds import PLAIN, Euclidean, FlatTorus
from scenes import random_field, seeded, small_scene
from torch import Tensor

from rsrm_gen.trainer.density import Change, Fixed, PruneAndAdd, make_density, pick_apart, pick_spread
from rsrm_gen.trainer.model import SplatField
from rsrm_gen.trainer.optimise import AdamW
from rsrm_gen.trainer.settings import EikonalTraining

PAPER = PruneAndAdd(every=10, add=2, prune_below=0.1, shape=0.4, last=90)


def six_splats() -> SplatField:
    field = random_field(Euclidean(2), torch.arange(12.0).reshape(6, 2), seeded())
    with torch.no_grad():
        field.v[:6] = torch.tensor([0.5, 0.05, -0.5, -0.05, 0.1, 0.7])
    return field


def propose(count: int) -> Tensor:
    return -torch.arange(1.0, 2 * count + 1).reshape(count, 2)


def test_light_splats_go_and_new_ones_come_after_those_kept() -> None:
    field = six_splats()
    change = PAPER.update(20, field, propose)
    assert change is not None
    assert change.kept.tolist() == [0, 2, 4, 5]
    assert change.added == 2
    assert field.mu[: field.count].tolist() == [[0, 1], [4, 5], [8, 9], [10, 11], [-1, -2], [-3, -4]]


@pytest.mark.parametrize("step", [5, 19, 91, 100])
def test_nothing_changes_between_times_nor_in_the_last_tenth(step: int) -> None:
    field = six_splats()
    assert PAPER.update(step, field, propose) is None
    assert field.count == 6


def test_there_are_never_more_splats_than_the_capacity() -> None:
    field = six_splats()  # room for eight
    change = PruneAndAdd(every=1, add=5, prune_below=0.0, shape=0.4, last=9).update(1, field, propose)
    assert change is not None
    assert change.added == 2
    assert field.count == 8
    full = PruneAndAdd(every=1, add=5, prune_below=0.0, shape=0.4, last=9).update(2, field, propose)
    assert full is not None
    assert full.added == 0


def test_one_splat_stays_when_all_are_light() -> None:
    field = six_splats()
    change = PruneAndAdd(every=1, add=0, prune_below=9.0, shape=0.4, last=9).update(1, field, propose)
    assert change is not None
    assert change.kept.tolist() == [5]


def test_settings_without_change_give_the_fixed_strategy() -> None:
    fixed = make_density(EikonalTraining.model_validate({"splats": {"add": 0, "prune_below": 0}}))
    assert fixed == Fixed()
    field = six_splats()
    assert fixed.update(400, field, propose) is None
    assert field.count == 6


def test_the_papers_recipe_has_room_for_all_it_can_add() -> None:
    training = EikonalTraining()
    assert training.last_change == 3600
    assert training.capacity == 128 + 9 * 48


def test_new_centres_have_the_largest_residuals_and_keep_apart() -> None:
    M = FlatTorus(2)
    points = torch.tensor([[3.1, 0.0], [-3.1, 0.0], [1.0, 0.0], [1.05, 0.0], [0.0, 0.0]])
    chosen = pick_apart(M, points, torch.tensor([5.0, 4.0, 2.0, 3.0, 1.0]), 3, 0.2)
    assert torch.equal(chosen, points[[0, 3, 4]])  # 3.1 and -3.1 are neighbours


@pytest.mark.parametrize("name", PLAIN)
def test_first_splats_spread_better_than_chance(tmp_path: Path, name: str) -> None:
    scene = small_scene(tmp_path, name)
    points = scene.sample(160, seeded())
    chosen = pick_spread(scene.manifold, points, 20)

    def closest(x: Tensor) -> float:
        far = 9.0 * torch.eye(len(x), dtype=x.dtype)
        return float((scene.manifold.distance(x[:, None], x[None]) + far).min())

    assert len(chosen) == 20
    assert closest(chosen) > 1.5 * closest(points[:20])


def test_moments_and_ages_go_with_their_splats() -> None:
    field = six_splats()
    adam = AdamW(field, 0.0, 1.0)
    for rows in adam.buffers_of_splats().values():
        numbers = torch.arange(1, len(rows) + 1, dtype=rows.dtype)
        rows.copy_(numbers.view(-1, *[1] * (rows.dim() - 1)).expand_as(rows))
    adam.follow(Change(torch.tensor([0, 2, 5]), 2))
    for rows in adam.buffers_of_splats().values():
        assert rows[:5].reshape(5, -1)[:, 0].tolist() == [1, 3, 6, 0, 0]
