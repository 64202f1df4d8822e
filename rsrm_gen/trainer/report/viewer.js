// Turns what is drawn of a field in space: a surface or a cloud of points, coloured by T, with lines and dots on it.
"use strict";

// 16-bit integers in base64 to numbers; the greatest integer is NaN.
function unpack(packed) {
  const bytes = Uint8Array.from(atob(packed.data), (c) => c.charCodeAt(0));
  const steps = new DataView(bytes.buffer);
  const values = new Float32Array(bytes.length / 2);
  const unit = (packed.high - packed.low) / 65534;
  for (let i = 0; i < values.length; i++) {
    const step = steps.getUint16(2 * i, true);
    values[i] = step === 65535 ? NaN : packed.low + unit * step;
  }
  return values;
}

// Lines end to end to pairs of ends: (ax, ay, az, bx, by, bz) for each segment.
function segments(lines) {
  const positions = unpack(lines);
  const starts = new Set(lines.starts);
  const found = [];
  for (let i = 1; i < positions.length / 3; i++)
    if (!starts.has(i)) found.push(...positions.subarray(3 * i - 3, 3 * i + 3));
  return new Float32Array(found);
}

const SHADED = `
  uniform sampler2D palette;
  uniform float top, step_, until, pick;
  uniform vec3 ink, stone;
  vec3 coloured(float t) { return texture(palette, vec2((clamp(t / top, 0., 1.) * 255. + .5) / 256., .5)).rgb; }
  vec4 told(float t, float distance) {
    float share = clamp(t / top, 0., 1.) * 65535.;
    return vec4(floor(share / 256.) / 255., mod(floor(share), 256.) / 255., distance < 0. ? 1. : 0., 1.);
  }`;

const SURFACE = [
  `#version 300 es
  layout(location = 0) in vec3 position;
  layout(location = 1) in vec3 normal;
  layout(location = 2) in vec2 known;
  uniform mat4 camera;
  out vec3 n, at;
  out vec2 k;
  void main() { n = normal; at = position; k = known; gl_Position = camera * vec4(position, 1.); }`,
  `#version 300 es
  precision highp float;
  in vec3 n, at;
  in vec2 k;
  uniform vec3 eye, lamp;
  out vec4 colour;
  ${SHADED}
  // How much of a pixel a line along v = 0 covers; v changes by w from a pixel to the next.
  float along(float v, float w, float width) { return 1. - smoothstep(width - .5, width + .5, abs(v) / max(w, 1e-9)); }
  void main() {
    if (pick > .5) { colour = told(k.x, k.y); return; }
    vec3 m = normalize(n);
    float side = sign(dot(m, eye - at));
    float light = .64 + .4 * max(side * dot(m, lamp), 0.);
    float level = k.x / step_;
    vec3 c = coloured(k.x);
    if (k.x > until) c = mix(c, stone, .78);
    float line = along(fract(level + .5) - .5, fwidth(level), .7) * step(.5, level + .25) * step(k.x, until);
    c = mix(c, vec3(1.), .62 * line);
    if (k.y < 0.) {
      float stripe = abs(fract((gl_FragCoord.x + gl_FragCoord.y) / 11.) - .5);
      c = mix(stone, ink, .22 * (1. - smoothstep(.04, .1, stripe)));
    }
    c *= light;
    c = mix(c, ink, along(k.y, fwidth(k.y), 1.));
    colour = vec4(c, 1.);
  }`,
];

const LINES = [
  `#version 300 es
  layout(location = 0) in vec2 corner;
  layout(location = 1) in vec3 a;
  layout(location = 2) in vec3 b;
  uniform mat4 camera;
  uniform vec2 screen;
  uniform float width, lift;
  out vec2 p;
  flat out float len;
  void main() {
    vec4 ca = camera * vec4(a, 1.), cb = camera * vec4(b, 1.);
    vec2 sa = ca.xy / ca.w * screen / 2., sb = cb.xy / cb.w * screen / 2.;
    len = max(length(sb - sa), 1e-4);
    vec2 way = (sb - sa) / len, across = vec2(-way.y, way.x);
    float r = width / 2. + 1.;
    p = vec2(mix(-r, len + r, corner.x), mix(-r, r, corner.y));
    vec4 c = corner.x < .5 ? ca : cb;
    vec2 s = sa + way * p.x + across * p.y;
    gl_Position = vec4(s / screen * 2. * c.w, c.z - lift * c.w, c.w);
  }`,
  `#version 300 es
  precision highp float;
  in vec2 p;
  flat in float len;
  uniform float width;
  uniform vec4 ink;
  out vec4 colour;
  void main() {
    float away = length(vec2(p.x - clamp(p.x, 0., len), p.y));
    float alpha = 1. - smoothstep(width / 2. - .5, width / 2. + .5, away);
    if (alpha < .04) discard;
    colour = vec4(ink.rgb, ink.a * alpha);
  }`,
];

const DOTS = [
  `#version 300 es
  layout(location = 0) in vec3 position;
  layout(location = 1) in vec2 known;
  uniform mat4 camera;
  uniform float size, lift;
  out vec3 at;
  out vec2 k;
  void main() {
    at = position;
    k = known;
    gl_Position = camera * vec4(position, 1.);
    gl_Position.z -= lift * gl_Position.w;
    gl_PointSize = max(size / gl_Position.w, 1.5);
  }`,
  `#version 300 es
  precision highp float;
  in vec3 at;
  in vec2 k;
  uniform vec3 eye;
  uniform vec4 plain;
  uniform float cut, star;
  out vec4 colour;
  ${SHADED}
  void main() {
    vec2 q = 2. * gl_PointCoord - 1.;
    float r = length(q), edge = fwidth(r);
    if (star > .5) {  // the goal: a star of five points with a rim
      float turn = mod(atan(q.x, -q.y) + .6283185, 1.2566371) - .6283185;
      float reach = .42 * .8 / (.42 * cos(turn) + abs(sin(turn)) * 1.1);
      if (r > reach + .2) discard;
      colour = vec4(r > reach ? ink : vec3(1.), 1.);
      return;
    }
    if (r > 1.) discard;
    if (plain.a > 0.) { colour = vec4(plain.rgb, plain.a * (1. - smoothstep(1. - edge, 1., r))); return; }
    if (isnan(k.x) || k.x > until || (cut > .5 && dot(at, normalize(eye)) > .02)) discard;
    if (pick > .5) { colour = told(k.x, k.y); return; }
    vec3 c = k.y < 0. ? stone : coloured(k.x);
    colour = vec4(c * (1. - .28 * r * r), 1.);
  }`,
];

class Viewer {
  constructor(canvas, data) {
    this.canvas = canvas;
    this.data = data;
    this.gl = canvas.getContext("webgl2", { antialias: true, alpha: true, preserveDrawingBuffer: true });
    if (!this.gl) throw new Error("no WebGL 2");
    this.programs = { surface: this.program(SURFACE), lines: this.program(LINES), dots: this.program(DOTS) };
    this.shown = { paths: true, splats: false, levels: true, cut: data.kind === "cloud" };
    this.until = data.top;
    this.known = this.pairs(unpack(data.time), unpack(data.distance));
    this.shapes = data.shapes.map((shape) => this.shape(shape));
    this.palette = this.texture(unpack(data.palette));
    this.target = null;
    this.choose(0);
    this.listen();
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  program([vertex, fragment]) {
    const gl = this.gl, program = gl.createProgram(), uniforms = {};
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
    for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); i++) {
      const { name } = gl.getActiveUniform(program, i);
      uniforms[name] = gl.getUniformLocation(program, name);
    }
    return { program, uniforms };
  }

  buffer(values, kind = this.gl.ARRAY_BUFFER) {
    const buffer = this.gl.createBuffer();
    this.gl.bindVertexArray(null);
    this.gl.bindBuffer(kind, buffer);
    this.gl.bufferData(kind, values, this.gl.STATIC_DRAW);
    return buffer;
  }

  // Attributes: [place, buffer, numbers, numbers between, first, instanced].
  layout(attributes, indices = null) {
    const gl = this.gl, layout = gl.createVertexArray();
    gl.bindVertexArray(layout);
    for (const [place, buffer, size, stride = size, first = 0, instanced = 0] of attributes) {
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.enableVertexAttribArray(place);
      gl.vertexAttribPointer(place, size, gl.FLOAT, false, 4 * stride, 4 * first);
      gl.vertexAttribDivisor(place, instanced);
    }
    if (indices) gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, indices);
    gl.bindVertexArray(null);
    return layout;
  }

  pairs(time, distance) {
    const known = new Float32Array(2 * time.length);
    for (let i = 0; i < time.length; i++) { known[2 * i] = time[i]; known[2 * i + 1] = distance[i]; }
    return this.buffer(known);
  }

  lines(packed) {
    const ends = segments(packed);
    this.corners ??= this.buffer(new Float32Array([0, 0, 1, 0, 0, 1, 1, 1]));
    const buffer = this.buffer(ends);
    return { count: ends.length / 6, layout: this.layout([[0, this.corners, 2], [1, buffer, 3, 6, 0, 1], [2, buffer, 3, 6, 3, 1]]) };
  }

  dots(positions) {
    const buffer = this.buffer(positions);
    return { count: positions.length / 3, layout: this.layout([[0, buffer, 3]]) };
  }

  shape(given) {
    const positions = this.buffer(unpack(given.positions));
    const made = {
      toward: given.toward,
      count: unpack(given.positions).length / 3,
      rim: this.lines(given.rim),
      paths: this.lines(given.paths),
      raise: this.lines(given.raise),
      lower: this.lines(given.lower),
      centers: this.dots(unpack(given.centers)),
      goal: this.dots(new Float32Array(given.goal)),
    };
    if (this.data.kind === "cloud") return { ...made, cloud: this.layout([[0, positions, 3], [1, this.known, 2]]) };
    const normals = this.buffer(unpack(given.normals));
    this.triangles ??= this.buffer(this.indices(), this.gl.ELEMENT_ARRAY_BUFFER);
    return { ...made, surface: this.layout([[0, positions, 3], [1, normals, 3], [2, this.known, 2]], this.triangles) };
  }

  indices() {
    const { rows, columns } = this.data, found = new Uint32Array(6 * (rows - 1) * (columns - 1));
    let n = 0;
    for (let i = 0; i + 1 < rows; i++)
      for (let j = 0; j + 1 < columns; j++) {
        const a = i * columns + j, b = a + columns;
        found.set([a, b, b + 1, a, b + 1, a + 1], n);
        n += 6;
      }
    return found;
  }

  texture(values) {
    const gl = this.gl, texture = gl.createTexture(), rgba = new Uint8Array(256 * 4);
    for (let i = 0; i < 256; i++) rgba.set([...values.subarray(3 * i, 3 * i + 3)].map((c) => Math.round(255 * c)).concat(255), 4 * i);
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, rgba);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
    return texture;
  }

  choose(number) {
    this.current = this.shapes[number];
    this.reset();
  }

  reset() {
    const [x, y, z] = this.current.toward;
    this.azimuth = Math.atan2(y, x);
    this.elevation = Math.asin(z / Math.hypot(x, y, z));
    this.zoom = 1;
    this.draw();
  }

  turn(azimuth, elevation) {
    this.azimuth += azimuth;
    this.elevation = Math.max(-1.57, Math.min(1.57, this.elevation + elevation));
    this.draw();
  }

  closer(factor) {
    this.zoom = Math.max(0.5, Math.min(12, this.zoom * factor));
    this.draw();
  }

  // Perspective from a distance of 5 with a lens that the ball of radius 1 fills; column by column.
  camera() {
    const ca = Math.cos(this.azimuth), sa = Math.sin(this.azimuth), ce = Math.cos(this.elevation), se = Math.sin(this.elevation);
    const right = [-sa, ca, 0], up = [-se * ca, -se * sa, ce], toward = [ce * ca, ce * sa, se];
    const away = 5, near = 3, far = 7.5, lens = 4.75 * this.zoom;
    const aspect = this.canvas.width / this.canvas.height, sx = lens / Math.max(aspect, 1), sy = lens * Math.min(aspect, 1);
    const a = (far + near) / (far - near), b = (2 * far * near) / (far - near);
    const matrix = new Float32Array(16);
    for (let i = 0; i < 3; i++) matrix.set([sx * right[i], sy * up[i], -a * toward[i], -toward[i]], 4 * i);
    matrix.set([0, 0, a * away - b, away], 12);
    const lamp = [0, 1, 2].map((i) => toward[i] + 0.7 * up[i] - 0.5 * right[i]), size = Math.hypot(...lamp);
    return { matrix, eye: toward.map((c) => away * c), lamp: lamp.map((c) => c / size), lens };
  }

  style(name) {
    const parts = getComputedStyle(this.canvas).getPropertyValue(name).trim();
    const number = parseInt(parts.slice(1), 16);
    return [number >> 16, (number >> 8) & 255, number & 255].map((c) => c / 255);
  }

  draw() {
    if (this.waiting) return;
    this.waiting = requestAnimationFrame(() => { this.waiting = null; this.drawNow(); });
  }

  fit() {
    const ratio = window.devicePixelRatio || 1, { clientWidth, clientHeight } = this.canvas;
    const width = Math.max(1, Math.round(clientWidth * ratio)), height = Math.max(1, Math.round(clientHeight * ratio));
    if (this.canvas.width !== width || this.canvas.height !== height) Object.assign(this.canvas, { width, height });
    return ratio;
  }

  drawNow() {
    const gl = this.gl, ratio = this.fit(), camera = this.camera(), shape = this.current;
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.enable(gl.BLEND);
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    this.field(camera, ratio, false);
    gl.depthMask(false);
    if (!shape.surface) gl.disable(gl.DEPTH_TEST);  // lines among points: none could be followed else
    const ink = this.style("--line");
    this.stroke(shape.rim, [...ink, 0.9], 1.3, camera, ratio);
    if (this.shown.splats) {
      this.stroke(shape.raise, [...this.style("--raise"), 0.75], 1.1, camera, ratio);
      this.stroke(shape.lower, [...this.style("--lower"), 0.75], 1.1, camera, ratio);
      this.point(shape.centers, [...this.style("--centre"), 0.9], 15, camera, ratio);
    }
    if (this.shown.paths) {
      this.stroke(shape.paths, [1, 1, 1, 0.85], 4.2, camera, ratio);
      this.stroke(shape.paths, [...this.style("--way"), 1], 2.4, camera, ratio);
    }
    this.point(shape.goal, [1, 1, 1, 1], 105, camera, ratio, 1);
    gl.depthMask(true);
  }

  use(program, camera) {
    const gl = this.gl, u = program.uniforms;
    gl.useProgram(program.program);
    gl.uniformMatrix4fv(u.camera, false, camera.matrix);
    const numbers = { top: this.data.top, step_: this.shown.levels ? this.data.step : 1e9, until: this.until, pick: 0, cut: 0, star: 0 };
    for (const [name, value] of Object.entries(numbers)) if (u[name]) gl.uniform1f(u[name], value);
    if (u.ink) gl.uniform3fv(u.ink, [0.106, 0.106, 0.118]);
    if (u.stone) gl.uniform3fv(u.stone, this.style("--stone"));
    if (u.eye) gl.uniform3fv(u.eye, camera.eye);
    if (u.lamp) gl.uniform3fv(u.lamp, camera.lamp);
    if (u.screen) gl.uniform2f(u.screen, this.canvas.width, this.canvas.height);
    return u;
  }

  field(camera, ratio, picking) {
    const gl = this.gl, shape = this.current;
    if (shape.surface) {
      const u = this.use(this.programs.surface, camera);
      gl.uniform1f(u.pick, picking ? 1 : 0);
      gl.bindVertexArray(shape.surface);
      gl.drawElements(gl.TRIANGLES, 6 * (this.data.rows - 1) * (this.data.columns - 1), gl.UNSIGNED_INT, 0);
    } else {
      const u = this.use(this.programs.dots, camera);
      gl.uniform1f(u.pick, picking ? 1 : 0);
      gl.uniform1f(u.cut, this.shown.cut ? 1 : 0);
      // As large as the points are apart, so that none shines through.
      gl.uniform1f(u.size, 0.11 * Math.min(this.canvas.width, this.canvas.height) * this.zoom);
      gl.uniform1f(u.lift, 0);
      gl.uniform4f(u.plain, 0, 0, 0, 0);
      gl.bindVertexArray(shape.cloud);
      gl.drawArrays(gl.POINTS, 0, shape.count);
    }
  }

  stroke(lines, colour, width, camera, ratio) {
    if (!lines.count) return;
    const gl = this.gl, program = this.programs.lines, u = program.uniforms;
    gl.useProgram(program.program);
    gl.uniformMatrix4fv(u.camera, false, camera.matrix);
    gl.uniform2f(u.screen, this.canvas.width, this.canvas.height);
    gl.uniform1f(u.width, width * ratio);
    gl.uniform1f(u.lift, 0.006);
    gl.uniform4fv(u.ink, colour);
    gl.bindVertexArray(lines.layout);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, lines.count);
  }

  point(dots, colour, size, camera, ratio, star = 0) {
    if (!dots.count) return;
    const gl = this.gl, u = this.use(this.programs.dots, camera);
    gl.uniform4fv(u.plain, colour);
    gl.uniform1f(u.size, size * ratio);
    gl.uniform1f(u.lift, 0.01);
    gl.uniform1f(u.star, star);
    gl.bindVertexArray(dots.layout);
    gl.drawArrays(gl.POINTS, 0, dots.count);
  }

  // What lies under a place on the canvas: {time, blocked}, or null.
  ask(x, y) {
    const gl = this.gl, ratio = this.fit(), { width, height } = this.canvas;
    if (!this.target || this.target.width !== width || this.target.height !== height) this.target = this.offscreen(width, height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.target.frame);
    gl.viewport(0, 0, width, height);
    const px = Math.round(x * ratio), py = height - 1 - Math.round(y * ratio);
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(px, py, 1, 1);
    gl.disable(gl.BLEND);
    gl.enable(gl.DEPTH_TEST);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    this.field(this.camera(), ratio, true);
    const read = new Uint8Array(4);
    gl.readPixels(px, py, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, read);
    gl.disable(gl.SCISSOR_TEST);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    return read[3] ? { time: ((256 * read[0] + read[1]) / 65535) * this.data.top, blocked: read[2] > 127 } : null;
  }

  offscreen(width, height) {
    const gl = this.gl, frame = gl.createFramebuffer();
    if (this.target) gl.deleteFramebuffer(this.target.frame);
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    for (const [format, place] of [[gl.RGBA8, gl.COLOR_ATTACHMENT0], [gl.DEPTH_COMPONENT24, gl.DEPTH_ATTACHMENT]]) {
      const store = gl.createRenderbuffer();
      gl.bindRenderbuffer(gl.RENDERBUFFER, store);
      gl.renderbufferStorage(gl.RENDERBUFFER, format, width, height);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, place, gl.RENDERBUFFER, store);
    }
    return { frame, width, height };
  }

  listen() {
    const canvas = this.canvas, fingers = new Map();
    const spread = () => { const [a, b] = [...fingers.values()]; return Math.hypot(a.x - b.x, a.y - b.y); };
    canvas.addEventListener("pointerdown", (e) => {
      canvas.setPointerCapture(e.pointerId);
      fingers.set(e.pointerId, { x: e.clientX, y: e.clientY });
    });
    canvas.addEventListener("pointermove", (e) => {
      const last = fingers.get(e.pointerId);
      if (!last) return;
      const before = fingers.size === 2 ? spread() : 0;
      fingers.set(e.pointerId, { x: e.clientX, y: e.clientY });
      if (before) this.closer(spread() / before);
      else this.turn((last.x - e.clientX) / 140, (e.clientY - last.y) / 140);
    });
    for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, (e) => fingers.delete(e.pointerId));
    canvas.addEventListener("wheel", (e) => { e.preventDefault(); this.closer(Math.exp(-e.deltaY / 600)); }, { passive: false });
    canvas.addEventListener("dblclick", () => this.reset());
    const keys = { ArrowLeft: [0.1, 0], ArrowRight: [-0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] };
    canvas.addEventListener("keydown", (e) => {
      if (keys[e.key]) this.turn(...keys[e.key]);
      else if (e.key === "+" || e.key === "-") this.closer(e.key === "+" ? 1.15 : 1 / 1.15);
      else return;
      e.preventDefault();
    });
  }
}
