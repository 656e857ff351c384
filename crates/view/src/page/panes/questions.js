// Dialogs of scripts that wait for a person (simUI.msgBox and others): the script goes on when one is answered.
import { el } from '../dom.js';

const NAMES = { ok: 'OK', yes: 'Yes', no: 'No', cancel: 'Cancel' };
const LOADS = ['the file to load', 'the file to save to', 'the files to load, one on each line', 'the folder']; // simUI.filedialog_type

const byte = (x) => Math.round(Math.min(Math.max(x, 0), 1) * 255).toString(16).padStart(2, '0');

/** Fields of each kind: what is in them, and the answer they make. */
const KINDS = {
  msgBox: () => ({ fields: [] }),
  inputDialog({ initial, text }) {
    const field = el('input', { type: 'text', value: initial ?? '', autocomplete: 'off' });
    return { fields: [el('label', {}, text, field)], answer: () => field.value };
  },
  fileDialog({ type, startPath, initName, extensions }) {
    const start = [startPath?.replace(/\/$/, ''), initName].filter(Boolean).join('/');
    const field = el('textarea', { rows: type === 2 ? 4 : 1, value: start });
    const hint = extensions ? ` (${extensions.split(';').map((name) => `.${name}`).join(', ')})` : '';
    return { fields: [el('label', {}, `Path of ${LOADS[type] ?? LOADS[0]} on the simulator's machine${hint}`, field)], answer: () => field.value.split('\n').map((path) => path.trim()).filter(Boolean) };
  },
  colorDialog({ initial, alpha }) {
    const color = el('input', { type: 'color', value: `#${initial.slice(0, 3).map(byte).join('')}` });
    const opacity = el('input', { type: 'range', min: 0, max: 1, step: 0.01, value: initial[3] ?? 1 });
    const parts = () => [1, 3, 5].map((i) => parseInt(color.value.slice(i, i + 2), 16) / 255);
    return { fields: [el('label', {}, 'Colour', color), alpha && el('label', {}, 'Opacity', opacity)], answer: () => [...parts(), ...(alpha ? [Number(opacity.value)] : [])] };
  },
};

export class Questions {
  constructor(page) {
    this.page = page;
    page.store.on('question', () => this._update(page.store.question));
  }

  _update(question) {
    if (question?.number === this.number) return;
    this.dialog?.remove();
    this.number = question?.number;
    if (question && this.page.canWrite) this._ask(question);
  }

  _ask(question) {
    this.page.dialogs.asked.add(question.title);
    const { fields, answer } = (KINDS[question.kind] ?? KINDS.msgBox)(question);
    const send = (value) => this._answer(question, value);
    const names = question.buttons ?? ['ok', 'cancel'];
    const button = (name) => el('button', { type: 'button', class: 'answer-button', 'data-answer': name, autofocus: !fields.length && name === (question.usual ?? 'ok'), onclick: () => send(answer ? (name === 'ok' ? answer() : null) : name) }, NAMES[name]);
    this.dialog = el('dialog', { class: `question type-${question.type}`, 'aria-labelledby': 'question-title' }, el('h2', { id: 'question-title' }, question.title || 'A script asks'),
      question.kind !== 'inputDialog' && question.text && el('p', {}, question.text), ...fields, el('div', { class: 'question-buttons' }, ...names.map(button)));
    this.dialog.addEventListener('cancel', (event) => (event.preventDefault(), send(null)));
    this.dialog.addEventListener('keydown', (event) => event.key === 'Enter' && answer && event.target.tagName === 'INPUT' && send(answer()));
    document.body.append(this.dialog);
    this.dialog.showModal();
  }

  _answer({ number }, answer) {
    this.page.source.request('answer', { question: number, answer }).catch(() => {}); // another page was faster
    this.dialog.remove();
  }
}
