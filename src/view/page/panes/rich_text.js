// The HTML that scripts write into labels, without ever being HTML of this page: a few harmless elements are built anew, all else is text.
import { el } from '../dom.js';

const KEPT = { B: 'strong', STRONG: 'strong', I: 'em', EM: 'em', U: 'u', BR: 'br', P: 'p', DIV: 'div', SPAN: 'span', UL: 'ul', OL: 'ol', LI: 'li', CODE: 'code', PRE: 'pre', SMALL: 'small', BIG: 'span', SUB: 'sub', SUP: 'sup', H1: 'h3', H2: 'h4', H3: 'h5', HR: 'hr', TABLE: 'table', TBODY: 'tbody', THEAD: 'thead', TR: 'tr', TD: 'td', TH: 'th', CENTER: 'div', FONT: 'span', TT: 'code', S: 's' };
const DROPPED = new Set(['SCRIPT', 'STYLE', 'IFRAME', 'OBJECT', 'TEMPLATE', 'HEAD', 'TITLE', 'NOSCRIPT']);

/** @param {string} text @param {function(string): void} follow called with the href of a link @param {string} [type] plain, html or markdown */
export function richText(text, follow, type = 'html') {
  if (type === 'plain' || !/[<&]/.test(text)) return type === 'markdown' ? markdown(text) : document.createTextNode(text);
  const inert = new DOMParser().parseFromString(text, 'text/html'); // runs and loads nothing
  const fragment = document.createDocumentFragment();
  fragment.append(...copies(inert.body, follow));
  return fragment;
}

function copies(node, follow) {
  return Array.from(node.childNodes).flatMap((child) => copy(child, follow));
}

function copy(node, follow) {
  if (node.nodeType === Node.TEXT_NODE) return [document.createTextNode(node.data)];
  if (node.nodeType !== Node.ELEMENT_NODE || DROPPED.has(node.nodeName)) return [];
  const inside = copies(node, follow);
  if (node.nodeName === 'A') {
    const href = node.getAttribute('href') ?? '';
    return [el('button', { type: 'button', class: 'link', onclick: () => follow(href) }, ...inside)];
  }
  if (!KEPT[node.nodeName]) return inside;
  const made = el(KEPT[node.nodeName], {}, ...inside);
  const color = node.getAttribute('color') || node.style?.color;
  if (color) made.style.color = color;
  return [made];
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
