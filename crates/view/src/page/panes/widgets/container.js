// The elements of simUI as HTML forms, by the JSON of crates/ui: a function per kind, and containers with their layouts.
import { el } from '../../dom.js';
import { canvas } from './canvas.js';
import { collections } from './collections.js';
import { richText } from './rich_text.js';

/** @typedef {{id: string, enabled: boolean, send: function(any): void}} Form the window that widgets belong to; functions of a kind get `send` of their widget, and the form as `whole` */

const USUAL_SPACING = 6;

/** @param {any} content a container as in crates/ui @param {Form} form */
export function container(content, form) {
  const { layout = 'vbox', margins = [7, 7, 7, 7], spacing = -1, items = [] } = content;
  const element = el('div', { class: `layout ${layout}` });
  element.style.padding = `${margins[1]}px ${margins[2]}px ${margins[3]}px ${margins[0]}px`;
  element.style.gap = `${spacing < 0 ? USUAL_SPACING : spacing}px`;
  const there = items.filter(Boolean);
  if (layout === 'none') reach(element, there, margins);
  if (layout === 'grid') fillGrid(element, there, form);
  else there.forEach((item) => element.append(placed(item, layout, form, margins)));
  return element;
}

function placed(item, layout, form, margins) {
  if (item.kind === 'stretch') return stretched(el('div', { 'aria-hidden': 'true' }), Math.max(item.factor ?? 0, 1));
  const element = widget(item, form);
  if (item.stretch > 0) stretched(element, item.stretch);
  if (layout === 'none' && item.geometry) ['left', 'top', 'width', 'height'].forEach((side, i) => (element.style[side] = `${item.geometry[i] + (i < 2 ? margins[i] : 0)}px`));
  return element;
}

/** As large as what is placed in it. */
function reach(element, items, [left, top, right, bottom]) {
  const far = (i) => Math.max(0, ...items.filter((item) => item.geometry).map(({ geometry }) => geometry[i] + geometry[i + 2]));
  element.style.minWidth = `${far(0) + left + right}px`;
  element.style.minHeight = `${far(1) + top + bottom}px`;
}

function stretched(element, factor) {
  element.style.flex = `${factor} 1 0`;
  return element;
}

/** Cells from left to right; `br` begins the next row. */
function fillGrid(element, items, form) {
  let [row, column] = [1, 1];
  for (const item of items) {
    if (item.kind === 'br') [row, column] = [row + 1, 1];
    else {
      const cell = widget(item, form);
      cell.style.gridRow = row;
      cell.style.gridColumn = column++;
      element.append(cell);
    }
  }
}

/** @returns {HTMLElement} */
function widget(item, form) {
  const made = (KINDS[item.kind] ?? unknown)(item, { id: form.id, whole: form, send: (input) => form.send({ widget: item.id, ...input }) });
  made.dataset.leaf = item.content || item.pages ? '' : item.id;
  if (!made.dataset.leaf) delete made.dataset.leaf;
  made.classList.add('widget', `ui-${item.kind}`);
  if (item.look) dress(made, item.look);
  if (item.visible === false) made.hidden = true;
  if (item.enabled === false || !form.enabled) disable(made);
  return made;
}

const css = (color) => `rgb(${color.map((x) => Math.round(x * 255)).join(' ')})`;

/** Colours that the scene itself chose. */
function dress(element, { background, color, bordered }) {
  element.style.background = background ? css(background) : 'none';
  element.style.color = background ? css(color) : '';
  element.classList.add('dressed');
  element.classList.toggle('bordered', bordered);
}

function disable(element) {
  for (const each of [element, ...element.querySelectorAll('button, input, select, textarea')]) if ('disabled' in each) each.disabled = true;
  element.classList.add('disabled');
}

/** A text of Qt: the letter behind an ampersand is a shortcut there, two ampersands are one. */
const plain = (text) => (text ?? '').replace(/&(.?)/g, '$1');

const unknown = (item) => el('div', { class: 'hint' }, `The page cannot show “${item.kind}”.`);
const key = (item) => ({ 'data-widget': item.id });

function button(item, form) {
  const pressed = item.checkable ? { 'aria-pressed': String(!!item.checked) } : {};
  const element = el('button', { type: 'button', ...key(item), ...pressed }, plain(item.text));
  if (item.holds) return holding(element, form);
  element.addEventListener('click', () => form.send({ type: 'click' }));
  if (item.repeat) repeat(element, item.repeat, () => form.send({ type: 'click' }));
  return element;
}

/** Down as long as the pointer or a key is; the element may be exchanged meanwhile. */
function holding(element, form) {
  let held = false;
  const send = (value) => form.send({ type: 'hold', value });
  const down = () => {
    held = true;
    send(true);
    const ended = new AbortController();
    const up = () => (ended.abort(), send(false));
    for (const end of ['pointerup', 'pointercancel', 'keyup', 'blur']) addEventListener(end, up, { signal: ended.signal });
  };
  element.addEventListener('pointerdown', (event) => event.button === 0 && down());
  element.addEventListener('keydown', (event) => (event.key === ' ' || event.key === 'Enter') && !event.repeat && down());
  element.addEventListener('click', () => (held ? (held = false) : form.send({ type: 'click' }))); // of what reads the screen
  return element;
}

/** Clicks again and again while the button is held. */
function repeat(element, [delay, interval], click) {
  let timer;
  const again = () => {
    click();
    timer = setTimeout(again, Math.max(interval, 20));
  };
  element.addEventListener('pointerdown', () => (timer = setTimeout(again, Math.max(delay, 20))));
  for (const end of ['pointerup', 'pointerleave', 'pointercancel']) element.addEventListener(end, () => clearTimeout(timer));
}

function checkbox(item, form) {
  const box = el('input', { type: 'checkbox', ...key(item), checked: item.value === 2, indeterminate: item.value === 1, onchange: () => form.send({ type: 'click' }) });
  return el('label', { class: 'choice' }, box, plain(item.text));
}

function radiobutton(item, form) {
  const dot = el('input', { type: 'radio', ...key(item), checked: item.value === 1, onclick: () => form.send({ type: 'click' }) });
  return el('label', { class: 'choice' }, dot, plain(item.text));
}

function combobox(item, form) {
  const options = item.items.map((text, i) => el('option', { value: i }, text));
  const list = el('select', { ...key(item), 'aria-label': 'Choice', onchange: () => form.send({ type: 'value', value: list.selectedIndex }) }, ...options);
  list.selectedIndex = item.value;
  return list;
}

function edit(item, form) {
  const field = el('input', { type: item.password ? 'password' : 'text', ...key(item), value: item.value, 'aria-label': 'Text', autocomplete: 'off' });
  if (item.look) field.addEventListener('change', () => form.send({ type: 'value', value: field.value }));
  else field.addEventListener('input', () => form.send({ type: 'value', value: field.value }));
  if (!item.look) field.addEventListener('change', () => form.send({ type: 'finish' }));
  return field;
}

function slider(item, form) {
  const field = el('input', { type: 'range', ...key(item), min: item.minimum, max: item.maximum, step: 1, 'aria-label': item.label || 'Value' });
  const turned = (x) => (item.inverted ? item.minimum + item.maximum - x : x);
  field.value = turned(item.value);
  field.addEventListener('input', () => form.send({ type: 'value', value: turned(Number(field.value)) }));
  if (item.vertical) field.classList.add('vertical');
  return field;
}

function spinbox(item, form) {
  const step = item.step || 'any';
  const field = el('input', { type: 'number', ...key(item), min: item.minimum, max: item.maximum, step, 'aria-label': 'Number' });
  field.value = item.decimals === null || item.decimals === undefined ? item.value : Number(item.value).toFixed(Math.min(item.decimals, 6)).replace(/(\.\d*?[1-9])0+$|\.0+$/, '$1');
  field.addEventListener('change', () => field.value !== '' && form.send({ type: 'value', value: Number(field.value) }));
  if (!item.prefix && !item.suffix) return field;
  return el('span', { class: 'spin' }, item.prefix, field, item.suffix);
}

function label(item, form) {
  if (item.plain) return el('div', {}, plain(item.text));
  const element = el('div', { class: item.wordWrap ? 'wraps' : '' });
  element.append(richText(item.text ?? '', (href) => form.send({ type: 'link', href })));
  return element;
}

function progressbar(item) {
  const part = (item.value - item.minimum) / (item.maximum - item.minimum || 1);
  const bar = el('progress', { max: 1, 'aria-label': 'Progress' });
  bar.value = Math.min(Math.max(part, 0), 1);
  return el('div', { class: 'progress' }, bar, item.textVisible && el('span', {}, `${Math.round(part * 100)} %`));
}

function browser(item, form) {
  if (!item.readOnly) {
    const area = el('textarea', { ...key(item), rows: 6, 'aria-label': 'Text' });
    area.value = item.text;
    area.addEventListener('input', () => form.send({ type: 'value', value: area.value }));
    return area;
  }
  const element = el('div', { class: `text ${item.wordWrap ? 'wraps' : ''}`, tabindex: 0, role: 'document' });
  element.append(richText(item.text ?? '', (href) => form.send({ type: 'link', href }), item.type));
  return element;
}

function group(item, form) {
  return el('fieldset', { class: item.flat ? 'flat' : '' }, container(item.content, form.whole));
}

function tabs(item, form) {
  const list = el('div', { role: 'tablist' });
  const element = el('div', {}, list);
  item.pages.forEach((page, i) => {
    const [tab, panel] = [`tab-${form.id}-${item.id}-${i}`, `page-${form.id}-${item.id}-${i}`];
    const chosen = i === item.current;
    const choose = (index) => form.send({ type: 'value', value: (index + item.pages.length) % item.pages.length });
    const by = { ArrowRight: 1, ArrowLeft: -1 };
    list.append(el('button', { type: 'button', role: 'tab', id: tab, 'data-widget': `${item.id}-${i}`, tabindex: chosen ? 0 : -1, 'aria-selected': String(chosen), 'aria-controls': panel, onclick: () => choose(i), onkeydown: (event) => by[event.key] && choose(i + by[event.key]) }, plain(page.title)));
    element.append(el('div', { role: 'tabpanel', id: panel, 'aria-labelledby': tab, hidden: !chosen }, container(page.content, form.whole)));
  });
  return element;
}

const KINDS = { button, checkbox, radiobutton, combobox, edit, hslider: slider, vslider: slider, spinbox, label, progressbar, 'text-browser': browser, group, tabs, canvas, ...collections };
