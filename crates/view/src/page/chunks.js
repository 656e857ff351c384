// Where a recording comes from: a server, or the page itself (`swanilda export --html`). And how its chunks become messages.

/** @typedef {{time: number, kind: 'text'|'binary', data: any}} Message */

const BLOB = 2;
const HASH_BYTES = 16;

async function gunzip(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Response(stream).arrayBuffer();
}

/** A recording that `swanilda view` serves; null when the simulator runs. */
export async function servedRecording() {
  const reply = await fetch('recording').catch(() => null);
  if (reply?.status !== 200) return null;
  const index = await reply.json();
  return {
    index,
    chunk: async (n) => gunzip(await (await fetch(`recording/${n}`)).arrayBuffer()),
    blob: async (hash) => (await fetch(index.blobs[hash] ?? `blob/${hash}`)).arrayBuffer(),
  };
}

/** A recording inside this page; null when there is none. */
export function inlinedRecording() {
  const text = document.getElementById('recording')?.textContent;
  if (!text) return null;
  const bytes = (n) => Uint8Array.from(atob(document.querySelector(`script[data-chunk="${n}"]`).textContent.trim()), (c) => c.charCodeAt(0));
  return { index: JSON.parse(text), chunk: (n) => gunzip(bytes(n)), blob: null };
}

/** Decodes chunks; equal objects of different chunks become the same object, so that nothing is drawn anew for them. */
export class ChunkDecoder {
  constructor() {
    this.objects = new Map(); // by handle: the text of an object and the object
    this.blobs = new Map();
  }

  /** @param {ArrayBuffer} buffer @returns {Message[]} */
  decode(buffer) {
    const view = new DataView(buffer);
    const messages = [];
    for (let at = 0; at + 13 <= buffer.byteLength; ) {
      const [time, kind, length] = [view.getFloat64(at, true), view.getUint8(at + 8), view.getUint32(at + 9, true)];
      const start = at + 13;
      at = start + length;
      if (kind === BLOB) this._keep(new Uint8Array(buffer, start, length));
      else if (kind === 1) messages.push({ time, kind: 'binary', data: buffer.slice(start, at) });
      else messages.push({ time, kind: 'text', data: this._shared(JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, start, length)))) });
    }
    return messages;
  }

  _keep(bytes) {
    const hash = Array.from(bytes.subarray(0, HASH_BYTES), (byte) => byte.toString(16).padStart(2, '0')).join('');
    this.blobs.set(hash, bytes.slice(HASH_BYTES).buffer);
  }

  _shared(message) {
    message.objects = message.objects?.map((object) => {
      const text = JSON.stringify(object);
      const known = this.objects.get(object.handle);
      if (known?.text === text) return known.object;
      this.objects.set(object.handle, { text, object });
      return object;
    });
    return message;
  }
}
