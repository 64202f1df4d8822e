"""Products, scaled manifolds, retractions, and what only an author can give: transport and a uniform distribution."""

from __future__ import annotations

import math
import random
import re
from pathlib import Path
from typing import Any

import mpmath as mp
import numpy as np
import pytest
import torch
from compiled import MANIFOLDS, bundled_spec, files, geometry, program, torch_module
from torch import Tensor

import rsrm_gen
from rsrm_gen.compiler.derive import derive
from rsrm_gen.compiler.driver import compile_manifold
from rsrm_gen.compiler.lower import interpret
from rsrm_gen.compiler.spec import ProductSpec, read_spec
from rsrm_gen.errors import UserError

SE3 = """manifold: pose
doc: A test.
parameters: {radius: 2}
product:
  position: euclidean
  rotation: {manifold: so3, weight: radius}
"""


def written(folder: Path, text: str, name: str = "file.yaml") -> Path:
    path = folder / name
    path.write_text(text)
    return path


def module(name: str, folder: Path, **parameters: Any) -> Any:
    """The torch manifold; the audit of the bundled ones is test_audit's."""
    identifier = bundled_spec(name, **parameters).identifier
    return torch_module(files(name, **parameters), identifier, folder).manifold


def poses(count: int, seed: int) -> Tensor:
    x = torch.randn(count, 7, generator=torch.Generator().manual_seed(seed), dtype=torch.float64)
    return torch.cat([x[:, :3], x[:, 3:] / x[:, 3:].norm(dim=-1, keepdim=True)], -1)


def test_a_product_is_its_factors_side_by_side(tmp_path: Path) -> None:
    se3, so3 = module("se3", tmp_path, radius=2), module("so3", tmp_path)
    p, q = poses(50, 1), poses(50, 2)
    v = se3.log(p, q)
    angle = so3.distance(p[:, 3:], q[:, 3:])
    assert torch.equal(v, torch.cat([q[:, :3] - p[:, :3], so3.log(p[:, 3:], q[:, 3:])], -1))
    torch.testing.assert_close(se3.distance(p, q), ((q - p)[:, :3].square().sum(-1) + (2 * angle) ** 2).sqrt())
    torch.testing.assert_close(se3.log_abs_det(p, q), so3.log_abs_det(p[:, 3:], q[:, 3:]))
    torch.testing.assert_close(se3.norm(p, v), se3.distance(p, q))
    assert (se3.dim, se3.point_size, se3.tangent_size) == (6, 7, 6)
    assert se3.injectivity_radius == pytest.approx(2 * math.pi)
    assert se3.diameter == math.inf


def test_the_weight_of_a_factor_shortens_its_gradients(tmp_path: Path) -> None:
    se3 = module("se3", tmp_path, radius=2)
    p, q = poses(50, 3), poses(50, 4).requires_grad_()
    (partials,) = torch.autograd.grad(se3.distance(p, q).sum(), q)
    torch.testing.assert_close(se3.gradient_norm(q, partials), torch.ones(50, dtype=torch.float64))


def test_products_nest_and_powers_have_numbered_names() -> None:
    nested, power = bundled_spec("mobile_manipulator"), bundled_spec("dual_arm")
    assert isinstance(nested, ProductSpec)
    assert isinstance(power, ProductSpec)
    assert [f.name for f in nested.factors] == ["base", "arm"]
    assert isinstance(nested.factors[0].spec, ProductSpec)
    assert [f.name for f in power.factors] == ["arm1", "arm2"]
    assert power.dim == 14
    assert [f.name for f in power.distinct()] == ["arm1"]
    p, q = [mp.mpf(k) / 7 for k in range(9)], [mp.mpf(k * k) / 9 for k in range(9)]
    squares = [(b - a) ** 2 for a, b in zip(p[:2], q[:2], strict=True)]
    turns = [b - a - 2 * mp.pi * mp.nint((b - a) / (2 * mp.pi)) for a, b in zip(p[2:], q[2:], strict=True)]
    squares += [w**2 * turn**2 for w, turn in zip([0.5] + [0.25] * 6, turns, strict=True)]
    (distance,) = interpret(program("mobile_manipulator")["distance"], p, q)[0]
    assert abs(distance - mp.sqrt(mp.fsum(squares))) < 1e-14


@pytest.mark.parametrize("factors", ["{a: so3, b: euclidean}", "{a: euclidean, b: so3}"])
def test_a_product_has_what_all_factors_have_in_any_order(factors: str, tmp_path: Path) -> None:
    product = derive(read_spec(written(tmp_path, f"manifold: both\ndoc: A test.\nproduct: {factors}\n")))
    assert "transport" in product
    assert "sample" not in product
    assert "other_name" not in product
    with pytest.raises(KeyError):
        product["other_name"]


def test_names_in_the_code_of_a_product_begin_with_the_factor() -> None:
    assert "rotation_norm_s = " in files("se3")["se3.py"]
    assert "rotation_g0 = " in files("se3")["se3.c"]


@pytest.mark.parametrize("name", ["sphere", "so3", "hyperbolic"])
def test_a_scale_multiplies_lengths_and_nothing_else(name: str, tmp_path: Path) -> None:
    text = re.sub(r"(?m)^scale: .*$", "", (MANIFOLDS / f"{name}.yaml").read_text()) + "scale: sqrt(2) * 3\n"
    compiled = compile_manifold(written(tmp_path, text))
    large = torch_module(compiled.files, name, tmp_path).manifold
    small = module(name, tmp_path)
    generator = torch.Generator().manual_seed(5)
    p, q = (small.project(torch.randn(40, small.point_size, generator=generator).double()) for _ in range(2))
    k = 3 * math.sqrt(2)
    torch.testing.assert_close(large.distance(p, q), k * small.distance(p, q))
    torch.testing.assert_close(large.log(p, q), small.log(p, q))
    torch.testing.assert_close(large.log_abs_det(p, q), small.log_abs_det(p, q))
    torch.testing.assert_close(large.inner(p, small.log(p, q), small.log(p, q)), k**2 * small.distance(p, q) ** 2)
    assert large.injectivity_radius == pytest.approx(k * small.injectivity_radius)


def test_what_a_scale_or_a_weight_changes_is_another_manifold(tmp_path: Path) -> None:
    one, two = (read_spec(written(tmp_path, SE3), {"radius": r}) for r in (1, 2))
    assert one.content_hash != two.content_hash
    assert (one.identifier, two.identifier) == ("pose_radius1", "pose")


def test_a_factor_beside_the_file_comes_before_a_bundled_one_and_counts_in_the_hash(tmp_path: Path) -> None:
    before = read_spec(written(tmp_path, SE3)).content_hash
    text = (MANIFOLDS / "so3.yaml").read_text()
    written(tmp_path, text.replace("Rotations of R^3", "My rotations"), "so3.yaml")
    spec = read_spec(written(tmp_path, SE3))
    assert spec.content_hash != before
    assert isinstance(spec, ProductSpec)
    assert spec.factors[1].spec.doc.startswith("My rotations")


MISTAKES = {
    "an unknown factor": ("so3, weight", "s03, weight", "no manifold `s03`", "`so3`"),
    "a path for a name": ("position: euclidean", "position: ../secret", "`../secret` is not a factor", "torus(n=6)"),
    "a parameter the factor does not have": ("position: euclidean", "position: euclidean(m=2)", "no parameter `m`", "here: n"),
    "a parameter that is no number": ("position: euclidean", "position: euclidean(n=k)", "a number is expected", "radius"),
    "a negative weight": ("weight: radius", "weight: -radius", "`weight` must be positive", ""),
    "a power of nothing": ("weight: radius", "power: 0", "a power of 0", ""),
    "too many factors": ("weight: radius", "power: 17", "a power of 17", ""),
    "too many dimensions": ("position: euclidean", "position: {manifold: torus, parameters: {n: 7}, power: 4}", "31 dim", ""),
    "a key of another kind of file": ("product:", "metric: dot(u, v)\nproduct:", "unknown key `metric`", ""),
    "half of a parameter": ("position: euclidean", "position: euclidean(n)", "not a factor", "torus(n=6)"),
}  # fmt: skip


@pytest.mark.parametrize("name", MISTAKES)
def test_a_mistake_in_a_product_is_named(name: str, tmp_path: Path) -> None:
    old, new, message, hint = MISTAKES[name]
    assert old in SE3
    with pytest.raises(UserError) as caught:
        read_spec(written(tmp_path, SE3.replace(old, new)))
    assert message in str(caught.value)
    assert hint in (caught.value.hint or "")
    assert caught.value.span is not None


def test_a_product_that_is_part_of_itself_is_refused(tmp_path: Path) -> None:
    written(tmp_path, SE3.replace("euclidean", "b"), "a.yaml")
    written(tmp_path, SE3.replace("euclidean", "a"), "b.yaml")
    with pytest.raises(UserError, match="part of itself"):
        read_spec(tmp_path / "a.yaml")


def test_the_error_of_a_factor_is_where_the_factor_is_written(tmp_path: Path) -> None:
    text = (MANIFOLDS / "so3.yaml").read_text()
    written(tmp_path, text.replace("metric: dot(u, v)", "metric: dot(u, w)"), "so3.yaml")
    with pytest.raises(UserError, match=r"so3\.yaml:\d+:\d+: error: unknown symbol `w`"):
        read_spec(written(tmp_path, SE3))


# Retractions


def kinetic_energy(angles: Any, velocities: Any) -> Any:
    """Of two rods of one metre and one kilogram, from the velocities of their centres (m1 = m2 = l1 = 1, i = 1/12)."""
    a, b = angles
    first = np.array([-np.sin(a), np.cos(a)])
    second = np.array([-np.sin(a + b), np.cos(a + b)])
    u, w = velocities
    center1, center2 = u / 2 * first, u * first + (u + w) / 2 * second
    return (center1 @ center1 + u**2 / 12 + center2 @ center2 + (u + w) ** 2 / 12) / 2


def test_the_metric_of_the_arm_is_its_kinetic_energy(tmp_path: Path) -> None:
    arm = module("arm2", tmp_path)
    rng = np.random.default_rng(3)
    for _ in range(20):
        p, v = rng.uniform(-3, 3, 2), rng.normal(size=2)
        found = float(arm.inner(torch.tensor(p), torch.tensor(v), torch.tensor(v))) / 2
        assert found == pytest.approx(kinetic_energy(p, v), rel=1e-13)


def test_the_gradient_on_a_retraction_is_that_of_the_metric(tmp_path: Path) -> None:
    arm = module("arm2", tmp_path)
    assert arm.maps == "retraction"
    generator = torch.Generator().manual_seed(2)
    p, df, w = (torch.randn(30, 2, generator=generator, dtype=torch.float64) for _ in range(3))
    gradient = arm.riemannian_gradient(p, df)
    torch.testing.assert_close(arm.inner(p, gradient, w), (df * w).sum(-1))
    torch.testing.assert_close(arm.gradient_norm(p, df) ** 2, (df * gradient).sum(-1))


def test_a_retraction_is_not_called_geodesic_in_the_generated_code() -> None:
    assert "geodesic distance: near" not in files("arm2")["arm2.py"]
    assert "near the geodesic distance where p and q are near" in files("arm2")["arm2.h"]


# Transport and sampling


def test_transport_on_the_sphere_is_the_rotation_of_the_plane(tmp_path: Path) -> None:
    sphere = module("sphere", tmp_path, n=4)
    generator = torch.Generator().manual_seed(7)
    p, q = (sphere.project(torch.randn(30, 5, generator=generator).double()) for _ in range(2))
    v = sphere.to_tangent(p, torch.randn(30, 5, generator=generator).double())
    angle = sphere.distance(p, q).unsqueeze(-1)
    along = sphere.log(p, q) / angle
    part = (along * v).sum(-1, keepdim=True)
    expected = v + part * ((angle.cos() - 1) * along - angle.sin() * p)
    torch.testing.assert_close(sphere.transport(p, q, v), expected)


@pytest.mark.parametrize("name", ["sphere", "so3"])
def test_transport_is_the_limit_of_a_ladder(name: str, tmp_path: Path) -> None:
    manifold = module(name, tmp_path)
    generator = torch.Generator().manual_seed(9)
    p, q = (manifold.project(torch.randn(manifold.point_size, generator=generator).double()) for _ in range(2))
    step, rungs = manifold.log(p, q) / 200, 200
    x, v = p, manifold.to_tangent(p, torch.randn(manifold.point_size, generator=generator).double())
    expected = manifold.transport(p, q, v)
    for _ in range(rungs):  # Schild's ladder with exact symmetric rungs
        y, middle = manifold.exp(x, step), manifold.exp(x, step / 2)
        tip = manifold.exp(middle, -manifold.log(middle, manifold.exp(x, v)))
        x, v, step = y, -manifold.log(y, tip), -manifold.log(y, x)
    torch.testing.assert_close(v, expected, rtol=1e-9, atol=1e-9)


def test_transport_at_the_antipode_follows_the_declared_geodesic(tmp_path: Path) -> None:
    sphere = module("sphere", tmp_path)
    p = torch.tensor([0.6, 0.0, 0.8], dtype=torch.float64)
    w = sphere.log(p, -p)
    torch.testing.assert_close(sphere.transport(p, -p, w), -w)
    side = torch.linalg.cross(p, w)
    torch.testing.assert_close(sphere.transport(p, -p, side), side)


def test_a_product_transports_factor_by_factor_and_says_what_it_cannot(tmp_path: Path) -> None:
    p, q = poses(5, 1), poses(5, 2)
    v = torch.randn(5, 6, generator=torch.Generator().manual_seed(1)).double()
    moved = module("se3", tmp_path).transport(p, q, v)
    assert torch.equal(moved[:, :3], v[:, :3])
    torch.testing.assert_close(moved[:, 3:], module("so3", tmp_path).transport(p[:, 3:], q[:, 3:], v[:, 3:]))
    with pytest.raises(ValueError, match="transport"):
        module("hyperbolic", tmp_path).transport(p, q, v)


WRONG = {
    "left translation for transport": ("so3", "qmul(qmul(h, [0, v]), conj(h))[1:] / dot(h, h)", "v", "in parallel"),
    "transport the other way": ("so3", "-sign(g[0]) * s]", "sign(g[0]) * s]", "in parallel"),
    "a normalised cube": ("sphere", "normal / norm(normal)", "2 * [1, 1, 1] / 3 * 0 + uniform / norm(uniform)", "uniform"),
    "half of the circle": ("torus", "wrap(2 * pi * uniform)", "pi * uniform", "uniform"),
    "transport along a retraction": ("arm2", "log: wrap(q - p)\n", "log: wrap(q - p)\ntransport: v\n", "does not know"),
    "a uniform point of a plane": ("euclidean", "log: q - p\n", "log: q - p\nsample: uniform\n", "no uniform distribution"),
}  # fmt: skip


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_closed_form_is_refused(name: str, tmp_path: Path) -> None:
    manifold, old, new, says = WRONG[name]
    text = (MANIFOLDS / f"{manifold}.yaml").read_text()
    assert old in text
    with pytest.raises(UserError, match=says) as caught:
        compile_manifold(written(tmp_path, text.replace(old, new)))
    assert caught.value.span is not None


def test_half_of_the_names_of_rotations_is_a_uniform_sample_too(tmp_path: Path) -> None:
    text = (MANIFOLDS / "so3.yaml").read_text()
    half = text.replace("sample: normal / norm(normal)", "sample: sign(normal[0]) * normal / norm(normal)")
    assert half != text
    compile_manifold(written(tmp_path, half))


def test_samples_of_a_product_are_those_of_its_factors(tmp_path: Path) -> None:
    arms = module("dual_arm", tmp_path)
    points = arms.sample(2000, torch.Generator().manual_seed(1))
    assert points.shape == (2000, 14)
    assert points.abs().max() <= math.pi
    assert points.mean(0).abs().max() < 5 * math.pi / math.sqrt(3 * 2000)
    with pytest.raises(ValueError, match="no uniform distribution"):
        module("se3", tmp_path).sample(3)


def test_symbols_are_explained_in_the_generated_code() -> None:
    assert "v: joint velocities in radians per second" in files("arm2")["arm2.py"]
    assert "v: joint velocities in radians per second" in files("arm2")["arm2.h"]


def test_the_derivation_does_not_depend_on_the_precision_that_the_caller_works_in() -> None:
    with mp.workdps(20):
        other = geometry.__wrapped__("so3")
    assert str(other.functions) == str(geometry("so3").functions)


def test_a_product_is_loaded_like_any_manifold() -> None:
    se2 = rsrm_gen.load("se2")
    rng = random.Random(1)
    p = torch.tensor([[rng.gauss(0, 1) for _ in range(3)] for _ in range(9)], dtype=torch.float64)
    torch.testing.assert_close(se2.exp(p, torch.zeros_like(p)), p)
