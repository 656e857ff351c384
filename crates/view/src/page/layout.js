// Panels: which are shown, how large, light or dark; remembered between visits.
import { el, iconButton } from './dom.js';
import { remember, setting } from './settings.js';
import { addBorders } from './splits.js';
import { THEMES } from './render/themes.js';

const NARROW = 640; // pixels; below it panels cover the scene and are closed at first
const OPTIONS = [
  ['shadows', 'Shadows'], ['edges', 'Edges'], ['grid', 'Grid'], ['frames', 'Frames of all objects'], ['contacts', 'Contacts and forces'], ['torques', 'Forces of joints as colours'], ['trails', 'Paths of what is selected'], ['hidden', 'Hidden objects'],
];

export class Layout {
  constructor(page) {
    this.page = page;
    this.app = document.getElementById('app');
    this.buttons = new Map();
    this.dark = matchMedia('(prefers-color-scheme: dark)');
    this.dark.addEventListener('change', () => this._applyTheme());
    this._applyTheme();
    this._fit();
    this.narrow = matchMedia(`(max-width: ${NARROW - 0.02}px)`);
    this.narrow.addEventListener('change', () => this._fit());
    this._split();
    addBorders();
    page.store.on('objects', () => this._cameras());
  }

  /** @param {boolean} [shown] the other way round if left out */
  show(name, shown = document.getElementById(name).hidden, kept = true) {
    document.getElementById(name).hidden = !shown;
    this.app.classList.toggle(`with-${name}`, shown);
    this.buttons.get(name)?.setAttribute('aria-pressed', String(shown));
    if (kept && innerWidth >= NARROW) remember(`panel ${name}`, shown);
  }

  /** Panels as they are at first at this width: also when a window is made narrow or a phone is turned. */
  _fit() {
    for (const name of ['side', 'console']) this.show(name, innerWidth >= NARROW && setting(`panel ${name}`, true), false);
  }

  toggleTheme() {
    remember('theme', this.theme === 'dark' ? 'light' : 'dark');
    this._applyTheme();
  }

  _applyTheme() {
    this.theme = setting('theme', this.dark.matches ? 'dark' : 'light');
    document.documentElement.dataset.theme = this.theme;
    const { renderer, curves } = this.page;
    if (renderer) Object.assign(renderer, { theme: THEMES[this.theme], stale: true });
    curves?.draw();
  }

  /** Buttons of the bar's right end. */
  addButtons(bar) {
    const panel = (name, sign, title) => {
      const shown = !document.getElementById(name).hidden;
      const button = iconButton(sign, title, () => this.show(name), { class: 'icon-button toggle', 'aria-pressed': String(shown) });
      this.buttons.set(name, button);
      this._closable(name);
      return button;
    };
    this.menu = this._menu();
    const options = iconButton('options', 'Options of the view', () => this._toggleMenu(options), { 'aria-haspopup': 'dialog', 'aria-expanded': 'false' });
    bar.append(el('span', { class: 'room' }), panel('side', 'tree', 'Objects and properties (T)'), panel('console', 'console', 'Console (C)'), options,
      iconButton('theme', 'Light or dark (D)', () => this.toggleTheme()), iconButton('help', 'Keys (?)', () => this.page.help.toggle()));
    this._closable('script');
    this._closable('curves');
    this.menuButton = options;
  }

  /** A cross in the corner of a panel. */
  _closable(name) {
    const panel = document.getElementById(name);
    panel.append(iconButton('close', 'Close', () => this.show(name, false), { class: 'icon-button panel-close' }));
  }

  _menu() {
    const { page } = this;
    const boxes = OPTIONS.map(([name, text]) => {
      const box = el('input', { type: 'checkbox', checked: this._option(name), onchange: () => this._setOption(name, box.checked) });
      return el('label', { class: 'choice' }, box, text);
    });
    this.camera = el('select', { 'aria-label': 'Camera', onchange: () => page.useCamera(Number(this.camera.value)) });
    this._cameras();
    const menu = el('div', { class: 'menu', role: 'dialog', 'aria-label': 'Options of the view', hidden: true }, el('label', { class: 'menu-row' }, 'Camera', this.camera), page.sights?.presets.element, ...boxes, page.shelf.element);
    document.getElementById('stage').append(menu);
    for (const [name] of OPTIONS) this._applyOption(name, this._option(name));
    return menu;
  }

  _option(name) {
    return setting(`option ${name}`, ['shadows', 'edges', 'grid'].includes(name));
  }

  _setOption(name, on) {
    remember(`option ${name}`, on);
    this._applyOption(name, on);
  }

  _applyOption(name, on) {
    const { renderer, source } = this.page;
    if (!renderer || this.page.sights.set(name, on)) return;
    if (name === 'contacts') source.request('show', { contacts: on }).catch(() => {});
    else if (name === 'frames' || name === 'hidden') {
      renderer.view.options[name] = on;
      renderer.view.dirtyLines = true;
      renderer.view.rebuild();
    } else renderer.options[name] = on;
    if (name === 'contacts' && !on) this.page.store.contacts = [];
    renderer.drawings.contactsChanged();
    renderer.stale = true;
  }

  /** The scene's cameras, to look through. */
  _cameras() {
    if (!this.camera) return;
    const cameras = [...this.page.store.objects.values()].filter(({ objectType }) => objectType === 'camera' || objectType === 'visionSensor');
    const entries = [[-1, 'Free'], ...cameras.map(({ handle, alias }) => [handle, alias])];
    const key = JSON.stringify(entries);
    if (key === this.cameraKey) return;
    this.cameraKey = key;
    const { value } = this.camera;
    this.camera.replaceChildren(...entries.map(([handle, name]) => el('option', { value: handle }, name)));
    this.camera.value = entries.some(([handle]) => String(handle) === value) ? value : '-1';
  }

  _toggleMenu(button) {
    this.menu.hidden = !this.menu.hidden;
    button.setAttribute('aria-expanded', String(!this.menu.hidden));
    if (this.menu.hidden) return button.focus();
    this.camera.value = String(this.page.renderer?.camera.fixed ? this.page.throughCamera : -1);
    this.camera.focus();
  }

  /** @returns {boolean} whether anything was open */
  closeOverlays() {
    if (!this.menu.hidden) return this._toggleMenu(this.menuButton), true;
    if (innerWidth >= NARROW) return false;
    const open = ['script', 'side', 'console'].find((name) => !document.getElementById(name).hidden);
    if (open) this.show(open, false);
    return !!open;
  }

  /** The border between tree and inspector, by pointer and keys. */
  _split() {
    const split = document.getElementById('side-split');
    const side = document.getElementById('side');
    const set = (part) => {
      const kept = Math.min(Math.max(part, 0.15), 0.85);
      side.style.setProperty('--tree-part', `${kept * 100}%`);
      split.setAttribute('aria-valuenow', String(Math.round(kept * 100)));
      remember('tree part', (this.part = kept));
    };
    set(setting('tree part', 0.42));
    split.addEventListener('keydown', (event) => {
      const by = { ArrowUp: -0.05, ArrowDown: 0.05 }[event.key];
      if (by) event.preventDefault(), event.stopPropagation(), set(this.part + by);
    });
    split.addEventListener('pointerdown', (event) => split.setPointerCapture(event.pointerId));
    split.addEventListener('pointermove', (event) => split.hasPointerCapture(event.pointerId) && set((event.clientY - side.getBoundingClientRect().top) / side.clientHeight));
  }
}
