// The HTML that scripts write into labels, without ever being HTML of this page: a few harmless elements are made anew, all else is text.
import { el } from '../../dom.js';

const KEPT = {
  b: 'strong', strong: 'strong', i: 'em', em: 'em', u: 'u', s: 's', p: 'p', div: 'div', center: 'div', span: 'span', font: 'span', big: 'span', small: 'small', sub: 'sub', sup: 'sup', code: 'code', tt: 'code',
  pre: 'pre', ul: 'ul', ol: 'ol', li: 'li', h1: 'h3', h2: 'h4', h3: 'h5', table: 'table', tbody: 'tbody', thead: 'thead', tr: 'tr', td: 'td', th: 'th',
};
const DROPPED = new Set(['script', 'style', 'head', 'title', 'template', 'noscript', 'iframe', 'object']);
const ENTITIES = { amp: '&', lt: '<', gt: '>', quot: '"', apos: "'", nbsp: '\u00a0', deg: '°', micro: 'µ', times: '×', plusmn: '±', ndash: '–', mdash: '—', rarr: '→', larr: '←' };
const TOKENS = /<!--[\s\S]*?-->|<!\w[^>]*>|<(\/?)([a-z][a-z0-9]*)((?:"[^"]*"|'[^']*'|[^>"'])*)>|&(#x?[\da-f]+|\w+);|[^<&]+|[<&]/gi;

/** @param {string} text @param {function(string): void} open called with the href of a link @param {string} [type] plain, html or markdown */
export function richText(text, open, type = 'html') {
  if (type === 'markdown') return markdown(text);
  if (type === 'plain' || !/[<&]/.test(text)) return document.createTextNode(text);
  return new Builder(open).build(text);
}

class Builder {
  constructor(open) {
    this.open = open;
    this.stack = [{ name: '', node: document.createDocumentFragment() }];
  }

  build(text) {
    for (const [token, slash, name, attributes, entity] of text.matchAll(TOKENS)) {
      if (name && slash) this._end(name.toLowerCase());
      else if (name) this._begin(name.toLowerCase(), attributes);
      else if (entity) this._text(character(entity) ?? token);
      else if (!token.startsWith('<!')) this._text(token);
    }
    return this.stack[0].node;
  }

  _text(text) {
    if (!this.stack.some(({ name }) => DROPPED.has(name))) this.stack.at(-1).node.append(text);
  }

  _begin(name, attributes) {
    const parent = this.stack.at(-1).node;
    if (name === 'br' || name === 'hr') return parent.append(el(name));
    if (this.stack.length > 50 || !(KEPT[name] || name === 'a' || DROPPED.has(name))) return;
    const node = name === 'a' ? this._link(attributes) : el(KEPT[name] ?? 'span');
    const color = /color\s*[:=]\s*["']?\s*([#\w]+)/i.exec(attributes)?.[1];
    if (color) node.style.color = color;
    parent.append(node);
    this.stack.push({ name, node });
  }

  _link(attributes) {
    const href = /href\s*=\s*(?:"([^"]*)"|'([^']*)'|(\S+))/i.exec(attributes);
    return el('button', { type: 'button', class: 'link', onclick: () => this.open(href?.[1] ?? href?.[2] ?? href?.[3] ?? '') });
  }

  _end(name) {
    const at = this.stack.findLastIndex((entry) => entry.name === name);
    if (at > 0) this.stack.length = at;
  }
}

function character(entity) {
  if (!entity.startsWith('#')) return ENTITIES[entity];
  const code = /^#x/i.test(entity) ? parseInt(entity.slice(2), 16) : Number(entity.slice(1));
  return code > 0 && code <= 0x10ffff ? String.fromCodePoint(code) : undefined;
}

/** Headings, lists and paragraphs; the rest stays as it is written. */
function markdown(text) {
  const fragment = document.createDocumentFragment();
  for (const line of text.split('\n')) {
    const heading = /^(#{1,6})\s+(.*)/.exec(line);
    const item = /^\s*[-*]\s+(.*)/.exec(line);
    fragment.append(heading ? el(`h${Math.min(heading[1].length + 2, 6)}`, {}, heading[2]) : item ? el('li', {}, item[1]) : el('div', {}, line || '\u00a0'));
  }
  return fragment;
}
