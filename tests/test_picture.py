"""What a picture shows is where it is: pixels, obstacles, paths and the goal, in all three views."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import matplotlib.image
import numpy as np
import pytest
import torch
from plain_manifolds import PLAIN, Rotations
from scenes import seeded, small_scene
from torch import Tensor

from rsrm_gen.errors import UserError
from rsrm_gen.trainer import picture
from rsrm_gen.trainer.picture import Canvas, View, draw_run, draw_scene_field, path_starts
from rsrm_gen.trainer.run import RunFolder
from rsrm_gen.trainer.scene import Scene
from rsrm_gen.trainer.train import train

VIEWS: list[tuple[str, View]] = [("T2", "chart"), ("H2", "disk"), ("R2", "disk"), ("T2", "disk"), ("S2", "surface")]


@pytest.fixture(autouse=True)
def _few_pixels(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(picture, "PIXELS", 81)


def scene_for(folder: Path, name: str, view: View) -> Scene:
    scene = small_scene(folder, name)
    return scene if view == "disk" else replace(scene, domain=None)


def distance_to_goal(scene: Scene) -> picture.TimeFunction:
    return lambda x: scene.manifold.distance(x, scene.goal)


def canvases(scene: Scene, view: View) -> list[Canvas]:
    return picture._canvases(scene, view)


def pixel_centers(canvas: Canvas) -> Tensor:
    return picture._pixels(*canvas.extent)


@pytest.mark.parametrize(("name", "view"), VIEWS)
def test_a_pixel_shows_the_point_that_is_drawn_there(tmp_path: Path, name: str, view: View) -> None:
    for canvas in canvases(scene_for(tmp_path, name, view), view):
        where = pixel_centers(canvas)[2:-2, 2:-2].reshape(-1, 2)
        drawn = canvas.plane(canvas.points[2:-2, 2:-2].reshape(-1, canvas.points.shape[-1]))
        if canvas.outline is not None:
            radius = np.linalg.norm(canvas.outline, axis=1).min()
            inside = where.norm(dim=-1) < 0.98 * radius
            where, drawn = where[inside], drawn[inside]
        assert len(where) > 4000
        assert (where - drawn).norm(dim=-1).max() < 1e-3 * (canvas.extent[1] - canvas.extent[0])


def test_every_point_of_a_surface_is_seen_from_one_of_the_two_sides(tmp_path: Path) -> None:
    scene = scene_for(tmp_path, "S2", "surface")
    x = scene.sample(500, seeded())
    first, second = (canvas.plane(x).isfinite().all(-1) for canvas in canvases(scene, "surface"))
    assert (first ^ second).all()
    assert canvases(scene, "surface")[0].plane(scene.goal[None]).isfinite().all()


@pytest.mark.parametrize(("name", "view"), VIEWS)
def test_the_view_that_fits_is_taken(tmp_path: Path, name: str, view: View) -> None:
    assert picture.default_view(scene_for(tmp_path, name, view)) == view


@pytest.mark.parametrize(("name", "view"), VIEWS)
def test_every_view_is_drawn_without_a_warning(tmp_path: Path, name: str, view: View) -> None:
    scene = scene_for(tmp_path, name, view)
    p = scene.goal.expand(5, -1)
    way = torch.linspace(1, 0, 5, dtype=torch.float64)[:, None]
    path = scene.manifold.exp(p, way * 1.5 * scene.manifold.frame(scene.goal)[0])
    figure = draw_scene_field(scene, distance_to_goal(scene), [path], view)
    picture._save(figure, tmp_path / "field.png")
    image = matplotlib.image.imread(tmp_path / "field.png")[..., :3]
    paths = np.abs(image - np.array(matplotlib.colors.to_rgb(picture.PATH))).max(-1) < 0.02
    assert paths.sum() > 50


def test_an_obstacle_covers_its_share_of_the_chart(tmp_path: Path) -> None:
    scene = scene_for(tmp_path, "T2", "chart")
    (canvas,) = canvases(scene, "chart")
    field = np.zeros((81, 81))
    sdf = scene.signed_distance(canvas.points).numpy()
    covered = (picture._colours(canvas, field, sdf, 1.0) == matplotlib.colors.to_rgb(picture.OBSTACLE)).all(-1)
    assert covered.mean() == pytest.approx(math.pi * 0.4**2 / (2 * math.pi) ** 2, rel=0.15)


def test_level_lines_are_evenly_spaced() -> None:
    for top in (0.37, 5.6, 11.0):
        levels = picture._levels(top)
        assert 6 <= len(levels) <= picture.LEVELS
        np.testing.assert_allclose(np.diff(levels), levels[0])


def test_a_line_is_broken_where_it_jumps_over_the_seam() -> None:
    line = np.array([[3.0, 0.0], [3.1, 0.0], [-3.1, 0.1], [-3.0, 3.1], [-2.9, -3.1]])
    broken = picture._broken_at_seams(line, (2 * math.pi, 2 * math.pi))
    assert np.flatnonzero(np.isnan(broken[:, 0])).tolist() == [2, 5]
    np.testing.assert_array_equal(broken[~np.isnan(broken[:, 0])], line)


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.0, "$0$"), (math.pi, r"$\pi$"), (-math.pi / 2, r"$-\pi/2$"), (1.5 * math.pi, r"$3\pi/2$"), (0.7, "0.7")],
)
def test_angles_are_written_as_multiples_of_pi(value: float, text: str) -> None:
    assert picture._multiple_of_pi(value) == text


@pytest.mark.parametrize("name", PLAIN)
def test_paths_start_at_free_points_far_from_each_other(tmp_path: Path, name: str) -> None:
    scene = small_scene(tmp_path, name)
    starts = path_starts(scene, 5)
    assert starts.shape == (5, scene.manifold.point_size)
    assert (scene.signed_distance(starts) > 0).all()
    apart = scene.manifold.distance(starts[:, None], starts) + 9 * torch.eye(5)
    assert min(apart.min(), scene.manifold.distance(starts, scene.goal).min()) > 0.8


def test_three_dimensions_are_refused(tmp_path: Path) -> None:
    scene = small_scene(tmp_path, "SO3")
    with pytest.raises(UserError, match="two dimensions; plain SO"):
        draw_scene_field(scene, Rotations().distance, [])


@pytest.mark.parametrize(("name", "view"), [("H2", "chart"), ("H2", "surface"), ("T2", "surface")])
def test_a_view_that_the_manifold_has_not_is_refused(tmp_path: Path, name: str, view: View) -> None:
    with pytest.raises(UserError, match=f"`{view}` view"):
        canvases(small_scene(tmp_path, name), view)


def test_a_run_is_drawn_as_png_and_pdf(tmp_path: Path) -> None:
    folder = RunFolder(tmp_path / "run")
    scene = small_scene(tmp_path, "T2", "{steps: 3, points: 32, splats: {initial: 4}}")
    folder.create(scene)
    train(scene, folder)
    file = draw_run(folder.path, paths_from=2, manifold=scene.manifold)
    assert file == folder.path / "field.png"
    assert matplotlib.image.imread(file).shape[1] == 920
    assert (folder.path / "field.pdf").read_bytes().startswith(b"%PDF")
    assert not [file for file in folder.path.iterdir() if file.name.startswith(".")]
