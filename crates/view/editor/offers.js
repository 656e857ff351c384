// Completion: members of modules, names of modules, callbacks, and the words of the text.
import { snippetCompletion } from '@codemirror/autocomplete';
import { syntaxTree } from '@codemirror/language';
import { keywords } from './names.js';

const TYPES = { function: 'function', constant: 'constant', module: 'namespace', callback: 'function' };
const CALLBACK = { lua: (name, parameters) => `function ${name}(${parameters})\n\t\${}\nend`, python: (name, parameters) => `def ${name}(${parameters}):\n\t\${}` };

/** Signature and sentence, below one another. */
export function description({ signature, text }) {
  const dom = document.createElement('div');
  dom.className = 'cm-description';
  for (const [name, content] of [['code', signature], ['p', text]]) if (content) dom.append(Object.assign(document.createElement(name), { textContent: content }));
  return dom;
}

function offer(label, entry) {
  return { label, type: TYPES[entry.kind], info: () => description(entry), boost: entry.kind === 'function' ? 1 : 0 };
}

/** A callback with its end, where nothing else is in the line. */
function callback(entry, language, isAlone) {
  const parameters = entry.signature.match(/\((.*)\)/)?.[1] ?? '';
  const template = CALLBACK[language];
  return isAlone && template ? { ...snippetCompletion(template(entry.name, parameters), offer(entry.name, entry)), boost: 2 } : offer(entry.name, entry);
}

/** The words of a text beside the one at a place. */
function wordsOf(text, at) {
  const found = new Set();
  for (const match of text.matchAll(/[A-Za-z_]\w{2,}/g)) if (at < match.index || at > match.index + match[0].length) found.add(match[0]);
  return found;
}

const inText = (context) => /comment|string/.test(syntaxTree(context.state).resolveInner(context.pos, -1).name);

function members(context, names) {
  const found = context.matchBefore(/[A-Za-z_]\w*[.:]\w*/);
  if (!found || inText(context)) return null;
  const [owner] = found.text.split(/[.:]/, 1);
  const all = names.of(owner, context.state.doc.toString());
  const options = [...all].map(([label, entry]) => offer(label, entry));
  return { from: found.from + owner.length + 1, options, validFor: /^\w*$/ };
}

function modules(context, names) {
  const found = context.matchBefore(/require\s*\(?\s*['"][\w.\/-]*/);
  if (!found) return null;
  const from = found.from + found.text.search(/['"]/) + 1;
  return { from, options: names.modules.map((entry) => offer(entry.name, entry)), validFor: /^[\w.\/-]*$/ };
}

function words(context, names, language) {
  const found = context.matchBefore(/[A-Za-z_]\w*/);
  if ((!found && !context.explicit) || (found && found.text.length < 2 && !context.explicit) || inText(context)) return null;
  const from = found?.from ?? context.pos;
  const line = context.state.doc.lineAt(context.pos);
  const isAlone = line.text.trimEnd() === (found?.text ?? ''); // and not within another function
  const known = [...names.of('', '')].filter(([, entry]) => entry.kind !== 'callback').map(([label, entry]) => offer(label, entry));
  const options = [
    ...names.callbacks.map((entry) => callback(entry, language, isAlone)),
    ...known,
    ...names.modules.filter(({ name }) => /^\w+$/.test(name)).map((entry) => offer(entry.name, entry)),
    ...keywords(language).map((label) => ({ label, type: 'keyword' })),
  ];
  const labels = new Set(options.map(({ label }) => label));
  for (const label of wordsOf(context.state.doc.toString(), context.pos)) if (!labels.has(label)) options.push({ label, type: 'variable' });
  return { from, options, validFor: /^\w*$/ };
}

/** A source of completions. @param {() => Promise<import('./names.js').Names>} load @param {string} language */
export function offers(load, language) {
  return async (context) => {
    const names = await load().catch(() => null);
    if (!names) return null; // the simulator has gone
    return modules(context, names) ?? members(context, names) ?? words(context, names, language);
  };
}
