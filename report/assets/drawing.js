// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later
// WebGL2: cells coloured by a texture of one value a cell, edges, well paths, and the number of the cell under a pixel.
"use strict";

const cellVertexShader = `#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
in vec3 position;
in uint cell;
uniform mat4 matrix;
uniform vec3 stretch;
uniform sampler2D values;
out vec3 place;
out vec3 stretched;
flat out uint number;
flat out float value;
void main() {
  place = position;
  stretched = position * stretch;
  number = cell;
  int width = textureSize(values, 0).x;
  value = texelFetch(values, ivec2(int(cell) % width, int(cell) / width), 0).r;
  gl_Position = matrix * vec4(stretched, 1.0);
}`;

// way 0: colours, 1: cell numbers.
const cellFragmentShader = `#version 300 es
precision highp float;
precision highp int;
in vec3 place;
in vec3 stretched;
flat in uint number;
flat in float value;
uniform sampler2D ramp;
uniform vec2 range;
uniform vec4 plane;
uniform int way;
uniform uint chosen;
uniform vec3 toEye;
out vec4 colour;
void main() {
  if (dot(plane.xyz, place) + plane.w > 0.0) discard;
  if (way == 1) {
    uint n = number + 1u;
    colour = vec4(float(n & 255u), float((n >> 8) & 255u), float((n >> 16) & 255u), float(n >> 24)) / 255.0;
    return;
  }
  vec3 normal = normalize(cross(dFdx(stretched), dFdy(stretched)));
  float light = 0.55 + 0.45 * abs(dot(normal, toEye));
  float t = range.y > range.x ? clamp((value - range.x) / (range.y - range.x), 0.0, 1.0) : 0.5;
  vec3 base = value == value ? texture(ramp, vec2(t, 0.5)).rgb : vec3(0.5);
  if (number == chosen) base = vec3(1.0, 0.1, 0.65);
  colour = vec4(base * light, 1.0);
}`;

const lineVertexShader = `#version 300 es
precision highp float;
in vec3 position;
uniform mat4 matrix;
uniform vec3 stretch;
uniform float nearer;
out vec3 place;
void main() {
  place = position;
  gl_Position = matrix * vec4(position * stretch, 1.0);
  gl_Position.z -= nearer;
}`;

const lineFragmentShader = `#version 300 es
precision highp float;
in vec3 place;
uniform vec4 plane;
uniform vec4 ink;
out vec4 colour;
void main() {
  if (dot(plane.xyz, place) + plane.w > 0.0) discard;
  colour = ink;
}`;

// A path as a ribbon that faces the eye: each corner knows the other end of its piece.
const pathVertexShader = `#version 300 es
precision highp float;
in vec3 position;
in vec3 other;
in float side;
uniform mat4 matrix;
uniform vec3 stretch;
uniform vec2 pixel;
uniform float wide;
void main() {
  vec4 here = matrix * vec4(position * stretch, 1.0);
  vec4 there = matrix * vec4(other * stretch, 1.0);
  vec2 along = (there.xy / there.w - here.xy / here.w) / pixel;
  vec2 across = length(along) > 0.0 ? normalize(vec2(-along.y, along.x)) : vec2(1.0, 0.0);
  here.xy += across * side * wide * pixel * here.w;
  gl_Position = here;
}`;

const pathFragmentShader = `#version 300 es
precision highp float;
uniform vec4 ink;
out vec4 colour;
void main() { colour = ink; }`;

function shaderProgram(gl, vertexText, fragmentText, attributes) {
  const program = gl.createProgram();
  for (const [type, text] of [[gl.VERTEX_SHADER, vertexText], [gl.FRAGMENT_SHADER, fragmentText]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(program, shader);
  }
  attributes.forEach((name, i) => gl.bindAttribLocation(program, i, name));
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  const uniforms = {};
  for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); ++i) {
    const name = gl.getActiveUniform(program, i).name;
    uniforms[name] = gl.getUniformLocation(program, name);
  }
  return {program, uniforms};
}

// Buffers of Pieces (surface.js) on the device.
class DevicePieces {
  constructor(gl) {
    this.gl = gl;
    this.buffers = {points: gl.createBuffer(), cells: gl.createBuffer(), lines: gl.createBuffer()};
    this.faces = gl.createVertexArray();
    gl.bindVertexArray(this.faces);
    this.attribute(this.buffers.points, 0, 3);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers.cells);
    gl.enableVertexAttribArray(1);
    gl.vertexAttribIPointer(1, 1, gl.UNSIGNED_INT, 0, 0);
    this.edges = gl.createVertexArray();
    gl.bindVertexArray(this.edges);
    this.attribute(this.buffers.lines, 0, 3);
    this.corners = this.ends = 0;
  }
  attribute(buffer, place, size) {
    const gl = this.gl;
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, size, gl.FLOAT, false, 0, 0);
  }
  load(pieces) {
    const gl = this.gl;
    for (const name of ["points", "cells", "lines"]) {
      gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[name]);
      gl.bufferData(gl.ARRAY_BUFFER, pieces[name].view(), gl.DYNAMIC_DRAW);
    }
    this.corners = pieces.cells.length;
    this.ends = pieces.lines.length / 3;
  }
}

class Drawing {
  constructor(canvas) {
    const gl = canvas.getContext("webgl2", {alpha: false, antialias: false, preserveDrawingBuffer: true});
    if (!gl) throw new Error("this browser has no WebGL2");
    this.gl = gl;
    this.canvas = canvas;
    this.cells = shaderProgram(gl, cellVertexShader, cellFragmentShader, ["position", "cell"]);
    this.lines = shaderProgram(gl, lineVertexShader, lineFragmentShader, ["position"]);
    this.paths = shaderProgram(gl, pathVertexShader, pathFragmentShader, ["position", "other", "side"]);
    this.outside = new DevicePieces(gl);
    this.section = new DevicePieces(gl);
    this.valueTexture = gl.createTexture();
    this.rampTexture = gl.createTexture();
    this.pathCorners = 0;
    this.pick = null;
  }

  texture(texture, unit) {
    const gl = this.gl;
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, texture);
    for (const [name, value] of [
             [gl.TEXTURE_MIN_FILTER, gl.NEAREST], [gl.TEXTURE_MAG_FILTER, gl.NEAREST],
             [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE], [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE]])
      gl.texParameteri(gl.TEXTURE_2D, name, value);
  }

  setValues(values) {
    const gl = this.gl, width = 1024, height = Math.max(1, Math.ceil(values.length / width));
    const padded = new Float32Array(width * height);
    padded.set(values);
    this.texture(this.valueTexture, 0);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.R32F, width, height, 0, gl.RED, gl.FLOAT, padded);
  }

  // `colours`: [r, g, b] from 0 to 255 each; a value range is spread over them.
  setRamp(colours) {
    const gl = this.gl;
    this.texture(this.rampTexture, 1);
    gl.texImage2D(
        gl.TEXTURE_2D, 0, gl.RGBA, colours.length, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE,
        new Uint8Array(colours.flatMap((c) => [...c, 255])));
  }

  // Paths: lists of points. Two triangles a piece.
  setPaths(paths) {
    const gl = this.gl, position = [], other = [], side = [];
    for (const path of paths)
      for (let i = 0; i + 1 < path.length; ++i)
        for (const [from, to, s] of [[0, 1, 1], [0, 1, -1], [1, 0, 1], [1, 0, 1], [0, 1, 1], [1, 0, -1]]) {
          position.push(...path[i + from]);
          other.push(...path[i + to]);
          side.push(s);
        }
    this.pathCorners = side.length;
    this.pathArray = gl.createVertexArray();
    gl.bindVertexArray(this.pathArray);
    [[position, 3], [other, 3], [side, 1]].forEach(([data, size], place) => {
      gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
      gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(data), gl.STATIC_DRAW);
      gl.enableVertexAttribArray(place);
      gl.vertexAttribPointer(place, size, gl.FLOAT, false, 0, 0);
    });
  }

  // scene: { matrix, nearer (of edges, in clip space), stretch, toEye, plane (or null), range, chosen (or null), edges, wells, paper: [r, g, b] }
  draw(scene) {
    const gl = this.gl;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.clearColor(...scene.paper, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    this.drawCells(scene, 0);
    if (scene.edges) this.drawEdges(scene);
    if (scene.wells) this.drawPaths(scene);
  }

  drawCells(scene, way) {
    const gl = this.gl, u = this.cells.uniforms;
    gl.useProgram(this.cells.program);
    gl.uniformMatrix4fv(u.matrix, false, new Float32Array(scene.matrix));
    gl.uniform3fv(u.stretch, scene.stretch);
    gl.uniform3fv(u.toEye, scene.toEye);
    gl.uniform2fv(u.range, scene.range);
    gl.uniform1i(u.way, way);
    gl.uniform1i(u.values, 0);
    gl.uniform1i(u.ramp, 1);
    gl.uniform1ui(u.chosen, scene.chosen === null ? 0xffffffff : scene.chosen);
    for (const [pieces, plane] of [[this.outside, scene.plane], [this.section, null]]) {
      if (pieces.corners === 0) continue;
      gl.uniform4fv(u.plane, plane || [0, 0, 0, -1]);
      gl.bindVertexArray(pieces.faces);
      gl.drawArrays(gl.TRIANGLES, 0, pieces.corners);
    }
  }

  drawEdges(scene) {
    const gl = this.gl, u = this.lines.uniforms;
    gl.useProgram(this.lines.program);
    gl.uniformMatrix4fv(u.matrix, false, new Float32Array(scene.matrix));
    gl.uniform1f(u.nearer, scene.nearer);
    gl.uniform3fv(u.stretch, scene.stretch);
    gl.uniform4fv(u.ink, [0, 0, 0, 0.45]);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    for (const [pieces, plane] of [[this.outside, scene.plane], [this.section, null]]) {
      gl.uniform4fv(u.plane, plane || [0, 0, 0, -1]);
      gl.bindVertexArray(pieces.edges);
      gl.drawArrays(gl.LINES, 0, pieces.ends);
    }
    gl.disable(gl.BLEND);
  }

  // Over everything: a path inside of cells would not be seen.
  drawPaths(scene) {
    if (this.pathCorners === 0) return;
    const gl = this.gl, u = this.paths.uniforms;
    gl.useProgram(this.paths.program);
    gl.uniformMatrix4fv(u.matrix, false, new Float32Array(scene.matrix));
    gl.uniform3fv(u.stretch, scene.stretch);
    gl.uniform2fv(u.pixel, [2 / this.canvas.width, 2 / this.canvas.height]);
    gl.disable(gl.DEPTH_TEST);
    gl.bindVertexArray(this.pathArray);
    const scale = this.canvas.width / Math.max(1, this.canvas.clientWidth);
    for (const [ink, wide] of [[[1, 1, 1, 1], 2.2 * scale], [[0.75, 0.05, 0.1, 1], 1.2 * scale]]) {
      gl.uniform4fv(u.ink, ink);
      gl.uniform1f(u.wide, wide);
      gl.drawArrays(gl.TRIANGLES, 0, this.pathCorners);
    }
    gl.enable(gl.DEPTH_TEST);
  }

  // The cell under a pixel of the canvas, counted from its lower left; null for none.
  cellAt(scene, x, y) {
    const gl = this.gl;
    this.preparePick();
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.pick.frame);
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(x, y, 1, 1);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    this.drawCells(scene, 1);
    gl.disable(gl.SCISSOR_TEST);
    const bytes = new Uint8Array(4);
    gl.readPixels(x, y, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    const number = bytes[0] + 256 * bytes[1] + 65536 * bytes[2] + 16777216 * bytes[3];
    return number > 0 ? number - 1 : null;
  }

  preparePick() {
    const gl = this.gl, {width, height} = this.canvas;
    if (this.pick && this.pick.width === width && this.pick.height === height) return;
    const frame = gl.createFramebuffer(), colour = gl.createRenderbuffer(), depth = gl.createRenderbuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    for (const [buffer, format, place] of [
             [colour, gl.RGBA8, gl.COLOR_ATTACHMENT0], [depth, gl.DEPTH_COMPONENT24, gl.DEPTH_ATTACHMENT]]) {
      gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
      gl.renderbufferStorage(gl.RENDERBUFFER, format, width, height);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, place, gl.RENDERBUFFER, buffer);
    }
    this.pick = {frame, width, height};
  }
}
