// Plays a recording: feeds the store with the messages of the moment that is shown, and knows the whole run for curves and console.
import { ChunkDecoder } from './chunks.js';
import { localRows } from './local_rows.js';

const NEED_SIMULATOR = 'This is a recording: the simulator is not there.';

/** The time in seconds with which a link begins the recording: `run.html#t=3.2`. */
function timeOfLink() {
  const found = /^#t=([\d.]+)$/.exec(globalThis.location?.hash ?? '');
  return found ? Number(found[1]) : undefined;
}

export class ReplaySource {
  /** @param {import('./store.js').Store} store @param {{index: any, chunk: function, blob: function?}} recording */
  constructor(store, recording) {
    this.store = store;
    this.recording = recording;
    this.index = recording.index;
    this.live = false;
    this.time = this.start_time = this.index.start ?? this.index.chunks[0]?.time ?? 0;
    this.end_time = this.index.end ?? this.index.chunks.at(-1)?.time ?? 0;
    this.speed = 1;
    this.playing = false;
    this.decoder = new ChunkDecoder();
    /** @type {Map<number, Promise<import('./chunks.js').Message[]>>} */
    this.chunks = new Map();
    this.shown = { chunk: -1, next: 0, time: -Infinity };
    this.log = [];
    this.listeners = new Set(); // of time and playing
  }

  async start() {
    this.store.setConnection('open');
    await this.seek(timeOfLink() ?? this.start_time);
    this._readAhead();
  }

  /** Reads all chunks, one after the other: the console and curves need them. */
  async _readAhead() {
    const seen = new Set();
    for (let n = 0; n < this.index.chunks.length; n++) {
      for (const { kind, data } of await this._chunk(n)) {
        if (kind === 'text') this._collectLog(data, seen);
      }
      this._showLog();
    }
    this.complete = true;
    this._notify();
  }

  /** Lines of snapshots may have been there before. */
  _collectLog(message, seen) {
    for (const line of message.log ?? []) {
      const key = JSON.stringify([line.time, line.origin, line.text]);
      if (message.type === 'snapshot' && seen.has(key)) continue;
      seen.add(key);
      this.log.push(line);
    }
  }

  _showLog() {
    const { store } = this;
    store.log = this.log.filter((line) => line.time <= this.time + 1e-9);
    store.loggedLines = store.log.length;
    store.dirty.add('log');
  }

  _chunk(n) {
    if (!this.chunks.has(n)) this.chunks.set(n, this.recording.chunk(n).then((buffer) => this.decoder.decode(buffer)));
    return this.chunks.get(n);
  }

  _chunkAt(time) {
    const after = this.index.chunks.findIndex((chunk) => chunk.time > time + 1e-9);
    return Math.max((after < 0 ? this.index.chunks.length : after) - 1, 0);
  }

  /** Shows the moment `time`. The last call counts, when several wait for chunks. */
  async seek(time) {
    this.time = Math.min(Math.max(time, this.start_time), this.end_time);
    this._notify();
    const n = this._chunkAt(this.time);
    if (!this.index.chunks.length) return;
    const messages = await this._chunk(n);
    if (n === this._chunkAt(this.time)) this._show(n, messages);
  }

  _show(n, messages) {
    const { shown, store } = this;
    const goesOn = shown.chunk === n && shown.time <= this.time;
    if (!goesOn) Object.assign(shown, { chunk: n, next: 0 });
    for (; shown.next < messages.length && messages[shown.next].time <= this.time + 1e-9; shown.next++) {
      const { kind, data } = messages[shown.next];
      if (kind === 'text') store.receive(this.hasSelected ? { ...data, selection: store.selection } : data);
      else store.receiveBinary(data);
    }
    shown.time = this.time;
    this._showLog();
    if (this.inspected !== undefined) store.properties = { handle: this.inspected, values: localRows(store, this.inspected) };
    store.dirty.add('properties');
  }

  /** What a timeline shows, in seconds. */
  get track() {
    const { start_time: start, end_time: end, time } = this;
    return { start, end, at: time, step: 'any', name: 'Time in the recording', ending: `${end.toFixed(1)} s`, marks: this.marks, seek: (to) => this.seek(to) };
  }

  /** Marks with their places. */
  get marks() {
    this.placed ??= (this.index.marks ?? []).map((mark) => ({ ...mark, at: mark.time }));
    return this.placed;
  }

  /** Goes on by the time of a picture, in seconds of the wall clock. */
  advance(seconds) {
    if (!this.playing) return;
    if (this.time >= this.end_time) this.setPlaying(false);
    else this.seek(this.time + seconds * this.speed);
  }

  setPlaying(playing) {
    if (playing && this.time >= this.end_time) this.seek(this.start_time);
    this.playing = playing;
    this._notify();
  }

  _notify() {
    this.listeners.forEach((listener) => listener());
  }

  /** The same requests as of a live source, as far as a recording has answers. */
  async request(action, { handle, factor, count } = /** @type {any} */ ({})) {
    const actions = {
      play: () => this.setPlaying(true),
      pause: () => this.setPlaying(false),
      stop: () => (this.setPlaying(false), this.seek(this.start_time)),
      step: () => (this.setPlaying(false), this.seek(this.time + (count ?? 1) * (this.index.timeStep ?? this.store.scene.timeStep ?? 0.05))),
      speed: () => ((this.speed = factor || 1), this._notify()),
      select: () => void (this.hasSelected = true), // from then on not what was selected in the run
      inspect: () => ((this.inspected = handle), localRows(this.store, handle)),
      watch: () => null,
      show: () => null,
    };
    if (!actions[action]) throw new Error(NEED_SIMULATOR);
    return actions[action]();
  }

  async blob(hash) {
    if (this.decoder.blobs.has(hash)) return this.decoder.blobs.get(hash);
    if (this.recording.blob) return this.recording.blob(hash);
    await this._chunk(Number(this.index.blobs[hash] ?? 0));
    if (!this.decoder.blobs.has(hash)) throw new Error(`The recording has no blob ${hash}.`);
    return this.decoder.blobs.get(hash);
  }

  /**
   * A curve over the whole recording: what `read` finds in each message.
   * @param {function(any, 'text'|'binary'): number|undefined} read
   * @returns {Promise<{x: number[], y: number[]}>}
   */
  async curve(read) {
    const [x, y] = [[], []];
    for (let n = 0; n < this.index.chunks.length; n++) {
      for (const { time, kind, data } of await this._chunk(n)) {
        const value = read(data, kind);
        if (value !== undefined) x.push(time), y.push(value);
      }
    }
    return { x, y };
  }
}
