// The tree of objects: the ARIA tree pattern, with only the rows that are seen as elements, so that 50 000 objects scroll.
import { el, icon, setText } from '../dom.js';

const ROW = 24; // pixels
const SPARE = 10; // rows above and below what is seen
const ICONS = { shape: 'shape', joint: 'joint', dummy: 'dummy', camera: 'camera', light: 'light', forceSensor: 'forceSensor', proximitySensor: 'proximitySensor', visionSensor: 'visionSensor', script: 'script', graph: 'curve', path: 'curve', octree: 'points', pointCloud: 'points' };

export class TreePane {
  /** @param {HTMLElement} pane @param {any} page */
  constructor(pane, page) {
    Object.assign(this, { page, store: page.store });
    this.expanded = new Map(); // by handle; the others are open when they are no models
    this.shown = new Map(); // by handle: what rows say of objects
    this.rows = [];
    this.active = null;
    this.search = el('input', { type: 'search', placeholder: 'Search objects', 'aria-label': 'Search objects', oninput: () => this._refresh() });
    this.spacer = el('div', { class: 'tree-spacer', role: 'presentation' });
    this.tree = el('div', { class: 'tree', role: 'tree', tabindex: 0, 'aria-label': 'Objects', 'aria-multiselectable': 'true', id: 'tree' }, this.spacer);
    this.empty = el('p', { class: 'hint' });
    pane.append(el('div', { class: 'pane-tools' }, this.search), this.tree, this.empty);
    this._listen();
  }

  _listen() {
    this.tree.addEventListener('scroll', () => this._draw());
    this.tree.addEventListener('keydown', (event) => this._key(event));
    this.tree.addEventListener('click', (event) => this._click(event));
    this.tree.addEventListener('dblclick', (event) => this._doubleClick(event));
    new ResizeObserver(() => this._draw()).observe(this.tree);
    this.store.on('objects', (changed) => this._objectsChanged(changed));
    this.store.on('selection', () => this._selectionChanged());
    this.store.on('connection', () => this._refresh());
  }

  /** Most changes, such as of positions of joints, do not concern the tree. */
  _objectsChanged(changed) {
    let differs = false;
    for (const handle of changed) {
      const object = this.store.objects.get(handle);
      const shown = object && JSON.stringify([object.alias, object.parent, object.childOrder, object.objectType, object.visible, object.modelBase, object.error?.message]);
      if (this.shown.get(handle) === shown) continue;
      differs = true;
      if (shown) this.shown.set(handle, shown);
      else this.shown.delete(handle);
    }
    if (differs) this._refresh();
  }

  _children() {
    const children = new Map();
    for (const object of this.store.objects.values()) {
      const parent = this.store.objects.has(object.parent) ? object.parent : -1;
      if (!children.has(parent)) children.set(parent, []);
      children.get(parent).push(object);
    }
    for (const list of children.values()) list.sort((a, b) => (a.objectType === 'script') - (b.objectType === 'script') || a.childOrder - b.childOrder || a.handle - b.handle);
    return children;
  }

  /** Makes the list of rows that are not folded away. */
  _refresh() {
    const wanted = this.search.value.trim().toLowerCase();
    const children = this._children();
    const matches = wanted ? this._matching(children, wanted) : null;
    this.rows = [];
    this._append(children, children.get(-1) ?? [], 1, matches);
    this.spacer.style.height = `${this.rows.length * ROW}px`;
    const nothing = this.store.objects.size ? `No object is called “${this.search.value}”.` : 'The scene has no objects yet.';
    setText(this.empty, this.rows.length ? '' : nothing);
    this.empty.hidden = this.rows.length > 0;
    this._draw();
  }

  _append(children, objects, level, matches) {
    const shown = matches ? objects.filter((object) => matches.has(object.handle)) : objects;
    shown.forEach((object, i) => {
      const below = children.get(object.handle) ?? [];
      const open = matches ? true : this._isOpen(object);
      this.rows.push({ object, level, position: i + 1, of: shown.length, open: below.length ? open : null });
      if (below.length && open) this._append(children, below, level + 1, matches);
    });
  }

  _isOpen({ handle, modelBase }) {
    return this.expanded.get(handle) ?? !modelBase;
  }

  /** What is called so, and everything above it. */
  _matching(children, wanted) {
    const found = new Set();
    for (const object of this.store.objects.values()) {
      if (!`${object.alias} ${object.objectType}`.toLowerCase().includes(wanted)) continue;
      for (let at = object; at && !found.has(at.handle); at = this.store.objects.get(at.parent)) found.add(at.handle);
    }
    return found;
  }

  /** Elements for the rows that are seen. */
  _draw() {
    const first = Math.max(Math.floor(this.tree.scrollTop / ROW) - SPARE, 0);
    const last = Math.min(Math.ceil((this.tree.scrollTop + this.tree.clientHeight) / ROW) + SPARE, this.rows.length);
    this.spacer.replaceChildren(...this.rows.slice(first, last).map((row, i) => this._row(row, first + i)));
    const active = this.active !== null && document.getElementById(`tree-${this.active}`);
    if (active) this.tree.setAttribute('aria-activedescendant', active.id);
    else this.tree.removeAttribute('aria-activedescendant');
  }

  _row({ object, level, position, of, open }, index) {
    const { handle, alias, objectType, visible } = object;
    const selected = this.store.selection.includes(handle);
    const arrow = open === null ? el('span', { class: 'twisty' }) : el('span', { class: open ? 'twisty open' : 'twisty' }, icon('fold'));
    const row = el('div', {
      role: 'treeitem', id: `tree-${handle}`, 'data-handle': handle, 'aria-level': level, 'aria-posinset': position, 'aria-setsize': of, 'aria-selected': String(selected),
      'aria-expanded': open === null ? null : String(open), class: `tree-row${handle === this.active ? ' active' : ''}${visible === false ? ' hidden-object' : ''}`,
      title: `${alias} (${objectType})`,
    }, arrow, icon(ICONS[objectType] ?? 'shape'), el('span', { class: 'name' }, alias), object.error && el('span', { class: 'badge', title: object.error.message }, 'E'));
    row.style.top = `${index * ROW}px`;
    row.style.paddingLeft = `${4 + (level - 1) * 14}px`;
    return row;
  }

  _rowOf(event) {
    const handle = Number(event.target.closest('[role=treeitem]')?.dataset.handle ?? NaN);
    return this.rows.find((row) => row.object.handle === handle);
  }

  _click(event) {
    const row = this._rowOf(event);
    if (!row) return;
    this.active = row.object.handle;
    if (event.target.closest('.twisty') && row.open !== null) return this._setOpen(row, !row.open);
    this.page.select(row.object.handle, event.ctrlKey || event.metaKey);
    this._draw();
  }

  _doubleClick(event) {
    const row = this._rowOf(event);
    if (row) this._open(row);
  }

  /** Scripts are read, other objects looked at. */
  _open({ object }) {
    if (object.objectType === 'script') this.page.openScript(object.handle);
    else this.page.fit([object.handle]);
  }

  _setOpen(row, open) {
    this.expanded.set(row.object.handle, open);
    this._refresh();
  }

  _key(event) {
    const index = this.rows.findIndex((row) => row.object.handle === this.active);
    const row = this.rows[index];
    const go = (to) => this._activate(this.rows[Math.min(Math.max(to, 0), this.rows.length - 1)]);
    const actions = {
      ArrowDown: () => go(index + 1),
      ArrowUp: () => go(index - 1),
      Home: () => go(0),
      End: () => go(this.rows.length - 1),
      ArrowRight: () => (row?.open === false ? this._setOpen(row, true) : row?.open && go(index + 1)),
      ArrowLeft: () => (row?.open ? this._setOpen(row, false) : row && this._activate(this.rows.find(({ object }) => object.handle === row.object.parent))),
      Enter: () => row && this.page.select(row.object.handle, false),
      ' ': () => row && this.page.select(row.object.handle, true),
    };
    if (!actions[event.key] || event.ctrlKey !== (event.key === ' ')) return; // letters are keys of the page; Space alone starts and pauses
    event.preventDefault();
    event.stopPropagation();
    actions[event.key]();
  }

  _activate(row) {
    if (!row) return;
    this.active = row.object.handle;
    this._reveal(this.rows.indexOf(row));
    this._draw();
  }

  _reveal(index) {
    const { tree } = this;
    if (index * ROW < tree.scrollTop) tree.scrollTop = index * ROW;
    else if ((index + 1) * ROW > tree.scrollTop + tree.clientHeight) tree.scrollTop = (index + 1) * ROW - tree.clientHeight;
  }

  /** Unfolds what is above the selected object and shows its row. */
  _selectionChanged() {
    const handle = this.store.selection.at(-1);
    const object = this.store.objects.get(handle);
    if (object) {
      for (let at = this.store.objects.get(object.parent); at; at = this.store.objects.get(at.parent)) this.expanded.set(at.handle, true);
      this.active = handle;
      this._refresh();
      const index = this.rows.findIndex((row) => row.object.handle === handle);
      if (index >= 0) this._reveal(index);
    }
    this._draw();
  }
}
