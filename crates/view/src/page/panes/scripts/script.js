// Scripts to read and change: line numbers, colours for Lua, the line of the last error.
import { el, iconButton, setText } from '../../dom.js';
import { codeRows } from './code_lines.js';
import { Debugging } from './debugging.js';
import { ScriptEditing } from './editing.js';

export class ScriptPane {
  constructor(pane, page) {
    Object.assign(this, { page });
    this.title = el('h2', { class: 'inspected' });
    this.error = el('p', { class: 'script-error', role: 'status', hidden: true });
    this.code = el('div', { class: 'code', tabindex: 0, role: 'region', 'aria-label': 'Text of the script' });
    this.edit = iconButton('edit', 'Change the text', () => this._change());
    this.debugging = new Debugging(page, this);
    this.editing = new ScriptEditing(page, this.debugging, { changed: () => this._showTitle(), opened: () => this.showStop(), closed: () => this._load() });
    pane.append(el('div', { class: 'inspected-head' }, this.title, this.edit), this.error, this.debugging.element, this.code, this.editing.element);
    this.code.addEventListener('click', (event) => this._pressed(event));
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

  /** A text that is no script's, to read. */
  openText(title, text, line) {
    this.editing.end();
    Object.assign(this, { handle: null, script: null });
    setText(this.title, title);
    this._read({ text }, line);
  }

  /** A click on the number of a line. */
  _pressed({ target }) {
    const row = target.closest('.line-number')?.parentElement;
    if (row && this.script && this.debugging.possible(this.script.language)) this.debugging.toggle(this.handle, Number(row.dataset.line));
  }

  /** Marks the lines of the script that have breakpoints. */
  showBreakpoints() {
    this.code.classList.toggle('debugged', !!this.script && this.debugging.possible(this.script.language));
    for (const row of this.code.querySelectorAll('.breakpoint')) row.classList.remove('breakpoint', 'waiting', 'conditional');
    for (const { line, at, condition } of this.debugging.of(this.handle)) this.code.children[(at ?? line) - 1]?.classList.add('breakpoint', ...(at === null ? ['waiting'] : []), ...(condition ? ['conditional'] : []));
    this.editing.showBreakpoints();
  }

  /** Marks the line that is about to run. */
  showStop() {
    const { mark } = this.debugging;
    const isHere = mark && (mark.handle === null ? mark.path === this.title.textContent : mark.handle === this.handle);
    for (const row of this.code.querySelectorAll('.stopped')) row.classList.remove('stopped');
    if (isHere) this.code.children[mark.line - 1]?.classList.add('stopped');
    this.editing.editor?.showStop(isHere ? mark.line : null);
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
    this.showBreakpoints();
    this.showStop();
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
