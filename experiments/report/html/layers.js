// Colours images and errors at the images' own size; a view enlarges them. Each layer is a canvas;
// `held` is an old one to reuse.

// Shared by all canvases of one size: a canvas copies it.
let sharedPicture = null;

function canvasOf(width, height, held) {
  if (held && held.width === width && held.height === height) return held;
  const canvas = document.createElement('canvas');
  canvas.width = width;
  canvas.height = height;
  return canvas;
}

// `fill` writes one word per pixel.
function paintedCanvas(width, height, held, fill) {
  const canvas = canvasOf(width, height, held), context = canvas.getContext('2d');
  if (!sharedPicture || sharedPicture.width !== width || sharedPicture.height !== height) {
    sharedPicture = context.createImageData(width, height);
  }
  fill(new Uint32Array(sharedPicture.data.buffer));
  context.putImageData(sharedPicture, 0, 0);
  return canvas;
}

// Returns the pixel for R, G, B of which at least one is not finite.
function nonfiniteColour(data, i) {
  return data.subarray(3 * i, 3 * i + 3).some(Number.isNaN) ? NAN_WORD : INF_WORD;
}

function markNonfinite(image, out) {
  for (const i of image.nonfinite) out[i] = nonfiniteColour(image.data, i);
}

// Draws radiance times exposure as sRGB, clipped.
function srgbLayer(image, encoder, held) {
  return paintedCanvas(image.width, image.height, held, out => {
    encoder.fill(image.data, out);
    markNonfinite(image, out);
  });
}

// Draws the luminance by a logarithmic scale.
function falseColourLayer(image, scale, held) {
  return paintedCanvas(image.width, image.height, held, out => {
    fillLuminance(image.data, scale, out);
    markNonfinite(image, out);
  });
}

// Draws one value per pixel by a scale.
function scaledLayer(image, values, scale, held) {
  return paintedCanvas(image.width, image.height, held, out => fillScaled(values, scale, out));
}

// Returns one value per pixel of an overlay, which has one value or R, G, B per pixel; null if its
// size differs from the image's.
function overlayValues(image) {
  const {data} = image.overlay, count = image.width * image.height;
  if (!data || data.length === count) return data;
  if (data.length !== 3 * count) return null;
  const values = new Float32Array(count);
  for (let k = 0; k < count; ++k) {
    values[k] = luminance(data[3 * k], data[3 * k + 1], data[3 * k + 2]);
  }
  return values;
}
