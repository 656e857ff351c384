// Where an object is: position and rotation, in the world or beside its parent, as Euler angles or a quaternion; every number can be changed.
import { copyText, el, iconButton } from '../../dom.js';
import { poseProduct } from '../../maths.js';
import { eulerAngles, inversePose, quaternionOf, sameRotation, unitQuaternion } from '../../rotation.js';
import { remember, setting } from '../../settings.js';
import { NumberField, withoutNoise } from './number.js';
import { chooseAngles, inDegrees } from './units.js';

const POSITION = ['x', 'y', 'z'];
const EULER = [['α', 'alpha'], ['β', 'beta'], ['γ', 'gamma']];
const QUATERNION = ['qx', 'qy', 'qz', 'qw'].map((name) => [name, name]);

const ORIGIN = [0, 0, 0, 0, 0, 0, 1];

/** A pose of the world in the frame of another one; itself in that of the world, so that no digit changes. */
const poseIn = (frame, pose) => (frame === ORIGIN ? pose : poseProduct(inversePose(frame), pose));

/** A choice that is kept. */
function choice(label, name, usual, options, changed) {
  const list = el('select', { 'aria-label': label, title: label, onchange: () => (remember(name, list.value), changed()) }, ...options.map(([value, text]) => el('option', { value }, text)));
  list.value = setting(name, usual);
  return list;
}

export class PoseBlock {
  /**
   * @param {{pose?: any, absolutePose?: any}} rows of the inspector, as they change
   * @param {{isRoot: boolean, writable: boolean, set: function(number[]): Promise<any>, lua: function(any): string, again: function(): void, curve?: HTMLElement}} how `again`: angles are shown in another unit
   * @param {any} entered the angles of the block before
   */
  constructor(rows, how, entered = null) {
    Object.assign(this, { rows, how, entered });
    this.fields = el('div', { class: 'pose-fields' });
    const angles = el('select', { 'aria-label': 'Angles', title: 'Angles', onchange: () => (chooseAngles(angles.value), how.again()) }, el('option', { value: 'degrees' }, '°'), el('option', { value: 'radians' }, 'rad'));
    angles.value = inDegrees() ? 'degrees' : 'radians';
    const frame = choice('Frame of the pose', 'pose frame', 'world', [['world', 'World'], ['parent', 'Parent']], () => this._build());
    const rotation = choice('Rotation as', 'pose rotation', 'euler', [['euler', 'Euler'], ['quaternion', 'Quat.']], () => this._build());
    const copy = iconButton('copy', 'Copy the pose as Lua', () => copyText(how.lua(this._row())), { class: 'icon-button copy' });
    this.element = el('section', { class: 'pose-block', 'aria-label': 'Pose' }, el('div', { class: 'pose-head' }, rows.pose ? frame : el('span', { class: 'label' }, 'World'), rotation, angles, copy, how.curve), this.fields);
    this._build();
  }

  get _inWorld() {
    return !this.rows.pose || setting('pose frame', 'world') === 'world';
  }

  _row() {
    return this._inWorld ? this.rows.absolutePose ?? this.rows.pose : this.rows.pose;
  }

  get _isEuler() {
    return setting('pose rotation', 'euler') === 'euler';
  }

  _build() {
    const turning = this._isEuler ? EULER : QUATERNION;
    const names = [...POSITION.map((name) => [name, name]), ...turning];
    const values = this._values();
    this.numbers = names.map(([, name], i) => new NumberField({ label: name, value: values[i], unit: i < 3 ? 'm' : this._isEuler ? 'rad' : '', form: withoutNoise, change: (fresh) => this._changed(i, fresh) }));
    const cells = names.map(([shown], i) => this._cell(shown, this.numbers[i]));
    this.fields.replaceChildren(el('div', {}, ...cells.slice(0, 3)), el('div', {}, ...cells.slice(3)));
  }

  _cell(name, field) {
    const label = el('span', { class: 'label' }, name);
    const shown = this.how.writable ? field.element : (field.element.readOnly = true, field.element);
    if (this.how.writable) field.draggedBy(label);
    return el('div', { class: 'pose-cell' }, label, shown, el('span', { class: 'unit' }, field.unit));
  }

  /** The numbers that are shown, in metres and radians. */
  _values() {
    const pose = this._row().value;
    const turn = pose.slice(3);
    if (!this._isEuler) return [...pose];
    const angles = this.entered && sameRotation(this.entered.turn, turn) ? this.entered.angles : eulerAngles(turn);
    return [...pose.slice(0, 3), ...angles];
  }

  _changed(i, fresh) {
    const pose = [...this._row().value];
    if (i < 3) pose[i] = fresh;
    else pose.splice(3, 4, ...this._turned(i - 3, fresh));
    this._give(pose);
  }

  /** What is asked for is taken for granted until it is refused, so that the next change goes on from it. */
  _give(pose) {
    const { rows } = this;
    const before = [rows.pose.value, rows.absolutePose?.value];
    const parent = this._parent();
    const inParent = this._inWorld ? poseIn(parent, pose) : pose;
    rows.pose.value = inParent;
    if (rows.absolutePose) rows.absolutePose.value = this._inWorld ? pose : poseProduct(parent, pose);
    const asked = (this.asked = this.how.set(inParent));
    asked.finally(() => this.asked === asked && (this.asked = null)).catch(() => {
      rows.pose.value = before[0];
      if (rows.absolutePose) rows.absolutePose.value = before[1];
      this.reset();
      this.update();
    });
  }

  /** The parent in the world. */
  _parent() {
    if (this.how.isRoot || !this.rows.absolutePose) return ORIGIN;
    return poseProduct(this.rows.absolutePose.value, inversePose(this.rows.pose.value));
  }

  _turned(i, fresh) {
    if (!this._isEuler) return unitQuaternion(this._row().value.slice(3).map((x, k) => (k === i ? fresh : x)));
    const angles = this._values().slice(3).map((x, k) => (k === i ? fresh : x));
    const turn = quaternionOf(angles);
    this.entered = { angles, turn }; // shown as they were entered, as long as they are the rotation
    return turn;
  }

  /** After the rows have changed. */
  update() {
    const values = this._values();
    this.numbers.forEach((field, i) => field.show(values[i]));
  }

  reset() {
    this.numbers.forEach((field) => field.reset());
  }
}
