// The stream of a simulator that runs: messages over a WebSocket, requests with answers, and waiting while it is gone.
import { AUTHOR } from './settings.js';

const WAITS = [500, 1000, 2000, 4000]; // milliseconds before each further attempt

export class LiveSource {
  /** @param {import('./store.js').Store} store */
  constructor(store) {
    this.store = store;
    this.live = true;
    this.count = 0;
    this.failures = 0;
    this.pending = new Map();
    this.standing = new Map([['author', { number: AUTHOR }]]); // requests that the simulator must know again after a pause: inspect, watch, show, sample
  }

  start() {
    const address = new URL('stream', location.href);
    address.protocol = address.protocol.replace('http', 'ws');
    this.socket = new WebSocket(address);
    this.socket.binaryType = 'arraybuffer';
    this.socket.onopen = () => this._opened();
    this.socket.onmessage = (event) => this._message(event.data);
    this.socket.onclose = () => this._closed();
  }

  _opened() {
    this.failures = 0;
    this.store.setBusy(null);
    this.store.setConnection('open');
    for (const [action, members] of this.standing) this._send(action, members).catch(() => {});
  }

  _message(data) {
    if (typeof data !== 'string') return this.store.receiveBinary(data);
    const message = JSON.parse(data);
    if (message.type === 'reply') this._reply(message);
    else if (message.type === 'end') this.store.setConnection('ended', message.reason ?? '');
    else if (message.type === 'busy') this.store.setBusy(message.text);
    else this.store.receive(message);
  }

  _reply({ id, result, error }) {
    const waiting = this.pending.get(id);
    this.pending.delete(id);
    if (error === undefined) waiting?.resolve(result);
    else waiting?.reject(new Error(error));
  }

  _closed() {
    for (const { reject } of this.pending.values()) reject(new Error('The simulator has gone.'));
    this.pending.clear();
    if (this.store.connection.state !== 'ended') this.store.setConnection('closed');
    setTimeout(() => this.start(), WAITS[Math.min(this.failures++, WAITS.length - 1)]);
  }

  /** Asks the simulator. @param {string} action @param {Object<string, any>} [members] @returns {Promise<any>} */
  request(action, members = {}) {
    if (['inspect', 'watch', 'show', 'sample'].includes(action)) this.standing.set(action, members);
    return this._send(action, members);
  }

  _send(action, members) {
    if (this.socket?.readyState !== WebSocket.OPEN) return Promise.reject(new Error('The simulator has gone.'));
    const id = ++this.count;
    this.socket.send(JSON.stringify({ id, do: action, ...members }));
    return new Promise((resolve, reject) => this.pending.set(id, { resolve, reject }));
  }

  /** What the timeline of a capture shows, in frames; null for a simulation that is no capture. */
  get track() {
    const { timeline, scene } = this.store;
    if (!timeline || scene.mode !== 'capture') return null;
    const { frames, end, complete, marks } = timeline;
    const at = scene.frame ?? 0;
    const ending = complete ? `${end.toFixed(1)} s` : `${end.toFixed(1)} s…`;
    return { start: 0, end: Math.max(frames - 1, at), at, step: 1, name: 'Moment of the capture', ending, marks: this._placed(marks), seek: (frame) => this._seek(frame) };
  }

  /** Marks with their places: the same list until others come. */
  _placed(marks) {
    if (this.marks !== marks) (this.marks = marks), (this.places = marks.map((mark) => ({ ...mark, at: mark.frame })));
    return this.places;
  }

  /** Goes to a frame; while the answer is awaited only the last one counts. */
  _seek(frame) {
    this.wanted = frame;
    if (this.seeking) return;
    this.seeking = true;
    const answered = () => {
      this.seeking = false;
      if (this.wanted !== frame) this._seek(this.wanted);
    };
    this._send('seek', { frame }).then(answered, answered);
  }

  /** A mesh, texture, voxels or points. @param {string} hash @returns {Promise<ArrayBuffer>} */
  async blob(hash) {
    const reply = await fetch(`blob/${hash}`);
    if (!reply.ok) throw new Error(`The simulator has no blob ${hash}.`);
    return reply.arrayBuffer();
  }
}
