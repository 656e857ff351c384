// The page: which parts there are, and what they do together.
import { servedRecording, inlinedRecording } from './chunks.js';
import { LiveSource } from './connection.js';
import { Layout } from './layout.js';
import { BannersPane } from './panes/banners.js';
import { Bar } from './panes/bar.js';
import { ConsolePane } from './panes/console.js';
import { CurvesPane } from './panes/plots/curves.js';
import { DialogsPane } from './panes/dialogs.js';
import { Help, keysOf } from './panes/help.js';
import { InspectorPane } from './panes/inspector.js';
import { Overlay } from './panes/overlay.js';
import { Plots } from './panes/plots/plots.js';
import { Questions } from './panes/questions.js';
import { debugKeys } from './panes/scripts/debugging.js';
import { ScriptPane } from './panes/scripts/script.js';
import { SensorImages } from './panes/sensor_images.js';
import { Shelf } from './panes/shelf.js';
import { Sights } from './panes/sight/sights.js';
import { TreePane } from './panes/tree.js';
import { ViewsPane } from './panes/views.js';
import { WindowsPane } from './panes/windows.js';
import { Controls } from './render/controls.js';
import { Renderer } from './render/renderer.js';
import { ReplaySource } from './replay.js';
import { Samples } from './samples.js';
import { poseIn, Store } from './store.js';
import { Studio, studioKeys } from './studio/studio.js';

const at = (id) => document.getElementById(id);

/** Everything that panes may ask of the page. */
class Page {
  constructor(store, source) {
    Object.assign(this, { store, source });
    this.renderer = this._renderer();
    this.sensorImages = new SensorImages(source);
    this.samples = new Samples(this);
    this.layout = new Layout(this);
    this.shelf = new Shelf(this);
    this.tree = new TreePane(at('tree-pane'), this);
    this.inspector = new InspectorPane(at('inspector-pane'), this);
    this.console = new ConsolePane(at('console'), this);
    this.script = new ScriptPane(at('script'), this);
    this.curves = new CurvesPane(at('curves'), this);
    this.plots = new Plots(this);
    this.bar = new Bar(at('bar'), this);
    this.overlay = new Overlay(this);
    this.windows = new WindowsPane(at('windows'), this);
    this.views = new ViewsPane(at('windows'), this);
    this.dialogs = new DialogsPane(this);
    this.questions = new Questions(this);
    this.banners = new BannersPane(this);
    this.studio = new Studio(this);
    const keys = [...keysOf(this), ...studioKeys(this), ...debugKeys()];
    this.help = new Help(keys);
    this._listen(keys);
    this.layout.addButtons(at('bar'));
  }

  /** Without WebGL2 the text remains. */
  _renderer() {
    try {
      return new Renderer(at('scene'), this.store, this.source);
    } catch (error) {
      this.failure = error.message;
      return null;
    }
  }

  _listen(keys) {
    const actions = new Map(keys.flatMap((key) => key.keys.map((name) => [name, key.action])));
    addEventListener('keydown', (event) => this._key(event, actions));
    const pointed = { select: (hit, more) => this._clicked(hit, more), focus: (hit) => this._focused(hit), hover: (hit, x, y) => this.overlay.hover(hit, x, y), moved: () => (this.followed = null), pull: this.studio.pull };
    if (this.renderer) this.controls = new Controls(this.renderer, pointed);
    if (this.renderer) this.sights = new Sights(this, pointed);
    this.store.on('scene', () => (document.title = this.store.scene.name ? `${this.store.scene.name} – Swanilda` : 'Swanilda'));
    this.store.on('poses', () => this._frameFirst());
  }

  _key(event, actions) {
    if (event.altKey || event.target.closest?.('input, select, textarea, dialog')) return;
    if ((event.key === ' ' || event.key === 'Enter') && event.target.closest?.('button, summary')) return;
    const name = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const withCtrl = event.ctrlKey || event.metaKey ? 'ctrl+' : '';
    const action = actions.get(`${withCtrl}${event.shiftKey ? 'shift+' : ''}${name}`) ?? (withCtrl ? undefined : actions.get(name));
    if (!action || (event.key.startsWith('Arrow') && !event.target.matches?.('#scene, .second'))) return;
    event.preventDefault();
    action(event);
  }

  get canWrite() {
    return this.source.live && !this.store.scene.readOnly;
  }

  /** A request whose failure the console shows. */
  ask(action, members = {}) {
    const answer = this.source.request(action, members);
    answer.catch((error) => this.console.say('error', error.message));
    return answer;
  }

  /** The scene is in the middle from its first picture. */
  _frameFirst() {
    if (!this.renderer || this.framed || !this.store.objects.size) return;
    this.framed = true;
    this.renderer.fit([], true);
    this.sights.frameFirst();
  }

  /** @param {number} handle @param {boolean} more adds to what is selected, or takes it out */
  select(handle, more) {
    const { selection } = this.store;
    const others = selection.filter((each) => each !== handle);
    const wanted = handle < 0 ? [] : more ? (others.length < selection.length ? others : [...selection, handle]) : [handle];
    this.store.receive({ type: 'update', selection: wanted });
    this.source.request('select', { handles: wanted }).catch(() => {}); // a page that only reads selects for itself
  }

  _clicked(hit, more) {
    if (this.sights.measure.clicked(hit)) return;
    const handle = hit ? this._selectable(hit.handle) : -1;
    if (handle >= 0 || !more) this.select(handle, more);
  }

  /** The object that a click means: its model, if it says so; -1 if it cannot be selected. */
  _selectable(handle) {
    let object = this.store.objects.get(handle);
    if (!object) return -1;
    if (object.modelSelectable) for (let above = object; above; above = this.store.objects.get(above.parent)) if (above.modelBase) return above.handle;
    return object.selectable === false ? -1 : handle;
  }

  _focused(hit) {
    if (hit && hit.handle >= 0) this.fit([hit.handle]);
  }

  /** The view that keys are about. */
  get sight() {
    return this.sights?.view ?? this.renderer;
  }

  fit(handles) {
    this.followed = null;
    this.sight?.fit(handles);
  }

  lookAlong(yaw, pitch) {
    this.sight.camera.turnTo(yaw, pitch);
    this.renderer.stale = true;
  }

  togglePerspective() {
    const { camera } = this.sight;
    camera.release();
    camera.perspective = !camera.perspective;
    this.renderer.stale = true;
  }

  turn(event) {
    const { camera, canvas } = this.sight;
    const [x, y] = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (event.shiftKey) camera.pan(x * 40, y * 40, canvas.clientHeight, camera.distance);
    else camera.orbit(camera.focus, x * 0.1, -y * 0.1);
    this.renderer.stale = true;
  }

  zoom(factor) {
    this.sight.camera.zoom(this.sight.camera.focus, factor);
    this.renderer.stale = true;
  }

  /** The camera goes where an object goes; again, and it stays. */
  follow(handle) {
    const pose = this.store.poses.get(handle);
    if (!pose || this.followed?.handle === handle) return void (this.followed = null);
    this.followed = { handle, position: pose.slice(0, 3) };
    this.overlay.say(`Following ${this.store.objects.get(handle)?.alias}. L ends it.`);
  }

  /** Looks through a camera of the scene; -1: the viewer's own. */
  useCamera(handle) {
    this.throughCamera = handle;
    if (handle < 0) this.renderer.camera.release();
    this.renderer.stale = true;
  }

  /** Cameras that move with objects. */
  _moveCamera() {
    const { camera } = this.renderer;
    if (this.throughCamera >= 0 && !camera.fixed && this.cameraWasFixed) this.throughCamera = -1; // the user has left it
    const [object, pose] = [this.store.objects.get(this.throughCamera), this.store.poses.get(this.throughCamera)];
    if (object && pose) camera.setFixed(pose, object);
    this.cameraWasFixed = !!camera.fixed;
    const place = this.followed && this.store.poses.get(this.followed.handle);
    if (!place) return;
    const by = [0, 1, 2].map((i) => place[i] - this.followed.position[i]);
    camera.eye = camera.eye.map((x, i) => x + by[i]);
    if (camera.motion) camera.motion.to.focus = camera.motion.to.focus.map((x, i) => x + by[i]);
    this.followed.position = place.slice(0, 3);
    if (by.some((x) => x !== 0)) this.renderer.stale = true;
  }

  openScript(handle, line) {
    this.script.open(handle, line);
  }

  /** The script of an object: itself, or the first one below it. */
  openScriptOf(handle) {
    const own = [...this.store.objects.values()].find((object) => object.objectType === 'script' && (object.handle === handle || object.parent === handle));
    if (own) this.openScript(own.handle);
    else if (document.getElementById('script').hidden) this.overlay.say('Select a script, or an object that has one.');
    else this.showPanel('script', false);
  }

  /** @param {string} name @param {boolean} [shown] the other way round if left out */
  showPanel(name, shown) {
    this.layout.show(name, shown);
  }

  search() {
    this.showPanel('side', true);
    this.tree.search.focus();
  }

  toggleTheme() {
    this.layout.toggleTheme();
  }

  escape() {
    if (this.studio.close() || this.layout.closeOverlays() || this.sights?.measure.end()) return;
    this.select(-1, false);
  }

  async showGraph(handle) {
    const { curves = [], xyCurves = [] } = await this.ask('graph', { handle });
    for (const { name, x, y } of [...curves, ...xyCurves]) this.curves.add({ name, x, y });
  }

  /** A value over the whole recording. */
  async showCurve(handle, { name, label }) {
    const title = `${this.store.objects.get(handle)?.alias} ${label}`;
    if (name === 'absolutePose') return this._showPositions(handle, title);
    const read = (message, kind) => (kind === 'text' ? message.objects?.find((object) => object.handle === handle)?.[name] : undefined);
    this.curves.add({ name: title, ...(await this.source.curve(read)) });
  }

  async _showPositions(handle, title) {
    for (const [i, axis] of ['x', 'y', 'z'].entries()) {
      const read = (message, kind) => (kind === 'binary' ? poseIn(message, handle)?.[i] : undefined);
      this.curves.add({ name: `${title} ${axis}`, ...(await this.source.curve(read)) });
    }
  }

  frame(now) {
    const seconds = Math.min((now - (this.before ?? now)) / 1000, 0.25);
    this.before = now;
    if (!this.source.live) this.source.advance(seconds);
    this.store.flush();
    if (this.renderer) {
      this._moveCamera();
      this.sights.advance(seconds);
      if (this.renderer.frame(seconds)) this.views.draw(true), this.sights.measure.place();
      this.overlay.frame();
      this.studio.frame();
    }
    requestAnimationFrame((next) => this.frame(next));
  }
}

async function start() {
  const recording = inlinedRecording() ?? (await servedRecording());
  const store = new Store();
  const source = recording ? new ReplaySource(store, recording) : new LiveSource(store);
  const page = new Page(store, source);
  globalThis.swanilda = page; // for the browser's console, and tests
  source.start();
  requestAnimationFrame((now) => page.frame(now));
}

start();
