"""What a field is trained for: three objectives behind one interface, which the training loop drives step by step.

paths     labels from paths, then Gauss-Newton on the splats: T becomes the arrival time; the default
bellman   T(x) = min over u of T(Exp_x(h u)) + the cost of getting there, swept until it holds
eikonal   the residual of |grad T|_g = s, as in the RSRM paper; small residuals do not make T the arrival time
"""

from __future__ import annotations

from rsrm_gen.trainer.clock import NO_CLOCK, Clock
from rsrm_gen.trainer.objectives.bellman import Bellman
from rsrm_gen.trainer.objectives.eikonal import Eikonal
from rsrm_gen.trainer.objectives.objective import Objective, Tell
from rsrm_gen.trainer.objectives.paths import Paths
from rsrm_gen.trainer.scene import Scene
from rsrm_gen.trainer.settings import BellmanTraining, EikonalTraining

__all__ = ["Objective", "Tell", "make_objective"]


def make_objective(scene: Scene, clock: Clock = NO_CLOCK, tell: Tell = lambda what, part: None) -> Objective:
    """The objective that the scene's settings name, at step 0 and without splats."""
    if isinstance(scene.training, BellmanTraining):
        return Bellman(scene, tell)
    if isinstance(scene.training, EikonalTraining):
        return Eikonal(scene, clock)
    return Paths(scene, tell)
