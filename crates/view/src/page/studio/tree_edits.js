// Changes in the tree: names are written there, rows are dragged onto others, and a menu has what can be done with an object.
import { el } from '../dom.js';

const TYPE = 'application/x-swanilda-objects';

export class TreeEdits {
  /** @param {any} page @param {any} studio */
  constructor(page, studio) {
    Object.assign(this, { page, studio, edits: studio.edits, store: page.store, tree: page.tree.tree });
    this.menu = el('div', { class: 'studio-menu context-menu', role: 'menu', 'aria-label': 'What can be done with the object', hidden: true });
    document.getElementById('tree-pane').append(this.menu);
    const listen = (type, handler) => this.tree.addEventListener(type, handler);
    listen('pointerdown', (event) => this._markDraggable(event));
    listen('dragstart', (event) => this._dragStart(event));
    listen('dragover', (event) => this._dragOver(event));
    listen('dragleave', () => this._mark(null));
    listen('drop', (event) => this._drop(event));
    listen('contextmenu', (event) => this._openMenu(event));
    this.menu.addEventListener('keydown', (event) => this._menuKey(event));
    addEventListener('pointerdown', (event) => this.menu.contains(event.target) || this.closeMenu(), true);
  }

  _rowAt(event) {
    return event.target.closest?.('[role=treeitem]');
  }

  _markDraggable(event) {
    const row = this._rowAt(event);
    if (row) row.draggable = this.edits.possible && this.edits.stopped;
  }

  _dragStart(event) {
    const handle = Number(this._rowAt(event).dataset.handle);
    const { selection } = this.store;
    this.dragged = selection.includes(handle) ? [...selection] : [handle];
    event.dataTransfer.setData(TYPE, this.dragged.join());
    event.dataTransfer.effectAllowed = 'all';
  }

  _dragOver(event) {
    if (![...event.dataTransfer.types].includes(TYPE)) return;
    event.preventDefault();
    this._mark(this._rowAt(event));
  }

  _mark(row) {
    this.tree.querySelector('.drop-target')?.classList.remove('drop-target');
    row?.classList.add('drop-target');
  }

  /** Onto a row: below that object; onto the empty part of the tree: below none. */
  _drop(event) {
    if (!event.dataTransfer.getData(TYPE)) return;
    event.preventDefault();
    const parent = Number(this._rowAt(event)?.dataset.handle ?? -1);
    this._mark(null);
    const handles = (this.dragged ?? []).filter((handle) => handle !== parent);
    if (handles.length) this.edits.ask('parent', { handles, parent });
  }

  /** The name of an object becomes a field. @param {number} handle */
  rename(handle = this.store.selection.at(-1)) {
    const object = this.store.objects.get(handle);
    if (!object || !this.edits.possible) return;
    const name = document.querySelector(`#tree-${handle} .name`);
    if (!name) return;
    const field = el('input', { type: 'text', class: 'rename', value: object.alias, 'aria-label': `New name of ${object.alias}`, spellcheck: 'false' });
    let over = false;
    const end = (alias) => {
      if (over) return;
      over = true;
      field.replaceWith(name);
      this.tree.focus({ preventScroll: true });
      if (alias !== null) this.edits.rename(handle, alias.trim());
    };
    field.addEventListener('keydown', (event) => {
      event.stopPropagation();
      if (event.key === 'Enter') end(field.value);
      if (event.key === 'Escape') end(null);
    });
    for (const type of ['click', 'dblclick', 'pointerdown']) field.addEventListener(type, (event) => event.stopPropagation());
    field.addEventListener('blur', () => end(field.value));
    name.replaceWith(field);
    field.focus();
    field.select();
  }

  _items() {
    const { edits, studio, store } = this;
    const [handle] = store.selection.slice(-1);
    const object = store.objects.get(handle);
    const isShape = object?.objectType === 'shape';
    return [
      ['Rename', 'F2', () => this.rename(handle)],
      ['Duplicate', 'Ctrl+D', () => edits.ofChosen('duplicate')],
      ['Delete with all below', 'Del', () => edits.ofChosen('remove')],
      ['Move to the top of the tree', '', () => edits.ofChosen('parent', { parent: -1 })],
      object?.objectType !== 'script' && ['Drop onto what is below', 'B', () => edits.ofChosen('drop')],
      isShape && store.selection.length > 1 && ['Group shapes', 'Ctrl+G', () => edits.group()],
      isShape && ['Ungroup', 'Ctrl+Shift+G', () => edits.ungroup()],
      object?.objectType !== 'script' && ['Add below', 'A', () => studio.addBelow()],
      object?.objectType !== 'script' && [object?.modelBase ? 'Is no model' : 'Becomes a model', '', () => edits.ask('model', { handle, on: !object.modelBase })],
      object?.modelBase && ['Save the model', '', () => studio.files.save(handle)],
    ].filter(Boolean);
  }

  _openMenu(event) {
    const row = this._rowAt(event);
    if (!row || !this.edits.possible) return;
    event.preventDefault();
    const handle = Number(row.dataset.handle);
    if (!this.store.selection.includes(handle)) this.page.select(handle, false);
    this.openMenuAt(event.clientX, event.clientY);
  }

  openMenuAt(x, y) {
    this.closeMenu();
    const item = ([text, key, action]) => el('button', { type: 'button', role: 'menuitem', tabindex: -1, class: 'menu-item', onclick: () => (this.closeMenu(), action()) }, text, el('kbd', {}, key));
    this.menu.replaceChildren(...this._items().map(item));
    this.menu.hidden = false;
    Object.assign(this.menu.style, { left: `${Math.min(x, innerWidth - this.menu.offsetWidth - 8)}px`, top: `${Math.min(y, innerHeight - this.menu.offsetHeight - 8)}px` });
    this.menu.querySelector('button')?.focus();
  }

  closeMenu() {
    this.menu.hidden = true;
  }

  _menuKey(event) {
    event.stopPropagation();
    const items = [...this.menu.children];
    const to = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (event.key === 'Escape') this.closeMenu(), this.tree.focus();
    if (!to) return;
    event.preventDefault();
    items[(items.indexOf(document.activeElement) + to + items.length) % items.length].focus();
  }
}
