// A text area in place of the editor component, for builds without it: what `makeEditor` of editor/editor.js returns.
import { el } from '../../dom.js';

const isSave = (event) => (event.ctrlKey || event.metaKey) && (event.key === 's' || event.key === 'Enter');

export class PlainEditor {
  constructor({ parent, text, label, onChange, onSave }) {
    this.area = el('textarea', { class: 'code mono', 'aria-label': label, spellcheck: 'false', value: text, oninput: () => onChange(this.area.value) });
    this.area.addEventListener('keydown', (event) => {
      if (isSave(event)) event.preventDefault(), onSave();
    });
    const hint = el('p', { class: 'hint' }, 'A plain text area: Swanilda was built without npm, with which it fetches its editor (docs/VIEWER.md, Edit scripts).');
    this.element = el('div', { class: 'plain-editor' }, hint, this.area);
    parent.append(this.element);
    this.changed = () => onChange(this.area.value);
  }

  /** @returns {null} what can be undone stays in the browser */
  keep() {
    return null;
  }

  setText(text) {
    this.area.value = text;
    this.changed();
  }

  /** Errors stand above the text. */
  showError() {}

  /** Breakpoints are set while the text is read. */
  breakpoints() {
    return null;
  }

  showBreakpoints() {}

  /** @param {number | null} line */
  showStop(line) {
    if (line) this.reveal(line);
  }

  /** @param {number} line */
  reveal(line) {
    const start = this.area.value.split('\n').slice(0, line - 1).join('\n').length + (line > 1 ? 1 : 0);
    this.area.setSelectionRange(start, start);
  }

  focus() {
    this.area.focus();
  }

  destroy() {
    this.element.remove();
  }
}
