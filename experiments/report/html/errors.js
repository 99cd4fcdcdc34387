// Errors of an image against another one, one value a pixel.

// `pixel` takes the differences d = image - reference of a pixel and the reference. `name` is that
// of the metric which the mean over all pixels is, where there is one.
const ERRORS = {
  signed: {
    title: 'signed error', formula: 'mean over channels of d', metric: 'mean error',
    signed: true, log: false,
    pixel: (dr, dg, db) => (dr + dg + db) / 3
  },
  absolute: {
    title: 'absolute error', formula: 'mean over channels of |d|', metric: 'mae',
    log: false,
    pixel: (dr, dg, db) => (Math.abs(dr) + Math.abs(dg) + Math.abs(db)) / 3
  },
  squared: {
    title: 'squared error', formula: 'mean over channels of d\u00b2', metric: 'mse',
    log: true,
    pixel: (dr, dg, db) => (dr * dr + dg * dg + db * db) / 3
  },
  relative: {
    title: 'relative error', formula: 'mean over channels of |d| / (|r| + 0.01)',
    metric: 'mape_e1e-2', log: false,
    pixel: (dr, dg, db, r, g, b) =>
        (Math.abs(dr) / (Math.abs(r) + 1e-2) + Math.abs(dg) / (Math.abs(g) + 1e-2) +
         Math.abs(db) / (Math.abs(b) + 1e-2)) / 3
  }
};
const ERROR_ORDER = ['none', 'signed', 'absolute', 'squared', 'relative'];
// Decades of a logarithmic scale.
const ERROR_DECADES = 4;

function errorOfPixel(kind, a, r, i) {
  return ERRORS[kind].pixel(a[i] - r[i], a[i + 1] - r[i + 1], a[i + 2] - r[i + 2], r[i], r[i + 1],
                            r[i + 2]);
}

// {values: one a pixel, mean}; a value that is not finite makes the mean NaN, as in the metrics.
function errorPlane(kind, image, reference) {
  const count = image.length / 3;
  const values = new Float32Array(count);
  let sum = 0;
  for (let i = 0; i < count; ++i) {
    const value = errorOfPixel(kind, image, reference, 3 * i);
    values[i] = value;
    sum += value;
  }
  return {values, mean: Number.isFinite(sum) ? sum / count : NaN};
}

// What 98 % of the pixels of all planes together do not exceed, as a round number.
function commonRange(planes) {
  const sizes = [];
  for (const plane of planes) {
    const step = Math.max(1, Math.floor(plane.values.length / 20000));
    for (let i = 0; i < plane.values.length; i += step) {
      const size = Math.abs(plane.values[i]);
      if (Number.isFinite(size)) sizes.push(size);
    }
  }
  if (!sizes.length) return 1;
  sizes.sort((a, b) => a - b);
  return niceAbove(sizes[Math.floor(0.98 * (sizes.length - 1))]);
}

// The scale of an error: [-range, range], [0, range] or decades below range.
function errorScale(kind, range, log) {
  if (ERRORS[kind].signed) return makeScale(-range, range, false, MAPS.diverging);
  if (log) return makeScale(range / Math.pow(10, ERROR_DECADES), range, true, MAPS.rising);
  return makeScale(0, range, false, MAPS.rising);
}
