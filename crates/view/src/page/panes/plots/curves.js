// Curves on a canvas: of properties, graphs, and plots of scripts.
import { el, iconButton } from '../../dom.js';
import { csv, download, picture } from './exports.js';

const MARGIN = { left: 52, right: 10, top: 8, bottom: 22 };

/** Steps of 1, 2 or 5 times a power of ten. */
function step(range, pieces) {
  const raw = range / pieces;
  const power = 10 ** Math.floor(Math.log10(raw));
  return power * ([1, 2, 5, 10].find((factor) => factor * power >= raw) ?? 10);
}

export function ticks(low, high, pieces = 5) {
  if (!(high > low) || !Number.isFinite(high - low)) return [];
  const by = step(high - low, pieces);
  const marks = [];
  for (let x = Math.ceil(low / by) * by; x <= high + by * 1e-6 && marks.length < 50; x += by) marks.push(Math.abs(x) < by * 1e-6 ? 0 : x);
  return marks;
}

/** The extent of values, a little wider than they are. */
export function extent(lists, pad = 0.05) {
  let [low, high] = [Infinity, -Infinity];
  for (const list of lists) for (const x of list) if (Number.isFinite(x)) (low = Math.min(low, x)), (high = Math.max(high, x));
  if (!(low <= high)) return [0, 1];
  const room = (high - low) * pad || Math.abs(high) * 0.1 || 1;
  return [low - room, high + room];
}

/** @typedef {{name: string, x: ArrayLike<number>, y: ArrayLike<number>, color: string, style?: string, width?: number, dots?: number}} Curve */

/** Draws curves with axes; returns how values become pixels. @param {HTMLCanvasElement} canvas @param {Curve[]} curves */
export function drawCurves(canvas, curves, { xRange, yRange, xLabel = '', yLabel = '', cursor = null, square = false } = /** @type {any} */ ({})) {
  const ratio = devicePixelRatio || 1;
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  if (!width || !height) return null;
  [canvas.width, canvas.height] = [width * ratio, height * ratio];
  const paper = canvas.getContext('2d');
  paper.scale(ratio, ratio);
  const style = getComputedStyle(canvas);
  const x = scale(xRange ?? extent(curves.map((curve) => curve.x), 0), MARGIN.left, width - MARGIN.right);
  const y = scale(yRange ?? extent(curves.map((curve) => curve.y)), height - MARGIN.bottom, MARGIN.top);
  if (square) equalize(x, y);
  drawAxes(paper, style, x, y, [width, height], [xLabel, yLabel]);
  paper.save();
  paper.beginPath();
  paper.rect(MARGIN.left, MARGIN.top, width - MARGIN.left - MARGIN.right, height - MARGIN.top - MARGIN.bottom);
  paper.clip();
  for (const curve of curves) drawCurve(paper, curve, x, y);
  if (cursor !== null) drawCursor(paper, style, x.pixel(cursor), height);
  paper.restore();
  return { x, y };
}

function scale([low, high], from, to) {
  const made = { low, high, from, to, pixel: (v) => made.from + ((v - made.low) / (made.high - made.low)) * (made.to - made.from) };
  made.value = (p) => made.low + ((p - made.from) / (made.to - made.from)) * (made.high - made.low);
  return made;
}

/** The same length on both axes, as plots that are `square` want. */
function equalize(x, y) {
  const per = [x, y].map((axis) => (axis.high - axis.low) / Math.abs(axis.to - axis.from));
  const most = Math.max(...per);
  [x, y].forEach((axis, i) => {
    const more = ((axis.high - axis.low) * (most / per[i] - 1)) / 2;
    axis.low -= more;
    axis.high += more;
  });
}

function drawAxes(paper, style, x, y, [width, height], [xLabel, yLabel]) {
  paper.font = '11px system-ui, sans-serif';
  paper.fillStyle = style.color;
  paper.strokeStyle = style.getPropertyValue('--line');
  paper.lineWidth = 1;
  paper.textAlign = 'center';
  for (const v of ticks(x.low, x.high, Math.max(width / 90, 2))) {
    const at = Math.round(x.pixel(v)) + 0.5;
    stroke(paper, [at, MARGIN.top], [at, height - MARGIN.bottom]);
    paper.fillText(label(v), at, height - 7);
  }
  paper.textAlign = 'right';
  for (const v of ticks(y.low, y.high, Math.max(height / 40, 2))) {
    const at = Math.round(y.pixel(v)) + 0.5;
    stroke(paper, [MARGIN.left, at], [width - MARGIN.right, at]);
    paper.fillText(label(v), MARGIN.left - 5, at + 4);
  }
  paper.fillText(xLabel, width - MARGIN.right - 2, height - MARGIN.bottom - 5);
  paper.textAlign = 'left';
  paper.fillText(yLabel, MARGIN.left + 4, MARGIN.top + 11);
}

const label = (v) => (v !== 0 && (Math.abs(v) >= 1e5 || Math.abs(v) < 1e-3) ? v.toExponential(0) : String(+v.toPrecision(6)));

function stroke(paper, a, b) {
  paper.beginPath();
  paper.moveTo(...a);
  paper.lineTo(...b);
  paper.stroke();
}

function drawCurve(paper, { x: xs, y: ys, color, style = 'line', width = 1.5, dots = 2 }, x, y) {
  paper.strokeStyle = paper.fillStyle = color;
  paper.lineWidth = width;
  const count = Math.min(xs.length, ys.length);
  if (style !== 'scatter') {
    paper.beginPath();
    for (let i = 0; i < count; i++) appendPoint(paper, style, i, x.pixel(xs[i]), y.pixel(ys[i]), y.pixel(0));
    paper.stroke();
  }
  if (!style.includes('scatter')) return;
  for (let i = 0; i < count; i++) paper.fillRect(x.pixel(xs[i]) - dots / 2, y.pixel(ys[i]) - dots / 2, dots, dots);
}

let lastY = 0;
let lastX = 0;

/** The next point of a line, in the styles of simUI. */
function appendPoint(paper, style, i, px, py, zero) {
  if (style === 'impulse') paper.moveTo(px, zero);
  else if (i === 0) paper.moveTo(px, py);
  else if (style === 'step_left') paper.lineTo(px, lastY);
  else if (style === 'step_right') paper.lineTo(lastX, py);
  else if (style === 'step_center') paper.lineTo((lastX + px) / 2, lastY), paper.lineTo((lastX + px) / 2, py);
  paper.lineTo(px, py);
  [lastX, lastY] = [px, py];
}

function drawCursor(paper, style, at, height) {
  paper.strokeStyle = style.getPropertyValue('--accent');
  paper.lineWidth = 1;
  stroke(paper, [at, 0], [at, height - MARGIN.bottom]);
}

/** A small curve beside a row of the inspector. */
export class Sparkline {
  constructor() {
    this.canvas = el('canvas', { 'aria-hidden': 'true' });
    this.element = el('div', { class: 'sparkline', hidden: true }, this.canvas);
  }

  show(beside, entry) {
    this.entry = entry;
    this.beside = beside;
    this.update();
  }

  hide() {
    this.entry = null;
    this.element.hidden = true;
  }

  update() {
    const points = this.entry?.history ?? [];
    this.element.hidden = points.length < 2;
    if (points.length < 2) return;
    const box = this.beside.getBoundingClientRect();
    this.element.style.top = `${Math.min(box.bottom, innerHeight - 110)}px`;
    this.element.style.left = `${box.left}px`;
    const accent = getComputedStyle(this.element).getPropertyValue('--accent');
    drawCurves(this.canvas, [{ name: '', x: points.map((p) => p[0]), y: points.map((p) => p[1]), color: accent }]);
  }
}

const COLORS = ['#0969da', '#cf4a22', '#1a7f37', '#8250df', '#bf8700', '#0e7c86'];

/** The pane of curves: of graphs, and of properties over a run or a recording. */
export class CurvesPane {
  constructor(pane, page) {
    Object.assign(this, { page, pane });
    this.curves = [];
    this.canvas = el('canvas', { class: 'curves', role: 'img', 'aria-label': 'Curves' });
    this.legend = el('div', { class: 'legend' });
    this.hint = el('p', { class: 'hint', hidden: true }, 'Drop values here.');
    const tool = (text, title, action) => el('button', { type: 'button', class: 'text-button', title, onclick: action }, text);
    this.tools = el('div', { class: 'curve-tools' }, tool('CSV', 'Save the curves as a table', () => this._save('csv')), tool('SVG', 'Save the curves as a picture', () => this._save('svg')), tool('Clear', 'Remove all curves', () => this.clear()));
    pane.append(el('div', { class: 'pane-tools' }, this.legend, this.tools), this.canvas, this.hint);
    new ResizeObserver(() => this.draw()).observe(this.canvas);
    this.canvas.addEventListener('pointerdown', (event) => this._seek(event));
    page.store.on('scene', () => this.draw());
  }

  /** @param {{name: string, x: number[], y: number[]}} curve */
  add(curve) {
    this.remove(curve.name);
    const free = COLORS.find((color) => this.curves.every((each) => each.color !== color));
    const added = { ...curve, color: free ?? COLORS[this.curves.length % COLORS.length] };
    this.curves.push(added);
    this._legend();
    return added;
  }

  clear() {
    [...this.curves].forEach(({ name }) => this.remove(name));
  }

  /** Something is dragged that can be dropped here. */
  await(comes) {
    this.pane.classList.toggle('awaits', comes);
    this.hint.hidden = !comes || this.curves.length > 0;
    this.canvas.hidden = !this.hint.hidden;
    this.page.showPanel('curves', comes || this.curves.length > 0);
  }

  _save(form) {
    const name = (this.page.store.scene.name || 'curves').replace(/\.\w+$/, '');
    if (form === 'csv') download(`${name}.csv`, 'text/csv', csv(this.curves));
    else download(`${name}.svg`, 'image/svg+xml', picture(this.curves, { extent, ticks, label }));
  }

  remove(name) {
    const gone = this.curves.filter((curve) => curve.name === name);
    this.curves = this.curves.filter((curve) => curve.name !== name);
    if (gone.length) this._legend();
    gone.forEach((curve) => this.page.plots?.removed(curve));
  }

  _legend() {
    this.legend.replaceChildren(...this.curves.map(({ name, color, unit }) => {
      const mark = el('span', { class: 'legend-mark', 'aria-hidden': 'true' });
      mark.style.background = color;
      return el('span', { class: 'legend-entry' }, mark, unit ? `${name} (${unit})` : name, iconButton('close', `Remove ${name}`, () => this.remove(name)));
    }));
    this.page.showPanel('curves', this.curves.length > 0);
    this.draw();
  }

  draw() {
    if (!this.curves.length) return;
    this.scales = drawCurves(this.canvas, this.curves, { xLabel: 's', cursor: this.page.source.time ?? this.page.store.scene.time ?? null });
  }

  _seek(event) {
    if (this.scales && !this.page.source.live) this.page.source.seek(this.scales.x.value(event.offsetX));
  }
}
