// Directions to look from: buttons in the options, the letters of the axes, and keys.
import { el } from '../../dom.js';

const RIGHT = Math.PI / 2;

/** Names, keys, and yaw and pitch of looking. */
const VIEWS = {
  front: ['Front', '1', Math.PI, 0],
  back: ['Back', 'Ctrl+1', 0, 0],
  right: ['Right', '3', RIGHT, 0],
  left: ['Left', 'Ctrl+3', -RIGHT, 0],
  top: ['Top', '7', RIGHT, -RIGHT],
  bottom: ['Bottom', 'Ctrl+7', RIGHT, RIGHT],
};
const OPPOSITE = { 1: 'back', 3: 'left', 7: 'bottom' };
const AXES = [['front', 'back'], ['left', 'right'], ['top', 'bottom']];
const HOME = { yaw: -0.95, pitch: -0.42 };

export class Presets {
  constructor(page) {
    this.page = page;
    const buttons = Object.entries(VIEWS).map(([name, [text, key]]) => this._button(text, `From the ${name} (${key})`, () => this.show(name)));
    const home = this._button('Home', 'Everything, as at first (Home)', () => this.home());
    this.element = el('div', { class: 'presets', role: 'group', 'aria-label': 'Directions' }, ...buttons, home);
    if (page.renderer) addEventListener('keydown', (event) => this._key(event));
  }

  _button(text, title, onclick) {
    return el('button', { type: 'button', class: 'text-button', title, onclick }, text);
  }

  show(name) {
    const [, , yaw, pitch] = VIEWS[name];
    this.page.lookAlong(yaw, pitch);
  }

  home() {
    this.page.fit([]);
    const { camera } = this.page.sight;
    if (camera.motion) Object.assign(camera.motion.to, HOME);
    else Object.assign(camera, HOME), this.page.fit([]);
    this.page.renderer.stale = true;
  }

  /** Ctrl or Shift with a digit: from the other side. Browsers keep some of these keys to themselves in tabs. */
  _key(event) {
    const digit = /^(?:Digit|Numpad)([137])$/.exec(event.code)?.[1];
    if (!digit || !(event.ctrlKey || event.shiftKey) || event.altKey || event.metaKey || event.target.closest?.('input, select, textarea, dialog, [contenteditable]')) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    this.show(OPPOSITE[digit]);
  }

  /** Letters of the axes as buttons: a click looks along the axis, another one from the other side. @param {SVGElement[]} letters of x, y and z */
  onLetters(letters) {
    letters.forEach((letter, i) => {
      const look = () => this.show(AXES[i].find((name) => name !== this.last) ?? AXES[i][0]);
      const press = () => {
        look();
        this.last = AXES[i].find((name) => name !== this.last) ?? AXES[i][0];
      };
      Object.entries({ role: 'button', tabindex: '0', 'aria-label': `Look along ${'XYZ'[i]}`, class: `${letter.getAttribute('class')} axis-button` }).forEach(([name, value]) => letter.setAttribute(name, value));
      letter.addEventListener('click', press);
      letter.addEventListener('keydown', (event) => {
        if (event.key !== 'Enter' && event.key !== ' ') return;
        event.preventDefault();
        event.stopPropagation();
        press();
      });
    });
  }
}
