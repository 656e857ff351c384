// What floats above the scene: frames with a title that are moved by pointer and keys, folded and put away, and remember their place.
import { el, iconButton, setText } from '../dom.js';
import { remember, setting } from '../settings.js';

const AXES = 96; // pixels of the upper right corner that the directions of the axes need
const STEP = 16; // pixels for an arrow key
const ARROWS = { ArrowLeft: [-STEP, 0], ArrowRight: [STEP, 0], ArrowUp: [0, -STEP], ArrowDown: [0, STEP] };

let highest = 1;

/** `&&` in a title is an ampersand, as Qt writes it. @param {string} text */
export const titleText = (text) => text.replaceAll('&&', '&');

export class Floating {
  /**
   * @param {HTMLElement} layer above the scene @param {import('./shelf.js').Shelf} shelf where it goes when it is put away
   * @param {{id: string, kind: string, members?: Object<string, any>, close?: function(): void}} how `close` in place of putting it away
   */
  constructor(layer, shelf, { id, kind, members = {}, close }) {
    Object.assign(this, { layer, shelf, kind });
    this.title = el('h2', { id: `${kind}-${id}` });
    this.fold = iconButton('fold', 'Fold', () => this.setFolded(!this.folded, true), { class: 'icon-button window-fold' });
    this.grip = iconButton('grip', 'Move by dragging or with the arrow keys', null, { class: 'icon-button window-grip', 'aria-keyshortcuts': Object.keys(ARROWS).join(' ') });
    this.bar = el('header', {}, this.grip, this.title, this.fold, iconButton('close', 'Close', close ?? (() => this.putAway())));
    this.element = el('section', { class: 'window', 'aria-labelledby': this.title.id, [`data-${kind}`]: id, ...members }, this.bar);
    this.bar.addEventListener('pointerdown', (event) => this._drag(event));
    this.grip.addEventListener('keydown', (event) => this._move(event));
    this.element.addEventListener('pointerdown', () => this.raise());
    this.setFolded(false);
  }

  setTitle(text) {
    const shown = titleText(text);
    setText(this.title, shown);
    if (this.name === shown) return;
    this.name = shown;
    this.grip.setAttribute('aria-label', `Move ${shown}`);
  }

  /** Where it was left: two numbers, or none. */
  get kept() {
    return setting(`${this.kind} ${this.name}`, []);
  }

  setFolded(folded, kept = false) {
    this.folded = folded;
    this.element.classList.toggle('folded', folded);
    this.fold.setAttribute('aria-expanded', String(!folded));
    if (kept) remember(`folded ${this.kind} ${this.name}`, folded);
  }

  get keptFolded() {
    return setting(`folded ${this.kind} ${this.name}`, false);
  }

  /** Hidden until the options bring it back. */
  putAway() {
    this.away = true;
    this.showAway();
    this.shelf.put(this, this.name, () => {
      this.away = false;
      this.showAway();
      this.grip.focus();
    });
  }

  showAway() {
    this.element.hidden = !!this.away;
  }

  remove() {
    this.shelf.take(this);
    this.element.remove();
  }

  /** The one that was touched last is before all others. */
  raise() {
    this.element.style.zIndex = String(++highest);
  }

  moveTo(x, y) {
    const { clientWidth, clientHeight } = this.layer;
    this.x = Math.min(Math.max(x, 0), Math.max(clientWidth - this.element.offsetWidth, 0));
    this.y = Math.min(Math.max(y, 0), Math.max(clientHeight - this.element.offsetHeight, 0));
    this.element.style.left = `${this.x}px`;
    this.element.style.top = `${this.y}px`;
  }

  /** To a place that nobody has chosen: beside the directions of the axes, not over them. */
  placeAt(x, y) {
    const { clientWidth, clientHeight } = this.layer;
    const { offsetWidth: width, offsetHeight: height } = this.element;
    const covers = x + width > clientWidth - AXES && y < AXES;
    if (!covers) return this.moveTo(x, y);
    if (AXES + height <= clientHeight || width > clientWidth - AXES) return this.moveTo(x, AXES);
    this.moveTo(clientWidth - AXES - width, y);
  }

  _drag(event) {
    if (event.target.closest('button:not(.window-grip)') || event.button !== 0) return;
    const [dx, dy] = [event.clientX - this.element.offsetLeft, event.clientY - this.element.offsetTop];
    this.bar.setPointerCapture(event.pointerId);
    const move = (at) => this.moveTo(at.clientX - dx, at.clientY - dy);
    this.bar.addEventListener('pointermove', move);
    const ended = () => {
      this.bar.removeEventListener('pointermove', move);
      this._keep();
      this.grip.focus(); // arrow keys go on
    };
    this.bar.addEventListener('lostpointercapture', ended, { once: true });
  }

  _move(event) {
    const by = ARROWS[event.key];
    if (!by) return;
    event.preventDefault();
    event.stopPropagation();
    this.moveTo(this.element.offsetLeft + by[0], this.element.offsetTop + by[1]);
    this._keep();
  }

  _keep() {
    if (this.x !== undefined) remember(`${this.kind} ${this.name}`, [this.x, this.y]);
  }
}
