"""Scene files: what they mean, and what a mistake in one says."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
import torch
from plain_manifolds import PLAIN, FlatTorus, Hyperboloid, Sphere

from rsrm_gen.errors import UserError
from rsrm_gen.manifold import Manifold
from rsrm_gen.trainer.scene import Scene, read_scene

EXAMPLES = Path(__file__).parent.parent / "examples"

TORUS = """\
scene: a test
manifold: flat
goal: [0.5, -1]
obstacles:
  - {center: [1, 1], radius: 0.5}
  - {center: [-2, 0], radius: 0.25}
slowness: {free: 2, obstacle: 8, width: 0.1}
training: {dtype: float64, steps: 20}
"""

HYPERBOLIC = """\
scene: a disc
manifold: curved
goal: [1, 0, 0]
domain: {center: [1, 0, 0], radius: 2.5}
"""


def read(folder: Path, text: str, manifold: Manifold) -> Scene:
    path = folder / "scene.yaml"
    path.write_text(text)
    return read_scene(path, manifold)


def test_slowness_is_that_of_the_nearest_obstacle(tmp_path: Path) -> None:
    scene = read(tmp_path, TORUS, FlatTorus(2))
    x = torch.tensor([[1.0, 1.7], [-2.0, 0.25], [0.5, -1.0]], dtype=torch.float64)
    assert torch.allclose(scene.signed_distance(x)[:2], torch.tensor([0.2, 0.0], dtype=torch.float64))
    expected = [2 + 6 / (1 + math.exp(2.0)), 5.0]
    assert scene.slowness(x)[:2].tolist() == pytest.approx(expected, abs=1e-12)
    assert scene.slowness(x)[2] == pytest.approx(2.0, abs=1e-4)


def test_obstacles_reach_around_the_torus(tmp_path: Path) -> None:
    scene = read(tmp_path, TORUS.replace("[-2, 0]", "[-3.1, 0]"), FlatTorus(2))
    x = torch.tensor([[3.1, 0.0]], dtype=torch.float64)
    assert scene.signed_distance(x)[0] == pytest.approx(2 * math.pi - 6.2 - 0.25, abs=1e-12)


def test_a_scene_without_obstacles_is_free_everywhere(tmp_path: Path) -> None:
    scene = read(tmp_path, HYPERBOLIC, Hyperboloid(2))
    x = scene.sample(100, torch.Generator().manual_seed(0))
    assert (scene.slowness(x) == 1).all()


def test_a_ball_domain_is_sampled_uniformly_in_volume(tmp_path: Path) -> None:
    scene = read(tmp_path, HYPERBOLIC, Hyperboloid(2))
    x = scene.sample(20_000, torch.Generator().manual_seed(0))
    assert x.dtype == torch.float32
    assert scene.inside_domain(x).float().mean() > 0.999  # but for rounding at the rim
    inner = (scene.manifold.distance(x, scene.goal) < 1.5).float().mean()
    area = (math.cosh(1.5) - 1) / (math.cosh(2.5) - 1)
    assert inner == pytest.approx(area, abs=4 * math.sqrt(area / 20_000))


def test_points_outside_the_domain_come_back_to_its_rim(tmp_path: Path) -> None:
    scene = read(tmp_path, HYPERBOLIC + "training: {dtype: float64}\n", Hyperboloid(2))
    far = scene.manifold.project(torch.tensor([[0.0, 30.0, 40.0], [0.0, 0.3, 0.1]], dtype=torch.float64))
    back = scene.into_domain(far)
    assert scene.manifold.distance(back[0], scene.goal) == pytest.approx(2.5, abs=1e-12)
    assert back[0, 1] / back[0, 2] == pytest.approx(0.75)
    assert torch.equal(back[1], far[1])


def test_an_angle_may_be_written_with_full_turns(tmp_path: Path) -> None:
    scene = read(tmp_path, TORUS.replace("goal: [0.5, -1]", f"goal: [{0.5 + 2 * math.pi}, -1]"), FlatTorus(2))
    assert scene.goal.tolist() == pytest.approx([0.5, -1], abs=1e-12)


MISTAKES = {
    "two numbers for three": ("goal: [0, 0, 1]", "goal: [0, 1]", "scene.yaml:3:7", "has 2 numbers"),
    "off the sphere": ("goal: [0, 0, 1]", "goal: [0, 0, 2]", "scene.yaml:3:7", "[0, 0, 1]"),
    "nowhere": ("goal: [0, 0, 1]", "goal: [0, 0, 0]", "scene.yaml:3:7", "stands for no point"),
    "off-sphere center": ("[0, 1, 0]", "[0, 1, 0.1]", "scene.yaml:5:14", "`obstacles.0.center` is not on"),
    "radius 0": ("radius: 0.5", "radius: 0", "scene.yaml:5:33", "greater than 0"),
    "radius nan": ("radius: 0.5", "radius: .nan", "scene.yaml:5:33", "radius"),
    "radius is text": ("radius: 0.5", "radius: big", "scene.yaml:5:33", "valid number"),
    "radius is true": ("radius: 0.5", "radius: true", "scene.yaml:5:33", "not true or false"),
    "unknown key": ("goal:", "gaol: 1\ngoal:", "scene.yaml:3:1", "did you mean `goal`?"),
    "no goal": ("goal: [0, 0, 1]", "", "scene.yaml", "`goal` is missing"),
    "manifold is a number": ("manifold: round", "manifold: 3", "scene.yaml:2:11", "`manifold`"),
    "unknown residual": (
        "steps: 9",
        "objective: {kind: eikonal, residual: cubed}",
        "scene.yaml:6:49",
        "`ratio` or `squared`",
    ),
    "unknown objective": ("steps: 9", "objective: magic", "scene.yaml:6:23", "write `paths`, `bellman` or `eikonal`"),
    "residual of paths": ("steps: 9", "objective: {kind: paths, residual: ratio}", "scene.yaml:6:37", "unknown key"),
    "another's setting": ("steps: 9", "learning_rate: 0.1", "scene.yaml:6:12", "it belongs to `eikonal`"),
    "unknown setting": ("steps: 9", "stepz: 9", "scene.yaml:6:12", "did you mean `steps`?"),
    "nested unknown": ("steps: 9", "splats: {cuont: 9}", "scene.yaml:6:21", "did you mean `count`?"),
    "zero steps": ("steps: 9", "steps: 0", "scene.yaml:6:19", "greater than or equal to 1"),
    "half a step": ("steps: 9", "steps: 1.5", "scene.yaml:6:19", "integer"),
    "floor of 1": ("steps: 9", "link: {kind: quotient, floor: 1}", "scene.yaml:6:42", "less than 1"),
    "floor without quotient": ("steps: 9", "link: {floor: 0.2}", "scene.yaml:6:18", "kind: quotient"),
    "small capacity": (
        "steps: 9",
        "objective: eikonal, splats: {initial: 9, capacity: 3}",
        "scene.yaml:6:40",
        "capacity of 3",
    ),
    "thin shape": ("steps: 9", "objective: eikonal, splats: {shape: 0.01}", "scene.yaml:6:40", "min_singular"),
    "widths in no order": (
        "steps: 9",
        "splats: {min_width: 0.02, max_width: 0.01}",
        "scene.yaml:6:20",
        "less than min_width",
    ),
    "too wide a domain": (
        "training",
        "domain: {center: [0, 0, 1], radius: 4}\ntraining",
        "scene.yaml:6:37",
        "injectivity",
    ),
    "goal outside": (
        "training",
        "domain: {center: [1, 0, 0], radius: 1}\ntraining",
        "scene.yaml:3:7",
        "outside the domain",
    ),
}

SPHERE = """\
scene: a test
manifold: round
goal: [0, 0, 1]
obstacles:
  - {center: [0, 1, 0], radius: 0.5}
training: {steps: 9}
"""


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_is_shown_where_it_is(tmp_path: Path, mistake: str) -> None:
    old, new, place, message = MISTAKES[mistake]
    assert old in SPHERE
    with pytest.raises(UserError) as caught:
        read(tmp_path, SPHERE.replace(old, new, 1), Sphere(2))
    assert f"{place}" in str(caught.value)
    assert message in str(caught.value)


def test_a_manifold_that_is_not_compact_needs_a_domain(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="not compact") as caught:
        read(tmp_path, HYPERBOLIC.replace("domain: ", "# "), Hyperboloid(2))
    assert "scene.yaml:2:11" in str(caught.value)


def test_a_scene_file_that_is_not_there_is_named_with_its_neighbours(tmp_path: Path) -> None:
    (tmp_path / "first.yaml").write_text(SPHERE)
    with pytest.raises(UserError, match=r"did you mean `first.yaml`"):
        read_scene(tmp_path / "frist.yaml")


def test_an_unknown_manifold_is_an_error_in_the_scene_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def load(name: object, kernels: str | None = None, **parameters: object) -> Manifold:
        raise UserError(f"no manifold is called {name}")

    monkeypatch.setattr("rsrm_gen.trainer.scene.load", load)
    (tmp_path / "scene.yaml").write_text(SPHERE)
    with pytest.raises(UserError, match="no manifold is called round") as caught:
        read_scene(tmp_path / "scene.yaml")
    assert "scene.yaml:2:11" in str(caught.value)


def test_the_manifolds_file_is_found_beside_the_scene(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[tuple[object, dict[str, object]]] = []

    def load(name: object, kernels: str | None = None, **parameters: object) -> Manifold:
        asked.append((name, parameters))
        return Sphere(2)

    monkeypatch.setattr("rsrm_gen.trainer.scene.load", load)
    text = SPHERE.replace("manifold: round", "manifold: {spec: mine.yaml, parameters: {n: 2}}")
    (tmp_path / "scene.yaml").write_text(text)
    read_scene(tmp_path / "scene.yaml")
    assert asked == [(tmp_path / "mine.yaml", {"n": 2})]


PAPER = {"torus": PLAIN["T2"], "sphere": PLAIN["S2"], "hyperbolic": PLAIN["H2"]}


@pytest.mark.parametrize("name", PAPER)
@pytest.mark.parametrize("seed", range(1, 6))
def test_the_papers_scenes_lie_on_their_manifolds_and_leave_the_goal_free(name: str, seed: int) -> None:
    scene = read_scene(EXAMPLES / "paper" / f"{name}-{seed}.yaml", PAPER[name])
    assert scene.manifold_choice.spec == name
    assert len(scene.radii) == 3
    assert scene.signed_distance(scene.goal) > 0
    assert scene.inside_domain(scene.centers).all()
    assert (scene.law.free, scene.law.obstacle, scene.law.width) == (1, 10, 0.15)


def test_the_demonstration_is_a_scene_that_can_be_trained() -> None:
    scene = read_scene(EXAMPLES / "torus.yaml", PLAIN["T2"])
    assert scene.signed_distance(scene.goal) > 0
    assert 0 < scene.training.capacity < 2000
