// What the page knows of the scene, from the messages of docs/VIEW_PROTOCOL.md. Messages only mark what changed; `flush`, once a
// picture, calls the listeners, so that many messages cost one update of the page.

/** @typedef {Object<string, any>} SceneObject as in the protocol */

const POSE = 32; // bytes of a pose in a message: a handle and seven numbers
const LINES = 5000; // of the console; older ones are dropped

/** The position of an object in a message of poses; undefined if it is not there. @param {ArrayBuffer} buffer */
export function poseIn(buffer, handle) {
  const view = new DataView(buffer);
  if (view.getUint8(0) !== 1) return undefined;
  for (let at = 16; at + POSE <= buffer.byteLength; at += POSE) {
    if (view.getInt32(at, true) === handle) return [4, 8, 12].map((by) => view.getFloat32(at + by, true));
  }
  return undefined;
}

export class Store {
  constructor() {
    /** @type {Map<string, Set<Function>>} */
    this.listeners = new Map();
    this.connection = { state: 'connecting', reason: '' };
    this.busy = null; // a sentence about a script that does not end
    this.scene = {};
    this.timeline = null; // of a capture
    this.log = [];
    this.loggedLines = 0; // ever, also those that were dropped
    this._clear();
    this._marks();
  }

  _clear() {
    /** @type {Map<number, SceneObject>} */
    this.objects = new Map();
    /** @type {Map<number, Float32Array>} world poses: 3 of the position, 4 of the quaternion */
    this.poses = new Map();
    this.drawings = new Map();
    this.selection = [];
    this.windows = new Map();
    this.dialogs = [];
    this.banners = [];
    this.views = [];
    this.question = null;
    this.breakpoints = [];
    this.stopped = null; // where code stands still
    this.images = new Map();
    this.contacts = [];
  }

  _marks() {
    this.dirty = new Set();
    this.changed = new Set();
    this.moved = new Set();
    this.changedDrawings = new Set();
    this.samples = []; // messages
  }

  /** Calls a function after changes of a topic: scene, timeline, objects, poses, drawings, selection, log, windows, dialogs, banners, views, question, breakpoints, stopped, image, contacts, properties, samples, connection. */
  on(topic, listener) {
    if (!this.listeners.has(topic)) this.listeners.set(topic, new Set());
    this.listeners.get(topic).add(listener);
  }

  /** Calls the listeners of everything that changed since the last time. */
  flush() {
    if (!this.dirty.size) return;
    const { dirty, changed, moved, changedDrawings, samples } = this;
    this._marks();
    for (const topic of ['connection', 'scene', 'timeline', 'objects', 'poses', 'drawings', 'selection', 'log', 'windows', 'dialogs', 'banners', 'views', 'question', 'breakpoints', 'stopped', 'image', 'contacts', 'properties', 'samples']) {
      if (!dirty.has(topic)) continue;
      const detail = { objects: changed, poses: moved, drawings: changedDrawings, samples }[topic];
      this.listeners.get(topic)?.forEach((listener) => listener(detail));
    }
  }

  /** @param {string | null} sentence */
  setBusy(sentence) {
    this.busy = sentence;
    this.dirty.add('connection');
  }

  setConnection(state, reason = '') {
    this.connection = { state, reason };
    this.dirty.add('connection');
  }

  /** @param {any} message one of the simulator's text messages */
  receive(message) {
    if (message.type === 'snapshot') this._snapshot(message);
    else if (message.type === 'update') this._update(message);
    else if (message.type === 'properties') this._properties(message);
    else if (message.type === 'samples') this._sampled(message);
  }

  _properties({ handle, values }) {
    this.properties = { handle, values };
    this.dirty.add('properties');
  }

  _sampled(message) {
    this.samples.push(message);
    this.dirty.add('samples');
  }

  _snapshot(message) {
    const here = new Set((message.objects ?? []).map((object) => object.handle));
    const removed = [...this.objects.keys()].filter((handle) => !here.has(handle));
    const drawn = new Set((message.drawings ?? []).map((drawing) => drawing.id));
    const removedDrawings = [...this.drawings.keys()].filter((id) => !drawn.has(id));
    const shown = new Set((message.windows ?? []).map((window) => window.id));
    const removedWindows = [...this.windows.keys()].filter((handle) => !shown.has(handle));
    this._forgetLines();
    this._update({ timeline: null, selection: [], dialogs: [], banners: [], views: [], question: null, breakpoints: [], stopped: null, ...message, removed, removedDrawings, removedWindows });
  }

  _update(message) {
    this._take(message, 'scene', (scene) => ({ ...this.scene, ...scene }));
    message.removed?.forEach((handle) => this._remove(handle));
    message.objects?.forEach((object) => this._object(object));
    message.removedDrawings?.forEach((id) => this._drawing(id, null));
    message.drawings?.forEach((drawing) => this._drawing(drawing.id, drawing));
    this._take(message, 'selection');
    if (message.logBegins) this._forgetLines();
    if (message.log?.length) this._lines(message.log);
    for (const name of ['timeline', 'dialogs', 'banners', 'views', 'question', 'breakpoints', 'stopped']) this._take(message, name);
    message.removedWindows?.forEach((id) => this.windows.delete(id));
    message.windows?.forEach((window) => this.windows.set(window.id, window));
    if (message.windows?.length || message.removedWindows?.length) this.dirty.add('windows');
  }

  /** Takes over a member of a message, if it has it. */
  _take(message, name, made = (value) => value) {
    if (message[name] === undefined) return;
    this[name] = made(message[name]);
    this.dirty.add(name);
  }

  _object(object) {
    if (this.objects.get(object.handle) === object) return; // a recording's, seen again
    this.objects.set(object.handle, object);
    this.changed.add(object.handle);
    this.dirty.add('objects');
  }

  _remove(handle) {
    this.objects.delete(handle);
    this.poses.delete(handle);
    this.images.delete(handle);
    this.changed.add(handle);
    this.dirty.add('objects');
  }

  _drawing(id, drawing) {
    if (drawing) this.drawings.set(id, drawing);
    else this.drawings.delete(id);
    this.changedDrawings.add(id);
    this.dirty.add('drawings');
  }

  _forgetLines() {
    this.log = [];
    this.loggedLines = 0;
    this.dirty.add('log');
  }

  _lines(lines) {
    this.loggedLines += lines.length;
    this.log.push(...lines);
    if (this.log.length > LINES * 1.2) this.log.splice(0, this.log.length - LINES);
    this.dirty.add('log');
  }

  /** @param {ArrayBuffer} buffer a binary message */
  receiveBinary(buffer) {
    const view = new DataView(buffer);
    const kind = view.byteLength ? view.getUint8(0) : 0;
    if (kind === 1) this._poses(view);
    else if (kind === 2) this._image(view, buffer);
    else if (kind === 3) this._contacts(view);
  }

  _poses(view) {
    const count = view.getUint32(4, true);
    for (let i = 0, at = 16; i < count; i++, at += POSE) {
      const handle = view.getInt32(at, true);
      let pose = this.poses.get(handle);
      if (!pose) this.poses.set(handle, (pose = new Float32Array(7)));
      for (let k = 0; k < 7; k++) pose[k] = view.getFloat32(at + 4 + 4 * k, true);
      this.moved.add(handle);
    }
    this.dirty.add('poses');
  }

  _image(view, buffer) {
    const [handle, width, height] = [view.getInt32(4, true), view.getUint32(8, true), view.getUint32(12, true)];
    this.images.set(handle, { width, height, rgb: new Uint8Array(buffer, 24) });
    this.dirty.add('image');
  }

  _contacts(view) {
    const floats = (at) => [0, 1, 2].map((i) => view.getFloat32(at + 4 * i, true));
    this.contacts = Array.from({ length: view.getUint32(4, true) }, (_, i) => {
      const at = 16 + 44 * i;
      return { handles: [view.getInt32(at, true), view.getInt32(at + 4, true)], point: floats(at + 8), normal: floats(at + 20), force: floats(at + 32) };
    });
    this.dirty.add('contacts');
  }

  /** Path of an object as scripts write it, `/Robot/joint`. */
  path(handle) {
    const names = [];
    for (let at = this.objects.get(handle); at && names.length < 100; at = this.objects.get(at.parent)) names.unshift(at.alias);
    return '/' + names.join('/');
  }
}
