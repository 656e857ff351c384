// Which properties come first: the few that matter for the type of an object; what is rarely needed comes last.

/** Words for numbers. */
export const CHOICES = {
  jointType: [[10, 'revolute'], [11, 'prismatic'], [12, 'spherical']],
  jointMode: [[0, 'kinematic'], [4, 'dependent'], [5, 'dynamic']],
  dynCtrlMode: [[0, 'free'], [1, 'force'], [4, 'velocity'], [8, 'position'], [12, 'spring'], [16, 'callback']],
  lightType: [[1, 'omnidirectional'], [2, 'spot'], [3, 'directional']],
  sensorType: [[30, 'pyramid'], [31, 'cylinder'], [32, 'disc'], [33, 'cone'], [34, 'ray']],
  scriptType: [[0, 'main'], [1, 'simulation'], [2, 'add-on'], [6, 'customization'], [8, 'sandbox'], [9, 'passive']],
};

/** Names of properties by the type of the object, with shorter words for some. */
const ESSENTIALS = {
  shape: ['alias', ['applyColor.diffuse', 'colour'], 'size', 'mass', 'dynamic', 'respondable'],
  joint: ['alias', ['jointType', 'type'], ['jointMode', 'mode'], ['dynCtrlMode', 'control'], ['jointPosition', 'position'], ['interval', 'limits'], ['cyclic', 'without limits'], ['targetPos', 'target position'],
    ['targetVel', 'target velocity'], ['targetForce', 'largest force'], ['jointForce', 'force']],
  forceSensor: ['alias', ['sensorForce', 'force'], ['sensorTorque', 'torque'], 'forceThreshold', 'torqueThreshold'],
  proximitySensor: ['alias', ['sensorType', 'type'], ['volume_offset', 'offset'], ['volume_range', 'range'], ['volume_angle', 'angle'], ['detectedObjectHandle', 'detects'], 'distance', 'explicitHandling'],
  visionSensor: ['alias', 'resolution', 'perspective', 'viewAngle', 'viewSize', 'clippingPlanes', 'explicitHandling'],
  camera: ['alias', 'perspective', 'viewAngle', 'viewSize', 'clippingPlanes'],
  light: ['alias', ['lightType', 'type'], 'enabled', ['lightColor.diffuse', 'colour'], 'spotCutoffAngle'],
  dummy: ['alias', ['dummySize', 'size'], 'dummyType', ['linkedDummyHandle', 'linked to']],
  script: ['alias', ['scriptType', 'type'], 'language', ['scriptDisabled', 'disabled'], 'execPriority'],
  graph: ['alias'],
};
const LAST = ['data', 'model', 'mouse', 'engine'];

/** Headings of groups that do not say enough by themselves. */
export const TITLES = { engine: 'settings of physics engines', mouse: 'moving by mouse', model: 'model' };
export const FOLDED = new Set(LAST);

/** Names of rows that are no properties. */
export const MADE = new Set(['size', 'distance', 'applyColor.diffuse']);

/** Rows that the page makes from others. @param {Map<string, any>} rows by name @param {any} object */
export function madeRows(rows, object) {
  const row = (name, type, value, unit = '', writable = false) => ({ name, type, value, unit, writable, group: 'shape', label: name });
  const made = [];
  const half = rows.get('bbHSize')?.value;
  if (half) made.push(row('size', 'vector3', half.map((x) => 2 * x), 'm', true));
  const color = object?.meshes?.[0]?.color?.diffuse;
  if (color && rows.has('mass')) made.push(row('applyColor.diffuse', 'color', color, '', true));
  const point = rows.get('detectedPoint')?.value;
  if (point) made.push(row('distance', 'float', rows.get('detectedObjectHandle')?.value >= 0 ? Math.hypot(...point) : null, 'm'));
  return made;
}

/**
 * @param {any[]} rows @param {any} object
 * @returns {{main: any[], groups: [string, any[]][]}} what matters, with the words for it, and the rest
 */
export function arranged(rows, object) {
  const byName = new Map(rows.map((row) => [row.name, row]));
  for (const made of madeRows(byName, object)) byName.set(made.name, made);
  const main = (ESSENTIALS[object?.objectType] ?? []).map((entry) => (Array.isArray(entry) ? entry : [entry, null])).filter(([name]) => byName.has(name));
  const taken = new Set(['pose', 'absolutePose', ...main.map(([name]) => name)]);
  const groups = new Map();
  for (const row of rows) {
    const name = row.group || 'other';
    if (taken.has(row.name)) continue;
    if (!groups.has(name)) groups.set(name, []);
    groups.get(name).push(row);
  }
  const order = ([name]) => LAST.indexOf(name);
  return { main: main.map(([name, word]) => ({ ...byName.get(name), label: word ?? byName.get(name).label })), groups: [...groups].sort((a, b) => order(a) - order(b)) };
}
