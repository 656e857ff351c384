// The timeline of a recording or a capture: a slider, marks above it, and buttons that go from mark to mark.
import { el, iconButton, setText, svg } from '../dom.js';

const MARKS = { error: 'error', failure: 'failure', contact: 'contact', signal: 'message', broadcast: 'message' };
const NEAR = 1e-6;

export class Timeline {
  /** @param {{track: any}} source */
  constructor(source) {
    this.source = source;
    const hold = (held) => () => (this.held = held);
    this.slider = el('input', { type: 'range', class: 'timeline', oninput: () => source.track?.seek(Number(this.slider.value)), onpointerdown: hold(true), onpointerup: hold(false), onpointercancel: hold(false) });
    this.strip = svg('svg', { class: 'marks', viewBox: '0 0 1000 10', preserveAspectRatio: 'none', 'aria-hidden': 'true' });
    this.ending = el('span', { class: 'time-end' });
    const jump = (by) => iconButton('jump', by > 0 ? 'Next mark (N)' : 'Previous mark (P)', () => this.jump(by), { class: by > 0 ? 'icon-button' : 'icon-button mirrored' });
    this.jumps = [jump(-1), jump(1)];
    this.box = el('div', { class: 'timeline-box' }, this.strip, this.slider);
    this.elements = [this.box, this.ending, ...this.jumps];
    this.update();
  }

  update() {
    const { track } = this.source;
    this.elements.forEach((element) => (element.hidden = !track));
    if (!track) return;
    this._place(track);
    this.jumps.forEach((button) => (button.hidden = !track.marks.length));
    setText(this.ending, track.ending);
    if (!this.held) this.slider.value = track.at;
  }

  /** The ends and the marks, where they are others. */
  _place({ start, end, step, name, marks }) {
    if (this.marks === marks && this.start === start && this.end === end) return;
    Object.assign(this, { marks, start, end });
    for (const [member, value] of Object.entries({ min: start, max: end, step })) this.slider[member] = value;
    this.slider.setAttribute('aria-label', name);
    const span = end - start || 1;
    this.strip.replaceChildren(...marks.map((mark) => this._mark(mark, (1000 * (mark.at - start)) / span)));
  }

  _mark({ at, time, kind, text }, x) {
    const mark = svg('rect', { class: `mark ${MARKS[kind] ?? 'message'}`, x: x - 1.5, width: 3, y: 0, height: 10 }, svg('title', {}, `${time.toFixed(3)} s ${kind}: ${text ?? ''}`));
    mark.addEventListener('click', () => this.source.track?.seek(at));
    return mark;
  }

  /** What screen readers say of the place. @param {string} text */
  describe(text) {
    this.slider.setAttribute('aria-valuetext', text);
  }

  /** Goes to the mark before or after the moment that is shown. */
  jump(by) {
    const { track } = this.source;
    if (!track) return;
    const places = track.marks.map((mark) => mark.at).sort((a, b) => a - b);
    const ahead = by > 0 ? places.find((at) => at > track.at + NEAR) : places.findLast((at) => at < track.at - NEAR);
    if (ahead !== undefined) track.seek(ahead);
  }
}
