// Poses and rotations in double precision: Euler angles as CoppeliaSim has them, R = Rx(alpha) Ry(beta) Rz(gamma), and inverses.
import { poseProduct, quaternionProduct, rotationRows } from './maths.js';

/** @param {number[]} q quaternion x, y, z, w @returns {number[]} alpha, beta, gamma in radians, beta between -90 and 90 degrees */
export function eulerAngles(q) {
  const r = rotationRows([0, 0, 0, ...q]);
  const level = Math.hypot(r[0], r[1]); // the cosine of beta
  const beta = Math.atan2(r[2], level);
  if (level < 1e-9) return [Math.atan2(r[7], r[4]), beta, 0];
  return [Math.atan2(-r[5], r[8]), beta, Math.atan2(-r[1], r[0])];
}

/** @param {number[]} angles alpha, beta, gamma in radians */
export function quaternionOf([alpha, beta, gamma]) {
  const about = (axis, angle) => [0, 1, 2].map((i) => (i === axis ? Math.sin(angle / 2) : 0)).concat(Math.cos(angle / 2));
  return quaternionProduct(quaternionProduct(about(0, alpha), about(1, beta)), about(2, gamma));
}

/** Of length 1; no rotation where there is none. */
export function unitQuaternion(q) {
  const length = Math.hypot(...q);
  return length > 1e-12 ? q.map((x) => x / length) : [0, 0, 0, 1];
}

export function inversePose([x, y, z, ...q]) {
  const back = [-q[0], -q[1], -q[2], q[3]];
  const place = poseProduct([0, 0, 0, ...back], [-x, -y, -z, 0, 0, 0, 1]);
  return [...place.slice(0, 3), ...back];
}

/** Whether two quaternions are the same rotation. */
export const sameRotation = (a, b) => Math.abs(Math.abs(a.reduce((sum, x, i) => sum + x * b[i], 0)) - 1) < 1e-12;
