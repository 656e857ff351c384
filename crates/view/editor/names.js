// What there is to call: the table of `editor/reference.json` (docs/VIEW_PROTOCOL.md), and what a text means by its names.

const REQUIRED = /([A-Za-z_]\w*)\s*=\s*require\s*\(?\s*['"]([\w.\/-]+)['"]/g;
const WORDS = { lua: 'and break do else elseif end false for function goto if in local nil not or repeat return then true until while', python: 'and as assert async await break class continue def del elif else except False finally for from global if import in is lambda None nonlocal not or pass raise return True try while with yield' };

/** The words of a language. @param {string} language */
export const keywords = (language) => (WORDS[language] ?? '').split(' ').filter(Boolean);

/** Which module each name stands for: `local ik = require 'simIK'`. @param {string} text @returns {Map<string, string>} */
export function required(text) {
  const found = new Map();
  for (const [, name, module] of text.matchAll(REQUIRED)) found.set(name, module);
  return found;
}

/** The call that a place of a text is in, or the name there; empty without one. @param {string} before the text before it @param {string} after */
export function calledAt(before, after) {
  let open = 0;
  for (let at = before.length - 1; at >= 0; at--) {
    if (before[at] === ')') open++;
    else if (before[at] === '(' && open-- === 0) return before.slice(0, at).match(/[A-Za-z_][\w.:]*\s*$/)?.[0].trim() ?? '';
  }
  return (before.match(/[A-Za-z_][\w.:]*$/)?.[0] ?? '') + (after.match(/^\w*/)?.[0] ?? '');
}

export class Names {
  /** @param {{functions: string[][], constants: Object<string, string[]>, modules: string[][], callbacks: string[][]}} table */
  constructor({ functions, constants, modules, callbacks }) {
    /** @type {Map<string, Map<string, {name: string, kind: string, signature: string, text: string}>>} by what stands before the dot */
    this.members = new Map();
    const entry = (kind) => ([name, signature, text]) => ({ name, kind, signature, text });
    for (const row of functions) this._add(entry('function')(row));
    for (const [module, names] of Object.entries(constants)) for (const name of names) this._add({ name: `${module}.${name}`, kind: 'constant', signature: `${module}.${name}`, text: '' });
    this.modules = modules.map(([name, text]) => ({ name, kind: 'module', signature: name, text }));
    this.callbacks = callbacks.map(entry('callback'));
    for (const callback of this.callbacks) this._add(callback);
  }

  /** Globals are below the empty name. */
  _add(entry) {
    const at = Math.max(entry.name.lastIndexOf('.'), entry.name.lastIndexOf(':'));
    const owner = at < 0 ? '' : entry.name.slice(0, at);
    if (!this.members.has(owner)) this.members.set(owner, new Map());
    this.members.get(owner).set(entry.name.slice(at + 1), entry);
  }

  /** What a name of a text has. @param {string} name @param {string} text */
  of(name, text) {
    const module = required(text).get(name) ?? name;
    return this.members.get(module) ?? this.members.get(module.replace(/-\d+(\.\d+)*$/, '')) ?? new Map();
  }

  /** The entry of `sim.getObject` or `print`; undefined where it is not known. @param {string} name @param {string} text */
  find(name, text) {
    const at = Math.max(name.lastIndexOf('.'), name.lastIndexOf(':'));
    return this.of(at < 0 ? '' : name.slice(0, at), text).get(name.slice(at + 1));
  }
}
