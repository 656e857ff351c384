// Pointer, wheel and touch on the scene: orbit, pan, zoom, select.

const CLICK = 5; // pixels that a click may move
const HOVER = 400; // milliseconds

export class Controls {
  /**
   * @param {import('./renderer.js').Renderer} renderer
   * @param {{select: function(any, boolean): void, focus: function(any): void, hover: function(any, number, number): void, moved: function(): void, pull: any}} actions
   */
  constructor(renderer, actions) {
    Object.assign(this, { renderer, actions });
    this.pointers = new Map();
    const { canvas } = renderer;
    const listen = (type, handler) => canvas.addEventListener(type, handler);
    listen('pointerdown', (event) => this._down(event));
    listen('pointermove', (event) => this._move(event));
    listen('pointerup', (event) => this._up(event));
    listen('pointercancel', (event) => (this.actions.pull?.end(), this.pointers.delete(event.pointerId)));
    listen('pointerleave', () => this._noHover());
    listen('dblclick', (event) => actions.focus(renderer.pick(event.offsetX, event.offsetY)));
    listen('contextmenu', (event) => event.preventDefault());
    canvas.addEventListener('wheel', (event) => this._wheel(event), { passive: false });
  }

  _down(event) {
    const { canvas } = this.renderer;
    canvas.focus({ preventScroll: true });
    canvas.setPointerCapture(event.pointerId);
    this._noHover();
    if (this.actions.pull?.takes(event)) return;
    this.pointers.set(event.pointerId, [event.offsetX, event.offsetY]);
    this.travelled = this.pointers.size > 1 ? CLICK : 0;
    const pivot = this.renderer.pointAt(event.offsetX, event.offsetY);
    const { camera } = this.renderer;
    const depth = pivot.reduce((sum, x, i) => sum + (x - camera.eye[i]) * camera.axes().forward[i], 0);
    this.grabbed = { pivot, depth, pans: event.button === 1 || event.button === 2 || event.shiftKey };
  }

  _move(event) {
    if (this.actions.pull?.held) return this.actions.pull.move(event);
    const before = this.pointers.get(event.pointerId);
    if (!before) return this._hoverLater(event);
    const [dx, dy] = [event.offsetX - before[0], event.offsetY - before[1]];
    this.travelled += Math.abs(dx) + Math.abs(dy);
    if (this.travelled < CLICK) return;
    if (this.pointers.size === 2) this._pinch(event, dx, dy);
    else if (this.grabbed.pans) this._pan(dx, dy);
    else this.renderer.camera.orbit(this.grabbed.pivot, -dx * 0.006, -dy * 0.006);
    this.pointers.set(event.pointerId, [event.offsetX, event.offsetY]);
    this._moved();
  }

  _pan(dx, dy) {
    this.renderer.camera.pan(dx, dy, this.renderer.canvas.clientHeight, this.grabbed.depth);
  }

  /** Two fingers: the middle pans, the distance zooms. */
  _pinch(event, dx, dy) {
    const other = [...this.pointers].find(([id]) => id !== event.pointerId)[1];
    const before = this.pointers.get(event.pointerId);
    const apart = (p) => Math.max(Math.hypot(p[0] - other[0], p[1] - other[1]), 10);
    this._pan(dx / 2, dy / 2);
    this.renderer.camera.zoom(this.grabbed.pivot, apart(before) / apart([event.offsetX, event.offsetY]));
  }

  _up(event) {
    this.actions.pull?.end();
    if (!this.pointers.delete(event.pointerId)) return;
    if (this.travelled >= CLICK || event.button !== 0) return;
    this.actions.select(this.renderer.pick(event.offsetX, event.offsetY), event.ctrlKey || event.metaKey || event.shiftKey);
  }

  _wheel(event) {
    event.preventDefault();
    const pixels = event.deltaY * (event.deltaMode === 1 ? 30 : 1);
    const now = performance.now();
    const near = this.zoomed && now - this.zoomed.time < 400 && this.zoomed.x === event.offsetX && this.zoomed.y === event.offsetY;
    const point = near ? this.zoomed.point : this.renderer.pointAt(event.offsetX, event.offsetY);
    this.zoomed = { time: now, x: event.offsetX, y: event.offsetY, point };
    this.renderer.camera.zoom(point, Math.exp(Math.max(Math.min(pixels, 200), -200) * 0.0018));
    this._moved();
  }

  _moved() {
    this.renderer.stale = true;
    this._noHover();
    this.actions.moved();
  }

  _hoverLater(event) {
    if (event.pointerType === 'touch') return;
    this._noHover();
    const [x, y] = [event.offsetX, event.offsetY];
    this.timer = setTimeout(() => this.actions.hover(this.renderer.pick(x, y), x, y), HOVER);
  }

  _noHover() {
    clearTimeout(this.timer);
    this.actions.hover(null, 0, 0);
  }
}
