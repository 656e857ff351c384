// The editor of scripts in the page of the viewer: CodeMirror with what Swanilda knows of its functions.
import { autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap } from '@codemirror/autocomplete';
import { defaultKeymap, history, historyField, historyKeymap, indentWithTab } from '@codemirror/commands';
import { bracketMatching, indentOnInput, indentUnit, StreamLanguage, syntaxHighlighting } from '@codemirror/language';
import { lua } from '@codemirror/legacy-modes/mode/lua';
import { python } from '@codemirror/legacy-modes/mode/python';
import { forceLinting, lintGutter, linter, lintKeymap } from '@codemirror/lint';
import { highlightSelectionMatches, search, searchKeymap } from '@codemirror/search';
import { EditorState, StateEffect } from '@codemirror/state';
import { drawSelection, EditorView, highlightActiveLine, highlightActiveLineGutter, highlightSpecialChars, hoverTooltip, keymap, lineNumbers, showPanel } from '@codemirror/view';
import { classHighlighter } from '@lezer/highlight';
import { Breakpoints } from './breakpoints.js';
import { calledAt, Names } from './names.js';
import { description, offers } from './offers.js';

const MODES = { lua, python };
const LOOKED_BACK = 2000; // letters before the cursor in which the call it is in may begin
const FIELDS = { history: historyField };
const checkAgain = StateEffect.define();

/** The reference is fetched when it is needed first. */
let names = null;
function load() {
  names ??= fetch(new URL('reference.json', import.meta.url)).then((reply) => reply.json()).then((table) => new Names(table));
  names.catch(() => (names = null));
  return names;
}

/** The function at the cursor, in a line below the text. */
function signatures(view) {
  const dom = document.createElement('div');
  dom.className = 'cm-signature';
  const show = async () => {
    const { state } = view;
    const { head } = state.selection.main;
    const name = calledAt(state.sliceDoc(Math.max(0, head - LOOKED_BACK), head), state.sliceDoc(head, head + 100));
    const entry = name && (await load().catch(() => null))?.find(name, state.doc.toString());
    const text = entry ? [entry.signature, entry.text].filter(Boolean).join('  –  ') : '';
    if (dom.textContent !== text) Object.assign(dom, { textContent: text, title: text });
  };
  show();
  return { dom, update: (update) => (update.docChanged || update.selectionSet) && show() };
}

const hovered = hoverTooltip(async (view, pos) => {
  const line = view.state.doc.lineAt(pos);
  const at = pos - line.from;
  const before = line.text.slice(0, at).match(/[A-Za-z_][\w.:]*$|$/)[0];
  const after = line.text.slice(at).match(/^\w*/)[0];
  const entry = (await load().catch(() => null))?.find(before + after, view.state.doc.toString());
  return entry ? { pos: pos - before.length, end: pos + after.length, above: true, create: () => ({ dom: description(entry) }) } : null;
});

/** The place of an error: its columns, which are counted from 1, or its line if it has none there. */
function marked(doc, { line, column, end }) {
  const { from, to } = doc.line(Math.min(Math.max(line, 1), doc.lines));
  if (!column || from + column > to) return { from, to };
  return { from: from + column - 1, to: end > column ? Math.min(from + end - 1, to) : to };
}

/** Errors: those of the syntax, which `check` finds, and the last one of the run, which moves with its line. */
class Errors {
  constructor(check) {
    Object.assign(this, { check, place: null });
  }

  get extension() {
    const moves = EditorView.updateListener.of((update) => {
      if (this.place !== null && update.docChanged) this.place = update.changes.mapPos(this.place);
    });
    const asked = (update) => update.transactions.some((transaction) => transaction.effects.some((effect) => effect.is(checkAgain)));
    return [moves, lintGutter(), linter((view) => this._found(view), { delay: 400, needsRefresh: asked })];
  }

  async _found(view) {
    const { doc } = view.state;
    const wrong = await this.check(doc.toString()).catch(() => null);
    const found = [];
    if (wrong) found.push([marked(doc, wrong), wrong.message]);
    if (this.place !== null) found.push([doc.lineAt(Math.min(this.place, doc.length)), this.message]);
    return found.map(([{ from, to }, message]) => ({ from, to, severity: 'error', message }));
  }

  /** @param {{line?: number, message: string} | null} error of the run */
  show(view, error) {
    const { doc } = view.state;
    this.place = error?.line >= 1 && error.line <= doc.lines ? doc.line(error.line).from : null;
    this.message = error?.message;
    view.dispatch({ effects: checkAgain.of(null) });
    forceLinting(view);
  }
}

/** The list of completions scrolls, so keys have to reach it. */
const listIsReached = EditorView.updateListener.of(({ view }) => {
  const list = view.dom.querySelector('.cm-tooltip-autocomplete > ul');
  if (list && list.tabIndex !== 0) list.tabIndex = 0;
});

/** Lines end as they did: as in Windows only if all do. */
const ends = (text) => (text.includes('\r\n') && !/(^|[^\r])\n/.test(text) ? EditorState.lineSeparator.of('\r\n') : []);

function extensions({ text, language, label, onChange, onSave }, errors, breakpoints) {
  const save = { run: () => (onSave(), true), preventDefault: true };
  const mode = MODES[language];
  return [
    keymap.of([{ key: 'Mod-s', ...save }, { key: 'Mod-Enter', ...save }]),
    ends(text), breakpoints.extension, lineNumbers(), highlightActiveLineGutter(), highlightSpecialChars(), history(), drawSelection(), EditorState.allowMultipleSelections.of(true),
    indentUnit.of('    '), indentOnInput(), bracketMatching(), closeBrackets(), highlightActiveLine(), highlightSelectionMatches(),
    mode ? StreamLanguage.define(mode) : [], syntaxHighlighting(classHighlighter),
    autocompletion({ override: [offers(load, language)] }), listIsReached, hovered, search({ top: true }), showPanel.of(signatures), errors.extension,
    keymap.of([...closeBracketsKeymap, ...completionKeymap, ...searchKeymap, ...historyKeymap, ...lintKeymap, ...defaultKeymap, indentWithTab]),
    EditorView.updateListener.of((update) => update.docChanged && onChange(update.state.sliceDoc())),
    EditorView.contentAttributes.of({ 'aria-label': label, spellcheck: 'false', tabindex: '0' }),
  ];
}

/**
 * An editor in an element.
 * @param {{parent: HTMLElement, text: string, kept?: any, language: string, label: string, onChange: (text: string) => void, onSave: () => void, check: (text: string) => Promise<{line: number, column?: number | null, end?: number | null, message: string} | null>, onBreakpoints?: ((breakpoints: any[]) => void) | null}} options
 * `kept` is what `keep` of an earlier one has returned: its text, its selection, and what can be undone.
 */
export function makeEditor(options) {
  const errors = new Errors(options.check);
  const breakpoints = new Breakpoints(options.onBreakpoints ?? null);
  const config = { extensions: extensions(options, errors, breakpoints) };
  const state = options.kept ? EditorState.fromJSON(options.kept, config, FIELDS) : EditorState.create({ doc: options.text, ...config });
  const view = new EditorView({ parent: options.parent, state });
  return {
    view,
    keep: () => view.state.toJSON(FIELDS),
    setText: (text) => view.dispatch({ changes: { from: 0, to: view.state.doc.length, insert: text } }),
    showError: (error) => errors.show(view, error),
    reveal(number) {
      const line = view.state.doc.line(Math.min(Math.max(number, 1), view.state.doc.lines));
      view.dispatch({ selection: { anchor: line.from }, effects: EditorView.scrollIntoView(line.from, { y: 'center' }) });
    },
    breakpoints: () => breakpoints.list(view),
    showBreakpoints: (all) => breakpoints.show(view, all),
    showStop: (line) => breakpoints.showStop(view, line),
    focus: () => view.focus(),
    destroy: () => view.destroy(),
  };
}
