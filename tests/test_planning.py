"""How planning with a field is judged: perfect fields are found perfect, and valleys are found."""

from __future__ import annotations

from pathlib import Path

import pytest
import torch
from plain_manifolds import PLAIN
from scenes import CENTER, ORIGIN, seeded, small_scene
from torch import Tensor

from rsrm_gen.trainer.link import Exponential
from rsrm_gen.trainer.model import ArrivalTime, SplatField
from rsrm_gen.trainer.planning import planning, starts
from rsrm_gen.trainer.scene import Scene

FREE = "{dtype: float64}"


def arrival_of(scene: Scene, weight: float = 0.0) -> ArrivalTime:
    """T = d exp(f), f one splat of this weight in the middle of the obstacle."""
    field = SplatField(scene.manifold, 1, torch.float64)
    center = torch.tensor([CENTER["R2"]] if scene.manifold.point_size == 2 else [ORIGIN["S2"]], dtype=torch.float64)
    field.append(center, 0.3)
    field.v[0] = weight
    return ArrivalTime(field, Exponential(), scene.manifold, scene.goal)


@pytest.mark.parametrize("name", PLAIN)
def test_the_distance_plans_perfectly_where_nothing_is_in_the_way(tmp_path: Path, name: str) -> None:
    scene = small_scene(tmp_path, name, FREE, obstacles=False)
    field = SplatField(scene.manifold, 1, torch.float64)
    arrival = ArrivalTime(field, Exponential(), scene.manifold, scene.goal)

    def distance(x: Tensor) -> Tensor:
        return scene.manifold.distance(x, scene.goal)

    found = planning(arrival, scene, distance)
    assert found.valleys == 0
    assert [row.kind for row in found.rows] == ["all", "open"]
    for row in found.rows:
        assert (row.reached, row.entered) == (1.0, 0.0)
        assert row.mean is not None
        assert row.worst is not None
        assert 1 - 1e-9 <= row.mean <= row.worst < 1 + 1e-3


def test_a_valley_is_found_and_those_who_end_there_have_not_arrived(tmp_path: Path) -> None:
    scene = small_scene(tmp_path, "R2", FREE)
    found = planning(arrival_of(scene, -1.5), scene, lambda x: scene.manifold.distance(x, scene.goal))
    everyone = found.rows[0]
    assert found.valleys == 1
    assert 0.2 < everyone.reached < 1


def test_starts_are_free_and_of_the_kind_that_is_said(tmp_path: Path) -> None:
    scene = small_scene(tmp_path, "R2", FREE)
    x, kinds = starts(scene, seeded())
    assert set(kinds) == {"open", "near", "shadow"}
    depth = scene.signed_distance(x)
    assert bool((depth >= 0).all())
    near = torch.tensor([kind == "near" for kind in kinds])
    assert float(depth[near].max()) < 0.3 < float(depth.max())
    behind = torch.tensor([[2.0, 0.6]], dtype=torch.float64)  # the goal is the origin, the obstacle at (1, 0.3)
    assert not bool(
        torch.tensor([kind == "shadow" for kind in kinds])[(x - behind).norm(dim=1) < 0.1].logical_not().any()
    )
