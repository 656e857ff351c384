// Windows that a program draws: its pictures, and what pointer and keys do with them.
import { el } from '../../dom.js';
import { modifiers, qtKey } from './collections.js';

/** Keys for which collections.js has no number, and what text keys enter. */
const MORE_KEYS = { Shift: 0x1000020, Control: 0x1000021, Meta: 0x1000022, Alt: 0x1000023, CapsLock: 0x1000024, ContextMenu: 0x1000055 };
const BACKTAB = 0x1000002;
const F1 = 0x1000030;
const TEXTS = { Enter: '\r', Tab: '\t', Backspace: '\b', Escape: '\u001b', Delete: '\u007f' };
const LINE = 40; // pixels of a line that a wheel turns by
const PAUSE = 150; // milliseconds without change until a size counts

/** @returns {HTMLCanvasElement} */
export function canvas(item, form) {
  const members = { class: 'drawn', tabindex: 0, role: 'application', 'data-widget': item.id, title: 'Keys go to the interface; F6 leaves it', 'aria-label': 'Interface of a program' };
  const element = el('canvas', { width: Math.max(item.width, 1), height: Math.max(item.height, 1), ...members });
  draw(element, item);
  takePointer(element, form);
  takeKeys(element, form);
  requestAnimationFrame(() => followSize(element, form));
  return element;
}

/** Shows another picture in a window that a program draws, in place; false for others. @param {HTMLElement} body */
export function redraw(body, window) {
  const [item, ...more] = window.content?.items ?? [];
  const element = body.querySelector('canvas.drawn');
  if (!element || item?.kind !== 'canvas' || more.length) return false;
  draw(element, item);
  return true;
}

/** Pictures are decoded beside the page; an earlier one never follows a later one. */
async function draw(element, { picture, width, height }) {
  if (!picture || element.picture === picture) return;
  element.picture = picture;
  const image = await createImageBitmap(new Blob([bytesOf(picture)], { type: 'image/png' })).catch(() => null);
  if (!image || element.picture !== picture) return;
  if (element.width !== width || element.height !== height) [element.width, element.height] = [width, height];
  element.getContext('2d').drawImage(image, 0, 0);
  image.close();
}

/** Photographs have half a million bytes: browsers that cannot do it themselves get a loop. @param {string} base64 */
function bytesOf(base64) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(base64);
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < bytes.length; i++) bytes[i] = text.charCodeAt(i);
  return bytes;
}

function takePointer(element, form) {
  let waiting = null;
  const send = (event, at, more = {}) => {
    const scale = element.width / (element.clientWidth || 1);
    form.send({ type: 'pointer', event, x: at.offsetX * scale, y: at.offsetY * scale, button: Math.max(at.button, 0), buttons: at.buttons, modifiers: modifiers(at), ...more });
  };
  const flush = () => {
    if (waiting) send('move', waiting);
    waiting = null;
  };
  element.addEventListener('pointermove', (event) => {
    if (!waiting) requestAnimationFrame(flush);
    waiting = event;
  });
  element.addEventListener('pointerdown', (event) => {
    event.preventDefault();
    element.focus({ preventScroll: true });
    element.setPointerCapture(event.pointerId);
    flush();
    send('down', event);
  });
  for (const end of ['pointerup', 'pointercancel']) element.addEventListener(end, (event) => (flush(), send('up', event)));
  element.addEventListener('contextmenu', (event) => event.preventDefault());
  element.addEventListener('wheel', (event) => {
    event.preventDefault();
    const unit = event.deltaMode ? LINE : 1;
    send('wheel', event, { dx: event.deltaX * unit, dy: event.deltaY * unit });
  }, { passive: false });
}

function numberOf({ key, shiftKey }) {
  if (key === 'Tab' && shiftKey) return BACKTAB;
  const place = /^F(\d+)$/.exec(key);
  return place ? F1 + Number(place[1]) - 1 : (MORE_KEYS[key] ?? qtKey({ key }));
}

const textOf = ({ key, ctrlKey, metaKey }) => (ctrlKey || metaKey ? '' : (TEXTS[key] ?? (key.length === 1 ? key : '')));

/** All keys but those of the browser; F6 goes on to the title of the window. */
function takeKeys(element, form) {
  const send = (event, down) => form.send({ type: 'stroke', down, key: numberOf(event), text: textOf(event), modifiers: modifiers(event) });
  element.addEventListener('keydown', (event) => {
    event.stopPropagation();
    if (event.key === 'F6') element.closest('.window')?.querySelector('.window-grip')?.focus();
    if (event.metaKey || event.isComposing || /^F(5|6|11|12)$/.test(event.key)) return;
    event.preventDefault();
    send(event, true);
  });
  element.addEventListener('keyup', (event) => {
    event.stopPropagation();
    if (!/^F(5|6|11|12)$/.test(event.key)) send(event, false);
  });
}

/** A frame that a person has made larger or smaller has an interface of its size. */
function followSize(element, form) {
  const frame = element.closest('.window');
  if (!frame) return;
  let timer;
  const ask = () => {
    const header = frame.querySelector('header');
    const size = [frame.clientWidth, frame.clientHeight - header.offsetHeight];
    if (element.isConnected && !frame.classList.contains('folded') && (size[0] !== element.width || size[1] !== element.height)) form.send({ type: 'resize', size });
  };
  new ResizeObserver(() => {
    clearTimeout(timer);
    if (frame.style.width || frame.style.height) timer = setTimeout(ask, PAUSE);
  }).observe(frame);
}
