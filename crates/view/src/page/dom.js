// Elements from code. Text always becomes text nodes, so that nothing a scene contains can become HTML.

const SVG = 'http://www.w3.org/2000/svg';

/**
 * An element; members that begin with `on` are listeners, `class` and others attributes; false and null are left out.
 * @param {string} tag
 * @param {Object<string, any>} [members]
 * @param {...(Node|string|number|null|undefined|false)} children
 * @returns {any}
 */
export function el(tag, members = {}, ...children) {
  return filled(document.createElement(tag), members, children);
}

/** @returns {any} an element of SVG */
export function svg(tag, members = {}, ...children) {
  return filled(document.createElementNS(SVG, tag), members, children);
}

function filled(element, members, children) {
  for (const [name, value] of Object.entries(members)) {
    if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
    else if (name === 'value' || name === 'checked' || name === 'indeterminate') element[name] = value;
    else if (value === true) element.setAttribute(name, '');
    else if (value !== false && value !== null && value !== undefined) element.setAttribute(name, value);
  }
  element.append(...children.filter((child) => child !== null && child !== undefined && child !== false).map(node));
  return element;
}

const node = (child) => (typeof child === 'object' ? child : document.createTextNode(String(child)));

/** Outlines in a box of 16 by 16, drawn with the colour of the text. */
const ICONS = {
  play: 'M4 2.5v11l9-5.5z',
  pause: 'M4 3h3v10H4zM9 3h3v10H9z',
  stop: 'M3.5 3.5h9v9h-9z',
  step: 'M3 3v10l7-5zM11 3h2v10h-2z',
  jump: 'M3 3v10l5-5zM8 3v10l5-5z',
  tree: 'M2 3h5M5 8h5M5 13h5M3.5 3v10H5M3.5 8H5',
  console: 'M2 3h12v10H2zM4.5 6l2 2-2 2M8 10h3',
  fit: 'M2 6V2h4M10 2h4v4M14 10v4h-4M6 14H2v-4M6 6h4v4H6z',
  help: 'M5.5 6a2.5 2.5 0 1 1 3.5 2.3c-.7.3-1 .8-1 1.7M8 12.5v.5',
  theme: 'M8 2a6 6 0 1 0 0 12zM8 2a6 6 0 0 1 0 12',
  camera: 'M2 5h8v7H2zM10 7.5l4-2v6l-4-2',
  options: 'M2 4h7M12 4h2M2 8h2M7 8h7M2 12h6M11 12h3M9 2.7v2.6M4.5 6.7v2.6M8.5 10.7v2.6',
  script: 'M4 2h6l3 3v9H4zM6 7h5M6 9.5h5M6 12h3',
  stepOver: 'M2 9.5a5.5 5.5 0 0 1 10.5-2M13 3.5v4H9M8 12.5v.01',
  stepInto: 'M8 1.5v7M5 6l3 3 3-3M8 12.5v.01',
  stepOut: 'M8 9V2M5 4.5l3-3 3 3M8 12.5v.01',
  edit: 'M3 13l1-3.5L11 2.5l2.5 2.5L6.5 12zM9.5 4L12 6.5',
  close: 'M4 4l8 8M12 4l-8 8',
  fold: 'M4 6l4 4 4-4',
  grip: 'M6 4v.01M10 4v.01M6 8v.01M10 8v.01M6 12v.01M10 12v.01',
  copy: 'M5.5 5.5h7v8h-7zM3.5 10.5v-8h7',
  curve: 'M2 13V3M2 13h12M4 10c2-6 4-6 5-3s3 2 4-3',
  follow: 'M8 2v3M8 11v3M2 8h3M11 8h3M8 5a3 3 0 1 0 0 6 3 3 0 0 0 0-6',
  shape: 'M8 2l5.5 3v6L8 14l-5.5-3V5zM2.5 5L8 8l5.5-3M8 8v6',
  joint: 'M8 1.5v3M8 11.5v3M5 4.5h6v7H5zM5 8h6',
  dummy: 'M8 8v-5M8 8l4.5 3M8 8l-4.5 3',
  light: 'M8 5a3 3 0 1 0 0 6 3 3 0 0 0 0-6M8 1.5v1M8 13.5v1M1.5 8h1M13.5 8h1',
  forceSensor: 'M3 4h10M3 12h10M8 4v8M6 6.5L8 4.5l2 2M6 9.5l2 2 2-2',
  proximitySensor: 'M2 8l9-4.5v9zM13 5.5c1 1.5 1 3.5 0 5',
  visionSensor: 'M1.5 8C4 4 12 4 14.5 8 12 12 4 12 1.5 8zM8 6.5a1.5 1.5 0 1 0 0 3 1.5 1.5 0 0 0 0-3',
  points: 'M4 4v.01M8 3v.01M12 5v.01M5 8v.01M10 8v.01M4 12v.01M8 12v.01M12 11v.01',
  select: 'M4 2l8 6-3.5.8L10.5 13l-1.8.8-2-4.2L4 12z',
  move: 'M8 1.5v13M1.5 8h13M6 3.5l2-2 2 2M6 12.5l2 2 2-2M3.5 6l-2 2 2 2M12.5 6l2 2-2 2',
  turn: 'M13 8a5 5 0 1 1-1.8-3.8M13 2.5v3h-3',
  snap: 'M3 2v6a5 5 0 0 0 10 0V2h-3v6a2 2 0 0 1-4 0V2zM3 4.5h3M10 4.5h3',
  add: 'M8 3v10M3 8h10',
  undo: 'M3 6.5h6.5a3.5 3.5 0 0 1 0 7H6M6 3.5l-3 3 3 3',
  open: 'M1.5 13V3.5h4l1.5 2h6V7M1.5 13l2.5-6h11l-2.5 6z',
  save: 'M2.5 2.5h8.5l2.5 2.5v8.5h-11zM5 2.5v4h5v-4M5 13.5V9.5h6v4',
  windows: 'M2 3h9v7H2zM5 10v3h9V6h-3M2 5h9',
};
const FILLED = new Set(['play', 'pause', 'stop', 'step', 'jump']);

/** @param {string} name */
export function icon(name) {
  const how = FILLED.has(name) ? { fill: 'currentColor' } : { fill: 'none', stroke: 'currentColor', 'stroke-width': 1.5 };
  return svg('svg', { class: 'icon', viewBox: '0 0 16 16', 'aria-hidden': 'true' }, svg('path', { d: ICONS[name], 'stroke-linejoin': 'round', 'stroke-linecap': 'round', ...how }));
}

/** A button with an icon, its title the name that screen readers say. */
export function iconButton(name, title, onclick, members = {}) {
  return el('button', { type: 'button', class: 'icon-button', title, 'aria-label': title, onclick, ...members }, icon(name));
}

/** Shows another icon and title. */
export function setIcon(button, name, title) {
  if (button.title === title) return;
  button.title = title;
  button.setAttribute('aria-label', title);
  button.replaceChildren(icon(name));
}

/** Sets the text only if it differs, so that selections in it stay. */
export function setText(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

/** Copies text, also where the page is not trusted with the clipboard. @param {string} text */
export async function copyText(text) {
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    const area = el('textarea', { value: text, class: 'off-screen' });
    document.body.append(area);
    area.select();
    document.execCommand('copy');
    area.remove();
  }
}
