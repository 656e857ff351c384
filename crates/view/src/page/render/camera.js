// The viewer's camera: a place, two angles and the distance of what it looks at. It never rolls, so it cannot flip at the poles.
import { add, clamp, cross, dot, mix, normalized, orthographic, perspective, product, rotationRows, scaled, sub, viewMatrix } from '../maths.js';

const STEEPEST = Math.PI / 2 - 0.001;
const EASING = 0.22; // seconds of an eased motion

export class Camera {
  constructor() {
    this.yaw = -0.95; // direction of looking in the plane of the ground
    this.pitch = -0.42;
    this.distance = 3; // of the focus
    this.eye = [0, 0, 0];
    this.angle = 0.75; // of view
    this.perspective = true;
    this.motion = null;
    this.fixed = null; // pose and angle of one of the scene's cameras
    this.lookAt([0, 0, 0.3], 4);
  }

  get forward() {
    const c = Math.cos(this.pitch);
    return [c * Math.cos(this.yaw), c * Math.sin(this.yaw), Math.sin(this.pitch)];
  }

  get focus() {
    return add(this.eye, scaled(this.forward, this.distance));
  }

  /** Right, up and forward. */
  axes() {
    if (this.fixed) {
      const r = rotationRows(this.fixed.pose); // a scene's camera looks along its z axis, with y up
      return { right: [-r[0], -r[3], -r[6]], up: [r[1], r[4], r[7]], forward: [r[2], r[5], r[8]] };
    }
    const forward = this.forward;
    const right = [Math.sin(this.yaw), -Math.cos(this.yaw), 0];
    return { right, up: cross(right, forward), forward };
  }

  /** Moves so that `point` is in the middle at a distance. */
  lookAt(point, distance = this.distance) {
    this.distance = distance;
    this.eye = sub(point, scaled(this.forward, distance));
  }

  /** Turns about a point that stays where it is on the screen. */
  orbit(pivot, turn, tilt) {
    this._leave();
    const before = this.axes();
    const local = sub(this.eye, pivot);
    const parts = [dot(local, before.right), dot(local, before.up), dot(local, before.forward)];
    this.yaw += turn;
    this.pitch = clamp(this.pitch + tilt, -STEEPEST, STEEPEST);
    const { right, up, forward } = this.axes();
    this.eye = add(pivot, add(add(scaled(right, parts[0]), scaled(up, parts[1])), scaled(forward, parts[2])));
  }

  /** Moves sideways: pixels on a screen of this height, at the distance of what was grabbed. */
  pan(dx, dy, height, depth) {
    this._leave();
    const scale = (2 * Math.tan(this.angle / 2) * (this.perspective ? depth : this.distance)) / height;
    const { right, up } = this.axes();
    this.eye = add(this.eye, add(scaled(right, -dx * scale), scaled(up, dy * scale)));
  }

  /** Comes nearer to a point by a factor below 1, or goes away. */
  zoom(point, factor) {
    this._leave();
    const closest = 0.01;
    if (this.distance * factor < closest) return;
    this.eye = add(point, scaled(sub(this.eye, point), factor));
    this.distance = Math.min(this.distance * factor, 1e5);
  }

  /** Looks from a direction. @param {number} yaw @param {number} pitch */
  turnTo(yaw, pitch) {
    const nearest = yaw + 2 * Math.PI * Math.round((this.yaw - yaw) / (2 * Math.PI));
    this._ease({ yaw: nearest, pitch: clamp(pitch, -STEEPEST, STEEPEST), focus: this.focus, distance: this.distance });
  }

  /** Shows a sphere of the scene. */
  fit(centre, radius, aspect, at_once = false) {
    const angle = Math.min(this.angle, 2 * Math.atan(Math.tan(this.angle / 2) * aspect));
    const goal = { yaw: this.yaw, pitch: this.pitch, focus: centre, distance: Math.max((radius * 1.12) / Math.sin(angle / 2), 0.05) };
    if (at_once) this._apply(goal);
    else this._ease(goal);
  }

  _ease(goal) {
    this._leave();
    if (matchMedia('(prefers-reduced-motion: reduce)').matches) return this._apply(goal);
    this.motion = { from: { yaw: this.yaw, pitch: this.pitch, focus: this.focus, distance: this.distance }, to: goal, passed: 0 };
  }

  _apply({ yaw, pitch, focus, distance }) {
    Object.assign(this, { yaw, pitch });
    this.lookAt(focus, distance);
  }

  /** Goes on with an eased motion. @returns {boolean} whether the camera moved */
  advance(seconds) {
    const { motion } = this;
    if (!motion) return false;
    motion.passed += seconds;
    const part = clamp(motion.passed / EASING, 0, 1);
    const t = part * part * (3 - 2 * part);
    const between = (name) => motion.from[name] + (motion.to[name] - motion.from[name]) * t;
    this._apply({ yaw: between('yaw'), pitch: between('pitch'), distance: between('distance'), focus: mix(motion.from.focus, motion.to.focus, t) });
    if (part === 1) this.motion = null;
    return true;
  }

  /** Looks through one of the scene's cameras. */
  setFixed(pose, object) {
    this.motion = null;
    this.fixed = { pose, angle: object.viewAngle ?? this.angle, perspective: object.perspective !== false, size: object.orthoSize ?? 1 };
    this.eye = [pose[0], pose[1], pose[2]];
  }

  /** Leaves a camera of the scene, from where it was. */
  _leave() {
    this.motion = null;
    if (!this.fixed) return;
    const { forward } = this.axes();
    this.fixed = null;
    this.yaw = Math.atan2(forward[1], forward[0]);
    this.pitch = clamp(Math.asin(clamp(forward[2], -1, 1)), -STEEPEST, STEEPEST);
  }

  release() {
    this._leave();
  }

  /** Matrices for a picture; `reach` is the distance beyond which nothing is. */
  matrices(aspect, reach) {
    const { right, up, forward } = this.axes();
    const angle = this._verticalAngle(aspect);
    const far = Math.max(reach, this.distance * 4);
    const near = Math.max(Math.min(this.distance * 0.02, 0.1), far / 1e5);
    const isPerspective = this.fixed ? this.fixed.perspective : this.perspective;
    const half = this.fixed ? this.fixed.size / 2 : Math.tan(this.angle / 2) * this.distance;
    const projection = isPerspective ? perspective(angle, aspect, near, far) : orthographic(half, aspect, -far, far);
    const view = viewMatrix(this.eye, right, up, scaled(forward, -1));
    return { matrix: product(projection, view), right, up, forward, angle, half, isPerspective };
  }

  /** A scene's camera gives the angle of the longer side. */
  _verticalAngle(aspect) {
    if (!this.fixed) return this.angle;
    return aspect > 1 ? 2 * Math.atan(Math.tan(this.fixed.angle / 2) / aspect) : this.fixed.angle;
  }

  /** The ray through a place of the picture, -1 to 1. */
  ray(x, y, aspect) {
    const { right, up, forward, angle, half, isPerspective } = this.matrices(aspect, 1);
    const size = isPerspective ? Math.tan(angle / 2) : half;
    const side = add(scaled(right, x * size * aspect), scaled(up, y * size));
    if (!isPerspective) return { from: add(this.eye, side), along: forward };
    return { from: this.eye, along: normalized(add(forward, side)) };
  }
}
