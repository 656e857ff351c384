// Scripts to read and change: line numbers, colours for Lua, the line of the last error.
import { el, iconButton, setText } from '../../dom.js';
import { codeRows } from './code_lines.js';
import { ScriptEditing } from './editing.js';

export class ScriptPane {
  constructor(pane, page) {
    Object.assign(this, { page });
    this.title = el('h3', { class: 'inspected' });
    this.error = el('p', { class: 'script-error', role: 'status', hidden: true });
    this.code = el('div', { class: 'code', tabindex: 0, role: 'region', 'aria-label': 'Text of the script' });
    this.edit = iconButton('edit', 'Change the text', () => this._change());
    this.editing = new ScriptEditing(page, { changed: () => this._showTitle(), closed: () => this._load() });
    pane.append(el('div', { class: 'inspected-head' }, this.title, this.edit), this.error, this.code, this.editing.element);
    page.store.on('scene', () => this._showPermission());
    page.store.on('objects', (changed) => changed.has(this.handle) && this._changed());
  }

  /** @param {number} handle @param {number} [line] to show; otherwise that of the last error */
  async open(handle, line) {
    this.page.showPanel('script', true);
    if (handle === this.handle && this.editing.draft) return void (line && this.editing.editor?.reveal(line));
    this.editing.end();
    this.handle = handle;
    await this._load(line);
  }

  /** Shows the script as it is now, or the text of it that is not saved. */
  async _load(line) {
    const { handle } = this;
    this.script = null; // until it is here, nothing can be changed
    this._showPermission();
    this._showTitle();
    const script = await this.page.source.request('script', { handle }).catch((error) => ({ text: '', failure: error.message }));
    if (handle !== this.handle || this.editing.draft) return;
    this.script = script.failure ? null : { ...script, handle };
    if (this.script && this.page.canWrite && this.editing.has(handle)) return this._change(line);
    this._read(script, line);
  }

  /** Shows the text to read. */
  _read(script, line) {
    this.code.hidden = false;
    this.code.replaceChildren(...(script.failure ? [el('p', { class: 'hint' }, script.failure)] : codeRows(script.text, script.language)));
    this._showPermission();
    this._showError();
    this._reveal(line ?? this.page.store.objects.get(this.handle)?.error?.line);
  }

  /** Shows the text to change. */
  _change(line) {
    this.code.hidden = true;
    this.edit.hidden = true;
    this._showError();
    this.editing.begin(this.script, line);
  }

  /** The script is another one now, or has got an error. */
  _changed() {
    this._showError();
    const version = this.page.store.objects.get(this.handle)?.version;
    if (this.editing.draft) this.editing.scriptChanged();
    else if (version && this.script && version !== this.script.version) this._load();
  }

  _showTitle() {
    const isChanged = this.editing.hasChanges;
    setText(this.title, (isChanged ? '● ' : '') + this.page.store.path(this.handle));
    this.title.title = isChanged ? 'Not saved' : '';
  }

  /** Texts can be changed where pages may change something. */
  _showPermission() {
    this.edit.hidden = !this.page.canWrite || !this.script || !!this.editing.draft;
    this.editing.showPermission();
  }

  _showError() {
    const error = this.page.store.objects.get(this.handle)?.error;
    this.error.hidden = !error;
    setText(this.error, error ? `Line ${error.line ?? '?'}: ${error.message}` : '');
    for (const row of this.code.querySelectorAll('.wrong')) row.classList.remove('wrong');
    if (error?.line) this.code.children[error.line - 1]?.classList.add('wrong');
    if (this.editing.draft) this.editing.showError();
  }

  _reveal(line) {
    const row = line && this.code.children[line - 1];
    if (!row) return void (this.code.scrollTop = 0);
    row.classList.add('shown');
    row.scrollIntoView({ block: 'center' });
  }
}
