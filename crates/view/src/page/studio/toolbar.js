// The tools over the scene: select, move, turn; the frame of drags; add, undo, redo, open, save.
import { el, iconButton } from '../dom.js';
import { AUTHOR, remember, setting } from '../settings.js';

const TOOLS = [['select', 'select', 'Select (Q)'], ['move', 'move', 'Move (M); while the simulation runs: pull'], ['turn', 'turn', 'Turn (R); while the simulation runs: pull']];
const FRAMES = [['world', 'World'], ['parent', 'Parent'], ['own', 'Own']];

/** What tools do; kept between visits, but for the tool. */
export function toolOptions() {
  return { tool: 'select', frame: setting('gizmo frame', 'world'), snap: setting('gizmo snap', false) };
}

export class Toolbar {
  /** @param {any} studio */
  constructor(studio) {
    Object.assign(this, { studio, page: studio.page, store: studio.page.store, options: studio.options });
    this.tools = new Map(TOOLS.map(([name, sign, title]) => [name, iconButton(sign, title, () => this.choose(name), { class: 'icon-button toggle', 'aria-pressed': 'false' })]));
    this.frame = el('select', { 'aria-label': 'Axes of moves', title: 'Axes that moves go along', onchange: () => this._setFrame(this.frame.value) }, ...FRAMES.map(([value, text]) => el('option', { value }, text)));
    this.frame.value = this.options.frame;
    this.snap = iconButton('snap', 'Steps of 5 cm and 15° (Ctrl: the other way round)', () => this._toggleSnap(), { class: 'icon-button toggle', 'aria-pressed': String(this.options.snap) });
    this.add = iconButton('add', 'Add an object (A)', () => studio.addMenu.toggle(), { 'aria-haspopup': 'menu', 'aria-expanded': 'false' });
    this.undo = iconButton('undo', 'Undo', () => studio.edits.back('undo'));
    this.redo = iconButton('undo', 'Redo', () => studio.edits.back('redo'), { class: 'icon-button mirrored' });
    this.open = iconButton('open', 'Open files, or drop them on the scene (Ctrl+O)', () => studio.files.choose());
    this.save = iconButton('save', 'Save (Ctrl+S)', () => studio.files.save());
    this.element = el('div', { class: 'toolbar', role: 'toolbar', 'aria-label': 'Tools' }, ...this.tools.values(), this.frame, this.snap, el('span', { class: 'toolbar-gap' }), this.add, this.undo, this.redo, this.open, this.save);
    this.choose(this.options.tool);
    for (const topic of ['scene', 'selection']) this.store.on(topic, () => this.update());
    this.update();
  }

  choose(tool) {
    this.options.tool = tool;
    for (const [name, button] of this.tools) button.setAttribute('aria-pressed', String(name === tool));
    this.frame.hidden = this.snap.hidden = tool === 'select';
    if (this.page.renderer) this.page.renderer.stale = true;
  }

  _setFrame(frame) {
    remember('gizmo frame', (this.options.frame = frame));
    this.page.renderer.stale = true;
  }

  _toggleSnap() {
    remember('gizmo snap', (this.options.snap = !this.options.snap));
    this.snap.setAttribute('aria-pressed', String(this.options.snap));
  }

  update() {
    const { scene } = this.store;
    const { possible, stopped } = this.studio.edits;
    this.element.hidden = !possible;
    describe(this.undo, 'Undo', named(scene.undo, scene.undoBy), scene.noUndo, 'Ctrl+Z', stopped);
    describe(this.redo, 'Redo', named(scene.redo, scene.redoBy), null, 'Ctrl+Shift+Z', stopped);
    this.save.classList.toggle('unsaved', scene.changes > 0);
    for (const button of [this.open, this.save]) button.disabled = !stopped;
  }
}

/** What another page has done is named so. */
const named = (label, author) => (label && author !== AUTHOR ? `${label}, of another page` : label);

function describe(button, what, label, refusal, key, stopped) {
  button.disabled = !label || !stopped;
  const why = refusal ? `There is no undo: ${refusal}` : `Nothing to ${what.toLowerCase()}`;
  button.title = label ? `${what}: ${label} (${key})` : why;
  button.setAttribute('aria-label', button.title);
}
