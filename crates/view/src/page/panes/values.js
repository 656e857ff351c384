// Values of properties as text and as fields to edit.
import { el } from '../dom.js';
import { CHOICES } from './inspect/essentials.js';
import { decimal, NumberField, NumberList, short } from './inspect/number.js';
import { shownUnit } from './inspect/units.js';

const NUMBERS = new Set(['int', 'long', 'float', 'handle']);

/** What the numbers of a list are. */
const NAMES = { interval: ['from', 'to'], clippingPlanes: ['near', 'far'], resolution: ['width', 'height'], maxVelAccelJerk: ['velocity', 'acceleration', 'jerk'], springDamperParams: ['stiffness', 'damping'], dependencyParams: ['offset', 'factor'] };

const INTEGERS = new Set(['int', 'long', 'handle', 'intarray', 'intarray2']);

/** Numbers with a fixed width behind the point, except integers. */
function number(x, type) {
  if (INTEGERS.has(type) || (type === 'table' && Number.isInteger(x))) return String(x);
  return decimal(x);
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

/** @param {{value: any, type: string, name: string, unit?: string}} row */
export function formatted(row) {
  const { value, type, name } = row;
  const word = typeof value === 'number' && CHOICES[name]?.find(([number]) => number === value)?.[1];
  if (word) return word;
  const { factor } = shownUnit(row.unit);
  const scaled = (x) => (typeof x === 'number' ? x * factor : x);
  return text(factor === 1 ? value : Array.isArray(value) ? value.map(scaled) : scaled(value), type);
}

const hex = (rgb) => '#' + rgb.slice(0, 3).map((x) => Math.round(Math.min(Math.max(x, 0), 1) * 255).toString(16).padStart(2, '0')).join('');
const rgb = (value) => [1, 3, 5].map((i) => parseInt(value.slice(i, i + 2), 16) / 255);

/**
 * A field for a value; null for what has none.
 * @param {{value: any, type: string}} row @param {string} label @param {function(any): void} change
 * @returns {{element: HTMLElement, show: function(any): void, reset?: function(): void, unit?: string, draggedBy?: function(HTMLElement): void} | null}
 */
export function editorOf(row, label, change) {
  const { type, value } = row;
  if (type === 'bool') return checkbox(label, value, change);
  if (type === 'color') return color(label, value, change);
  if (CHOICES[row.name] && typeof value === 'number') return choice(row, label, change);
  const isList = Array.isArray(value) && value.every((x) => typeof x === 'number');
  const integer = INTEGERS.has(type);
  if (NUMBERS.has(type) && typeof value === 'number') return new NumberField({ label, value, unit: row.unit, integer, change });
  if (isList && value.length > 1 && value.length <= 4) return new NumberList({ label, names: NAMES[row.name], value, unit: row.unit, integer, change });
  if (typeof value === 'string' || isList) return field(row, label, change, isList);
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

function choice({ name, value }, label, change) {
  const options = (now) => (CHOICES[name].some(([number]) => number === now) ? CHOICES[name] : [...CHOICES[name], [now, String(now)]]);
  const element = el('select', { class: 'value', 'aria-label': label, onchange: () => change(Number(element.value)) });
  const show = (now) => {
    element.replaceChildren(...options(now).map(([number, word]) => el('option', { value: number }, word)));
    element.value = String(now);
  };
  show(value);
  return { element, show };
}

function field(row, label, change, isList) {
  const { type } = row;
  const figures = (x) => (INTEGERS.has(type) ? String(x) : short(x, ''));
  const shown = (value) => (isList ? value.map(figures).join(', ') : text(value, type));
  const element = el('input', { type: 'text', class: isList ? 'value number' : 'value', value: shown(row.value), 'aria-label': label, spellcheck: 'false' });
  // What was not touched stays as it is, with all of its figures.
  const numbers = () => element.value.split(/[\s,]+/).filter(Boolean).map((word, i) => (i in row.value && word === figures(row.value[i]) ? row.value[i] : Number(word)));
  const parse = () => (isList ? numbers() : element.value);
  element.addEventListener('change', () => {
    const value = parse();
    const wrong = isList && (value.length !== row.value.length || value.some(Number.isNaN));
    if (wrong) element.value = shown(row.value);
    else change(value);
  });
  element.addEventListener('keydown', (event) => event.key === 'Escape' && ((element.value = shown(row.value)), element.blur()));
  const show = (now) => {
    if (document.activeElement !== element) element.value = shown(now);
  };
  return { element, show };
}
