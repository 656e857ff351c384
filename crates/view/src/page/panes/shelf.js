// Windows and floating views that a person has put away, in the options: a button for each brings it back.
import { el } from '../dom.js';

export class Shelf {
  constructor(page) {
    this.page = page;
    this.buttons = new Map(); // by what was put away
    this.list = el('div', { class: 'shelf-list' });
    this.element = el('div', { class: 'shelf', role: 'group', 'aria-label': 'Closed windows', hidden: true }, el('h3', {}, 'Closed windows'), this.list);
  }

  /** @param {any} what @param {string} name @param {function(): void} restore */
  put(what, name, restore) {
    const back = () => {
      this.take(what);
      restore();
    };
    const button = el('button', { type: 'button', class: 'answer-button', onclick: back }, `Show ${name}`);
    this.buttons.set(what, button);
    this.list.append(button);
    this.element.hidden = false;
    this.page.overlay.say(`${name} is closed. The options bring it back.`);
  }

  take(what) {
    this.buttons.get(what)?.remove();
    this.buttons.delete(what);
    this.element.hidden = !this.buttons.size;
  }
}
