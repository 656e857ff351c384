// Distances: between two places that are clicked, or between two objects that are selected.
import { el } from '../../dom.js';
import { LineSet } from '../../render/gpu/sets.js';

const INK = [0.95, 0.55, 0.05];
const CROSS = 0.012; // of the distance of the camera: half of the marks at the ends

const metres = (x) => `${x.toFixed(Math.abs(x) < 10 ? 4 : 3)} m`;

export class Measure {
  constructor(page) {
    Object.assign(this, { page, renderer: page.renderer, active: false, ends: [] });
    this.lines = new LineSet(this.renderer.gl, 2);
    this.renderer.overlaid.push(this.lines);
    this.label = el('output', { class: 'measure', hidden: true, 'aria-label': 'Distance' });
    document.getElementById('overlay').append(this.label);
    page.store.on('poses', (moved) => this.between?.some((handle) => moved.has(handle)) && this._follow());
  }

  /** Begins, or ends. Between two selected objects at once. */
  toggle() {
    if (this.active) return void this.end();
    this.active = true;
    const { selection } = this.page.store;
    if (selection.length === 2) {
      this.between = [...selection];
      return this._follow();
    }
    this.renderer.canvas.classList.add('measures');
    this.page.overlay.say('Click two points. Esc ends measuring.');
  }

  _follow() {
    const poses = this.between.map((handle) => this.page.store.poses.get(handle));
    if (poses.every(Boolean)) this._show(poses.map((pose) => [...pose.slice(0, 3)]));
  }

  /** A click while it is active. @param {{point: number[]} | null} hit @returns {boolean} whether it is taken */
  clicked(hit) {
    if (!this.active || this.between) return false;
    if (!hit) return true;
    this._show(this.ends.length === 1 ? [this.ends[0], hit.point] : [hit.point]);
    return true;
  }

  _show(ends) {
    this.ends = ends;
    const slot = this.renderer.slots.world;
    const size = CROSS * this.renderer.camera.distance;
    const mark = (p) => [0, 1, 2].flatMap((i) => [-size, size].flatMap((by) => p.map((x, k) => (k === i ? x + by : x))));
    const points = [...ends.flatMap(mark), ...(ends.length === 2 ? ends.flat() : [])];
    this.lines.set([{ points, color: INK, slot }]);
    this.renderer.stale = true;
    if (ends.length === 2) this._say(ends);
    else this.label.hidden = true;
  }

  _say([a, b]) {
    const by = a.map((x, i) => b[i] - x);
    const parts = by.map((x, i) => el('span', {}, `d${'xyz'[i]} ${metres(x)}`));
    this.label.replaceChildren(el('strong', {}, metres(Math.hypot(...by))), ...parts);
    this.label.hidden = false;
    this.place();
  }

  /** After each picture: the words stay at the middle of the line. */
  place() {
    if (this.ends.length !== 2) return;
    const at = this.renderer.screenPosition(this.ends[0].map((x, i) => (x + this.ends[1][i]) / 2));
    this.label.hidden = !at;
    if (at) Object.assign(this.label.style, { left: `${at[0] + 10}px`, top: `${at[1] + 10}px` });
  }

  /** @returns {boolean} whether there was anything to end */
  end() {
    const was = this.active;
    Object.assign(this, { active: false, ends: [], between: null });
    this.renderer.canvas.classList.remove('measures');
    this.lines.set([]);
    this.label.hidden = true;
    this.renderer.stale = true;
    return was;
  }
}
