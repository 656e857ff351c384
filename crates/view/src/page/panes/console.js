// The console: one line per message, filtered as you type; a line for Lua below it.
import { el } from '../dom.js';

const SHOWN = 1000; // lines at a time
const LEVELS = [['all', 'Everything'], ['info', 'Information'], ['warning', 'Warnings'], ['error', 'Errors'], ['print', 'Printed']];

/** @returns {'error'|'warning'|'print'|'debug'|'info'} what the name of a level amounts to */
export function kindOf(level) {
  if (/error|critical/.test(level)) return 'error';
  if (/warn/.test(level)) return 'warning';
  if (/debug|trace/.test(level)) return 'debug';
  return level === 'print' ? 'print' : 'info';
}

export class ConsolePane {
  constructor(pane, page) {
    Object.assign(this, { page, store: page.store });
    this.filter = el('input', { type: 'search', placeholder: 'Filter', 'aria-label': 'Filter the console', oninput: () => this._rebuild() });
    const options = LEVELS.map(([value, text]) => el('option', { value }, text));
    this.level = el('select', { 'aria-label': 'Level', onchange: () => this._rebuild() }, ...options);
    this.lines = el('div', { class: 'console-lines', role: 'log', 'aria-label': 'Console', tabindex: 0 });
    this.empty = el('p', { class: 'hint' }, 'Nothing was logged yet. What scripts print appears here.');
    this.history = [];
    this.input = el('input', { type: 'text', class: 'mono', placeholder: 'Lua', 'aria-label': 'Run Lua', spellcheck: 'false', autocomplete: 'off', onkeydown: (event) => this._key(event) });
    this.entry = el('div', { class: 'console-input' }, el('span', { 'aria-hidden': 'true' }, '>'), this.input);
    this.entry.hidden = !page.source.live;
    pane.append(el('div', { class: 'pane-tools' }, this.level, this.filter), this.lines, this.empty, this.entry);
    this.first = undefined;
    this.count = 0;
    this.store.on('log', () => this._update());
    this.store.on('scene', () => (this.input.disabled = !page.canWrite));
  }

  _wanted(line) {
    const level = this.level.value;
    const text = this.filter.value.trim().toLowerCase();
    if (level !== 'all' && kindOf(line.level) !== level && !(level === 'warning' && kindOf(line.level) === 'error')) return false;
    return !text || `${line.origin} ${line.text}`.toLowerCase().includes(text);
  }

  _rebuild() {
    this.lines.replaceChildren();
    this.count = 0;
    this._update();
  }

  /** Appends what is new; in recordings lines may also go. */
  _update() {
    const { log } = this.store;
    const dropped = this.store.loggedLines - log.length;
    if (this.first !== log[0] && dropped === 0) this.lines.replaceChildren(), (this.count = 0);
    this.first = log[0];
    if (this.store.loggedLines < this.count) return this._takeBack();
    const atEnd = this.lines.scrollHeight - this.lines.scrollTop - this.lines.clientHeight < 30;
    const fresh = log.slice(Math.max(this.count - dropped, log.length - 3 * SHOWN, 0)).filter((line) => this._wanted(line)).slice(-SHOWN);
    this.count = this.store.loggedLines;
    if (fresh.length) this.lines.append(...fresh.map((line) => this._line(line)));
    while (this.lines.childElementCount > SHOWN) this.lines.firstChild.remove();
    if (atEnd) this.lines.scrollTop = this.lines.scrollHeight;
    this.empty.hidden = this.lines.childElementCount > 0;
  }

  _takeBack() {
    this.count = 0;
    this.lines.replaceChildren();
    this._update();
    this.lines.scrollTop = this.lines.scrollHeight;
  }

  _line({ time, level, origin, handle, text, line }) {
    const kind = kindOf(level);
    const known = handle !== undefined && handle !== null && this.store.objects.has(handle);
    const name = known
      ? el('button', { type: 'button', class: 'link', title: line ? `Open the script at line ${line}` : 'Select', onclick: () => this._open(handle, line) }, origin)
      : el('span', { class: 'origin' }, origin ?? '');
    return el('div', { class: `line ${kind}` },
      el('span', { class: 'time' }, (time ?? 0).toFixed(3)),
      el('span', { class: 'letter', title: level }, { error: 'E', warning: 'W', info: 'I', debug: 'D', print: ' ' }[kind]),
      name, el('span', { class: 'text' }, text));
  }

  _open(handle, line) {
    this.page.select(handle, false);
    if (this.store.objects.get(handle)?.objectType === 'script') this.page.openScript(handle, line);
  }

  /** Notes something of the page itself. */
  say(level, text) {
    this.store.receive({ type: 'update', log: [{ time: this.store.scene.time ?? 0, level, origin: 'viewer', text }] });
  }

  _key(event) {
    event.stopPropagation();
    if (event.key === 'ArrowUp' || event.key === 'ArrowDown') return this._recall(event.key === 'ArrowUp' ? -1 : 1, event);
    const code = this.input.value.trim();
    if (event.key !== 'Enter' || !code) return;
    this.history.push(code);
    this.recalled = this.history.length;
    this.input.value = '';
    this.say('print', `> ${code}`);
    this._run(code).catch((error) => this.say('error', error.message));
  }

  /** What it prints is in the log; while code stands still, it is about that. */
  async _run(code) {
    if (!this.store.stopped) return void (await this.page.source.request('run', { code }));
    this.say('print', await this.page.script.debugging.evaluate(code));
  }

  _recall(by, event) {
    event.preventDefault();
    this.recalled = Math.min(Math.max((this.recalled ?? this.history.length) + by, 0), this.history.length);
    this.input.value = this.history[this.recalled] ?? '';
  }
}
