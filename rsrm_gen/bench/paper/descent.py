"""The training of a network on a scene: the recipe's residual, link, points, AdamW and clip; only the model differs."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import torch

from rsrm_gen.bench.paper.network import Network
from rsrm_gen.bench.paper.published import NetworkShape
from rsrm_gen.errors import UserError
from rsrm_gen.trainer.arithmetic import BETA1, BETA2, EPSILON
from rsrm_gen.trainer.clock import NO_CLOCK, Clock
from rsrm_gen.trainer.link import make_link
from rsrm_gen.trainer.model import ArrivalTime
from rsrm_gen.trainer.objectives.collocation import Collocation, generator, learning_rate
from rsrm_gen.trainer.objectives.eikonal import FINAL_POINTS, POOL
from rsrm_gen.trainer.objectives.residual import Residual
from rsrm_gen.trainer.run import Arrays
from rsrm_gen.trainer.scene import Scene
from rsrm_gen.trainer.settings import EikonalTraining


class NetworkDescent:
    """An `Objective` of the training loop."""

    def __init__(self, scene: Scene, shape: NetworkShape, clock: Clock = NO_CLOCK) -> None:
        """At step 0; `begin` or `restore` gives the network its weights."""
        settings = scene.training
        assert isinstance(settings, EikonalTraining)
        self.settings = settings
        self.network = Network(scene.manifold, shape, scene.goal.dtype)
        self.arrival = network_arrival(scene, self.network)
        self.residual = Residual(scene, settings.objective.residual)
        self.collocation = Collocation(scene, settings, self.residual, clock)
        self.adam = torch.optim.AdamW(
            self.network.parameters,
            lr=settings.learning_rate,
            betas=(BETA1, BETA2),
            eps=EPSILON,
            weight_decay=settings.weight_decay,
        )
        self.step, self.steps = 0, settings.steps
        self.phase = "descent"

    def begin(self) -> None:
        """Random weights."""
        self.network.begin(generator(self.settings.seed, "splats"))

    def advance(self) -> float:
        """One step: its loss. A loss or gradient that is not finite is a `FloatingPointError`, and nothing moved."""
        points = self.collocation.at_step(self.arrival, self.step)
        f, df = self.network.value_and_gradient(points.x)
        loss = self.residual.given(self.arrival, points, f.detach(), df.detach().contiguous())
        gradients = torch.autograd.grad((f, df), self.network.parameters, (loss.f_bar, loss.df_bar))
        for tensor, gradient in zip(self.network.parameters, gradients, strict=True):
            tensor.grad = gradient
        length = float(torch.nn.utils.clip_grad_norm_(self.network.parameters, self.settings.gradient_clip))
        if not (math.isfinite(loss.mean) and math.isfinite(length)):
            raise FloatingPointError(f"the loss is {loss.mean}, the length of its gradient {length}")
        self.adam.param_groups[0]["lr"] = learning_rate(self.settings, self.step)
        self.adam.step()
        self.step += 1
        return loss.mean

    @torch.no_grad()
    def final_loss(self) -> float:
        """The mean residual at many fresh points."""
        x = self.collocation.fresh(FINAL_POINTS, "final loss", self.step)
        return float(torch.cat([self.residual.loss(self.arrival, part)[1] for part in torch.split(x, POOL)]).mean())

    def arrays(self) -> Arrays:
        """Everything that changes, as plain arrays."""
        arrays: Arrays = {"step": np.array(self.step)}
        for i, tensor in enumerate(self.network.parameters):
            state = self.adam.state.get(tensor) or {}
            arrays[f"parameters{i}"] = tensor.detach().numpy()
            arrays |= {f"{name}{i}": state[name].numpy() for name in ("exp_avg", "exp_avg_sq") if name in state}
        return arrays

    def restore(self, arrays: Arrays, path: Path) -> None:
        """Go back to what `arrays` gave; it was read from `path`."""
        self.step = int(arrays["step"])
        fill(self.network, arrays, path)
        for i, tensor in enumerate(self.network.parameters if self.step else ()):
            state = {name: torch.from_numpy(arrays[f"{name}{i}"]) for name in ("exp_avg", "exp_avg_sq")}
            self.adam.state[tensor] = {"step": torch.tensor(float(self.step)), **state}


def network_arrival(scene: Scene, network: Network) -> ArrivalTime:
    """T = d / tau, tau from the network by the scene's link."""
    return ArrivalTime(network, make_link(scene.training.link), scene.manifold, scene.goal)


@torch.no_grad()
def fill(network: Network, arrays: Arrays, path: Path) -> None:
    """Give a network the weights of a checkpoint that was read from `path`."""
    for i, tensor in enumerate(network.parameters):
        stored = arrays.get(f"parameters{i}")
        if stored is None or stored.shape != tensor.shape:
            raise UserError(f"{path} holds another network than the one that is trained")
        tensor.copy_(torch.from_numpy(stored))
