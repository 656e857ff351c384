// One picture of the scene: which passes there are, in which order.
import { projected } from '../maths.js';
import { Batches } from './gpu/batches.js';
import { Camera } from './camera.js';
import { Drawings } from './drawings.js';
import { context, isSoftware, PLACES, Program, Target } from './gpu/gl.js';
import { Picker } from './picking.js';
import { Quality } from './quality.js';
import { Resources } from './resources.js';
import { SceneView } from './scene_view.js';
import { CopySet, LineSet, PointSet } from './gpu/sets.js';
import { SHADERS } from './gpu/shaders.js';
import { KEY_DIRECTION, Shadows } from './shadows.js';
import { Slots } from './gpu/slots.js';
import { Surroundings } from './surroundings.js';
import { THEMES } from './themes.js';

const LIGHT = { key_direction: KEY_DIRECTION, key_color: [1.36, 1.32, 1.25], sky_color: [0.5, 0.54, 0.6], ground_color: [0.25, 0.235, 0.22] };

const LOADING = 120; // milliseconds between pictures while meshes arrive

/** Whether two parts are drawn with the same state. */
const sameLook = (a, b) => a.texture === b.texture && a.decal === b.decal && a.culling === b.culling && a.order === b.order;

export class Renderer {
  /** @param {HTMLCanvasElement} canvas @param {import('../store.js').Store} store @param {any} source */
  constructor(canvas, store, source) {
    const gl = context(canvas);
    if (!gl) throw new Error('This browser has no WebGL2, which the scene is drawn with.');
    Object.assign(this, { canvas, gl, store });
    this.camera = new Camera();
    this.quality = new Quality(isSoftware(gl));
    this.programs = {};
    for (const [name, { vertex, fragment }] of Object.entries(SHADERS)) this.programs[name] = new Program(gl, vertex, fragment);
    this.slots = new Slots(gl);
    this.batches = new Batches(gl, this.slots);
    this.resources = new Resources(gl, source);
    this.view = new SceneView(gl, store, this.slots, this.batches, this.resources);
    this.surroundings = new Surroundings(this.view);
    this.drawings = new Drawings(gl, store, this.slots, this.resources, this.view);
    this.shadows = new Shadows(gl, this.programs.depth);
    this.picker = new Picker(gl);
    this.theme = THEMES.light;
    this.options = { shadows: true, edges: true, grid: true };
    this.hovered = -1;
    this.before = []; // functions that draw other pictures before this one
    this.overlaid = []; // lines that are seen through everything, of other parts of the page
    this.stale = true;
    this._connect();
  }

  _connect() {
    const { store, view, drawings } = this;
    const again = (update) => (detail) => {
      update(detail);
      this.stale = true;
    };
    store.on('objects', again((changed) => view.objectsChanged(changed)));
    store.on('poses', again((moved) => view.posesChanged(moved)));
    store.on('drawings', again((ids) => drawings.changed(ids)));
    store.on('selection', again(() => view.selectionChanged()));
    store.on('contacts', again(() => drawings.contactsChanged()));
    this.resources.onready = () => (this.loaded ??= performance.now());
  }

  /** Fits the drawing to its element. */
  resize() {
    const { canvas } = this;
    const ratio = Math.min(devicePixelRatio || 1, 2) * this.quality.scale;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((x) => Math.max(Math.round(x * ratio), 1));
    if (canvas.width === width && canvas.height === height) return;
    [canvas.width, canvas.height] = [width, height];
    this.stale = true;
  }

  get aspect() {
    return this.canvas.width / this.canvas.height;
  }

  /** Draws, if something changed. @param {number} seconds since the last call @returns {boolean} whether it did */
  frame(seconds) {
    if (this.gl.isContextLost()) return false;
    const moved = this.camera.advance(seconds);
    if (this.loaded && performance.now() - this.loaded > LOADING) Object.assign(this, { stale: true, loaded: undefined });
    if (this.surroundings.outdated(performance.now())) this.stale = true;
    if (this.quality.update(seconds, moved || this.stale)) this.stale = true;
    this.resize();
    if (!moved && !this.stale) return false;
    this.stale = false;
    this.before.forEach((draw) => draw());
    this._draw();
    return true;
  }

  /** What one of the scene's cameras sees, on another canvas; the picture on the page is drawn again after it. */
  drawThrough(object, pose, canvas) {
    if (!pose || this.gl.isContextLost()) return;
    const camera = Object.assign(new Camera(), { distance: this.surroundings.sphere.radius });
    camera.setFixed(pose, object);
    this.drawWith(camera, canvas);
    this._draw();
  }

  /** What a camera sees, on another canvas; the page's own picture has to be drawn after it. */
  drawWith(camera, canvas) {
    const { canvas: own } = this;
    const kept = { camera: this.camera, matrices: this.matrices, canvas: own };
    const ratio = own.width / Math.max(own.clientWidth, 1);
    const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((x) => Math.max(Math.round(x * ratio), 1));
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    this.camera = camera;
    this.canvas = { width: Math.min(width, own.width), height: Math.min(height, own.height), clientWidth: canvas.clientWidth };
    this._draw();
    canvas.getContext('2d').drawImage(own, 0, own.height - this.canvas.height, this.canvas.width, this.canvas.height, 0, 0, width, height);
    Object.assign(this, kept);
  }

  _draw() {
    const { gl, view, drawings } = this;
    this.surroundings.update(performance.now());
    const { sphere } = this.surroundings;
    const reach = this._reach();
    this.matrices = this.camera.matrices(this.aspect, reach * 2);
    view.prepareLines();
    drawings.place();
    this._constants();
    this.slots.bind(0);
    this.withShadows = this.options.shadows && this.quality.shadows;
    if (this.withShadows) this.shadows.update(this.batches, sphere.centre, sphere.radius * 1.15, view.version);
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    this._sky();
    this._solid();
    if (this.options.grid) this._grid(reach);
    this._lines();
    this._transparent();
    this._overlays();
    this._outline();
  }

  _reach() {
    const { centre, radius } = this.surroundings.sphere;
    return Math.hypot(...this.camera.eye.map((x, i) => x - centre[i])) + radius * 4 + 10;
  }

  /** What attributes are where no buffer has them. */
  _constants() {
    const { gl } = this;
    gl.vertexAttrib4f(PLACES.offset, 0, 0, 0, 1);
    gl.vertexAttrib4f(PLACES.turn, 0, 0, 0, 1);
    gl.vertexAttrib4f(PLACES.tint, 1, 1, 1, 1);
    gl.vertexAttribI4ui(PLACES.slot, this.slots.world, 0, 0, 0);
  }

  _sky() {
    const { gl, theme, aspect } = this;
    gl.disable(gl.DEPTH_TEST);
    gl.disable(gl.BLEND);
    gl.disable(gl.CULL_FACE);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    const { forward, right, up, angle } = this.matrices;
    const size = Math.tan(angle / 2);
    this.programs.sky.use({ forward, right: right.map((x) => x * size * aspect), up: up.map((x) => x * size), ...theme.sky });
    gl.bindVertexArray(null);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.enable(gl.DEPTH_TEST);
  }

  _surfaceUniforms() {
    const shadow = this.withShadows;
    const { gl, shadows } = this;
    gl.activeTexture(gl.TEXTURE1);
    gl.bindTexture(gl.TEXTURE_2D, shadows.texture);
    return {
      slots: 0, shadow_map: 1, picture: 2, view_projection: this.matrices.matrix, eye: this.camera.eye, ...LIGHT, lit: 1, textured: 0,
      shadows: shadow ? 1 : 0, ...(shadow ? { shadow_matrix: shadows.matrix, shadow_texel: shadows.texel } : {}),
    };
  }

  _solid() {
    const { gl } = this;
    const { surface } = this.programs;
    surface.use(this._surfaceUniforms());
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(1, 1);
    this.looksLike = null;
    this.batches.drawOpaque(({ look }) => this._look(surface, look));
    surface.use({ textured: 0 });
    gl.disable(gl.CULL_FACE);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    for (const set of this._sets(CopySet, false)) set.draw();
    gl.disable(gl.BLEND);
    gl.disable(gl.POLYGON_OFFSET_FILL);
    this._constants();
    if (this.options.edges && this.quality.edges) this._edges();
  }

  /** Of meshes of a shape in the same plane the first is seen. */
  _look(program, look) {
    const { texture, decal, culling, order } = look;
    const { gl } = this;
    if (this.looksLike && sameLook(this.looksLike, look)) return;
    this.looksLike = look;
    const behind = 1 + Math.min(order, 4);
    gl.polygonOffset(behind, behind * 2);
    if (culling) gl.enable(gl.CULL_FACE);
    else gl.disable(gl.CULL_FACE);
    program.set('textured', texture ? 1 : 0);
    if (!texture) return;
    gl.activeTexture(gl.TEXTURE2);
    gl.bindTexture(gl.TEXTURE_2D, texture.texture);
    program.set('decal', decal ? 1 : 0);
  }

  _edges() {
    const { edges } = this.programs;
    edges.use({ slots: 0, view_projection: this.matrices.matrix, nearer: 2e-5 });
    this.gl.enable(this.gl.BLEND);
    this.batches.drawEdges((color) => edges.set('ink', [...color, 0.6]));
    this.gl.disable(this.gl.BLEND);
  }

  _grid(reach) {
    const { gl, theme, camera } = this;
    const height = Math.max(Math.abs(camera.eye[2]), camera.distance * 0.4);
    this.spacing = 10 ** Math.floor(Math.log10(Math.max(height, 0.02) * 0.6));
    const { floor, sphere } = this.surroundings;
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    gl.disable(gl.CULL_FACE);
    gl.depthMask(false);
    const extent = Math.min(reach * 2, Math.max(height * 25, sphere.radius * 6));
    const shadow = this.withShadows ? { shadows: 1, shadow_matrix: this.shadows.matrix } : { shadows: 0 };
    this.programs.grid.use({ view_projection: this.matrices.matrix, shadow_map: 1, centre: [...camera.focus.slice(0, 2), 0], reach: extent, spacing: this.spacing, catches: floor ? 0 : 1, ...theme.grid, strength: theme.grid.strength * (floor ? 0.45 : 1), ...shadow });
    gl.bindVertexArray(null);
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4); // before surfaces in its plane, which are drawn a little farther away
    gl.depthMask(true);
  }

  _sets(Type, overlay) {
    const own = overlay ? [] : [...this.view.entries.values()].flatMap(({ sets }) => sets).filter((set) => set instanceof Type);
    return [...own, ...this.drawings.of(Type, overlay)];
  }

  _lines(overlay = false) {
    const { gl, canvas } = this;
    const lines = overlay ? [this.view.thickLines, this.drawings.contacts, ...this.overlaid] : [this.view.lines];
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    gl.disable(gl.CULL_FACE);
    const uniforms = { slots: 0, view_projection: this.matrices.matrix };
    const ratio = canvas.width / Math.max(canvas.clientWidth, 1);
    for (const set of [...lines, ...this._sets(LineSet, overlay)]) {
      this.programs.lines.use({ ...uniforms, viewport: [canvas.width, canvas.height], nearer: 1e-4, width: set.width * ratio });
      set.draw();
    }
    for (const set of this._sets(PointSet, overlay)) {
      this.programs.points.use({ ...uniforms, size: set.size * ratio });
      set.draw();
    }
    this._constants();
  }

  _transparent() {
    const { gl } = this;
    const { surface } = this.programs;
    gl.enable(gl.BLEND);
    gl.depthMask(false);
    surface.use(this._surfaceUniforms());
    this.looksLike = null;
    this.batches.drawTransparent(this.camera.eye, ({ look }) => this._look(surface, look));
    gl.depthMask(true);
    this._constants();
  }

  /** What is seen through everything: frames, forces, drawing objects that ask for it. */
  _overlays() {
    const { gl } = this;
    gl.disable(gl.DEPTH_TEST);
    this._lines(true);
    const copies = this._sets(CopySet, true);
    if (copies.length) this.programs.surface.use({ ...this._surfaceUniforms(), lit: 0 });
    copies.forEach((set) => set.draw());
    this._constants();
    gl.enable(gl.DEPTH_TEST);
  }

  _outline() {
    const { gl, canvas, theme } = this;
    const outlined = this._outlined();
    if (!outlined.length) return;
    const size = [canvas.width, canvas.height];
    if (this.silhouettes?.size.join() !== size.join()) {
      this.silhouettes?.free();
      this.silhouettes = new Target(gl, size, 1, false);
    }
    this.silhouettes.begin();
    gl.disable(gl.DEPTH_TEST);
    gl.disable(gl.CULL_FACE);
    gl.disable(gl.BLEND);
    gl.colorMask(true, true, false, false);
    for (const { part, ink } of outlined) {
      this.programs.mask.use({ slots: 0, view_projection: this.matrices.matrix, ink });
      this.batches.drawPart(part);
    }
    gl.colorMask(true, true, true, true);
    this._constants();
    this._showOutline(theme);
  }

  _showOutline(theme) {
    const { gl, canvas } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.enable(gl.BLEND);
    gl.activeTexture(gl.TEXTURE2);
    gl.bindTexture(gl.TEXTURE_2D, this.silhouettes.colors[0]);
    const thickness = (2 * canvas.width) / Math.max(canvas.clientWidth, 1);
    this.programs.outline.use({ silhouettes: 2, thickness, ...theme.outline });
    gl.bindVertexArray(null);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.enable(gl.DEPTH_TEST);
  }

  /** Parts of what the pointer is over, then of what is selected; of a model all that belongs to it. */
  _outlined() {
    const parts = (handle, ink) => (this.view.entries.get(handle)?.parts ?? []).map((part) => ({ part, ink }));
    const whole = (handle) => (this.store.objects.get(handle)?.modelBase ? this.view.descendants(handle) : [handle]);
    const chosen = new Set(this.store.selection.flatMap(whole));
    return [...parts(this.hovered, [0, 1, 0, 0]), ...[...chosen].flatMap((handle) => parts(handle, [1, 0, 0, 0]))];
  }

  /**
   * What is at a place of the canvas, in CSS pixels.
   * @returns {{handle: number, point: number[]} | null} the object (-1: a drawing object), and where in the world
   */
  pick(x, y) {
    if (!this.matrices) return null;
    const { canvas, camera } = this;
    const [px, py] = [(2 * x) / canvas.clientWidth - 1, 1 - (2 * y) / canvas.clientHeight];
    this.matrices = camera.matrices(this.aspect, this._reach() * 2);
    const found = this.picker.pick((matrix) => this._drawNumbers(matrix), this.matrices.matrix, px, py, [canvas.width, canvas.height]);
    this.stale = true;
    if (!found) return null;
    const { from, along } = camera.ray(px, py, this.aspect);
    const aside = Math.hypot(...from.map((v, i) => v - camera.eye[i])); // of a parallel projection
    found.distance = Math.sqrt(Math.max(found.distance ** 2 - aside ** 2, 0));
    return { handle: this.view.numbers[found.number] ?? -1, point: from.map((v, i) => v + along[i] * found.distance) };
  }

  _drawNumbers(matrix) {
    const { gl } = this;
    const uniforms = { slots: 0, view_projection: matrix, eye: this.camera.eye };
    gl.disable(gl.BLEND);
    gl.enable(gl.DEPTH_TEST);
    gl.disable(gl.CULL_FACE);
    this._constants();
    this.slots.bind(0);
    this.programs.pick.use(uniforms);
    this.batches.drawOpaque(() => {});
    this.batches.drawTransparent(this.camera.eye, () => {});
    this._sets(CopySet, false).forEach((set) => set.draw());
    this.programs.pickPoints.use({ ...uniforms, size: 3 });
    this._sets(PointSet, false).forEach((set) => set.draw());
    this._constants();
    this.programs.pickLines.use({ ...uniforms, viewport: [9, 9], width: 1.5, nearer: 1e-4 });
    this.view.lines.draw();
  }

  /** Where the ground, or else the distance of the focus, is under a place of the canvas. */
  pointAt(x, y) {
    const hit = this.pick(x, y);
    if (hit) return hit.point;
    const [px, py] = [(2 * x) / this.canvas.clientWidth - 1, 1 - (2 * y) / this.canvas.clientHeight];
    const { from, along } = this.camera.ray(px, py, this.aspect);
    const down = along[2] < -0.02 ? -from[2] / along[2] : -1;
    const far = down > 0 && down < this.camera.distance * 3 ? down : this.camera.distance;
    return from.map((v, i) => v + along[i] * far);
  }

  /** Where a point of the world is on the canvas, in CSS pixels; null when it is behind. */
  screenPosition(point) {
    const [x, y, z] = projected(this.matrices.matrix, point);
    if (Math.abs(z) > 1) return null;
    return [((x + 1) / 2) * this.canvas.clientWidth, ((1 - y) / 2) * this.canvas.clientHeight];
  }

  /** Shows objects, or everything. */
  fit(handles = [], atOnce = false) {
    const chosen = handles.flatMap((handle) => this.view.descendants(handle));
    const bounds = chosen.length ? this.view.bounds(chosen) : this.view.contentBounds();
    if (bounds.empty) this.camera.fit([0, 0, 0.2], 1.2, this.aspect, atOnce);
    else this.camera.fit(bounds.centre, Math.max(bounds.radius, 0.02), this.aspect, atOnce);
    this.stale = true;
  }
}
