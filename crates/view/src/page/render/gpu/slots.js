// The table of everything that is drawn: a row per part, with its place in the world, colours and number. Shaders look it up in a
// texture, so that a part that moves costs 48 bytes, and a thousand equal parts one call.
import { rotationRows } from '../../maths.js';

const TEXELS = 6; // of a row: 3 of the matrix, colour with opacity, emission with shine, number
const ROWS_PER_LINE = 128;
const WIDTH = TEXELS * ROWS_PER_LINE;
const STRIDE = 4 * TEXELS;

export class Slots {
  /** @param {WebGL2RenderingContext} gl */
  constructor(gl) {
    this.gl = gl;
    this.free = [];
    this.count = 0;
    this._grow(8);
    this.world = this.take(0); // the slot of things in the frame of the world
  }

  _grow(lines) {
    const data = new Float32Array(WIDTH * 4 * lines);
    if (this.data) data.set(this.data);
    this.data = data;
    this.lines = lines;
    const { gl } = this;
    if (this.texture) gl.deleteTexture(this.texture);
    this.texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA32F, WIDTH, lines);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    [this.firstDirty, this.lastDirty] = [0, lines - 1];
  }

  /** A new row, of the object with this number. */
  take(number) {
    const slot = this.free.pop() ?? this.count++;
    if (slot >= this.lines * ROWS_PER_LINE) this._grow(this.lines * 2);
    this.data.fill(0, slot * STRIDE, (slot + 1) * STRIDE);
    this.data[slot * STRIDE + 20] = number;
    this.place(slot, [0, 0, 0, 0, 0, 0, 1]);
    this.paint(slot, [1, 1, 1], 1);
    return slot;
  }

  give(slot) {
    this.free.push(slot);
  }

  /** @param {ArrayLike<number>} pose @param {number[]} [scale] along the part's own axes */
  place(slot, pose, scale = [1, 1, 1]) {
    const r = rotationRows(pose);
    const at = slot * STRIDE;
    for (let row = 0; row < 3; row++) {
      for (let column = 0; column < 3; column++) this.data[at + 4 * row + column] = r[3 * row + column] * scale[column];
      this.data[at + 4 * row + 3] = pose[row];
    }
    this._touch(slot);
  }

  /** @param {number[]} color @param {number} opacity @param {number[]} [emission] @param {number} [shine] strength of highlights */
  paint(slot, color, opacity, emission = [0, 0, 0], shine = 0) {
    this.data.set([...color, opacity, ...emission, shine], slot * STRIDE + 12);
    this._touch(slot);
  }

  /** Position in the world. */
  position(slot) {
    const at = slot * STRIDE;
    return [this.data[at + 3], this.data[at + 7], this.data[at + 11]];
  }

  _touch(slot) {
    const line = Math.floor(slot / ROWS_PER_LINE);
    this.firstDirty = Math.min(this.firstDirty, line);
    this.lastDirty = Math.max(this.lastDirty, line);
  }

  /** Binds the texture to a unit, after sending what changed. */
  bind(unit) {
    const { gl } = this;
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    if (this.firstDirty > this.lastDirty) return;
    const lines = this.lastDirty - this.firstDirty + 1;
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 4);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, this.firstDirty, WIDTH, lines, gl.RGBA, gl.FLOAT, this.data, this.firstDirty * WIDTH * 4);
    [this.firstDirty, this.lastDirty] = [Infinity, -Infinity];
  }
}
