// The elements of simUI with many parts: tables, trees, plots, images, properties.
import { el } from '../../dom.js';
import { drawCurves } from '../plots/curves.js';
import { scene3d } from './scene3d.js';

const MANY = 300; // rows that a table has at once
const ROWS = 40; // rows that come and go together
const ROW = 25; // pixels, until one is measured

/** Keys as Qt numbers them, for handlers that want them. */
const QT_KEYS = { Escape: 0x1000000, Tab: 0x1000001, Backspace: 0x1000003, Enter: 0x1000004, Insert: 0x1000006, Delete: 0x1000007, Home: 0x1000010, End: 0x1000011, ArrowLeft: 0x1000012, ArrowUp: 0x1000013, ArrowRight: 0x1000014, ArrowDown: 0x1000015, PageUp: 0x1000016, PageDown: 0x1000017 };

export const modifiers = (event) => ({ shift: event.shiftKey, control: event.ctrlKey, alt: event.altKey });
export const qtKey = (event) => QT_KEYS[event.key] ?? (event.key.length === 1 ? event.key.toUpperCase().codePointAt(0) : 0);

function sendKeys(element, form) {
  element.addEventListener('keydown', (event) => form.send({ type: 'key', key: qtKey(event), text: event.key.length === 1 ? event.key : '', modifiers: modifiers(event) }));
}

function table(item, form) {
  const cells = new Map(item.cells.map((cell) => [`${cell.row} ${cell.column}`, cell]));
  const columns = Array.from({ length: item.columnCount }, (_, i) => i);
  const titled = (i, text) => el('th', { scope: i < 0 ? 'row' : 'col' }, text ?? '');
  const head = item.showHorizontalHeader && el('thead', {}, el('tr', {}, item.showVerticalHeader && el('td', {}), ...columns.map((i) => titled(i, header(item.columnHeaders, i)))));
  const row = (i) => el('tr', { 'aria-rowindex': i + 1 }, item.showVerticalHeader && titled(-1, header(item.rowHeaders, i)), ...columns.map((column) => tableCell(item, form, cells.get(`${i} ${column}`), i, column)));
  const body = el('tbody');
  const element = el('div', { class: 'scrolls', tabindex: 0, role: 'group', 'aria-label': 'Table', 'data-widget': item.id }, el('table', { class: item.showGrid ? 'grid-lines' : '', 'aria-rowcount': item.rowCount }, head, body));
  fillRows(element, body, item.rowCount, row);
  if (item.handlers?.includes('on-key-press')) sendKeys(element, form);
  return element;
}

/** All rows of a body; of many only those about the place that is scrolled to. */
function fillRows(scroller, body, count, row) {
  if (count <= MANY) return body.append(...Array.from({ length: count }, (_, i) => row(i)));
  let shown = -1;
  const space = (rows, height) => {
    const element = el('tr', { 'aria-hidden': 'true' });
    element.style.height = `${rows * height}px`;
    return element;
  };
  const show = () => {
    const height = body.children[1]?.offsetHeight || ROW;
    const first = Math.max(Math.floor(scroller.scrollTop / height / ROWS) * ROWS - ROWS, 0);
    if (first === shown) return;
    shown = first;
    const last = Math.min(first + 4 * ROWS, count);
    body.replaceChildren(space(first, height), ...Array.from({ length: last - first }, (_, i) => row(first + i)), space(count - last, height));
  };
  scroller.addEventListener('scroll', show);
  show();
}

/** Headers come as a list or by index. */
const header = (headers, i) => (Array.isArray(headers) ? headers[i] : headers?.[i]) ?? String(i + 1);

function tableCell(item, form, cell, row, column) {
  const [r, c] = item.selection ?? [-1, -1];
  const chosen = item.selectionMode === 'row' ? r === row : item.selectionMode === 'column' ? c === column : r === row && c === column;
  const element = el('td', { 'aria-selected': String(chosen), class: chosen ? 'chosen' : '' }, cell?.image && picture(cell.image), cell?.text ?? '');
  element.addEventListener('click', () => form.send({ type: 'select', row: item.selectionMode === 'column' ? -1 : row, column: item.selectionMode === 'row' ? -1 : column }));
  const editable = item.editable && cell?.editable !== false;
  element.addEventListener('dblclick', () => (editable ? editCell(element, cell, (text) => form.send({ type: 'cell', row, column, text })) : form.send({ type: 'cell', row, column })));
  return element;
}

function editCell(element, cell, done) {
  const field = el('input', { type: 'text', value: cell?.text ?? '', 'aria-label': 'Cell' });
  field.addEventListener('change', () => done(field.value));
  field.addEventListener('blur', () => element.replaceChildren(cell?.text ?? ''));
  element.replaceChildren(field);
  field.focus();
}

function tree(item, form) {
  const children = new Map();
  for (const each of item.items) {
    if (!children.has(each.parent)) children.set(each.parent, []);
    children.get(each.parent).push(each);
  }
  const below = (parent) => children.get(parent) ?? [];
  const row = (each) => {
    const inside = below(each.id);
    const chosen = each.id === item.selected;
    const name = el('button', { type: 'button', class: 'tree-name', 'data-widget': `${item.id}-${each.id}`, onclick: () => form.send({ type: 'select', item: each.id }) }, each.texts.join('  '));
    const members = { role: 'treeitem', 'aria-selected': String(chosen), class: chosen ? 'chosen' : '', ...(inside.length ? { 'aria-expanded': String(!!each.expanded) } : {}) };
    const fold = inside.length > 0 && el('button', { type: 'button', class: 'fold', 'aria-label': each.expanded ? 'Fold' : 'Unfold', onclick: () => form.send({ type: 'expand', item: each.id, expanded: !each.expanded }) }, each.expanded ? '−' : '+');
    return el('li', members, fold, name, inside.length > 0 && each.expanded && el('ul', { role: 'group' }, ...inside.map(row)));
  };
  const head = item.showHeader && item.columnHeaders?.length ? el('div', { class: 'tree-head' }, item.columnHeaders.join('  ')) : null;
  return el('div', { class: 'scrolls' }, head, el('ul', { role: 'tree', 'aria-label': 'Tree' }, ...below(0).map(row)));
}

/** A canvas with pixels: base64 of red, green, blue, opacity, the top row first. */
function picture({ width, height, pixels }) {
  const canvas = el('canvas', { width: Math.max(width, 1), height: Math.max(height, 1) });
  const bytes = Uint8ClampedArray.from(atob(pixels ?? ''), (c) => c.charCodeAt(0));
  if (width > 0 && height > 0 && bytes.length === 4 * width * height) canvas.getContext('2d').putImageData(new ImageData(bytes, width, height), 0, 0);
  return canvas;
}

function image(item, form) {
  const canvas = picture(item);
  canvas.setAttribute('role', 'img');
  canvas.setAttribute('aria-label', 'Image');
  if (item.scaledContents) canvas.classList.add(item.keepAspectRatio ? 'keeps-ratio' : 'scaled');
  sendMouse(canvas, item, form);
  return canvas;
}

function svgImage(item, form) {
  const element = el('img', { alt: 'Drawing', src: URL.createObjectURL(new Blob([item.text ?? ''], { type: 'image/svg+xml' })) });
  element.addEventListener('load', () => URL.revokeObjectURL(element.src));
  sendMouse(element, item, form);
  return element;
}

function sendMouse(element, item, form) {
  for (const event of ['down', 'up', 'move']) {
    if (!item.handlers?.includes(`on-mouse-${event}`)) continue;
    element.addEventListener(`pointer${event}`, (at) => (event !== 'move' || at.buttons & 1) && form.send({ type: 'mouse', event, x: Math.round(at.offsetX), y: Math.round(at.offsetY), modifiers: modifiers(at) }));
  }
}

/** Styles of curves as `simUI.curve_style` numbers them. */
const STYLES = ['scatter', 'line', 'line_and_scatter', 'step_left', 'step_center', 'step_right', 'impulse'];
const styleOf = (style) => (typeof style === 'number' ? STYLES[style - 22400] : style) ?? 'line';

const css = ([r, g, b]) => `rgb(${r} ${g} ${b})`;

function plot(item, form) {
  const canvas = el('canvas', { role: 'img', 'aria-label': `Plot of ${item.curves.map((curve) => curve.name).join(', ') || 'nothing yet'}` });
  const curves = item.curves.map(({ name, x, y, color, style, lineSize, scatterSize }) => ({ name, x, y, color: css(color), style: styleOf(style), width: lineSize, dots: scatterSize / 2 }));
  const options = { xRange: item.xRange ?? undefined, yRange: item.yRange ?? undefined, xLabel: item.xLabel, yLabel: item.yLabel, square: item.square };
  let scales = null;
  new ResizeObserver(() => (scales = drawCurves(canvas, curves, options))).observe(canvas);
  canvas.addEventListener('click', (event) => scales && sendPoint(item, form, scales, event));
  const legend = item.legendVisible && el('div', { class: 'legend' }, ...item.curves.filter((curve) => curve.inLegend).map((curve) => {
    const mark = el('span', { class: 'legend-mark' });
    mark.style.background = css(curve.color);
    return el('button', { type: 'button', class: 'legend-entry', onclick: () => form.send({ type: 'legend', curve: curve.name }) }, mark, curve.name);
  }));
  return el('div', { class: item.square ? 'plot square' : 'plot' }, canvas, legend);
}

/** The nearest point of a selectable curve, within a few pixels. */
function sendPoint(item, form, { x, y }, event) {
  let best = null;
  for (const curve of item.curves.filter((each) => each.selectable)) {
    for (let i = 0; i < curve.x.length; i++) {
      const away = Math.hypot(x.pixel(curve.x[i]) - event.offsetX, y.pixel(curve.y[i]) - event.offsetY);
      if (away < (best?.away ?? 10)) best = { away, curve: curve.name, index: i, x: curve.x[i], y: curve.y[i] };
    }
  }
  if (best) form.send({ type: 'point', curve: best.curve, index: best.index, x: best.x, y: best.y });
}

function properties(item, form) {
  const row = (each, i) => {
    const element = el('tr', { class: i === item.selected ? 'chosen' : each.flags === -1 ? 'section' : '' }, el('td', { title: each.description }, each.displayedName || each.name), el('td', {}, each.displayedValue || each.value));
    element.addEventListener('click', () => form.send({ type: 'select', row: i }));
    element.addEventListener('dblclick', (event) => form.send({ type: 'doubleClick', row: i, column: event.target.cellIndex ?? 0 }));
    return element;
  };
  return el('div', { class: 'scrolls', tabindex: 0, role: 'group', 'aria-label': 'Properties' }, el('table', { class: 'grid-lines' }, el('tbody', {}, ...item.rows.map(row))));
}

export const collections = { table, tree, plot, image, svg: svgImage, properties, scene3d };
