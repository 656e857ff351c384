// The programs of the graphics processor. `slots` is the table of slots.js.

const TABLE = `
uniform highp sampler2D slots;
in uint slot;
vec4 entry(int i) { return texelFetch(slots, ivec2(int(slot % 128u) * 6 + i, int(slot / 128u)), 0); }
mat4 placement() { return transpose(mat4(entry(0), entry(1), entry(2), vec4(0, 0, 0, 1))); }
`;

/** Surfaces. `offset`, `turn` and `tint` place and colour the items of drawing objects and octrees; others leave them constant. */
const SURFACE = `${TABLE}
uniform mat4 view_projection;
in vec3 position;
in vec3 normal;
in vec4 offset;
in vec4 turn;
in vec4 tint;
vec3 rotated(vec3 v) { return v + 2.0 * cross(turn.xyz, cross(turn.xyz, v) + turn.w * v); }
vec4 world_position() { return placement() * vec4(rotated(position * offset.w) + offset.xyz, 1); }
vec3 world_normal() {
  mat3 m = mat3(placement());
  vec3 squares = vec3(dot(m[0], m[0]), dot(m[1], m[1]), dot(m[2], m[2]));
  return m * (rotated(normal) / max(squares, vec3(1e-20)));
}
`;

const surface = {
  vertex: `${SURFACE}
in vec2 uv;
out vec3 world;
out vec3 shade_normal;
out vec2 texture_uv;
flat out vec4 color;
flat out vec4 glow;
void main() {
  vec4 place = world_position();
  world = place.xyz;
  shade_normal = world_normal();
  texture_uv = uv;
  color = entry(3) * tint;
  glow = entry(4);
  gl_Position = view_projection * place;
}`,
  // Light: a key light with shadows, the sky above and the ground below, a little from the viewer so that nothing is flat.
  fragment: `
uniform vec3 eye, key_direction, key_color, sky_color, ground_color;
uniform mat4 shadow_matrix;
uniform highp sampler2DShadow shadow_map;
uniform sampler2D picture;
uniform float textured, decal, shadows, shadow_texel, lit;
in vec3 world;
in vec3 shade_normal;
in vec2 texture_uv;
flat in vec4 color;
flat in vec4 glow;
out vec4 result;
float lightness(vec3 n) {
  if (shadows < 0.5) return 1.0;
  vec4 at = shadow_matrix * vec4(world + n * shadow_texel * 1.5, 1);
  vec3 p = at.xyz * 0.5 + 0.5;
  if (any(greaterThan(abs(p - 0.5), vec3(0.5)))) return 1.0;
  float sum = 0.0, step_size = 1.4 / float(textureSize(shadow_map, 0).x);
  for (int y = -1; y <= 1; y++)
    for (int x = -1; x <= 1; x++) sum += texture(shadow_map, vec3(p.xy + vec2(x, y) * step_size, p.z));
  return sum / 9.0;
}
vec3 shown(vec3 linear) {
  float peak = max(linear.r, max(linear.g, linear.b));
  float soft = peak > 0.75 ? 1.0 - 0.0625 / (peak - 0.5) : peak;
  vec3 kept = linear * (soft / max(peak, 1e-5));
  return pow(mix(kept, vec3(soft), 0.15 * smoothstep(0.75, 3.0, peak)), vec3(1.0 / 2.2));
}
void main() {
  vec4 base = color;
  if (textured > 0.5) {
    vec4 texel = texture(picture, texture_uv);
    base.rgb = decal > 0.5 ? mix(base.rgb, texel.rgb, texel.a) : base.rgb * texel.rgb;
  }
  if (lit < 0.5) { result = base; return; }
  vec3 albedo = pow(base.rgb, vec3(2.2));
  vec3 n = normalize(shade_normal);
  vec3 view = normalize(eye - world);
  if (!gl_FrontFacing) n = -n;
  float incoming = max(dot(n, key_direction), 0.0);
  float key = incoming * lightness(n);
  vec3 around = mix(ground_color, sky_color, n.z * 0.5 + 0.5);
  float head = 0.12 * max(dot(n, view), 0.0);
  float facing = max(dot(n, normalize(key_direction + view)), 0.0);
  float highlight = glow.w * 0.22 * pow(facing, 42.0) * step(0.001, key) * key;
  float rim = 0.035 * pow(1.0 - max(dot(n, view), 0.0), 4.0);
  vec3 light = albedo * (around + key_color * key + head) + highlight * key_color + rim * sky_color;
  result = vec4(shown(light + pow(glow.rgb, vec3(2.2))), base.a);
}`,
};

const depth = { vertex: `${SURFACE} void main() { gl_Position = view_projection * world_position(); }`, fragment: 'void main() {}' };

/** Numbers and distances of what is there, for picking; the same for lines and points. */
const PICKED = `
uniform vec3 eye;
flat in float number;
in vec3 world;
layout(location = 0) out vec4 identifier;
layout(location = 1) out vec4 distance_bits;
vec4 bytes(uint bits) { return vec4(uvec4(bits, bits >> 8u, bits >> 16u, bits >> 24u) & 255u) / 255.0; }
void main() {
  identifier = bytes(uint(number));
  distance_bits = bytes(floatBitsToUint(distance(eye, world)));
}`;

const pick = {
  vertex: `${SURFACE} flat out float number; out vec3 world;
void main() { vec4 place = world_position(); world = place.xyz; number = entry(5).x; gl_Position = view_projection * place; }`,
  fragment: PICKED,
};

/** Everything of one colour: the silhouettes of what is selected. */
const mask = { vertex: depth.vertex, fragment: 'uniform vec4 ink; out vec4 result; void main() { result = ink; }' };

const LINE = `${TABLE}
uniform mat4 view_projection;
uniform vec2 viewport;
uniform float width, nearer;
in vec3 from;
in vec3 to;
in vec4 tint;
vec4 line_position() {
  mat4 m = placement();
  vec4 a = view_projection * m * vec4(from, 1), b = view_projection * m * vec4(to, 1);
  if (a.w < 0.001) a = mix(b, a, (b.w - 0.001) / max(b.w - a.w, 1e-6));
  if (b.w < 0.001) b = mix(a, b, (a.w - 0.001) / max(a.w - b.w, 1e-6));
  vec2 along = (b.xy / b.w - a.xy / a.w) * viewport;
  vec2 side = length(along) > 1e-6 ? normalize(vec2(-along.y, along.x)) : vec2(0);
  vec4 end = (gl_VertexID & 1) == 0 ? a : b;
  end.xy += side * ((gl_VertexID & 2) == 0 ? -1.0 : 1.0) * width / viewport * end.w;
  end.z -= nearer * end.w;
  return end;
}`;

const lines = {
  vertex: `${LINE} flat out vec4 color; void main() { color = entry(3) * tint; gl_Position = line_position(); }`,
  fragment: 'flat in vec4 color; out vec4 result; void main() { result = color; }',
};

const pickLines = {
  vertex: `${LINE} flat out float number; out vec3 world;
void main() { number = entry(5).x; world = (placement() * vec4((gl_VertexID & 1) == 0 ? from : to, 1)).xyz; gl_Position = line_position(); }`,
  fragment: PICKED,
};

/** Edges of meshes: the processor's own lines, one pixel wide. */
const edges = {
  vertex: `${SURFACE} uniform float nearer; void main() { gl_Position = view_projection * world_position(); gl_Position.z -= nearer * gl_Position.w; }`,
  fragment: 'uniform vec4 ink; out vec4 result; void main() { result = ink; }',
};

const POINT = `${TABLE}
uniform mat4 view_projection;
uniform float size;
in vec3 position;
in vec4 tint;
vec4 point_position(out vec3 place) { place = (placement() * vec4(position, 1)).xyz; gl_PointSize = size; return view_projection * vec4(place, 1); }`;

const points = {
  vertex: `${POINT} flat out vec4 color; void main() { vec3 place; gl_Position = point_position(place); color = entry(3) * tint; }`,
  fragment: 'flat in vec4 color; out vec4 result; void main() { if (length(gl_PointCoord - 0.5) > 0.5) discard; result = color; }',
};

const pickPoints = {
  vertex: `${POINT} flat out float number; out vec3 world; void main() { number = entry(5).x; gl_Position = point_position(world); }`,
  fragment: PICKED,
};

/** A triangle that covers everything. */
const WHOLE = `out vec2 at; void main() { at = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2); gl_Position = vec4(at * 2.0 - 1.0, 0.9999999, 1); }`;

const sky = {
  vertex: WHOLE,
  fragment: `
uniform vec3 forward, right, up, zenith, horizon, nadir;
in vec2 at;
out vec4 result;
float noise(vec2 p) { return fract(sin(dot(p, vec2(12.9898, 78.233))) * 43758.5453); }
void main() {
  vec2 p = at * 2.0 - 1.0;
  float height = normalize(forward + p.x * right + p.y * up).z;
  vec3 color = height > 0.0 ? mix(horizon, zenith, pow(height, 0.6)) : mix(horizon, nadir, smoothstep(0.0, 0.35, -height));
  result = vec4(color + (noise(gl_FragCoord.xy) - 0.5) / 255.0, 1);
}`,
};

/** The ground: lines that fade with the distance, and the shadows that nothing else would catch. */
const grid = {
  vertex: `
uniform mat4 view_projection;
uniform vec3 centre;
uniform float reach;
out vec3 world;
void main() {
  vec2 corner = vec2((gl_VertexID & 1) * 2 - 1, (gl_VertexID & 2) - 1);
  world = vec3(centre.xy + corner * reach, 0);
  gl_Position = view_projection * vec4(world, 1);
}`,
  fragment: `
uniform vec3 ink, centre, red, green;
uniform float reach, spacing, shadows, catches, strength;
uniform mat4 shadow_matrix;
uniform highp sampler2DShadow shadow_map;
in vec3 world;
out vec4 result;
float line(float x, float size) {
  float d = fwidth(x / size), near = abs(fract(x / size - 0.5) - 0.5);
  return (1.0 - smoothstep(0.4 * d, 1.3 * d, near)) * (1.0 - smoothstep(0.15, 0.45, d));
}
float axis(float x) { float d = fwidth(x); return 1.0 - smoothstep(0.6 * d, 1.7 * d, abs(x)); }
float shade() {
  vec3 p = (shadow_matrix * vec4(world, 1)).xyz * 0.5 + 0.5;
  if (shadows < 0.5 || any(greaterThan(abs(p - 0.5), vec3(0.5)))) return 0.0;
  float sum = 0.0, step_size = 1.6 / float(textureSize(shadow_map, 0).x);
  for (int y = -1; y <= 1; y++)
    for (int x = -1; x <= 1; x++) sum += texture(shadow_map, vec3(p.xy + vec2(x, y) * step_size, p.z - 0.0005));
  return 1.0 - sum / 9.0;
}
void main() {
  float fade = 1.0 - smoothstep(0.15, 1.0, length(world.xy - centre.xy) / reach);
  float fine = max(line(world.x, spacing), line(world.y, spacing)) * 0.55;
  float coarse = max(line(world.x, spacing * 10.0), line(world.y, spacing * 10.0));
  float amount = max(fine, coarse) * strength;
  vec3 color = ink;
  float x_axis = axis(world.y), y_axis = axis(world.x);
  if (max(x_axis, y_axis) > 0.01) { color = x_axis > y_axis ? red : green; amount = max(amount, max(x_axis, y_axis) * 0.75); }
  float dark = shade() * 0.32 * catches;
  float alpha = dark + amount * (1.0 - dark);
  result = vec4(color * amount / max(alpha, 1e-4), alpha) * vec4(1, 1, 1, fade);
}`,
};

/** Outlines of silhouettes. */
const outline = {
  vertex: WHOLE,
  fragment: `
uniform sampler2D silhouettes;
uniform vec4 chosen, hovered;
uniform float thickness;
in vec2 at;
out vec4 result;
void main() {
  vec2 pixel = thickness / vec2(textureSize(silhouettes, 0));
  vec4 here = texture(silhouettes, at);
  vec2 most = vec2(0);
  for (int i = 0; i < 12; i++) {
    float angle = float(i) * 0.5235988;
    most = max(most, texture(silhouettes, at + pixel * vec2(cos(angle), sin(angle))).xy);
  }
  vec2 edge = max(most - here.xy, vec2(0));
  result = edge.x > 0.0 ? chosen : edge.y > 0.0 ? hovered : vec4(0);
  if (result.a == 0.0) discard;
}`,
};

/** All programs by name. */
export const SHADERS = { surface, depth, pick, mask, lines, pickLines, edges, points, pickPoints, sky, grid, outline };
