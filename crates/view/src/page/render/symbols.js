// How objects look that are no shapes: joints, dummies, sensors, cameras, lights. Pure descriptions, in the object's own frame.

/**
 * @typedef {Object} Symbol
 * @property {{mesh: string, scale: number[], pose?: number[], color: number[], opacity?: number, emission?: number[]}[]} solids
 * @property {{points: number[], color: number[]}[]} lines
 */

const at = (x, y, z) => [x, y, z, 0, 0, 0, 1];
const GREY = [0.6, 0.6, 0.62];

/** A circle of radius r in the plane z, from angle to angle. */
function arc(r, z, from = 0, to = 2 * Math.PI, pieces = 32) {
  const points = [];
  for (let i = 0; i < pieces; i++) {
    const [a, b] = [i, i + 1].map((k) => from + ((to - from) * k) / pieces);
    points.push(r * Math.cos(a), r * Math.sin(a), z, r * Math.cos(b), r * Math.sin(b), z);
  }
  return points;
}

function joint(object) {
  const { jointType, jointLength: l = 0.1, jointDiameter: d = 0.02 } = object;
  const color = object.color ?? [1, 0.3, 0.1];
  const solids = {
    revolute: [{ mesh: 'cylinder', scale: [d, d, l], color }, { mesh: 'cylinder', scale: [d * 1.5, d * 1.5, l * 0.4], color: [0.25, 0.4, 0.85] }],
    prismatic: [{ mesh: 'box', scale: [d * 0.7, d * 0.7, l], color }, { mesh: 'box', scale: [d * 1.2, d * 1.2, l * 0.4], color: [0.25, 0.4, 0.85] }],
    spherical: [{ mesh: 'sphere', scale: [d * 1.6, d * 1.6, d * 1.6], color }],
  }[jointType];
  return { solids: solids ?? [], lines: jointType === 'spherical' ? [] : [{ points: [0, 0, -0.75 * l, 0, 0, 0.75 * l], color }] };
}

function dummy({ size = 0.01, color }) {
  return { solids: [{ mesh: 'sphere', scale: [size, size, size], color: color ?? GREY }], lines: axes(size * 1.6) };
}

function forceSensor({ size = 0.02, color = GREY }) {
  const half = (z) => ({ mesh: 'cylinder', scale: [size, size, size * 0.3], pose: at(0, 0, z), color });
  return { solids: [half(-size * 0.25), half(size * 0.25), { mesh: 'cylinder', scale: [size * 0.5, size * 0.5, size * 0.3], color: [0.3, 0.75, 0.35] }], lines: [] };
}

/** Corners of what is seen at a distance: half width and height. */
function halfExtent({ perspective, viewAngle = 1, orthoSize = 1, resolution }, z) {
  const half = perspective === false ? orthoSize / 2 : z * Math.tan(viewAngle / 2);
  const [w, h] = resolution ?? [4, 3];
  return w >= h ? [half, (half * h) / w] : [(half * w) / h, half];
}

function frustum(object) {
  const [near, far] = object.clippingPlanes ?? [0.05, 1];
  const corners = [near, far].map((z) => {
    const [x, y] = halfExtent(object, z);
    return [[x, y, z], [-x, y, z], [-x, -y, z], [x, -y, z]];
  });
  const points = [];
  for (let i = 0; i < 4; i++) {
    const k = (i + 1) % 4;
    points.push(...corners[0][i], ...corners[0][k], ...corners[1][i], ...corners[1][k], ...corners[0][i], ...corners[1][i]);
  }
  return points;
}

function camera(object, chosen) {
  const s = object.size ?? 0.05;
  const color = object.color ?? [0.45, 0.5, 0.58];
  const solids = [
    { mesh: 'box', scale: [s, s * 0.8, s * 1.6], pose: at(0, 0, -s * 0.8), color },
    { mesh: 'cone', scale: [s, s, s * 0.6], pose: [0, 0, s * 0.2, 1, 0, 0, 0], color: [0.2, 0.22, 0.26] },
  ];
  const shown = chosen || (object.showFrustum ?? object.objectType === 'visionSensor');
  return { solids, lines: shown ? [{ points: frustum(object), color: [...color, chosen ? 0.9 : 0.35] }] : [] };
}

function light({ lightType, diffuse = [1, 1, 1], enabled = true, spotAngle = 0.8, size = 0.1 }) {
  const r = size / 2;
  const bulb = { mesh: 'sphere', scale: [r, r, r], color: diffuse, emission: enabled ? diffuse.map((x) => x * 0.6) : [0, 0, 0] };
  const color = [0.85, 0.7, 0.2];
  if (lightType === 'omni') return { solids: [bulb], lines: [] };
  const width = lightType === 'spot' ? Math.min(r * 4 * Math.tan(Math.min(spotAngle, 1.3)), 0.4) : r;
  const rays = [0, 1, 2, 3].flatMap((i) => {
    const [x, y] = [Math.cos((i * Math.PI) / 2) * width, Math.sin((i * Math.PI) / 2) * width];
    return lightType === 'spot' ? [0, 0, 0, x, y, 4 * r] : [x, y, 0, x, y, 4 * r];
  });
  return { solids: [bulb], lines: [{ points: [...rays, ...arc(width, 4 * r)], color }] };
}

function proximitySensor({ volume = [], showVolume = true, size = 0.012, color, detection }) {
  const solids = [{ mesh: 'box', scale: [size, size, size], color: color ?? GREY }];
  const lines = !showVolume ? [] : [{ points: volume, color: [...(color ?? [0.8, 0.2, 0.6]), 0.8] }];
  if (detection?.point) {
    lines.push({ points: [0, 0, 0, ...detection.point], color: [1, 0.75, 0.05] });
    solids.push({ mesh: 'ball', scale: [0.02, 0.02, 0.02], pose: at(...detection.point), color: [1, 0.75, 0.05], emission: [0.4, 0.3, 0] });
  }
  return { solids, lines };
}

/** The axes of a frame: red, green, blue. */
export function axes(size) {
  return [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((direction, i) => ({
    points: [0, 0, 0, ...direction.map((x) => x * size)],
    color: [[0.87, 0.22, 0.2], [0.2, 0.65, 0.25], [0.22, 0.42, 0.92]][i],
  }));
}

const KINDS = { joint, dummy, forceSensor, camera, visionSensor: camera, light, proximitySensor };

/** @param {import('../store.js').SceneObject} object @param {boolean} chosen whether it is selected @returns {Symbol} */
export function symbolOf(object, chosen) {
  return KINDS[object.objectType]?.(object, chosen) ?? { solids: [], lines: [] };
}
