// Changes of the scene: what a page may do, as requests with undo and redo.

import { confirmed } from './confirm.js';

let gestures = Math.floor(Math.random() * 2 ** 40); // numbers of gestures differ between pages

export class Edits {
  /** @param {any} page */
  constructor(page) {
    Object.assign(this, { page, store: page.store });
  }

  /** Whether the scene can be changed here at all: a simulation, on a page that may write. */
  get possible() {
    return this.page.canWrite && this.store.scene.mode === 'live';
  }

  get stopped() {
    return this.store.scene.state === 'stopped';
  }

  /** A number for changes that are one step of undo. */
  gesture() {
    return ++gestures;
  }

  /**
   * Asks for a change; the console shows why it fails.
   * @param {string} edit @param {Object<string, any>} args @param {number} [gesture]
   */
  async ask(edit, args, gesture) {
    if (!this._mayEdit()) return null;
    const done = await this.page.ask('edit', { edit, arguments: { ...args, gesture }, gesture }).catch((error) => this.page.overlay.say(error.message));
    if (done && !this.stopped) this.page.overlay.say('What is changed while the simulation runs is gone when it stops.');
    return done ?? null;
  }

  _mayEdit() {
    if (!this.possible) this.page.overlay.say('This page can only show.');
    return this.possible;
  }

  /** @param {'undo' | 'redo'} what @param {boolean} others also what another page has done */
  async back(what, others = false) {
    if (!this._mayEdit()) return;
    const done = await this.page.source.request(what, { others }).catch((error) => this.page.overlay.say(error.message));
    if (!done) return;
    if (!done.isAnothers) return this.page.overlay.say(`${what === 'undo' ? 'Undone' : 'Done again'}: ${done.label}`);
    const verb = what === 'undo' ? 'Undo' : 'Redo';
    if (await confirmed(`Another page has done this: ${done.label}. ${verb} it?`, verb)) this.back(what, true);
  }

  /** What is selected and can be changed: without what is below something else that is selected. */
  get chosen() {
    return this.store.selection.filter((handle) => this.store.objects.has(handle));
  }

  /** An edit of what is selected. */
  ofChosen(edit, more = {}) {
    const handles = this.chosen;
    if (!handles.length) return this.page.overlay.say('Select an object first.');
    return this.ask(edit, { handles, ...more });
  }

  group() {
    const shapes = this.chosen.filter((handle) => this.store.objects.get(handle).objectType === 'shape');
    if (shapes.length < 2) return this.page.overlay.say('Select at least two shapes: click, then click with Ctrl.');
    return this.ask('group', { handles: shapes });
  }

  ungroup() {
    const [handle] = this.chosen;
    return handle === undefined ? this.page.overlay.say('Select a compound shape first.') : this.ask('ungroup', { handle });
  }

  rename(handle, alias) {
    const before = this.store.objects.get(handle)?.alias;
    if (alias && alias !== before) return this.ask('rename', { handle, alias });
    return null;
  }
}
