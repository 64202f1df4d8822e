// What one can do with the page: turn the field, read T under the pointer, read the curves.
"use strict";

(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const note = document.getElementById("note");
  const figure = (value) => (Math.abs(value) >= 100 ? value.toFixed(1) : value.toPrecision(4));

  function say(text, event) {
    note.hidden = !text;
    if (!text) return;
    note.textContent = text;
    const right = event.clientX > window.innerWidth - 200;
    note.style.left = `${event.clientX + (right ? -14 - note.offsetWidth : 14)}px`;
    note.style.top = `${event.clientY + 14}px`;
  }

  function space() {
    const panel = document.getElementById("space");
    if (!panel || !data.space.kind) return;
    const canvas = panel.querySelector("canvas");
    let viewer;
    try {
      viewer = new Viewer(canvas, { ...data.space, top: data.top, step: data.step, palette: data.palette });
    } catch (error) {
      panel.dataset.state = "still";
      panel.querySelector(".why").textContent = `It cannot be turned here: ${error.message}.`;
      return;
    }
    panel.dataset.state = "live";
    window.viewer = viewer;
    for (const box of panel.querySelectorAll("input[type=checkbox]"))
      box.addEventListener("change", () => { viewer.shown[box.name] = box.checked; viewer.draw(); });
    for (const radio of panel.querySelectorAll("input[name=shape]"))
      radio.addEventListener("change", () => viewer.choose(Number(radio.value)));
    const front = panel.querySelector("input[name=until]"), reading = panel.querySelector("output");
    const advance = () => {
      viewer.until = Number(front.value) >= 1 ? 1e30 : Number(front.value) * data.top;
      reading.textContent = Number(front.value) >= 1 ? "all" : figure(viewer.until);
      viewer.draw();
    };
    front.addEventListener("input", advance);
    advance();
    panel.querySelector("button").addEventListener("click", () => viewer.reset());
    canvas.addEventListener("pointermove", (event) => {
      if (event.buttons) return say("");
      const box = canvas.getBoundingClientRect();
      const found = viewer.ask(event.clientX - box.left, event.clientY - box.top);
      say(found ? `T = ${figure(found.time)}${found.blocked ? " (in an obstacle)" : ""}` : "", event);
    });
    canvas.addEventListener("pointerleave", () => say(""));
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => viewer.draw());
  }

  // T of a flat view at a position in its plane, from the nearest point of its mesh.
  function readSheet(sheet, x, y) {
    let row, column;
    if (sheet.round) {
      row = (Math.hypot(x, y) / sheet.half[0]) * (sheet.rows - 1);
      column = (((Math.atan2(y, x) / (2 * Math.PI) + 1) % 1) * (sheet.columns - 1));
    } else {
      row = ((y / sheet.half[1] + 1) / 2) * (sheet.rows - 1);
      column = ((x / sheet.half[0] + 1) / 2) * (sheet.columns - 1);
    }
    if (row < 0 || row > sheet.rows - 1 || column < 0 || column > sheet.columns - 1) return null;
    const at = Math.round(row) * sheet.columns + Math.round(column);
    return { time: sheet.values[at], blocked: sheet.distances[at] < 0 };
  }

  function flat() {
    for (const drawing of document.querySelectorAll("svg.flat")) {
      const sheet = data.sheets[Number(drawing.dataset.sheet)];
      sheet.values = unpack(sheet.time);
      sheet.distances = unpack(sheet.distance);
      const image = drawing.querySelector("image");
      drawing.addEventListener("pointermove", (event) => {
        const box = image.getBoundingClientRect();
        const x = (2 * (event.clientX - box.left) / box.width - 1) * sheet.half[0];
        const y = (1 - 2 * (event.clientY - box.top) / box.height) * sheet.half[1];
        const found = readSheet(sheet, x, y);
        const told = found && !Number.isNaN(found.time);
        say(told ? `T = ${figure(found.time)}${found.blocked ? " (in an obstacle)" : ""}` : "", event);
      });
      drawing.addEventListener("pointerleave", () => say(""));
    }
    for (const box of document.querySelectorAll("#flat input[type=checkbox]")) {
      const show = () => document.querySelectorAll(`#flat .${box.name}`).forEach((part) => part.classList.toggle("off", !box.checked));
      box.addEventListener("change", show);
      show();
    }
  }

  function curves() {
    for (const drawing of document.querySelectorAll("svg.plot")) {
      const lines = [...drawing.querySelectorAll(".curve")].map((path) => ({
        points: path.getAttribute("d").slice(1).split("L").map((pair) => pair.split(" ").map(Number)),
        notes: path.dataset.notes.split("\n"),
      }));
      const mark = document.createElementNS(drawing.namespaceURI, "path");
      mark.setAttribute("class", "mark");
      drawing.append(mark);
      drawing.addEventListener("pointermove", (event) => {
        const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(drawing.getScreenCTM().inverse());
        let best = null;
        for (const { points, notes } of lines)
          points.forEach(([x, y], i) => {
            const away = Math.hypot(x - at.x, (y - at.y) / 4);
            if (!best || away < best.away) best = { away, x, y, text: notes[i] };
          });
        mark.setAttribute("d", `M${best.x} ${best.y}h.01`);
        say(best.text, event);
      });
      drawing.addEventListener("pointerleave", () => { mark.removeAttribute("d"); say(""); });
    }
  }

  space();
  flat();
  curves();
  document.documentElement.dataset.ready = "true";
})();
