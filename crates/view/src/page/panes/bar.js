// The bar at the bottom: play, step, stop, speed and time; in recordings the same bar is a timeline with marks.
import { el, iconButton, setIcon, setText, svg } from '../dom.js';

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10];
const MARKS = { error: 'error', failure: 'failure', contact: 'contact', signal: 'message', broadcast: 'message' };

export class Bar {
  constructor(bar, page) {
    Object.assign(this, { page, store: page.store, source: page.source });
    this.play = iconButton('play', 'Start (Space)', () => this.toggle());
    this.step = iconButton('step', 'One step (.)', () => this.page.ask('step', { count: 1 }));
    this.stop = iconButton('stop', 'Stop (Shift+Space)', () => this.page.ask('stop'));
    const speeds = SPEEDS.map((factor) => el('option', { value: factor }, `${factor}×`));
    if (this.source.live) speeds.push(el('option', { value: 0 }, 'max'));
    this.speed = el('select', { 'aria-label': 'Speed', title: 'Speed; max is as fast as possible', onchange: () => this.page.ask('speed', { factor: Number(this.speed.value) }) }, ...speeds);
    this.speed.value = '1';
    this.time = el('output', { class: 'time-now', 'aria-label': 'Simulation time' }, '0.000 s');
    this.state = el('span', { class: 'state', role: 'status' });
    bar.append(this.play, this.step, this.stop, this.speed, this.time);
    if (this.source.live) bar.append(this.state);
    else this._addTimeline(bar);
    this.store.on('scene', () => this._update());
    this.source.listeners?.add(() => this._update());
  }

  get running() {
    return this.source.live ? this.store.scene.state === 'running' : this.source.playing;
  }

  toggle() {
    this.page.ask(this.running ? 'pause' : 'play');
  }

  _addTimeline(bar) {
    const { start_time, end_time, index } = this.source;
    this.slider = el('input', { type: 'range', class: 'timeline', min: start_time, max: end_time, step: 'any', 'aria-label': 'Time in the recording', oninput: () => this.source.seek(Number(this.slider.value)) });
    const span = end_time - start_time || 1;
    const marks = (index.marks ?? []).map(({ time, kind, text }) => {
      const mark = svg('rect', { class: `mark ${MARKS[kind] ?? 'message'}`, x: (1000 * (time - start_time)) / span - 1.5, width: 3, y: 0, height: 10 }, svg('title', {}, `${time.toFixed(3)} s ${kind}: ${text ?? ''}`));
      mark.addEventListener('click', () => this.source.seek(time));
      return mark;
    });
    const jump = (by) => iconButton('step', by > 0 ? 'Next mark (N)' : 'Previous mark (P)', () => this.jump(by), { class: by > 0 ? 'icon-button' : 'icon-button mirrored' });
    const strip = svg('svg', { class: 'marks', viewBox: '0 0 1000 10', preserveAspectRatio: 'none', 'aria-hidden': 'true' }, ...marks);
    const end = el('span', { class: 'time-end' }, `${end_time.toFixed(1)} s`);
    bar.append(el('div', { class: 'timeline-box' }, strip, this.slider), end, ...(marks.length ? [jump(-1), jump(1)] : []));
  }

  /** Goes to the mark before or after the moment that is shown. */
  jump(by) {
    const times = (this.source.index.marks ?? []).map((mark) => mark.time).sort((a, b) => a - b);
    const ahead = by > 0 ? times.find((time) => time > this.source.time + 1e-6) : times.findLast((time) => time < this.source.time - 1e-6);
    if (ahead !== undefined) this.source.seek(ahead);
  }

  _update() {
    const { scene } = this.store;
    const time = this.source.live ? scene.time ?? 0 : this.source.time;
    setIcon(this.play, this.running ? 'pause' : 'play', this.running ? 'Pause (Space)' : 'Start (Space)');
    setText(this.time, `${time.toFixed(3)} s`);
    const speed = String(this.source.live ? (scene.realTime === false && !scene.speed ? 0 : scene.speed ?? 1) : this.source.speed);
    if (document.activeElement !== this.speed && [...this.speed.options].some((option) => option.value === speed)) this.speed.value = speed;
    setText(this.state, { stopped: 'stopped', running: 'running', paused: 'paused' }[scene.state] ?? '');
    for (const button of [this.play, this.step, this.stop, this.speed]) button.disabled = this.source.live && !this.page.canWrite;
    if (this.slider && document.activeElement !== this.slider) this.slider.value = time;
    if (this.slider) this.slider.setAttribute('aria-valuetext', `${time.toFixed(2)} seconds`);
  }
}
