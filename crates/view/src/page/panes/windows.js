// Windows of scripts (simUI) above the scene; what is in them makes widgets/container.js.
import { el } from '../dom.js';
import { Floating, titleText } from './floating.js';
import { redraw } from './widgets/canvas.js';
import { container } from './widgets/container.js';

const MARGIN = 12;
const NARROW = 640; // pixels; there windows are folded at first, so that the scene is seen

/** One window, kept up to date. */
class Frame extends Floating {
  constructor(pane, window) {
    const members = { role: 'dialog' };
    super(pane.layer, pane.page.shelf, { id: window.id, kind: 'window', members, close: window.closeable ? () => this._send({ type: 'close' }) : undefined });
    Object.assign(this, { pane, id: window.id });
    this.body = el('div', { class: 'window-body' });
    this.element.append(this.body);
    this.element.addEventListener('keydown', (event) => this._key(event));
    this.update(window);
    this.setFolded(innerWidth < NARROW || !!window.folded || this.keptFolded);
  }

  update(window) {
    const before = this.window;
    this.window = window;
    this.setTitle(window.title || 'Window');
    this.showAway();
    this.element.classList.toggle('resizable', !!window.resizable);
    if (before && window.revision !== undefined && before.revision === window.revision) return;
    if (before && !!before.folded !== !!window.folded) this.setFolded(!!window.folded);
    if (redraw(this.body, window)) return;
    const form = { id: this.id, enabled: window.enabled !== false, send: (input) => this._send(input) };
    this._replaceBody(window.content ? withoutTitle(container(window.content, form), this.name) : null);
  }

  showAway() {
    this.element.hidden = !!this.away || !this.window.visible;
  }

  /** Fields that are being edited keep focus and text. */
  _replaceBody(content) {
    const held = document.activeElement?.closest?.('.window-body') === this.body ? document.activeElement : null;
    if (held && this._patch(content)) return;
    const [key, start, end, scroll] = [held?.dataset.widget, held?.selectionStart, held?.selectionEnd, this.body.scrollTop];
    const scrolled = [...this.body.querySelectorAll('.scrolls[data-leaf]')].map((each) => [each.dataset.leaf, each.scrollTop]);
    this.body.replaceChildren(...(content ? [content] : []));
    this.body.scrollTop = scroll;
    for (const [leaf, at] of scrolled) {
      const again = this.body.querySelector(`.scrolls[data-leaf="${leaf}"]`);
      if (again) again.scrollTop = at;
    }
    const again = key && this.body.querySelector(`[data-widget="${key}"]`);
    if (!again) return;
    again.focus({ preventScroll: true });
    if (start !== null && start !== undefined && again.setSelectionRange && again.type === 'text') again.setSelectionRange(start, end);
  }

  /** While a slider is dragged its element must stay: then only the other widgets are exchanged. */
  _patch(content) {
    const held = document.activeElement;
    if (held.type !== 'range' || !this.pane.pressed || !content) return false;
    for (const fresh of content.querySelectorAll('[data-leaf]')) {
      const old = this.body.querySelector(`[data-leaf="${fresh.dataset.leaf}"]`);
      if (old && !old.contains(held)) old.replaceWith(fresh);
    }
    return true;
  }

  _send(input) {
    this.pane.send(this.id, input);
  }

  _key(event) {
    event.stopPropagation();
    if (event.key === 'Escape' && this.window.closeable) this._send({ type: 'close', escape: true });
  }

  /** Where it stands: as it was left, else as the script says, else below the one before. */
  place(index) {
    const { clientWidth, clientHeight } = this.layer;
    const [width, height] = [this.element.offsetWidth, this.element.offsetHeight];
    const { placement, position = [50, 50] } = this.window;
    const free = [clientWidth - width, clientHeight - height];
    const asked = position.map((x, i) => (placement === 'relative' && x < 0 ? free[i] + x : x));
    const usual = [free[0] - MARGIN, 56 + MARGIN * index * 3];
    if (this.kept.length === 2) this.moveTo(...this.kept);
    else this.placeAt(...(placement === 'center' || !placement ? usual : asked));
  }
}

/** Content that begins with its title once more goes without it: the frame has it. */
function withoutTitle(content, title) {
  const first = content.querySelector('.widget');
  const repeats = first?.classList.contains('ui-label') && titleText(first.textContent.trim()) === title;
  if (repeats && content.classList.contains('none')) first.style.visibility = 'hidden'; // the others have their places
  else if (repeats) first.hidden = true;
  return content;
}

export class WindowsPane {
  /** @param {HTMLElement} layer above the scene */
  constructor(layer, page) {
    Object.assign(this, { layer, page });
    /** @type {Map<string, Frame>} */
    this.frames = new Map();
    this.pressed = false;
    addEventListener('pointerdown', () => (this.pressed = true), true);
    addEventListener('pointerup', () => (this.pressed = false), true);
    page.store.on('windows', () => this._update());
    new ResizeObserver(() => this.frames.forEach((frame) => frame.moveTo(frame.x ?? 0, frame.y ?? 0))).observe(layer);
  }

  _update() {
    const { windows } = this.page.store;
    for (const [id, frame] of this.frames) {
      if (windows.has(id)) continue;
      frame.remove();
      this.frames.delete(id);
    }
    for (const window of windows.values()) {
      const frame = this.frames.get(window.id);
      if (frame) frame.update(window);
      else this._open(window);
    }
  }

  _open(window) {
    const frame = new Frame(this, window);
    this.frames.set(window.id, frame);
    this.layer.append(frame.element);
    frame.place(this.frames.size - 1);
  }

  send(window, input) {
    this.page.ask('ui', { window, widget: input.widget ?? null, input: { window, ...input } });
  }
}
