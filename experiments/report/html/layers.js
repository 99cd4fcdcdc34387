// Coloured pictures of images and errors at the images' own size; a view enlarges them.

// `bytes` of the canvas keeps R, G, B, A of each pixel.
function canvasOf(width, height, fill) {
  const canvas = document.createElement('canvas');
  canvas.width = width;
  canvas.height = height;
  const context = canvas.getContext('2d');
  const picture = context.createImageData(width, height);
  fill(picture.data);
  context.putImageData(picture, 0, 0);
  canvas.bytes = picture.data;
  return canvas;
}

function setPixel(bytes, i, r, g, b) {
  bytes[4 * i] = r;
  bytes[4 * i + 1] = g;
  bytes[4 * i + 2] = b;
  bytes[4 * i + 3] = 255;
}

function setMapped(bytes, i, value, scale) {
  if (Number.isNaN(value)) {
    setPixel(bytes, i, ...NAN_COLOUR);
  } else if (!Number.isFinite(value)) {
    setPixel(bytes, i, ...INF_COLOUR);
  } else {
    const at = 3 * scale.index(value), map = scale.map;
    setPixel(bytes, i, map[at], map[at + 1], map[at + 2]);
  }
}

// Radiance times exposure as sRGB, clipped.
function srgbLayer(image, exposure) {
  const {levels, table} = srgbEncoder(exposure);
  const data = image.data, words = new Uint32Array(data.buffer);
  const encode = i => {
    const word = words[i];
    if (word >>> 31) return 0;
    let level = table[word >>> 15];
    while (data[i] >= levels[level + 1]) ++level;
    return level;
  };
  return canvasOf(image.width, image.height, bytes => {
    for (let i = 0; i < data.length / 3; ++i) {
      setPixel(bytes, i, encode(3 * i), encode(3 * i + 1), encode(3 * i + 2));
    }
    markNonfinite(bytes, image);
  });
}

function markNonfinite(bytes, image) {
  for (const i of image.nonfinite) {
    const pixel = image.data.subarray(3 * i, 3 * i + 3);
    setPixel(bytes, i, ...(pixel.some(Number.isNaN) ? NAN_COLOUR : INF_COLOUR));
  }
}

// Luminance by a scale.
function falseColourLayer(image, scale) {
  const data = image.data;
  return canvasOf(image.width, image.height, bytes => {
    for (let i = 0; i < data.length / 3; ++i) {
      setMapped(bytes, i, luminance(data[3 * i], data[3 * i + 1], data[3 * i + 2]), scale);
    }
    markNonfinite(bytes, image);
  });
}

function errorLayer(image, plane, scale) {
  return canvasOf(image.width, image.height, bytes => {
    for (let i = 0; i < plane.values.length; ++i) setMapped(bytes, i, plane.values[i], scale);
  });
}

// The last layer of each slot; made anew when its key has changed.
class LayerCache {
  constructor() { this.slots = new Map(); }

  get(slot, key, make) {
    const held = this.slots.get(slot);
    if (held && held.key === key) return held.layer;
    const layer = make();
    this.slots.set(slot, {key, layer});
    return layer;
  }
}
