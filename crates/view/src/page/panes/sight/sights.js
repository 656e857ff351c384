// Ways to look at the scene beyond the one view: directions, a second view, distances, paths, and forces of joints.
import { Measure } from './measure.js';
import { Presets } from './presets.js';
import { SecondView } from './second_view.js';
import { Torques } from './torques.js';
import { Trails } from './trails.js';

export class Sights {
  /** @param {any} page with a renderer @param {any} actions of the controls of the first view */
  constructor(page, actions) {
    this.page = page;
    this.presets = new Presets(page);
    this.presets.onLetters(page.overlay.lines.map(({ label }) => label));
    this.measure = new Measure(page);
    this.trails = new Trails(page);
    this.torques = new Torques(page);
    const hover = (hit, x, y) => actions.hover(hit, x + this.second.canvas.offsetLeft, y);
    this.second = new SecondView(page, { ...actions, hover, moved: () => {} });
  }

  /** The view that keys are about: the one that was touched last. */
  get view() {
    return this.second.shown && this.second.active ? this.second : this.page.renderer;
  }

  /** @param {string} name of an option @returns {boolean} whether it is one of these */
  set(name, on) {
    if (name !== 'trails' && name !== 'torques') return false;
    this[name].show(on);
    return true;
  }

  /** Before each picture. @param {number} seconds since the last one */
  advance(seconds) {
    if (this.second.advance(seconds)) this.page.renderer.stale = true;
  }

  /** The whole scene in both views. */
  frameFirst() {
    if (this.second.shown) this.second.fit([], true);
  }
}
