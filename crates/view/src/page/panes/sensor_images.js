// Images of vision sensors: who wants to see which, and how they get on a canvas.

/** The simulator sends images that somebody watches. */
export class SensorImages {
  constructor(source) {
    this.source = source;
    this.wanted = new Map(); // handles by who wants them
  }

  /** @param {any} who @param {number[]} handles instead of those from before */
  watch(who, handles) {
    const before = this._all();
    if (handles.length) this.wanted.set(who, handles);
    else this.wanted.delete(who);
    const now = this._all();
    if (now.join() !== before.join()) this.source.request('watch', { handles: now }).catch(() => {});
  }

  _all() {
    return [...new Set([...this.wanted.values()].flat())].sort((a, b) => a - b);
  }
}

/** @param {HTMLCanvasElement} canvas @param {{width: number, height: number, rgb: Uint8Array} | undefined} image @returns {boolean} whether there was one */
export function drawImage(canvas, image) {
  if (!image || !image.width || image.rgb.length < 3 * image.width * image.height) return false;
  const { width, height, rgb } = image;
  Object.assign(canvas, { width, height });
  const pixels = new ImageData(width, height);
  for (let i = 0, n = width * height; i < n; i++) {
    for (let k = 0; k < 3; k++) pixels.data[4 * i + k] = rgb[3 * i + k];
    pixels.data[4 * i + 3] = 255;
  }
  canvas.getContext('2d').putImageData(pixels, 0, 0);
  return true;
}
