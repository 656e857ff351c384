// The shadow map: distances as the key light sees them, drawn again only when something moved.
import { cross, normalized, orthographic, product, scaled, add, viewMatrix } from '../maths.js';

/** Where the light comes from: over the viewer's usual shoulder, so that shadows fall to the side. */
export const KEY_DIRECTION = normalized([0.42, -0.38, 0.82]);

export class Shadows {
  constructor(gl, program, size = 2048) {
    Object.assign(this, { gl, program, size });
    this.texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.DEPTH_COMPONENT24, size, size);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_COMPARE_MODE, gl.COMPARE_REF_TO_TEXTURE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_COMPARE_FUNC, gl.LEQUAL);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
    this.frame = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.frame);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, this.texture, 0);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    this.drawn = null;
  }

  /** Draws the map of a sphere of the scene, if it is another one or the scene has another version. */
  update(batches, centre, radius, version) {
    const key = [version, radius, ...centre].join();
    if (key === this.drawn) return;
    this.drawn = key;
    this.texel = (2 * radius) / this.size;
    this._aim(centre, radius);
    const { gl } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.frame);
    gl.viewport(0, 0, this.size, this.size);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(1.5, 3);
    gl.disable(gl.CULL_FACE);
    this.program.use({ slots: 0, view_projection: this.matrix });
    batches.drawOpaque((batch) => !batch.symbol && !batch.look.wireframe);
    gl.disable(gl.POLYGON_OFFSET_FILL);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  }

  _aim(centre, radius) {
    const right = normalized(cross([0, 0, 1], KEY_DIRECTION));
    const eye = add(centre, scaled(KEY_DIRECTION, 2 * radius));
    const view = viewMatrix(eye, right, cross(KEY_DIRECTION, right), KEY_DIRECTION);
    this.matrix = product(orthographic(radius, 1, radius * 0.2, radius * 4), view);
  }
}
