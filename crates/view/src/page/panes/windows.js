// Windows of scripts (simUI) above the scene: frames that can be dragged and remember their place; what is in them makes widgets/container.js.
import { el, iconButton, setText } from '../dom.js';
import { remember, setting } from '../settings.js';
import { container } from './widgets/container.js';

const MARGIN = 12;
const NARROW = 640; // pixels; there windows are folded at first, so that the scene is seen

/** One window, kept up to date. */
class Frame {
  constructor(pane, window) {
    Object.assign(this, { pane, id: window.id });
    this.title = el('h2', { id: `window-${window.id}` });
    this.fold = iconButton('fold', 'Fold', () => this._setFolded(!this.folded), { class: 'icon-button window-fold' });
    this.bar = el('header', {}, this.title, this.fold, window.closeable && iconButton('close', 'Close', () => this._send({ type: 'close' })));
    this.body = el('div', { class: 'window-body' });
    this.element = el('section', { class: 'window', role: 'dialog', 'aria-labelledby': this.title.id, 'data-window': window.id }, this.bar, this.body);
    this.element.addEventListener('pointerdown', () => pane.raise(this));
    this.element.addEventListener('keydown', (event) => this._key(event));
    this.bar.addEventListener('pointerdown', (event) => this._drag(event));
    this.update(window);
    this._setFolded(innerWidth < NARROW || !!window.folded);
  }

  _setFolded(folded) {
    this.folded = folded;
    this.element.classList.toggle('folded', folded);
    this.fold.setAttribute('aria-expanded', String(!folded));
  }

  update(window) {
    const before = this.window;
    this.window = window;
    setText(this.title, window.title || 'Window');
    this.element.hidden = !window.visible;
    this.element.classList.toggle('resizable', !!window.resizable);
    if (before && window.revision !== undefined && before.revision === window.revision) return;
    if (before && !!before.folded !== !!window.folded) this._setFolded(!!window.folded);
    const form = { id: this.id, enabled: window.enabled !== false, send: (input) => this._send(input) };
    this._replaceBody(window.content ? container(window.content, form) : null);
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
    const stage = this.pane.layer.getBoundingClientRect();
    const [width, height] = [this.element.offsetWidth, this.element.offsetHeight];
    const { placement, position = [50, 50] } = this.window;
    const kept = setting(`window ${this.window.title}`, []);
    const free = [stage.width - width, stage.height - height];
    const asked = position.map((x, i) => (placement === 'relative' && x < 0 ? free[i] + x : x));
    const usual = [free[0] - MARGIN, 56 + MARGIN * index * 3];
    this.moveTo(...(kept.length === 2 ? kept : placement === 'center' || !placement ? usual : asked));
  }

  moveTo(x, y) {
    const stage = this.pane.layer.getBoundingClientRect();
    this.x = Math.min(Math.max(x, 0), Math.max(stage.width - this.element.offsetWidth, 0));
    this.y = Math.min(Math.max(y, 0), Math.max(stage.height - this.element.offsetHeight, 0));
    this.element.style.left = `${this.x}px`;
    this.element.style.top = `${this.y}px`;
  }

  _drag(event) {
    if (event.target.closest('button')) return;
    const [dx, dy] = [event.clientX - this.x, event.clientY - this.y];
    this.bar.setPointerCapture(event.pointerId);
    const move = (at) => this.moveTo(at.clientX - dx, at.clientY - dy);
    this.bar.addEventListener('pointermove', move);
    this.bar.addEventListener('pointerup', () => {
      this.bar.removeEventListener('pointermove', move);
      remember(`window ${this.window.title}`, [this.x, this.y]);
    }, { once: true });
  }
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
      frame.element.remove();
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

  raise(frame) {
    if (this.layer.lastElementChild !== frame.element && !frame.element.contains(document.activeElement)) this.layer.append(frame.element);
  }

  send(window, input) {
    this.page.ask('ui', { window, widget: input.widget ?? null, input: { window, ...input } });
  }
}
