// Meshes and textures by hash, each fetched once, kept while something uses them.
import { Mesh, parseMesh } from './gpu/mesh.js';
import { PRIMITIVES } from './gpu/primitives.js';

const PARALLEL = 6; // fetches at a time

export class Resources {
  /** @param {WebGL2RenderingContext} gl @param {{blob: function(string): Promise<ArrayBuffer>}} source */
  constructor(gl, source) {
    Object.assign(this, { gl, source });
    this.kept = new Map(); // by kind and hash: a promise of a value, and its users
    this.primitives = new Map();
    this.waiting = [];
    this.running = 0;
    this.onready = () => {};
  }

  /** A mesh that the page makes itself. @param {string} name */
  primitive(name) {
    if (!this.primitives.has(name)) this.primitives.set(name, new Mesh(this.gl, PRIMITIVES[name]()));
    return this.primitives.get(name);
  }

  mesh(hash) {
    return this._use(`mesh ${hash}`, hash, (blob) => new Mesh(this.gl, parseMesh(blob)), (mesh) => mesh.free());
  }

  /** @param {{blob: string, interpolate: boolean, repeat?: boolean[]}} texture as in the protocol */
  texture({ blob: hash, interpolate, repeat = [true, true] }) {
    const free = (texture) => this.gl.deleteTexture(texture.texture);
    return this._use(`texture ${interpolate} ${repeat} ${hash}`, hash, (blob) => this._texture(blob, interpolate, repeat), free);
  }

  /** Calls back with points of an octree or a point cloud: count, positions, colours. */
  async points(hash) {
    const blob = await this._fetch(hash);
    const count = new Uint32Array(blob, 4, 1)[0];
    return { count, positions: new Float32Array(blob, 8, 3 * count), colors: new Uint8Array(blob, 8 + 12 * count, 4 * count) };
  }

  /** @returns {{key: string, value: Promise<any>}} to be released by its key */
  _use(key, hash, make, free) {
    let entry = this.kept.get(key);
    if (!entry) {
      entry = { users: 0, free, value: this._fetch(hash).then(make) };
      entry.value.catch(() => {}); // whoever waits for it sees the error
      this.kept.set(key, entry);
    }
    entry.users++;
    return { key, value: entry.value };
  }

  release(key) {
    const entry = this.kept.get(key);
    if (!entry || --entry.users > 0) return;
    this.kept.delete(key);
    entry.value.then(entry.free, () => {});
  }

  _fetch(hash) {
    return new Promise((resolve, reject) => {
      this.waiting.push({ hash, resolve, reject });
      this._next();
    });
  }

  _next() {
    if (this.running >= PARALLEL || !this.waiting.length) return;
    const { hash, resolve, reject } = this.waiting.shift();
    this.running++;
    this.source.blob(hash).then(resolve, reject).finally(() => {
      this.running--;
      this._next();
      this.onready();
    });
  }

  get busy() {
    return this.running > 0 || this.waiting.length > 0;
  }

  _texture(blob, interpolate, repeat) {
    const { gl } = this;
    const [width, height] = new Uint32Array(blob, 4, 2);
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, width, height, 0, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(blob, 12, 4 * width * height));
    gl.generateMipmap(gl.TEXTURE_2D);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, interpolate ? gl.LINEAR_MIPMAP_LINEAR : gl.NEAREST_MIPMAP_LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, interpolate ? gl.LINEAR : gl.NEAREST);
    const wrap = (on) => (on ? gl.REPEAT : gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, wrap(repeat[0]));
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, wrap(repeat[1]));
    return { texture, number: (this.textures = (this.textures ?? 0) + 1) };
  }
}
