// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What of the mesh is drawn: the outside of the cells that are shown, and the section of a plane through them.
// Positions are x, y and minus depth, metres from the mesh's origin.
"use strict";

// A list of floats or words that grows.
class Growing {
  constructor(type, size = 1 << 16) {
    this.data = new type(size);
    this.length = 0;
  }
  room(more) {
    if (this.length + more <= this.data.length) return;
    const larger = new this.data.constructor(Math.max(2 * this.data.length, this.length + more));
    larger.set(this.data.subarray(0, this.length));
    this.data = larger;
  }
  clear() {
    this.length = 0;
  }
  view() {
    return this.data.subarray(0, this.length);
  }
}

// Triangles with the cell that each corner belongs to, and lines.
class Pieces {
  constructor() {
    this.points = new Growing(Float32Array);
    this.cells = new Growing(Uint32Array);
    this.lines = new Growing(Float32Array);
  }
  clear() {
    this.points.clear();
    this.cells.clear();
    this.lines.clear();
  }
}

class Surface {
  // vertices: all x, all y, all depths; face_size and face_vertices: the loops; first and second: the cells, -1
  // outside.
  constructor(cellCount, vertices, faceSize, faceVertices, first, second) {
    const n = vertices.length / 3;
    this.cellCount = cellCount;
    this.points = new Float32Array(3 * n);
    for (let i = 0; i < n; ++i) {
      this.points[3 * i] = vertices[i];
      this.points[3 * i + 1] = vertices[n + i];
      this.points[3 * i + 2] = -vertices[2 * n + i];
    }
    this.faceStart = new Int32Array(faceSize.length + 1);
    for (let f = 0; f < faceSize.length; ++f) this.faceStart[f + 1] = this.faceStart[f] + faceSize[f];
    this.loops = faceVertices;
    this.first = first;
    this.second = second;
    this.shown = new Uint8Array(cellCount).fill(1);
    this.outside = new Pieces();
    this.section = new Pieces();
    this.distance = new Float32Array(n);
    this.sums = new Float32Array(4 * cellCount);
    this.measure();
  }

  // The box of all points, and the middle of each cell's faces' points.
  measure() {
    this.low = [Infinity, Infinity, Infinity];
    this.high = [-Infinity, -Infinity, -Infinity];
    for (let i = 0; i < this.points.length; ++i) {
      const axis = i % 3, v = this.points[i];
      if (!Number.isFinite(v)) continue;
      if (v < this.low[axis]) this.low[axis] = v;
      if (v > this.high[axis]) this.high[axis] = v;
    }
    const counts = new Uint32Array(this.cellCount);
    this.middles = new Float32Array(3 * this.cellCount);
    for (let f = 0; f < this.first.length; ++f) {
      const begin = this.faceStart[f], end = this.faceStart[f + 1];
      for (const cell of [this.first[f], this.second[f]]) {
        if (cell < 0) continue;
        counts[cell] += end - begin;
        for (let i = begin; i < end; ++i)
          for (let axis = 0; axis < 3; ++axis) this.middles[3 * cell + axis] += this.points[3 * this.loops[i] + axis];
      }
    }
    for (let c = 0; c < this.cellCount; ++c)
      for (let axis = 0; axis < 3; ++axis) this.middles[3 * c + axis] /= Math.max(1, counts[c]);
  }

  // Which cells are shown: `wanted(cell)`, and with a plane [a, b, c, d] those whose middle is on its far side.
  choose(wanted, plane) {
    const m = this.middles;
    for (let c = 0; c < this.cellCount; ++c) {
      const kept = !plane || plane[0] * m[3 * c] + plane[1] * m[3 * c + 1] + plane[2] * m[3 * c + 2] + plane[3] <= 0;
      this.shown[c] = kept && wanted(c) ? 1 : 0;
    }
    this.makeOutside();
  }

  makeOutside() {
    const out = this.outside;
    out.clear();
    for (let f = 0; f < this.first.length; ++f) {
      const a = this.first[f], b = this.second[f];
      const seesA = a >= 0 && this.shown[a], seesB = b >= 0 && this.shown[b];
      if (seesA !== seesB && (seesA || seesB)) this.addFace(out, f, seesA ? a : b);
    }
  }

  addFace(out, f, cell) {
    const begin = this.faceStart[f], size = this.faceStart[f + 1] - begin;
    if (size < 3) return;
    const fan = size > 4;  // a face of more corners need not be convex: a fan around the mean of its corners
    const mean = [0, 0, 0];
    for (let i = 0; i < size; ++i)
      for (let axis = 0; axis < 3; ++axis) mean[axis] += this.points[3 * this.loops[begin + i] + axis] / size;
    const corner = (i) => 3 * this.loops[begin + i % size];
    const triangles = fan ? size : size - 2;
    out.points.room(9 * triangles);
    out.cells.room(3 * triangles);
    out.lines.room(6 * size);
    const p = out.points.data, l = out.lines.data;
    let at = out.points.length;
    for (let t = 0; t < triangles; ++t) {
      const b = corner(fan ? t : t + 1), c = corner(fan ? t + 1 : t + 2), a = corner(0);
      for (let axis = 0; axis < 3; ++axis) p[at++] = fan ? mean[axis] : this.points[a + axis];
      for (let axis = 0; axis < 3; ++axis) p[at++] = this.points[b + axis];
      for (let axis = 0; axis < 3; ++axis) p[at++] = this.points[c + axis];
    }
    out.points.length = at;
    out.cells.data.fill(cell, out.cells.length, out.cells.length + 3 * triangles);
    out.cells.length += 3 * triangles;
    at = out.lines.length;
    for (let i = 0; i < size; ++i)
      for (const end of [corner(i), corner(i + 1)])
        for (let axis = 0; axis < 3; ++axis) l[at++] = this.points[end + axis];
    out.lines.length = at;
  }

  // Ends of the pieces in which a face crosses the plane: pairs of points.
  crossings(f, ends) {
    const begin = this.faceStart[f], size = this.faceStart[f + 1] - begin;
    let count = 0;
    for (let i = 0; i < size; ++i) {
      const a = this.loops[begin + i], b = this.loops[begin + (i + 1) % size];
      const da = this.distance[a], db = this.distance[b];
      if ((da > 0) === (db > 0)) continue;
      const t = da / (da - db);
      for (let axis = 0; axis < 3; ++axis)
        ends[3 * count + axis] =
            this.points[3 * a + axis] + t * (this.points[3 * b + axis] - this.points[3 * a + axis]);
      if (++count === 8) break;
    }
    return count & ~1;
  }

  // The section of the shown cells: for each cell a fan around the middle of where its faces cross.
  cut(plane) {
    const out = this.section;
    out.clear();
    if (!plane) return;
    for (let v = 0; v < this.distance.length; ++v)
      this.distance[v] = plane[0] * this.points[3 * v] + plane[1] * this.points[3 * v + 1] +
          plane[2] * this.points[3 * v + 2] + plane[3];
    const ends = new Float32Array(24);
    const found = [];  // face, number of ends, the ends
    this.sums.fill(0);
    for (let f = 0; f < this.first.length; ++f) {
      const a = this.first[f], b = this.second[f];
      const seesA = a >= 0 && this.shown[a], seesB = b >= 0 && this.shown[b];
      if (!seesA && !seesB) continue;
      const count = this.crossings(f, ends);
      if (count === 0) continue;
      found.push(f, count);
      for (let i = 0; i < 3 * count; ++i) found.push(ends[i]);
      for (const cell of [seesA ? a : -1, seesB ? b : -1]) {
        if (cell < 0) continue;
        this.sums[4 * cell + 3] += count;
        for (let i = 0; i < count; ++i)
          for (let axis = 0; axis < 3; ++axis) this.sums[4 * cell + axis] += ends[3 * i + axis];
      }
    }
    this.fillSection(found);
  }

  fillSection(found) {
    const out = this.section;
    for (let at = 0; at < found.length;) {
      const f = found[at], count = found[at + 1];
      at += 2;
      for (let pair = 0; pair < count; pair += 2, at += 6) {
        out.lines.room(6);
        for (let i = 0; i < 6; ++i) out.lines.data[out.lines.length++] = found[at + i];
        for (const cell of [this.first[f], this.second[f]]) {
          if (cell < 0 || !this.shown[cell]) continue;
          out.points.room(9);
          out.cells.room(3);
          for (let axis = 0; axis < 3; ++axis)
            out.points.data[out.points.length++] = this.sums[4 * cell + axis] / this.sums[4 * cell + 3];
          for (let i = 0; i < 6; ++i) out.points.data[out.points.length++] = found[at + i];
          for (let i = 0; i < 3; ++i) out.cells.data[out.cells.length++] = cell;
        }
      }
    }
  }
}
