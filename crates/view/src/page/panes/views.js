// Floating views of scripts (sim.floatingViewAdd): what a camera or a vision sensor sees, or the curves of a graph, above the scene.
import { el } from '../dom.js';
import { drawCurves } from './plots/curves.js';
import { Floating } from './floating.js';
import { drawImage } from './sensor_images.js';

const COLORS = ['#3b82f6', '#e4572e', '#2a9d8f', '#b5179e', '#e9a800'];
const REFRESH = 500; // milliseconds between two looks at a graph

class View extends Floating {
  constructor(pane, view) {
    super(pane.layer, pane.page.shelf, { id: view.id, kind: 'view', members: { class: 'window view' } });
    this.pane = pane;
    this.canvas = el('canvas', { role: 'img', 'aria-labelledby': this.title.id });
    this.element.append(this.canvas);
    this.drawn = 0;
  }

  update(view) {
    const place = JSON.stringify([view.position, view.size]);
    this.view = view;
    this.showTitle();
    if (place === this.place) return;
    this.place = place;
    this.takePlace();
  }

  /** As large as the script says, and there, unless it was moved. */
  takePlace() {
    const { position: [x, y], size: [width, height] } = this.view;
    const { clientWidth, clientHeight } = this.layer;
    Object.assign(this.element.style, { width: `${width * 100}%`, height: `${height * 100}%` });
    if (this.kept.length === 2) this.moveTo(...this.kept);
    else this.placeAt((x - width / 2) * clientWidth, (1 - y - height / 2) * clientHeight);
    this.setFolded(this.keptFolded);
  }

  get object() {
    return this.pane.store.objects.get(this.view.object);
  }

  showTitle() {
    this.setTitle(this.view.label || this.object?.alias || 'View');
  }

  /** What it shows as it is now. */
  draw() {
    if (this.folded || this.away) return;
    const { object, canvas, pane } = this;
    const { store, page } = pane;
    if (object?.objectType === 'visionSensor') drawImage(canvas, store.images.get(object.handle));
    else if (object?.objectType === 'camera') page.renderer?.drawThrough(object, store.poses.get(object.handle), canvas);
    else if (object?.objectType === 'graph') this._curves(object.handle);
  }

  async _curves(handle) {
    if (performance.now() - this.drawn < REFRESH) return;
    this.drawn = performance.now();
    const { curves = [], xyCurves = [] } = await this.pane.page.source.request('graph', { handle }).catch(() => ({}));
    drawCurves(this.canvas, [...curves, ...xyCurves].map((curve, i) => ({ ...curve, color: COLORS[i % COLORS.length] })), {});
  }
}

export class ViewsPane {
  /** @param {HTMLElement} layer above the scene */
  constructor(layer, page) {
    Object.assign(this, { layer, page, store: page.store });
    /** @type {Map<number, View>} */
    this.views = new Map();
    this.store.on('views', () => this._update());
    this.store.on('objects', () => this._titles());
    for (const topic of ['image', 'scene', 'objects']) this.store.on(topic, () => this.draw());
    new ResizeObserver(() => this.views.forEach((view) => view.takePlace())).observe(layer);
  }

  _update() {
    const there = new Set(this.store.views.map(({ id }) => id));
    for (const [id, view] of this.views) if (!there.has(id)) view.remove(), this.views.delete(id);
    for (const view of this.store.views) {
      if (!this.views.has(view.id)) this._open(view);
      this.views.get(view.id).update(view);
    }
    this._titles();
    this.draw();
  }

  _open(view) {
    const made = new View(this, view);
    this.views.set(view.id, made);
    this.layer.prepend(made.element);
  }

  _titles() {
    if (!this.views.size && !this.watching) return;
    const sensors = [...this.views.values()].filter(({ object }) => object?.objectType === 'visionSensor');
    this.watching = sensors.length > 0;
    this.page.sensorImages.watch(this, sensors.map(({ view }) => view.object));
    this.views.forEach((view) => view.showTitle());
  }

  /** @param {boolean} [camerasOnly] after each picture of the scene */
  draw(camerasOnly = false) {
    for (const view of this.views.values()) if (!camerasOnly || view.object?.objectType === 'camera') view.draw();
  }
}
