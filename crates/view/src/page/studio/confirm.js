// A question with two answers, over the page.
import { el } from '../dom.js';

/** @param {string} text @param {string} yes what the button says that agrees @returns {Promise<boolean>} */
export function confirmed(text, yes) {
  return new Promise((answer) => {
    const button = (value, text) => el('button', { type: 'submit', class: 'answer-button', value }, text);
    const form = el('form', { method: 'dialog' }, el('p', { id: 'confirm-text' }, text), el('div', { class: 'question-buttons' }, button('yes', yes), button('no', 'Cancel')));
    const dialog = el('dialog', { class: 'modal confirm', 'aria-labelledby': 'confirm-text' }, form);
    dialog.addEventListener('keydown', (event) => event.stopPropagation());
    dialog.addEventListener('close', () => (dialog.remove(), answer(dialog.returnValue === 'yes')));
    document.body.append(dialog);
    dialog.showModal();
  });
}
