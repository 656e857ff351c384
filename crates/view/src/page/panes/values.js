// Values of properties as text and as fields to edit.
import { el } from '../dom.js';

const NUMBERS = new Set(['int', 'long', 'float', 'handle']);

const INTEGERS = new Set(['int', 'long', 'handle', 'intarray', 'intarray2']);

/** Numbers with a fixed width behind the point, except integers. */
function number(x, type) {
  if (INTEGERS.has(type) || (type === 'table' && Number.isInteger(x))) return String(x);
  const size = Math.abs(x);
  return size !== 0 && (size < 1e-4 || size >= 1e7) ? x.toExponential(4) : x.toFixed(4);
}

/** @param {any} value @param {string} type as of a property */
export function text(value, type) {
  if (value === null || value === undefined) return '–';
  if (typeof value === 'number') return number(value, type);
  if (typeof value === 'boolean') return value ? 'true' : 'false';
  if (typeof value === 'string') return value;
  if (Array.isArray(value)) return value.map((x) => (typeof x === 'number' && Math.abs(x) < 1e-4 && !Number.isInteger(x) ? (0).toFixed(4) : text(x, type))).join(', ');
  if (typeof value.bytes === 'number') return `${value.bytes} bytes`;
  return JSON.stringify(value);
}

/** @param {{value: any, type: string}} row */
export function formatted(row) {
  return text(row.value, row.type);
}

const hex = (rgb) => '#' + rgb.slice(0, 3).map((x) => Math.round(Math.min(Math.max(x, 0), 1) * 255).toString(16).padStart(2, '0')).join('');
const rgb = (value) => [1, 3, 5].map((i) => parseInt(value.slice(i, i + 2), 16) / 255);

/**
 * A field for a value; null for what has none.
 * @param {{value: any, type: string}} row @param {string} label @param {function(any): void} change
 * @returns {{element: HTMLElement, show: function(any): void} | null}
 */
export function editorOf(row, label, change) {
  const { type, value } = row;
  if (type === 'bool') return checkbox(label, value, change);
  if (type === 'color') return color(label, value, change);
  const isList = Array.isArray(value) && value.every((x) => typeof x === 'number');
  if (typeof value === 'string' || NUMBERS.has(type) || isList) return field(row, label, change, isList);
  return null;
}

function checkbox(label, value, change) {
  const element = el('input', { type: 'checkbox', class: 'value', checked: value, 'aria-label': label, onchange: () => change(element.checked) });
  return { element, show: (now) => (element.checked = now) };
}

function color(label, value, change) {
  const element = el('input', { type: 'color', class: 'value', value: hex(value), 'aria-label': label, onchange: () => change(rgb(element.value)) });
  return { element, show: (now) => (element.value = hex(now)) };
}

function field(row, label, change, isList) {
  const { type } = row;
  const isNumber = NUMBERS.has(type);
  const element = el('input', { type: 'text', class: isNumber || isList ? 'value number' : 'value', value: text(row.value, type), 'aria-label': label, spellcheck: 'false' });
  const parse = () => (isList ? element.value.split(/[\s,]+/).filter(Boolean).map(Number) : isNumber ? Number(element.value) : element.value);
  element.addEventListener('change', () => {
    const value = parse();
    const wrong = isList ? value.length !== row.value.length || value.some(Number.isNaN) : Number.isNaN(value);
    if (wrong) element.value = text(row.value, type);
    else change(value);
  });
  element.addEventListener('keydown', (event) => event.key === 'Escape' && ((element.value = text(row.value, type)), element.blur()));
  const show = (now) => {
    if (document.activeElement !== element) element.value = text(now, type);
  };
  return { element, show };
}
