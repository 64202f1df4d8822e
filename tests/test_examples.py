"""The scenes that come with the project: each is one that can be trained, and what is said of it is so."""

from __future__ import annotations

from pathlib import Path

import pytest
import torch
from torch import Generator, Tensor

from rsrm_gen.manifold import Manifold
from rsrm_gen.trainer.curves import Curves, Terrain
from rsrm_gen.trainer.link import Exponential
from rsrm_gen.trainer.model import ArrivalTime, SplatField
from rsrm_gen.trainer.plan import plan
from rsrm_gen.trainer.planning import KINDS, starts
from rsrm_gen.trainer.scene import Scene, read_scene

EXAMPLES = Path(__file__).parent.parent / "examples"
FILES = sorted(EXAMPLES.glob("*.yaml"))


def example(name: str) -> Scene:
    return read_scene(EXAMPLES / f"{name}.yaml")


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_every_example_is_a_scene_with_something_to_learn(file: Path) -> None:
    scene = read_scene(file)
    assert scene.signed_distance(scene.goal) > 0
    assert scene.inside_domain(scene.centers).all()
    x, kinds = starts(scene, Generator().manual_seed(0))
    assert scene.inside_domain(x).double().mean() > 0.99
    assert min(kinds.count(kind) for kind in KINDS) > len(x) / 100, "starts that are open, near and in the shadow"


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_every_example_says_how_it_is_run(file: Path) -> None:
    assert f"rsrm train examples/{file.name}" in file.read_text(encoding="utf-8")


def precise(name: str, folder: Path) -> Scene:
    """An example whose points are not rounded to float32."""
    copy = folder / "scene.yaml"
    copy.write_text((EXAMPLES / f"{name}.yaml").read_text(encoding="utf-8") + "  dtype: float64\n", encoding="utf-8")
    return read_scene(copy)


def to_disk(x: Tensor) -> Tensor:
    """From the hyperboloid -t^2 + x^2 + y^2 = -1 into the unit disk, from the point (-1, 0, 0): (N, 3) to (N, 2)."""
    return x[:, 1:] / (1 + x[:, :1])


def test_the_scene_in_the_disk_is_the_papers_in_other_coordinates(tmp_path: Path) -> None:
    disk, sheet = (precise(name, tmp_path) for name in ("poincare", "paper/hyperbolic-1"))
    assert torch.allclose(to_disk(sheet.centers), disk.centers, rtol=0, atol=1e-15)
    assert torch.equal(disk.radii, sheet.radii)
    assert disk.law == sheet.law
    x = sheet.sample(2000, Generator().manual_seed(4))
    y = to_disk(x)
    ones, others = x[:1000], x[1000:]
    assert torch.allclose(
        disk.manifold.distance(y[:1000], y[1000:]), sheet.manifold.distance(ones, others), rtol=1e-11, atol=1e-11
    )
    assert torch.allclose(disk.slowness(y), sheet.slowness(x), rtol=1e-9)
    assert torch.equal(disk.inside_domain(y), sheet.inside_domain(x))
    middle = sheet.manifold.exp(ones, sheet.manifold.log(ones, others) / 2)
    halfway = disk.manifold.exp(y[:1000], disk.manifold.log(y[:1000], y[1000:]) / 2)
    assert torch.allclose(to_disk(middle), halfway, atol=1e-10)


def test_what_is_sampled_in_the_domain_of_a_retraction_is_inside_of_it() -> None:
    scene = example("arm").in_double()
    assert scene.manifold.maps == "retraction"
    x = scene.sample(4000, Generator().manual_seed(1))
    assert scene.inside_domain(x).all()
    assert scene.domain is not None
    center, radius = scene.domain.center, scene.domain.radius
    beyond = scene.manifold.exp(center, 1.001 * scene.manifold.log(center.expand_as(x), x))
    far = scene.manifold.norm(center.expand_as(x), scene.manifold.log(center.expand_as(x), x)) > 0.9995 * radius
    assert far.any()
    assert not scene.inside_domain(beyond[far]).any()


def test_a_path_of_a_retraction_is_as_long_as_its_metric_says() -> None:
    scene = example("arm").in_double()
    manifold: Manifold = scene.manifold
    field = SplatField(manifold, 1, torch.float64)
    arrival = ArrivalTime(field, Exponential(), manifold, scene.goal)
    paths = plan(arrival, scene, scene.sample(30, Generator().manual_seed(2)))
    terrain, some = Terrain(scene), paths.reached.nonzero()[:, 0].tolist()
    assert len(some) > 10
    cost, length = terrain.measure(Curves.of([paths.points[i].numpy() for i in some]))
    assert torch.allclose(paths.length[some], torch.from_numpy(length), rtol=4e-4)
    assert torch.allclose(paths.cost[some], torch.from_numpy(cost), rtol=4e-4)
