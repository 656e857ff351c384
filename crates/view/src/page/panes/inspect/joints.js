// The joints of a model, or below an object: sliders for their positions, or for what they are driven to.
import { el, setText } from '../../dom.js';
import { decimal } from './number.js';
import { shownUnit } from './units.js';

const MOST = 60; // joints
const FOLLOWED = ['jointMode', 'dynCtrlMode', 'targetPos', 'targetVel'];
const DYNAMIC = 5;
const [VELOCITY, POSITION, SPRING] = [4, 8, 12];
const newGesture = () => Math.floor(Math.random() * 2 ** 50);
const FASTEST = { rad: Math.PI, m: 1 }; // of sliders for velocities, unless it is faster already

/** Joints below an object, and itself if it is one. */
export function jointsOf(store, view, handle) {
  const all = handle >= 0 ? view.descendants(handle) : [];
  return all.map((each) => store.objects.get(each)).filter((object) => object?.objectType === 'joint' && object.jointType !== 'spherical').slice(0, MOST);
}

class JointRow {
  constructor(pane, handle) {
    Object.assign(this, { pane, handle, state: {} });
    const { page } = pane;
    this.name = el('button', { type: 'button', class: 'link joint-name', onclick: () => page.select(handle, false) });
    this.slider = el('input', { type: 'range', step: 'any', disabled: !page.canWrite, oninput: () => this._slid(), onpointerdown: () => this._hold(true), onpointerup: () => this._hold(false), onpointercancel: () => this._hold(false), onkeydown: (event) => this._key(event) });
    this.now = el('output', { class: 'value joint-now' });
    this.element = el('div', { class: 'joint', 'data-joint': handle }, this.name, this.now, this.slider);
    this.update();
  }

  get object() {
    return this.pane.page.store.objects.get(this.handle);
  }

  get _unit() {
    return this.object.jointType === 'prismatic' ? 'm' : 'rad';
  }

  /** What the slider is for: a property; nothing while it is not known yet what drives the joint. */
  get _driven() {
    const { jointMode, dynCtrlMode } = this.state;
    if (jointMode === undefined) return null;
    const runs = this.pane.page.store.scene.state !== 'stopped';
    if (jointMode !== DYNAMIC) return 'jointPosition';
    if (dynCtrlMode === POSITION || dynCtrlMode === SPRING) return 'targetPos';
    if (dynCtrlMode === VELOCITY) return 'targetVel';
    return runs ? null : 'jointPosition';
  }

  _ends(driven) {
    if (driven === 'targetVel') {
      const fastest = Math.max(FASTEST[this._unit], Math.abs(this.state.targetVel ?? 0));
      return [-fastest, fastest];
    }
    const { cyclic, interval = [-1, 1] } = this.object;
    if (cyclic) return [-Math.PI, Math.PI];
    return interval.map((x) => Math.min(Math.max(x, -100), 100));
  }

  update() {
    const { object } = this;
    if (!object) return;
    const driven = this._driven;
    const [low, high] = this._ends(driven);
    const value = driven === 'jointPosition' || !driven ? object.jointPosition : this.state[driven];
    this._limits(low, high);
    if (!this.held && document.activeElement !== this.slider) this.slider.value = String(value ?? 0);
    this.slider.disabled = !driven || !this.pane.page.canWrite;
    this._words(driven, value ?? 0);
  }

  _limits(low, high) {
    if (this.low === low && this.high === high) return;
    Object.assign(this, { low, high });
    Object.assign(this.slider, { min: low, max: high });
  }

  _words(driven, value) {
    const { alias, jointPosition } = this.object;
    const shown = (x, unit) => {
      const { unit: name, factor } = shownUnit(unit);
      return `${decimal(x * factor, name)} ${name}`;
    };
    const what = { jointPosition: 'Position', targetPos: 'Target position', targetVel: 'Target velocity' }[driven] ?? 'Position';
    setText(this.name, alias);
    setText(this.now, shown(jointPosition, this._unit));
    const words = `${what} of ${alias}`;
    if (this.slider.ariaLabel !== words) this.slider.ariaLabel = this.slider.title = words;
    const said = shown(value, driven === 'targetVel' ? `${this._unit}/s` : this._unit);
    if (this.said !== said) this.slider.setAttribute('aria-valuetext', (this.said = said));
  }

  /** What is dragged at once is one change. */
  _hold(held) {
    this.held = held;
    if (held) this.gesture = newGesture();
  }

  /** The arrow keys go by a hundredth of the way. */
  _key(event) {
    const by = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key];
    if (!by) return;
    event.preventDefault();
    event.stopPropagation();
    if (!event.repeat) this.gesture = newGesture();
    this.slider.value = String(Number(this.slider.value) + (by * (this.high - this.low) * (event.shiftKey ? 10 : event.altKey ? 0.1 : 1)) / 100);
    this._slid();
  }

  /** The last place of the slider; while the answer is awaited only that counts. */
  _slid() {
    this.wanted = Number(this.slider.value);
    if (!this.sending) this._send();
  }

  async _send() {
    this.sending = true;
    while (this.wanted !== null && this.wanted !== undefined) {
      const [value, driven] = [this.wanted, this._driven];
      this.wanted = null;
      await this._set(driven, value).catch(() => {});
    }
    this.sending = false;
  }

  /** While nothing runs a joint that is driven to a position goes there at once. */
  async _set(driven, value) {
    const { page } = this.pane;
    if (!driven) return;
    const { handle, gesture } = this;
    await page.ask('set', { handle, name: driven, value, gesture });
    if (driven === 'targetPos' && page.store.scene.state === 'stopped') await page.ask('set', { handle, name: 'jointPosition', value, gesture });
  }
}

export class JointsPane {
  constructor(page) {
    this.page = page;
    this.rows = [];
    this.element = el('details', { class: 'joints', open: true, hidden: true }, el('summary', {}, 'joints'));
    page.store.on('objects', (changed) => this.rows.forEach((row) => changed.has(row.handle) && row.update()));
    page.store.on('scene', () => this.state !== page.store.scene.state && this._update());
  }

  /** Shows the joints of an object. */
  show(handle) {
    const { page } = this;
    const joints = page.source.live && page.renderer ? jointsOf(page.store, page.renderer.view, handle) : [];
    this.rows = joints.map((joint) => new JointRow(this, joint.handle));
    this.element.hidden = !this.rows.length;
    this.element.replaceChildren(this.element.firstChild, ...this.rows.map(({ element }) => element));
    const items = this.rows.flatMap((row) => FOLLOWED.map((name) => ({ handle: row.handle, name })));
    page.samples.follow(this, items, (_, values) => this._take(values));
  }

  _take(values) {
    this.rows.forEach((row, i) => FOLLOWED.forEach((name, k) => (row.state[name] = values[i * FOLLOWED.length + k].at(-1))));
    this._update();
  }

  _update() {
    this.state = this.page.store.scene.state;
    this.rows.forEach((row) => row.update());
  }
}
