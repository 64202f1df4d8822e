"""Curves: what they cost is exact, relaxation finds the cheapest nearby, and nothing that is not finite comes out."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import torch
from curve_scenes import GOALS, around, curve_scene
from scenes import seeded
from scipy.integrate import quad

from rsrm_gen.errors import UserError
from rsrm_gen.trainer import curves as module
from rsrm_gen.trainer.curves import Curves, Relaxation, Terrain


def crooked(terrain: Terrain, starts: torch.Tensor, by: float, seed: int = 0) -> Curves:
    """Segments to the goal with their inner nodes thrown about."""
    M = terrain.manifold
    curves = terrain.spaced(Curves.between(starts.numpy(), terrain.scene.goal.numpy()), terrain.usual.spacing)
    nodes = torch.from_numpy(curves.nodes)
    noise = by * torch.randn(len(nodes), 1, M.dim, generator=seeded(seed), dtype=torch.float64)
    noise[curves.offsets[:-1]], noise[curves.offsets[1:] - 1] = 0, 0
    return Curves(M.project(M.exp(nodes, (noise @ M.frame(nodes))[:, 0])).numpy(), curves.offsets)


@pytest.mark.parametrize("name", ["torus", "sphere", "hyperbolic", "so3", "se3"])
def test_where_the_slowness_is_constant_a_relaxed_curve_is_a_geodesic(name: str, tmp_path: Path) -> None:
    terrain = Terrain(curve_scene(tmp_path, name, slowness="{free: 2}"))
    x = around(terrain.scene, 2.0, 12)
    distance = terrain.manifold.distance(x, terrain.scene.goal).numpy()
    curves = crooked(terrain, x, 0.03)
    assert (terrain.cost(curves) > 2.02 * distance).any()
    relaxed = terrain.relaxed(curves, replace(terrain.usual, tolerance=1e-10, iterations=60))
    assert np.abs(relaxed.cost / (2 * distance) - 1).max() < 1e-5
    assert (relaxed.cost + relaxed.error > 2 * distance * (1 - 1e-12)).all()


def test_on_a_retraction_curves_are_shorter_than_its_own_lines(tmp_path: Path) -> None:
    terrain = Terrain(curve_scene(tmp_path, "arm2"))
    x = around(terrain.scene, 1.5, 20)
    lines = Curves.between(x.numpy(), terrain.scene.goal.numpy())
    relaxed, fine = (
        terrain.relaxed(lines, replace(terrain.usual, spacing=part * terrain.usual.spacing, tolerance=1e-9))
        for part in (1, 0.25)
    )
    assert (relaxed.cost < terrain.cost(lines) * (1 + 1e-9)).all()
    assert (relaxed.cost < 0.99 * terrain.cost(lines)).any()
    assert np.abs(relaxed.cost - fine.cost).max() < 2e-5
    others = terrain.cost(crooked(terrain, x, 0.01))
    assert (relaxed.cost < others).all()


def test_the_length_of_a_segment_of_a_retraction_is_by_the_metric_along_it(tmp_path: Path) -> None:
    terrain = Terrain(curve_scene(tmp_path, "arm2"))
    p, q = np.array([[0.3, 0.5]]), np.array([[1.1, -0.9]])
    M, v = terrain.manifold, torch.from_numpy(q - p)

    def speed(t: float) -> float:
        return float(M.norm(torch.from_numpy(p) + t * v, v))

    exact, _ = quad(speed, 0, 1, epsabs=1e-12)
    assert terrain.segments(p, q)[1] == pytest.approx([exact], rel=1e-6)


AREAS = {"euclidean": lambda r: r, "sphere": math.sin, "hyperbolic": math.sinh}
RADIUS, WIDTH, FREE, OBSTACLE = 0.5, 0.3, 1.0, 2.0  # so mild that rays through the ball turn back

MILD = f"{{free: {FREE}, obstacle: {OBSTACLE}, width: {WIDTH}}}"


def slowness_at(r: float) -> float:
    return FREE + (OBSTACLE - FREE) / (1 + math.exp((r - RADIUS) / WIDTH))


def bent_ray(name: str, nearest: float, farthest: float) -> tuple[float, float]:
    """The time along the ray that passes a ball at `nearest` from its centre, from one point at the distance `farthest`
    to another, and the angle between these at the centre: Snell's law, s(r) a(r) sin(angle to the radius) is constant."""
    area = AREAS[name]
    invariant = slowness_at(nearest) * area(nearest)

    def root(u: float) -> tuple[float, float, float]:
        r = nearest + u * u  # takes away the singularity at the nearest point
        product = slowness_at(r) * area(r)
        return r, product, 2 * u / math.sqrt(max(product**2 - invariant**2, 1e-300))

    def time(u: float) -> float:
        r, product, inverse = root(u)
        return slowness_at(r) * product * inverse

    def angle(u: float) -> float:
        r, _, inverse = root(u)
        return invariant * inverse / area(r)

    top = math.sqrt(farthest - nearest)
    return 2 * quad(time, 1e-9, top, epsabs=1e-11)[0], 2 * quad(angle, 1e-9, top, epsabs=1e-11)[0]


def at_polar(terrain: Terrain, center: torch.Tensor, r: float, angle: float) -> torch.Tensor:
    frame = terrain.manifold.frame(center)
    return terrain.manifold.exp(center, r * (math.cos(angle) * frame[0] + math.sin(angle) * frame[1]))


@pytest.mark.parametrize("name", AREAS)
def test_curves_obey_snells_law_around_an_obstacle(name: str, tmp_path: Path) -> None:
    obstacle = f"[{{center: {GOALS[name]}, radius: {RADIUS}}}]"
    terrain = Terrain(curve_scene(tmp_path, name, obstacle, MILD))
    center = terrain.scene.goal
    time, angle = bent_ray(name, 0.75, 1.1)
    start, end = (at_polar(terrain, center, 1.1, side * angle / 2).numpy() for side in (1, -1))
    way = at_polar(terrain, center, 0.9, 0.0).numpy()
    relaxed = terrain.relaxed(Curves.of([np.stack([start, way, end])]))
    assert relaxed.cost[0] == pytest.approx(time, abs=3e-5)
    assert relaxed.cost[0] + relaxed.error[0] >= time - 1e-8
    gradient = torch.from_numpy(terrain.gradients(relaxed.curves)[0])
    M, x = terrain.manifold, torch.from_numpy(start)
    outward = -M.log(x, center) / M.distance(x, center)
    cosine = M.inner(x, gradient, outward) / slowness_at(1.1)
    sine = slowness_at(0.75) * AREAS[name](0.75) / (slowness_at(1.1) * AREAS[name](1.1))
    assert float(cosine) == pytest.approx(math.sqrt(1 - sine**2), abs=2e-3)


def test_the_error_falls_with_the_square_of_the_spacing_and_is_what_is_said(tmp_path: Path) -> None:
    obstacle = f"[{{center: {GOALS['euclidean']}, radius: {RADIUS}}}]"
    terrain = Terrain(curve_scene(tmp_path, "euclidean", obstacle, MILD))
    time, angle = bent_ray("euclidean", 0.7, 1.4)
    nodes = [at_polar(terrain, terrain.scene.goal, r, a) for r, a in ((1.4, angle / 2), (0.8, 0.0), (1.4, -angle / 2))]
    curve = Curves.of([torch.stack(nodes).numpy()])
    tight = Relaxation(tolerance=1e-10, iterations=60)
    excess = []
    for spacing in (0.2, 0.1, 0.05):
        relaxed = terrain.relaxed(curve, replace(tight, spacing=spacing))
        excess.append(relaxed.cost[0] + relaxed.error[0] - time)
        assert abs(relaxed.cost[0] - time) < 0.2 * relaxed.error[0] + 1e-7
    assert 3.0 < excess[0] / excess[1] < 5.0
    assert 3.0 < excess[1] / excess[2] < 5.0


def test_curves_find_the_floor_of_a_valley_with_a_kink(tmp_path: Path) -> None:
    terrain = Terrain(curve_scene(tmp_path, "euclidean", "[{center: [0, 1], radius: 0.6}, {center: [0, -1], radius: 0.6}]",
                            goal=[1.5, 0.0]))  # fmt: skip
    curve = np.array([[-1.5, 0.0], [-0.5, 0.25], [0.3, -0.2], [1.5, 0.0]])
    relaxed = terrain.relaxed(Curves.of([curve]))
    exact, _ = quad(lambda t: float(terrain.scene.slowness(torch.tensor([t, 0.0]).double())), -1.5, 1.5, epsabs=1e-11)
    assert relaxed.cost[0] == pytest.approx(exact, abs=1e-5)
    assert relaxed.cost[0] + relaxed.error[0] >= exact - 1e-8


@pytest.mark.parametrize("name", ["torus", "sphere", "hyperbolic", "so3", "arm2"])
def test_the_gradient_is_that_of_the_cost_of_relaxed_curves(name: str, tmp_path: Path) -> None:
    plain = curve_scene(tmp_path, name)
    M = plain.manifold
    center = M.exp(plain.goal, 0.8 * M.frame(plain.goal)[0])
    terrain = Terrain(curve_scene(tmp_path, name, f"[{{center: {center.tolist()}, radius: 0.3}}]"))
    tight = replace(terrain.usual, tolerance=1e-11, iterations=60)
    x = M.exp(plain.goal, M.frame(plain.goal)[0] * 1.5 + M.frame(plain.goal)[1] * 0.3)
    frame, h = M.frame(x), 1e-3
    sides = torch.cat([M.exp(x, h * frame), M.exp(x, -h * frame), x[None]])
    relaxed = terrain.relaxed(Curves.between(sides.numpy(), plain.goal.numpy()), tight)
    slopes = (relaxed.cost[: M.dim] - relaxed.cost[M.dim : -1]) / (2 * h)
    gradient = terrain.gradients(relaxed.curves.take(np.array([2 * M.dim])))
    ours = M.inner(x, torch.from_numpy(gradient), frame).numpy()
    assert np.abs(ours - slopes).max() < 0.01 * float(terrain.scene.slowness(x))


def many(terrain: Terrain, count: int = 40) -> Curves:
    return Curves.between(around(terrain.scene, 2.5, count).numpy(), terrain.scene.goal.numpy())


@pytest.fixture
def terrain(tmp_path: Path) -> Terrain:
    return Terrain(
        curve_scene(tmp_path, "torus", "[{center: [-0.3, -0.6], radius: 0.5}, {center: [0.4, -1.6], radius: 0.4}]")
    )


def test_ends_stay_and_no_curve_becomes_dearer(terrain: Terrain) -> None:
    curves = terrain.spaced(many(terrain), terrain.usual.spacing)
    settled = terrain.settled(curves, terrain.usual.coarse)
    assert np.array_equal(settled.starts, curves.starts)
    assert np.array_equal(settled.nodes[settled.offsets[1:] - 1], curves.nodes[curves.offsets[1:] - 1])
    assert (terrain.cost(settled) <= terrain.cost(curves) + 1e-3).all()  # Simpson's rule decides, Gauss's judges
    assert terrain.cost(settled).sum() < 0.9 * terrain.cost(curves).sum()


def test_a_curve_that_is_not_finite_stays_as_it_is_and_spoils_no_other(terrain: Terrain) -> None:
    curves = terrain.spaced(many(terrain), terrain.usual.spacing)
    alone = terrain.settled(curves, terrain.usual.coarse)
    nodes = curves.nodes.copy()
    nodes[curves.offsets[3] + 2] = math.nan
    nodes[curves.offsets[7] + 1] = math.inf
    spoilt = Curves(nodes, curves.offsets)
    settled = terrain.settled(spoilt, terrain.usual.coarse)
    for b in range(len(curves)):
        assert np.array_equal(settled[b], spoilt[b] if b in (3, 7) else alone[b], equal_nan=True)
    relaxed = terrain.relaxed(spoilt)
    sound = np.setdiff1d(np.arange(len(curves)), [3, 7])
    assert np.isfinite(relaxed.cost[sound]).all()
    assert not np.isfinite(relaxed.cost[[3, 7]]).any()


def test_what_is_taken_off_is_never_more_than_polygons_can_cost(terrain: Terrain) -> None:
    """A curve still on its way when its nodes are doubled gains much more by that than its sides' length explains."""
    starts = around(terrain.scene, 2.5, 60).numpy()
    detours = Curves.between(np.broadcast_to([0.5, -0.2], starts.shape), terrain.scene.goal.numpy()).from_(starts)
    relaxed = terrain.relaxed(detours)
    finer = terrain.resampled(relaxed.curves, 2 * relaxed.curves.counts - 1)
    finest = terrain.cost(terrain.settled(finer, terrain.usual.fine))
    assert (relaxed.cost > 0.995 * finest).all()
    assert np.median(np.abs(relaxed.cost - finest)) < 1e-3


def test_the_number_of_threads_changes_no_bit(terrain: Terrain) -> None:
    curves = many(terrain)
    one = terrain.relaxed(curves)
    terrain.threads = 2
    two = terrain.relaxed(curves)
    assert np.array_equal(one.cost, two.cost)
    assert np.array_equal(one.curves.nodes, two.curves.nodes)


def test_a_start_at_the_goal_costs_nothing(terrain: Terrain) -> None:
    goal = terrain.scene.goal.numpy()[None]
    relaxed = terrain.relaxed(Curves.between(goal, goal))
    assert relaxed.cost == pytest.approx([0.0], abs=1e-12)
    assert np.isfinite(terrain.gradients(relaxed.curves)).all()


def test_in_one_dimension_there_is_nothing_to_relax(tmp_path: Path) -> None:
    terrain = Terrain(curve_scene(tmp_path, "circle", "[{center: [0, 1], radius: 0.3}]"))
    start = np.array([[math.cos(2.5), math.sin(2.5)]])
    relaxed = terrain.relaxed(Curves.between(start, terrain.scene.goal.numpy()))

    def s(angle: float) -> float:
        return float(terrain.scene.slowness(torch.tensor([math.cos(angle), math.sin(angle)]).double()))

    exact, _ = quad(s, 0, 2.5, epsabs=1e-10, points=[math.pi / 2])
    assert relaxed.cost[0] == pytest.approx(exact, abs=1e-4)  # the slowness has a kink on the way


def test_without_a_compiler_one_is_asked_for(terrain: Terrain, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "compiler", lambda: None)
    with pytest.raises(UserError, match="C compiler") as caught:
        Terrain(terrain.scene)
    assert "eikonal" in str(caught.value.hint)


def test_curves_are_taken_joined_and_replaced_by_index() -> None:
    a, b, c = (np.full((n, 2), float(n)) for n in (2, 4, 3))
    curves = Curves.of([a, b, c])
    assert [curves.take(np.array([2, 0]))[k].tolist() for k in (0, 1)] == [c.tolist(), a.tolist()]
    assert curves.joined(Curves.of([a]))[3].tolist() == a.tolist()
    replaced = curves.replaced(np.array([1]), Curves.of([c]))
    assert [replaced[k].tolist() for k in range(3)] == [a.tolist(), c.tolist(), c.tolist()]
    longer = curves.from_(np.zeros((3, 2)))
    assert longer.counts.tolist() == [3, 5, 4]
    assert longer.starts.tolist() == np.zeros((3, 2)).tolist()
    assert longer[1][1:].tolist() == b.tolist()
