// Structural similarity per pixel: Wang et al., "Image Quality Assessment: From Error Visibility to
// Structural Similarity" (2004), with the constants of core/image/metrics/ssim.h.

const SSIM_RADIUS = 5, SSIM_SIGMA = 1.5, SSIM_C1 = 0.01 ** 2, SSIM_C2 = 0.03 ** 2;

function encodeSrgb(linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * Math.pow(linear, 1 / 2.4) - 0.055;
}

// Returns a channel of a band as shown: clipped and sRGB encoded.
function* encodedChannel({data, width, height}, [first, rows], channel) {
  const across = width + 2 * SSIM_RADIUS, down = rows + 2 * SSIM_RADIUS;
  const values = new Float64Array(across * down);
  yield* eachBandPixel(width, height, first, rows, SSIM_RADIUS, (at, k) => {
    values[k] = encodeSrgb(clampUnit(data[at + channel]));
  });
  return {width: across, height: down, values};
}

function planeProduct(a, b) { return {...a, values: a.values.map((x, i) => x * b.values[i])}; }

// Adds a third of the index of one channel of a band.
function* addSsim(a, b, window, sum) {
  const windowed = function*(plane) {
    const rows = filteredAcross(plane, window);
    yield;
    const {values} = filteredDown(rows, window);
    yield;
    return values;
  };
  const meanA = yield* windowed(a), meanB = yield* windowed(b);
  const aa = yield* windowed(planeProduct(a, a)), bb = yield* windowed(planeProduct(b, b));
  const ab = yield* windowed(planeProduct(a, b));
  for (let i = 0; i < sum.length; ++i) {
    const ma = meanA[i], mb = meanB[i];
    const varianceA = aa[i] - ma * ma, varianceB = bb[i] - mb * mb, covariance = ab[i] - ma * mb;
    sum[i] += (2 * ma * mb + SSIM_C1) * (2 * covariance + SSIM_C2) /
        ((ma * ma + mb * mb + SSIM_C1) * (varianceA + varianceB + SSIM_C2)) / 3;
  }
}

// Steps as in errors.js.
function* ssimSteps(image, reference) {
  const {width, height} = image, values = new Float32Array(width * height);
  const window = normalisedKernel(gaussianKernel(SSIM_SIGMA, SSIM_RADIUS));
  for (const band of bandsOf(width, height)) {
    const [first, rows] = band, sum = new Float64Array(width * rows);
    for (let channel = 0; channel < 3; ++channel) {
      yield first / height;
      const a = yield* encodedChannel(image, band, channel);
      yield* addSsim(a, yield* encodedChannel(reference, band, channel), window, sum);
    }
    values.set(sum, first * width);
  }
  return {values, mean: meanOfMap(values, image, reference), text: ''};
}
