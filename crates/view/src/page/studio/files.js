// Files: dropped on the page or chosen, loaded into the scene; and the dialog that saves.
import { el, setText } from '../dom.js';
import { confirmed } from './confirm.js';

const PIECE = 3 << 20; // bytes of a file in one request
const SCENES = ['ttt', 'ttm', 'xml', 'urdf', 'sdf', 'world', 'glb', 'gltf', 'stl', 'obj', 'dae', 'ply', '3ds', 'dxf', 'lua'];

const ending = (name) => name.split('.').pop().toLowerCase();

export class Files {
  /** @param {any} page @param {import('./edits.js').Edits} edits */
  constructor(page, edits) {
    Object.assign(this, { page, edits, store: page.store });
    this.input = el('input', { type: 'file', multiple: true, hidden: true, 'aria-label': 'Files to load', onchange: () => this._load([...this.input.files].map((file) => [file.name, file])) });
    const stage = document.getElementById('stage');
    stage.append(this.input);
    stage.addEventListener('dragover', (event) => this._over(event));
    stage.addEventListener('drop', (event) => this._dropped(event));
    this._dialog();
  }

  choose() {
    this.input.value = '';
    this.input.click();
  }

  _over(event) {
    if ([...event.dataTransfer.types].includes('Files') && this.edits.possible) event.preventDefault();
  }

  async _dropped(event) {
    if (!event.dataTransfer.files.length || !this.edits.possible) return;
    event.preventDefault();
    const { renderer } = this.page;
    const box = renderer?.canvas.getBoundingClientRect();
    const place = renderer?.pointAt(event.clientX - box.left, event.clientY - box.top);
    const entries = [...event.dataTransfer.items].map((item) => item.webkitGetAsEntry?.()).filter(Boolean);
    const plain = [...event.dataTransfer.files].map((file) => [file.name, file]);
    this._load(entries.some((entry) => entry.isDirectory) ? (await Promise.all(entries.map((entry) => walk(entry)))).flat() : plain, place);
  }

  /** The file that is meant among those that came together: the one that may name the others. */
  _main(files) {
    const rank = ([name]) => SCENES.indexOf(ending(name));
    const known = files.filter((file) => rank(file) >= 0);
    return known.sort((a, b) => rank(a) - rank(b) || a[0].split('/').length - b[0].split('/').length)[0]?.[0];
  }

  async _load(files, place = null) {
    const main = this._main(files);
    if (!main) return this.page.overlay.say('None of these files is a scene, a model, a robot or a mesh.');
    if (ending(main) === 'ttt' && this.store.scene.changes > 0 && !(await confirmed(`${main} takes the place of this scene, with changes that are not saved. Undo brings it back.`, 'Load it'))) return;
    this.page.overlay.say(`Loading ${main} …`);
    try {
      for (const [name, file] of files) await this._send(name, file);
      const done = await this.page.ask('load', { main, position: place && [place[0], place[1], 0] });
      this.page.overlay.say(`Loaded ${main}.`);
      if (done.messages) this.page.console.say('warning', `${main}: ${done.messages}`);
      this.page.fit(done.selection ?? []);
    } catch (error) {
      this.page.overlay.say(error.message);
    }
  }

  async _send(name, file) {
    const bytes = new Uint8Array(await file.arrayBuffer());
    for (let at = 0; at === 0 || at < bytes.length; at += PIECE) await this.page.ask('upload', { name, data: base64(bytes.subarray(at, at + PIECE)) });
  }

  _dialog() {
    this.path = el('input', { type: 'text', name: 'path', spellcheck: 'false', 'aria-describedby': 'save-hint' });
    this.problem = el('p', { class: 'save-problem', role: 'status' });
    this.changes = el('pre', { class: 'save-changes', tabindex: 0, 'aria-label': 'What was changed' });
    this.confirm = el('button', { type: 'submit', class: 'answer-button' }, 'Save');
    const cancel = el('button', { type: 'button', class: 'answer-button', onclick: () => this.dialog.close() }, 'Cancel');
    const hint = el('p', { id: 'save-hint', class: 'answer' }, 'On the machine of the simulator, from the folder of the scene. .ttt, .simscene.xml, .glb, .gltf; without an ending a folder for version control.');
    const form = el('form', { method: 'dialog', onsubmit: (event) => this._submit(event) }, el('label', {}, 'File', this.path), hint, this.problem, el('details', {}, el('summary', {}, 'What was changed since it was loaded or saved'), this.changes), el('div', { class: 'question-buttons' }, this.confirm, cancel));
    this.title = el('h2', { id: 'save-title' });
    this.dialog = el('dialog', { class: 'modal save', 'aria-labelledby': 'save-title' }, this.title, form);
    this.dialog.addEventListener('keydown', (event) => event.stopPropagation());
    this.path.addEventListener('input', () => this._reset());
    document.body.append(this.dialog);
  }

  _reset() {
    this.overwrite = false;
    setText(this.problem, '');
    setText(this.confirm, 'Save');
  }

  /** Asks where to, the scene or a model. @param {number | null} [model] the base */
  async save(model = null) {
    if (!this.edits.possible || !this.edits.stopped) return this.page.overlay.say('Stop the simulation before you save.');
    this.model = model;
    const { scene, objects } = this.store;
    setText(this.title, model === null ? 'Save the scene' : `Save the model ${objects.get(model)?.alias}`);
    this.path.value = model === null ? asScene(scene.path) : `${objects.get(model)?.alias}.ttm`;
    this._reset();
    this.dialog.showModal();
    this.path.select();
    const { text } = await this.page.source.request('changes', {}).catch((error) => ({ text: error.message }));
    setText(this.changes, text || 'Nothing.');
  }

  async _submit(event) {
    event.preventDefault();
    const request = { path: this.path.value, model: this.model, overwrite: !!this.overwrite };
    const done = await this.page.source.request('save', request).catch((error) => setText(this.problem, error.message));
    if (!done) return;
    if (done.exists) {
      setText(this.problem, `${done.path} is there already.`);
      setText(this.confirm, 'Replace it');
      this.overwrite = true;
      return;
    }
    this.dialog.close();
    this.page.overlay.say(`Saved ${done.path}`);
  }
}

/** Scripts and robots that became a scene are saved beside their files. */
function asScene(path) {
  if (!path) return 'scene.ttt';
  return /\.(ttt|xml)$/i.test(path) ? path : `${path.replace(/\.[^./]*$/, '')}.ttt`;
}

function base64(bytes) {
  let text = '';
  for (let at = 0; at < bytes.length; at += 0x8000) text += String.fromCharCode(...bytes.subarray(at, at + 0x8000));
  return btoa(text);
}

/** Files of a folder that was dropped, with their paths. */
async function walk(entry) {
  if (entry.isFile) return [[entry.fullPath.replace(/^\//, ''), await new Promise((done, failed) => entry.file(done, failed))]];
  const reader = entry.createReader();
  const all = [];
  for (;;) {
    const some = await new Promise((done, failed) => reader.readEntries(done, failed));
    if (!some.length) break;
    all.push(...some);
  }
  return (await Promise.all(all.map((each) => walk(each)))).flat();
}
