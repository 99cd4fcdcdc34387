// Coloured pictures of images and errors at the images' own size; a view enlarges them. Each is a
// canvas; one that is no longer wanted is written over.

// One for all canvases of a size: a canvas takes a copy.
let sharedPicture = null;

function canvasOf(width, height, held) {
  if (held && held.width === width && held.height === height) return held;
  const canvas = document.createElement('canvas');
  canvas.width = width;
  canvas.height = height;
  return canvas;
}

// `fill` writes one word a pixel.
function paintedCanvas(width, height, held, fill) {
  const canvas = canvasOf(width, height, held), context = canvas.getContext('2d');
  if (!sharedPicture || sharedPicture.width !== width || sharedPicture.height !== height) {
    sharedPicture = context.createImageData(width, height);
  }
  fill(new Uint32Array(sharedPicture.data.buffer));
  context.putImageData(sharedPicture, 0, 0);
  return canvas;
}

// The pixel of R, G, B of which one is no finite number.
function nonfiniteColour(data, i) {
  return data.subarray(3 * i, 3 * i + 3).some(Number.isNaN) ? NAN_WORD : INF_WORD;
}

function markNonfinite(image, out) {
  for (const i of image.nonfinite) out[i] = nonfiniteColour(image.data, i);
}

// Radiance times exposure as sRGB, clipped.
function srgbLayer(image, encoder, held) {
  return paintedCanvas(image.width, image.height, held, out => {
    encoder.fill(image.data, out);
    markNonfinite(image, out);
  });
}

// Luminance by a logarithmic scale.
function falseColourLayer(image, scale, held) {
  return paintedCanvas(image.width, image.height, held, out => {
    fillLuminance(image.data, scale, out);
    markNonfinite(image, out);
  });
}

// Values by a scale, one a pixel.
function scaledLayer(image, values, scale, held) {
  return paintedCanvas(image.width, image.height, held, out => fillScaled(values, scale, out));
}

// One value a pixel of an overlay of that, or of R, G, B; null where it is not as large as its
// image.
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
