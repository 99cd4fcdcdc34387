// Colours images and errors by WebGL2: the same pictures as by tables, made on the GPU. A byte of
// sRGB differs by at most one. A colour of a map is at most the next one, if 32-bit arithmetic
// rounds to the other side.

const GL_KINDS = ['srgb', 'luminance', 'signed', 'absolute', 'squared', 'relative', 'smape'];

const GL_VERTEX = `#version 300 es
void main() {
  // One triangle covers everything.
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}`;

const GL_FRAGMENT = `#version 300 es
precision highp float;
precision highp int;
uniform highp sampler2D image, reference;
uniform sampler2D map;
uniform int kind, height;
// Position in the map: (f(value) - lo) / span, f the logarithm or the value itself.
uniform bool isLog;
uniform float factor, lo, span;
out vec4 pixel;

// Test the bits: GLSL allows any result for arithmetic on NaN and infinities.
uint magnitude(float value) { return floatBitsToUint(value) & 0x7fffffffu; }
bool isNan(float value) { return magnitude(value) > 0x7f800000u; }
bool isOdd(float value) { return magnitude(value) >= 0x7f800000u; }
vec4 oddColour(bool nan) { return nan ? vec4(1, 0, 1, 1) : vec4(0, 1, 0, 1); }

vec4 mapped(float value) {
  if (isOdd(value)) return oddColour(isNan(value));
  float at = -1.0;
  if (!isLog) at = (value - lo) / span;
  else if (value > 0.0) at = (log2(value) - lo) / span;
  return texelFetch(map, ivec2(int(clamp(at * 255.0, 0.0, 255.0) + 0.5), 0), 0);
}

vec3 srgb(vec3 linear) {
  vec3 c = clamp(linear, 0.0, 1.0);
  vec3 curve = 1.055 * pow(max(c, 1e-6), vec3(1.0 / 2.4)) - 0.055;
  return floor(255.0 * mix(curve, 12.92 * c, lessThanEqual(c, vec3(0.0031308))) + 0.5) / 255.0;
}

void main() {
  // Row 0 of the image is at the top.
  ivec2 at = ivec2(int(gl_FragCoord.x), height - 1 - int(gl_FragCoord.y));
  vec3 a = texelFetch(image, at, 0).rgb;
  if (kind < 2) {
    if (isOdd(a.r) || isOdd(a.g) || isOdd(a.b)) {
      pixel = oddColour(isNan(a.r) || isNan(a.g) || isNan(a.b));
    } else if (kind == 0) {
      pixel = vec4(srgb(factor * a), 1.0);
    } else {
      pixel = mapped(0.2126 * a.r + 0.7152 * a.g + 0.0722 * a.b);
    }
    return;
  }
  vec3 r = texelFetch(reference, at, 0).rgb, d = a - r, size = abs(d);
  // Multiply by 1/3 before adding: the sum must not overflow if the mean does not.
  vec3 third = vec3(1.0 / 3.0);
  if (kind == 2) pixel = mapped(dot(d, third));
  if (kind == 3) pixel = mapped(dot(size, third));
  if (kind == 4) pixel = mapped(dot(d / 3.0, d));
  if (kind == 5) pixel = mapped(dot(size / (abs(r) + 0.01), third));
  if (kind == 6) pixel = mapped(dot(size / (0.5 * abs(a) + 0.5 * abs(r) + 0.01), third));
}`;

// Limit of images held on the GPU.
const GL_MOST_IMAGES = 8;

class GlColours {
  // Throws if WebGL2 is not available. `isStrict`: also throws without a GPU.
  constructor(isStrict) {
    this.canvas = document.createElement('canvas');
    const gl = this.canvas.getContext('webgl2', {
      alpha: false, antialias: false, depth: false, failIfMajorPerformanceCaveat: isStrict
    });
    if (!gl) throw new Error('no WebGL2');
    this.gl = gl;
    if (isStrict && isSoftwareGl(gl)) {
      this.dispose();
      throw new Error('WebGL2 without a graphics processor');
    }
    this.program = linkedProgram(gl);
    gl.useProgram(this.program);
    this.places = {};
    this.images = new Map();
    this.maps = new Map();
    this.largest = gl.getParameter(gl.MAX_TEXTURE_SIZE);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    ['image', 'reference', 'map'].forEach((name, unit) => gl.uniform1i(this.place(name), unit));
  }

  get isLost() { return this.gl.isContextLost(); }

  dispose() {
    const loser = this.gl.getExtension('WEBGL_lose_context');
    if (loser) loser.loseContext();
  }

  place(name) {
    if (!(name in this.places)) {
      this.places[name] = this.gl.getUniformLocation(this.program, name);
    }
    return this.places[name];
  }

  // Draws a picture of `kind` of an image into a canvas of its size; `held` as in layers.js.
  // Returns null if that fails: the context is lost, or the image is too large.
  layer({kind, image, reference, factor, scale}, held) {
    const {gl} = this, {width, height} = image;
    if (this.isLost || Math.max(width, height) > this.largest) return null;
    if (this.canvas.width !== width || this.canvas.height !== height) {
      Object.assign(this.canvas, {width, height});
    }
    gl.viewport(0, 0, width, height);
    // Make all textures first: making one binds it.
    const textures = [this.imageTexture(image), reference ? this.imageTexture(reference) : null,
                      scale ? this.mapTexture(scale.map) : null];
    textures.forEach((texture, unit) => this.bind(unit, texture));
    if (scale) {
      const f = scale.log ? Math.log2 : value => value;
      gl.uniform1i(this.place('isLog'), scale.log ? 1 : 0);
      gl.uniform1f(this.place('lo'), f(scale.lo));
      gl.uniform1f(this.place('span'), f(scale.hi) - f(scale.lo));
    } else {
      gl.uniform1f(this.place('factor'), factor);
    }
    gl.uniform1i(this.place('kind'), GL_KINDS.indexOf(kind));
    gl.uniform1i(this.place('height'), height);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    const canvas = canvasOf(width, height, held);
    canvas.getContext('2d').drawImage(this.canvas, 0, 0);
    return this.isLost ? null : canvas;
  }

  bind(unit, texture) {
    this.gl.activeTexture(this.gl.TEXTURE0 + unit);
    this.gl.bindTexture(this.gl.TEXTURE_2D, texture);
  }

  // Returns the texture of the newest version; evicts the least recently used image.
  imageTexture(image) {
    const {gl, images} = this, version = versionOf(image);
    let held = images.get(image);
    images.delete(image);
    if (held && (held.width !== image.width || held.height !== image.height)) {
      gl.deleteTexture(held.texture);
      held = null;
    }
    if (!held) {
      const {width, height} = image;
      held = {texture: this.newTexture(gl.RGB32F, width, height), width, height};
    }
    images.set(image, held);
    if (held.version !== version) {
      held.version = version;
      this.bind(0, held.texture);
      gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, image.width, image.height, gl.RGB, gl.FLOAT,
                       image.data);
    }
    for (const [other, {texture}] of images) {
      if (images.size <= GL_MOST_IMAGES) break;
      gl.deleteTexture(texture);
      images.delete(other);
    }
    return held.texture;
  }

  mapTexture(map) {
    const {gl, maps} = this;
    if (!maps.has(map)) {
      maps.set(map, this.newTexture(gl.RGBA8, 256, 1));
      gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, 256, 1, gl.RGBA, gl.UNSIGNED_BYTE,
                       new Uint8Array(map.words.buffer));
    }
    return maps.get(map);
  }

  newTexture(format, width, height) {
    const {gl} = this, texture = gl.createTexture();
    this.bind(0, texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
    // No filtering: texels are read exactly.
    for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) {
      gl.texParameteri(gl.TEXTURE_2D, name, gl.NEAREST);
    }
    return texture;
  }
}

function linkedProgram(gl) {
  const program = gl.createProgram();
  for (const [type, text] of [[gl.VERTEX_SHADER, GL_VERTEX], [gl.FRAGMENT_SHADER, GL_FRAGMENT]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
    throw new Error(`the shader cannot be used: ${gl.getProgramInfoLog(program)}`);
  }
  return program;
}

// On a software renderer tables are faster.
function isSoftwareGl(gl) {
  const info = gl.getExtension('WEBGL_debug_renderer_info');
  const name = gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

// Shared by all viewers, since browsers limit the number of contexts; null if not available.
const glColours = (() => {
  const made = new Map();
  return isStrict => {
    if (!made.has(isStrict)) {
      let colours = null;
      try {
        colours = new GlColours(isStrict);
      } catch (error) {
        // Fall back to the tables.
      }
      made.set(isStrict, colours);
    }
    return made.get(isStrict);
  };
})();
