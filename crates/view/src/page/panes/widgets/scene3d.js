// The element scene3d of simUI: entities with meshes, materials and transforms, in the terms of Qt3D, on a canvas. All of them share one context of WebGL.
import { add, Box, cross, dot, length, normalized, perspective, product, projected, quaternionProduct, rotationRows, scaled, sub, viewMatrix } from '../../maths.js';
import { el } from '../../dom.js';
import { context, PLACES, Program } from '../../render/gpu/gl.js';
import { box, cylinder, quad, sphere, torus } from '../../render/gpu/primitives.js';

const SIZE = [320, 240]; // pixels
const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
const MOST_LIGHTS = 4;
const VERTEX = `
in vec3 position; in vec3 normal; out vec3 at; out vec3 facing;
uniform mat4 model; uniform mat4 view_projection;
void main() {
  vec4 world = model * vec4(position, 1.0);
  at = world.xyz;
  facing = transpose(inverse(mat3(model))) * normal;
  gl_Position = view_projection * world;
}`;
const FRAGMENT = `
in vec3 at; in vec3 facing; out vec4 color;
uniform vec3 eye; uniform vec3 ambient; uniform vec3 diffuse; uniform vec3 specular; uniform float shininess;
uniform vec4 lights[${MOST_LIGHTS}]; uniform vec4 light_colors[${MOST_LIGHTS}];
void main() {
  vec3 n = normalize(facing), back = normalize(eye - at), sum = ambient;
  if (dot(n, back) < 0.0) n = -n;
  for (int i = 0; i < ${MOST_LIGHTS}; i++) {
    vec3 l = normalize(lights[i].xyz - lights[i].w * at);
    float shine = pow(max(dot(n, normalize(l + back)), 0.0), shininess);
    sum += light_colors[i].rgb * (diffuse * max(dot(n, l), 0.0) + specular * shine);
  }
  color = vec4(sum, 1.0);
}`;

/** Along y, as Qt3D has them. */
const upright = (mesh) => ({ ...mesh, positions: turned(mesh.positions), normals: turned(mesh.normals) });
const turned = (numbers) => Array.from({ length: numbers.length }, (_, i) => (i % 3 === 0 ? numbers[i] : i % 3 === 1 ? numbers[i + 1] : -numbers[i - 1]));

/** Meshes and their scale by type; `p` reads a parameter. */
const MESHES = {
  'mesh-cuboid': (p) => ['cuboid', box, [p('xextent', 1), p('yextent', 1), p('zextent', 1)]],
  'mesh-sphere': (p) => ['sphere', sphere, Array(3).fill(2 * p('radius', 1))],
  'mesh-cylinder': (p) => ['cylinder', () => upright(cylinder()), [2 * p('radius', 1), p('length', 1), 2 * p('radius', 1)]],
  'mesh-cone': (p) => cone(p('bottomradius', 1), p('topradius', 0), p('length', 1)),
  'mesh-plane': (p) => ['plane', () => upright(quad()), [p('width', 1), 1, p('height', 1)]],
  'mesh-torus': (p) => ring(p('radius', 1), p('minorradius', 1)),
};

function cone(bottom, top, high) {
  const part = bottom > 0 ? (0.5 * top) / bottom : 0.5;
  const wide = 2 * (bottom > 0 ? bottom : top);
  return [`cone ${part}`, () => upright(cylinder(32, part)), [wide, high, wide]];
}

function ring(radius, minor) {
  const part = radius > 0 ? minor / radius : 1;
  return [`torus ${part}`, () => torus(part), Array(3).fill(radius)];
}

const numbers = (value) => (Array.isArray(value) ? value : typeof value === 'number' ? [value] : String(value).split(',').map(Number)).map((x) => (Number.isFinite(x) ? x : 0));
const plain = (name) => name.replace(/[-_]/g, '').toLowerCase();

/** Reads parameters of a node, written with hyphens or not. */
function reader(node) {
  const params = new Map(Object.entries(node?.params ?? {}).map(([name, value]) => [plain(name), value]));
  return (name, usual) => (!params.has(name) ? usual : Array.isArray(usual) ? [...numbers(params.get(name)), ...usual].slice(0, Math.max(usual.length, 3)) : numbers(params.get(name))[0]);
}

/** Red, green, blue from 0 to 1; given as #rrggbb, or up to 255. */
function color(node, name, usual) {
  const text = reader(node)(name, null) === null ? null : Object.entries(node.params).find(([key]) => plain(key) === name)?.[1];
  if (text === null || text === undefined) return usual;
  if (/^#[0-9a-f]{6}$/i.test(text)) return [1, 3, 5].map((i) => parseInt(text.slice(i, i + 2), 16) / 255);
  const given = [...numbers(text), 0, 0, 0].slice(0, 3);
  return given.some((x) => x > 1) ? given.map((x) => x / 255) : given;
}

function transform(node) {
  const p = reader(node);
  const [w, x, y, z] = p('rotation', [1, 0, 0, 0]); // as Qt writes quaternions
  const angles = ['rotationx', 'rotationy', 'rotationz'].map((name) => (p(name, 0) * Math.PI) / 360);
  const about = (i) => [...[0, 1, 2].map((k) => (k === i ? Math.sin(angles[i]) : 0)), Math.cos(angles[i])];
  const turn = normalized4(quaternionProduct([x, y, z, w], quaternionProduct(about(1), quaternionProduct(about(0), about(2)))));
  const r = rotationRows([0, 0, 0, ...turn]);
  const size = p('scale3d', Array(3).fill(p('scale', 1)));
  const place = p('translation', [0, 0, 0]);
  return [0, 1, 2].flatMap((c) => [r[c] * size[c], r[3 + c] * size[c], r[6 + c] * size[c], 0]).concat(place, 1);
}

function normalized4(q) {
  const l = Math.hypot(...q) || 1;
  return q.map((x) => x / l);
}

/** What there is to draw: things with their places, lights, the camera. */
function contents(nodes) {
  const below = new Map();
  for (const node of nodes) below.set(node.parent, [...(below.get(node.parent) ?? []), node]);
  const found = { things: [], lights: [], camera: null, orbits: false };
  const visit = (node, frame) => {
    if (node.enabled === false) return;
    const parts = (below.get(node.id) ?? []).filter(({ enabled }) => enabled !== false);
    const part = (start) => parts.find(({ type }) => type.startsWith(start));
    const own = part('transform') ? product(frame, transform(part('transform'))) : frame;
    if (node.type === 'camera') found.camera ??= node;
    if (node.type.startsWith('camera-controller')) found.orbits = true;
    const light = node.type.startsWith('light-') ? node : null;
    if (light) found.lights.push(lightOf(light, frame));
    const mesh = parts.find(({ type }) => MESHES[type]);
    if (mesh) found.things.push({ mesh, frame: own, material: part('material'), picker: part('object-picker')?.id });
    parts.forEach((each) => visit(each, own));
  };
  (below.get(-1) ?? []).forEach((node) => visit(node, IDENTITY));
  return found;
}

function lightOf(node, frame) {
  const ink = scaled(color(node, 'color', [1, 1, 1]), reader(node)('intensity', 1));
  const along = reader(node)('worlddirection', reader(node)('localdirection', [0, 0, -1]));
  return { at: node.type === 'light-directional' ? [...scaled(along, -1), 0] : [frame[12], frame[13], frame[14], 1], ink };
}

let shared = null; // the context, its program, the meshes

function drawer() {
  if (shared) return shared;
  const canvas = document.createElement('canvas');
  const gl = context(canvas);
  if (gl) shared = { canvas, gl, program: new Program(gl, VERTEX, FRAGMENT), meshes: new Map() };
  return shared;
}

/** A mesh on the graphics processor: three corners for each triangle. */
function uploaded({ gl, meshes }, [name, make]) {
  if (meshes.has(name)) return meshes.get(name);
  const { positions, indices, normals } = make();
  const corners = new Float32Array(indices.length * 6);
  for (let i = 0; i < indices.length; i++) for (let k = 0; k < 3; k++) corners[6 * i + k] = positions[3 * indices[i] + k], corners[6 * i + 3 + k] = normals[3 * i + k];
  const array = gl.createVertexArray();
  gl.bindVertexArray(array);
  gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ARRAY_BUFFER, corners, gl.STATIC_DRAW);
  for (const [place, at] of [[PLACES.position, 0], [PLACES.normal, 12]]) gl.enableVertexAttribArray(place), gl.vertexAttribPointer(place, 3, gl.FLOAT, false, 24, at);
  const mesh = { array, corners, count: indices.length };
  meshes.set(name, mesh);
  return mesh;
}

const grown = (frame, size) => frame.map((x, i) => (i < 12 ? x * size[i >> 2] : x));

/** The scene on a canvas. */
class Scene3d {
  constructor(item, canvas, kept) {
    Object.assign(this, { item, canvas, kept, ...contents(item.nodes ?? []) });
    this.gpu = drawer();
    this.things.forEach((thing) => {
      const [name, make, size] = MESHES[thing.mesh.type](reader(thing.mesh));
      Object.assign(thing, { drawn: this.gpu && uploaded(this.gpu, [name, make]), frame: grown(thing.frame, size) });
    });
  }

  /** The camera of the scene, or one that sees all; turned by what a person did. */
  _camera() {
    const p = reader(this.camera);
    const bounds = new Box();
    this.things.forEach(({ frame }) => bounds.include([frame[12], frame[13], frame[14]]));
    const far = bounds.empty ? 4 : bounds.radius * 2.5 + 4;
    const target = p('viewcenter', this.camera ? [0, 0, 0] : bounds.empty ? [0, 0, 0] : bounds.centre);
    const eye = p('position', add(target, scaled(normalized([1, 0.8, 1.6]), far)));
    const up = p('upvector', [0, 1, 0]);
    const { yaw, pitch, zoom } = this.kept;
    const away = sub(eye, target);
    const side = normalized(cross(up, away));
    const lifted = around(around(away, normalized(up), yaw), side, pitch);
    return { eye: add(target, scaled(lifted, zoom)), target, up, angle: (p('fieldofview', 45) * Math.PI) / 180 };
  }

  draw() {
    if (!this.gpu) return;
    const { gl, canvas: stage, program } = this.gpu;
    const { width, height } = this.canvas;
    Object.assign(stage, { width, height });
    const { eye, target, up, angle } = this._camera();
    const back = normalized(sub(eye, target));
    const right = normalized(cross(up, back));
    this.matrix = product(perspective(angle, width / height, length(sub(eye, target)) / 100, length(sub(eye, target)) * 100), viewMatrix(eye, right, cross(back, right), back));
    gl.viewport(0, 0, width, height);
    gl.enable(gl.DEPTH_TEST);
    gl.clearColor(...color({ params: { c: this.item.clearColor || '#20262e' } }, 'c', [0.1, 0.12, 0.15]), 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    program.use({ view_projection: this.matrix, eye, ...this._lights(back) });
    for (const { drawn, frame, material } of this.things) {
      const p = reader(material);
      const diffuse = color(material, 'diffuse', [0.7, 0.7, 0.7]);
      program.use({ model: frame, diffuse, ambient: color(material, 'ambient', scaled(diffuse, 0.25)), specular: color(material, 'specular', [0.1, 0.1, 0.1]), shininess: Math.max(p('shininess', 40), 1) });
      gl.bindVertexArray(drawn.array);
      gl.drawArrays(gl.TRIANGLES, 0, drawn.count);
    }
    this.canvas.getContext('2d').drawImage(stage, 0, 0);
  }

  /** Without lights of its own, one behind the person. */
  _lights(back) {
    const all = this.lights.length ? this.lights : [{ at: [...back, 0], ink: [0.9, 0.9, 0.9] }];
    const lists = { 'lights[0]': [], 'light_colors[0]': [] };
    for (let i = 0; i < MOST_LIGHTS; i++) lists['lights[0]'].push(...(all[i]?.at ?? [0, 0, 1, 0])), lists['light_colors[0]'].push(...(all[i]?.ink ?? [0, 0, 0]), 1);
    return lists;
  }

  /** The picker of the nearest thing at a place, in pixels; undefined without one. */
  pick(x, y) {
    const at = [(2 * x) / this.canvas.clientWidth - 1, 1 - (2 * y) / this.canvas.clientHeight];
    let best = { depth: Infinity };
    for (const { drawn, frame, picker } of this.things) {
      const matrix = product(this.matrix, frame);
      for (let i = 0; i < drawn.count; i += 3) {
        const depth = depthAt([0, 1, 2].map((k) => projected(matrix, drawn.corners.subarray(6 * (i + k)))), at);
        if (depth < best.depth) best = { depth, picker };
      }
    }
    return best.picker;
  }
}

/** The depth of a triangle at a place; infinite beside it. */
function depthAt([a, b, c], [x, y]) {
  const area = (p, q) => (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]);
  const parts = [area(b, c), area(c, a), area(a, b)];
  const whole = parts[0] + parts[1] + parts[2];
  if (whole === 0 || parts.some((part) => part / whole < 0)) return Infinity;
  const depth = (parts[0] * a[2] + parts[1] * b[2] + parts[2] * c[2]) / whole;
  return Math.abs(depth) <= 1 ? depth : Infinity;
}

/** A vector turned about an axis of length 1. */
function around(v, axis, angle) {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  return add(add(scaled(v, c), scaled(cross(axis, v), s)), scaled(axis, dot(axis, v) * (1 - c)));
}

const turns = new Map(); // how persons have turned each scene, by window and widget

export function scene3d(item, form) {
  const key = `${form.id} ${item.id}`;
  const kept = turns.get(key) ?? { yaw: 0, pitch: 0, zoom: 1 };
  turns.set(key, kept);
  const canvas = el('canvas', { class: 'scene3d', width: SIZE[0], height: SIZE[1], role: 'img', 'aria-label': `A scene of ${item.nodes?.length ?? 0} nodes`, 'data-widget': item.id, tabindex: 0 });
  const scene = new Scene3d(item, canvas, kept);
  if (!scene.gpu) return el('div', { class: 'hint' }, 'This browser has no WebGL2, which the scene is drawn with.');
  scene.draw();
  const turn = (yaw, pitch, zoom = 1) => (Object.assign(kept, { yaw: kept.yaw + yaw, pitch: Math.min(Math.max(kept.pitch + pitch, -1.3), 1.3), zoom: Math.min(Math.max(kept.zoom * zoom, 0.1), 10) }), scene.draw());
  let moved = false;
  canvas.addEventListener('pointerdown', (event) => ((moved = false), canvas.setPointerCapture(event.pointerId)));
  canvas.addEventListener('pointermove', (event) => event.buttons && scene.orbits && ((moved ||= Math.hypot(event.movementX, event.movementY) > 1), turn(-event.movementX / 120, -event.movementY / 120)));
  canvas.addEventListener('wheel', (event) => scene.orbits && (event.preventDefault(), turn(0, 0, Math.exp(event.deltaY / 600))), { passive: false });
  const keys = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] };
  canvas.addEventListener('keydown', (event) => scene.orbits && keys[event.key] && (event.preventDefault(), turn(...keys[event.key])));
  canvas.addEventListener('click', (event) => {
    const node = moved ? undefined : scene.pick(event.offsetX, event.offsetY);
    if (node !== undefined) form.send({ type: 'node', node });
  });
  return canvas;
}
