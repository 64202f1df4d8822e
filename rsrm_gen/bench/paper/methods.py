"""What is compared: the paper's recipe, the networks that the paper compares with, our default at three sizes.

A method is a way to write the `training` of a scene file, and for networks the shape of the network.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

from rsrm_gen.bench.paper.published import NetworkShape, published_on
from rsrm_gen.manifold import Manifold

Settings = Mapping[str, Any]
QUICK_STEPS = 400  # of 4000, for the methods that descend the residual


@dataclass(frozen=True)
class Method:
    """A row of the table."""

    key: str
    title: str
    model: Literal["splats", "network"] = "splats"
    share: float | None = (
        None  # of the paper's number of parameters; None: as many as the recipe makes, or the paper's network
    )
    published: Literal["rsrm", "mlp"] | None = None  # whose figures of the paper stand beside it
    recipe: bool = True  # the training as the scene file has it, else our default

    def network(self, manifold: Manifold) -> NetworkShape | None:
        """The network that is trained on a manifold."""
        if self.model == "splats":
            return None
        known = published_on(manifold.name)
        if self.share is None:
            return known.network
        return known.network.shrunk_to(round(self.share * known.rsrm.parameters), manifold.point_size)

    def training(self, written: Settings, manifold: Manifold, seed: int, quick: bool) -> Settings:
        """The `training` of a scene file, from the one `written` there."""
        if self.recipe:
            changes: dict[str, Any] = {"steps": QUICK_STEPS} if quick else {}
            if network := self.network(manifold):
                changes["learning_rate"] = network.learning_rate
            return {**written, **changes}
        assert self.share is not None
        budget = self.share * published_on(manifold.name).rsrm.parameters
        count = int(budget / (1 + manifold.point_size + manifold.dim**2))
        return {"objective": {"kind": "paths"}, "seed": seed, "splats": {"count": count}}


METHODS = (
    Method("recipe", "RSRM, the paper's recipe", published="rsrm"),
    Method("mlp", "MLP, the paper's", model="network", published="mlp"),
    Method("mlp-small", "MLP with the RSRM's parameters", model="network", share=1),
    Method("ours", "ours", share=1, published="rsrm", recipe=False),
    Method("ours-half", "ours, half the parameters", share=1 / 2, recipe=False),
    Method("ours-quarter", "ours, a quarter", share=1 / 4, recipe=False),
)
BY_KEY = {method.key: method for method in METHODS}
QUICK = ("recipe", "mlp", "mlp-small", "ours-quarter")
