"""What a scene file may say: its schema, and the training settings of each objective.

Lengths are in the units of the manifold's metric. Everything is frozen; nothing here knows a manifold.
"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Discriminator, Field, Tag, TypeAdapter, model_validator


def _not_a_bool(value: Any) -> Any:
    # YAML's `yes` and `true` would pass for 1 otherwise.
    if isinstance(value, bool):
        raise ValueError("a number is wanted, not true or false")
    return value


Number = Annotated[float, BeforeValidator(_not_a_bool)]
Positive = Annotated[Number, Field(gt=0)]
Count = Annotated[int, BeforeValidator(_not_a_bool), Field(ge=1)]
Numbers = list[Number]


class _Part(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class ManifoldChoice(_Part):
    """Which manifold: the name of a bundled one or the path of a YAML file, and parameters that differ."""

    spec: str = Field(min_length=1)
    parameters: dict[str, int | float | str] = {}

    @model_validator(mode="before")
    @classmethod
    def _name_alone(cls, value: Any) -> Any:
        return {"spec": value} if isinstance(value, str) else value

    @property
    def is_path(self) -> bool:
        """Whether `spec` names a file (relative to the scene file) rather than a bundled manifold."""
        return Path(self.spec).suffix in (".yaml", ".yml") or "/" in self.spec


class Obstacle(_Part):
    """A geodesic ball."""

    center: Numbers
    radius: Positive


class Slowness(_Part):
    """s = free + (obstacle - free) * sigmoid(-sdf / width): time per length, and the width of the transition."""

    free: Positive = 1.0
    obstacle: Positive = 10.0
    width: Positive = 0.15


class Domain(_Part):
    """The geodesic ball that is trained on."""

    center: Numbers
    radius: Positive


class Evaluation(_Part):
    """The grid that a field is judged on, `cells` x `cells`; `grid` left out: `chart` where every coordinate is
    periodic, else `polar` (distance from the goal and direction)."""

    grid: Literal["polar", "chart"] | None = None
    cells: Annotated[int, BeforeValidator(_not_a_bool), Field(ge=8, le=2000)] = 120


class Picture(_Part):
    """How the field is drawn: flat as a `chart` or a `disk`, or in space, `surface`; left out: in space and flat, as fits."""

    view: Literal["chart", "disk", "surface"] | None = None


class LinkChoice(_Part):
    """T from the distance d and the field f: `exponential` is d exp(f); `quotient` is d / tau with
    tau = floor + (1 - floor) sigmoid(f + offset)."""

    kind: Literal["exponential", "quotient"] = "exponential"
    offset: Number = 4.0
    floor: Annotated[Number, Field(ge=0, lt=1)] = 0.0

    @model_validator(mode="after")
    def _only_a_quotient_has_them(self) -> LinkChoice:
        if self.kind == "exponential" and (self.offset, self.floor) != (4.0, 0.0):
            raise ValueError("offset and floor belong to `kind: quotient`")
        return self


class BasedLink(LinkChoice):
    """The same with b in place of d: `smooth`, a base that is smooth where geodesics meet, if one is known; or `distance`."""

    base: Literal["smooth", "distance"] = "smooth"


class Splats(_Part):
    """How many splats there are, and how wide one may be: bounds of the singular values of A.

    What is left out of the bounds follows from how near to each other the points are, and how far the manifold goes.
    """

    count: Count = 256
    min_width: Positive | None = None  # a length
    max_width: Positive | None = None  # a length

    @model_validator(mode="before")
    @classmethod
    def _count_alone(cls, value: Any) -> Any:
        return {"count": value} if isinstance(value, int) and not isinstance(value, bool) else value

    @model_validator(mode="after")
    def _bounds_are_in_order(self) -> Splats:
        if self.min_width and self.max_width and self.max_width < self.min_width:
            raise ValueError(f"max_width {self.max_width} is less than min_width, {self.min_width}")
        return self


class GrowingSplats(_Part):
    """How many splats there are at first, and when they come and go."""

    initial: Count = 128
    add: Annotated[int, BeforeValidator(_not_a_bool), Field(ge=0)] = 48  # at each change, at the largest residuals
    every: Count = 400  # steps between changes; there are none in the last tenth of the training
    prune_below: Annotated[Number, Field(ge=0)] = 5e-4  # a splat with a smaller |v| goes
    shape: Positive = 0.35  # A = shape * I at first; a length
    min_singular: Positive = 0.07  # no singular value of A falls below; a length
    capacity: Count | None = None  # left out: room for all that can be added

    @model_validator(mode="after")
    def _start_fits(self) -> GrowingSplats:
        if self.capacity is not None and self.capacity < self.initial:
            raise ValueError(f"the capacity of {self.capacity} is less than the {self.initial} splats at first")
        if self.shape < self.min_singular:
            raise ValueError(f"the shape {self.shape} is less than min_singular, {self.min_singular}")
        return self


class ObjectiveChoice(_Part):
    """What is trained for, by its kind alone (see `rsrm_gen.trainer.objectives`)."""

    kind: Literal["paths", "bellman", "eikonal"]

    @model_validator(mode="before")
    @classmethod
    def _kind_alone(cls, value: Any) -> Any:
        return {"kind": value} if isinstance(value, str) else value


class EikonalChoice(ObjectiveChoice):
    """The Eikonal residual with q = |grad T|_g / s: `ratio` is |1 - sqrt q| + |1 - 1 / sqrt q|, `squared` is
    (|grad T|_g - s)^2."""

    residual: Literal["ratio", "squared"] = "ratio"


class _AnyTraining(_Part):
    """What all objectives have."""

    seed: Annotated[int, BeforeValidator(_not_a_bool), Field(ge=0, lt=2**63)] = 1
    dtype: Literal["float32", "float64"] = "float32"
    threads: Count | None = None  # of torch; left out: its own choice
    kernels: Literal["auto", "c", "torch"] | None = None  # what sums splats; left out: RSRM_KERNELS, or what is fastest


POINTS_A_SPLAT = 100  # of fewer, splats become needles between them


class PathsTraining(_AnyTraining):
    """Labels from paths, then Gauss-Newton: the first part on half of the points, the rest on all of them."""

    objective: ObjectiveChoice = ObjectiveChoice(kind="paths")
    link: BasedLink = BasedLink()
    steps: Count = 34  # iterations of Gauss-Newton
    points: Count | None = None  # that get labels; left out: 100 for each splat
    splats: Splats = Splats()
    checkpoint_every: Count = 5  # steps

    @property
    def capacity(self) -> int:
        """How many splats the buffers hold."""
        return self.splats.count

    @property
    def labelled(self) -> int:
        """How many points get labels."""
        return self.points or POINTS_A_SPLAT * self.splats.count


class BellmanTraining(_AnyTraining):
    """Sweeps of the dynamic programming principle, then Gauss-Newton on the costs of the field's own paths."""

    objective: ObjectiveChoice = ObjectiveChoice(kind="bellman")
    link: BasedLink = BasedLink()
    steps: Count = 60  # sweeps
    points: Count = 8_000  # at which each sweep asks for the best step
    reach: Positive = 0.3  # the longest step; a length
    splats: Splats = Splats()
    checkpoint_every: Count = 10  # steps

    @property
    def capacity(self) -> int:
        """How many splats the buffers hold."""
        return self.splats.count


class EikonalTraining(_AnyTraining):
    """The residual at fresh points, by AdamW; the defaults are the paper's recipe."""

    objective: EikonalChoice = EikonalChoice(kind="eikonal")
    link: LinkChoice = LinkChoice()
    steps: Count = 4000
    points: Count = 2048  # fresh points a step, uniform in volume
    learning_rate: Positive = 1e-2
    final_learning_rate: Positive | None = None  # left out: constant; else a half cosine from the first to this one
    weight_decay: Annotated[Number, Field(ge=0)] = 1e-4  # of v and A; a centre has no origin to decay to
    gradient_clip: Positive = 1.0  # the largest norm of the gradient of all parameters together
    splats: GrowingSplats = GrowingSplats()
    goal_exclusion: Annotated[Number, Field(ge=0)] = 0.25  # points nearer to the goal are left out; a length
    checkpoint_every: Count = 500  # steps

    @property
    def last_change(self) -> int:
        """The last step at which splats may come and go: none in the last tenth."""
        return self.steps * 9 // 10

    @property
    def capacity(self) -> int:
        """How many splats the buffers hold."""
        grown = self.splats.initial + self.splats.add * (self.last_change // self.splats.every)
        return self.splats.capacity or grown


def _kind_of(training: Any) -> str:
    objective = training.get("objective") if isinstance(training, dict) else getattr(training, "objective", None)
    kind = objective.get("kind") if isinstance(objective, dict) else getattr(objective, "kind", objective)
    return kind if kind in ("bellman", "eikonal") else "paths"  # whose schema says what else could be meant


Training = PathsTraining | BellmanTraining | EikonalTraining
_Tagged = Annotated[
    Annotated[PathsTraining, Tag("paths")]
    | Annotated[BellmanTraining, Tag("bellman")]
    | Annotated[EikonalTraining, Tag("eikonal")],
    Discriminator(_kind_of),
]


def training_of(settings: Any) -> Training:
    """Training settings from plain data, checked against the schema of their objective."""
    made: Training = TypeAdapter(_Tagged).validate_python(settings)
    return made


class SceneDocument(_Part):
    """A scene file."""

    scene: str
    manifold: ManifoldChoice
    goal: Numbers
    obstacles: list[Obstacle] = []
    forbid_obstacles: bool = False  # whether `rsrm plan` refuses paths that enter one; else they are only slow
    slowness: Slowness = Slowness()
    domain: Domain | None = None
    evaluation: Evaluation = Evaluation()
    picture: Picture = Picture()
    training: _Tagged = PathsTraining()
