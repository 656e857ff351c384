// Many lines, points or equal meshes in one buffer: symbols, drawing objects, octrees, point clouds, frames.
import { PLACES } from './gl.js';

/** A part of a colour as a byte. */
const byte = (x) => Math.round(Math.min(Math.max(x, 0), 1) * 255);

/** Sets one attribute of a buffer that advances by `divisor`. */
function attribute(gl, place, size, type, stride, offset, divisor) {
  gl.enableVertexAttribArray(place);
  if (type === gl.UNSIGNED_INT) gl.vertexAttribIPointer(place, size, type, stride, offset);
  else gl.vertexAttribPointer(place, size, type, type === gl.UNSIGNED_BYTE, stride, offset);
  gl.vertexAttribDivisor(place, divisor);
}

/** A buffer that grows, written as floats and bytes. */
class Records {
  constructor(gl, words) {
    Object.assign(this, { gl, words, count: 0 });
    this.buffer = gl.createBuffer();
  }

  begin(count) {
    this.floats = new Float32Array(this.words * count);
    this.bytes = new Uint8Array(this.floats.buffer);
    this.integers = new Uint32Array(this.floats.buffer);
    this.count = count;
  }

  end() {
    this.gl.bindBuffer(this.gl.ARRAY_BUFFER, this.buffer);
    this.gl.bufferData(this.gl.ARRAY_BUFFER, this.floats, this.gl.DYNAMIC_DRAW);
    this.floats = this.bytes = this.integers = null;
  }
}

/** Lines of some pixels' width. */
export class LineSet {
  constructor(gl, width = 1) {
    Object.assign(this, { gl, width });
    this.records = new Records(gl, 8);
    this.bindings = gl.createVertexArray();
    gl.bindVertexArray(this.bindings);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.records.buffer);
    attribute(gl, PLACES.from, 3, gl.FLOAT, 32, 0, 1);
    attribute(gl, PLACES.to, 3, gl.FLOAT, 32, 12, 1);
    attribute(gl, PLACES.tint, 4, gl.UNSIGNED_BYTE, 32, 24, 1);
    attribute(gl, PLACES.slot, 1, gl.UNSIGNED_INT, 32, 28, 1);
    gl.bindVertexArray(null);
  }

  /** @param {{points: ArrayLike<number>, color: number[], slot: number}[]} groups points of lines, six numbers each */
  set(groups) {
    const { records } = this;
    records.begin(groups.reduce((sum, group) => sum + Math.floor(group.points.length / 6), 0));
    let at = 0;
    for (const { points, color, slot } of groups) {
      for (let i = 0; i + 5 < points.length; i += 6, at++) {
        for (let k = 0; k < 6; k++) records.floats[8 * at + k] = points[i + k];
        for (let k = 0; k < 4; k++) records.bytes[32 * at + 24 + k] = byte(color[k] ?? 1);
        records.integers[8 * at + 7] = slot;
      }
    }
    records.end();
  }

  draw() {
    if (!this.records.count) return;
    this.gl.bindVertexArray(this.bindings);
    this.gl.drawArraysInstanced(this.gl.TRIANGLE_STRIP, 0, 4, this.records.count);
  }

  free() {
    this.gl.deleteBuffer(this.records.buffer);
    this.gl.deleteVertexArray(this.bindings);
  }
}

/** Round points of some pixels' width, all with one slot. */
export class PointSet {
  constructor(gl, slot, size) {
    Object.assign(this, { gl, slot, size });
    this.records = new Records(gl, 4);
    this.bindings = gl.createVertexArray();
    gl.bindVertexArray(this.bindings);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.records.buffer);
    attribute(gl, PLACES.position, 3, gl.FLOAT, 16, 0, 0);
    attribute(gl, PLACES.tint, 4, gl.UNSIGNED_BYTE, 16, 12, 0);
    gl.bindVertexArray(null);
  }

  /** @param {number} count @param {function(number): ArrayLike<number>} position @param {function(number): ArrayLike<number>} color */
  set(count, position, color) {
    this.records.begin(count);
    for (let i = 0; i < count; i++) {
      this.records.floats.set(position(i), 4 * i);
      const rgb = color(i);
      for (let k = 0; k < 4; k++) this.records.bytes[16 * i + 12 + k] = byte(rgb[k] ?? 1);
    }
    this.records.end();
  }

  draw() {
    if (!this.records.count) return;
    this.gl.bindVertexArray(this.bindings);
    this.gl.vertexAttribI4ui(PLACES.slot, this.slot, 0, 0, 0);
    this.gl.drawArrays(this.gl.POINTS, 0, this.records.count);
  }

  free() {
    this.gl.deleteBuffer(this.records.buffer);
    this.gl.deleteVertexArray(this.bindings);
  }
}

/** Copies of a mesh, each with position, size, turn and colour, all with one slot. */
export class CopySet {
  constructor(gl, slot, mesh) {
    Object.assign(this, { gl, slot, mesh });
    this.records = new Records(gl, 9);
    this.bindings = mesh.bindings();
    gl.bindVertexArray(this.bindings);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.records.buffer);
    attribute(gl, PLACES.offset, 4, gl.FLOAT, 36, 0, 1);
    attribute(gl, PLACES.turn, 4, gl.FLOAT, 36, 16, 1);
    attribute(gl, PLACES.tint, 4, gl.UNSIGNED_BYTE, 36, 32, 1);
    gl.bindVertexArray(null);
  }

  /** @param {number} count @param {function(number): {position: ArrayLike<number>, size: number, turn?: ArrayLike<number>, color: ArrayLike<number>}} item */
  set(count, item) {
    this.records.begin(count);
    for (let i = 0; i < count; i++) {
      const { position, size, turn, color } = item(i);
      this.records.floats.set([position[0], position[1], position[2], size, ...(turn ?? [0, 0, 0, 1])], 9 * i);
      for (let k = 0; k < 4; k++) this.records.bytes[36 * i + 32 + k] = byte(color[k] ?? 1);
    }
    this.records.end();
  }

  draw() {
    if (!this.records.count) return;
    this.gl.bindVertexArray(this.bindings);
    this.gl.vertexAttribI4ui(PLACES.slot, this.slot, 0, 0, 0);
    this.gl.drawElementsInstanced(this.gl.TRIANGLES, this.mesh.count, this.gl.UNSIGNED_INT, 0, this.records.count);
  }

  free() {
    this.gl.deleteBuffer(this.records.buffer);
    this.gl.deleteVertexArray(this.bindings);
  }
}
