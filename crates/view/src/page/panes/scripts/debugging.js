// Code that stands still: where, with which variables, and how it goes on. Breakpoints are those of all pages.
import { el, iconButton, setText } from '../../dom.js';
import { Variables } from './variables.js';

const STEPS = [['continue', 'play', 'Go on (F8)', 'F8'], ['next', 'stepOver', 'Over this line (F10)', 'F10'], ['stepIn', 'stepInto', 'Into the function (F11)', 'F11'], ['stepOut', 'stepOut', 'Out of the function (Shift+F11)', 'shift+F11']];
const REASONS = { breakpoint: 'at a breakpoint', 'function breakpoint': 'at a breakpoint', step: 'after a step', pause: 'by a debugger', exception: 'at an error', 'data breakpoint': 'at a change' };

/** @typedef {{line: number, condition?: string | null, at?: number | null}} Breakpoint `at` is where it stops, null while its text is not loaded */

/** Where everything stands still, in words. @param {any} stopped @param {any} store */
export function sentenceOf({ handle, isOwn, title, line, reason, text }, store) {
  const name = isOwn && store.objects.has(handle) ? store.path(handle) : title?.split('/').pop();
  const place = name ? ` in ${name}, line ${line}` : '';
  return `Stopped ${REASONS[reason] ?? ''}${place}.${text ? ` ${text}` : ''}`;
}

export class Debugging {
  /** @param {any} page @param {import('./script.js').ScriptPane} pane */
  constructor(page, pane) {
    Object.assign(this, { page, pane, store: page.store, mine: false, frames: [] });
    this.variables = new Variables((command, members) => this._ask(command, members));
    this.where = el('p', { class: 'debug-where', role: 'status' });
    this.stack = el('select', { 'aria-label': 'Function that runs', onchange: () => this._choose(this.frames[this.stack.selectedIndex]) });
    const steps = STEPS.map(([command, sign, title]) => iconButton(sign, title, () => this.go(command)));
    this.element = el('div', { class: 'debug', role: 'region', 'aria-label': 'Debugger', hidden: true }, this.where, el('div', { class: 'debug-tools', role: 'toolbar', 'aria-label': 'Steps' }, ...steps, this.stack), this.variables.element);
    const button = (text, onclick) => el('button', { type: 'button', class: 'answer-button', onclick }, text);
    this.buttons = el('span', { hidden: true }, button('Show', () => this._follow()), button('Go on', () => this.go('continue')));
    this.store.on('stopped', () => this._stopped());
    this.store.on('breakpoints', () => this.pane.showBreakpoints());
    addEventListener('keydown', (event) => this._key(event), true);
  }

  /** Whether this page can debug a script. @param {string} [language] */
  possible(language = 'lua') {
    return this.page.canWrite && !!this.store.scene.debugger && language === 'lua';
  }

  /** @returns {Breakpoint[]} those of a script */
  of(handle) {
    return this.store.breakpoints.find((script) => script.handle === handle)?.lines ?? [];
  }

  /** @param {number} handle of a script @param {Breakpoint[]} breakpoints in place of those before */
  set(handle, breakpoints) {
    this.mine = true;
    const wanted = breakpoints.map(({ line, condition }) => ({ line, condition }));
    return this.page.ask('breakpoints', { handle, breakpoints: wanted });
  }

  /** Sets the breakpoint of a line, or takes it away. */
  toggle(handle, line) {
    const all = this.of(handle);
    const others = all.filter((each) => (each.at ?? each.line) !== line);
    this.set(handle, others.length < all.length ? others : [...all, { line }]);
  }

  _ask(command, members = {}) {
    return this.page.source.request('debug', { command, arguments: members });
  }

  /** Lets the code go on. */
  go(command) {
    if (!this.store.stopped || !this.possible()) return;
    this.mine = true;
    this._ask(command).catch((error) => this.page.overlay.say(error.message));
  }

  _key(event) {
    const name = `${event.shiftKey ? 'shift+' : ''}${event.key}`;
    const step = STEPS.find(([, , , key]) => key === name);
    if (!step || !this.store.stopped || !this.possible()) return;
    event.preventDefault();
    event.stopPropagation();
    this.go(step[0]);
  }

  /** The value of an expression, or what a statement does, where the code stands still. @returns {Promise<string>} */
  async evaluate(expression) {
    const frame = this.frames[this.stack.selectedIndex];
    const { result } = await this._ask('evaluate', { expression, frameId: frame?.id });
    this._showVariables(frame);
    return result;
  }

  _stopped() {
    const { stopped } = this.store;
    this.buttons.hidden = !stopped || !this.possible();
    this.element.hidden = true;
    this.frames = [];
    this.mark = null;
    this.pane.showStop();
    if (stopped && this.possible() && this.mine) this._follow();
  }

  /** Shows where the code stands still, and what it has. */
  async _follow() {
    const { stopped } = this.store;
    this.mine = true;
    if (!stopped) return;
    setText(this.where, sentenceOf(stopped, this.store));
    const { stackFrames } = await this._ask('stackTrace', { threadId: stopped.handle }).catch(() => ({ stackFrames: [] }));
    if (stopped !== this.store.stopped) return;
    this.frames = stackFrames.filter(({ source }) => source);
    this.stack.replaceChildren(...this.frames.map(({ name, line, source }) => el('option', {}, `${name || '(main)'}, ${source.name}:${line}`)));
    this.element.hidden = false;
    this.page.showPanel('script', true);
    if (this.frames.length) this._choose(this.frames[0]);
  }

  async _choose(frame) {
    this.mark = { handle: frame.script ?? null, path: frame.source.path, line: frame.line };
    this._showVariables(frame);
    if (frame.script !== undefined) await this.pane.open(frame.script, frame.line);
    else await this._openFile(frame);
    this.pane.showStop();
  }

  /** A text that scripts have loaded. */
  async _openFile({ source, line }) {
    const { content } = await this._ask('source', { source }).catch((error) => ({ content: `-- ${error.message}` }));
    this.pane.openText(source.path, content, line);
  }

  async _showVariables(frame) {
    const { scopes } = await this._ask('scopes', { frameId: frame?.id }).catch(() => ({ scopes: [] }));
    this.variables.show(scopes);
  }
}

/** For the help; the keys are those of the debuggers of browsers. */
export function debugKeys() {
  const key = (shown, text) => ({ group: 'Debug', keys: [], shown, text, action: () => {} });
  return [key('F9', 'breakpoint in the line of the editor; Shift: where something is true'), key('F8', 'go on'), key('F10', 'over this line'), key('F11', 'into a function; Shift: out of it')];
}
