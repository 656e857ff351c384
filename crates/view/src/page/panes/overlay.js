// What lies over the scene: notices, the name of what the pointer rests on, the directions of the axes, the size of the grid.
import { el, setText, svg } from '../dom.js';
import { sentenceOf } from './scripts/debugging.js';

const SIZE = 76;
const AXES = [['X', [1, 0, 0], 'axis-x'], ['Y', [0, 1, 0], 'axis-y'], ['Z', [0, 0, 1], 'axis-z']];
const SHORT = 3000; // milliseconds
const MOMENT = 300; // the same: what takes less is not worth a sentence

export class Overlay {
  constructor(page) {
    Object.assign(this, { page, store: page.store, since: null, loading: null });
    this.sentence = el('span');
    this.stop = el('button', { type: 'button', class: 'answer-button', hidden: true, onclick: () => page.ask('stop') }, 'Stop');
    this.notice = document.getElementById('notice');
    this.notice.replaceChildren(this.sentence, this.stop, page.script.debugging.buttons);
    this.tip = el('div', { class: 'tip', role: 'tooltip', hidden: true });
    this.grid = el('span', { class: 'grid-size' });
    this.lines = AXES.map(([name, , kind]) => ({ line: svg('line', { class: kind }), label: svg('text', { class: kind, 'text-anchor': 'middle', dy: '0.35em' }, name) }));
    this.axes = svg('svg', { class: 'axes', viewBox: `${-SIZE / 2} ${-SIZE / 2} ${SIZE} ${SIZE}`, role: 'group', 'aria-label': 'Directions of the axes' }, ...this.lines.flatMap(({ line, label }) => [line, label]));
    document.getElementById('overlay').append(this.axes, this.grid, this.tip);
    for (const topic of ['connection', 'scene', 'objects', 'stopped']) this.store.on(topic, () => this._notice());
    this._notice();
  }

  /** One sentence about what to do, or nothing. */
  _notice() {
    const { connection, scene, objects, busy, stopped: halt } = this.store;
    const sentences = {
      connecting: 'Connecting to the simulator…',
      closed: 'The simulator has gone. Reconnecting…',
      ended: `The simulator has ended${connection.reason ? `: ${connection.reason}` : ''}. Start it again to see more.`,
    };
    const empty = !objects.size ? (scene.state ? 'The scene is empty.' : 'Loading the scene…') : null;
    const stopped = scene.state === 'stopped' && this.page.canWrite && !scene.steps ? 'The simulation is stopped. Press Space to start.' : null;
    const urgent = this.page.failure ?? sentences[connection.state] ?? busy;
    const text = urgent ?? this.said ?? (halt && sentenceOf(halt, this.store)) ?? empty ?? this.loading ?? stopped ?? '';
    setText(this.sentence, text);
    this.stop.hidden = urgent !== busy || !busy || !this.page.canWrite;
    this.notice.hidden = !text;
    this.notice.classList.toggle('urgent', !!urgent);
  }

  /** Shows a sentence for a while. */
  say(sentence) {
    this.said = sentence;
    this._notice();
    clearTimeout(this.timer);
    this.timer = setTimeout(() => ((this.said = null), this._notice()), SHORT);
  }

  /** @param {{handle: number} | null} hit */
  hover(hit, x, y) {
    const object = hit && this.store.objects.get(hit.handle);
    const { renderer } = this.page;
    const hovered = object ? hit.handle : -1;
    if (renderer.hovered !== hovered) Object.assign(renderer, { hovered, stale: true });
    this.tip.hidden = !object;
    if (!object) return;
    this.tip.replaceChildren(el('strong', {}, object.alias), ` ${object.objectType}`);
    this.tip.style.left = `${Math.min(x + 14, renderer.canvas.parentElement.clientWidth - 160)}px`;
    this.tip.style.top = `${y + 16}px`;
  }

  /** Says so when meshes are on their way for longer than a moment. */
  _loads(now) {
    this.since = this.page.renderer.resources.busy ? this.since ?? now : null;
    const loading = this.since !== null && now - this.since > MOMENT ? 'Loading meshes and textures…' : null;
    if (loading === this.loading) return;
    this.loading = loading;
    this._notice();
  }

  /** After each picture. */
  frame() {
    const { matrices, spacing, options } = this.page.renderer;
    this._loads(performance.now());
    if (!matrices || matrices === this.drawn) return;
    this.drawn = matrices;
    const { right, up, forward } = matrices;
    const arm = SIZE / 2 - 12;
    AXES.forEach(([, axis], i) => {
      const along = (direction) => axis.reduce((sum, x, k) => sum + x * direction[k], 0);
      const [x, y, away] = [along(right) * arm, -along(up) * arm, along(forward)];
      const { line, label } = this.lines[i];
      set(line, { x1: 0, y1: 0, x2: x, y2: y, opacity: away > 0.2 ? 0.45 : 1 });
      set(label, { x: x * 1.24, y: y * 1.24, opacity: away > 0.2 ? 0.45 : 1 });
    });
    setText(this.grid, options.grid && spacing ? `Grid ${size(spacing)}` : '');
  }
}

function set(element, members) {
  for (const [name, value] of Object.entries(members)) element.setAttribute(name, typeof value === 'number' ? value.toFixed(2) : value);
}

const size = (metres) => (metres >= 1 ? `${metres} m` : metres >= 0.01 ? `${+(metres * 100).toPrecision(3)} cm` : `${+(metres * 1000).toPrecision(3)} mm`);
