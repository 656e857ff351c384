// Parts that are drawn by one call: the same mesh, texture and way of drawing, each with its slot.
import { PLACES } from './gl.js';
import { MergedBatch } from './merged.js';
import { PartList } from './part_list.js';

/**
 * @typedef {Object} Part
 * @property {import('./mesh.js').Mesh} mesh
 * @property {number} slot
 * @property {number} handle of the object
 * @property {boolean} transparent
 * @property {boolean} symbol of a joint and the like: casts no shadow
 * @property {{texture: any, decal: boolean, culling: boolean, wireframe: boolean, edgeColor: number[]|null, order: number}} look
 */

class Batch extends PartList {
  constructor(gl, part) {
    super();
    Object.assign(this, { gl, mesh: part.mesh, look: part.look, symbol: part.symbol });
    this.buffer = gl.createBuffer();
    this.bindings = part.mesh.bindings(this.buffer, part.look.wireframe ? part.mesh.wires() : part.mesh.indices);
    this.edgeBindings = part.look.edgeColor && part.mesh.edges && part.mesh.bindings(this.buffer, part.mesh.edges);
  }

  prepare() {
    if (!this.stale) return;
    this.stale = false;
    this.gl.bindBuffer(this.gl.ARRAY_BUFFER, this.buffer);
    this.gl.bufferData(this.gl.ARRAY_BUFFER, new Uint32Array(this.parts.map((part) => part.slot)), this.gl.DYNAMIC_DRAW);
  }

  draw() {
    const { gl, mesh, look } = this;
    gl.bindVertexArray(this.bindings);
    if (look.wireframe) gl.drawElementsInstanced(gl.LINES, 2 * mesh.count, gl.UNSIGNED_INT, 0, this.parts.length);
    else gl.drawElementsInstanced(gl.TRIANGLES, mesh.count, gl.UNSIGNED_INT, 0, this.parts.length);
  }

  drawEdges() {
    this.gl.bindVertexArray(this.edgeBindings);
    this.gl.drawElementsInstanced(this.gl.LINES, this.mesh.edgeCount, this.gl.UNSIGNED_INT, 0, this.parts.length);
  }

  free() {
    this.gl.deleteBuffer(this.buffer);
    this.gl.deleteVertexArray(this.bindings);
    if (this.edgeBindings) this.gl.deleteVertexArray(this.edgeBindings);
  }
}

export class Batches {
  /** @param {WebGL2RenderingContext} gl @param {import('./slots.js').Slots} slots */
  constructor(gl, slots) {
    Object.assign(this, { gl, slots });
    /** @type {Map<string, Batch>} */
    this.batches = new Map();
    /** @type {Set<Part>} */
    this.transparent = new Set();
  }

  /** @param {Part} part */
  add(part) {
    if (part.transparent) return void this.transparent.add(part);
    const { texture, decal, culling, wireframe, edgeColor, order } = part.look;
    const look = [texture?.number, decal, culling, wireframe, edgeColor, order, part.symbol].join();
    part.merged = !!part.mesh.copy && !part.mesh.merged && !wireframe;
    if (part.merged) part.mesh.merged = true; // its further copies are instances
    part.key = part.merged ? this._mergedKey(part, look) : `${look},${part.mesh.number}`;
    if (!this.batches.has(part.key)) this.batches.set(part.key, part.merged ? new MergedBatch(this.gl, part) : new Batch(this.gl, part));
    part.batch = this.batches.get(part.key);
    part.batch.add(part);
  }

  /** The first joined buffer of this look that has room. */
  _mergedKey(part, look) {
    for (let i = 0; ; i++) {
      const key = `${look},${part.mesh.uvs ? 'uvs' : ''},joined ${i}`;
      if (!this.batches.get(key)?.full) return key;
    }
  }

  remove(part) {
    if (part.transparent) return void this.transparent.delete(part);
    part.batch.remove(part);
    if (part.merged) part.mesh.merged = false;
    if (part.batch.parts.length) return;
    part.batch.free();
    this.batches.delete(part.key);
  }

  /** Draws what is opaque; `before` sets the state for a batch and may refuse it. */
  drawOpaque(before) {
    for (const batch of this.batches.values()) {
      batch.prepare();
      if (before(batch) !== false) batch.draw();
    }
  }

  /** @param {function(number[]): void} setInk */
  drawEdges(setInk) {
    for (const batch of this.batches.values()) {
      if (!batch.edgeBindings) continue; // known after `prepare`
      setInk(batch.look.edgeColor);
      batch.drawEdges();
    }
  }

  /** Draws what is transparent, the farthest first. */
  drawTransparent(eye, before) {
    const distance = (part) => {
      const [x, y, z] = this.slots.position(part.slot);
      return (x - eye[0]) ** 2 + (y - eye[1]) ** 2 + (z - eye[2]) ** 2;
    };
    const sorted = Array.from(this.transparent, (part) => ({ part, far: distance(part) })).sort((a, b) => b.far - a.far);
    for (const { part } of sorted) if (before(part) !== false) this.drawPart(part);
  }

  /** Draws one part by itself. */
  drawPart({ mesh, slot }) {
    const { gl } = this;
    gl.bindVertexArray(mesh.single);
    gl.vertexAttribI4ui(PLACES.slot, slot, 0, 0, 0);
    gl.drawElements(gl.TRIANGLES, mesh.count, gl.UNSIGNED_INT, 0);
  }
}
