// Texts of scripts to read: lines with numbers, and colours for Lua.
import { el } from '../../dom.js';

const KEYWORDS = new Set('and break do else elseif end false for function goto if in local nil not or repeat return then true until while'.split(' '));
const TOKENS = /(--\[(=*)\[[\s\S]*?(?:\]\2\]|$)|--[^\n]*)|(\[(=*)\[[\s\S]*?(?:\]\4\]|$)|"(?:\\[\s\S]|[^"\\\n])*"?|'(?:\\[\s\S]|[^'\\\n])*'?)|(\b(?:0[xX][\da-fA-F]+|\d+\.?\d*(?:[eE][+-]?\d+)?)\b)|([A-Za-z_]\w*)/g;

/** Pieces of Lua with their kinds. @param {string} code @returns {{kind: string, text: string}[]} */
function pieces(code) {
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

function row(parts, number) {
  const text = parts.map(({ kind, text }) => (kind ? el('span', { class: `lua-${kind}` }, text) : text));
  return el('div', { class: 'code-line', 'data-line': number }, el('span', { class: 'line-number', 'aria-hidden': 'true' }, number), el('code', {}, ...text));
}

/** An element for each line of a text. @param {string} code @param {string} [language] @returns {HTMLElement[]} */
export function codeRows(code, language = 'lua') {
  return lines(code, language === 'lua').map((parts, i) => row(parts, i + 1));
}
