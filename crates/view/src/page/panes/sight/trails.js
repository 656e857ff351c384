// The paths of selected objects over the last seconds, as lines that fade.
import { LineSet } from '../../render/gpu/sets.js';

const SECONDS = 10; // of the simulation
const POINTS = 500; // of a path
const NEAR = 1e-4; // metres: less is no motion
const COLORS = [[0.05, 0.45, 0.9], [0.85, 0.35, 0.1], [0.1, 0.6, 0.3], [0.55, 0.3, 0.85]];

export class Trails {
  constructor(page) {
    Object.assign(this, { page, store: page.store, shown: false });
    this.paths = new Map(); // by handle: lists of time, x, y, z
    this.lines = new LineSet(page.renderer.gl, 2);
    page.renderer.overlaid.push(this.lines);
    page.store.on('poses', (moved) => this.shown && this._moved(moved));
    page.store.on('selection', () => this.shown && this._selected());
  }

  show(shown) {
    this.shown = shown;
    this.paths.clear();
    this._selected();
  }

  _selected() {
    const chosen = new Set(this.shown ? this.store.selection.slice(0, COLORS.length) : []);
    for (const handle of this.paths.keys()) if (!chosen.has(handle)) this.paths.delete(handle);
    for (const handle of chosen) if (!this.paths.has(handle)) this.paths.set(handle, []);
    this._draw();
  }

  _moved(moved) {
    const time = this.store.scene.time ?? 0;
    let differs = false;
    for (const [handle, path] of this.paths) if (moved.has(handle)) differs = this._append(path, time, this.store.poses.get(handle)) || differs;
    if (differs) this._draw();
  }

  _append(path, time, pose) {
    const last = path.at(-1);
    if (last && time < last[0]) path.length = 0; // the simulation began again
    if (last && Math.hypot(pose[0] - last[1], pose[1] - last[2], pose[2] - last[3]) < NEAR) return false;
    path.push([time, pose[0], pose[1], pose[2]]);
    while (path.length > POINTS || path[0][0] < time - SECONDS) path.shift();
    return true;
  }

  _draw() {
    const slot = this.page.renderer.slots.world;
    const groups = [...this.paths.values()].flatMap((path, k) => path.slice(1).map((to, i) => ({ points: [...path[i].slice(1), ...to.slice(1)], color: [...COLORS[k], (i + 1) / path.length], slot })));
    this.lines.set(groups);
    this.page.renderer.stale = true;
  }
}
