"""A finished training as a row of figures: one measure for all methods."""

from __future__ import annotations

import torch
from rich.console import Console

from rsrm_gen.bench.paper.descent import fill, network_arrival
from rsrm_gen.bench.paper.jobs import Job
from rsrm_gen.bench.paper.network import Network
from rsrm_gen.bench.paper.rows import Row
from rsrm_gen.trainer.evaluate import ErrorRow, evaluate_all
from rsrm_gen.trainer.model import ArrivalTime
from rsrm_gen.trainer.objectives.residual import Residual
from rsrm_gen.trainer.planning import planning
from rsrm_gen.trainer.run import Summary, load_run
from rsrm_gen.trainer.scene import Scene
from rsrm_gen.trainer.truth import solve_truth

LOSS_POINTS, LOSS_BATCH = 16384, 4096
LOSS_EXCLUSION = 0.25  # around the goal, as the paper's recipe leaves it out; a length


def judged(job: Job, summary: Summary, others: float | None, console: Console | None = None) -> Row:
    """The row of a job whose training is finished; `others` is what other programs used when it began."""
    scene, arrival = job.scene, trained(job)
    reference = solve_truth(scene, console=console)
    evaluation = evaluate_all(scene, {"field": arrival.time}, reference)
    field, distance = (_row(evaluation.rows, name) for name in ("field", "T = d"))
    plans = planning(arrival, scene, reference.time)
    descents = plans.rows[0]  # of all starts
    return Row(
        method=job.method.key,
        manifold=job.file.manifold,
        seed=job.file.seed,
        loss=residual(scene, arrival),
        milliseconds=summary.ms_per_step,
        seconds=summary.seconds,
        parameters=summary.parameters,
        splats=summary.splats,
        steps=summary.steps,
        error=field.paper,
        rms=field.rms,
        p95=field.p95,
        maximum=field.maximum,
        distance_error=distance.paper,
        reference_error=evaluation.reference_rms,
        reached=descents.reached,
        cost_mean=descents.mean,
        cost_p95=descents.p95,
        microseconds=plans.microseconds,
        threads=torch.get_num_threads(),
        others=others,
    )


def trained(job: Job) -> ArrivalTime:
    """The arrival time that a job's folder holds."""
    if job.network is None:
        return load_run(job.folder.path, job.scene.manifold).arrival
    network = Network(job.scene.manifold, job.network, job.scene.goal.dtype)
    fill(network, job.folder.restore(), job.folder.checkpoint)
    return network_arrival(job.scene, network)


@torch.no_grad()
def residual(scene: Scene, arrival: ArrivalTime) -> float:
    """The mean Eikonal residual of the recipe at fresh points of the domain, the same ones for every method."""
    x = scene.sample(LOSS_POINTS, torch.Generator().manual_seed(0))
    x = x[scene.manifold.distance(x, scene.goal) > LOSS_EXCLUSION]
    kind = Residual(scene, "ratio")
    return float(torch.cat([kind.loss(arrival, part)[1] for part in torch.split(x, LOSS_BATCH)]).mean())


def _row(rows: tuple[ErrorRow, ...], name: str) -> ErrorRow:
    return next(row for row in rows if row.name == name)
