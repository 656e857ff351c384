// Small meshes that are there once, joined in one buffer with a slot per vertex: a thousand different parts cost a few calls.
import { buffer, PLACES } from './gl.js';
import { PartList } from './part_list.js';

const PARTS = 128; // of a buffer; a part that comes or goes makes only its own buffer anew

/** As a `Batch`, for parts with different meshes. */
export class MergedBatch extends PartList {
  /** @param {WebGL2RenderingContext} gl @param {import('./batches.js').Part} part the first one */
  constructor(gl, part) {
    super();
    Object.assign(this, { gl, look: part.look, symbol: part.symbol, hasUvs: !!part.mesh.uvs });
    this.buffers = [];
  }

  get full() {
    return this.parts.length >= PARTS;
  }

  prepare() {
    if (!this.stale) return;
    this.stale = false;
    this.free();
    const { gl } = this;
    const data = this._joined();
    const buffers = [buffer(gl, data.vertices), buffer(gl, data.slots), data.uvs && buffer(gl, data.uvs)];
    gl.bindVertexArray(null);
    const [indices, edges] = [data.indices, data.edges].map((list) => buffer(gl, list, gl.ELEMENT_ARRAY_BUFFER));
    this.buffers = [...buffers, indices, edges].filter(Boolean);
    [this.count, this.edgeCount] = [data.indices.length, data.edges.length];
    this.bindings = this._bindings(buffers, indices);
    this.edgeBindings = this.look.edgeColor && this.edgeCount ? this._bindings(buffers, edges) : null;
  }

  _joined() {
    const total = (count) => this.parts.reduce((sum, { mesh }) => sum + count(mesh.copy), 0);
    const corners = total((copy) => copy.vertices.length / 4);
    const made = {
      vertices: new Float32Array(4 * corners), slots: new Uint32Array(corners), uvs: this.hasUvs ? new Float32Array(2 * corners) : null,
      indices: new Uint32Array(total((copy) => copy.indices.length)), edges: new Uint32Array(total((copy) => copy.edges.length)),
    };
    let [first, index, edge] = [0, 0, 0];
    for (const { mesh, slot } of this.parts) {
      const { vertices, uvs, indices, edges } = mesh.copy;
      made.vertices.set(vertices, 4 * first);
      made.uvs?.set(uvs, 2 * first);
      made.slots.fill(slot, first, first + vertices.length / 4);
      for (const i of indices) made.indices[index++] = i + first;
      for (const i of edges) made.edges[edge++] = i + first;
      first += vertices.length / 4;
    }
    return made;
  }

  _bindings([vertices, slots, uvs], indices) {
    const { gl } = this;
    const made = gl.createVertexArray();
    gl.bindVertexArray(made);
    gl.bindBuffer(gl.ARRAY_BUFFER, vertices);
    gl.enableVertexAttribArray(PLACES.position);
    gl.vertexAttribPointer(PLACES.position, 3, gl.FLOAT, false, 16, 0);
    gl.enableVertexAttribArray(PLACES.normal);
    gl.vertexAttribPointer(PLACES.normal, 3, gl.BYTE, true, 16, 12);
    gl.bindBuffer(gl.ARRAY_BUFFER, slots);
    gl.enableVertexAttribArray(PLACES.slot);
    gl.vertexAttribIPointer(PLACES.slot, 1, gl.UNSIGNED_INT, 0, 0);
    if (uvs) {
      gl.bindBuffer(gl.ARRAY_BUFFER, uvs);
      gl.enableVertexAttribArray(PLACES.uv);
      gl.vertexAttribPointer(PLACES.uv, 2, gl.FLOAT, false, 0, 0);
    }
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, indices);
    gl.bindVertexArray(null);
    return made;
  }

  draw() {
    this.gl.bindVertexArray(this.bindings);
    this.gl.drawElements(this.gl.TRIANGLES, this.count, this.gl.UNSIGNED_INT, 0);
  }

  drawEdges() {
    this.gl.bindVertexArray(this.edgeBindings);
    this.gl.drawElements(this.gl.LINES, this.edgeCount, this.gl.UNSIGNED_INT, 0);
  }

  free() {
    this.buffers.forEach((each) => this.gl.deleteBuffer(each));
    for (const each of [this.bindings, this.edgeBindings]) if (each) this.gl.deleteVertexArray(each);
  }
}
