// Numbers of properties on the pane of curves: over a live run, whose steps the simulator sends, or over a recording.
import { iconButton } from '../../dom.js';

const TYPE = 'application/x-swanilda-values'; // of what is dragged
const POINTS = 20000; // of a curve; older ones go
const PARTS = ['x', 'y', 'z', 'w'];

/** @param {any} row of the inspector @returns {{name: string, index: number | null, part: string}[]} its numbers; none of what has none */
export function numbersOf({ name, value }) {
  if (typeof value === 'number' || typeof value === 'boolean') return [{ name, index: null, part: '' }];
  if (!Array.isArray(value) || !value.length || !value.every((x) => typeof x === 'number')) return [];
  const count = name === 'absolutePose' || name === 'pose' ? 3 : value.length; // positions
  return count > 4 ? [] : Array.from({ length: count }, (_, index) => ({ name, index, part: value.length === 2 ? String(index + 1) : PARTS[index] }));
}

export class Plots {
  constructor(page) {
    Object.assign(this, { page, store: page.store });
    this.followed = []; // handle, name, index and the curve of each
    this._accept(document.getElementById('curves'));
  }

  /** A button at a row that puts its numbers on the pane, or takes them away; it can be dragged there, too. */
  button(handle, row) {
    const title = this.page.source.live ? 'Put it on the curves' : 'Curve over the recording';
    const shown = this.followed.some((each) => each.handle === handle && each.name === row.name);
    const button = iconButton('curve', title, () => this.toggle(handle, row), { class: 'icon-button copy plot-button', draggable: 'true', 'data-plots': `${handle} ${row.name}`, 'aria-label': `${title}: ${row.label}`, 'aria-pressed': this.page.source.live ? String(shown) : null });
    this.dragsFrom(button, handle, row);
    return button;
  }

  /** @param {HTMLElement} element that is dragged to the pane */
  dragsFrom(element, handle, row) {
    element.draggable = true;
    element.addEventListener('dragstart', (event) => {
      event.dataTransfer.setData(TYPE, JSON.stringify({ handle, name: row.name }));
      event.dataTransfer.effectAllowed = 'copy';
      this.dragged = { handle, row };
      setTimeout(() => this.page.curves.await(true)); // what is dragged must not move in this moment
    });
    element.addEventListener('dragend', () => this.page.curves.await(false));
  }

  _accept(pane) {
    pane.addEventListener('dragover', (event) => event.dataTransfer.types.includes(TYPE) && (event.preventDefault(), (event.dataTransfer.dropEffect = 'copy')));
    pane.addEventListener('drop', (event) => {
      if (!event.dataTransfer.types.includes(TYPE) || !this.dragged) return;
      event.preventDefault();
      this.add(this.dragged.handle, this.dragged.row);
    });
  }

  toggle(handle, row) {
    const there = this.followed.filter((each) => each.handle === handle && each.name === row.name);
    if (!there.length) return this.add(handle, row);
    there.forEach(({ curve }) => this.page.curves.remove(curve.name));
  }

  add(handle, row) {
    if (!this.page.source.live) return void this.page.showCurve(handle, row);
    const object = this.store.objects.get(handle);
    const title = `${object?.alias ?? 'scene'} ${row.label || row.name}`;
    for (const { name, index, part } of numbersOf(row)) {
      if (this.followed.some((each) => each.handle === handle && each.name === name && each.index === index)) continue;
      const curve = { name: [title, part].filter(Boolean).join(' '), unit: row.unit ?? '', x: [], y: [] };
      this.followed.push({ handle, name, index, curve: this.page.curves.add(curve) });
    }
    this._follow();
  }

  /** The pane has no such curve any more. */
  removed(curve) {
    const left = this.followed.filter((each) => each.curve !== curve);
    if (left.length === this.followed.length) return;
    this.followed = left;
    this._follow();
  }

  _follow() {
    this.page.samples.follow(this, this.followed.map(({ handle, name, index }) => ({ handle, name, index })), (times, values) => this._take(times, values));
    for (const button of document.querySelectorAll('[data-plots]')) button.setAttribute('aria-pressed', String(this.followed.some(({ handle, name }) => button.dataset.plots === `${handle} ${name}`)));
  }

  _take(times, values) {
    this.followed.forEach(({ curve }, i) => append(curve, times, values[i]));
    this.page.curves.draw();
  }
}

/** A simulation that begins again begins its curves again. */
function append(curve, times, values) {
  times.forEach((time, i) => {
    if (curve.x.length && time < curve.x.at(-1)) curve.x.length = curve.y.length = 0;
    const at = time === curve.x.at(-1) ? curve.x.length - 1 : curve.x.length; // changed without a step: the last point is another
    curve.x[at] = time;
    curve.y[at] = values[i] ?? NaN;
  });
  const surplus = curve.x.length - POINTS;
  if (surplus > 0) [curve.x, curve.y].forEach((list) => list.splice(0, surplus));
}
