// Vectors, quaternions and matrices: plain arrays, matrices by columns as WebGL wants them.

/** @typedef {ArrayLike<number>} Vec */

export const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scaled = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const length = (a) => Math.hypot(a[0], a[1], a[2]);
export const mix = (a, b, t) => [a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t, a[2] + (b[2] - a[2]) * t];
export const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

export function normalized(a) {
  const l = length(a) || 1;
  return [a[0] / l, a[1] / l, a[2] / l];
}

/** The rotation of a pose [x, y, z, qx, qy, qz, qw] as nine numbers, by rows. @param {Vec} p */
export function rotationRows(p) {
  const [x, y, z, w] = [p[3], p[4], p[5], p[6]];
  return [
    1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w),
    2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
    2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y),
  ];
}

/** A point of a pose's frame, in the world. @param {Vec} pose @param {Vec} v */
export function transformed(pose, v) {
  const r = rotationRows(pose);
  return [
    r[0] * v[0] + r[1] * v[1] + r[2] * v[2] + pose[0],
    r[3] * v[0] + r[4] * v[1] + r[5] * v[2] + pose[1],
    r[6] * v[0] + r[7] * v[1] + r[8] * v[2] + pose[2],
  ];
}

export function quaternionProduct(a, b) {
  return [
    a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
    a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
    a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
    a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2],
  ];
}

/** Pose b of the frame a, in the world. */
export function poseProduct(a, b) {
  return [...transformed(a, b), ...quaternionProduct([a[3], a[4], a[5], a[6]], [b[3], b[4], b[5], b[6]])];
}

/** @param {number} angle of view from top to bottom, in radians */
export function perspective(angle, aspect, near, far) {
  const f = 1 / Math.tan(angle / 2);
  return [f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, (2 * far * near) / (near - far), 0];
}

/** @param {number} halfHeight half of what is seen from top to bottom, in metres */
export function orthographic(halfHeight, aspect, near, far) {
  const depth = near - far;
  return [1 / (halfHeight * aspect), 0, 0, 0, 0, 1 / halfHeight, 0, 0, 0, 0, 2 / depth, 0, 0, 0, (far + near) / depth, 1];
}

/** World to view; `back` points from the scene to the viewer. */
export function viewMatrix(eye, right, up, back) {
  return [
    right[0], up[0], back[0], 0, right[1], up[1], back[1], 0, right[2], up[2], back[2], 0,
    -dot(right, eye), -dot(up, eye), -dot(back, eye), 1,
  ];
}

export function product(a, b) {
  const out = new Array(16);
  for (let c = 0; c < 4; c++) {
    for (let r = 0; r < 4; r++) {
      out[4 * c + r] = a[r] * b[4 * c] + a[4 + r] * b[4 * c + 1] + a[8 + r] * b[4 * c + 2] + a[12 + r] * b[4 * c + 3];
    }
  }
  return out;
}

/** A point by a matrix, after division: what is seen lies between -1 and 1. */
export function projected(m, v) {
  const w = m[3] * v[0] + m[7] * v[1] + m[11] * v[2] + m[15];
  return [0, 1, 2].map((i) => (m[i] * v[0] + m[4 + i] * v[1] + m[8 + i] * v[2] + m[12 + i]) / w);
}

/** Boxes that contain points; empty at first. */
export class Box {
  constructor() {
    this.low = [Infinity, Infinity, Infinity];
    this.high = [-Infinity, -Infinity, -Infinity];
  }

  get empty() {
    return !(this.low[0] <= this.high[0]);
  }

  get centre() {
    return mix(this.low, this.high, 0.5);
  }

  /** Half of the diagonal. */
  get radius() {
    return this.empty ? 0 : length(sub(this.high, this.low)) / 2;
  }

  include(v) {
    for (let i = 0; i < 3; i++) {
      this.low[i] = Math.min(this.low[i], v[i]);
      this.high[i] = Math.max(this.high[i], v[i]);
    }
  }

  /** Corners of a box in the frame of a pose. @param {Vec[]} box its low and high corner */
  includeBox(pose, [low, high]) {
    for (let i = 0; i < 8; i++) {
      this.include(transformed(pose, [i & 1 ? high[0] : low[0], i & 2 ? high[1] : low[1], i & 4 ? high[2] : low[2]]));
    }
  }
}
