// The bar at the bottom: play, step, stop, speed and time; of recordings and captures with a timeline.
import { el, iconButton, setIcon, setText } from '../dom.js';
import { Timeline } from './timeline.js';

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10];
const STATES = { stopped: 'stopped', running: 'running', paused: 'paused' };

export class Bar {
  constructor(bar, page) {
    Object.assign(this, { page, store: page.store, source: page.source });
    this.play = iconButton('play', 'Start (Space)', () => this.toggle());
    this.back = iconButton('step', 'Step back (,)', () => this.step(-1), { class: 'icon-button mirrored' });
    this.ahead = iconButton('step', 'One step (.)', () => this.step(1));
    this.stop = iconButton('stop', 'Stop (Shift+Space)', () => this.page.ask('stop'));
    const speeds = SPEEDS.map((factor) => el('option', { value: factor }, `${factor}×`));
    if (this.source.live) speeds.push(el('option', { value: 0 }, 'max'));
    this.speed = el('select', { 'aria-label': 'Speed', title: 'Speed; max is as fast as possible', onchange: () => this.page.ask('speed', { factor: Number(this.speed.value) }) }, ...speeds);
    this.speed.value = '1';
    this.time = el('output', { class: 'time-now', 'aria-label': 'Simulation time' }, '0.000 s');
    this.state = el('span', { class: 'state', role: 'status' });
    this.timeline = new Timeline(this.source);
    this.live = el('button', { type: 'button', class: 'answer-button go-on', title: 'The simulation goes on live from this moment (G)', onclick: () => this.goOn() }, 'Go on from here');
    bar.append(this.play, this.back, this.ahead, this.stop, this.speed, this.time, this.state, ...this.timeline.elements, this.live);
    for (const topic of ['scene', 'timeline', 'stopped']) this.store.on(topic, () => this._update());
    this.source.listeners?.add(() => this._update());
    this._update();
  }

  /** Whether a capture is shown. */
  get isCapture() {
    return this.source.live && this.store.scene.mode === 'capture';
  }

  get running() {
    if (this.store.stopped) return false;
    if (this.isCapture) return this.store.scene.playing;
    return this.source.live ? this.store.scene.state === 'running' : this.source.playing;
  }

  toggle() {
    this.page.ask(this.running ? 'pause' : 'play');
  }

  /** @param {number} count below zero back, where there is a timeline */
  step(count) {
    if (count > 0 || this.source.track) this.page.ask('step', { count });
  }

  /** A capture goes on live. What the page has selected stays so. */
  async goOn() {
    if (!this.isCapture || !this.store.scene.goesOn) return;
    const { selection } = this.store;
    await this.page.ask('live');
    this.source.request('select', { handles: selection }).catch(() => {}); // gone again
  }

  jump(by) {
    this.timeline.jump(by);
  }

  /** What is shown, in words. */
  _words() {
    const { scene, timeline } = this.store;
    if (!this.source.live) return '';
    if (this.store.stopped) return 'at a breakpoint';
    if (!this.isCapture) return STATES[scene.state] ?? '';
    if (!timeline?.complete) return 'capture, being read';
    return scene.frame === timeline.frames - 1 ? timeline.outcome : 'capture';
  }

  _update() {
    const { scene } = this.store;
    const time = (this.source.live ? scene.time : this.source.time) ?? 0;
    setIcon(this.play, this.running ? 'pause' : 'play', this.running ? 'Pause (Space)' : 'Start (Space)');
    setText(this.time, `${time.toFixed(3)} s`);
    const speed = String(this.source.live ? (scene.realTime === false && !scene.speed ? 0 : scene.speed ?? 1) : this.source.speed);
    if (document.activeElement !== this.speed && [...this.speed.options].some((option) => option.value === speed)) this.speed.value = speed;
    setText(this.state, this._words());
    this.state.title = this.state.textContent;
    this.back.hidden = !this.source.track;
    this.live.hidden = !(this.isCapture && scene.goesOn);
    for (const button of [this.play, this.ahead, this.stop, this.speed]) button.disabled = this.source.live && !this.page.canWrite && !this.isCapture;
    this.timeline.update();
    this.timeline.describe(`${time.toFixed(2)} seconds`);
  }
}
