// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The mesh's arrays: base64 of deflated, shuffled words in script elements (report/viewer_data.cpp). Unpacked when
// asked for.
"use strict";

const unpackedArrays = new Map();

function bytesOfBase64(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const raw = atob(text);
  const bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
  return bytes;
}

async function inflated(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// First bytes of all words, then second bytes …: back to words.
function unshuffled(bytes, count) {
  const words = new Uint32Array(count);
  for (let i = 0; i < count; ++i)
    words[i] = bytes[i] | (bytes[count + i] << 8) | (bytes[2 * count + i] << 16) | (bytes[3 * count + i] << 24);
  return words;
}

// Differences to the one before, the sign in the lowest bit: back to integers.
function summed(words) {
  const values = new Int32Array(words.length);
  let last = 0;
  for (let i = 0; i < words.length; ++i) {
    last = (last + ((words[i] >>> 1) ^ -(words[i] & 1))) | 0;
    values[i] = last;
  }
  return values;
}

async function unpack(element) {
  const count = Number(element.dataset.count);
  const words = unshuffled(await inflated(bytesOfBase64(element.textContent)), count);
  return element.dataset.type === "integer" ? summed(words) : new Float32Array(words.buffer);
}

// A promise of the array of this name.
function meshArray(name) {
  if (!unpackedArrays.has(name)) {
    const element = document.querySelector(`script[data-array="${CSS.escape(name)}"]`);
    unpackedArrays.set(name, element ? unpack(element) : Promise.reject(new Error(`no array ${name}`)));
  }
  return unpackedArrays.get(name);
}
