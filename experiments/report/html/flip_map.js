// FLIP per pixel: Andersson et al., "FLIP: A Difference Evaluator for Alternating Images" (2020),
// and for radiance "Visualizing Errors in Rendered High Dynamic Range Images" (2021). The numbers
// are those of core/image/metrics/flip.cpp.

// Viewing condition of the papers: 0.7 m from a screen that is 0.7 m and 3840 pixels wide.
const FLIP_PIXELS_PER_DEGREE = 67.02064327658225;
const FLIP_COLOUR_EXPONENT = 0.7, FLIP_KNEE_OF_ERROR = 0.4, FLIP_KNEE_OF_RESULT = 0.95;
const FLIP_FEATURE_WIDTH = 0.082;  // degrees

// Makes the filters, which have one radius.
const flipFilters = (() => {
  const sigma = variance => Math.sqrt(variance / 2) / Math.PI * FLIP_PIXELS_PER_DEGREE;
  const radius = Math.ceil(3 * sigma(0.04));
  const contrast = variance => gaussianKernel(sigma(variance), radius);
  // Blue-yellow is a sum of two terms: a term's weights in two dimensions are products of both
  // directions'.
  const terms = [[34.1, 0.04], [13.5, 0.025]].map(([scale, variance]) => {
    const sum = contrast(variance).reduce((total, weight) => total + weight, 0);
    return {kernel: normalisedKernel(contrast(variance)),
            share: scale * Math.sqrt(Math.PI / variance) * sum * sum};
  });
  const total = terms[0].share + terms[1].share;
  const width = 0.5 * FLIP_FEATURE_WIDTH * FLIP_PIXELS_PER_DEGREE;
  const reach = Math.ceil(3 * width);
  const blur = gaussianKernel(width, radius)
                   .map((weight, i) => Math.abs(i - radius) <= reach ? weight : 0);
  // Scales the weights of a derivative: positive ones sum to 1, negative ones to -1.
  const balanced = kernel => {
    let positive = 0, negative = 0;
    for (const weight of kernel) weight > 0 ? positive += weight : negative -= weight;
    return kernel.map(weight => weight / (weight > 0 ? positive : negative));
  };
  return {
    radius, achromatic: normalisedKernel(contrast(0.0047)),
    redGreen: normalisedKernel(contrast(0.0053)),
    blueYellow: terms.map(term => term.kernel), shares: terms.map(term => term.share / total),
    blur: normalisedKernel(blur),
    edge: balanced(blur.map((weight, i) => (radius - i) * weight)),
    point: balanced(blur.map((weight, i) => ((i - radius) ** 2 / (width * width) - 1) * weight))
  };
})();

// Returns sqrt(x^2 + y^2) of two planes' values.
function lengths({values: x}, {values: y}) {
  return x.map((value, k) => Math.sqrt(value * value + y[k] * y[k]));
}

// Returns a band as an observer perceives it: {l, a, b, edge, point}.
function* flipLook({data, width, height}, [first, rows], show) {
  const {radius, achromatic, redGreen, blueYellow, shares, blur, edge, point} = flipFilters;
  const size = {width: width + 2 * radius, height: rows + 2 * radius};
  const plane = () => ({...size, values: new Float64Array(size.width * size.height)});
  const y = plane(), cx = plane(), cz = plane(), grey = plane();
  yield* eachBandPixel(width, height, first, rows, radius, (at, k) => {
    putOpponent(show(data[at]), show(data[at + 1]), show(data[at + 2]), k, y.values, cx.values,
                cz.values);
    grey.values[k] = (y.values[k] + 16) / 116;
  });
  const both = function*(from, kernel) {
    const across = filteredAcross(from, kernel);
    yield;
    const {values} = filteredDown(across, kernel);
    yield;
    return values;
  };
  const l = yield* both(y, achromatic), a = yield* both(cx, redGreen);
  const b = yield* both(cz, blueYellow[0]), b1 = yield* both(cz, blueYellow[1]);
  for (let k = 0; k < b.length; ++k) b[k] = shares[0] * b[k] + shares[1] * b1[k];
  yield* eachChunk(l.length, (from, to) => labOfOpponent(l, a, b, from, to));
  const blurred = filteredAcross(grey, blur);
  yield;
  const edgeX = filteredDown(filteredAcross(grey, edge), blur);
  yield;
  const edges = lengths(edgeX, filteredDown(blurred, edge));
  yield;
  const pointX = filteredDown(filteredAcross(grey, point), blur);
  yield;
  return {l, a, b, edge: edges, point: lengths(pointX, filteredDown(blurred, point))};
}

// HyAB distance of two colours of CIELAB, compressed.
function flipDistance(l, a, b) {
  return Math.pow(Math.abs(l) + Math.sqrt(a * a + b * b), FLIP_COLOUR_EXPONENT);
}

// Largest distance between two colours of a screen: green against blue.
const FLIP_LARGEST = (() => {
  const l = [], a = [], b = [];
  putHuntLab(0, 1, 0, 0, l, a, b);
  putHuntLab(0, 0, 1, 1, l, a, b);
  return flipDistance(l[0] - l[1], a[0] - a[1], b[0] - b[1]);
})();

// Maps a distance to 0..1: most are far below the largest and get most of the scale.
function flipColourError(distance) {
  const knee = FLIP_KNEE_OF_ERROR * FLIP_LARGEST;
  if (distance < knee) return FLIP_KNEE_OF_RESULT * distance / knee;
  return FLIP_KNEE_OF_RESULT +
      (1 - FLIP_KNEE_OF_RESULT) * (distance - knee) / (FLIP_LARGEST - knee);
}

// Raises values to the errors of pixels from..to of a band, which begins at `at`. A NaN, once
// there, stays.
function raiseFlip(x, y, values, at, from, to) {
  for (let k = from; k < to; ++k) {
    const colour = flipColourError(flipDistance(x.l[k] - y.l[k], x.a[k] - y.a[k], x.b[k] - y.b[k]));
    const feature = Math.max(Math.abs(x.edge[k] - y.edge[k]), Math.abs(x.point[k] - y.point[k]));
    const error = Math.pow(colour, 1 - Math.sqrt(feature / Math.SQRT2));
    if (!(error <= values[at + k]) && !Number.isNaN(values[at + k])) values[at + k] = error;
  }
}

// Steps as in errors.js; `choice`: steps that return displays (flip_colour.js). Without any display
// all values are NaN.
function* flipSteps(image, reference, choice) {
  const {width, height} = image, displays = yield* choice, {shows} = displays;
  const values = new Float32Array(width * height).fill(shows.length ? 0 : NaN);
  const bands = bandsOf(width, height);
  for (const [e, show] of shows.entries()) {
    for (const [k, band] of bands.entries()) {
      yield (e + k / bands.length) / shows.length;
      const seen = yield* flipLook(image, band, show);
      const other = yield* flipLook(reference, band, show), at = band[0] * width;
      yield* eachChunk(width * band[1],
                       (from, to) => raiseFlip(seen, other, values, at, from, to));
    }
  }
  const condition = `${FLIP_PIXELS_PER_DEGREE.toPrecision(4)} pixels per degree`;
  return {values, mean: meanOfMap(values, image, reference),
          text: displays.text ? `${displays.text}, ${condition}` : condition};
}
