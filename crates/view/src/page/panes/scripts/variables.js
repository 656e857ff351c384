// The variables of code that stands still, as a tree. What was open stays open from stop to stop.
import { el } from '../../dom.js';

const COUNT = 200; // of a table at once

export class Variables {
  /** @param {(command: string, members: any) => Promise<any>} ask */
  constructor(ask) {
    Object.assign(this, { ask, open: new Set(['Locals']), shown: 0 });
    this.element = el('ul', { class: 'debug-variables', 'aria-label': 'Variables', tabindex: 0 });
  }

  /** @param {{name: string, variablesReference: number}[]} scopes */
  async show(scopes) {
    const shown = ++this.shown;
    const rows = await Promise.all(scopes.map((scope) => this._row({ ...scope, value: '' }, '')));
    if (shown === this.shown) this.element.replaceChildren(...rows);
  }

  /** A variable, and what it has if that is open. */
  async _row({ name, value, type, variablesReference }, above) {
    const path = above ? `${above}/${name}` : name;
    const list = el('ul', {});
    const text = [el('span', { class: 'variable-name' }, name), value !== '' && el('span', { class: `variable-value ${type ?? ''}`, title: value }, value)];
    if (!variablesReference) return el('li', {}, el('div', { class: 'variable' }, ...text));
    const isOpen = this.open.has(path);
    const button = el('button', { type: 'button', class: 'variable', 'aria-expanded': String(isOpen), onclick: () => this._toggle(button, list, variablesReference, path) }, ...text);
    if (isOpen) await this._fill(list, variablesReference, path);
    return el('li', {}, button, list);
  }

  async _fill(list, variablesReference, path) {
    const { variables } = await this.ask('variables', { variablesReference, count: COUNT }).catch(() => ({ variables: [] }));
    const rows = await Promise.all(variables.map((variable) => this._row(variable, path)));
    if (variables.length === COUNT) rows.push(el('li', { class: 'hint' }, `the first ${COUNT}`));
    if (!rows.length) rows.push(el('li', { class: 'hint' }, 'none'));
    list.replaceChildren(...rows);
  }

  async _toggle(button, list, reference, path) {
    const isOpen = !this.open.delete(path);
    if (isOpen) this.open.add(path);
    button.setAttribute('aria-expanded', String(isOpen));
    if (isOpen) await this._fill(list, reference, path);
    else list.replaceChildren();
  }
}
