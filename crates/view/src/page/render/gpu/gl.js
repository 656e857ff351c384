// WebGL2 with names: programs with their places, buffers, targets to draw into.

/** Attributes have the same place in all programs, so that one set of bindings serves pictures, shadows and picking. */
export const PLACES = { position: 0, normal: 1, uv: 2, slot: 3, offset: 4, turn: 5, tint: 6, from: 0, to: 1 };

/** @returns {WebGL2RenderingContext | null} */
export function context(canvas) {
  return canvas.getContext('webgl2', { antialias: true, alpha: false, powerPreference: 'high-performance', preserveDrawingBuffer: false });
}

/** Whether pictures are computed without a graphics processor. */
export function isSoftware(gl) {
  const extension = gl.getExtension('WEBGL_debug_renderer_info');
  const name = extension ? gl.getParameter(extension.UNMASKED_RENDERER_WEBGL) : '';
  return /swiftshader|llvmpipe|software/i.test(name);
}

function shader(gl, type, text) {
  const made = gl.createShader(type);
  gl.shaderSource(made, `#version 300 es\nprecision highp float;\nprecision highp int;\n${text}`);
  gl.compileShader(made);
  if (!gl.getShaderParameter(made, gl.COMPILE_STATUS) && !gl.isContextLost()) throw new Error(gl.getShaderInfoLog(made));
  return made;
}

/** A program; its uniforms are set by name: `use({ light: [0, 0, 1] })`. */
export class Program {
  constructor(gl, vertex, fragment) {
    this.gl = gl;
    this.program = gl.createProgram();
    gl.attachShader(this.program, shader(gl, gl.VERTEX_SHADER, vertex));
    gl.attachShader(this.program, shader(gl, gl.FRAGMENT_SHADER, fragment));
    for (const [name, place] of Object.entries(PLACES)) gl.bindAttribLocation(this.program, place, name);
    gl.linkProgram(this.program);
    if (!gl.getProgramParameter(this.program, gl.LINK_STATUS) && !gl.isContextLost()) throw new Error(gl.getProgramInfoLog(this.program));
    this.uniforms = new Map();
    const count = gl.getProgramParameter(this.program, gl.ACTIVE_UNIFORMS) ?? 0;
    for (let i = 0; i < count; i++) {
      const { name, type } = gl.getActiveUniform(this.program, i);
      this.uniforms.set(name, { type, place: gl.getUniformLocation(this.program, name) });
    }
  }

  /** @param {Object<string, any>} values numbers, lists; of samplers the number of the texture unit */
  use(values) {
    this.gl.useProgram(this.program);
    for (const [name, value] of Object.entries(values)) this.set(name, value);
  }

  set(name, value) {
    const { gl } = this;
    const uniform = this.uniforms.get(name);
    if (!uniform) return;
    const { type, place } = uniform;
    if (type === gl.FLOAT_MAT4) gl.uniformMatrix4fv(place, false, value);
    else if (type === gl.FLOAT_VEC4) gl.uniform4fv(place, value);
    else if (type === gl.FLOAT_VEC3) gl.uniform3fv(place, value);
    else if (type === gl.FLOAT_VEC2) gl.uniform2fv(place, value);
    else if (type === gl.FLOAT) gl.uniform1f(place, value);
    else gl.uniform1i(place, value);
  }
}

/** @returns {WebGLBuffer} */
export function buffer(gl, data, target = gl.ARRAY_BUFFER) {
  const made = gl.createBuffer();
  gl.bindBuffer(target, made);
  gl.bufferData(target, data, gl.STATIC_DRAW);
  return made;
}

/** A texture of `size` pixels, without content. */
export function emptyTexture(gl, format, [width, height], filter = gl.NEAREST) {
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, filter);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, filter);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
  return texture;
}

/** Something to draw into: colours of 4 bytes (`colors` of them) and, if wanted, depth. */
export class Target {
  constructor(gl, size, colors, depth) {
    this.gl = gl;
    this.size = size;
    this.frame = gl.createFramebuffer();
    this.colors = Array.from({ length: colors }, () => emptyTexture(gl, gl.RGBA8, size));
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.frame);
    this.colors.forEach((texture, i) => gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0 + i, gl.TEXTURE_2D, texture, 0));
    if (depth) this._addDepth();
    gl.drawBuffers(this.colors.map((_, i) => gl.COLOR_ATTACHMENT0 + i));
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  }

  _addDepth() {
    const { gl, size } = this;
    this.depth = gl.createRenderbuffer();
    gl.bindRenderbuffer(gl.RENDERBUFFER, this.depth);
    gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT24, ...size);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, this.depth);
  }

  begin() {
    const { gl } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.frame);
    gl.viewport(0, 0, ...this.size);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  }

  free() {
    this.colors.forEach((texture) => this.gl.deleteTexture(texture));
    if (this.depth) this.gl.deleteRenderbuffer(this.depth);
    this.gl.deleteFramebuffer(this.frame);
  }
}
