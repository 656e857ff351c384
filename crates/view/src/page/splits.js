// Borders of panels that are dragged, or moved by keys; sizes are remembered.
import { el } from './dom.js';
import { remember, setting } from './settings.js';

const STEP = 16; // pixels for an arrow key

/** Panels with the edge that moves, and the smallest size in pixels. */
const PANELS = [
  { name: 'side', edge: 'right', label: 'Width of objects and properties', least: 180 },
  { name: 'script', edge: 'left', label: 'Width of the script', least: 220 },
  { name: 'console', edge: 'top', label: 'Height of the console', least: 72 },
  { name: 'curves', edge: 'top', label: 'Height of the curves', least: 90 },
];

class Border {
  constructor({ name, edge, label, least }) {
    Object.assign(this, { name, least, panel: document.getElementById(name), wide: edge !== 'top', sign: edge === 'right' ? 1 : -1 });
    this.element = el('div', { class: `border ${edge}`, role: 'separator', tabindex: 0, 'aria-label': label, 'aria-controls': name, 'aria-orientation': this.wide ? 'vertical' : 'horizontal', title: `${label}; a double click makes it usual` });
    this.panel.prepend(this.element);
    this.element.addEventListener('pointerdown', (event) => this._drag(event));
    this.element.addEventListener('keydown', (event) => this._key(event));
    this.element.addEventListener('dblclick', () => this._set(null));
    new ResizeObserver(() => this._say()).observe(this.panel);
    this._set(setting(`size ${name}`, 0) || null, false);
  }

  get _size() {
    return this.wide ? this.panel.offsetWidth : this.panel.offsetHeight;
  }

  get _most() {
    return Math.round(0.6 * (this.wide ? innerWidth : innerHeight));
  }

  /** @param {number | null} size in pixels; null: as it is at first */
  _set(size, kept = true) {
    const fitting = size === null ? null : Math.round(Math.min(Math.max(size, this.least), this._most));
    const { style } = document.documentElement;
    if (fitting === null) style.removeProperty(`--size-${this.name}`);
    else style.setProperty(`--size-${this.name}`, `${fitting}px`);
    if (kept) remember(`size ${this.name}`, fitting ?? 0);
  }

  _say() {
    const values = { 'aria-valuenow': this._size, 'aria-valuemin': this.least, 'aria-valuemax': this._most };
    for (const [name, value] of Object.entries(values)) this.element.setAttribute(name, String(value));
  }

  _drag(start) {
    const [from, size] = [this.wide ? start.clientX : start.clientY, this._size];
    this.element.setPointerCapture(start.pointerId);
    const move = (event) => this._set(size + this.sign * ((this.wide ? event.clientX : event.clientY) - from), false);
    this.element.addEventListener('pointermove', move);
    const ended = () => {
      this.element.removeEventListener('pointermove', move);
      if (this._size !== size) this._set(this._size);
    };
    this.element.addEventListener('lostpointercapture', ended, { once: true });
  }

  _key(event) {
    const along = this.wide ? { ArrowLeft: -1, ArrowRight: 1 } : { ArrowUp: -1, ArrowDown: 1 };
    const by = along[event.key] && this.sign * along[event.key] * STEP * (event.shiftKey ? 5 : 1);
    const wanted = by ? this._size + by : { Home: this.least, End: this._most, Enter: null }[event.key];
    if (wanted === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    this._set(wanted);
  }
}

/** Gives the panels their borders. */
export function addBorders() {
  PANELS.forEach((panel) => new Border(panel));
}
