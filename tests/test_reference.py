"""The reference must be the arrival time where that is known in closed form, know its own error, and keep its work."""

from __future__ import annotations

import ast
import io
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest
import torch
from plain_manifolds import PLAIN, Euclidean, FlatTorus
from rich.console import Console
from scenes import seeded
from torch import Tensor
from torch.nn.functional import softplus

from rsrm_gen.errors import UserError
from rsrm_gen.trainer import reference as module
from rsrm_gen.trainer.reference import solve_reference
from rsrm_gen.trainer.scene import Scene, read_scene

TRAINER = Path(module.__file__).parent


@dataclass(frozen=True)
class Case:
    """A manifold with a goal, another point, the domain, and the grid that resolves it."""

    goal: list[float]
    elsewhere: list[float]
    domain: str
    cells: int


# The ball's centre is not its goal, so that nothing is exact by symmetry.
CASES = {
    "R2": Case([0.3, -0.4], [1.5, 1.0], "domain: {center: [0, 0], radius: 3}", 384),
    "T2": Case([-1.5, -1.5], [1.0, 2.0], "", 384),
    "S2": Case([0.0, 0.6, 0.8], [0.8, 0.0, -0.6], "", 768),
    "H2": Case([1.25, 0.75, 0.0], [1.25, 0.0, 0.75], "domain: {center: [1, 0, 0], radius: 2.5}", 512),
    "SO3": Case([0.8, 0.0, 0.6, 0.0], [0.8, 0.6, 0.0, 0.0], "", 96),
}


@pytest.fixture(autouse=True)
def _own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("RSRM_GEN_CACHE", str(tmp_path / "cache"))


def scene(folder: Path, name: str, obstacle: list[float], radius: float, slowness: str) -> Scene:
    path = folder / "scene.yaml"
    lines = [
        "scene: exact",
        f"manifold: {name}",
        f"goal: {CASES[name].goal}",
        f"obstacles: [{{center: {obstacle}, radius: {radius}}}]",
        f"slowness: {slowness}",
        CASES[name].domain,
        "training: {dtype: float64}",
    ]
    path.write_text("\n".join(lines) + "\n")
    return read_scene(path, PLAIN[name])


def uniform(folder: Path, name: str) -> Scene:
    """s = 1, with an obstacle that costs nothing: T is the distance."""
    return scene(folder, name, CASES[name].elsewhere, 0.5, "{free: 1, obstacle: 1}")


def radial(folder: Path, name: str) -> Scene:
    """One soft obstacle around the goal: s depends on the distance to the goal only."""
    return scene(folder, name, CASES[name].goal, 0.8, "{free: 1, obstacle: 3, width: 0.4}")


def radial_time(distance: Tensor) -> Tensor:
    """The integral of 1 + 2 sigmoid((0.8 - r) / 0.4): every path crosses every distance on its way out."""
    return distance + 2 * 0.4 * (softplus(torch.tensor(0.8 / 0.4)) - softplus((0.8 - distance) / 0.4))


@pytest.mark.parametrize("name", CASES)
def test_arrival_time_is_the_distance_where_nothing_is_slow(tmp_path: Path, name: str) -> None:
    made = uniform(tmp_path, name)
    x = made.sample(2000, seeded())
    reference = solve_reference(made, CASES[name].cells)
    difference = reference.time(x) - made.manifold.distance(x, made.goal)
    assert difference.square().mean().sqrt() < (1e-3 if made.manifold.dim == 2 else 5e-3)
    assert difference.abs().max() < (1e-2 if made.manifold.dim == 2 else 5e-2)


@pytest.mark.parametrize("name", CASES)
def test_arrival_time_of_a_radial_slowness_is_its_integral(tmp_path: Path, name: str) -> None:
    made = radial(tmp_path, name)
    x = made.sample(2000, seeded())
    exact = radial_time(made.manifold.distance(x, made.goal))
    rms = (solve_reference(made, CASES[name].cells).time(x) - exact).square().mean().sqrt()
    assert rms < (1e-3 if made.manifold.dim == 2 else 3e-2)


@pytest.mark.parametrize("name", ["T2", "S2", "H2"])
def test_error_falls_with_resolution_and_is_as_small_as_the_reference_says(tmp_path: Path, name: str) -> None:
    made = radial(tmp_path, name)
    x = made.sample(2000, seeded())
    x = x[made.signed_distance(x) >= 0]
    exact = radial_time(made.manifold.distance(x, made.goal))
    rms, said = [], []
    for cells in (96, 192, 384):
        reference = solve_reference(made, cells)
        rms.append(float((reference.time(x) - exact).square().mean().sqrt()))
        said.append(reference.error)
    assert rms[0] > 2 * rms[1] > 4 * rms[2]
    assert rms[1] < 1.5 * said[1]
    assert rms[2] < 1.5 * said[2]


def test_the_wall_is_gone_around_not_through(tmp_path: Path) -> None:
    """Behind a hard obstacle in the plane the path bends around a circle: two tangents and an arc."""
    made = scene(tmp_path, "R2", [1.5, 0.0], 0.8, "{free: 1, obstacle: 100, width: 0.004}")
    made = replace(made, goal=torch.zeros(2, dtype=torch.float64))
    behind = torch.tensor([[2.8, 0.0]], dtype=torch.float64)
    a, b, r = 1.5, 1.3, 0.8
    arc = torch.pi - np.arccos(r / a) - np.arccos(r / b)
    taut = np.sqrt(a**2 - r**2) + np.sqrt(b**2 - r**2) + r * arc
    time = float(solve_reference(made, 1024).time(behind)[0])
    # The soft edge of the wall costs a little on both sides of it.
    assert taut < time < taut + 0.06


def test_time_is_finite_all_over_a_closed_manifold(tmp_path: Path) -> None:
    made = uniform(tmp_path, "S2")
    deep = torch.stack([made.goal, -made.goal, made.centers[0], -made.centers[0]])
    time = solve_reference(made, 512).time(deep)
    torch.testing.assert_close(time, made.manifold.distance(deep, made.goal), rtol=0, atol=5e-3)


def test_arrival_time_is_exact_inside_the_obstacle_that_hides_infinity(tmp_path: Path) -> None:
    made = scene(tmp_path, "S2", [0.0, -0.6, -0.8], 0.7, "{free: 1, obstacle: 10, width: 0.15}")
    reference = solve_reference(made, 768)
    assert "inside an obstacle" in reference.note
    x = made.manifold.sample_ball(made.centers[0], 0.7, 300, seeded())
    depth = torch.pi - 0.7 - made.manifold.distance(x, made.goal)
    exact = made.manifold.distance(x, made.goal) + 9 * 0.15 * softplus(-depth / 0.15)
    assert (reference.time(x) - exact).square().mean().sqrt() < 2e-3


def test_two_charts_of_one_scene_agree(tmp_path: Path) -> None:
    """Of obstacles of one size the first hides infinity: in another order the same scene is solved elsewhere."""
    made = scene(tmp_path, "S2", CASES["S2"].elsewhere, 0.6, "{free: 1, obstacle: 10, width: 0.15}")
    centers = torch.tensor([[0.8, 0.0, -0.6], [-0.8, -0.6, 0.0]], dtype=torch.float64)
    there, back = (
        replace(made, centers=each, radii=torch.full((2,), 0.6, dtype=torch.float64))
        for each in (centers, centers.flip(0))
    )
    a, b = solve_reference(there, 1024), solve_reference(back, 1024)
    assert there.manifold.distance(a.place.chart.center, b.place.chart.center) > 1
    x = there.sample(2000, seeded())
    x = x[there.signed_distance(x) >= 0]
    assert (a.time(x) - b.time(x)).square().mean().sqrt() < 2e-3


def test_time_is_nan_outside_of_what_was_solved(tmp_path: Path) -> None:
    reference = solve_reference(uniform(tmp_path, "R2"), 64)
    assert reference.time(torch.tensor([[40.0, 0.0]])).isnan().all()


def test_a_solution_is_taken_from_the_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    made = radial(tmp_path, "T2")
    x = made.sample(100, seeded())
    first = solve_reference(made, 64)
    monkeypatch.setattr(module, "_march", lambda *_: pytest.fail("solved again"))
    second = solve_reference(made, 64)
    assert torch.equal(first.time(x), second.time(x))
    assert (first.error, first.max_error) == (second.error, second.max_error)


def test_solving_says_what_takes_the_time_and_the_cache_says_nothing(tmp_path: Path) -> None:
    made = radial(tmp_path, "T2")
    for expected in (True, False):
        console = Console(file=io.StringIO(), force_terminal=True, width=300)
        solve_reference(made, 64, console)
        assert ("reference solution on 65 x 65 nodes" in console.file.getvalue()) is expected


def test_another_scene_or_grid_is_another_solution(tmp_path: Path) -> None:
    made = radial(tmp_path, "T2")
    others = [
        replace(made, radii=made.radii + 0.1),
        replace(made, goal=made.goal + 0.1),
        replace(made, law=made.law.model_copy(update={"width": 0.5})),
        uniform(tmp_path, "R2"),
    ]
    for each in [made, *others]:
        solve_reference(each, 64)
    solve_reference(made, 68)
    assert len(list((tmp_path / "cache").iterdir())) == len(others) + 2


def test_a_damaged_file_in_the_cache_is_solved_again(tmp_path: Path) -> None:
    made = radial(tmp_path, "T2")
    x = made.sample(100, seeded())
    good = solve_reference(made, 64).time(x)
    (file,) = (tmp_path / "cache").iterdir()
    file.write_bytes(file.read_bytes()[:1000])
    assert torch.equal(solve_reference(made, 64).time(x), good)


def test_a_single_precision_scene_is_solved_for_the_same_points(tmp_path: Path) -> None:
    made = radial(tmp_path, "S2")
    single = replace(made, goal=made.goal.float(), centers=made.centers.float(), radii=made.radii.float())
    x = made.sample(100, seeded())
    a, b = solve_reference(made, 128), solve_reference(single, 128)
    torch.testing.assert_close(a.time(x), b.time(x.float()), rtol=0, atol=1e-5)


class Squeezed(FlatTorus):
    """A flat chart whose metric changes from place to place, and whose exp does not know."""

    def flat(self, p: Tensor, v: Tensor) -> Tensor:
        return v * (1 + 0.1 * torch.sin(p))

    def frame(self, p: Tensor) -> Tensor:
        return torch.diag_embed((1 + 0.1 * torch.sin(p)).rsqrt())


def test_a_manifold_without_a_conformal_chart_is_refused(tmp_path: Path) -> None:
    made = replace(uniform(tmp_path, "T2"), manifold=Squeezed(2))
    with pytest.raises(UserError, match="not conformally flat"):
        solve_reference(made, 64)


def test_dimensions_that_no_grid_can_hold_are_refused(tmp_path: Path) -> None:
    manifold = Euclidean(5)
    with pytest.raises(UserError, match="2 and 3 dimensions"):
        solve_reference(replace(uniform(tmp_path, "R2"), manifold=manifold), 64)


def imports(file: Path) -> set[str]:
    found = set()
    for node in ast.walk(ast.parse(file.read_text())):
        if isinstance(node, ast.ImportFrom):
            found |= {node.module or "", *(f"{node.module}.{alias.name}" for alias in node.names)}
        elif isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
    return {name.removeprefix("rsrm_gen.trainer.") for name in found if name.startswith("rsrm_gen.trainer.")}


def test_training_cannot_reach_the_reference() -> None:
    reached, waiting = set(), {"train", "plan", "run"}
    while waiting:
        name = waiting.pop()
        reached.add(name)
        if (TRAINER / f"{name}.py").exists():
            waiting |= imports(TRAINER / f"{name}.py") - reached
    assert "model" in reached
    assert "reference" not in reached
