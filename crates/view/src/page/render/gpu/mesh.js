// Meshes on the graphics processor. The simulator sends a normal per corner; here equal corners of a vertex become one.
import { buffer, PLACES } from './gl.js';

/** A blob `MESH` of the protocol. @param {ArrayBuffer} blob @returns {import('./primitives.js').MeshData} */
export function parseMesh(blob) {
  const [vertices, triangles, edges, flags] = new Uint32Array(blob, 4, 4);
  let at = 20;
  const take = (Type, count) => {
    const array = new Type(blob, at, count);
    at += 4 * count;
    return array;
  };
  return {
    positions: take(Float32Array, 3 * vertices),
    indices: take(Uint32Array, 3 * triangles),
    normals: take(Float32Array, 9 * triangles),
    uvs: flags & 1 ? take(Float32Array, 6 * triangles) : null,
    edges: take(Uint32Array, 2 * edges),
  };
}

/** Corners with the same vertex, normal and texture coordinates, once each. */
class Weld {
  constructor({ positions, indices, normals, uvs }) {
    Object.assign(this, { positions, normals, uvs });
    const corners = indices.length;
    this.first = new Int32Array(positions.length / 3).fill(-1); // of a vertex, then `next` of that
    this.next = new Int32Array(corners);
    this.corner = new Uint32Array(corners);
    this.packed = new Int32Array(corners);
    this.count = 0;
    this.indices = new Uint32Array(corners);
    for (let i = 0; i < corners; i++) this.indices[i] = this._find(indices[i], i);
  }

  _find(vertex, corner) {
    const packed = this._packedNormal(corner);
    for (let i = this.first[vertex]; i >= 0; i = this.next[i]) {
      if (this.packed[i] === packed && this._sameUv(this.corner[i], corner)) return i;
    }
    const made = this.count++;
    this.next[made] = this.first[vertex];
    this.first[vertex] = made;
    this.corner[made] = corner;
    this.packed[made] = packed;
    return made;
  }

  _packedNormal(corner) {
    const [x, y, z] = [this.normals[3 * corner], this.normals[3 * corner + 1], this.normals[3 * corner + 2]];
    const size = 127 / (Math.hypot(x, y, z) || 1);
    return (Math.round(x * size) & 255) | ((Math.round(y * size) & 255) << 8) | ((Math.round(z * size) & 255) << 16);
  }

  _sameUv(a, b) {
    return !this.uvs || (this.uvs[2 * a] === this.uvs[2 * b] && this.uvs[2 * a + 1] === this.uvs[2 * b + 1]);
  }

  /** 16 bytes for each: position and normal. */
  interleaved(indices) {
    const words = new Float32Array(4 * this.count);
    const bits = new Int32Array(words.buffer);
    for (let i = 0; i < this.count; i++) {
      const vertex = 3 * indices[this.corner[i]];
      for (let k = 0; k < 3; k++) words[4 * i + k] = this.positions[vertex + k];
      bits[4 * i + 3] = this.packed[i];
    }
    return words;
  }

  weldedUvs() {
    const uvs = new Float32Array(2 * this.count);
    for (let i = 0; i < this.count; i++) uvs.set([this.uvs[2 * this.corner[i]], this.uvs[2 * this.corner[i] + 1]], 2 * i);
    return uvs;
  }

  edges(edges) {
    const kept = [];
    for (let i = 0; i + 1 < edges.length; i += 2) {
      const [a, b] = [this.first[edges[i]], this.first[edges[i + 1]]];
      if (a >= 0 && b >= 0) kept.push(a, b);
    }
    return new Uint32Array(kept);
  }
}

const SMALL = 2000; // triangles of a mesh that is joined with others when it is there once

let meshes = 0;

export class Mesh {
  /** @param {WebGL2RenderingContext} gl @param {import('./primitives.js').MeshData} data */
  constructor(gl, data) {
    this.gl = gl;
    this.number = meshes++;
    const weld = new Weld(data);
    this.count = weld.indices.length;
    this.triangles = this.count / 3;
    const [vertices, uvs, edges] = [weld.interleaved(data.indices), data.uvs && weld.weldedUvs(), weld.edges(data.edges)];
    this.copy = this.triangles <= SMALL ? { vertices, uvs, indices: weld.indices, edges } : null;
    this.vertices = buffer(gl, vertices);
    this.uvs = uvs && buffer(gl, uvs);
    gl.bindVertexArray(null);
    this.indices = buffer(gl, weld.indices, gl.ELEMENT_ARRAY_BUFFER);
    this.edgeCount = edges.length;
    this.edges = edges.length ? buffer(gl, edges, gl.ELEMENT_ARRAY_BUFFER) : null;
    this.welded = weld.indices;
    this.single = this.bindings();
  }

  /** Bindings to draw the mesh; `instances` has a slot for each copy, and without it the slot is a constant. */
  bindings(instances = null, indices = this.indices) {
    const { gl } = this;
    const made = gl.createVertexArray();
    gl.bindVertexArray(made);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.vertices);
    gl.enableVertexAttribArray(PLACES.position);
    gl.vertexAttribPointer(PLACES.position, 3, gl.FLOAT, false, 16, 0);
    gl.enableVertexAttribArray(PLACES.normal);
    gl.vertexAttribPointer(PLACES.normal, 3, gl.BYTE, true, 16, 12);
    if (this.uvs) {
      gl.bindBuffer(gl.ARRAY_BUFFER, this.uvs);
      gl.enableVertexAttribArray(PLACES.uv);
      gl.vertexAttribPointer(PLACES.uv, 2, gl.FLOAT, false, 0, 0);
    }
    if (instances) bindSlots(gl, instances);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, indices);
    gl.bindVertexArray(null);
    return made;
  }

  /** The edges of all triangles, for wire frames. */
  wires() {
    if (!this.wireIndices) {
      const lines = new Uint32Array(2 * this.count);
      for (let i = 0; i < this.count; i++) lines.set([this.welded[i], this.welded[i % 3 === 2 ? i - 2 : i + 1]], 2 * i);
      this.gl.bindVertexArray(null);
      this.wireIndices = buffer(this.gl, lines, this.gl.ELEMENT_ARRAY_BUFFER);
    }
    return this.wireIndices;
  }

  free() {
    const { gl } = this;
    for (const each of [this.vertices, this.uvs, this.indices, this.edges, this.wireIndices]) if (each) gl.deleteBuffer(each);
    gl.deleteVertexArray(this.single);
  }
}

function bindSlots(gl, instances) {
  gl.bindBuffer(gl.ARRAY_BUFFER, instances);
  gl.enableVertexAttribArray(PLACES.slot);
  gl.vertexAttribIPointer(PLACES.slot, 1, gl.UNSIGNED_INT, 0, 0);
  gl.vertexAttribDivisor(PLACES.slot, 1);
}
