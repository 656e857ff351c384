// Properties of the selected object: grouped, live, editable where a script could write them.
import { copyText, el, iconButton, setText } from '../dom.js';
import { Sparkline } from './plots/curves.js';
import { arranged, FOLDED, MADE, madeRows, TITLES } from './inspect/essentials.js';
import { JointsPane } from './inspect/joints.js';
import { PoseBlock } from './inspect/pose.js';
import { shownUnit } from './inspect/units.js';
import { numbersOf } from './plots/plots.js';
import { drawImage } from './sensor_images.js';
import { editorOf, formatted } from './values.js';

const GETTERS = {
  bool: 'getBoolProperty', int: 'getIntProperty', long: 'getLongProperty', float: 'getFloatProperty', string: 'getStringProperty', buffer: 'getBufferProperty', color: 'getColorProperty',
  vector2: 'getVector2Property', vector3: 'getVector3Property', quaternion: 'getQuaternionProperty', pose: 'getPoseProperty', handle: 'getHandleProperty',
};
const CALLS = { jointPosition: 'getJointPosition', alias: 'getObjectAlias', mass: 'getShapeMass', position: 'getObjectPosition', absolutePosition: 'getObjectPosition', absolutePose: 'getObjectPose', parent: 'getObjectParent' };
const TARGETS = { [-13]: 'sim.handle_app', [-12]: 'sim.handle_scene' };

/** Lua that reads a property. */
export function luaOf(row, handle, path) {
  const target = TARGETS[handle] ?? `sim.getObject(${JSON.stringify(path).replaceAll('"', "'")})`;
  if (row.name === 'pose' && handle >= 0) return `sim.getObjectPose(${target}, sim.handle_parent)`;
  if (CALLS[row.name] && handle >= 0) return `sim.${CALLS[row.name]}(${target})`;
  return `sim.${GETTERS[row.type] ?? 'getProperty'}(${target}, '${row.name}')`;
}

export class InspectorPane {
  constructor(pane, page) {
    Object.assign(this, { page, store: page.store });
    this.handle = null;
    this.asking = null; // the answer that is awaited
    this.rows = new Map();
    this.folded = new Map();
    this.title = el('h2', { class: 'inspected' });
    this.kind = el('p', { class: 'inspected-kind' });
    this.tools = el('div', { class: 'inspected-tools' });
    this.search = el('input', { type: 'search', placeholder: 'Search properties', 'aria-label': 'Search properties', oninput: () => this._filter() });
    this.list = el('div', { class: 'properties', onpointerover: ({ target }) => showWhole(target) });
    this.hint = el('p', { class: 'hint' });
    this.picture = el('canvas', { class: 'sensor-image', hidden: true, role: 'img', 'aria-label': 'Image of the vision sensor' });
    this.sparkline = new Sparkline();
    this.joints = new JointsPane(page);
    pane.append(el('div', { class: 'inspected-head' }, this.title, this.tools), this.kind, this.picture, el('div', { class: 'pane-tools' }, this.search), this.hint, this.list, this.sparkline.element);
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
    if (handle === this.handle && (this.rows.size || this.asking) && writable === this.writable) return;
    Object.assign(this, { handle, writable, head: null });
    this._head();
    this._watch();
    const asking = (this.asking = this.page.source.request('inspect', { handle }));
    const answer = await asking.then((rows) => () => rows && this._show(rows), (error) => () => this._fail(error));
    if (asking !== this.asking) return; // something else was selected meanwhile
    this.asking = null;
    answer();
  }

  _fail(error) {
    this.list.replaceChildren();
    this.rows.clear();
    setText(this.hint, error.message);
    this.hint.hidden = false;
  }

  _head() {
    const object = this.store.objects.get(this.handle);
    const head = `${this.handle} ${object?.alias} ${object?.objectType} ${object?.lightType} ${object?.parent}`;
    if (head === this.head) return;
    this.head = head;
    const names = { [-12]: 'Scene', [-13]: 'Application' };
    setText(this.title, object ? object.alias : names[this.handle] ?? 'Nothing selected');
    const path = this.store.path(this.handle);
    setText(this.kind, object ? `${[object.jointType ?? object.lightType, spaced(object.objectType)].filter(Boolean).join(' ')}, handle ${this.handle}` : '');
    this.kind.hidden = !object;
    this.title.title = object ? `${path} (${object.objectType}, handle ${this.handle})` : '';
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
    this.sparkline.hide(); // its row is gone
    this.shown = rows;
    const object = this.store.objects.get(this.handle);
    const { main, groups } = arranged(rows, object);
    this.pose = this._poseBlock(rows, object);
    const first = main.length ? [el('section', { class: 'group essentials', 'aria-label': 'What matters' }, ...main.map((row) => this._row(row)))] : [];
    this.list.replaceChildren(...(this.pose ? [this.pose.element] : []), ...first, this.joints.element, ...groups.map(([name, members]) => this._group(name, members)));
    this.joints.show(this.handle);
    this.hint.hidden = rows.length > 0;
    setText(this.hint, rows.length ? '' : 'It has no properties.');
    this._filter();
  }

  _poseBlock(rows, object) {
    const of = Object.fromEntries(rows.filter(({ name }) => name === 'pose' || name === 'absolutePose').map((row) => [row.name, row]));
    if (!object || !(of.pose ?? of.absolutePose)) return null;
    this.poses = of;
    const { handle } = this;
    return new PoseBlock(of, {
      isRoot: !this.store.objects.has(object.parent),
      writable: this.page.canWrite && !!of.pose?.writable,
      set: (value) => this.page.ask('set', { handle, name: 'pose', value }),
      lua: (row) => luaOf(row, handle, this.store.path(handle)),
      again: () => this._show(this.shown),
      curve: of.absolutePose && this.page.plots.button(handle, { ...of.absolutePose, label: 'position', unit: 'm' }),
    }, this.pose?.entered);
  }

  _group(name, rows) {
    const open = this.folded.get(name) ?? !FOLDED.has(name);
    const group = el('details', { class: 'group', open }, el('summary', {}, TITLES[name] ?? name), ...rows.map((row) => this._row(row)));
    group.addEventListener('toggle', () => this.folded.set(name, group.open));
    return group;
  }

  _row(row) {
    const writable = row.writable && this.page.canWrite;
    const label = row.label || row.name;
    const editor = writable ? editorOf(row, label, (value) => this._set(row, value)) : null;
    const shown = editor?.element ?? el('output', { class: 'value', 'aria-label': label }, this._text(row));
    const wide = Array.isArray(row.value) && row.value.length > 1 && row.type !== 'color';
    const name = el('span', { class: 'label', title: row.about ? `${row.name}: ${row.about}` : row.name }, label);
    editor?.draggedBy?.(name);
    const unit = el('span', { class: 'unit', title: row.inert ? 'It is kept for scripts and files, and has no effect in Swanilda.' : null }, row.inert ? 'no effect' : shownUnit(row.unit).unit);
    const element = el('div', { class: `property${wide ? ' wide' : ''}${row.inert ? ' inert' : ''}`, 'data-name': row.name }, name, shown, unit, this._copy(row, label));
    const entry = { row, editor, shown, element, history: [] };
    if (typeof row.value === 'number') this._watchHistory(element, entry);
    if (this._hasCurve(row)) element.append(this.page.plots.button(this.handle, row));
    if (this._hasCurve(row) && !editor) this.page.plots.dragsFrom(name, this.handle, row);
    this.rows.set(row.name, entry);
    return element;
  }

  /** Of recordings only numbers are known over time. */
  _hasCurve(row) {
    return !MADE.has(row.name) && (this.page.source.live ? numbersOf(row).length > 0 : typeof row.value === 'number');
  }

  _copy(row, label) {
    const lua = luaOf(row, this.handle, this.store.path(this.handle));
    const copy = iconButton('copy', `Copy as Lua: ${lua}`, () => copyText(lua), { class: 'icon-button copy' });
    copy.setAttribute('aria-label', `Copy ${label} as Lua`);
    return copy;
  }

  /** A value as text; handles with the name of the object. */
  _text(row) {
    const object = /Handle$/.test(row.name) && typeof row.value === 'number' ? this.store.objects.get(row.value) : null;
    if (/Handle$/.test(row.name) && row.value === -1) return 'none';
    return object ? `${object.alias} (${row.value})` : formatted(row);
  }

  _watchHistory(element, entry) {
    element.addEventListener('pointerenter', () => this.sparkline.show(element, entry));
    element.addEventListener('pointerleave', () => this.sparkline.hide());
  }

  _set(row, value) {
    const back = () => {
      const editor = this.rows.get(row.name)?.editor;
      if (editor?.reset) editor.reset();
      editor?.show(row.value);
    };
    const { handle, page } = this;
    const edit = { edit: 'resize', arguments: { handle, size: value } };
    const done = row.name === 'size' ? page.ask('edit', edit) : page.ask('set', { handle, name: row.name, value });
    const entry = this.rows.get(row.name) ?? {};
    entry.asked = done;
    const over = () => entry.asked === done && (entry.asked = null);
    done.then(over, () => (over(), back()));
  }

  /** Values that were on their way when another one was asked for are no news. */
  _values() {
    const { handle, values: all } = this.store.properties;
    if (handle !== this.handle) return;
    const values = this.pose?.asked ? all.filter(({ name }) => !this.poses[name]) : all;
    const time = this.store.scene.time ?? 0;
    for (const fresh of values) this._value(fresh, time);
    const known = new Map(this.shown?.map((row) => [row.name, row]) ?? []);
    for (const fresh of values) if (known.has(fresh.name)) known.get(fresh.name).value = fresh.value;
    for (const made of madeRows(known, this.store.objects.get(handle))) this._value(made, time);
    if (this.pose && values.some(({ name }) => this.poses[name])) this.pose.update();
    this.sparkline.update();
  }

  _value(fresh, time) {
    const entry = this.rows.get(fresh.name);
    if (!entry || entry.asked) return;
    entry.row.value = fresh.value;
    if (entry.editor) entry.editor.show(fresh.value);
    else setText(entry.shown, this._text(entry.row));
    if (typeof fresh.value === 'number') remember(entry.history, time, fresh.value);
  }

  _filter() {
    const text = this.search.value.trim().toLowerCase();
    this.list.classList.toggle('searched', !!text);
    for (const { row, element } of this.rows.values()) element.hidden = !!text && !`${row.name} ${row.label}`.toLowerCase().includes(text);
    for (const group of this.list.querySelectorAll('.group')) group.hidden = [...group.querySelectorAll('.property')].every((row) => row.hidden);
  }
}

/** A text that is cut has the whole of it as title; fields for numbers have their own. */
function showWhole(element) {
  if (!element.matches('output.value, input.value:not([inputmode])')) return;
  const isCut = element.scrollWidth > element.clientWidth || element.scrollHeight > element.clientHeight + 2;
  element.title = isCut ? element.value : '';
}

/** `forceSensor` in words. */
const spaced = (type) => type.replace(/[A-Z]/g, (letter) => ` ${letter.toLowerCase()}`);

function remember(history, time, value) {
  if (history.length && history.at(-1)[0] > time) history.length = 0; // the simulation began again
  history.push([time, value]);
  if (history.length > 300) history.shift();
}
