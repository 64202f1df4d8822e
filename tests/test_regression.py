"""`rsrm fit`: a function is learnt from samples, judged on others, evaluated again, and what is wrong with a file is said."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
import torch
from scenes import seeded
from torch import Tensor

import rsrm_gen
from rsrm_gen.errors import UserError
from rsrm_gen.trainer import cli
from rsrm_gen.trainer.regression import Regression, create, load_function, regress
from rsrm_gen.trainer.run import Metric, RunFolder
from rsrm_gen.trainer.samples import read_samples


def function(x: Tensor) -> Tensor:
    """The same for a unit quaternion and its negative, as a function of rotations is; not linear in anything."""
    return 3 + torch.sin(2 * x[:, 0] * x[:, 1]) + (x[:, 0] * x[:, -1]) ** 2


def write_npz(path: Path, name: str, count: int, seed: int = 0) -> Path:
    x = rsrm_gen.load(name).sample(count, seeded(seed), like=torch.zeros(1, dtype=torch.float64))
    np.savez(path, x=x.numpy(), value=function(x).numpy())
    return path


def write_csv(path: Path, rows: list[str], header: str = "x,y,z,value") -> Path:
    path.write_text("\n".join([header, *rows]) + "\n")
    return path


def run(*arguments: object) -> None:
    cli.main([str(argument) for argument in arguments])


@pytest.fixture(autouse=True)
def _in_a_folder_of_its_own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize(("name", "within"), [("sphere", 4e-3), ("so3", 2e-2)])
def test_a_function_is_learnt_and_found_on_samples_kept_back(tmp_path: Path, name: str, within: float) -> None:
    data = write_npz(tmp_path / "data.npz", name, 3000)
    with pytest.raises(SystemExit) as ended:
        run("fit", data, "--manifold", name, "--splats", 40, "--iterations", 12)
    assert ended.value.code == 0
    summary = json.loads((tmp_path / "runs/data/summary.json").read_text())
    assert summary["held_out"] == 600
    assert summary["held_out_rms"] < within
    assert summary["r_squared"] > 1 - (within / 0.3) ** 2
    fresh = np.load(write_npz(tmp_path / "fresh.npz", name, 500, seed=1))
    error = load_function(tmp_path / "runs/data")(torch.from_numpy(fresh["x"])).double() - torch.from_numpy(
        fresh["value"]
    )
    assert float(error.square().mean().sqrt()) < 2 * summary["held_out_rms"]


def test_a_fit_is_evaluated_at_the_points_of_a_file(tmp_path: Path) -> None:
    data = write_npz(tmp_path / "data.npz", "sphere", 300)
    with pytest.raises(SystemExit):
        run("fit", data, "-m", "sphere", "--iterations", 2, "-o", "here")
    points = write_csv(tmp_path / "points.csv", ["0,0.6,0.8", "1,0,0"], header="a,b,c")
    with pytest.raises(SystemExit) as ended:
        run("fit", points, "--predict", "here", "-o", "values.csv")
    assert ended.value.code == 0
    found = np.loadtxt(tmp_path / "values.csv", delimiter=",", skiprows=1)
    assert (tmp_path / "values.csv").read_text().startswith("x1,x2,x3,value\n")
    expected = load_function(tmp_path / "here")(torch.tensor([[0, 0.6, 0.8], [1, 0, 0]]))
    np.testing.assert_allclose(found[:, 3], expected.numpy(), rtol=1e-6)


def test_an_interrupted_fit_goes_on_exactly(tmp_path: Path) -> None:
    data = write_npz(tmp_path / "data.npz", "sphere", 400)
    settings = Regression("sphere", str(data), splats=12, iterations=6)
    manifold = settings.load()
    samples = read_samples(data, manifold)

    def interrupt(metric: Metric) -> None:
        if metric.step == 3:
            raise KeyboardInterrupt

    whole, broken = RunFolder(tmp_path / "whole"), RunFolder(tmp_path / "broken")
    for folder in (whole, broken):
        create(folder, settings, manifold)
    regress(samples, manifold, settings, whole)
    with pytest.raises(KeyboardInterrupt):
        regress(samples, manifold, settings, broken, progress=interrupt)
    with pytest.raises(SystemExit) as ended:
        run("fit", "--resume", broken.path)
    assert ended.value.code == 0
    for name, array in whole.restore().items():
        assert name == "seconds" or (array == broken.restore()[name]).all(), name
    assert [metric.step for metric in broken.read_metrics()] == [1, 2, 3, 4, 5, 6]


WRONG = [
    (["1,0,0,1", "0,1,0,two"], "x,y,z,value", ":3:7: error: `two` is not a number"),
    (["1,0,0,1", "", "0,1,1,2"], "x,y,z,value", ":4:1: error: the point is not on sphere"),
    (["1,0,0,1", "0,1,2"], "x,y,z,value", ":3:1: error: 3 numbers; the header names 4"),
    (["1,0,0,nan"], "x,y,z,value", ":2:1: error: value is not finite"),
    (["1,0,0,1,-1"], "x,y,z,value,weight", ":2:1: error: the weight -1 is negative"),
    (["1,0,0"], "x,y,z", ":1:1: error: there is no column `value`"),
    (["1,0,0"], "x,y,value", ":1:1: error: 2 columns beside `value` and `weight`; a point of sphere has 3 numbers"),
    (["1,0,0,1"], "0,1,0,2", ":1:1: error: the first line must name the columns"),
    (["1,0,0,1"], "x,x,y,value", ":1:1: error: the column `x` is there twice"),
]


@pytest.mark.parametrize(("rows", "header", "message"), WRONG)
def test_what_is_wrong_with_a_table_is_said_with_its_line(
    tmp_path: Path, rows: list[str], header: str, message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    data = write_csv(tmp_path / "data.csv", rows, header)
    with pytest.raises(SystemExit) as ended:
        run("fit", data, "--manifold", "sphere")
    assert ended.value.code == 2
    assert f"{data}{message}" in capsys.readouterr().err
    assert not (tmp_path / "runs").exists()


@pytest.mark.parametrize(
    ("arrays", "message"),
    [
        ({"x": np.eye(3)}, "no array `value`"),
        ({"x": np.eye(4), "value": np.ones(4)}, "`x` has the shape (4, 4); points of sphere make it (N, 3)"),
        ({"x": np.eye(3), "value": np.ones(2)}, "`value` has the shape (2,); with 3 points it is (3,)"),
        ({"x": 2 * np.eye(3), "value": np.ones(3)}, "row 0: the point is not on sphere"),
        ({"x": np.full((3, 3), np.nan), "value": np.ones(3)}, "row 0: the point is not finite"),
        ({"x": np.eye(3), "value": np.ones(3)}, "has 3 samples: too few to learn from"),
    ],
)
def test_what_is_wrong_with_arrays_is_said(
    tmp_path: Path, arrays: dict[str, np.ndarray], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    np.savez(tmp_path / "data.npz", **arrays)  # type: ignore[arg-type]
    with pytest.raises(SystemExit) as ended:
        run("fit", tmp_path / "data.npz", "--manifold", "sphere")
    assert ended.value.code == 2
    assert message in capsys.readouterr().err


def test_periodic_coordinates_may_be_written_with_full_turns(tmp_path: Path) -> None:
    data = write_csv(tmp_path / "data.csv", ["7,0,1", "-5,1,2"], header="a,b,value")
    samples = read_samples(data, rsrm_gen.load("torus"))
    assert float(samples.x.abs().max()) <= 3.1416
    assert samples.value is not None
    assert samples.value.tolist() == [1, 2]


def test_a_run_with_other_samples_is_not_gone_on_with(tmp_path: Path) -> None:
    data = write_npz(tmp_path / "data.npz", "sphere", 100)
    settings = Regression("sphere", str(data), splats=4, iterations=2)
    folder = RunFolder(tmp_path / "run")
    create(folder, settings, settings.load())
    write_npz(data, "sphere", 101)
    with pytest.raises(SystemExit) as ended:
        run("fit", "--resume", folder.path)
    assert ended.value.code == 2
    folder.save({"v": np.zeros(1)})
    with pytest.raises(UserError, match="already holds"):
        create(folder, settings, settings.load())
