"""`rsrm`: train an arrival-time field on a scene, judge it, plan with it."""

from __future__ import annotations

import json
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import torch
import typer
from rich.console import Console
from rich.table import Table

import rsrm_gen
from rsrm_gen.bench.cli import app as bench
from rsrm_gen.errors import UserError
from rsrm_gen.load import CHOICES
from rsrm_gen.trainer.clock import StopWatch, table
from rsrm_gen.trainer.plan import Paths, plan
from rsrm_gen.trainer.progress import show_progress
from rsrm_gen.trainer.regression_cli import fit
from rsrm_gen.trainer.run import Run, RunFolder, load_run
from rsrm_gen.trainer.scene import Scene, read_scene
from rsrm_gen.trainer.train import Outcome, train

INTERRUPTED = 130  # what shells expect of a program ended by Ctrl-C

app = typer.Typer(
    name="rsrm",
    no_args_is_help=True,
    add_completion=False,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    help="Train arrival-time fields on Riemannian manifolds and plan with them.\n\n"
    "A scene file names a manifold, a goal and obstacles:\n\n"
    "\b\n"
    "  rsrm train scene.yaml                 train into runs/scene\n"
    "  rsrm figure runs/scene -o field.pdf   the field as a figure\n"
    "  rsrm report runs/scene                all of it on a page that can be turned: runs/scene/report.html\n"
    "  rsrm eval runs/scene                  errors against a reference solution\n"
    "  rsrm plan runs/scene --from 1.0,2.0   a path to the goal and its true cost\n"
    "  rsrm fit samples.csv -m MANIFOLD      any function on a manifold, from samples",
)

app.add_typer(bench, name="bench")
app.command("fit")(fit)

RunArgument = Annotated[Path, typer.Argument(metavar="RUN", help="A folder that `rsrm train` made.")]


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"rsrm {rsrm_gen.__version__}")
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[bool, typer.Option("--version", callback=_version, is_eager=True, help="Say which.")] = False,
) -> None:
    pass


@app.command("train")
def _train(
    scene: Annotated[Path | None, typer.Argument(metavar="SCENE", help="A scene file (YAML).")] = None,
    output: Annotated[Path | None, typer.Option("-o", metavar="RUN", help="Folder to write; runs/SCENE.")] = None,
    steps: Annotated[int | None, typer.Option(help="Steps in all, instead of the scene's.")] = None,
    seed: Annotated[int | None, typer.Option(help="Random seed, instead of the scene's.")] = None,
    resume: Annotated[Path | None, typer.Option(metavar="RUN", help="Go on with an interrupted training.")] = None,
    kernels: Annotated[str | None, typer.Option(help="What sums splats: c, torch or auto.")] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace a training that is already there.")] = False,
    no_picture: Annotated[bool, typer.Option("--no-picture", help="Draw nothing at the end.")] = False,
) -> None:
    """Train a field: progress, checkpoint, report, picture.

    \b
    rsrm train scene.yaml
    rsrm train scene.yaml -o runs/first --steps 500
    rsrm train --resume runs/first
    """
    if resume is not None:
        folder, prepared = _resumed(resume, scene, output, steps, seed, kernels)
    elif scene is not None:
        folder, prepared = _new(scene, output, steps, seed, kernels, force)
    else:
        raise UserError("which scene?", hint="rsrm train SCENE, or rsrm train --resume RUN")
    if prepared.training.threads:
        torch.set_num_threads(prepared.training.threads)
    console = Console()
    console.print(f"{prepared.title}: {prepared.manifold.name}, into {folder.path}", highlight=False, markup=False)
    console.print(f"kernels: {prepared.manifold.kernels(prepared.goal)}", highlight=False, markup=False)
    first = int(folder.restore()["step"]) if resume else 0
    with show_progress(console, first, prepared.training.steps) as (progress, tell):
        outcome = train(prepared, folder, resume is not None, progress, tell)
    _report(console, folder, prepared, outcome)
    if not no_picture:
        _picture(console, folder.path)


@bench.command("step")
def _step(
    scene: Annotated[Path, typer.Argument(metavar="SCENE", help="A scene file (YAML).")],
    points: Annotated[int, typer.Option(min=1, help="Points a step.")] = 2048,
    splats: Annotated[int, typer.Option(min=1, help="Splats, the same at every step.")] = 512,
    steps: Annotated[int, typer.Option(min=1, help="Steps that are measured.")] = 400,
) -> None:
    """Where the time of a training step goes: the median of every phase, and the share outside the sum of splats.

    \b
    rsrm bench step scene.yaml
    rsrm bench step scene.yaml --points 4096 --splats 128
    """
    prepared = read_scene(scene)
    fixed = {**prepared.training.splats.model_dump(), "initial": splats, "capacity": splats, "add": 0, "prune_below": 0}
    warm = min(steps, 50)
    prepared = prepared.with_training(points=points, splats=fixed, steps=warm + steps)
    if prepared.training.threads:
        torch.set_num_threads(prepared.training.threads)
    watch = StopWatch(warm)
    with tempfile.TemporaryDirectory() as folder:
        run = RunFolder(Path(folder))
        run.create(prepared)
        train(prepared, run, clock=watch)
    console = Console()
    threads = torch.get_num_threads()
    console.print(f"{prepared.manifold.name}: {points} points, {splats} splats, {threads} threads", highlight=False)
    console.print(table(watch))


def _new(
    path: Path, output: Path | None, steps: int | None, seed: int | None, kernels: str | None, force: bool
) -> tuple[RunFolder, Scene]:
    scene = _with_options(read_scene(path), steps, seed, kernels)
    folder = RunFolder(output or Path("runs") / path.stem)
    folder.create(scene, force)
    return folder, scene


def _resumed(
    run: Path,
    scene: Path | None,
    output: Path | None,
    steps: int | None,
    seed: int | None,
    kernels: str | None,
) -> tuple[RunFolder, Scene]:
    if scene or output or seed is not None:
        raise UserError(
            "--resume RUN takes its scene, folder and seed from the run", hint="only --steps and --kernels may be given"
        )
    folder = RunFolder(run)
    resumed = _with_options(folder.read_scene(), steps, None, kernels)
    stored = folder.restore()
    done, splats = int(stored["step"]), len(stored["v"])
    if splats > resumed.training.capacity:
        hint = "train it with more steps"
        raise UserError(
            f"{run} has {splats} splats; so few steps leave room for {resumed.training.capacity}", hint=hint
        )
    if done >= resumed.training.steps:
        hint = f"train it further with `--resume {run} --steps {2 * done}`"
        raise UserError(f"{run} is trained: it has made {done} of {resumed.training.steps} steps", hint=hint)
    folder.write_settings(resumed)
    return folder, resumed


def _with_options(scene: Scene, steps: int | None, seed: int | None, kernels: str | None) -> Scene:
    if steps is not None and steps < 1:
        raise UserError("--steps must be at least 1")
    if seed is not None and not 0 <= seed < 2**63:
        raise UserError("--seed must be at least 0 and less than 2^63")
    if kernels not in (None, *CHOICES):
        raise UserError(f"--kernels {kernels}: one of {', '.join(CHOICES)}")
    given = {"steps": steps, "seed": seed, "kernels": kernels}
    scene = scene.with_training(**{name: value for name, value in given.items() if value is not None})
    return scene.with_kernels(scene.training.kernels) if scene.training.kernels else scene


def _report(console: Console, folder: RunFolder, scene: Scene, outcome: Outcome) -> None:
    s = outcome.summary
    if s is None:
        typer.echo(f"stopped after step {outcome.step} of {scene.training.steps}; all of it is kept in {folder.path}")
        typer.echo(f"go on with: rsrm train --resume {folder.path}")
        raise typer.Exit(INTERRUPTED)
    size = f"{s.splats} splats ({s.parameters} numbers)"
    console.print(f"loss {s.loss:.5f}, {size}, {s.ms_per_step:.2f} ms a step, {s.seconds:.0f} s", highlight=False)


def _picture(console: Console, run: Path) -> None:
    try:
        with _extra("the picture", "pictures"):
            from rsrm_gen.trainer.picture import draw_run

            console.print(f"picture: {draw_run(run)}", highlight=False, soft_wrap=True, markup=False)
    except UserError as error:  # the training is done and kept: no reason to fail
        typer.echo(str(error), err=True)


@app.command("eval")
def _eval(
    run: RunArgument,
    with_fitted: Annotated[
        bool, typer.Option("--fitted/--no-fitted", help="Also the model fitted to the reference.")
    ] = True,
) -> None:
    """Judge a field by a reference solution, beside what no training at all would give, and what so many splats could hold.

    \b
    rsrm eval runs/scene
    """
    console = Console()
    with _extra("a reference solution", "reference"):
        from rsrm_gen.trainer.evaluate import evaluate_run, print_evaluation

        print_evaluation(evaluate_run(run, console, with_fitted=with_fitted), console)


@app.command("plan")
def _plan(
    run: RunArgument,
    starts: Annotated[list[str], typer.Option("--from", metavar="POINT", help="A start; may be given again.")],
    step: Annotated[float, typer.Option(help="Step length of the descent, in the metric.")] = 0.02,
    output: Annotated[Path | None, typer.Option("-o", metavar="FILE", help="Write the paths as JSON.")] = None,
) -> None:
    """Follow a field to its goal and say what each path truly costs.

    \b
    rsrm plan runs/scene --from '[1.0, 2.0]'
    rsrm plan runs/scene --from 1.0,2.0 --from 0.5,-2 -o paths.json
    """
    if not 0 < step < float("inf"):
        raise UserError("--step must be a positive length")
    loaded = load_run(run)
    paths = plan(loaded.arrival, loaded.scene, torch.stack([_start(loaded, text) for text in starts]), step)
    Console().print(_table(starts, paths))
    if output:
        _write_paths(output, starts, paths)
    if not bool(paths.reached.all()):
        typer.echo("not every path reached the goal: the field's T has a valley elsewhere", err=True)
        raise typer.Exit(1)
    if bool(paths.refused.any()):
        typer.echo("a path leads through an obstacle, which the scene forbids; it is refused", err=True)
        raise typer.Exit(1)


def _start(run: Run, text: str) -> torch.Tensor:
    try:
        numbers = [float(part) for part in text.strip("[]() ").replace(",", " ").split()]
    except ValueError:
        raise UserError(f"--from {text}: not a list of numbers", hint="write it as --from '[0.1, 0.2]'") from None
    point = run.scene.point(numbers, f"--from {text}")
    if not run.scene.inside_domain(point):
        raise UserError(f"--from {text}: lies outside the scene's domain")
    return point


def _table(starts: Sequence[str], paths: Paths) -> Table:
    table = Table(box=None, pad_edge=False, header_style="dim")
    for heading in ("from", "T by the field", "true cost", "length", "clearance", "reaches the goal"):
        table.add_column(heading, justify="left" if heading == "from" else "right", no_wrap=True)
    columns = (paths.value, paths.cost, paths.length, paths.clearance)
    for i, start in enumerate(starts):
        said = "yes, through an obstacle" if paths.entered[i] else "yes"
        if paths.refused[i]:
            said = "refused: through an obstacle"
        if not paths.reached[i]:
            said = "no"
        table.add_row(start.replace("[", r"\["), *[f"{float(column[i]):.4f}" for column in columns], said)
    return table


def _write_paths(file: Path, starts: Sequence[str], paths: Paths) -> None:
    rows = [
        {
            "from": start,
            "reached": bool(paths.reached[i]),
            "entered_obstacle": bool(paths.entered[i]),
            "refused": bool(paths.refused[i]),
            "time_by_field": float(paths.value[i]),
            "cost": float(paths.cost[i]) if paths.reached[i] else None,
            "length": float(paths.length[i]),
            "clearance": float(paths.clearance[i]) if torch.isfinite(paths.clearance[i]) else None,
            "points": None if paths.refused[i] else paths.points[i].tolist(),
        }
        for i, start in enumerate(starts)
    ]
    try:
        file.write_text(json.dumps(rows, indent=1) + "\n")
    except OSError as error:
        raise UserError(f"cannot write {file}: {error.strerror}") from None


@app.command("figure")
def _figure(
    run: RunArgument,
    output: Annotated[Path | None, typer.Option("-o", metavar="FILE", help="A .pdf, .png or .svg file.")] = None,
    paths: Annotated[int, typer.Option(min=0, help="Paths to draw, from starts far apart.")] = 6,
) -> None:
    """Draw a field as a figure: the surface in space, and flat, with level lines, obstacles, paths and their cost.

    Left out, the file is RUN/field.pdf and RUN/field.png, which a training draws too.

    \b
    rsrm figure runs/scene
    rsrm figure runs/scene -o scene.pdf --paths 4
    """
    with _extra("a figure", "pictures"):
        from rsrm_gen.trainer.picture import draw_run

        typer.echo(f"figure: {draw_run(run, output, paths)}")


@app.command("report")
def _report_page(
    run: RunArgument,
    output: Annotated[Path | None, typer.Option("-o", metavar="FILE", help="File to write; RUN/report.html.")] = None,
    paths: Annotated[int, typer.Option(min=0, help="Paths to draw, from starts far apart.")] = 6,
) -> None:
    """Write all that is known of a run on one page, with the field to be turned; it needs no network.

    \b
    rsrm report runs/scene
    rsrm report runs/scene -o scene.html
    """
    with _extra("a report", "pictures"):
        from rsrm_gen.trainer.report import write_report

        typer.echo(f"report: {write_report(run, output, paths)}")


@contextmanager
def _extra(what: str, extra: str) -> Iterator[None]:
    """An optional package that is not installed is a message that names the extra."""
    try:
        yield
    except ModuleNotFoundError as error:
        if (error.name or "").startswith("rsrm_gen"):
            raise
        hint = f"pip install 'rsrm-gen[{extra}]'"
        raise UserError(f"{what} needs {error.name}, which is not installed", hint=hint) from None


def main(arguments: Sequence[str] | None = None) -> None:
    """The entry point of `rsrm`; a user's mistake is a message and exit code 2."""
    try:
        app(args=None if arguments is None else list(arguments))
    except UserError as error:
        typer.echo(str(error), err=True)
        sys.exit(2)


if __name__ == "__main__":
    main()
