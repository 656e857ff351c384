// Drawing objects of scripts, contacts: things in the scene that are no objects.
import { add, cross, length, normalized, scaled, sub } from '../maths.js';
import { CopySet, LineSet, PointSet } from './gpu/sets.js';

const COPIES = { trianglePoint: 'triangle', quadPoint: 'quad', discPoint: 'disc', cubePoint: 'box', spherePoint: 'ball' };
const NEWTONS_PER_METRE = 200; // forces are drawn at this scale
const NORMAL = 0.04; // metres
const HEAD = 0.03; // the same: the largest head of an arrow

export class Drawings {
  constructor(gl, store, slots, resources, view) {
    Object.assign(this, { gl, store, slots, resources, view });
    this.sets = new Map();
    this.contacts = new LineSet(gl, 1.5);
  }

  /** @param {Set<any>} ids */
  changed(ids) {
    for (const id of ids) {
      this._discard(id);
      const drawing = this.store.drawings.get(id);
      if (drawing?.items?.length) this.sets.set(id, this._create(drawing));
    }
  }

  _discard(id) {
    const entry = this.sets.get(id);
    if (!entry) return;
    this.sets.delete(id);
    entry.set.free();
    this.slots.give(entry.slot);
  }

  _create(drawing) {
    const slot = this.slots.take(0);
    this.slots.paint(slot, [1, 1, 1], 1 - (drawing.transparency ?? 0));
    return { slot, parent: drawing.parent, overlay: drawing.overlay, set: this._set(drawing, slot) };
  }

  _set(drawing, slot) {
    const { itemType, size, items, stride } = drawing;
    const count = Math.floor(items.length / stride);
    const color = (i) => (drawing.colors ? drawing.colors.slice(3 * i, 3 * i + 3) : drawing.color ?? [1, 0, 0]);
    const position = (i) => items.slice(stride * i, stride * i + 3);
    if (itemType === 'line' || itemType === 'lineStrip' || itemType === 'triangle') {
      const set = new LineSet(this.gl, Math.max(size ?? 1, 1));
      set.set(LINES[itemType](items, stride, count).map((points, i) => ({ points, color: color(i), slot })));
      return set;
    }
    if (itemType === 'point') {
      const set = new PointSet(this.gl, slot, Math.max(size ?? 1, 1));
      set.set(count, position, color);
      return set;
    }
    const set = new CopySet(this.gl, slot, this.resources.primitive(COPIES[itemType] ?? 'ball'));
    set.set(count, (i) => ({ position: position(i), size: drawing.sizes?.[i] ?? size, color: color(i), turn: stride >= 7 ? items.slice(stride * i + 3, stride * i + 7) : undefined }));
    return set;
  }

  /** Moves drawings with the objects that they are attached to. */
  place() {
    for (const { slot, parent } of this.sets.values()) {
      const pose = parent >= 0 ? this.store.poses.get(parent) : null;
      if (pose) this.slots.place(slot, pose);
    }
  }

  contactsChanged() {
    const slot = this.slots.world;
    this.contacts.set(this.store.contacts.flatMap(({ point, normal, force }) => {
      const end = (v, scale) => point.map((x, i) => x + v[i] * scale);
      return [
        { points: arrow(point, end(force, 1 / NEWTONS_PER_METRE)), color: [0.95, 0.45, 0.1], slot },
        { points: arrow(point, end(normal, NORMAL)), color: [0.2, 0.6, 0.9], slot },
      ];
    }));
  }

  of(Type, overlay) {
    return [...this.sets.values()].filter((entry) => entry.set instanceof Type && !!entry.overlay === overlay).map((entry) => entry.set);
  }
}

/** Lines of an arrow: the shaft and four lines of its head. */
function arrow(from, to) {
  const along = sub(to, from);
  const size = Math.min(0.3 * length(along), HEAD);
  if (size < 1e-6) return [];
  const back = scaled(normalized(along), -size);
  const side = scaled(normalized(cross(along, Math.abs(along[2]) < 0.9 * length(along) ? [0, 0, 1] : [1, 0, 0])), 0.4 * size);
  const other = cross(normalized(along), side);
  const heads = [side, scaled(side, -1), other, scaled(other, -1)].flatMap((out) => [...to, ...add(add(to, back), out)]);
  return [...from, ...to, ...heads];
}

/** Lists of line ends, one list per item. */
const LINES = {
  line: (items, stride, count) => Array.from({ length: count }, (_, i) => items.slice(stride * i, stride * i + 6)),
  lineStrip: (items, stride, count) =>
    Array.from({ length: Math.max(count - 1, 0) }, (_, i) => [...items.slice(stride * i, stride * i + 3), ...items.slice(stride * (i + 1), stride * (i + 1) + 3)]),
  triangle: (items, stride, count) =>
    Array.from({ length: count }, (_, i) => {
      const corner = (k) => items.slice(stride * i + 3 * k, stride * i + 3 * k + 3);
      return [0, 1, 2].flatMap((k) => [...corner(k), ...corner((k + 1) % 3)]);
    }),
};
