// Separable filters over bands of an image, in double precision, for errors that look at the
// neighbourhood of a pixel. core/image/metrics/plane.h has the same for the program's metrics.

// Returns exp(-x^2 / (2 sigma^2)) for x in -radius..radius, not normalised.
function gaussianKernel(sigma, radius) {
  return Float64Array.from({length: 2 * radius + 1}, (_, i) => {
    const x = i - radius;
    return Math.exp(-x * x / (2 * sigma * sigma));
  });
}

function normalisedKernel(kernel) {
  const sum = kernel.reduce((total, weight) => total + weight, 0);
  return kernel.map(weight => weight / sum);
}

// Correlates the rows of a plane with a kernel, where it lies inside of them.
function filteredAcross({width, height, values}, kernel) {
  const n = kernel.length, across = width - n + 1, out = new Float64Array(across * height);
  for (let y = 0, k = 0; y < height; ++y) {
    for (let x = 0, from = y * width; x < across; ++x, ++from, ++k) {
      let sum = 0;
      for (let j = 0; j < n; ++j) sum += kernel[j] * values[from + j];
      out[k] = sum;
    }
  }
  return {width: across, height, values: out};
}

// Correlates the columns of a plane with a kernel, where it lies inside of them.
function filteredDown({width, height, values}, kernel) {
  const n = kernel.length, down = height - n + 1, out = new Float64Array(width * down);
  for (let k = 0; k < out.length; ++k) {
    let sum = 0;
    for (let j = 0, from = k; j < n; ++j, from += width) sum += kernel[j] * values[from];
    out[k] = sum;
  }
  return {width, height: down, values: out};
}

// Number of pixels between two yields of costly loops.
const PLANE_CHUNK = 16384;

// Calls pixel(at, k) for the pixels of rows first..first + rows with `border` pixels around them:
// k counts them, `at` is the index of R in the image. Beyond the image, edge pixels repeat.
function* eachBandPixel(width, height, first, rows, border, pixel) {
  let next = PLANE_CHUNK;
  for (let y = first - border, k = 0; y < first + rows + border; ++y) {
    const row = Math.min(Math.max(y, 0), height - 1) * width;
    for (let x = -border; x < width + border; ++x, ++k) {
      pixel(3 * (row + Math.min(Math.max(x, 0), width - 1)), k);
    }
    if (k < next) continue;
    next += PLANE_CHUNK;
    yield;
  }
}

// Calls part(from, to) for parts of 0..count.
function* eachChunk(count, part) {
  for (let from = 0; from < count; from += PLANE_CHUNK) {
    part(from, Math.min(count, from + PLANE_CHUNK));
    yield;
  }
}

// Returns [first row, number of rows] of bands that cover an image: small enough for one filter of
// a band to take a few milliseconds, large against the border.
function bandsOf(width, height) {
  const most = Math.max(32, Math.floor(1e5 / width)), bands = [];
  for (let first = 0; first < height; first += most) {
    bands.push([first, Math.min(most, height - first)]);
  }
  return bands;
}

// Returns a value, or the end of 0..1 that it is beyond; NaN stays.
function clampUnit(x) { return x < 0 ? 0 : x > 1 ? 1 : x; }

// Returns the mean of a map of two images: NaN if either has values that are not finite, as in the
// metrics.
function meanOfMap(values, image, reference) {
  if (image.nonfinite.length + reference.nonfinite.length) return NaN;
  let sum = 0;
  for (let k = 0; k < values.length; ++k) sum += values[k];
  return sum / values.length;
}
