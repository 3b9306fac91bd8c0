// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The picture: camera, controls, keys, a cell's numbers.
"use strict";

const kindNames = ["host", "refined", "transition", "radial"];
const kindColours = [[186, 192, 200], [86, 180, 233], [230, 159, 0], [0, 158, 115]];
// Dark to light with even steps of lightness, told apart by every kind of colour sight.
const rampStops = [[38, 30, 84], [38, 82, 134], [26, 129, 138], [70, 171, 108], [170, 204, 72], [253, 231, 76]];

function smoothRamp(stops, count = 256) {
  return Array.from({length: count}, (_, i) => {
    const place = i / (count - 1) * (stops.length - 1), k = Math.min(stops.length - 2, Math.floor(place)),
          t = place - k;
    return [0, 1, 2].map((c) => Math.round(stops[k][c] + t * (stops[k + 1][c] - stops[k][c])));
  });
}

class Viewer {
  constructor(picture) {
    this.picture = picture;
    this.canvas = document.getElementById("v-canvas");
    this.drawing = new Drawing(this.canvas);
    this.chosen = null;
    this.pending = false;
    this.fineness = 0.5;
  }

  element(name) {
    return document.getElementById("v-" + name);
  }

  async open() {
    const names = ["vertices", "face_size", "face_vertices", "face_first", "face_second", "kind"];
    const [vertices, sizes, loops, first, second, kind] = await Promise.all(names.map(meshArray));
    this.surface = new Surface(this.picture.cells, vertices, sizes, loops, first, second);
    this.kind = kind;
    this.paths = this.picture.wells.map((well) => {
      const points = [];
      for (let i = 0; i < well.path.length; i += 3) points.push([well.path[i], well.path[i + 1], -well.path[i + 2]]);
      return points;
    });
    this.drawing.setPaths(this.paths);
    this.fillControls();
    this.listen();
    await this.reset();
    this.element("state").textContent = "";
  }

  fillControls() {
    for (const {name, title} of this.picture.arrays) this.element("array").add(new Option(title, name));
    this.element("target").add(new Option("the whole mesh", "all"));
    this.picture.wells.forEach((well, i) => this.element("target").add(new Option(well.name, String(i))));
    const present = new Set(this.kind);
    kindNames.forEach((name, i) => {
      if (!present.has(i)) return;
      const label = document.createElement("label"), box = document.createElement("input");
      box.type = "checkbox";
      box.checked = true;
      box.dataset.kind = i;
      box.addEventListener("change", () => this.rebuild());
      label.append(box, " " + name);
      this.element("kinds").append(label);
    });
    this.element("cell").max = this.picture.cells - 1;
  }

  listen() {
    const on = (name, event, action) => this.element(name).addEventListener(event, action);
    on("array", "change", () => this.colourBy(this.element("array").value));
    on("target", "change", () => this.lookAt(this.element("target").value));
    for (const name of ["axis", "flip", "whole", "low", "high"]) on(name, "change", () => this.rebuild());
    on("place", "input", () => this.rebuild(true));
    on("height", "change", () => {
      this.stretchHeight(Number(this.element("height").value) || 1);
      this.redraw();
    });
    for (const name of ["edges", "wells"]) on(name, "change", () => this.redraw());
    on("cell", "change", () => {
      if (this.element("cell").value !== "") this.choose(Number(this.element("cell").value));
    });
    on("top", "click", () => this.turnTo(0, Math.PI / 2));
    on("side", "click", () => this.turnTo(0, 0));
    on("reset", "click", () => this.reset());
    this.canvas.addEventListener("pointerdown", (e) => this.dragFrom(e));
    this.canvas.addEventListener("wheel", (e) => {
      e.preventDefault();
      this.zoom(Math.exp(e.deltaY * 0.001));
    }, {passive: false});
    this.canvas.addEventListener("contextmenu", (e) => e.preventDefault());
    this.canvas.addEventListener("keydown", (e) => this.key(e));
    new ResizeObserver(() => this.redraw()).observe(this.canvas);
  }

  // ---- what is shown

  async reset() {
    const {low, high} = this.surface;
    const flat = Math.max(high[0] - low[0], high[1] - low[1]) / Math.max(1e-9, high[2] - low[2]);
    this.element("height").value = flat > 4 ? Math.min(20, Math.max(1, Math.round(flat / 4))) : 1;
    this.stretchHeight(Number(this.element("height").value));
    for (const box of this.element("kinds").querySelectorAll("input")) box.checked = true;
    this.element("flip").checked = this.element("whole").checked = false;
    const meshed = this.picture.wells.findIndex((well) => well.radius > 0);
    this.element("axis").value = meshed >= 0 ? "well" : "none";
    this.element("target").value = meshed >= 0 ? String(meshed) : "all";
    this.element("array").value = "kind";
    this.chosen = null;
    this.element("numbers").replaceChildren();
    await this.colourBy("kind", false);
    this.lookAt(this.element("target").value);
  }

  async colourBy(name, build = true) {
    const values = await meshArray(name);
    let low = Infinity, high = -Infinity;
    for (const v of values) {
      if (!Number.isFinite(v)) continue;
      if (v < low) low = v;
      if (v > high) high = v;
    }
    if (!(low <= high)) low = high = 0;
    this.values = values;
    this.name = name;
    this.range = name === "kind" ? [-0.5, 3.5] : [low, high];
    this.drawing.setValues(values);
    this.drawing.setRamp(name === "kind" ? kindColours : smoothRamp(rampStops));
    this.element("low").value = this.element("high").value = "";
    this.element("low").placeholder = this.short(low);
    this.element("high").placeholder = this.short(high);
    this.showLegend(low, high);
    if (build) this.rebuild();
  }

  short(v) {
    return Number.isInteger(v) && Math.abs(v) < 1e9 ? String(v) : v.toPrecision(4);
  }

  showLegend(low, high) {
    const legend = this.element("legend");
    legend.replaceChildren();
    const text = (words) => {
      const s = document.createElement("span");
      s.textContent = words;
      return s;
    };
    const css = (c) => `rgb(${c.join(",")})`;
    if (this.name === "kind") {
      const present = new Set(this.kind);
      kindNames.forEach((name, i) => {
        if (!present.has(i)) return;
        const swatch = document.createElement("i");
        swatch.style.background = css(kindColours[i]);
        legend.append(swatch, text(name));
      });
      return;
    }
    const bar = document.createElement("b");
    bar.style.background = `linear-gradient(to right, ${rampStops.map(css).join(",")})`;
    legend.append(text(this.short(low)), bar, text(this.short(high)));
  }

  // The plane [a, b, c, d] of the cut; what has a x + b y + c z + d > 0 is taken away.
  plane() {
    const axis = this.element("axis").value;
    if (axis === "none") return null;
    let normal = {x: [1, 0, 0], y: [0, -1, 0], z: [0, 0, 1]}[axis];
    const path = this.paths[Number(this.element("target").value)] || this.paths[0];
    if (!normal) {
      const along = path ? minus(path[path.length - 1], path[0]) : [1, 0, 0];
      const flat = Math.hypot(along[0], along[1]);
      normal = flat > 0.05 * norm(along) ? [along[1] / flat, -along[0] / flat, 0] : [0, -1, 0];
      if (normal[1] > 0) normal = [-normal[0], -normal[1], 0];
    }
    if (this.element("flip").checked) normal = normal.map((v) => -v);
    const corner = (pick) =>
        normal.reduce((sum, n, i) => sum + n * (pick(n) ? this.surface.high : this.surface.low)[i], 0);
    const from = corner((n) => n < 0), to = corner((n) => n > 0);
    let middle = 0.5 * (from + to);
    if (path && axis !== "z") middle = path.reduce((sum, p) => sum + dot(normal, p), 0) / path.length;
    // The slider goes from one side of the mesh over the well, in the middle, to the other side.
    const place = Number(this.element("place").value) / 500 - 1;
    const offset = place < 0 ? middle + place * (middle - from) : middle + place * (to - middle);
    return [...normal, -offset];
  }

  rebuild(moving = false) {
    const kinds = [0, 0, 0, 0];
    for (const box of this.element("kinds").querySelectorAll("input"))
      kinds[Number(box.dataset.kind)] = box.checked ? 1 : 0;
    const bound = (name, fallback) => this.element(name).value === "" ? fallback : Number(this.element(name).value);
    const low = bound("low", -Infinity), high = bound("high", Infinity);
    const bounded = low > -Infinity || high < Infinity;
    const plane = this.plane(), whole = this.element("whole").checked;
    const wanted = (c) => kinds[this.kind[c]] && (!bounded || (this.values[c] >= low && this.values[c] <= high));
    this.surface.choose(wanted, whole ? plane : null);
    this.surface.cut(whole ? null : plane);
    this.clip = whole ? null : plane;
    this.drawing.outside.load(this.surface.outside);
    this.drawing.section.load(this.surface.section);
    this.redraw(moving);
  }

  // ---- camera

  stretchHeight(times) {
    this.stretch = [1, 1, times];
  }

  lookAt(target) {
    const {low, high} = this.surface;
    let from = low, to = high;
    const path = this.paths[Number(target)], well = this.picture.wells[Number(target)];
    if (path) {
      const margin = 3 * (well.radius || 0.02 * norm(minus(high, low)));
      const inside = path.map((p) => p.map((v, i) => Math.min(high[i], Math.max(low[i], v))));
      from = [0, 1, 2].map((i) => Math.max(low[i], Math.min(...inside.map((p) => p[i])) - margin));
      to = [0, 1, 2].map((i) => Math.min(high[i], Math.max(...inside.map((p) => p[i])) + margin));
    }
    this.middle = [0, 1, 2].map((i) => 0.5 * (from[i] + to[i]) * this.stretch[i]);
    this.distance = 1.1 * norm([0, 1, 2].map((i) => (to[i] - from[i]) * this.stretch[i])) || 1;
    const plane = this.plane();
    this.azimuth = plane && Math.abs(plane[2]) < 0.5 ? Math.atan2(plane[1], plane[0]) + Math.PI / 2 + 0.45 : 0.6;
    this.elevation = 0.45;
    this.rebuild();
  }

  turnTo(azimuth, elevation) {
    this.azimuth = azimuth;
    this.elevation = elevation;
    this.redraw();
  }

  // The eye's axes: right, up, and back towards it.
  axes() {
    const ca = Math.cos(this.azimuth), sa = Math.sin(this.azimuth), ce = Math.cos(this.elevation),
          se = Math.sin(this.elevation);
    const back = [sa * ce, -ca * ce, se], right = [ca, sa, 0];
    return {right, up: cross(back, right), back};
  }

  scene() {
    const {right, up, back} = this.axes();
    const eye = plus(this.middle, back, this.distance);
    const size = norm(minus(this.surface.high, this.surface.low).map((v, i) => v * this.stretch[i]));
    const aspect = this.canvas.width / Math.max(1, this.canvas.height);
    const near = Math.max(0.002 * this.distance, this.distance - 1.2 * size), far = this.distance + 1.2 * size;
    const dark = getComputedStyle(document.documentElement).getPropertyValue("--paper").trim();
    const paper = [1, 3, 5].map((i) => (parseInt(dark.slice(i, i + 2), 16) || 0) / 255);
    return {
      matrix: product(perspective(0.6, aspect, near, far), lookingAt(eye, right, up, back)),
      // Edges are drawn as if nearer by 0.2 % of their distance: enough to stand before their own faces, and too little
      // to shine through what is behind the mesh's rim.
      nearer: 0.002 * 2.0 * far * near / (far - near),
      stretch: this.stretch,
      toEye: back,
      plane: this.clip,
      range: this.range,
      chosen: this.chosen,
      paper,
      edges: this.element("edges").checked,
      wells: this.element("wells").checked
    };
  }

  // On the next frame; `moving` while a hand is at it: then as fine as the machine keeps up with, and fine afterwards.
  redraw(moving = false) {
    if (!this.middle) return;
    this.moving = this.moving || moving;
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame((now) => {
      this.pending = false;
      if (this.moving) this.keepUp(now);
      this.drawNow(this.moving ? this.fineness : 1);
      if (this.moving) {
        clearTimeout(this.settling);
        this.settling = setTimeout(() => this.redraw(), 150);
      }
      this.moving = false;
    });
  }

  // Frames further apart than 50 ms are too slow: fewer pixels; closer than 25 ms: more.
  keepUp(now) {
    const passed = now - (this.lastFrame || 0);
    this.lastFrame = now;
    if (passed > 500) return;  // the hand had paused
    if (passed > 50) this.fineness = Math.max(0.2, this.fineness * 0.7);
    if (passed < 25) this.fineness = Math.min(1, this.fineness * 1.1);
  }

  // Twice as many pixels as the screen has smooth the edges.
  drawNow(fineness = 1) {
    const scale = 2 * fineness;
    const width = Math.max(1, Math.round(this.canvas.clientWidth * scale));
    const height = Math.max(1, Math.round(this.canvas.clientHeight * scale));
    if (this.canvas.width !== width || this.canvas.height !== height) Object.assign(this.canvas, {width, height});
    const scene = this.scene();
    if (fineness < 0.3) scene.edges = false;  // lines cost the most where a processor draws them
    this.drawing.draw(scene);
    this.placeNames(scene);
  }

  placeNames(scene) {
    const box = this.element("names");
    box.replaceChildren();
    if (!scene.wells) return;
    this.picture.wells.forEach((well, i) => {
      if (this.paths[i].length === 0) return;
      const [x, y, , w] = projected(scene.matrix, this.paths[i][0].map((v, k) => v * this.stretch[k]));
      if (w <= 0 || Math.abs(x) > 1 || Math.abs(y) > 1) return;
      const name = document.createElement("span");
      name.textContent = well.name;
      name.style.left = `${50 + 50 * x}%`;
      name.style.top = `${50 - 50 * y}%`;
      box.append(name);
    });
  }

  turn(right, up) {
    this.azimuth -= right;
    this.elevation = Math.min(Math.PI / 2, Math.max(-Math.PI / 2, this.elevation + up));
    this.redraw(true);
  }

  // By parts of the picture's height.
  move(right, up) {
    const axes = this.axes(), reach = 0.62 * this.distance;
    this.middle = plus(plus(this.middle, axes.right, -right * reach), axes.up, -up * reach);
    this.redraw(true);
  }

  zoom(times) {
    this.distance *= times;
    this.redraw(true);
  }

  // ---- the user's hands

  dragFrom(start) {
    this.canvas.focus();
    this.canvas.setPointerCapture(start.pointerId);
    const moves = start.button !== 0 || start.shiftKey;
    let last = start, travelled = 0;
    const go = (e) => {
      const dx = e.clientX - last.clientX, dy = e.clientY - last.clientY;
      travelled += Math.abs(dx) + Math.abs(dy);
      last = e;
      if (moves)
        this.move(dx / this.canvas.clientHeight, -dy / this.canvas.clientHeight);
      else
        this.turn(dx * 0.008, dy * 0.008);
    };
    const end = (e) => {
      this.canvas.removeEventListener("pointermove", go);
      this.canvas.removeEventListener("pointerup", end);
      this.canvas.removeEventListener("pointercancel", end);
      if (travelled < 4 && start.button === 0 && e.type === "pointerup") this.pickAt(e);
    };
    this.canvas.addEventListener("pointermove", go);
    this.canvas.addEventListener("pointerup", end);
    this.canvas.addEventListener("pointercancel", end);
  }

  pickAt(e) {
    const box = this.canvas.getBoundingClientRect(), scale = this.canvas.width / box.width;
    const x = Math.floor((e.clientX - box.left) * scale),
          y = this.canvas.height - 1 - Math.floor((e.clientY - box.top) * scale);
    this.choose(this.drawing.cellAt(this.scene(), x, y), false);
  }

  key(e) {
    const step = 0.1, arrows = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]}[e.key];
    const slide = (by) => {
      this.element("place").value = Number(this.element("place").value) + by;
      this.rebuild(true);
    };
    if (arrows && e.shiftKey)
      this.move(-0.5 * step * arrows[0], -0.5 * step * arrows[1]);
    else if (arrows)
      this.turn(step * arrows[0], -step * arrows[1]);
    else if (e.key === "+" || e.key === "=")
      this.zoom(0.8);
    else if (e.key === "-")
      this.zoom(1.25);
    else if (e.key === "[")
      slide(-10);
    else if (e.key === "]")
      slide(10);
    else if (e.key === "Home")
      this.reset();
    else
      return;
    e.preventDefault();
  }

  // ---- a cell's numbers

  // Shows a cell's numbers; with `near` the camera and the cut go there.
  async choose(cell, near = true) {
    this.chosen = cell !== null && cell >= 0 && cell < this.picture.cells ? cell : null;
    const box = this.element("numbers");
    if (this.chosen === null) {
      box.replaceChildren();
      this.redraw();
      return;
    }
    if (near) this.goTo(this.chosen);
    const table = document.createElement("table");
    table.createCaption().textContent = `Cell ${this.chosen}`;
    const add = (title, text, name = "") => {
      const line = table.insertRow();
      line.insertCell().textContent = title;
      const value = line.insertCell();
      value.textContent = text;
      value.dataset.array = name;
    };
    const arrays = await Promise.all(this.picture.arrays.map(({name}) => meshArray(name)));
    const m = this.surface.middles, o = this.picture.origin, c = this.chosen;
    add("middle x, y, depth, m",
        [o[0] + m[3 * c], o[1] + m[3 * c + 1], o[2] - m[3 * c + 2]].map((v) => v.toFixed(1)).join(", "));
    this.picture.arrays.forEach(
        ({name, title}, i) => add(title, name === "kind" ? kindNames[arrays[i][c]] : this.short(arrays[i][c]), name));
    box.replaceChildren(table);
    box.dataset.cell = c;
    this.redraw();
  }

  // Through the cell's middle goes the cut, and the camera to it.
  goTo(cell) {
    const m = this.surface.middles, at = [m[3 * cell], m[3 * cell + 1], m[3 * cell + 2]];
    if (this.element("axis").value === "none") this.element("axis").value = "y";
    this.element("place").value = 500;
    const slider = this.element("place"), side = (place) => {
      slider.value = place;
      const p = this.plane();
      return dot(p, at) + p[3];
    };
    let low = 0, high = 1000;  // the plane moves along its normal: the cell's side changes once
    while (high - low > 1) {
      const half = (low + high) >> 1;
      if (side(half) > 0)
        low = half;
      else
        high = half;
    }
    slider.value = low;
    this.middle = at.map((v, i) => v * this.stretch[i]);
    this.distance = Math.min(
        this.distance, 0.4 * norm(minus(this.surface.high, this.surface.low).map((v, i) => v * this.stretch[i])));
    this.rebuild();
  }
}
