"""What a figure shows is where it is: the flat views, the shapes in space, what hides what."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import matplotlib.colors
import matplotlib.image
import numpy as np
import pytest
import torch
from plain_manifolds import PLAIN
from scenes import random_field, seeded, small_scene

from rsrm_gen.errors import UserError
from rsrm_gen.trainer import picture
from rsrm_gen.trainer.evaluate import TimeFunction
from rsrm_gen.trainer.picture import draw_field, draw_run
from rsrm_gen.trainer.plan import Paths
from rsrm_gen.trainer.run import RunFolder
from rsrm_gen.trainer.scene import Scene
from rsrm_gen.trainer.settings import Picture
from rsrm_gen.trainer.train import train
from rsrm_gen.trainer.views.drawing import LEVELS, drawing_of, level_values, path_starts, splat_outlines
from rsrm_gen.trainer.views.hidden import Eye, look
from rsrm_gen.trainer.views.mesh import mesh_of
from rsrm_gen.trainer.views.plane import Array, Plane, goal_frame, planes
from rsrm_gen.trainer.views.render import flat_image, render
from rsrm_gen.trainer.views.shape import natural_shape, normals

# A manifold, whether on a ball of it, and the kind of its flat view: round or not.
VIEWS = [("T2", False, False), ("T2", True, True), ("H2", True, True), ("R2", True, True), ("S2", False, True)]


@pytest.fixture(autouse=True)
def _few_pixels(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(picture, "PIXELS", 120)
    monkeypatch.setattr(picture, "FINENESS", 60)


def scene_for(folder: Path, name: str, ball: bool) -> Scene:
    scene = small_scene(folder, name)
    return scene if ball else replace(scene, domain=None)


def distance_to_goal(scene: Scene) -> TimeFunction:
    return lambda x: scene.manifold.distance(x, scene.goal)


def inner_positions(plane: Plane) -> torch.Tensor:
    y = plane.pixels(60).reshape(-1, 2)
    return y[y.norm(dim=-1) < 0.98 * plane.half[0]] if plane.round else y


@pytest.mark.parametrize(("name", "ball", "is_round"), VIEWS)
def test_a_position_shows_the_point_that_is_drawn_there(tmp_path: Path, name: str, ball: bool, is_round: bool) -> None:
    (plane,) = planes(scene_for(tmp_path, name, ball))
    assert plane.round == is_round
    y = inner_positions(plane)
    assert len(y) > 2000
    assert (plane.coordinates(plane.point(y)) - y).norm(dim=-1).max() < 1e-6 * plane.half[0]


def test_three_sections_show_more_dimensions(tmp_path: Path) -> None:
    scene = small_scene(tmp_path, "SO3")
    found = planes(scene)
    assert len(found) == 3
    for plane in found:
        y = inner_positions(plane)
        assert (plane.coordinates(plane.point(y)) - y).norm(dim=-1).max() < 1e-6
        assert torch.allclose(scene.manifold.distance(plane.point(y), scene.goal), y.norm(dim=-1))
    obstacle = scene.manifold.log(scene.goal, scene.centers[0])
    along = scene.manifold.inner(scene.goal, obstacle, goal_frame(scene))
    assert along[0].abs() == pytest.approx(float(scene.manifold.norm(scene.goal, obstacle))), (
        "the first direction leads there"
    )


@pytest.mark.parametrize("name", ["T2", "S2", "H2"])
def test_a_shape_in_space_shows_every_point_once(tmp_path: Path, name: str) -> None:
    """Neighbours are drawn side by side, also over the seam, and what is apart is drawn apart."""
    scene = scene_for(tmp_path, name, name == "H2")
    mesh = mesh_of(planes(scene)[0], 40)
    shape = natural_shape(mesh, scene.manifold, scene.goal)
    assert shape is not None
    assert shape.closed == (name != "H2")
    x = mesh.points.reshape(-1, scene.manifold.point_size)[::3]
    positions = shape.embed(x)
    assert positions.norm(dim=-1).max() < 1 + 1e-9
    apart = scene.manifold.distance(x[:, None], x[None])
    drawn = (positions[:, None] - positions[None]).norm(dim=-1)
    some = apart > 0.02
    ratio = (drawn / apart)[some]
    assert ratio.max() < 1.6
    assert ratio.min() > 0.02


def test_what_has_no_shape_in_space_is_drawn_as_a_graph(tmp_path: Path) -> None:
    scene = small_scene(tmp_path, "R2")
    drawing = drawing_of(scene, distance_to_goal(scene), None, 40)
    ((graph, _),) = drawing.shapes
    assert graph.torn
    x = drawing.sheets[0].mesh.points.reshape(-1, 2)
    z = graph.embed(x)[:, 2]
    time = scene.manifold.distance(x, scene.goal)
    line = np.polynomial.Polynomial.fit(time.numpy(), z.numpy(), 1)
    assert np.abs(line(time.numpy()) - z.numpy()).max() < 1e-9, "the height is T"


def test_normals_of_a_mesh_are_those_of_the_surface(tmp_path: Path) -> None:
    mesh = mesh_of(planes(scene_for(tmp_path, "S2", False))[0], 120)
    x = mesh.points.reshape(-1, 3).numpy()
    found = normals(x, mesh.triangles)
    assert np.abs((found * x).sum(1)).min() > 0.999


def test_the_near_side_hides_the_far_side(tmp_path: Path) -> None:
    mesh = mesh_of(planes(scene_for(tmp_path, "S2", False))[0], 80)
    eye = Eye.at(0.4, 0.7)
    assert np.allclose(
        np.stack([eye.right, eye.up, eye.toward]) @ np.stack([eye.right, eye.up, eye.toward]).T, np.eye(3)
    )
    sight = look(eye, mesh.points.reshape(-1, 3).numpy(), mesh.triangles, 200)
    x = PLAIN["S2"].sample(2000, seeded()).double().numpy()
    seen = eye.screen(x)
    clear = np.abs(seen[:, 2]) > 0.15
    np.testing.assert_array_equal(sight.shows(seen)[clear], seen[clear, 2] > 0)
    there = (sight.triangle >= 0).sum() * sight.pixel**2
    assert there == pytest.approx(math.pi, rel=0.01), "the disc is filled"
    depth = sight.interpolate(eye.screen(mesh.points.reshape(-1, 3).numpy())[:, 2], mesh.triangles)
    assert depth[sight.triangle >= 0].min() > -0.1


def test_colours_in_space_are_those_of_t_where_it_is(tmp_path: Path) -> None:
    """From above the goal, the shading of T = d is darkest, that is T smallest, in the middle, and level on rings."""
    scene = scene_for(tmp_path, "S2", False)
    scene = replace(scene, radii=scene.radii[:0], centers=scene.centers[:0])
    drawing = drawing_of(scene, distance_to_goal(scene), None, 80)
    shape, _ = drawing.shapes[0]
    x, y, z = scene.goal.tolist()
    eye = Eye.at(math.atan2(y, x), math.asin(z))
    rendering = render(drawing.sheets[0], shape, eye, drawing.top, 100)
    time = rendering.sight.interpolate(drawing.sheets[0].time.reshape(-1).numpy(), drawing.sheets[0].mesh.triangles)
    height, width = time.shape
    across = (np.arange(width) + 0.5) * rendering.sight.pixel + rendering.sight.low[0]
    up = (np.arange(height) + 0.5) * rendering.sight.pixel + rendering.sight.low[1]
    r = np.hypot(across, up[:, None])
    near = r < 0.9
    assert np.abs(time - np.arcsin(np.minimum(r, 1)))[near].max() < 0.02
    assert rendering.image[height // 4, width // 4, 3] == 1
    assert rendering.image[0, 0, 3] == 0


def test_level_lines_are_level_and_stay_out_of_obstacles(tmp_path: Path) -> None:
    for name, ball, _ in VIEWS:
        scene = scene_for(tmp_path, name, ball)
        drawing = drawing_of(scene, distance_to_goal(scene), None, 120)
        sheet = drawing.sheets[0]
        lines = sheet.level_lines(scene, np.array([0.5]))
        x = sheet.mesh.plane.point(torch.from_numpy(np.concatenate(lines)))
        assert len(x) > 30
        assert (scene.manifold.distance(x, scene.goal) - 0.5).abs().max() < 0.01
        assert scene.signed_distance(x).min() >= 0
        edge = sheet.mesh.plane.point(torch.from_numpy(np.concatenate(sheet.outlines())))
        assert scene.signed_distance(edge).abs().max() < 0.01


def test_an_obstacle_covers_its_share_of_the_chart(tmp_path: Path) -> None:
    scene = scene_for(tmp_path, "T2", False)
    drawing = drawing_of(scene, distance_to_goal(scene), None, 200)
    areas = [shoelace(polygon) for polygon in drawing.sheets[0].areas()]
    assert sum(areas) == pytest.approx(math.pi * 0.4**2, rel=0.01)


def shoelace(polygon: Array) -> float:
    """The area of a polygon (k, 2)."""
    x, y = polygon.T
    return abs(float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))) / 2


def test_a_flat_image_shows_t(tmp_path: Path) -> None:
    scene = scene_for(tmp_path, "T2", False)
    drawing = drawing_of(scene, distance_to_goal(scene), None, 60)
    image = flat_image(drawing, drawing.sheets[0], 50)
    x = drawing.sheets[0].mesh.plane.pixels(50)
    wanted = matplotlib.colormaps["viridis"]((scene.manifold.distance(x, scene.goal) / drawing.top).clamp(0, 1).numpy())
    np.testing.assert_allclose(image, wanted, atol=0.01)


def test_splats_are_outlined_where_they_have_fallen_by_the_root_of_e() -> None:
    for name in ("T2", "S2", "H2"):
        manifold = PLAIN[name]
        center = torch.tensor(
            {"T2": [0.3, 0.4], "S2": [0, 0.6, 0.8], "H2": [1.25, 0.75, 0.0]}[name], dtype=torch.float64
        )
        field = random_field(manifold, manifold.sample_ball(center, 0.5, 3, seeded()).double(), seeded(1))
        outlines = splat_outlines(field, 16)
        assert outlines.shape[:3] == (3, 1, 17)
        for k in range(3):
            v = manifold.log(field.mu[k], outlines[k, 0])
            components = manifold.inner(field.mu[k], v[:, None], field.frame[k])
            z = torch.linalg.solve(field.A[k], components.T)
            assert torch.allclose(z.norm(dim=0), torch.ones(17, dtype=torch.float64), atol=1e-9)


@pytest.mark.parametrize(("name", "ball", "is_round"), [*VIEWS, ("SO3", True, True)])
def test_every_view_is_drawn_without_a_warning(tmp_path: Path, name: str, ball: bool, is_round: bool) -> None:
    scene = scene_for(tmp_path, name, ball)
    way = torch.linspace(1, 0, 30, dtype=torch.float64)[:, None]
    path = scene.manifold.exp(scene.goal.expand(30, -1), way * 1.5 * scene.manifold.frame(scene.goal)[0])
    one, yes = torch.ones(1, dtype=torch.float64), torch.ones(1, dtype=torch.bool)
    paths = Paths((path,), 1.5 * one, 1.4 * one, yes, ~yes, ~yes, one, 1.5 * one)
    figure = draw_field(scene, distance_to_goal(scene), paths)
    texts = [text.get_text() for ax in figure.axes for text in ax.texts]
    assert len(figure.axes) == {"R2": 2, "SO3": 4}.get(name, 3), "in space, flat, and the bar"
    picture._save(figure, tmp_path / "field.png")
    image = matplotlib.image.imread(tmp_path / "field.png")[..., :3]
    drawn = (np.abs(image - np.array(matplotlib.colors.to_rgb(picture.PATH))).max(-1) < 0.02).sum()
    if name == "SO3":
        assert (texts, drawn) == ([], 0), "a section does not hold paths"
    else:
        assert texts == ["1.50"]
        assert drawn > 200


def test_the_view_that_is_asked_for_is_drawn_alone(tmp_path: Path) -> None:
    scene = replace(small_scene(tmp_path, "H2"), picture=Picture(view="surface"))
    assert len(draw_field(scene, distance_to_goal(scene)).axes) == 2
    scene = replace(scene, picture=Picture(view="disk"))
    assert len(draw_field(scene, distance_to_goal(scene)).axes) == 2


@pytest.mark.parametrize(("name", "view"), [("H2", "chart"), ("R2", "surface")])
def test_a_view_that_the_manifold_has_not_is_refused(tmp_path: Path, name: str, view: str) -> None:
    scene = replace(small_scene(tmp_path, name), picture=Picture.model_validate({"view": view}))
    with pytest.raises(UserError, match=f"`{view}` view"):
        draw_field(scene, distance_to_goal(scene))


def test_level_values_are_evenly_spaced() -> None:
    for top in (0.37, 5.6, 11.0):
        levels = level_values(top)
        assert 6 <= len(levels) <= LEVELS
        np.testing.assert_allclose(np.diff(levels), levels[0])


def test_a_line_is_cut_where_it_jumps_over_the_seam(tmp_path: Path) -> None:
    (plane,) = planes(scene_for(tmp_path, "T2", False))
    line = torch.tensor([[3.0, 0.0], [3.1, 0.0], [-3.1, 0.1], [-3.0, 3.1], [-2.9, -3.1]], dtype=torch.float64)
    pieces = plane.lines(line)
    assert [len(piece) for piece in pieces] == [2, 2, 1]
    np.testing.assert_allclose(np.concatenate(pieces), line)


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


def test_a_run_is_drawn_as_png_and_pdf(tmp_path: Path) -> None:
    folder = RunFolder(tmp_path / "run")
    scene = small_scene(tmp_path, "T2", "{steps: 3, points: 32, splats: {initial: 4}}")
    folder.create(scene)
    train(scene, folder)
    file = draw_run(folder.path, paths_from=2, manifold=scene.manifold)
    assert file == folder.path / "field.png"
    assert matplotlib.image.imread(file).shape[1] == round(300 * (2 * picture.PANEL + 0.7))
    drawn = (folder.path / "field.pdf").read_bytes()
    assert drawn.startswith(b"%PDF")
    assert b"/FontFile2" in drawn, "fonts are embedded"
    again = draw_run(folder.path, tmp_path / "again.pdf", 2, scene.manifold)
    assert again.read_bytes() == drawn
    assert not [file for file in folder.path.iterdir() if file.name.startswith(".")]
    with pytest.raises(UserError, match=r"\.pdf, \.png, \.svg"):
        draw_run(folder.path, tmp_path / "field.gif", 2, scene.manifold)
