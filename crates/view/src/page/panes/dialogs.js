// Dialogs of scripts that were answered when they came, since no page could answer: the page says what and how.
import { el, iconButton } from '../dom.js';

const SHOWN = 8000; // milliseconds

export class DialogsPane {
  constructor(page) {
    this.page = page;
    this.asked = new Set(); // titles of those that this page has asked itself
    this.last = null; // number of the newest dialog that was there before the page came
    this.list = el('div', { class: 'dialogs', role: 'status' });
    document.getElementById('stage').append(this.list);
    page.store.on('dialogs', () => this._update(page.store.dialogs));
  }

  _update(dialogs) {
    const newest = dialogs.reduce((most, { number }) => Math.max(most, number ?? 0), 0);
    const fresh = this.last === null ? [] : dialogs.filter(({ number }) => number > this.last);
    this.last = newest;
    for (const dialog of fresh) if (!this.asked.delete(dialog.title)) this._show(dialog);
  }

  _show({ title, text, answer }) {
    const note = el('div', { class: 'dialog-note' }, el('strong', {}, title || 'Dialog'), el('p', {}, text ?? ''), el('p', { class: 'answer' }, `Answered: ${answer ?? 'nothing'}`));
    note.append(iconButton('close', 'Close', () => note.remove()));
    this.list.append(note);
    setTimeout(() => note.remove(), SHOWN);
  }
}
