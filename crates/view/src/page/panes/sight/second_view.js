// A second view beside the first, with a camera of its own; both see the same scene.
import { el } from '../../dom.js';
import { remember, setting } from '../../settings.js';
import { Camera } from '../../render/camera.js';
import { Controls } from '../../render/controls.js';

export class SecondView {
  /** @param {any} page @param {any} actions of the controls, as those of the first view */
  constructor(page, actions) {
    Object.assign(this, { page, renderer: page.renderer, camera: new Camera(), shown: false, active: false });
    this.canvas = el('canvas', { class: 'second', tabindex: 0, role: 'application', 'aria-label': 'The scene from another side. Arrow keys turn it.', hidden: true });
    this.renderer.canvas.after(this.canvas);
    this.controls = new Controls(this, actions);
    this.canvas.addEventListener('focus', () => (this.active = true));
    this.renderer.canvas.addEventListener('focus', () => (this.active = false));
    this.renderer.before.push((seconds) => this._draw(seconds));
    if (setting('second view', false)) this.toggle();
  }

  toggle() {
    this.shown = !this.shown;
    this.canvas.hidden = !this.shown;
    this.page.layout.app.classList.toggle('with-second', this.shown);
    this.active = false;
    remember('second view', this.shown);
    if (this.shown && !this.placed) this._place();
    this.stale = true;
  }

  /** At first from the right, at the same things. */
  _place() {
    const { focus, distance } = this.renderer.camera;
    Object.assign(this.camera, { yaw: Math.PI / 2, pitch: -0.25 });
    this.camera.lookAt(focus, distance);
    this.placed = true;
  }

  set stale(is) {
    if (is) this.renderer.stale = true;
  }

  get stale() {
    return this.renderer.stale;
  }

  get aspect() {
    return this.canvas.clientWidth / Math.max(this.canvas.clientHeight, 1);
  }

  /** Does something of the renderer's with this camera and this size. */
  _as(action) {
    const { renderer, camera, canvas } = this;
    const kept = { camera: renderer.camera, canvas: renderer.canvas, matrices: renderer.matrices };
    Object.assign(renderer, { camera, canvas: { width: canvas.clientWidth, height: canvas.clientHeight, clientWidth: canvas.clientWidth, clientHeight: canvas.clientHeight } });
    try {
      return action(renderer);
    } finally {
      Object.assign(renderer, kept);
    }
  }

  pick(x, y) {
    return this._as((renderer) => renderer.pick(x, y));
  }

  pointAt(x, y) {
    return this._as((renderer) => renderer.pointAt(x, y));
  }

  fit(handles, atOnce) {
    this._as((renderer) => renderer.fit(handles, atOnce));
  }

  /** Moves the camera on, and says whether it moved. */
  advance(seconds) {
    return this.shown && this.camera.advance(seconds);
  }

  _draw() {
    if (this.shown) this.renderer.drawWith(this.camera, this.canvas);
  }
}
