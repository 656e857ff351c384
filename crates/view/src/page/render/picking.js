// What is under the pointer: a few pixels around it are drawn with numbers instead of colours, and distances.
import { product } from '../maths.js';
import { Target } from './gpu/gl.js';

const SIZE = 9; // pixels around the pointer, so that thin things can be met

export class Picker {
  constructor(gl) {
    this.gl = gl;
    this.target = new Target(gl, [SIZE, SIZE], 2, true);
  }

  /**
   * @param {function(number[]): void} draw draws everything with a matrix
   * @param {number[]} matrix of the picture
   * @param {number} x from -1 to 1 @param {number} y @param {number[]} size of the picture in pixels
   * @returns {{number: number, distance: number} | null} the nearest to the pointer
   */
  pick(draw, matrix, x, y, [width, height]) {
    const { gl } = this;
    this.target.begin();
    const [sx, sy] = [width / SIZE, height / SIZE];
    draw(product([sx, 0, 0, 0, 0, sy, 0, 0, 0, 0, 1, 0, -x * sx, -y * sy, 0, 1], matrix));
    const numbers = this._read(0);
    const distances = new Float32Array(this._read(1).buffer);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    return nearest(new Uint32Array(numbers.buffer), distances);
  }

  _read(i) {
    const { gl } = this;
    const bytes = new Uint8Array(4 * SIZE * SIZE);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.target.frame);
    gl.readBuffer(gl.COLOR_ATTACHMENT0 + i);
    gl.readPixels(0, 0, SIZE, SIZE, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    gl.readBuffer(gl.COLOR_ATTACHMENT0);
    return bytes;
  }
}

/** Of the pixels that show something, the one nearest to the middle. */
function nearest(numbers, distances) {
  const middle = (SIZE - 1) / 2;
  let best = null;
  let least = Infinity;
  for (let i = 0; i < numbers.length; i++) {
    const away = (((i % SIZE) - middle) ** 2) + ((Math.floor(i / SIZE) - middle) ** 2);
    if (!numbers[i] || away >= least) continue;
    least = away;
    best = { number: numbers[i], distance: distances[i] };
  }
  return best;
}
