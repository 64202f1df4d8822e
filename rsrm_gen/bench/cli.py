"""`rsrm bench`: measurements of the compiler and its code, as tables that anyone can make again."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from rsrm_gen.errors import UserError
from rsrm_gen.files import assignments, bundled, manifold_file

app = typer.Typer(
    no_args_is_help=True,
    add_completion=False,
    rich_markup_mode=None,
    help="Measure the generated code and the compiler.",
)

Parameters = Mapping[str, int | float | str]

# What other tools have too.
CASES: tuple[tuple[str, Parameters], ...] = (
    ("sphere", {}),
    ("hyperbolic", {}),
    ("so3", {}),
    ("torus", {}),
    ("sphere", {"n": 5}),
    ("poincare", {}),
    ("half_space", {}),
    ("so3_matrix", {}),
    ("spd", {}),
    ("spd", {"n": 3}),
)
LARGE: tuple[tuple[str, Parameters], ...] = (("sphere", {"n": 16}),)
ROWS, QUICK_ROWS = 48, 8
# Manifolds and sizes, points and splats, of `rsrm bench kernels`.
STEP_CASES: tuple[tuple[str, Parameters], ...] = (
    ("torus", {}),
    ("sphere", {}),
    ("hyperbolic", {}),
    ("so3", {}),
    ("torus", {"n": 6}),
    ("sphere", {"n": 5}),
    ("se3", {}),
)
STEP_SIZES = ((1024, 128), (4096, 512), (16384, 2048))
CONTENDER_KEYS = ["eager", "analytic", "compiled", "jax", "jax-analytic", "ours", "kernel", "culled"]
PLANNERS = ["RRT*", "BIT*"]
PAPER_METHODS = ["recipe", "mlp", "mlp-small", "ours", "ours-half", "ours-quarter"]

Manifolds = Annotated[
    list[str] | None, typer.Argument(metavar="[MANIFOLD...]", help="Bundled manifolds or files.", show_default=False)
]
Assignments = Annotated[
    list[str] | None, typer.Option("-p", "--parameter", metavar="NAME=VALUE", help="A parameter of the manifolds.")
]
Markdown = Annotated[Path | None, typer.Option("--markdown", metavar="FILE", help="Write the tables as Markdown.")]
Json = Annotated[Path | None, typer.Option("--json", metavar="FILE", help="Write all figures as JSON.")]


@app.command("accuracy")
def accuracy_command(
    manifolds: Manifolds = None,
    parameter: Assignments = None,
    rows: Annotated[int, typer.Option(min=1, help="Pairs of points a band.")] = ROWS,
    quick: Annotated[bool, typer.Option("--quick", help=f"{QUICK_ROWS} pairs a band.")] = False,
    markdown: Markdown = None,
    json: Json = None,
) -> None:
    """The worst and median error of the generated code, beside other tools on the same points.

    \b
    rsrm bench accuracy                          S^2, H^2 in three models, SO(3) in two, T^2, S^5, SPD(2), SPD(3)
    rsrm bench accuracy sphere -p n=7 --quick
    rsrm bench accuracy --markdown accuracy.md --json accuracy.json

    Other tools are measured where they are installed: pip install 'rsrm-gen[peers]'.
    """
    from rsrm_gen.bench.accuracy import accuracy
    from rsrm_gen.bench.table import write_json, write_markdown

    given: Parameters = assignments(parameter or ())
    chosen = [(name, given) for name in manifolds] if manifolds else [(name, {**p, **given}) for name, p in CASES]
    cases = [(manifold_file(name), parameters) for name, parameters in chosen]
    with _progress() as say:
        result = accuracy(cases, QUICK_ROWS if quick else rows, say=say)
    console = _console()
    summary = [*result.worst(), result.counts()]
    for table in summary:
        console.print(table.rich())
        console.print()
    console.print(result.foot(), style="dim", highlight=False)
    if markdown is not None:
        write_markdown(markdown, [*summary, *result.bands()], result.foot())
    if json is not None:
        write_json(json, result.document())


@app.command("generation")
def generation_command(
    manifolds: Manifolds = None,
    parameter: Assignments = None,
    runs: Annotated[int, typer.Option(min=1, help="How often each is generated; the table has medians.")] = 3,
    quick: Annotated[bool, typer.Option("--quick", help="Once.")] = False,
    markdown: Markdown = None,
    json: Json = None,
) -> None:
    """The seconds that rsrm-gen takes, cold and when nothing changed.

    \b
    rsrm bench generation                        every bundled manifold, and S^16
    rsrm bench generation mine.yaml --runs 5
    """
    from rsrm_gen.bench.generation import document, foot, generation, tables
    from rsrm_gen.bench.table import write_json, write_markdown

    given: Parameters = assignments(parameter or ())
    chosen = [(name, given) for name in manifolds] if manifolds else [*((n, given) for n in _names()), *LARGE]
    with _progress() as say:
        results = generation(
            [(manifold_file(name), parameters) for name, parameters in chosen], 1 if quick else runs, say
        )
    console = _console()
    for table in tables(results):
        console.print(table.rich())
    console.print(foot(results), style="dim", highlight=False)
    if markdown is not None:
        write_markdown(markdown, tables(results), foot(results))
    if json is not None:
        write_json(json, document(results))


@app.command("kernels")
def kernels_command(
    manifolds: Manifolds = None,
    parameter: Assignments = None,
    size: Annotated[
        list[str] | None, typer.Option("--size", metavar="N,K", help="Points and splats; may be given several times.")
    ] = None,
    threads: Annotated[list[int] | None, typer.Option(min=1, help="Number of threads; several times.")] = None,
    precision: Annotated[list[str] | None, typer.Option(help="float32 or float64; several times.")] = None,
    contender: Annotated[
        list[str] | None,
        typer.Option(help="eager, analytic, compiled, jax, jax-analytic, ours, kernel or culled; several times."),
    ] = None,
    sigma: Annotated[
        float | None, typer.Option(min=0.001, help="How wide the splats are; narrow ones leave out far pairs.")
    ] = None,
    rounds: Annotated[int, typer.Option(min=1, help="Samples of each, one a round; the tables have medians.")] = 7,
    compile_budget: Annotated[float, typer.Option(help="Seconds that torch.compile may take for a size.")] = 120,
    quick: Annotated[
        bool, typer.Option("--quick", help="The smallest size, float32, three rounds, no torch.compile.")
    ] = False,
    markdown: Markdown = None,
    json: Json = None,
    plot: Annotated[
        Path | None, typer.Option("--plot", metavar="FILE", help="Draw the medians: PNG, PDF or SVG.")
    ] = None,
) -> None:
    """The time of a training step by the generated kernel, beside torch and JAX in one run.

    \b
    rsrm bench kernels                           T^2, S^2, H^2, SO(3), T^6, S^5, SE(3): hours
    rsrm bench kernels sphere --size 4096,512 --threads 2 --precision float32
    rsrm bench kernels sphere --size 4096,512 --sigma 0.05 --contender kernel --contender culled
    rsrm bench kernels --markdown kernels.md --json kernels.json --plot kernels.png

    JAX is timed where it is installed: pip install 'rsrm-gen[jax]'.
    """
    from rsrm_gen.bench.kernel_tables import foot, tables
    from rsrm_gen.bench.kernels import Plan, kernels
    from rsrm_gen.bench.steps import CONTENDERS
    from rsrm_gen.bench.table import write_json, write_markdown

    given: Parameters = assignments(parameter or ())
    chosen = [(name, given) for name in manifolds] if manifolds else [(name, {**p, **given}) for name, p in STEP_CASES]
    keys = _chosen(contender, [c.key for c in CONTENDERS if not (quick and c.key == "compiled")], "contender")
    plan = Plan(
        cases=tuple((manifold_file(name), parameters) for name, parameters in chosen),
        sizes=tuple(map(_size, size)) if size else STEP_SIZES[: 1 if quick else None],
        threads=_available(threads or (1, 2)),
        precisions=tuple(_chosen(precision, ["float32"] if quick else ["float32", "float64"], "precision")),
        contenders=tuple(c for c in CONTENDERS if c.key in keys),
        rounds=min(rounds, 3) if quick else rounds,
        compile_budget=compile_budget,
        sigma=sigma,
    )
    with _progress() as say:
        result = kernels(plan, say)
    console = _console()
    for table in tables(result):
        console.print(table.rich())
        console.print()
    console.print(foot(result), style="dim", highlight=False)
    if markdown is not None:
        write_markdown(markdown, tables(result), foot(result))
    if json is not None:
        write_json(json, result.document())
    if plot is not None:
        from rsrm_gen.bench.kernel_plot import draw

        draw(result, plot)


@app.command("paper")
def paper_command(
    method: Annotated[
        list[str] | None, typer.Option(help=f"{', '.join(PAPER_METHODS)}; several times; all.", show_default=False)
    ] = None,
    manifold: Annotated[
        list[str] | None, typer.Option(help="As the scene files are named; several times; all.")
    ] = None,
    seed: Annotated[list[int] | None, typer.Option(help="As the scene files are named; several times; all.")] = None,
    output: Annotated[Path | None, typer.Option("-o", metavar="OUT", help="Folder; runs/bench-paper.")] = None,
    scenes: Annotated[
        Path | None, typer.Option(metavar="FOLDER", help="Scenes named like torus-1.yaml; the paper's fifteen.")
    ] = None,
    quick: Annotated[
        bool, typer.Option("--quick", help="One seed, 400 steps of the recipe, our smallest: minutes.")
    ] = False,
    only_tables: Annotated[bool, typer.Option("--tables", help="Of what is there; train nothing.")] = False,
    rows: Annotated[Path | None, typer.Option(metavar="FILE", help="Tables of a JSON file; train nothing.")] = None,
    markdown: Markdown = None,
    latex: Annotated[Path | None, typer.Option("--latex", metavar="FILE", help="Write the tables as LaTeX.")] = None,
) -> None:
    """The experiments of the RSRM paper: its recipe, its networks and our default on its fifteen scenes.

    \b
    rsrm bench paper                             all of it, into runs/bench-paper: hours; Ctrl-C keeps what is done
    rsrm bench paper                             again: goes on where it was
    rsrm bench paper --quick                     one seed, shortened: minutes
    rsrm bench paper --method ours --manifold torus --seed 1
    rsrm bench paper --tables                    the tables of what is done

    OUT/paper.json, paper.md and paper.tex hold all rows and the tables, as --markdown and --latex do elsewhere.
    """
    from rsrm_gen.bench.paper import methods
    from rsrm_gen.bench.paper.euclidean import plane_jobs
    from rsrm_gen.bench.paper.runner import Result, finished, run, selected
    from rsrm_gen.bench.paper.tables import notes, read_rows, tables, write_all, write_page
    from rsrm_gen.bench.table import write_latex

    console = _console()
    if rows is not None:
        read, read_plane = read_rows(rows)
        result = Result(tuple(read), tuple(read_plane))
    else:
        output = output or Path("runs/bench-paper-quick" if quick else "runs/bench-paper")
        keys = _chosen(method, list(methods.QUICK) if quick else PAPER_METHODS, "method")
        curved = [name for name in manifold or () if name != "euclidean"]
        jobs = selected(output, scenes, keys, curved, seed or (), quick) if curved or not manifold else []
        plane = plane_jobs(output, seed or (), quick) if _with_the_plane(method, manifold, scenes) else []
        with _progress() as say:
            result = finished(jobs, plane) if only_tables else run(jobs, say, plane=plane)
    shown = tables(result.rows, result.plane)
    for table in shown:
        console.print(table.rich())
        console.print()
    given = {"--method": method, "--manifold": manifold, "--seed": seed, "--scenes": [scenes] if scenes else []}
    chosen = [f" {option} {value}" for option, values in given.items() for value in values or ()]
    command = "rsrm bench paper" + "".join(chosen) + (" --quick" if quick else "")
    words = notes(result.rows, result.failures, result.missing, command)
    for word in words:
        console.print(f"- {word}", style="dim", highlight=False, markup=False)
    if output is not None and rows is None:
        write_all(output, command)
    if markdown is not None:
        write_page(markdown, shown, words)
    if latex is not None:
        write_latex(latex, shown, " ".join(words))
    if result.interrupted:
        raise typer.Exit(130)
    if result.failures:
        raise typer.Exit(1)


@app.command("planners")
def planners_command(
    runs: Annotated[list[Path], typer.Argument(metavar="RUN...", help="Folders of `rsrm train`.", show_default=False)],
    starts: Annotated[int, typer.Option(min=1, help="Free starts of each scene, evenly of all kinds.")] = 20,
    seconds: Annotated[
        list[float] | None, typer.Option(min=0.001, help="CPU seconds a query; several times; 0.1, 1 and 10.")
    ] = None,
    planner: Annotated[list[str] | None, typer.Option(help="RRT* or BIT*; several times; both.")] = None,
    quick: Annotated[bool, typer.Option("--quick", help="Six starts, 0.1 and 1 s.")] = False,
    markdown: Markdown = None,
    json: Json = None,
) -> None:
    """Sampling planners of OMPL beside the descent of trained fields: what they find, what it costs, how long it takes.

    \b
    rsrm bench planners runs/torus               RRT* and BIT* after 0.1, 1 and 10 s: seven minutes a scene
    rsrm bench planners runs/* --quick           a quarter of a minute a scene
    rsrm bench planners runs/torus --planner 'BIT*' --seconds 5 --starts 50

    It needs OMPL: pip install 'rsrm-gen[ompl]'.
    """
    from rsrm_gen.bench.planners.contest import contests, sampling_planners
    from rsrm_gen.bench.planners.tables import document, foot, tables
    from rsrm_gen.bench.table import write_json, write_markdown

    chosen = _chosen(planner, PLANNERS, "planner")
    search = sampling_planners()
    budgets = seconds or ([0.1, 1] if quick else [0.1, 1, 10])
    count = 6 if quick else starts
    with _progress() as say:
        found = contests(runs, search, chosen, budgets, count, say)
    console, shown = _console(), tables(found)
    for table in shown:
        console.print(table.rich())
        console.print()
    options = [f"--starts {count}", *(f"--seconds {budget:g}" for budget in budgets)]
    words = foot(found, " ".join(["rsrm bench planners", *map(str, runs), *options]))
    console.print(words, style="dim", highlight=False, markup=False)
    if markdown is not None:
        write_markdown(markdown, shown, words)
    if json is not None:
        write_json(json, document(found))


def _with_the_plane(methods: list[str] | None, manifolds: list[str] | None, scenes: Path | None) -> bool:
    """Whether the case in the Euclidean plane is wanted too: where it is named, and where nothing is chosen."""
    return "euclidean" in manifolds if manifolds else methods is None and scenes is None


def _size(text: str) -> tuple[int, int]:
    """`4096,512` as two numbers."""
    points, _, splats = text.partition(",")
    if not (points.strip().isdecimal() and splats.strip().isdecimal() and int(points) and int(splats)):
        raise UserError(f"`{text}` is no size", hint="write points and splats, like --size 4096,512")
    return int(points), int(splats)


def _chosen(given: list[str] | None, default: list[str], what: str) -> list[str]:
    """What was given, each one of those there are."""
    known = {
        "precision": ["float32", "float64"],
        "contender": CONTENDER_KEYS,
        "method": PAPER_METHODS,
        "planner": PLANNERS,
    }[what]
    for word in given or ():
        if word not in known:
            raise UserError(f"`{word}` is no {what}", hint=f"one of {', '.join(known)}")
    return given or default


def _available(threads: Sequence[int]) -> tuple[int, ...]:
    """The numbers of threads for which there are cores; the others are said and left out."""
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    for count in threads:
        if count > cores:
            print(f"{count} threads are left out: there are {cores} cores", file=sys.stderr)
    found = tuple(dict.fromkeys(count for count in threads if count <= cores))
    return found or (cores,)


def _names() -> list[str]:
    """The bundled manifolds."""
    return sorted(path.stem for path in bundled("manifolds").glob("*.yaml"))


def _console() -> Console:
    console = Console()
    return console if console.is_terminal else Console(width=200)  # a table in a file is not cut to fit a screen


@contextmanager
def _progress() -> Iterator[Callable[[str], None]]:
    """Says on the error stream what is being measured: one changing line in a terminal, else a line each."""
    console = Console(stderr=True)
    if not console.is_terminal:
        yield lambda words: console.print(words, style="dim", highlight=False, soft_wrap=True)
        return
    with console.status("") as status:
        yield status.update
