// Properties of the selected object: grouped, live, editable where a script could write them.
import { copyText, el, iconButton, setText } from '../dom.js';
import { Sparkline } from './curves.js';
import { drawImage } from './sensor_images.js';
import { editorOf, formatted } from './values.js';

const GETTERS = {
  bool: 'getBoolProperty', int: 'getIntProperty', long: 'getLongProperty', float: 'getFloatProperty', string: 'getStringProperty', buffer: 'getBufferProperty', color: 'getColorProperty',
  vector2: 'getVector2Property', vector3: 'getVector3Property', quaternion: 'getQuaternionProperty', pose: 'getPoseProperty', handle: 'getHandleProperty',
};
const CALLS = { jointPosition: 'getJointPosition', alias: 'getObjectAlias', mass: 'getShapeMass', position: 'getObjectPosition', absolutePosition: 'getObjectPosition', pose: 'getObjectPose', parent: 'getObjectParent' };
const TARGETS = { [-13]: 'sim.handle_app', [-12]: 'sim.handle_scene' };
const FOLDED = new Set(['data', 'engines']); // groups that are closed at first

/** Lua that reads a property. */
export function luaOf(row, handle, path) {
  const target = TARGETS[handle] ?? `sim.getObject(${JSON.stringify(path).replaceAll('"', "'")})`;
  if (CALLS[row.name] && handle >= 0) return `sim.${CALLS[row.name]}(${target})`;
  return `sim.${GETTERS[row.type] ?? 'getProperty'}(${target}, '${row.name}')`;
}

export class InspectorPane {
  constructor(pane, page) {
    Object.assign(this, { page, store: page.store });
    this.handle = null;
    this.rows = new Map();
    this.folded = new Map();
    this.title = el('h3', { class: 'inspected' });
    this.tools = el('div', { class: 'inspected-tools' });
    this.search = el('input', { type: 'search', placeholder: 'Search properties', 'aria-label': 'Search properties', oninput: () => this._filter() });
    this.list = el('div', { class: 'properties' });
    this.hint = el('p', { class: 'hint' });
    this.picture = el('canvas', { class: 'sensor-image', hidden: true, role: 'img', 'aria-label': 'Image of the vision sensor' });
    this.sparkline = new Sparkline();
    pane.append(el('div', { class: 'inspected-head' }, this.title, this.tools), this.picture, el('div', { class: 'pane-tools' }, this.search), this.hint, this.list, this.sparkline.element);
    this.store.on('selection', () => this._selected());
    this.store.on('objects', (changed) => changed.has(this.handle) && this._head());
    this.store.on('properties', () => this._values());
    this.store.on('image', () => this._image());
    for (const topic of ['connection', 'scene']) this.store.on(topic, () => this._selected());
  }

  /** The last selected object, or the scene. */
  async _selected() {
    if (!['open'].includes(this.store.connection.state)) return;
    const handle = this.store.selection.at(-1) ?? -12;
    const writable = this.page.canWrite; // a capture goes on live: from then on
    if (handle === this.handle && this.rows.size && writable === this.writable) return;
    Object.assign(this, { handle, writable, head: null });
    this._head();
    this._watch();
    const rows = await this.page.source.request('inspect', { handle }).catch((error) => this._fail(error));
    if (handle === this.handle && rows) this._show(rows);
  }

  _fail(error) {
    this.list.replaceChildren();
    this.rows.clear();
    setText(this.hint, error.message);
    this.hint.hidden = false;
  }

  _head() {
    const object = this.store.objects.get(this.handle);
    const head = `${this.handle} ${object?.alias} ${object?.objectType}`;
    if (head === this.head) return;
    this.head = head;
    const names = { [-12]: 'Scene', [-13]: 'Application' };
    setText(this.title, object ? object.alias : names[this.handle] ?? 'Nothing selected');
    this.title.title = object ? `${this.store.path(this.handle)} (${object.objectType}, handle ${this.handle})` : '';
    const tools = [];
    if (object?.objectType === 'script') tools.push(iconButton('script', 'Read the script', () => this.page.openScript(this.handle)));
    if (object && object.objectType !== 'script') tools.push(iconButton('follow', 'Follow with the camera', () => this.page.follow(object.handle)), iconButton('fit', 'Look at it (F)', () => this.page.fit([object.handle])));
    if (this._configurator() !== undefined && this.page.canWrite) tools.push(iconButton('options', 'Settings of the model', () => this._configure()));
    if (object?.objectType === 'graph') tools.push(iconButton('curve', 'Show the curves', () => this.page.showGraph(this.handle)));
    this.tools.replaceChildren(...tools);
  }

  /** The customization script of what is inspected: itself or one below it. */
  _configurator() {
    const isOne = ({ objectType, scriptType, handle, parent }) => objectType === 'script' && scriptType === 'customization' && (handle === this.handle || parent === this.handle);
    return this.handle >= 0 ? [...this.store.objects.values()].find(isOne)?.handle : undefined;
  }

  async _configure() {
    const has = await this.page.ask('configure', { handle: this._configurator() });
    if (!has) this.page.overlay.say('This model has no settings.');
  }

  _watch() {
    this.isSensor = this.store.objects.get(this.handle)?.objectType === 'visionSensor';
    this.picture.hidden = true;
    this.page.sensorImages.watch(this, this.isSensor ? [this.handle] : []);
  }

  _image() {
    this.picture.hidden = !this.isSensor || !drawImage(this.picture, this.store.images.get(this.handle));
  }

  _show(rows) {
    this.rows.clear();
    const groups = new Map();
    for (const row of rows) {
      const name = row.group || 'other';
      if (!groups.has(name)) groups.set(name, []);
      groups.get(name).push(row);
    }
    this.list.replaceChildren(...[...groups].map(([name, members]) => this._group(name, members)));
    this.hint.hidden = rows.length > 0;
    setText(this.hint, rows.length ? '' : 'It has no properties.');
    this._filter();
  }

  _group(name, rows) {
    const open = this.folded.get(name) ?? !FOLDED.has(name);
    const group = el('details', { class: 'group', open }, el('summary', {}, name), ...rows.map((row) => this._row(row)));
    group.addEventListener('toggle', () => this.folded.set(name, group.open));
    return group;
  }

  _row(row) {
    const writable = row.writable && this.page.canWrite;
    const label = row.label || row.name;
    const editor = writable ? editorOf(row, label, (value) => this._set(row, value)) : null;
    const shown = editor?.element ?? el('output', { class: 'value', 'aria-label': label }, formatted(row));
    const copy = iconButton('copy', `Copy as Lua: ${luaOf(row, this.handle, this.store.path(this.handle))}`, () => copyText(luaOf(row, this.handle, this.store.path(this.handle))), { class: 'icon-button copy' });
    copy.setAttribute('aria-label', `Copy ${label} as Lua`);
    const wide = Array.isArray(row.value) && row.value.length > 2 && row.type !== 'color';
    const element = el('div', { class: wide ? 'property wide' : 'property', 'data-name': row.name }, el('span', { class: 'label', title: row.name }, label), shown, el('span', { class: 'unit' }, row.unit ?? ''), copy);
    const entry = { row, editor, shown, element, history: [] };
    if (typeof row.value === 'number') this._watchHistory(element, entry);
    const hasCurve = typeof row.value === 'number' || row.name === 'absolutePose';
    if (hasCurve && !this.page.source.live) element.append(iconButton('curve', 'Curve over the recording', () => this.page.showCurve(this.handle, row), { class: 'icon-button copy' }));
    this.rows.set(row.name, entry);
    return element;
  }

  _watchHistory(element, entry) {
    element.addEventListener('pointerenter', () => this.sparkline.show(element, entry));
    element.addEventListener('pointerleave', () => this.sparkline.hide());
  }

  _set(row, value) {
    this.page.ask('set', { handle: this.handle, name: row.name, value }).then(null, () => this.rows.get(row.name)?.editor?.show(row.value));
  }

  _values() {
    const { handle, values } = this.store.properties;
    if (handle !== this.handle) return;
    const time = this.store.scene.time ?? 0;
    for (const fresh of values) {
      const entry = this.rows.get(fresh.name);
      if (!entry) continue;
      Object.assign(entry.row, fresh);
      if (entry.editor) entry.editor.show(fresh.value);
      else setText(entry.shown, formatted(entry.row));
      if (typeof fresh.value === 'number') remember(entry.history, time, fresh.value);
    }
    this.sparkline.update();
  }

  _filter() {
    const text = this.search.value.trim().toLowerCase();
    for (const { row, element } of this.rows.values()) element.hidden = !!text && !`${row.name} ${row.label}`.toLowerCase().includes(text);
    for (const group of this.list.children) group.hidden = [...group.querySelectorAll('.property')].every((row) => row.hidden);
  }
}

function remember(history, time, value) {
  if (history.length && history.at(-1)[0] > time) history.length = 0; // the simulation began again
  history.push([time, value]);
  if (history.length > 300) history.shift();
}
