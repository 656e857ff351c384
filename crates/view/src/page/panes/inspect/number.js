// Fields for numbers: typed, changed by the arrow keys, or by dragging their label. What keys or dragging do becomes one change at the end.
import { el } from '../../dom.js';
import { fitted, watchRoom } from './fit.js';
import { shownUnit } from './units.js';

const STEPS = { m: 0.01, '°': 1, rad: 0.01 };
const START = 3; // pixels before dragging begins

/** Numbers with a fixed width behind the point, except integers. */
export function decimal(x, unit = '') {
  const size = Math.abs(x);
  if (size !== 0 && (size < 1e-4 || size >= 1e7)) return x.toExponential(4);
  return x.toFixed(unit.startsWith('°') ? 2 : 4);
}

/** The same where what is next to nothing is nothing, as in poses. */
export const withoutNoise = (x, unit) => (Math.abs(x) < 5e-5 ? (0).toFixed(unit.startsWith('°') ? 2 : 4) : decimal(x, unit));

/** As short as it can be, where there is little room. */
export const short = (x, unit) => withoutNoise(x, unit).replace(/(\.\d*?)0+(?=e|$)/, '$1').replace(/\.(?=e|$)/, '');

/** How many steps at once: with Shift ten, with Alt a tenth. */
const times = (event) => (event.shiftKey ? 10 : event.altKey ? 0.1 : 1);

export class NumberField {
  /** @param {{label: string, value: number, unit?: string, integer?: boolean, form?: function(number, string): string, change: function(number): void}} how `value` and what `change` gets in the unit */
  constructor({ label, value, unit, integer = false, form = decimal, change }) {
    Object.assign(this, { ...shownUnit(unit), integer, form, change, value, pending: null, edited: false, room: 0 });
    this.element = el('input', { type: 'text', class: 'value number', 'aria-label': label, spellcheck: 'false', inputmode: 'decimal' });
    const listen = (type, handler) => this.element.addEventListener(type, handler);
    listen('input', () => (this.edited = true));
    listen('change', () => this._typed());
    listen('keydown', (event) => this._key(event));
    listen('keyup', (event) => event.key.startsWith('Arrow') && this._commit());
    listen('focus', () => this.show(this.value));
    listen('blur', () => (this._commit(), this.show(this.value)));
    watchRoom(this.element, (room) => ((this.room = room), this.show(this.value)));
    this.show(value);
  }

  /** @param {number} value what it is now; a field that is being changed stays */
  show(value) {
    this.value = value;
    if (!this.edited && this.pending === null) this._write(value);
  }

  /** All figures while it is edited; otherwise as many as there is room for, and all of them in the title. */
  _write(value) {
    const { element, unit } = this;
    const shown = value * this.factor;
    const full = this.integer ? String(value) : typeof value === 'number' ? this.form(shown, unit) : '–';
    const text = document.activeElement === element ? full : fitted(full, shown, this.room);
    if (element.value !== text) element.value = text;
    const title = typeof value !== 'number' || Number(text) === shown ? '' : `${shown} ${unit}`.trim();
    if (element.title !== title) element.title = title;
  }

  /** Back to what it is. */
  reset() {
    this.edited = false;
    this.pending = null;
    this._write(this.value);
  }

  _typed() {
    const typed = this.element.value.trim() === '' ? NaN : Number(this.element.value);
    this.edited = false;
    if (!Number.isFinite(typed) || (this.integer && !Number.isInteger(typed))) return this.reset();
    this._give(typed / this.factor);
  }

  _give(value) {
    this.value = value;
    this._write(value);
    this.change(value);
  }

  _key(event) {
    const by = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    if (event.key === 'Enter') this._commit();
    if (event.key === 'Escape') this.reset(), this.element.blur();
    if (!by) return;
    event.preventDefault();
    if (this.edited) this._take();
    this._suggest((this.pending ?? this.value) + by * this._step(event));
  }

  /** What was typed is what keys go on from. */
  _take() {
    const typed = Number(this.element.value);
    if (Number.isFinite(typed)) this.pending = typed / this.factor;
    this.edited = false;
  }

  /** A step in the unit of the value. */
  _step(event) {
    if (this.integer) return event.shiftKey ? 10 : 1;
    const usual = STEPS[this.unit] ?? 10 ** Math.floor(Math.log10(Math.max(Math.abs(this.value * this.factor), 0.01))) / 10;
    return (usual * times(event)) / this.factor;
  }

  _suggest(value) {
    this.pending = this.integer ? Math.round(value) : value;
    this._write(this.pending);
  }

  _commit() {
    if (this.pending === null) return;
    const value = this.pending;
    this.pending = null;
    this._give(value);
  }

  /** Dragging this label changes the number. @param {HTMLElement} handle */
  draggedBy(handle) {
    handle.classList.add('scrub');
    handle.addEventListener('pointerdown', (event) => event.pointerType !== 'touch' && event.button === 0 && this._drag(handle, event));
  }

  _drag(handle, start) {
    start.preventDefault();
    handle.setPointerCapture(start.pointerId);
    let [at, moved] = [start.clientX, false];
    const move = (event) => {
      moved ||= Math.abs(event.clientX - start.clientX) >= START;
      if (!moved) return;
      this._suggest((this.pending ?? this.value) + (event.clientX - at) * this._step(event));
      at = event.clientX;
    };
    handle.addEventListener('pointermove', move);
    const ended = () => {
      handle.removeEventListener('pointermove', move);
      this._commit();
    };
    handle.addEventListener('lostpointercapture', ended, { once: true });
  }
}

/** Some numbers side by side, such as a vector; each of them changes the whole list. */
export class NumberList {
  /** @param {{label: string, names?: string[], value: number[], unit?: string, integer?: boolean, change: function(number[]): void}} how */
  constructor({ label, names = ['x', 'y', 'z', 'w'], value, unit, integer, change }) {
    this.value = value;
    this.fields = value.map((number, i) => new NumberField({ label: `${label} ${names[i]}`, value: number, unit, integer, form: short, change: (fresh) => change((this.value = this.value.map((x, k) => (k === i ? fresh : x)))) }));
    this.unit = this.fields[0].unit;
    this.element = el('div', { class: 'number-list' }, ...this.fields.map(({ element }) => element));
  }

  show(value) {
    this.value = value;
    this.fields.forEach((field, i) => field.show(value[i]));
  }

  reset() {
    this.fields.forEach((field) => field.reset());
  }
}
