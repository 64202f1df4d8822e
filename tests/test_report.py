"""The page of a run: complete, alone, harmless, and alive in a real browser."""

from __future__ import annotations

import json
import math
import re
import shutil
from collections.abc import Iterator
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from typing import TYPE_CHECKING, Any

import matplotlib.image
import numpy as np
import pytest
import torch
from plain_manifolds import PLAIN
from scenes import small_scene

from rsrm_gen.load import read_audit
from rsrm_gen.trainer.report import page as page_module
from rsrm_gen.trainer.report import space, svg, write_report
from rsrm_gen.trainer.report.packed import packed, packed_lines
from rsrm_gen.trainer.report.page import Report, page
from rsrm_gen.trainer.report.tables import facts, number, table
from rsrm_gen.trainer.run import RunFolder, load_run
from rsrm_gen.trainer.scene import Scene
from rsrm_gen.trainer.train import train
from rsrm_gen.trainer.views.drawing import drawing_of

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

TRAINING = "{steps: 12, points: 64, dtype: float64, splats: {initial: 8, add: 0}}"
HOSTILE = "</script><script>document.title='taken'</script><b>&\"'"


@pytest.fixture(autouse=True)
def _coarse(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(page_module, "FINENESS", 40)
    monkeypatch.setattr(page_module, "STILL", 120)
    monkeypatch.setattr(space, "CLOUD", 8000)
    monkeypatch.setattr(svg, "PIXELS", 60)


def trained(folder: Path, name: str, **changes: Any) -> tuple[Path, Scene]:
    """A run of a few steps on a plain manifold."""
    scene = replace(small_scene(folder, name, TRAINING), **changes)
    run = RunFolder(folder / "run")
    run.create(scene)
    train(scene, run)
    return run.path, scene


def report_of(folder: Path, name: str) -> str:
    path, scene = trained(folder, name)
    return write_report(path, paths_from=2, manifold=scene.manifold).read_text()


class Elements(HTMLParser):
    """All elements of a page with their attributes, and the text of scripts."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.found: list[tuple[str, dict[str, str | None]]] = []
        self.scripts: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.found.append((tag, dict(attrs)))

    def handle_data(self, data: str) -> None:
        if self.cdata_elem == "script":
            self.scripts.append(data)


def unpacked(part: dict[str, Any]) -> np.ndarray[Any, Any]:
    """What page.js makes of packed numbers."""
    import base64

    steps = np.frombuffer(base64.b64decode(part["data"]), "<u2").astype(float)
    values = part["low"] + (part["high"] - part["low"]) / 65534 * steps
    return np.where(steps == 65535, np.nan, values)


@pytest.mark.parametrize("name", PLAIN)
def test_the_page_is_complete_and_alone(tmp_path: Path, name: str) -> None:
    text = report_of(tmp_path, name)
    headings = re.findall(r"<h2>(.*?)</h2>", text)
    assert headings == ["The field", "Training", "Errors", "Paths", "Settings", "Audit of the generated code"]
    elements = Elements(text)
    assert [tag for tag, _ in elements.found if tag in ("link", "iframe", "object", "embed", "base")] == []
    for tag, attributes in elements.found:
        for attribute in ("src", "href", "srcset", "action", "data"):
            address = attributes.get(attribute)
            assert address is None or address.startswith("data:image/png;base64,"), (tag, attribute)
    assert not re.search(r"(?i)https?:|//[a-z]+\.|@import|url\((?!#)", text)
    flat = [tag for tag, attributes in elements.found if tag == "svg" and "flat" in str(attributes.get("class"))]
    assert len(flat) == (1 if PLAIN[name].dim == 2 else 3)


@pytest.mark.parametrize("name", PLAIN)
def test_the_page_shows_the_field_it_was_given(tmp_path: Path, name: str) -> None:
    """What the script turns is T of the points it is drawn at: the field at the mesh, compared in the page's own data."""
    path, scene = trained(tmp_path, name)
    text = write_report(path, paths_from=2, manifold=scene.manifold).read_text()
    data = json.loads(Elements(text).scripts[0])
    run = load_run(path, scene.manifold)
    assert data["space"]["kind"] == ("surface" if scene.manifold.dim == 2 else "cloud")
    drawing = drawing_of(run.scene, run.arrival.time, None, 40)
    for sheet, shown in zip(drawing.sheets, data["sheets"], strict=True):
        y = sheet.mesh.y.reshape(-1, 2)
        inside = scene.inside_domain(sheet.mesh.plane.point(y)).numpy()
        wanted = run.arrival.time(sheet.mesh.plane.point(y)).numpy()
        error = np.abs(unpacked(shown["time"]) - wanted)[inside & np.isfinite(unpacked(shown["time"]))]
        assert error.size > 500
        assert error.max() < 1e-4 * (1 + wanted[np.isfinite(wanted)].max())
    for shape in data["space"]["shapes"]:
        positions = unpacked(shape["positions"]).reshape(-1, 3)
        assert len(positions) == len(unpacked(data["space"]["time"]))
        assert np.linalg.norm(positions, axis=1).max() < 1.01
        nearest = np.linalg.norm(positions - np.array(shape["goal"]), axis=1).argmin()
        assert unpacked(data["space"]["time"])[nearest] < 0.3 * data["top"]


def test_texts_are_escaped(tmp_path: Path) -> None:
    path, scene = trained(tmp_path, "T2")
    (path / "scene.yaml").write_text((path / "scene.yaml").read_text().replace("small T2", json.dumps(HOSTILE)))
    (path / "evaluation.json").write_text(
        json.dumps({"rows": [{"name": HOSTILE, "rms": 1.0}], "reference": HOSTILE, HOSTILE: 2})
    )
    text = write_report(path, paths_from=0, manifold=scene.manifold).read_text()
    assert "taken" in text
    assert "<script>document" not in text
    assert "<b>" not in text
    assert len(Elements(text).scripts) == 2


def test_the_same_run_gives_the_same_page(tmp_path: Path) -> None:
    path, scene = trained(tmp_path, "S2")
    first = write_report(path, paths_from=2, manifold=scene.manifold).read_bytes()
    assert write_report(path, tmp_path / "again.html", 2, scene.manifold).read_bytes() == first


def test_an_evaluation_is_told(tmp_path: Path) -> None:
    path, scene = trained(tmp_path, "T2")
    rows = [
        {"name": "field", "paper": 0.0125, "rms": 0.0375, "p95": 0.0625, "maximum": 0.5},
        {"name": "T = d", "paper": 0.75, "rms": 0.875, "p95": 1.5, "maximum": 3.0},
    ]
    descents = {"kind": "all", "starts": 200, "reached": 0.995, "entered": 0.0, "p95": 1.125}
    planning = {"rows": [descents, {**descents, "kind": "shadow"}], "valleys": 7, "time": {"one": 39.5}}
    said = {"rows": rows, "cells": 4321, "reference": "by hand", "reference_rms": 0.001, "planning": planning}
    (path / "evaluation.json").write_text(json.dumps(said))
    text = write_report(path, paths_from=0, manifold=scene.manifold).read_text()
    for expected in (
        "0.0375",
        "0.875",
        "T = d alone",
        "by hand",
        "time.one",
        "1.125",
        "99.5 %",
        "shadow",
        "39.5",
        "4\N{THIN SPACE}321",
    ):
        assert expected in text
    (path / "evaluation.json").write_text("{cut off")
    assert "Not evaluated yet" in write_report(path, paths_from=0, manifold=scene.manifold).read_text()


def test_an_unfinished_run_says_so(tmp_path: Path) -> None:
    path, scene = trained(tmp_path, "T2")
    (path / "summary.json").unlink()
    (path / "metrics.jsonl").write_text("")
    text = write_report(path, paths_from=0, manifold=scene.manifold).read_text()
    assert "not finished" in text
    assert "<h2>Training</h2>" not in text


def test_the_audit_is_that_of_the_generated_code(tmp_path: Path) -> None:
    audit = read_audit("torus")
    assert audit["manifold"] == "torus"
    path, scene = trained(tmp_path, "T2")
    run = load_run(path, scene.manifold)
    drawing = drawing_of(run.scene, run.arrival.time, None, 40)
    text = page(Report(run, RunFolder(path), drawing, audit, None))
    assert f"{len(audit['checks'])} of {len(audit['checks'])} checks passed" in text
    for check in audit["checks"]:
        assert check["check"].replace("<", "&lt;").replace(">", "&gt;") in text
    broken = {**audit, "checks": [{**audit["checks"][0], "passed": False}, *audit["checks"][1:]]}
    text = page(Report(run, RunFolder(path), drawing, broken, None))
    assert f"{len(audit['checks']) - 1} of {len(audit['checks'])} checks passed" in text
    assert '<td class="no">no</td>' in text


def test_a_run_whose_manifold_was_replaced_by_one_dimension_has_no_field(tmp_path: Path) -> None:
    import rsrm_gen

    scene_file = tmp_path / "scene.yaml"
    training = TRAINING.replace("{", "{objective: eikonal, ", 1)
    scene_file.write_text(f"scene: one turn\nmanifold: circle\ngoal: [1, 0]\ntraining: {training}\n")
    from rsrm_gen.trainer.scene import read_scene

    scene = read_scene(scene_file, rsrm_gen.load("circle"))
    run = RunFolder(tmp_path / "run")
    run.create(scene)
    train(scene, run)
    text = write_report(run.path, paths_from=1, manifold=scene.manifold).read_text()
    assert "<h2>The field</h2>" not in text
    assert "<h2>Training</h2>" in text


def test_numbers_survive_packing() -> None:
    values = np.array([[-2.5, 0.0], [7.25, np.nan]])
    back = unpacked(packed(values))
    np.testing.assert_allclose(back, values.ravel(), atol=10 / 65534)
    assert np.isnan(back[3])
    assert unpacked(packed(np.array([3.0, 3.0]))).tolist() == [3.0, 3.0]
    lines = packed_lines([np.zeros((4, 3)), np.ones((2, 3))])
    assert lines["starts"] == [0, 4]
    assert unpacked(packed_lines([])).size == 0


def test_numbers_are_written_as_a_person_does() -> None:
    assert [number(value) for value in (0.00123456, 12345, True)] == ["0.001235", "12\N{THIN SPACE}345", "yes"]
    assert [number(value) for value in (math.inf, math.nan, None)] == ["\N{INFINITY}", "\N{EN DASH}", "\N{EN DASH}"]


def test_tables_escape_and_align() -> None:
    drawn = table(["<a>", "n"], [["x & y", 1.5], ["<z>", 2]])
    assert "&lt;a&gt;" in drawn
    assert "<td>x &amp; y</td><td class=n>1.5</td>" in drawn
    assert "a.b" in facts({"a": {"b": [1, None]}})
    assert "1, left out" in facts({"a": {"b": [1, None]}})


# In a browser.

ASK_AT_THE_GOAL = """() => {
    const goal = JSON.parse(document.getElementById("data").textContent).space.shapes[0].goal;
    const c = viewer.camera().matrix, canvas = viewer.canvas;
    const p = [0, 1, 2, 3].map((i) => c[i] * goal[0] + c[4 + i] * goal[1] + c[8 + i] * goal[2] + c[12 + i]);
    return viewer.ask(((p[0] / p[3] + 1) / 2) * canvas.clientWidth, ((1 - p[1] / p[3]) / 2) * canvas.clientHeight);
}"""


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    """A Chromium that is installed here."""
    playwright = pytest.importorskip("playwright.sync_api", reason="no playwright: pip install 'rsrm-gen[browser]'")
    program = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    with playwright.sync_playwright() as running:
        if program is None and not Path(running.chromium.executable_path).exists():
            pytest.skip("no Chromium: install the system's, or `playwright install chromium`")
        flags = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
        found = running.chromium.launch(executable_path=program, args=flags)
        yield found
        found.close()


def opened(browser: Browser, file: Path, complaints: list[str], **options: Any) -> Page:
    """The page, with every complaint of the console and every request for something else noted."""
    shown = browser.new_page(**{"viewport": {"width": 1200, "height": 900}, **options})
    shown.on(
        "console", lambda message: complaints.append(message.text) if message.type in ("error", "warning") else None
    )
    shown.on("pageerror", lambda error: complaints.append(str(error)))
    shown.on("request", lambda request: complaints.append(request.url[:60]) if not is_own(request.url, file) else None)
    shown.goto(file.as_uri())
    shown.wait_for_selector("html[data-ready]")
    return shown


def is_own(url: str, file: Path) -> bool:
    return url == file.as_uri() or url.startswith("data:")


# Pixels stay in the browser: as JSON they would take a minute.
REMEMBER = """async (name) => {
    await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
    viewer.drawNow();
    const { width, height } = viewer.canvas, gl = viewer.gl, bytes = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    const seen = (window.seen ??= {}), all = (seen[name] = new Uint32Array(bytes.buffer));
    return { drawn: all.filter((c) => c >>> 24).length / all.length, colours: new Set(all).size };
}"""
CHANGED = """([a, b]) => seen[a].filter((c, i) => c !== seen[b][i]).length / seen[a].length"""


def remember(shown: Page, name: str) -> dict[str, float]:
    """Keeps what the canvas shows; the share of its pixels that are drawn, and how many colours there are."""
    found: dict[str, float] = shown.evaluate(REMEMBER, name)
    return found


def changed(shown: Page, before: str, after: str) -> float:
    """The share of pixels in which two views differ."""
    return float(shown.evaluate(CHANGED, [before, after]))


@pytest.mark.parametrize("name", ["T2", "S2", "H2", "R2", "SO3"])
def test_a_browser_turns_the_field(tmp_path: Path, browser: Browser, name: str) -> None:
    path, scene = trained(tmp_path, name)
    file = write_report(path, paths_from=2, manifold=scene.manifold)
    complaints: list[str] = []
    shown = opened(browser, file, complaints)
    assert shown.locator("#space").get_attribute("data-state") == "live", complaints
    first = remember(shown, "first")
    assert first["drawn"] > 0.1, "the canvas is blank"
    assert first["colours"] > 500

    box = shown.locator("#space canvas").bounding_box()
    assert box is not None
    middle = (box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    shown.mouse.move(*middle)
    shown.mouse.down()
    shown.mouse.move(middle[0] + 120, middle[1] + 30, steps=4)
    shown.mouse.up()
    remember(shown, "turned")
    assert changed(shown, "first", "turned") > 0.02, "a drag does not turn the view"

    for before, toggle in (("turned", "splats"), ("splats", "paths")):
        shown.locator(f"#space input[name={toggle}]").click()
        remember(shown, toggle)
        assert changed(shown, before, toggle) > 1e-4, f"{toggle} cannot be toggled"
    shown.locator("#space button").click()
    shown.locator("#space input[name=paths]").click()
    shown.locator("#space input[name=splats]").click()
    remember(shown, "again")
    assert changed(shown, "first", "again") == 0, "reset does not bring the first view back"

    shown.screenshot(path=tmp_path / "page.png")
    assert matplotlib.image.imread(tmp_path / "page.png").shape[:2] == (900, 1200)
    assert complaints == []
    shown.close()


def test_a_browser_reads_t_under_the_pointer(tmp_path: Path, browser: Browser) -> None:
    path, scene = trained(tmp_path, "T2", domain=None)
    text = (path / "scene.yaml").read_text()
    (path / "scene.yaml").write_text("".join(line for line in text.splitlines(True) if not line.startswith("domain")))
    file = write_report(path, paths_from=1, manifold=scene.manifold)
    complaints: list[str] = []
    shown = opened(browser, file, complaints)
    box = shown.locator("svg.flat image").bounding_box()
    assert box is not None
    at = torch.tensor([-1.0, 1.7], dtype=torch.float64)
    share = at / (2 * torch.pi) * torch.tensor([1, -1]) + 0.5
    shown.mouse.move(box["x"] + float(share[0]) * box["width"], box["y"] + float(share[1]) * box["height"])
    said = shown.locator("#note").inner_text()
    wanted = float(load_run(path, scene.manifold).arrival.time(at[None])[0])
    assert (
        abs(float(said.removeprefix("T = ").split()[0]) - wanted) < 0.1 * wanted
    )  # the nearest point of a coarse mesh

    read = shown.evaluate("viewer.ask(viewer.canvas.clientWidth / 2, 2)")
    assert read is None, "there is nothing at the upper edge"
    goal = shown.evaluate(f"({ASK_AT_THE_GOAL})()")
    assert goal["time"] < 0.4
    assert not goal["blocked"]
    assert complaints == []
    shown.close()


def test_without_a_script_there_are_pictures(tmp_path: Path, browser: Browser) -> None:
    path, scene = trained(tmp_path, "S2")
    file = write_report(path, paths_from=2, manifold=scene.manifold)
    shown = browser.new_page(java_script_enabled=False, color_scheme="dark", viewport={"width": 420, "height": 800})
    shown.goto(file.as_uri())
    assert shown.locator("#space img").is_visible()
    assert not shown.locator("#space canvas").is_visible()
    assert shown.locator("svg.flat .paths .way").first.is_visible()
    assert shown.locator("svg.plot").count() == 3
    assert shown.evaluate("1 + 1") == 2  # the driver's own, which runs all the same
    width = shown.evaluate("document.documentElement.scrollWidth")
    assert width <= 420, "a narrow window scrolls sideways"
    shown.close()
