// Pulling at bodies with the pointer while the simulation runs: a spring from the point that was grabbed to the pointer, with its force.
import { el, setText, svg } from '../dom.js';
import { dot, length, rotationRows, sub, transformed } from '../maths.js';
import { onPlane } from './gizmo_maths.js';

const REFRESH = 40; // milliseconds between two requests

export class Pull {
  /** @param {any} page @param {import('./edits.js').Edits} edits @param {{tool: string}} options */
  constructor(page, edits, options) {
    Object.assign(this, { page, edits, options, store: page.store, renderer: page.renderer });
    this.line = svg('line', { class: 'pull-line' });
    this.figure = svg('svg', { class: 'gizmo pull', 'aria-hidden': 'true', hidden: true }, this.line);
    this.label = el('output', { class: 'gizmo-label', hidden: true, 'aria-live': 'off' });
  }

  /** Whether a pointer that goes down there pulls. @param {PointerEvent} event */
  takes(event) {
    const { scene } = this.store;
    const asks = event.button === 0 && (event.ctrlKey || event.metaKey || this.options.tool !== 'select');
    if (!asks || !this.edits.possible || scene.state !== 'running') return false;
    const hit = this.renderer.pick(event.offsetX, event.offsetY);
    if (!hit || hit.handle < 0 || this.store.objects.get(hit.handle)?.objectType !== 'shape') return false;
    this._begin(hit, event);
    return true;
  }

  _begin({ handle, point }, event) {
    const pose = this.store.poses.get(handle);
    this.held = { handle, point: inFrame(pose, point), target: point, plane: point };
    this.move(event);
    this.timer = setInterval(() => this._ask(), REFRESH);
    this._ask();
  }

  /** The pointer goes on, in the plane of the picture through the point that was grabbed. */
  move(event) {
    if (!this.held) return;
    const { canvas, camera, aspect, matrices } = this.renderer;
    const ray = camera.ray((2 * event.offsetX) / canvas.clientWidth - 1, 1 - (2 * event.offsetY) / canvas.clientHeight, aspect);
    this.held.target = onPlane(ray, this.held.plane, matrices.forward) ?? this.held.target;
    this.draw();
  }

  async _ask() {
    const { held } = this;
    if (!held || this.asking) return;
    this.asking = true;
    const { handle, point, target } = held;
    const done = await this.page.source.request('pull', { handle, point, target }).catch((error) => this._fail(error));
    this.asking = false;
    if (done?.force && this.held === held) held.force = length(done.force);
    this.draw();
  }

  _fail(error) {
    if (this.held) this.page.overlay.say(error.message);
    this.end();
  }

  end() {
    const { held } = this;
    if (!held) return;
    this.held = null;
    clearInterval(this.timer);
    this.page.source.request('pull', { handle: held.handle, point: held.point, target: null }).catch(() => {});
    this.draw();
  }

  /** After each picture of the scene. */
  draw() {
    const { held } = this;
    this.figure.toggleAttribute('hidden', !held);
    this.label.hidden = !held?.force;
    const pose = held && this.store.poses.get(held.handle);
    if (!pose || !this.renderer.matrices) return;
    const [from, to] = [transformed(pose, held.point), held.target].map((point) => this.renderer.screenPosition(point));
    if (!from || !to) return;
    for (const [name, value] of Object.entries({ x1: from[0], y1: from[1], x2: to[0], y2: to[1] })) this.line.setAttribute(name, value.toFixed(1));
    setText(this.label, held.force ? `${held.force.toPrecision(3)} N` : '');
    Object.assign(this.label.style, { left: `${to[0] + 14}px`, top: `${to[1] - 26}px` });
  }
}

/** A point of the world in the frame of a pose. */
function inFrame(pose, point) {
  const r = rotationRows(pose);
  const by = sub(point, pose);
  return [0, 1, 2].map((i) => dot([r[i], r[3 + i], r[6 + i]], by));
}
