// Meshes that the page makes itself, of unit size, in the form of the protocol's meshes: positions, indices, normals of corners.

/** @typedef {{positions: ArrayLike<number>, indices: ArrayLike<number>, normals: ArrayLike<number>, uvs: ArrayLike<number>|null, edges: ArrayLike<number>}} MeshData */

/** Flat faces, each a list of corners. @returns {MeshData} */
function faceted(faces) {
  const [positions, indices, normals] = [[], [], []];
  for (const corners of faces) {
    const [a, b, c] = corners;
    const u = b.map((x, i) => x - a[i]);
    const v = c.map((x, i) => x - a[i]);
    const normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    const first = positions.length / 3;
    positions.push(...corners.flat());
    for (let i = 2; i < corners.length; i++) {
      indices.push(first, first + i - 1, first + i);
      normals.push(...normal, ...normal, ...normal);
    }
  }
  return { positions, indices, normals, uvs: null, edges: [] };
}

export function box() {
  const corner = (i) => [(i & 1) - 0.5, ((i >> 1) & 1) - 0.5, ((i >> 2) & 1) - 0.5];
  const quads = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
  return faceted(quads.map((quad) => quad.map(corner)));
}

const ring = (i, n, radius, z) => [radius * Math.cos((2 * Math.PI * i) / n), radius * Math.sin((2 * Math.PI * i) / n), z];

/** Along z; `top` is the radius above, so that 0 makes a cone. */
export function cylinder(sides = 32, top = 0.5) {
  const mesh = { positions: [], indices: [], normals: [], uvs: null, edges: [] };
  const slope = 0.5 - top;
  for (let i = 0; i < sides; i++) {
    const corners = [ring(i, sides, 0.5, -0.5), ring(i + 1, sides, 0.5, -0.5), ring(i + 1, sides, top, 0.5), ring(i, sides, top, 0.5)];
    const normals = [i, i + 1, i + 1, i].map((k) => ring(k, sides, 1, slope));
    appendQuad(mesh, corners, normals);
    appendQuad(mesh, [[0, 0, -0.5], corners[1], corners[0], [0, 0, -0.5]], Array(4).fill([0, 0, -1]));
    if (top > 0) appendQuad(mesh, [[0, 0, 0.5], corners[3], corners[2], [0, 0, 0.5]], Array(4).fill([0, 0, 1]));
  }
  return mesh;
}

function appendQuad(mesh, corners, normals) {
  const first = mesh.positions.length / 3;
  mesh.positions.push(...corners.flat());
  for (const k of [0, 1, 2, 0, 2, 3]) {
    mesh.indices.push(first + k);
    mesh.normals.push(...normals[k]);
  }
}

export function sphere(sides = 24) {
  const mesh = { positions: [], indices: [], normals: [], uvs: null, edges: [] };
  const point = (i, k) => {
    const angle = (Math.PI * k) / (sides / 2) - Math.PI / 2;
    return ring(i, sides, Math.cos(angle) / 2, Math.sin(angle) / 2);
  };
  for (let k = 0; k < sides / 2; k++) {
    for (let i = 0; i < sides; i++) {
      const corners = [point(i, k), point(i + 1, k), point(i + 1, k + 1), point(i, k + 1)];
      appendQuad(mesh, corners, corners);
    }
  }
  return mesh;
}

/** About z, with a ring of radius 1 and a tube of radius `minor`. */
export function torus(minor, sides = 36, around = 16) {
  const mesh = { positions: [], indices: [], normals: [], uvs: null, edges: [] };
  const point = (i, k, radius, tube) => {
    const [x, y] = ring(k, around, tube, 0);
    return ring(i, sides, radius + x, y);
  };
  for (let i = 0; i < sides; i++) {
    for (let k = 0; k < around; k++) {
      const all = [[i, k], [i + 1, k], [i + 1, k + 1], [i, k + 1]];
      appendQuad(mesh, all.map(([a, b]) => point(a, b, 1, minor)), all.map(([a, b]) => point(a, b, 0, 1)));
    }
  }
  return mesh;
}

/** In the plane of x and y. */
export function disc(sides = 32) {
  return faceted([Array.from({ length: sides }, (_, i) => ring(i, sides, 0.5, 0))]);
}

export const quad = () => faceted([[[-0.5, -0.5, 0], [0.5, -0.5, 0], [0.5, 0.5, 0], [-0.5, 0.5, 0]]]);
export const triangle = () => disc(3);

/** The primitives by name. */
export const PRIMITIVES = { box, cylinder, cone: () => cylinder(32, 0), sphere, disc, quad, triangle, ball: () => sphere(12) };
