// How much is drawn when pictures take long: while something moves shadows go first, then edges and resolution; what rests is
// drawn in full.

const LIMIT = 1 / 18; // seconds for a picture
const LEVELS = [
  { shadows: true, edges: true, scale: 1 },
  { shadows: false, edges: true, scale: 1 },
  { shadows: false, edges: false, scale: 0.75 },
  { shadows: false, edges: false, scale: 0.5 },
];
const REST = 0.25; // seconds without motion

export class Quality {
  constructor(software) {
    this.software = software;
    this.level = software ? 1 : 0; // while something moves
    this.moving = false;
    this.rest = 0;
    this.slow = 0; // pictures in a row that took too long
  }

  get _current() {
    return LEVELS[this.moving ? this.level : 0];
  }

  get shadows() {
    return this._current.shadows;
  }

  get edges() {
    return this._current.edges;
  }

  get scale() {
    return this._current.scale;
  }

  /** @param {number} seconds since the last picture @param {boolean} moves @returns {boolean} whether to draw again, better */
  update(seconds, moves) {
    if (moves) {
      this._measure(seconds);
      this.rest = 0;
      this.moving = true;
      return false;
    }
    this.rest += seconds;
    if (!this.moving || this.rest < REST) return false;
    this.moving = false;
    return this.level > 0;
  }

  _measure(seconds) {
    if (this.rest > 0 || !this.moving) return; // the time before was no picture's
    this.slow = seconds > LIMIT ? this.slow + 1 : Math.max(this.slow - 1, 0);
    if (this.slow < 8 || this.level === LEVELS.length - 1) return;
    this.level++;
    this.slow = 0;
  }
}
