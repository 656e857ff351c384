// Where drags of the gizmo lead: points on axes and planes under the pointer.
import { add, cross, dot, length, normalized, scaled, sub } from '../maths.js';

/** How far along an axis through a point the ray of the pointer passes it; null when it looks along the axis. */
export function alongAxis(ray, point, axis) {
  const side = cross(ray.along, axis);
  const size = dot(side, side);
  if (size < 1e-4) return null;
  return dot(cross(sub(ray.from, point), ray.along), scaled(side, -1)) / size;
}

/** Where the ray meets a plane; null when it looks along it, or away. */
export function onPlane(ray, point, normal) {
  const slope = dot(ray.along, normal);
  if (Math.abs(slope) < 1e-3) return null;
  const distance = dot(sub(point, ray.from), normal) / slope;
  return distance > 0 ? add(ray.from, scaled(ray.along, distance)) : null;
}

/** The angle from one direction to another, about a normal. */
export function angleAbout(normal, from, to) {
  return Math.atan2(dot(cross(from, to), normal), dot(from, to));
}

/** Two directions across an axis. */
export function across(axis) {
  const other = Math.abs(axis[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0];
  const first = normalized(cross(axis, other));
  return [first, cross(axis, first)];
}

export const snapped = (x, by) => (by ? Math.round(x / by) * by : x);

/** Metres and degrees for people. */
export const metres = (x) => `${x.toFixed(Math.abs(x) < 1 ? 3 : 2)} m`;
export const degrees = (x) => `${((x * 180) / Math.PI).toFixed(1)}°`;

export const isLong = (v) => length(v) > 1e-9;
