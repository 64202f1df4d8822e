"""Scenes: a manifold, a goal, geodesic-ball obstacles, the slowness they make and the domain trained on.

Points x have shape (..., D); the slowness is a time per length in the manifold's metric.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import torch
from torch import Generator, Tensor

from rsrm_gen.document import Document, Path_, read_document, validate
from rsrm_gen.errors import Source, Span, UserError
from rsrm_gen.load import load_in_rows as load
from rsrm_gen.manifold import Manifold
from rsrm_gen.trainer.settings import (
    Evaluation,
    ManifoldChoice,
    Picture,
    SceneDocument,
    Slowness,
    Training,
    training_of,
)

# How far from the manifold a written point may lie: six digits are what a person types.
ON_MANIFOLD = 1e-6


@dataclass(frozen=True)
class Ball:
    """A geodesic ball: center (D,), radius."""

    center: Tensor
    radius: float


@dataclass(frozen=True)
class Scene:
    """What a field is trained for. m obstacles; every tensor has the dtype of the training."""

    title: str
    source: Source  # the scene file
    manifold_choice: ManifoldChoice  # as the file names it
    manifold_span: Span  # where it does so
    manifold: Manifold
    goal: Tensor  # (D,)
    centers: Tensor  # (m, D)
    radii: Tensor  # (m,)
    forbid_obstacles: bool  # whether a path through one is no path
    law: Slowness
    domain: Ball | None  # None: the whole, compact manifold
    evaluation: Evaluation
    picture: Picture
    training: Training

    def signed_distance(self, x: Tensor) -> Tensor:
        """min_i d(x, c_i) - r_i: negative inside an obstacle, inf where there is none; (...)."""
        if not len(self.radii):
            return x.new_full(x.shape[:-1], math.inf)
        radii = self.radii.view(-1, *[1] * (x.dim() - 1))
        return (self.obstacle_distances(x) - radii).amin(0)

    def obstacle_distances(self, x: Tensor) -> Tensor:
        """d(x, c_i): (m, ...), points last, where numbers that are treated alike lie side by side."""
        distances: Tensor = self.manifold.distance(x, self.centers.view(-1, *[1] * (x.dim() - 1), x.shape[-1]))
        return distances

    def in_double(self) -> Scene:
        """The same scene in float64, its points put back exactly onto the manifold."""
        exact = self.manifold.project
        domain = self.domain and replace(self.domain, center=exact(self.domain.center.double()))
        goal, centers = exact(self.goal.double()), exact(self.centers.double())
        return replace(self, goal=goal, centers=centers, radii=self.radii.double(), domain=domain)

    def slowness(self, x: Tensor) -> Tensor:
        """s(x) = free + (obstacle - free) sigmoid(-sdf / width): (...)."""
        inside = torch.sigmoid(-self.signed_distance(x) / self.law.width)
        return self.law.free + (self.law.obstacle - self.law.free) * inside

    def sample(self, count: int, generator: Generator | None = None) -> Tensor:
        """Points uniform in volume in the domain: (count, D)."""
        if self.domain is None:
            return self.manifold.sample(count, generator, like=self.goal)
        return self.manifold.sample_ball(self.domain.center, self.domain.radius, count, generator)

    def inside_domain(self, x: Tensor) -> Tensor:
        """Whether points lie in the domain: (...) of bool."""
        if self.domain is None:
            return torch.ones(x.shape[:-1], dtype=torch.bool)
        # From the centre, as points are sampled: by a retraction's metric it is another distance back.
        return self.manifold.distance(self.domain.center, x) <= self.domain.radius

    def into_domain(self, x: Tensor) -> Tensor:
        """Points as they are inside the domain, else the nearest point of its boundary: (..., D)."""
        if self.domain is None:
            return x
        center = self.domain.center.expand_as(x)
        away = self.manifold.log(center, x)
        length = self.manifold.norm(center, away)[..., None]
        outside = length > self.domain.radius
        rim = self.manifold.exp(center, away * (self.domain.radius / torch.where(outside, length, 1.0)))
        return torch.where(outside, rim, x)

    def point(self, numbers: Sequence[float], what: str, span: Span | None = None) -> Tensor:
        """A point of the manifold that a user wrote, (D,); a `UserError` when it is none."""
        return _point(self.manifold, numbers, what, span).to(self.goal.dtype)

    def with_training(self, **changes: Any) -> Scene:
        """The same scene with other training settings, checked again; not for a change of dtype."""
        training = training_of({**self.training.model_dump(), **changes})
        return replace(self, training=training)

    def with_kernels(self, kernels: str) -> Scene:
        """The same scene, its sums of splats computed by "c", "torch" or, as C can, "auto"."""
        choice = self.manifold_choice
        name = Path(self.source.name).parent / choice.spec if choice.is_path else choice.spec
        return replace(self, manifold=load(name, kernels, **choice.parameters))


def read_scene(path: Path, manifold: Manifold | None = None) -> Scene:
    """Read a scene file; `manifold` stands in for the one it names. Every mistake is a `UserError` with its place."""
    document = read_document(path)
    written = validate(document, SceneDocument)
    manifold = manifold or _load(document, written.manifold, path.parent)
    return _Reader(document, written, manifold).scene()


def _load(document: Document, choice: ManifoldChoice, folder: Path) -> Manifold:
    name: str | Path = folder / choice.spec if choice.is_path else choice.spec
    try:
        return load(name, None, **choice.parameters)
    except UserError as error:
        if error.span is not None:  # a mistake inside the manifold's own file: that place is the one to show
            raise
        raise UserError(error.message, document.span(("manifold", "spec")), error.hint) from None


@dataclass(frozen=True)
class _Reader:
    """Turns what is written in a scene file into tensors, checked against the manifold."""

    document: Document
    written: SceneDocument
    manifold: Manifold

    def scene(self) -> Scene:
        written = self.written
        obstacles = [(("obstacles", i, "center"), ball) for i, ball in enumerate(written.obstacles)]
        centers = [self.point(ball.center, path) for path, ball in obstacles]
        goal = self.point(written.goal, ("goal",))
        scene = Scene(
            title=written.scene,
            source=self.document.source,
            manifold_choice=written.manifold,
            manifold_span=self.document.span(("manifold", "spec")),
            manifold=self.manifold,
            goal=goal,
            centers=torch.stack(centers) if centers else goal.new_zeros(0, len(goal)),
            radii=goal.new_tensor([ball.radius for ball in written.obstacles]),
            forbid_obstacles=written.forbid_obstacles,
            law=written.slowness,
            domain=self.domain(),
            evaluation=written.evaluation,
            picture=written.picture,
            training=written.training,
        )
        if not scene.inside_domain(goal):
            raise UserError("the goal lies outside the domain", self.document.span(("goal",)))
        return scene

    def point(self, numbers: Sequence[float], path: Path_) -> Tensor:
        name = ".".join(str(part) for part in path)
        point = _point(self.manifold, numbers, f"`{name}`", self.document.span(path))
        return point.to(getattr(torch, self.written.training.dtype))

    def domain(self) -> Ball | None:
        domain, name = self.written.domain, self.manifold.name
        if domain is None and math.isinf(self.manifold.diameter):
            hint = "add a geodesic ball to train on: `domain: {center: [...], radius: ...}`"
            raise UserError(f"{name} is not compact: it needs a `domain`", self.document.span(("manifold",)), hint)
        if domain is None:
            return None
        limit = self.manifold.injectivity_radius
        if domain.radius > limit:
            message = f"the radius {domain.radius:g} is more than {name}'s injectivity radius, {limit:.7g}"
            raise UserError(message, self.document.span(("domain", "radius")))
        return Ball(self.point(domain.center, ("domain", "center")), domain.radius)


def _point(manifold: Manifold, numbers: Sequence[float], what: str, span: Span | None) -> Tensor:
    size = manifold.point_size
    if len(numbers) != size:
        raise UserError(f"{what} has {len(numbers)} numbers; a point of {manifold.name} has {size}", span)
    x = torch.tensor(numbers, dtype=torch.float64)
    projected = manifold.project(x)
    away = (x - projected).abs()
    for i, period in enumerate(manifold.periods or ()):
        if period is not None:  # an angle means the same after a full turn
            away[i] = torch.minimum(away[i] % period, period - away[i] % period)
    if not torch.isfinite(projected).all():
        raise UserError(f"{what} stands for no point of {manifold.name}", span)
    if away.max() > ON_MANIFOLD:
        nearest = ", ".join(f"{number:.9g}" for number in projected.tolist())
        raise UserError(f"{what} is not on {manifold.name}", span, f"the point it projects to is [{nearest}]")
    return projected
