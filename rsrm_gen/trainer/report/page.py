"""RUN/report.html: all that is known of a run on one page that needs nothing else.

The page's script and style are the files beside this one, written into it; its policy forbids the browser to load anything.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, fields
from html import escape
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np

import rsrm_gen
from rsrm_gen.files import write_text_whole
from rsrm_gen.load import read_audit
from rsrm_gen.manifold import Manifold
from rsrm_gen.trainer.plan import Paths, plan
from rsrm_gen.trainer.report.packed import packed
from rsrm_gen.trainer.report.space import viewed
from rsrm_gen.trainer.report.svg import Curve, flat_view, plot, png
from rsrm_gen.trainer.report.tables import facts, number, table, tiles
from rsrm_gen.trainer.run import Metric, Run, RunFolder, load_run
from rsrm_gen.trainer.views.drawing import Drawing, drawing_of, path_starts
from rsrm_gen.trainer.views.render import COLOURS, render

FINENESS = 160  # steps of the mesh from side to side
STILL = 560  # pixels of the picture where nothing can be turned
TOLD = ("title", "cells", "rows", "reference", "reference_rms", "reference_maximum", "planning")
ERRORS = {"name": "", "paper": "RMS, by cells", "rms": "RMS, by volume", "p95": "95 %", "maximum": "largest"}
DESCENTS = {
    "kind": "starts",
    "starts": "how many",
    "reached": "reach the goal",
    "entered": "enter an obstacle",
    "p95": "95 %",
}
HERE = Path(__file__).parent
POLICY = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'"


@dataclass(frozen=True)
class Report:
    """What the page is made of."""

    run: Run
    folder: RunFolder
    drawing: Drawing
    audit: Mapping[str, Any] | None  # None: of a manifold that was not generated
    evaluation: Mapping[str, Any] | None  # None: not evaluated yet


def write_report(path: Path, output: Path | None = None, paths_from: int = 6, manifold: Manifold | None = None) -> Path:
    """Write the page of a run folder with paths from that many starts: RUN/report.html, or `output`; which is returned.

    `manifold` stands in for the one the run's scene names.
    """
    run = load_run(path, manifold)
    starts = path_starts(run.scene, paths_from)
    paths = plan(run.arrival, run.scene, starts) if len(starts) else None
    choice, folder = run.scene.manifold_choice, path
    name = folder / choice.spec if choice.is_path else choice.spec
    audit = read_audit(name, **choice.parameters) if manifold is None else None
    drawing = drawing_of(run.scene, run.arrival.time, paths, FINENESS)
    report = Report(run, RunFolder(path), drawing, audit, _document(path / "evaluation.json"))
    output = output or path / "report.html"
    write_text_whole(output, page(report))
    return output


def _document(path: Path) -> Mapping[str, Any] | None:
    """A JSON file of the run; None where there is none, or not a whole one."""
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    return found if isinstance(found, dict) else None


def page(report: Report) -> str:
    """The HTML of the page."""
    title = escape(report.run.scene.title)
    style = (HERE / "page.css").read_text(encoding="utf-8")
    script = "".join((HERE / name).read_text(encoding="utf-8") for name in ("viewer.js", "page.js"))
    return (
        f'<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><title>{title}</title>'
        f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<style>{style}</style></head>\n<body>{''.join(_parts(report))}"
        f'<div id="note" hidden></div><script type="application/json" id="data">{_embedded(_data(report))}</script>'
        f"<script>{script}</script></body></html>\n"
    )


def _embedded(data: Mapping[str, Any]) -> str:
    """JSON that cannot end the element it stands in."""
    text = json.dumps(data, allow_nan=False, separators=(",", ":"))
    return text.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")


def _data(report: Report) -> dict[str, Any]:
    drawing = report.drawing
    palette = matplotlib.colormaps[COLOURS](np.linspace(0, 1, 256))[:, :3]
    levels = drawing.levels
    return {
        "top": drawing.top,
        "step": float(levels[0]) if len(levels) else drawing.top,
        "palette": packed(palette),
        "space": viewed(drawing, report.run.arrival.field),
        "sheets": [
            {
                "half": sheet.mesh.plane.half,
                "round": sheet.mesh.plane.round,
                "rows": sheet.mesh.y.shape[0],
                "columns": sheet.mesh.y.shape[1],
                "time": packed(sheet.time.numpy()),
                "distance": packed(sheet.distance.clamp_max(1e6).numpy()),
            }
            for sheet in drawing.sheets
        ],
    }


def _parts(report: Report) -> Iterator[str]:
    yield _heading(report)
    yield _field(report)
    yield _training(report)
    yield _errors(report.evaluation)
    yield _planning(report.evaluation)
    yield _paths(report.drawing.paths)
    yield _settings(report)
    yield _audit(report.audit)
    version = escape(rsrm_gen.__version__)
    yield f"<footer>Written by rsrm-gen {version}. This page is complete: it loads nothing from anywhere.</footer>"


def _heading(report: Report) -> str:
    scene, manifold = report.run.scene, report.run.scene.manifold
    obstacles = f"{len(scene.radii)} obstacle{'' if len(scene.radii) == 1 else 's'}"
    domain = f"the ball of radius {scene.domain.radius:g}" if scene.domain else "all of it"
    lead = (
        f"Arrival times on {manifold.name} ({manifold.dim} dimension{'' if manifold.dim == 1 else 's'}), {domain}: {obstacles}, "
        f"slowness {scene.law.free:g} outside and {scene.law.obstacle:g} inside."
    )
    return f'<h1>{escape(scene.title)}</h1><p class="lead">{escape(lead)}</p>{tiles(_headlines(report))}'


def _headlines(report: Report) -> Iterator[tuple[str, str, str]]:
    summary, paths = report.run.summary, report.drawing.paths
    rows = {row.get("name"): row for row in _rows(report.evaluation)}
    if "field" in rows:
        beside = f"T = d alone: {number(rows['T = d']['rms'], 3)}" if "T = d" in rows else ""
        yield "RMS error of T", number(rows["field"]["rms"], 3), beside
        yield "largest error", number(rows["field"]["maximum"], 3), f"95 % below {number(rows['field']['p95'], 3)}"
    descents = next(iter(_rows((report.evaluation or {}).get("planning"))), None)
    if descents and "reached" in descents:
        ratio = f"cost over the least: 95 % below {number(descents.get('p95'))}" if descents.get("p95") else ""
        yield f"of {number(descents.get('starts'))} descents arrive", f"{100 * descents['reached']:.1f} %", ratio
    elif paths:
        yield "paths that arrive", f"{int(paths.reached.sum())} of {len(paths.reached)}", "from far-off free starts"
    if summary:
        yield "final loss", number(summary.loss, 3), "at fresh points"
        yield "splats", number(summary.splats), f"{number(summary.parameters)} numbers"
        yield "training", f"{number(summary.seconds, 3)} s", f"{number(summary.ms_per_step, 3)} ms a step"
    else:
        yield "not finished", f"step {report.run.step}", f"of {report.run.scene.training.steps}"


def _field(report: Report) -> str:
    drawing = report.drawing
    if not drawing.sheets:
        return ""
    views = [flat_view(drawing, i, report.run.arrival.field) for i in range(len(drawing.sheets))]
    titles = [escape(sheet.mesh.plane.title) for sheet in drawing.sheets]
    flats = [f"<figure>{v}<figcaption>{t}</figcaption></figure>" for v, t in zip(views, titles, strict=True)]
    surface = not drawing.sheets[0].mesh.plane.section
    if surface:
        choice = _checks([("paths", "paths with their true cost", True), ("splats", "splats", False)])
        flats = [
            f'<figure id="flat">{views[0]}<div class="controls">{choice}</div><figcaption>{titles[0]}</figcaption></figure>'
        ]
        body = f'<div class="pair">{_space(report)}{flats[0]}</div>'
    else:
        body = f'<div class="pair">{_space(report)}{"".join(flats)}</div>'
    scale = png(matplotlib.colormaps[COLOURS](np.linspace(0, 1, 256))[None, :, :3])
    every = f"level lines every {drawing.levels[0]:g}" if len(drawing.levels) else ""
    top = f"<span>{number(drawing.top, 3)}</span><span>{every}</span>"
    bar = f'<div class="scale"><span>T = 0</span><img src="{scale}" alt="">{top}</div>'
    legend = (
        "White star: the goal. Lines: paths down the field, with what they truly cost. Hatched: obstacles. Splats are outlined "
        'where they have fallen to exp(\N{MINUS SIGN}\N{VULGAR FRACTION ONE HALF}): <span class="key r"></span>of positive, '
        '<span class="key l"></span>of negative weight.'
    )
    return f'<section class="scripted"><h2>The field</h2>{body}{bar}<p class="soft">{legend}</p></section>'


def _space(report: Report) -> str:
    """The panel of the viewer, with a picture where there is no script."""
    drawing = report.drawing
    if drawing.sheets[0].mesh.plane.section:
        shapes = ["normal coordinates at the goal"]
        if drawing.scene.manifold.dim > 3:
            shapes = [
                "section through the goal, the three directions in which most obstacles are; paths are projected onto it"
            ]
        still, why = "", "It is turned by a script; sections of it are below."
        checks = [("cut", "cut open", True)]
    else:
        shapes = [shape.title for shape, _ in drawing.shapes]
        image = render(drawing.sheets[0], *drawing.shapes[0], drawing.top, STILL).image
        still, why = f'<img src="{png(image)}" alt="the field in space">', ""
        checks = [("levels", "level lines", True)]
    controls = _checks([*checks, ("paths", "paths", True), ("splats", "splats", False)])
    controls += '<label>up to T <input type="range" name="until" min="0" max="1" step="0.005" value="1"></label>'
    controls += '<output>all</output><button type="button">reset</button>'
    if len(shapes) > 1:
        controls += "".join(
            f'<label><input type="radio" name="shape" value="{i}"{" checked" if i == 0 else ""}>{escape(title)}</label>'
            for i, title in enumerate(shapes)
        )
    caption = f"{escape(shapes[0])}. " if len(shapes) == 1 else ""
    return (
        f'<figure id="space" data-state="still"><div class="stage">{still}<p class="why soft">{why}</p>'
        f'<canvas tabindex="0" role="img" aria-label="the field in space; arrow keys turn it"></canvas></div>'
        f'<div class="controls">{controls}</div><figcaption>{caption}Drag to turn, scroll to come closer.</figcaption></figure>'
    )


def _checks(boxes: list[tuple[str, str, bool]]) -> str:
    return "".join(
        f'<label><input type="checkbox" name="{name}"{" checked" if on else ""}>{escape(text)}</label>'
        for name, text, on in boxes
    )


def _training(report: Report) -> str:
    metrics = report.folder.read_metrics()
    if len(metrics) < 2:
        return ""
    plots = [
        _plot(metrics, "loss", "step", True),
        _plot(metrics, "loss", "seconds", True),
        _plot(metrics, "splats", "step"),
    ]
    known = {"step", "loss", "seconds", "splats"}
    more = [f.name for f in fields(Metric) if f.name not in known]
    plots += [_plot(metrics, name, "step", True) for name in more if _numeric(metrics, name)]
    figures = "".join(f"<figure>{drawn}</figure>" for drawn in plots)
    return f'<section><h2>Training</h2><div class="pair three">{figures}</div></section>'


def _numeric(metrics: list[Metric], name: str) -> bool:
    found = [getattr(metric, name) for metric in metrics]
    return any(isinstance(value, int | float) and not isinstance(value, bool) for value in found)


def _plot(metrics: list[Metric], name: str, across: str, log: bool = False) -> str:
    """One column of the metrics, a curve for each phase."""
    phases = list(dict.fromkeys(metric.phase for metric in metrics))
    curves = []
    for phase in phases:
        rows = [m for m in metrics if m.phase == phase and np.isfinite(float(getattr(m, name) or 0))]
        rows = [m for m in rows if getattr(m, name) is not None]
        if not rows:
            continue
        notes = [
            f"{phase}, step {m.step}, {m.seconds:g} s: {name} {number(getattr(m, name))}, {m.splats} splats"
            for m in rows
        ]
        curves.append(Curve(phase, [getattr(m, across) for m in rows], [getattr(m, name) for m in rows], notes))
    return plot(curves, across, name, log)


def _rows(document: Any) -> list[Mapping[str, Any]]:
    """The rows of a table that a JSON document holds."""
    found = document.get("rows", ()) if isinstance(document, Mapping) else ()
    return [row for row in found if isinstance(row, Mapping)]


def _table_of(rows: Sequence[Mapping[str, Any]], names: Mapping[str, str]) -> str:
    """Rows with the columns that they have, by other names where those are given."""
    columns = list(dict.fromkeys(key for row in rows for key in row))
    return table([names.get(column, column) for column in columns], [[row.get(c) for c in columns] for row in rows])


def _errors(evaluation: Mapping[str, Any] | None) -> str:
    if evaluation is None:
        return (
            '<section><h2>Errors</h2><p class="soft">Not evaluated yet: <code>rsrm eval</code> does, and then this page can be '
            "written again.</p></section>"
        )
    own = {"paper": evaluation.get("reference_rms"), "maximum": evaluation.get("reference_maximum")}
    rows = [*_rows(evaluation), {"name": "the reference's own", **own}]
    note, cells = escape(str(evaluation.get("reference", ""))), escape(number(evaluation.get("cells")))
    said = {key: value for key, value in evaluation.items() if key not in TOLD}
    intro = f"T less the reference solution's in {cells} free cells, in units of T. Reference: {note}."
    return f'<section><h2>Errors</h2><p class="soft">{intro}</p>{_table_of(rows, ERRORS)}{facts(said)}</section>'


def _planning(evaluation: Mapping[str, Any] | None) -> str:
    found = (evaluation or {}).get("planning")
    if not isinstance(found, Mapping):
        return ""
    rest = {name: value for name, value in found.items() if name != "rows"}
    intro = "Descents of T from fresh free starts, by kind; costs are those of the paths over the reference's."
    drawn = _table_of(_rows(found), DESCENTS) if _rows(found) else ""
    return f'<section><h2>Planning</h2><p class="soft">{intro}</p>{drawn}{facts(rest)}</section>'


def _paths(paths: Paths | None) -> str:
    if paths is None:
        return ""
    rows = [
        (
            ", ".join(f"{c:.3f}" for c in points[0].tolist()),
            float(paths.value[i]),
            float(paths.cost[i]),
            float(paths.length[i]),
            float(paths.clearance[i]),
            bool(paths.reached[i]),
        )
        for i, points in enumerate(paths.points)
    ]
    headings = ("from", "T by the field", "true cost", "length", "clearance", "reaches the goal")
    intro = (
        "The cost is the integral of the slowness along the path, whatever the field says; the clearance is negative in an "
        "obstacle."
    )
    return f'<section><h2>Paths</h2><p class="soft">{intro}</p>{table(headings, rows)}</section>'


def _settings(report: Report) -> str:
    document = _document(report.folder.path / "settings.json") or {}
    summary = report.run.summary
    parts = {**document, **({"summary": asdict(summary)} if summary else {})}
    scene = escape(report.run.scene.source.text)
    return (
        f"<section><h2>Settings</h2><details><summary>Every setting as it was resolved</summary>{facts(parts)}</details>"
        f'<details><summary>The scene file</summary><div class="wide"><pre><code>{scene}</code></pre></div></details></section>'
    )


def _audit(audit: Mapping[str, Any] | None) -> str:
    if audit is None:
        return '<section><h2>Audit of the generated code</h2><p class="soft">This manifold was not generated.</p></section>'
    checks = audit.get("checks", [])
    passed = sum(bool(check.get("passed")) for check in checks)
    accuracy = table(
        ("function", "precision", "worst error, at most", "points"),
        [
            (a.get("function"), a.get("precision"), a.get("error_at_most"), a.get("points"))
            for a in audit.get("accuracy", [])
        ],
    )
    rows = [
        (
            check.get("check"),
            check.get("promise"),
            "exactly" if check.get("exactly") else f"below {number(check.get('error_below'))}",
            check.get("tolerance"),
            check.get("points"),
            bool(check.get("passed")),
        )
        for check in checks
    ]
    every = table(("check", "promise", "worst error", "tolerance", "points", "passed"), rows)
    said = f"{passed} of {len(checks)} checks passed."
    hashed = f"Manifold file {str(audit.get('content_hash', ''))[:16]}, generator {audit.get('generator', '')}."
    return (
        f"<section><h2>Audit of the generated code</h2><p>{escape(said)} <span class=soft>{escape(hashed)} Errors of "
        "functions are in units of what rounding the inputs and the output alone would cost.</span></p>"
        f"{accuracy}<details><summary>Every check</summary>{every}</details></section>"
    )
