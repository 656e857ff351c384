// Objects of the scene as parts to draw: keeps both together while the scene changes.
import { Box, poseProduct } from '../maths.js';
import { axes, symbolOf } from './symbols.js';
import { CopySet, LineSet, PointSet } from './gpu/sets.js';

const IDENTITY = [0, 0, 0, 0, 0, 0, 1];

const GHOST = 0.3; // opacity of hidden objects, when they are shown

/** Members that say where something is or what it does, not how it looks. */
const NOT_LOOKS = new Set(['alias', 'parent', 'childOrder', 'jointPosition', 'interval', 'intrinsicPose', 'error']);

const looksOf = (object, chosen) => JSON.stringify([chosen, object], (name, value) => (NOT_LOOKS.has(name) ? undefined : value));

/** What is kept for an object that is drawn. */
class Entry {
  constructor(number, handle, looks) {
    Object.assign(this, { number, handle, looks, parts: [], lines: [], sets: [], keys: [], current: true });
  }
}

export class SceneView {
  constructor(gl, store, slots, batches, resources) {
    Object.assign(this, { gl, store, slots, batches, resources });
    /** @type {Map<number, Entry>} */
    this.entries = new Map();
    this.numbers = [-1]; // handles by the number that picking reads
    this.lines = new LineSet(gl);
    this.thickLines = new LineSet(gl, 2);
    this.options = { frames: false, hidden: false };
    this.version = 0; // of what casts shadows
    this.chosen = new Set();
    this.dirtyLines = true;
  }

  /** @param {Set<number>} changed handles */
  objectsChanged(changed) {
    for (const handle of changed) {
      const object = this.store.objects.get(handle);
      const drawn = object && (object.visible || this.options.hidden);
      const looks = drawn ? looksOf(object, this.chosen.has(handle)) : '';
      if (looks === (this.entries.get(handle)?.looks ?? '')) continue;
      this._discard(handle);
      if (drawn) this._create(object, looks);
      this.dirtyLines = true;
      this.version++;
    }
  }

  /** After an option or the selection changed. */
  rebuild(handles = this.store.objects.keys()) {
    this.objectsChanged(new Set(handles));
  }

  /** Makes what is drawn of objects anew. @param {number[]} handles */
  refresh(handles) {
    handles.forEach((handle) => this._discard(handle));
    this.rebuild(handles);
  }

  selectionChanged() {
    const chosen = new Set(this.store.selection);
    const differ = [...chosen, ...this.chosen].filter((handle) => chosen.has(handle) !== this.chosen.has(handle));
    this.chosen = chosen;
    const withSymbols = differ.filter((handle) => ['camera', 'visionSensor'].includes(this.store.objects.get(handle)?.objectType));
    if (withSymbols.length) this.rebuild(withSymbols);
    this.dirtyLines = true;
  }

  posesChanged(moved) {
    for (const handle of moved) {
      const entry = this.entries.get(handle);
      if (entry) this._place(entry);
    }
    this.version++;
  }

  _create(object, looks) {
    const entry = new Entry(this.numbers.push(object.handle) - 1, object.handle, looks);
    this.entries.set(object.handle, entry);
    entry.slot = this.slots.take(entry.number); // of the object's own frame, for lines and sets
    if (object.objectType === 'shape') object.meshes?.forEach((mesh, order) => this._addMesh(entry, mesh, { order, ghost: object.visible === false }));
    else if (object.blob) this._addPoints(entry, object);
    else this._addSymbol(entry, object);
    this._place(entry);
  }

  async _addMesh(entry, { blob, color, transparency, texture, culling, wireframe, showEdges, edgeColor }, { order, ghost }) {
    const mesh = this.resources.mesh(blob);
    const picture = texture && this.resources.texture(texture);
    entry.keys.push(mesh.key, ...(picture ? [picture.key] : []));
    try {
      const look = { order, culling, wireframe, decal: !!texture?.decal, edgeColor: showEdges ? edgeColor ?? [0, 0, 0] : null, texture: picture ? await picture.value : null };
      const loaded = await mesh.value;
      if (!entry.current) return;
      const part = { mesh: loaded, look, opacity: (1 - (transparency ?? 0)) * (ghost ? GHOST : 1), symbol: ghost };
      this._addPart(entry, part, { color: color?.diffuse ?? [0.7, 0.7, 0.7], emission: color?.emission, shine: Math.max(...(color?.specular ?? [0])) });
      this._place(entry);
      this.version++;
    } catch (error) {
      console.warn(`object ${entry.handle}: ${error.message}`);
    }
  }

  _addPart(entry, { mesh, look, opacity, symbol, local }, { color, emission, shine }) {
    const part = { mesh, look, symbol, local, slot: this.slots.take(entry.number), handle: entry.handle, transparent: opacity < 0.999 && !look.wireframe };
    this.slots.paint(part.slot, color, opacity, emission ?? [0, 0, 0], shine ?? 0);
    entry.parts.push(part);
    this.batches.add(part);
  }

  _addSymbol(entry, object) {
    const { solids, lines } = symbolOf(object, this.chosen.has(object.handle));
    const look = { order: 0, texture: null, decal: false, culling: true, wireframe: false, edgeColor: null };
    for (const { mesh, scale, pose, color, opacity, emission } of solids) {
      const part = { mesh: this.resources.primitive(mesh), look, opacity: opacity ?? 1, symbol: true, local: { pose: pose ?? IDENTITY, scale } };
      this._addPart(entry, part, { color, emission, shine: 0.2 });
    }
    entry.lines = lines;
  }

  async _addPoints(entry, { blob, objectType, size, points: asPoints = objectType === 'pointCloud' }) {
    const points = await this.resources.points(blob).catch((error) => console.warn(error.message));
    if (!entry.current || !points) return;
    const position = (i) => points.positions.subarray(3 * i, 3 * i + 3);
    const color = (i) => Array.from(points.colors.subarray(4 * i, 4 * i + 3), (x) => x / 255);
    if (!asPoints) {
      const cubes = new CopySet(this.gl, entry.slot, this.resources.primitive('box'));
      cubes.set(points.count, (i) => ({ position: position(i), size, color: color(i) }));
      entry.sets.push(cubes);
    } else {
      const set = new PointSet(this.gl, entry.slot, Math.max(size ?? 2, 1));
      set.set(points.count, position, color);
      entry.sets.push(set);
    }
    this.version++;
  }

  _place(entry) {
    const pose = this.store.poses.get(entry.handle) ?? IDENTITY;
    this.slots.place(entry.slot, pose);
    for (const { slot, local } of entry.parts) {
      if (local) this.slots.place(slot, poseProduct(pose, local.pose), local.scale);
      else this.slots.place(slot, pose);
    }
  }

  _discard(handle) {
    const entry = this.entries.get(handle);
    if (!entry) return;
    this.entries.delete(handle);
    entry.current = false;
    for (const part of entry.parts) {
      this.batches.remove(part);
      this.slots.give(part.slot);
    }
    this.slots.give(entry.slot);
    entry.sets.forEach((set) => set.free());
    entry.keys.forEach((key) => this.resources.release(key));
    this.numbers[entry.number] = -1;
    if (this.numbers.length > 100000) this._renumber();
  }

  /** Numbers are used once; after very many of them everything is made anew. */
  _renumber() {
    this.numbers = [-1];
    const drawn = [...this.entries.keys()];
    drawn.forEach((handle) => this._discard(handle));
    this.rebuild(drawn);
  }

  /** Brings the lines of all symbols and frames up to date. */
  prepareLines() {
    if (!this.dirtyLines) return;
    this.dirtyLines = false;
    const entries = [...this.entries.values()];
    this.lines.set(entries.flatMap(({ lines, slot }) => lines.map((line) => ({ ...line, slot }))));
    const framed = entries.filter(({ handle }) => this.options.frames || this.chosen.has(handle));
    this.thickLines.set(framed.flatMap(({ handle, slot }) => axes(this._frameSize(handle)).map((line) => ({ ...line, slot }))));
  }

  _frameSize(handle) {
    const box = this.store.objects.get(handle)?.boundingBox;
    if (!box) return 0.05;
    const size = Math.max(...box[0].map((low, i) => Math.max(-low, box[1][i])));
    return Math.min(Math.max(size * 1.3, 0.03), 0.6);
  }

  /** The box of objects in the world. @param {Iterable<number>} handles */
  bounds(handles) {
    const all = new Box();
    for (const handle of handles) {
      const [object, pose] = [this.store.objects.get(handle), this.store.poses.get(handle)];
      if (!object || !pose) continue;
      if (object.boundingBox) all.includeBox(pose, object.boundingBox);
      else all.include(pose);
    }
    return all;
  }

  /** What is worth looking at: visible shapes, without floors if there is anything else. */
  contentBounds() {
    const drawn = [...this.entries.keys()].map((handle) => this.store.objects.get(handle)).filter(Boolean);
    const extended = drawn.filter(({ objectType }) => ['shape', 'octree', 'pointCloud'].includes(objectType));
    const things = extended.filter((object) => !this.isFloor(object));
    const shown = things.length ? things : extended;
    return this.bounds(shown.map(({ handle }) => handle));
  }

  /** A flat shape as large as a floor: not what one wants to look at. */
  isFloor({ handle, boundingBox }) {
    const pose = this.store.poses.get(handle);
    if (!boundingBox || !pose) return false;
    const box = this.bounds([handle]);
    const [width, depth, height] = box.high.map((x, i) => x - box.low[i]);
    return Math.min(width, depth) > 2.1 && height < 0.05 * Math.min(width, depth) && box.high[2] < 0.05;
  }

  /** Whether a floor covers the grid's plane. */
  hasFloor() {
    return [...this.entries.keys()].some((handle) => {
      const object = this.store.objects.get(handle);
      return object?.objectType === 'shape' && this.isFloor(object) && this.bounds([handle]).high[2] > -0.02;
    });
  }

  /** An object and everything below it. */
  descendants(handle) {
    const all = [handle];
    for (let i = 0; i < all.length; i++) {
      for (const object of this.store.objects.values()) if (object.parent === all[i]) all.push(object.handle);
    }
    return all;
  }
}
