// Forces and torques of joints as colours: blue where they are negative, white at nothing, red where they are positive.
import { el, setText } from '../../dom.js';

const MOST = 200; // joints
const ENDS = { negative: [0.1, 0.3, 0.95], none: [0.96, 0.96, 0.96], positive: [0.9, 0.12, 0.1] };

/** @param {number} part -1 to 1 */
export function colorOf(part) {
  const end = part < 0 ? ENDS.negative : ENDS.positive;
  const t = Math.min(Math.abs(part), 1);
  return ENDS.none.map((x, i) => x + (end[i] - x) * t);
}

export class Torques {
  constructor(page) {
    Object.assign(this, { page, store: page.store, shown: false, forces: new Map() });
    this.most = { revolute: 0, prismatic: 0 }; // the largest so far
    this.low = el('span');
    this.high = el('span');
    this.legend = el('div', { class: 'torques', role: 'img', hidden: true }, this.low, el('span', { class: 'torque-scale' }), this.high);
    document.getElementById('overlay').append(this.legend);
    page.store.on('objects', (changed) => this.shown && this._changed(changed));
  }

  show(shown) {
    this.shown = shown && this.page.source.live;
    if (shown && !this.shown) this.page.overlay.say('A recording has no forces of joints.');
    this.legend.hidden = !this.shown;
    this.handles = null;
    this.forces.clear();
    Object.assign(this.most, { revolute: 0, prismatic: 0 });
    this._follow();
    if (!this.shown) this.page.renderer.view.refresh([...this.store.objects.values()].filter(({ objectType }) => objectType === 'joint').map(({ handle }) => handle));
    this._say();
  }

  _changed(changed) {
    const known = new Set(this.handles);
    const comesOrGoes = (handle) => known.has(handle) !== (this.store.objects.get(handle)?.objectType === 'joint');
    if ([...changed].some(comesOrGoes)) this._follow();
    else this._paint();
  }

  /** All joints, as they come and go. */
  _follow() {
    const joints = this.shown ? [...this.store.objects.values()].filter(({ objectType, jointType }) => objectType === 'joint' && jointType !== 'spherical') : [];
    const handles = joints.slice(0, MOST).map(({ handle }) => handle);
    if (this.handles?.join() !== handles.join()) {
      this.handles = handles;
      this.page.samples.follow(this, handles.map((handle) => ({ handle, name: 'jointForce' })), (_, values) => this._take(values));
    }
    this._paint();
  }

  _take(values) {
    this.handles.forEach((handle, i) => {
      const force = values[i].at(-1) ?? 0;
      const type = this.store.objects.get(handle)?.jointType;
      this.forces.set(handle, force);
      if (type in this.most) this.most[type] = Math.max(this.most[type], Math.abs(force));
    });
    this._paint();
    this._say();
  }

  /** Colours of the symbols, which are made anew when their objects change. */
  _paint() {
    const { view, slots } = this.page.renderer;
    for (const [handle, force] of this.forces) {
      const type = this.store.objects.get(handle)?.jointType;
      const color = colorOf(force / (this.most[type] || 1));
      for (const { slot } of view.entries.get(handle)?.parts ?? []) slots.paint(slot, color, 1, color.map((x) => x * 0.25), 0.2);
    }
    this.page.renderer.stale = true;
  }

  _say() {
    const { revolute, prismatic } = this.most;
    const words = [revolute || !prismatic ? `${+revolute.toPrecision(3)} N m` : '', prismatic ? `${+prismatic.toPrecision(3)} N` : ''].filter(Boolean).join(', ');
    setText(this.low, `−${words.replace(', ', ', −')}`);
    setText(this.high, words);
    this.legend.setAttribute('aria-label', `Forces and torques of joints: blue −${words}, red ${words}`);
  }
}
