// Rows of the inspector from what the page knows itself, for recordings: nobody is there who could be asked.

const SCENE = -12;
const GROUPS = { jointPosition: 'joint', jointType: 'joint', interval: 'joint', cyclic: 'joint', size: 'shape', layer: 'object' };
const HIDDEN = new Set(['meshes', 'volume', 'boundingBox', 'blob', 'handle', 'parent', 'childOrder', 'selectable', 'modelSelectable']);

const INTEGERS = new Set(['handle', 'uid', 'layer', 'linkedDummy']);

const kind = (name, value) => (INTEGERS.has(name) ? 'int' : name === 'resolution' ? 'intarray2' : Array.isArray(value) ? `vector${value.length}` : { boolean: 'bool', number: 'float' }[typeof value] ?? typeof value);

/** @param {import('./store.js').Store} store @param {number} handle */
export function localRows(store, handle) {
  const row = (name, value, group = 'object', unit = '') => ({ name, type: kind(name, value), value, writable: false, group, unit, label: name });
  if (handle === SCENE) return [row('name', store.scene.name), row('state', store.scene.state), row('time', store.scene.time, 'simulation', 's'), row('timeStep', store.scene.timeStep, 'simulation', 's')];
  const object = store.objects.get(handle);
  if (!object) return [];
  const rows = [row('handle', handle), ...Object.entries(object).filter(([name]) => !HIDDEN.has(name)).map(([name, value]) => row(name, value, GROUPS[name]))];
  const pose = store.poses.get(handle);
  if (pose) rows.push({ ...row('absolutePose', Array.from(pose), 'pose', 'm'), type: 'pose' });
  return rows;
}
