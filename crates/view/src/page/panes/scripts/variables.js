// The variables of code that stands still, as a tree. What was open stays open from stop to stop.
import { el } from '../../dom.js';

const COUNT = 200; // of a table at once

export class Variables {
  /** @param {(command: string, members: any) => Promise<any>} ask */
  constructor(ask) {
    Object.assign(this, { ask, open: new Set(['Locals']), shown: 0 });
    this.element = el('ul', { class: 'debug-variables', 'aria-label': 'Variables', tabindex: 0 });
  }

  /** @param {{name: string, variablesReference: number}[]} scopes @param {string} [path] of what has the focus */
  async show(scopes, path) {
    const shown = ++this.shown;
    this.scopes = scopes;
    const rows = await Promise.all(scopes.map((scope) => this._row({ ...scope, value: '' }, '')));
    if (shown !== this.shown) return;
    const isHere = this.element.contains(document.activeElement);
    this.element.replaceChildren(...rows);
    if (isHere && path !== undefined) this.element.querySelector(`[data-path="${CSS.escape(path)}"]`)?.focus();
  }

  /** A variable, and what it has if that is open. */
  async _row({ name, value, type, variablesReference }, above) {
    const path = above ? `${above}/${name}` : name;
    const text = [el('span', { class: 'variable-name' }, name), value !== '' && el('span', { class: `variable-value ${type ?? ''}`, title: value }, value)];
    if (!variablesReference) return el('li', {}, el('div', { class: 'variable' }, ...text));
    const isOpen = this.open.has(path);
    const button = el('button', { type: 'button', class: 'variable', 'data-path': path, 'aria-expanded': String(isOpen), onclick: () => this._toggle(path) }, ...text);
    return el('li', {}, button, isOpen && el('ul', {}, ...(await this._rows(variablesReference, path))));
  }

  async _rows(variablesReference, path) {
    const { variables } = await this.ask('variables', { variablesReference, count: COUNT }).catch(() => ({ variables: [] }));
    const rows = await Promise.all(variables.map((variable) => this._row(variable, path)));
    if (variables.length === COUNT) rows.push(el('li', { class: 'hint' }, `the first ${COUNT}`));
    if (!rows.length) rows.push(el('li', { class: 'hint' }, 'none'));
    return rows;
  }

  _toggle(path) {
    if (!this.open.delete(path)) this.open.add(path);
    this.show(this.scopes, path);
  }
}
