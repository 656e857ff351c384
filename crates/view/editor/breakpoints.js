// Breakpoints beside the lines of a text, which move with them; and the line that is about to run.
import { RangeSet, StateEffect, StateField } from '@codemirror/state';
import { Decoration, EditorView, gutter, GutterMarker, keymap } from '@codemirror/view';

const setAll = StateEffect.define();
const setStop = StateEffect.define();

class Mark extends GutterMarker {
  /** @param {{condition?: string | null, isLoaded: boolean}} breakpoint */
  constructor({ condition = null, isLoaded }) {
    super();
    Object.assign(this, { condition, isLoaded });
  }

  eq(other) {
    return other.condition === this.condition && other.isLoaded === this.isLoaded;
  }

  toDOM() {
    const title = this.condition ? `Stops where ${this.condition}` : this.isLoaded ? 'Stops here' : 'Stops here when the script is loaded';
    return Object.assign(document.createElement('span'), { className: `breakpoint${this.condition ? ' conditional' : ''}${this.isLoaded ? '' : ' waiting'}`, title });
  }
}

const changed = (transaction, effect) => transaction.effects.findLast((each) => each.is(effect));

/** Each line has one at most, whatever was deleted between them. */
function marks() {
  return StateField.define({
    create: () => RangeSet.empty,
    update: (marks, transaction) => changed(transaction, setAll)?.value ?? marks.map(transaction.changes),
  });
}

const stops = StateField.define({
  create: () => Decoration.none,
  update: (marks, transaction) => changed(transaction, setStop)?.value ?? marks.map(transaction.changes),
  provide: (field) => EditorView.decorations.from(field),
});

export class Breakpoints {
  /** @param {((breakpoints: {line: number, condition: string | null}[]) => void) | null} onChange null where there is no debugger */
  constructor(onChange) {
    Object.assign(this, { onChange, marks: marks() });
  }

  get extension() {
    if (!this.onChange) return stops;
    const toggle = (view, from) => (this._toggle(view, from), true);
    const atCursor = (view) => view.state.doc.lineAt(view.state.selection.main.head).from;
    const beside = gutter({
      class: 'cm-breakpoints',
      markers: (view) => view.state.field(this.marks),
      initialSpacer: () => new Mark({ isLoaded: true }),
      domEventHandlers: { mousedown: (view, line, event) => event.button === 0 && toggle(view, line.from), contextmenu: (view, line, event) => (event.preventDefault(), this._ask(view, line.from)) },
    });
    const keys = keymap.of([{ key: 'F9', run: (view) => toggle(view, atCursor(view)), preventDefault: true }, { key: 'Shift-F9', run: (view) => this._ask(view, atCursor(view)), preventDefault: true }]);
    return [this.marks, beside, keys, stops];
  }

  /** By the starts of lines. */
  _of(view) {
    const found = new Map();
    const marks = view.state.field(this.marks, false) ?? RangeSet.empty;
    for (const at = marks.iter(); at.value; at.next()) found.set(view.state.doc.lineAt(at.from).from, at.value);
    return found;
  }

  /** @returns {{line: number, condition: string | null}[]} */
  list(view) {
    return [...this._of(view)].map(([from, { condition }]) => ({ line: view.state.doc.lineAt(from).number, condition }));
  }

  /** @param {{line: number, condition?: string | null, at?: number | null}[]} all */
  show(view, all) {
    const { doc } = view.state;
    const found = new Map();
    for (const { line, condition, at } of all) if ((at ?? line) <= doc.lines) found.set(doc.line(at ?? line).from, new Mark({ condition, isLoaded: at !== null }));
    if (this.onChange) this._set(view, found);
  }

  _set(view, found) {
    const all = [...found].sort(([a], [b]) => a - b).map(([from, mark]) => mark.range(from));
    view.dispatch({ effects: setAll.of(RangeSet.of(all)) });
  }

  _change(view, from, mark) {
    const found = this._of(view);
    if (mark) found.set(from, mark);
    else found.delete(from);
    this._set(view, found);
    this.onChange(this.list(view));
  }

  _toggle(view, from) {
    this._change(view, from, this._of(view).has(from) ? null : new Mark({ isLoaded: true }));
  }

  /** Asks where it stops. */
  _ask(view, from) {
    const condition = prompt('Stop in this line only where this is true, such as i > 3; nothing: always', this._of(view).get(from)?.condition ?? '');
    if (condition !== null) this._change(view, from, new Mark({ condition: condition.trim() || null, isLoaded: true }));
    return true;
  }

  /** @param {number | null} line that is about to run */
  showStop(view, line) {
    const { doc } = view.state;
    const isThere = line >= 1 && line <= doc.lines;
    const from = isThere ? doc.line(line).from : 0;
    const effects = [setStop.of(isThere ? Decoration.set([Decoration.line({ class: 'cm-stopped' }).range(from)]) : Decoration.none)];
    if (isThere) effects.push(EditorView.scrollIntoView(from, { y: 'center' }));
    view.dispatch({ effects });
  }
}
