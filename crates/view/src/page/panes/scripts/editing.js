// A script that is changed: the editor, texts that are not saved, and what to do when the text has changed elsewhere meanwhile.
import { el, setText } from '../../dom.js';
import { codeRows } from './code_lines.js';
import { PlainEditor } from './plain_editor.js';

/** @typedef {{key: string, handle: number, language: string, text: string, original: string, version: string, kept: any}} Draft `original` is the text of `version` */

let component = null;

/** Makes editors; the component is loaded when a script is changed first. @returns {Promise<function(any): any>} */
function loaded() {
  const plain = (options) => new PlainEditor(options);
  component ??= import(String(new URL('editor/editor.js', document.baseURI))).then(({ makeEditor }) => makeEditor ?? plain, plain);
  return component;
}

/** The browser asks before it leaves the page. */
const askBefore = (event) => event.preventDefault();

const isChanged = (draft) => !!draft && draft.text !== draft.original;

export class ScriptEditing {
  /** @param {any} page @param {import('./debugging.js').Debugging} debugging @param {{changed: () => void, opened: () => void, closed: () => void}} calls */
  constructor(page, debugging, calls) {
    Object.assign(this, { page, debugging, calls, draft: null, editor: null });
    /** @type {Map<string, Draft>} */
    this.drafts = new Map();
    const button = (text, title, onclick) => el('button', { type: 'button', class: 'answer-button', title, onclick }, text);
    this.place = el('div', { class: 'script-editor' });
    this.saveButton = button('Save and restart', 'The script begins anew with this text (Ctrl+S)', () => this.save());
    this.closeButton = button('Close', 'Back to reading', () => this.discard());
    this.status = el('span', { class: 'script-status', role: 'status' });
    this.conflict = el('div', { class: 'script-conflict', role: 'alert', hidden: true });
    this.element = el('div', { class: 'script-editing', hidden: true }, this.conflict, this.place, el('div', { class: 'question-buttons' }, this.status, this.closeButton, this.saveButton));
    this.element.addEventListener('keydown', (event) => event.stopPropagation()); // keys of the page are letters here
  }

  get hasChanges() {
    return isChanged(this.draft);
  }

  /** Another scene may have another script with the same handle. */
  _key(handle) {
    return `${handle} ${this.page.store.objects.get(handle)?.uid}`;
  }

  /** Whether there is an unsaved text of a script. */
  has(handle) {
    return this.drafts.has(this._key(handle));
  }

  /** Edits a script as the simulator has it, or the unsaved text. @param {{handle: number, text: string, version: string, language: string}} script @param {number} [line] */
  async begin(script, line) {
    const key = this._key(script.handle);
    const draft = this.drafts.get(key) ?? { ...script, key, original: script.text, kept: null };
    this.draft = draft;
    this.element.hidden = false;
    this._showConflict(null);
    setText(this.status, '');
    const make = await loaded();
    if (this.draft !== draft) return;
    const { language, text, kept } = draft;
    const check = (code) => this.page.source.request('check', { code, language });
    const onBreakpoints = this.debugging.possible(language) ? (all) => this._setBreakpoints(all) : null;
    this.editor = make({ parent: this.place, text, kept, language, label: 'Text of the script', check, onBreakpoints, onChange: (text) => this._typed(text), onSave: () => this.save() });
    this.editor.showBreakpoints(draft.breakpoints ?? this.debugging.of(draft.handle));
    this.showPermission();
    this.showError();
    if (line) this.editor.reveal(line);
    this.editor.focus();
    this._mark();
    this.calls.opened();
    this._meet(script);
  }

  /** Leaves the editor; a text that is not saved is kept. */
  end() {
    const { draft, editor } = this;
    if (draft && isChanged(draft)) this.drafts.set(draft.key, { ...draft, kept: editor?.keep() ?? null, breakpoints: editor?.breakpoints() });
    else if (draft) this.drafts.delete(draft.key);
    editor?.destroy();
    Object.assign(this, { draft: null, editor: null });
    this.element.hidden = true;
    this._guard();
  }

  /** Those of an unsaved text count when it is saved: the lines of the script are others until then. */
  _setBreakpoints(all) {
    if (this.hasChanges) setText(this.status, 'Breakpoints count when the text is saved');
    else this.debugging.set(this.draft.handle, all);
  }

  /** As the simulator has them. */
  showBreakpoints() {
    if (this.editor && !this.hasChanges) this.editor.showBreakpoints(this.debugging.of(this.draft.handle));
  }

  /** Breakpoints have moved with their lines. */
  async _moveBreakpoints(handle) {
    const now = this.editor?.breakpoints();
    const lines = (all) => all.map(({ line, at, condition }) => `${at ?? line} ${condition ?? ''}`).join();
    if (now && lines(now) !== lines(this.debugging.of(handle))) await this.debugging.set(handle, now).catch(() => {});
  }

  discard() {
    if (this.draft) this.draft.text = this.draft.original;
    this.end();
    this.calls.closed();
  }

  showPermission() {
    this.saveButton.disabled = !this.page.canWrite;
  }

  showError() {
    this.editor?.showError(this.page.store.objects.get(this.draft.handle)?.error ?? null);
  }

  _typed(text) {
    this.draft.text = text;
    setText(this.status, '');
    this._mark();
  }

  _mark() {
    setText(this.closeButton, this.hasChanges ? 'Discard' : 'Close');
    this._guard();
    this.calls.changed();
  }

  /** Pages with nothing to lose are left without a word. */
  _guard() {
    const isUnsaved = this.hasChanges || [...this.drafts.values()].some(isChanged);
    if (isUnsaved) addEventListener('beforeunload', askBefore);
    else removeEventListener('beforeunload', askBefore);
  }

  async save() {
    const { draft } = this;
    if (!draft || !this.page.canWrite || this.saving) return;
    const { handle, text, version } = draft;
    this.saving = true;
    await this._moveBreakpoints(handle);
    const reply = await this.page.ask('saveScript', { handle, text, version }).catch(() => null);
    this.saving = false;
    if (!reply) return;
    if (reply.saved) Object.assign(draft, { version: reply.version, original: text });
    if (draft !== this.draft) return;
    if (reply.saved) setText(this.status, 'Saved');
    this._mark();
    if (reply.saved) this.scriptChanged();
    else this._meet(reply);
  }

  /** The text of the script may be another one now. */
  async scriptChanged() {
    const { draft } = this;
    const version = draft && this.page.store.objects.get(draft.handle)?.version;
    if (!version || this.saving || version === draft.version) return;
    const script = await this.page.source.request('script', { handle: draft.handle }).catch(() => null);
    if (script && draft === this.draft && !this.saving) this._meet(script);
  }

  /** What the simulator has beside what is edited. */
  _meet(theirs) {
    const { draft } = this;
    if (theirs.version === draft.version) return;
    if (theirs.text === draft.text) Object.assign(draft, { version: theirs.version, original: theirs.text }), this._mark();
    else if (isChanged(draft)) this._showConflict(theirs);
    else this._take(theirs);
  }

  _take({ text, version }) {
    Object.assign(this.draft, { version, original: text });
    this._showConflict(null);
    this.editor.setText(text);
    setText(this.status, 'Changed elsewhere');
  }

  _keepMine({ text, version }) {
    Object.assign(this.draft, { version, original: text });
    this._showConflict(null);
    this.save();
  }

  /** Their text, with the lines marked that mine does not have. */
  _showConflict(theirs) {
    this.conflict.hidden = !theirs;
    if (!theirs) return void this.conflict.replaceChildren();
    const mine = new Set(this.draft.text.split('\n'));
    const rows = codeRows(theirs.text, theirs.language ?? this.draft.language);
    theirs.text.split('\n').forEach((line, i) => mine.has(line) || rows[i].classList.add('other'));
    const button = (text, title, onclick) => el('button', { type: 'button', class: 'answer-button', title, onclick }, text);
    this.conflict.replaceChildren(
      el('p', {}, 'The text was changed elsewhere since you began. This is theirs, yours is below:'),
      el('div', { class: 'code', tabindex: 0, role: 'region', 'aria-label': 'Their text' }, ...rows),
      el('div', { class: 'question-buttons' }, button('Take theirs', 'Undo brings yours back', () => this._take(theirs)), button('Keep mine', 'Saves your text in place of theirs', () => this._keepMine(theirs))));
  }
}
