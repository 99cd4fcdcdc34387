// Errors of an image against another one, one value per pixel.

// `fill(a, r, out)` writes the error of each pixel of the image a against the reference r, with
// three values per pixel in both, and returns the sum; d = a - r. Every kind has its own loop: a
// function call per pixel takes several times as long. `metric`: name of the metric that is the
// mean over all pixels, if there is one. Kinds that take seconds have `steps(image, reference)`
// instead: a generator that yields the share that is done, and returns {values, mean, text}
// (rest_maps.js); `text` says what was chosen by the reference. `isLikeness`: 1 where nothing
// differs.
const ERRORS = {
  signed: {
    title: 'signed error', formula: 'mean over channels of d', metric: 'mean error',
    signed: true, log: false,
    fill(a, r, out) {
      let sum = 0;
      for (let i = 0, k = 0; k < out.length; i += 3, ++k) {
        const value = (a[i] - r[i] + (a[i + 1] - r[i + 1]) + (a[i + 2] - r[i + 2])) / 3;
        out[k] = value;
        sum += value;
      }
      return sum;
    }
  },
  absolute: {
    title: 'absolute error', formula: 'mean over channels of |d|', metric: 'mae',
    log: false,
    fill(a, r, out) {
      let sum = 0;
      for (let i = 0, k = 0; k < out.length; i += 3, ++k) {
        const value = (Math.abs(a[i] - r[i]) + Math.abs(a[i + 1] - r[i + 1]) +
                       Math.abs(a[i + 2] - r[i + 2])) / 3;
        out[k] = value;
        sum += value;
      }
      return sum;
    }
  },
  squared: {
    title: 'squared error', formula: 'mean over channels of d\u00b2', metric: 'mse',
    log: true,
    fill(a, r, out) {
      let sum = 0;
      for (let i = 0, k = 0; k < out.length; i += 3, ++k) {
        const red = a[i] - r[i], green = a[i + 1] - r[i + 1], blue = a[i + 2] - r[i + 2];
        const value = (red * red + green * green + blue * blue) / 3;
        out[k] = value;
        sum += value;
      }
      return sum;
    }
  },
  relative: {
    title: 'relative error', formula: 'mean over channels of |d| / (|r| + 0.01)',
    metric: 'mape_e1e-2', log: false,
    fill(a, r, out) {
      let sum = 0;
      for (let i = 0, k = 0; k < out.length; i += 3, ++k) {
        const red = r[i], green = r[i + 1], blue = r[i + 2];
        const value = (Math.abs(a[i] - red) / (Math.abs(red) + 1e-2) +
                       Math.abs(a[i + 1] - green) / (Math.abs(green) + 1e-2) +
                       Math.abs(a[i + 2] - blue) / (Math.abs(blue) + 1e-2)) / 3;
        out[k] = value;
        sum += value;
      }
      return sum;
    }
  },
  smape: {
    title: 'SMAPE', formula: 'mean over channels of |d| / ((|image| + |r|) / 2 + 0.01)',
    metric: 'smape', log: false,
    fill(a, r, out) {
      let sum = 0;
      for (let i = 0, k = 0; k < out.length; i += 3, ++k) {
        const red = a[i], green = a[i + 1], blue = a[i + 2];
        const x = r[i], y = r[i + 1], z = r[i + 2];
        const value = (Math.abs(red - x) / (0.5 * (Math.abs(red) + Math.abs(x)) + 1e-2) +
                       Math.abs(green - y) / (0.5 * (Math.abs(green) + Math.abs(y)) + 1e-2) +
                       Math.abs(blue - z) / (0.5 * (Math.abs(blue) + Math.abs(z)) + 1e-2)) / 3;
        out[k] = value;
        sum += value;
      }
      return sum;
    }
  },
  ssim: {
    title: 'SSIM', metric: 'ssim', log: false, isLikeness: true,
    formula: 'structural similarity of R, G, B clipped to 0..1 and sRGB encoded, 11\u00d711 pixels',
    steps: (image, reference) => ssimSteps(image, reference)
  },
  flip_ldr: {
    title: 'LDR-FLIP', metric: 'flip_ldr', log: false,
    formula: 'difference when flipping, radiance \u00d7 1 clipped to 0..1',
    steps: (image, reference) => flipSteps(image, reference, clippedDisplay())
  },
  flip_hdr: {
    title: 'HDR-FLIP', metric: 'flip_hdr', log: false,
    formula: 'difference when flipping, the largest over exposures, ACES tone mapping',
    steps: (image, reference) => flipSteps(image, reference, exposedDisplays(reference))
  }
};
const ERROR_ORDER = ['none', ...Object.keys(ERRORS)];
// Decades of a logarithmic scale.
const ERROR_DECADES = 4;

// Returns true if an error is computed at rest alone, in the background.
const isRestError = kind => kind !== 'none' && Boolean(ERRORS[kind].steps);

// Returns the title of an error as an entry of a list: with a capital letter.
function errorLabel(kind) {
  const {title} = ERRORS[kind];
  return title[0].toUpperCase() + title.slice(1);
}

// Returns true if an error may have a logarithmic scale.
const canBeLog = kind => kind !== 'none' && !ERRORS[kind].signed && !ERRORS[kind].isLikeness;

// Returns {values: one per pixel, mean}; a non-finite value makes the mean NaN, as in the metrics.
// `values`: memory of an old plane to reuse.
function errorPlane(kind, image, reference, values) {
  const count = image.length / 3;
  if (!values || values.length !== count) values = new Float32Array(count);
  const sum = ERRORS[kind].fill(image, reference, values);
  return {values, mean: Number.isFinite(sum) ? sum / count : NaN};
}

// Returns the 98th percentile of the absolute finite values of all lists together, from about 20000
// samples of each; null if there are none. `from`: the value that has no size.
function commonSize(lists, from = 0) {
  const steps = lists.map(values => Math.max(1, Math.floor(values.length / 20000)));
  const sizes = new Float32Array(
      lists.reduce((sum, values, k) => sum + Math.ceil(values.length / steps[k]), 0));
  let count = 0;
  lists.forEach((values, k) => {
    for (let i = 0; i < values.length; i += steps[k]) {
      const size = Math.abs(values[i] - from);
      if (size < Infinity) sizes[count++] = size;
    }
  });
  return count ? sizes.subarray(0, count).sort()[Math.floor(0.98 * (count - 1))] : null;
}

// Returns the scale of an error: [-range, range], [0, range], decades below range, or of a likeness
// [1, 1 - range].
function errorScale(kind, range, log) {
  if (ERRORS[kind].isLikeness) return makeScale(1, 1 - range, false, MAPS.rising);
  if (ERRORS[kind].signed) return makeScale(-range, range, false, MAPS.diverging);
  if (log) return makeScale(range / Math.pow(10, ERROR_DECADES), range, true, MAPS.rising);
  return makeScale(0, range, false, MAPS.rising);
}
