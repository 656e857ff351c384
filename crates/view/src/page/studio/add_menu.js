// New objects: a menu of what there is, and where it comes.
import { el, icon } from '../dom.js';

const GROUPS = [
  ['Shapes', [['cuboid', 'Cuboid'], ['sphere', 'Sphere'], ['cylinder', 'Cylinder'], ['cone', 'Cone'], ['capsule', 'Capsule'], ['plane', 'Plane']], 'shape'],
  ['Joints', [['revoluteJoint', 'Revolute joint'], ['prismaticJoint', 'Prismatic joint'], ['sphericalJoint', 'Spherical joint']], 'joint'],
  ['Sensors', [['raySensor', 'Proximity sensor, ray'], ['coneSensor', 'Proximity sensor, cone'], ['visionSensor', 'Vision sensor'], ['forceSensor', 'Force sensor']], 'proximitySensor'],
  ['Scripts', [['simulationScript', 'Simulation script'], ['customizationScript', 'Customization script']], 'script'],
  ['Others', [['dummy', 'Dummy'], ['camera', 'Camera'], ['omniLight', 'Light'], ['spotLight', 'Spotlight'], ['directionalLight', 'Directional light']], 'dummy'],
];
const BELOW = new Set(['simulationScript', 'customizationScript']); // of what is selected, whatever the choice

export class AddMenu {
  /** @param {any} page @param {import('./edits.js').Edits} edits @param {HTMLElement} button that opens it */
  constructor(page, edits, button) {
    Object.assign(this, { page, edits, button });
    this.below = el('input', { type: 'checkbox' });
    this.choice = el('label', { class: 'choice' }, this.below, 'Below what is selected, at its place');
    const groups = GROUPS.map(([title, kinds, sign]) => el('div', { role: 'group', 'aria-label': title }, el('h3', { 'aria-hidden': 'true' }, title), ...kinds.map(([kind, text]) => this._item(kind, text, sign))));
    this.element = el('div', { class: 'studio-menu add-menu', role: 'menu', 'aria-label': 'Add an object', hidden: true }, ...groups);
    this.panel = el('div', { class: 'add-panel', hidden: true }, this.element, this.choice);
    this.panel.addEventListener('keydown', (event) => this._key(event));
  }

  _item(kind, text, sign) {
    return el('button', { type: 'button', role: 'menuitem', tabindex: -1, class: 'menu-item', onclick: () => this._add(kind) }, icon(sign), text);
  }

  get open() {
    return !this.panel.hidden;
  }

  toggle(open = !this.open) {
    this.panel.hidden = this.element.hidden = !open;
    this.button.setAttribute('aria-expanded', String(open));
    this.choice.hidden = !this.edits.chosen.length;
    if (open) this.element.querySelector('button').focus();
    else this.button.focus({ preventScroll: true });
  }

  _key(event) {
    event.stopPropagation();
    const items = [...this.element.querySelectorAll('button')];
    const at = items.indexOf(document.activeElement);
    const to = { ArrowDown: at + 1, ArrowUp: at - 1, Home: 0, End: items.length - 1 }[event.key];
    if (event.key === 'Escape') this.toggle(false);
    if (to === undefined) return;
    event.preventDefault();
    items[(to + items.length) % items.length].focus();
  }

  async _add(kind) {
    const [parent] = this.edits.chosen.slice(-1);
    const isBelow = parent !== undefined && (BELOW.has(kind) || this.below.checked);
    this.toggle(false);
    this.page.renderer?.canvas.focus({ preventScroll: true });
    await this.edits.ask('add', isBelow ? { kind, parent } : { kind, position: this.place() });
  }

  /** In the middle of the picture, on what is seen there; rounded, so that values can be read. */
  place() {
    const { renderer } = this.page;
    if (!renderer) return [0, 0, 0];
    const point = renderer.pointAt(renderer.canvas.clientWidth / 2, renderer.canvas.clientHeight / 2);
    return point.map((x, i) => (i < 2 ? Math.round(x * 20) / 20 : Math.max(Math.round(x * 1000) / 1000, 0)));
  }
}
