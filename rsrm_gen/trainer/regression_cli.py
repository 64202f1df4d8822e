"""`rsrm fit`: learn a function on a manifold from a file of samples, and evaluate it afterwards."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console

from rsrm_gen.errors import UserError
from rsrm_gen.files import assignments
from rsrm_gen.trainer.progress import show_progress
from rsrm_gen.trainer.regression import Regression, Report, create, predict, regress, stored
from rsrm_gen.trainer.run import RunFolder
from rsrm_gen.trainer.samples import read_samples

INTERRUPTED = 130  # what shells expect of a program ended by Ctrl-C


def fit(
    data: Annotated[
        Path | None, typer.Argument(metavar="DATA", help="Samples: .csv with a header, or .npz with x and value.")
    ] = None,
    manifold: Annotated[str | None, typer.Option("-m", "--manifold", help="A bundled manifold or its file.")] = None,
    parameter: Annotated[
        list[str] | None, typer.Option("-p", "--parameter", metavar="NAME=VALUE", help="A parameter of the manifold.")
    ] = None,
    output: Annotated[Path | None, typer.Option("-o", metavar="PATH", help="Folder to write; runs/DATA.")] = None,
    splats: Annotated[int | None, typer.Option(min=1, help="As many as the samples can tell apart.")] = None,
    iterations: Annotated[int | None, typer.Option(min=1, help="Of Gauss-Newton; 30.")] = None,
    held_out: Annotated[float | None, typer.Option(help="Share of the samples kept back to judge by; 0.2.")] = None,
    seed: Annotated[int | None, typer.Option(min=0, help="Of what is kept back; 1.")] = None,
    dtype: Annotated[str | None, typer.Option(help="float32 or float64.")] = None,
    resume: Annotated[Path | None, typer.Option(metavar="RUN", help="Go on with an interrupted fit.")] = None,
    predict_by: Annotated[
        Path | None, typer.Option("--predict", metavar="RUN", help="Evaluate a fit at the points of DATA, into -o.")
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace what is already there.")] = False,
) -> None:
    """Learn a function on a manifold from samples, or evaluate one that was learnt.

    A .csv has a header: the numbers of a point, then `value`, and `weight` where rows differ in it. A .npz has the arrays x
    (N, D), value (N) and perhaps weight (N).

    \b
    rsrm fit samples.csv --manifold manifold.yaml -p n=5
    rsrm fit --resume runs/samples
    rsrm fit points.csv --predict runs/samples -o values.csv
    """
    given = {"iterations": iterations, "held_out": held_out, "seed": seed, "splats": splats, "dtype": dtype}
    chosen = {name: value for name, value in given.items() if value is not None}
    console = Console()
    if predict_by is not None:
        if data is None or output is None or manifold or parameter or resume or chosen:
            raise UserError(
                "--predict RUN takes points and -o FILE alone", hint="rsrm fit points.csv --predict RUN -o FILE"
            )
        count = predict(predict_by, data, output)
        console.print(f"{count} values in {output}", highlight=False, markup=False)
        return
    if resume is not None:
        if data or manifold or parameter or output or force or chosen:
            raise UserError("--resume RUN takes everything else from the run")
        settings, folder = _resumed(resume), RunFolder(resume)
    else:
        settings, folder = _new(data, manifold, parameter, output, chosen, force)
    _run(settings, folder, resume is not None, console)


def _new(
    data: Path | None,
    manifold: str | None,
    parameter: list[str] | None,
    output: Path | None,
    chosen: dict[str, Any],
    force: bool,
) -> tuple[Regression, RunFolder]:
    if data is None or manifold is None:
        raise UserError("which samples, on which manifold?", hint="rsrm fit DATA --manifold MANIFOLD")
    # Kept as they are found from anywhere.
    spec = str(Path(manifold).resolve()) if Path(manifold).suffix in (".yaml", ".yml") else manifold
    settings = replace(Regression(spec, str(data.resolve()), assignments(parameter or [])), **chosen)
    if not 0 <= settings.held_out < 1:
        raise UserError(f"--held-out {settings.held_out:g}: a share from 0 to below 1")
    if settings.dtype not in ("float32", "float64"):
        raise UserError(f"--dtype {settings.dtype}: float32 or float64")
    folder = RunFolder(output or Path("runs") / data.stem)
    read_samples(data, settings.load())  # before anything is written
    create(folder, settings, settings.load(), force)
    return settings, folder


def _resumed(run: Path) -> Regression:
    folder = RunFolder(run)
    settings, _ = stored(folder, with_data=True)
    if int(folder.restore()["step"]) >= settings.iterations:
        raise UserError(f"{run} is fitted: it has made all of its {settings.iterations} iterations")
    return settings


def _run(settings: Regression, folder: RunFolder, resume: bool, console: Console) -> None:
    manifold = settings.load()
    samples = read_samples(Path(settings.data), manifold)
    console.print(f"{len(samples.x)} samples on {manifold.name}, into {folder.path}", highlight=False, markup=False)
    first = int(folder.restore()["step"]) if resume else 0
    try:
        with show_progress(console, first, settings.iterations) as (progress, _):
            report = regress(samples, manifold, settings, folder, resume, progress)
    except KeyboardInterrupt:
        if not folder.checkpoint.exists():
            raise
        typer.echo(f"stopped; all finished iterations are kept: rsrm fit --resume {folder.path}")
        raise typer.Exit(INTERRUPTED) from None
    _say(console, report)


def _say(console: Console, report: Report) -> None:
    size = f"{report.splats} splats ({report.parameters} numbers)"
    console.print(f"RMS {report.rms:.4g} on {report.samples} samples, {size}, {report.seconds:.1f} s", highlight=False)
    if report.held_out_rms is not None:
        errors = f"RMS {report.held_out_rms:.4g}, max {report.held_out_max:.4g}, R^2 {report.r_squared:.6f}"
        console.print(f"{errors} on {report.held_out} samples kept back", highlight=False)
