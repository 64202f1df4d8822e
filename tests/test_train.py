"""The training loop: that it trains, that it repeats, that it goes on exactly, and what it does when it cannot."""

from __future__ import annotations

import signal
from pathlib import Path

import numpy as np
import pytest
import torch
from plain_manifolds import PLAIN
from scenes import random_field, seeded, small_scene
from small_runs import interrupted_after, new_run, same

from rsrm_gen.errors import UserError
from rsrm_gen.trainer.objectives.eikonal import Eikonal
from rsrm_gen.trainer.objectives.residual import Residual
from rsrm_gen.trainer.optimise import AdamW
from rsrm_gen.trainer.run import Metric
from rsrm_gen.trainer.train import train

# Changes at steps 10, 20 and 30 of 40: the interruption at 15 lies between two of them.
SHORT = "{steps: 40, points: 64, checkpoint_every: 15, splats: {initial: 8, add: 4, every: 10, prune_below: 0.02}}"


@pytest.mark.parametrize("name", PLAIN)
def test_training_lowers_the_residual(tmp_path: Path, name: str) -> None:
    scene = small_scene(tmp_path, name, "{steps: 60, points: 128, splats: {initial: 12, shape: 0.6}}")
    trainer = Eikonal(scene)
    trainer.begin()
    x = scene.sample(500, seeded())
    before = Residual(scene).loss(trainer.arrival, x)[1].mean()
    for _ in range(60):
        trainer.advance()
    assert Residual(scene).loss(trainer.arrival, x)[1].mean() < 0.8 * before


def test_a_training_that_was_interrupted_goes_on_exactly(tmp_path: Path) -> None:
    scene = small_scene(tmp_path, "S2", SHORT)
    straight, broken = new_run(scene, tmp_path / "straight"), new_run(scene, tmp_path / "broken")
    train(scene, straight)

    stopped = interrupted_after(15, scene, broken)
    assert (stopped.step, stopped.summary) == (15, None)
    resumed = train(scene, broken, resume=True)
    assert resumed.summary is not None

    assert same(straight.restore(), broken.restore())
    losses = [[(m.step, m.loss, m.splats) for m in folder.read_metrics()] for folder in (straight, broken)]
    assert losses[0] == losses[1]
    assert [step for step, _, _ in losses[0]] == [10, 20, 30, 40]
    assert len({splats for _, _, splats in losses[0]}) > 1


def test_steps_past_the_checkpoint_are_forgotten_and_made_again(tmp_path: Path) -> None:
    scene = small_scene(tmp_path, "T2", SHORT)
    straight, crashed = new_run(scene, tmp_path / "straight"), new_run(scene, tmp_path / "crashed")
    train(scene, straight)

    def crash(metric: Metric) -> None:
        if metric.step == 25:
            raise RuntimeError("the power went")

    with pytest.raises(RuntimeError, match="power"):
        train(scene, crashed, progress=crash)
    assert int(crashed.restore()["step"]) == 15
    assert crashed.read_metrics()[-1].step == 20
    train(scene, crashed, resume=True)
    assert same(straight.restore(), crashed.restore())
    assert [m.step for m in crashed.read_metrics()] == [10, 20, 30, 40]


def test_ctrl_c_ends_after_the_step_and_is_a_normal_one_again_afterwards(tmp_path: Path) -> None:
    before = signal.getsignal(signal.SIGINT)
    scene = small_scene(tmp_path, "R2", SHORT)
    folder = new_run(scene, tmp_path / "run")
    assert interrupted_after(7, scene, folder).step == 7
    assert int(folder.restore()["step"]) == 7
    assert signal.getsignal(signal.SIGINT) is before


def test_the_seed_decides_everything(tmp_path: Path) -> None:
    scene = small_scene(tmp_path, "T2", SHORT)
    folders = [new_run(scene, tmp_path / name) for name in ("a", "b", "c")]
    for folder, seed in zip(folders, (1, 1, 2), strict=True):
        train(scene.with_training(seed=seed), folder)
    a, b, c = (folder.restore() for folder in folders)
    assert same(a, b)
    assert not same(a, c)


def test_a_loss_that_is_not_finite_names_its_step_and_keeps_the_last_checkpoint(tmp_path: Path) -> None:
    scene = small_scene(tmp_path, "T2", SHORT)
    folder = new_run(scene, tmp_path / "run")
    losses: list[float] = []

    def spoil(metric: Metric) -> None:
        losses.append(metric.loss)
        if metric.step == 17:
            scene.radii.fill_(float("nan"))

    with pytest.raises(UserError, match="step 33: the loss is nan") as caught:
        train(scene, folder, progress=spoil)
    assert "the checkpoint in" in str(caught.value)
    assert len(losses) == 32  # the points of steps 17 to 32 had been drawn
    arrays = folder.restore()
    assert int(arrays["step"]) == 30
    assert all(np.isfinite(rows).all() for rows in arrays.values())


def test_a_gradient_that_is_not_finite_moves_nothing(tmp_path: Path) -> None:
    scene = small_scene(tmp_path, "H2")
    field = random_field(scene.manifold, scene.sample(4, seeded()), seeded(1))
    gradient = torch.ones(1 + 4 + 2, 4, dtype=torch.float64)
    gradient[0, 1] = float("inf")
    before = {name: rows.clone() for name, rows in field.buffers_of_splats().items()}
    with pytest.raises(FloatingPointError):
        AdamW(field, 0.0, 1.0).step(gradient, 0.1)
    assert all(torch.equal(rows, before[name]) for name, rows in field.buffers_of_splats().items())


def test_the_summary_says_what_was_trained(tmp_path: Path) -> None:
    scene = small_scene(tmp_path, "S2", SHORT)
    folder = new_run(scene, tmp_path / "run")
    outcome = train(scene, folder)
    summary = folder.read_summary()
    assert summary == outcome.summary
    assert summary is not None
    assert summary.steps == 40
    assert summary.splats == len(folder.restore()["v"])
    assert summary.parameters == summary.splats * (1 + 3 + 4)
    assert 0 < summary.loss < 1
    assert summary.ms_per_step == pytest.approx(1000 * summary.seconds / 40, abs=0.05)


def test_no_point_near_the_goal_is_trained_on(tmp_path: Path) -> None:
    scene = small_scene(tmp_path, "H2", "{goal_exclusion: 1.0}")
    x = Eikonal(scene).points(500, "points")
    assert scene.manifold.distance(x, scene.goal).min() > 1
    assert 0 < len(x) < 500
    with pytest.raises(UserError, match="no point of the domain is farther than 3"):
        Eikonal(small_scene(tmp_path, "H2", "{goal_exclusion: 3}")).points(50, "points")


def test_the_learning_rate_falls_to_its_final_value(tmp_path: Path) -> None:
    trainer = Eikonal(small_scene(tmp_path, "R2", "{steps: 100, learning_rate: 0.02, final_learning_rate: 0.001}"))
    rates = []
    for trainer.step in (0, 50, 100):
        rates.append(trainer.learning_rate())
    assert rates == pytest.approx([0.02, 0.0105, 0.001])
    assert Eikonal(small_scene(tmp_path, "R2")).learning_rate() == 0.01


def test_adam_is_torchs_where_nothing_is_curved(tmp_path: Path) -> None:
    """On v and A, and on flat centres without decay, a step is one of torch.optim.AdamW."""
    scene = small_scene(tmp_path, "R2")
    field = random_field(scene.manifold, scene.sample(5, seeded()), seeded(1))
    adam = AdamW(field, 0.01, 1e9)
    copies = {name: rows[:5].clone().requires_grad_() for name, rows in field.buffers_of_splats().items()}
    groups = [
        {"params": [copies["v"], copies["A"]], "weight_decay": 0.01},
        {"params": [copies["mu"]], "weight_decay": 0.0},
    ]
    torchs = torch.optim.AdamW(groups, lr=0.03)
    for seed in range(4):
        gradient = torch.randn(1 + 4 + 2, 5, generator=seeded(seed), dtype=torch.float64)
        copies["v"].grad, copies["mu"].grad = gradient[0], gradient[5:].T
        copies["A"].grad = gradient[1:5].T.reshape(5, 2, 2)
        torchs.step()
        adam.step(gradient, 0.03)
    for name in ("v", "mu", "A"):
        assert torch.allclose(field.buffers_of_splats()[name][:5], copies[name].detach(), rtol=1e-10, atol=1e-12), name
