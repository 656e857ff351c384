// The keys, as a dialog; the table is also what the page listens to.
import { el, iconButton } from '../dom.js';

/**
 * @typedef {{keys: string[], shown: string, text: string, action: function(KeyboardEvent): void, group: string}} Key
 * @param {any} page @returns {Key[]}
 */
export function keysOf(page) {
  const { renderer, bar } = page;
  const view = (yaw, pitch) => () => page.lookAlong(yaw, pitch);
  const key = (group, keys, shown, text, action) => ({ group, keys, shown, text, action });
  const keys = [
    key('Time', [' '], 'Space', 'start or pause', () => bar.toggle()),
    key('Time', ['shift+ '], 'Shift+Space', 'stop, or back to the start', () => page.ask('stop')),
    key('Time', ['.'], '.', 'one step', () => bar.step(1)),
    key('Time', [','], ',', 'one step back, in captures and recordings', () => bar.step(-1)),
    key('Time', ['n'], 'N', 'next mark, there too', () => bar.jump(1)),
    key('Time', ['p'], 'P', 'previous mark', () => bar.jump(-1)),
    key('View', ['f'], 'F', 'show the selected object, or everything', () => page.fit(page.store.selection)),
    key('View', ['Home'], 'Home', 'show everything', () => page.fit([])),
    key('View', ['1'], '1', 'from the front', view(Math.PI, 0)),
    key('View', ['3'], '3', 'from the side', view(Math.PI / 2, 0)),
    key('View', ['7'], '7', 'from above', view(Math.PI / 2, -Math.PI / 2)),
    key('View', ['5'], '5', 'with or without perspective', () => page.togglePerspective()),
    key('View', [], 'Ctrl+1 3 7', 'from the other side; Shift too', () => {}),
    key('View', ['v'], 'V', 'two views side by side', () => page.sights.second.toggle()),
    key('View', ['y'], 'Y', 'measure: two clicks, or two selected objects; Esc ends', () => page.sights.measure.toggle()),
    key('View', ['l'], 'L', 'follow the selected object', () => page.follow(page.store.selection.at(-1))),
    key('View', ['ArrowLeft', 'ArrowRight', 'ArrowUp', 'ArrowDown'], 'arrows', 'turn (in the scene); with Shift move', (event) => page.turn(event)),
    key('View', ['+', '=', '-'], '+ −', 'nearer, farther', (event) => page.zoom(event.key === '-' ? 1.25 : 0.8)),
    key('Panels', ['t'], 'T', 'tree and properties', () => page.showPanel('side')),
    key('Panels', ['c'], 'C', 'console', () => page.showPanel('console')),
    key('Panels', ['s'], 'S', 'script of the selected object', () => page.openScriptOf(page.store.selection.at(-1))),
    key('Panels', ['/'], '/', 'search objects', () => page.search()),
    key('Panels', ['d'], 'D', 'light or dark', () => page.toggleTheme()),
    key('Panels', ['Escape'], 'Esc', 'select nothing, close what is open', () => page.escape()),
    key('Panels', ['?'], '?', 'these keys', () => page.help.toggle()),
  ];
  if (page.source.live) keys.push(key('Time', ['g'], 'G', 'go on live from the moment of a capture', () => bar.goOn()));
  if (renderer) return keys;
  return keys.filter(({ group }) => group !== 'View');
}

const POINTER = [
  ['drag', 'turn about what is under the pointer'],
  ['right or middle button, or Shift and drag', 'move'],
  ['wheel', 'zoom to the pointer'],
  ['click', 'select; with Ctrl add'],
  ['double click', 'look at it'],
  ['two fingers', 'move and zoom'],
];

export class Help {
  /** @param {Key[]} keys */
  constructor(keys) {
    this.element = el('dialog', { class: 'help', 'aria-labelledby': 'help-title' });
    const groups = [...new Set(keys.map(({ group }) => group))];
    const row = (what, text) => el('tr', {}, el('th', { scope: 'row' }, el('kbd', {}, what)), el('td', {}, text));
    const tables = groups.map((group) => el('div', {}, el('h3', {}, group), el('table', {}, el('tbody', {}, ...keys.filter((key) => key.group === group).map((key) => row(key.shown, key.text))))));
    const pointer = el('div', {}, el('h3', {}, 'Pointer'), el('table', {}, el('tbody', {}, ...POINTER.map(([what, text]) => row(what, text)))));
    this.element.append(el('header', {}, el('h2', { id: 'help-title' }, 'Keys'), iconButton('close', 'Close', () => this.element.close())), el('div', { class: 'help-tables' }, ...tables, pointer));
    document.body.append(this.element);
  }

  toggle() {
    if (this.element.open) this.element.close();
    else this.element.showModal();
  }
}
