// The gizmo: arrows, squares and rings on the selected object, to move and turn it with the pointer.
import { add, dot, rotationRows, scaled, sub } from '../maths.js';
import { el, setText, svg } from '../dom.js';
import { across, alongAxis, angleAbout, degrees, metres, onPlane, snapped } from './gizmo_maths.js';

const LENGTH = 90; // pixels of an arrow
const RING = 76; // pixels
const AXES = ['x', 'y', 'z'];
const STEP = 0.05; // metres
const TURN = Math.PI / 12;

export class Gizmo {
  /** @param {any} page @param {import('./edits.js').Edits} edits @param {{tool: string, frame: string, snap: boolean}} options */
  constructor(page, edits, options) {
    Object.assign(this, { page, edits, options, store: page.store, renderer: page.renderer });
    this.figure = svg('svg', { class: 'gizmo', 'aria-hidden': 'true' });
    this.label = el('output', { class: 'gizmo-label', hidden: true });
    this.handles = new Map();
    for (const [i, axis] of AXES.entries()) {
      this._handle(`move ${axis}`, axis, (event) => this._dragAxis(event, i));
      this._handle(`plane ${axis}`, axis, (event) => this._dragPlane(event, i));
      this._handle(`turn ${axis}`, axis, (event) => this._dragRing(event, i));
    }
  }

  _handle(name, axis, begin) {
    const [kind] = name.split(' ');
    const seen = svg('path', { class: `gizmo-${kind} gizmo-${axis}` });
    const grip = svg('path', { class: `gizmo-grip gizmo-grip-${kind}`, 'data-handle': name });
    grip.addEventListener('pointerdown', (event) => event.button === 0 && begin(event));
    this.handles.set(name, { seen, grip });
    this.figure.append(seen, grip);
  }

  /** The object that is moved, with its world pose; null without one. */
  get target() {
    const { selection, poses, objects } = this.store;
    const handle = selection.at(-1);
    if (this.options.tool === 'select' || !this.edits.possible || objects.get(handle)?.objectType === 'script') return null;
    const pose = poses.get(handle);
    return pose ? { handle, pose } : null;
  }

  /** Directions of the axes that drags go along. */
  axes({ handle, pose }) {
    const { frame } = this.options;
    const above = this.store.poses.get(this.store.objects.get(handle)?.parent);
    const turned = frame === 'own' ? pose : frame === 'parent' ? above : null;
    if (!turned) return [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
    const r = rotationRows(turned);
    return [0, 1, 2].map((i) => [r[i], r[3 + i], r[6 + i]]);
  }

  /** Metres that a pixel has at a point. */
  _pixel(point) {
    const { matrices, canvas, camera } = this.renderer;
    const { isPerspective, angle, half, forward } = matrices;
    const depth = Math.max(dot(sub(point, camera.eye), forward), 1e-3);
    return (2 * (isPerspective ? Math.tan(angle / 2) * depth : half)) / canvas.clientHeight;
  }

  /** Draws it anew, after each picture of the scene. */
  draw() {
    const target = this.target;
    this.figure.toggleAttribute('hidden', !target);
    if (!target || !this.renderer.matrices) return;
    const origin = this.held?.origin && this.held.fixed ? this.held.origin : Array.from(target.pose.slice(0, 3));
    const axes = this.held?.axes ?? this.axes(target);
    const size = this._pixel(origin);
    axes.forEach((axis, i) => {
      const [u, v] = axes.filter((_, k) => k !== i);
      this._path(`move ${AXES[i]}`, this.options.tool === 'move' && [origin, add(origin, scaled(axis, LENGTH * size))]);
      this._path(`plane ${AXES[i]}`, this.options.tool === 'move' && square(origin, u, v, size), true);
      this._path(`turn ${AXES[i]}`, this.options.tool === 'turn' && ring(origin, axis, RING * size));
    });
  }

  /** @param {number[][] | false} points of the world */
  _path(name, points, closed = false) {
    const { seen, grip } = this.handles.get(name);
    const places = points ? points.map((point) => this.renderer.screenPosition(point)) : [];
    const isSeen = places.length > 0 && places.every(Boolean);
    const path = isSeen ? `M${places.map(([x, y]) => `${x.toFixed(1)} ${y.toFixed(1)}`).join('L')}${closed ? 'Z' : ''}` : '';
    for (const each of [seen, grip]) each.setAttribute('d', path);
  }

  _ray(event) {
    const { canvas, camera, aspect } = this.renderer;
    const box = canvas.getBoundingClientRect();
    const [x, y] = [event.clientX - box.left, event.clientY - box.top];
    return camera.ray((2 * x) / canvas.clientWidth - 1, 1 - (2 * y) / canvas.clientHeight, aspect);
  }

  _dragAxis(event, i) {
    this._begin(event, i, (ray, { origin, axes }) => alongAxis(ray, origin, axes[i]), (start, now) => {
      const by = [0, 0, 0];
      by[i] = snapped(now - start, this._snap(STEP));
      return { change: { by }, text: `${AXES[i]} ${metres(by[i])}` };
    });
  }

  _dragPlane(event, i) {
    const others = [0, 1, 2].filter((k) => k !== i);
    this._begin(event, i, (ray, { origin, axes }) => onPlane(ray, origin, axes[i]), (start, now, { axes }) => {
      const by = [0, 0, 0];
      for (const k of others) by[k] = snapped(dot(sub(now, start), axes[k]), this._snap(STEP));
      return { change: { by }, text: others.map((k) => `${AXES[k]} ${metres(by[k])}`).join('  ') };
    });
  }

  _dragRing(event, i) {
    let turned = 0;
    let last = null;
    this._begin(event, i, (ray, { origin, axes }) => onPlane(ray, origin, axes[i]), (start, now, { origin, axes }) => {
      turned += angleAbout(axes[i], sub(last ?? start, origin), sub(now, origin));
      last = now;
      const angle = snapped(turned, this._snap(TURN));
      const turn = [0, 0, 0, angle];
      turn[i] = 1;
      return { change: { turn }, text: `${AXES[i]} ${degrees(angle)}` };
    }, true);
  }

  /** Steps, as the button says; Ctrl the other way round. */
  _snap(step) {
    return this.options.snap !== this.ctrl ? step : 0;
  }

  /** A drag: `read` says where the pointer is, `change` what that means. */
  _begin(event, i, read, change, fixed = false) {
    const { target } = this;
    if (!target) return;
    event.preventDefault();
    event.stopPropagation();
    const held = { origin: Array.from(target.pose.slice(0, 3)), axes: this.axes(target), fixed, gesture: this.edits.gesture(), handles: this.edits.chosen, active: target.handle };
    const start = read(this._ray(event), held);
    if (start === null) return;
    this.held = held;
    const grip = event.target;
    grip.setPointerCapture(event.pointerId);
    const move = (at) => this._moved(at, read(this._ray(at), held), start, change);
    const end = () => {
      grip.removeEventListener('pointermove', move);
      this.held = null;
      this.label.hidden = true;
      this.renderer.stale = true;
    };
    grip.addEventListener('pointermove', move);
    for (const type of ['pointerup', 'pointercancel']) grip.addEventListener(type, end, { once: true });
  }

  _moved(event, now, start, change) {
    const { held } = this;
    if (now === null || !held) return;
    this.ctrl = event.ctrlKey || event.metaKey;
    const { change: wanted, text } = change(start, now, held);
    setText(this.label, text);
    const box = this.renderer.canvas.getBoundingClientRect();
    Object.assign(this.label.style, { left: `${event.clientX - box.left + 16}px`, top: `${event.clientY - box.top - 28}px` });
    this.label.hidden = false;
    this.next = { ...wanted, handles: held.handles, active: held.active, frame: this.options.frame };
    this._send(held.gesture);
  }

  /** One request at a time; what the pointer did meanwhile is in the next one. */
  async _send(gesture) {
    if (this.sending || !this.next) return;
    const { next } = this;
    this.next = null;
    this.sending = true;
    await this.edits.ask('drag', next, gesture);
    this.sending = false;
    this._send(gesture);
  }
}

function square(origin, u, v, size) {
  const [near, far] = [20 * size, 38 * size];
  const at = (a, b) => add(origin, add(scaled(u, a), scaled(v, b)));
  return [at(near, near), at(far, near), at(far, far), at(near, far)];
}

function ring(origin, axis, radius) {
  const [u, v] = across(axis);
  return Array.from({ length: 49 }, (_, i) => {
    const angle = (i / 48) * 2 * Math.PI;
    return add(origin, add(scaled(u, radius * Math.cos(angle)), scaled(v, radius * Math.sin(angle))));
  });
}
