// Scripts to read and change: line numbers, colours for Lua, the line of the last error.
import { el, iconButton, setText } from '../dom.js';

const KEYWORDS = new Set('and break do else elseif end false for function goto if in local nil not or repeat return then true until while'.split(' '));
const TOKENS = /(--\[(=*)\[[\s\S]*?(?:\]\2\]|$)|--[^\n]*)|(\[(=*)\[[\s\S]*?(?:\]\4\]|$)|"(?:\\[\s\S]|[^"\\\n])*"?|'(?:\\[\s\S]|[^'\\\n])*'?)|(\b(?:0[xX][\da-fA-F]+|\d+\.?\d*(?:[eE][+-]?\d+)?)\b)|([A-Za-z_]\w*)/g;

/** Pieces of Lua with their kinds. @param {string} code @returns {{kind: string, text: string}[]} */
export function pieces(code) {
  const found = [];
  let at = 0;
  for (const match of code.matchAll(TOKENS)) {
    if (match.index > at) found.push({ kind: '', text: code.slice(at, match.index) });
    const [text, comment, , string, , digits, word] = match;
    const kind = comment ? 'comment' : string ? 'string' : digits ? 'number' : KEYWORDS.has(word) ? 'keyword' : '';
    found.push({ kind, text });
    at = match.index + text.length;
  }
  found.push({ kind: '', text: code.slice(at) });
  return found;
}

/** The pieces by lines. */
function lines(code, isLua) {
  const all = [[]];
  for (const { kind, text } of isLua ? pieces(code) : [{ kind: '', text: code }]) {
    text.split('\n').forEach((part, i) => {
      if (i > 0) all.push([]);
      if (part) all.at(-1).push({ kind, text: part });
    });
  }
  return all;
}

export class ScriptPane {
  constructor(pane, page) {
    Object.assign(this, { page });
    this.title = el('h3', { class: 'inspected' });
    this.error = el('p', { class: 'script-error', role: 'status', hidden: true });
    this.code = el('div', { class: 'code', tabindex: 0, role: 'region', 'aria-label': 'Text of the script' });
    this.edit = iconButton('edit', 'Change the text', () => this._change(true));
    this.text = el('textarea', { class: 'code mono', 'aria-label': 'New text of the script', spellcheck: 'false' });
    this.restart = el('button', { type: 'button', class: 'answer-button', title: 'The script begins anew with this text', onclick: () => this._restart() }, 'Restart with this text');
    const cancel = el('button', { type: 'button', class: 'answer-button', onclick: () => this._change(false) }, 'Cancel');
    this.editing = el('div', { class: 'script-editing', hidden: true }, this.text, el('div', { class: 'question-buttons' }, this.restart, cancel));
    pane.append(el('div', { class: 'inspected-head' }, this.title, this.edit), this.error, this.code, this.editing);
    page.store.on('scene', () => this._showPermission());
    page.store.on('objects', (changed) => changed.has(this.handle) && this._showError());
  }

  /** @param {number} handle @param {number} [line] to show; otherwise that of the last error */
  async open(handle, line) {
    this.handle = handle;
    this._change(false);
    this._showPermission();
    this.page.showPanel('script', true);
    setText(this.title, this.page.store.path(handle));
    const script = await this.page.source.request('script', { handle }).catch((error) => ({ text: '', failure: error.message }));
    if (handle !== this.handle) return;
    this.source = script.text;
    const rows = lines(script.text ?? '', (script.language ?? 'lua') === 'lua').map((parts, i) => this._line(parts, i + 1));
    this.code.replaceChildren(...rows);
    if (script.failure) this.code.replaceChildren(el('p', { class: 'hint' }, script.failure));
    this._showError();
    this._reveal(line ?? this.page.store.objects.get(handle)?.error?.line);
  }

  /** Texts can be changed where pages may change something. */
  _showPermission() {
    this.edit.hidden = !this.page.canWrite || !this.editing.hidden;
    this.restart.disabled = !this.page.canWrite;
  }

  /** Shows the text to read, or to change. @param {boolean} on */
  _change(on) {
    this.code.hidden = on;
    this.editing.hidden = !on;
    this._showPermission();
    if (!on) return;
    this.text.value = this.source ?? '';
    this.text.focus();
  }

  async _restart() {
    const { handle } = this;
    await this.page.ask('set', { handle, name: 'code', value: this.text.value });
    await this.page.ask('run', { code: `sim.initScript(${handle})` });
    if (handle === this.handle) this.open(handle);
  }

  _line(parts, number) {
    const text = parts.map(({ kind, text }) => (kind ? el('span', { class: `lua-${kind}` }, text) : text));
    return el('div', { class: 'code-line', 'data-line': number }, el('span', { class: 'line-number', 'aria-hidden': 'true' }, number), el('code', {}, ...text));
  }

  _showError() {
    const error = this.page.store.objects.get(this.handle)?.error;
    this.error.hidden = !error;
    setText(this.error, error ? `Line ${error.line ?? '?'}: ${error.message}` : '');
    for (const row of this.code.querySelectorAll('.wrong')) row.classList.remove('wrong');
    if (error?.line) this.code.children[error.line - 1]?.classList.add('wrong');
  }

  _reveal(line) {
    const row = line && this.code.children[line - 1];
    if (!row) return void (this.code.scrollTop = 0);
    row.classList.add('shown');
    row.scrollIntoView({ block: 'center' });
  }
}
