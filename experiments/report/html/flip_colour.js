// Colours of FLIP (flip_map.js), as in core/image/metrics/flip_color.h: displays, which turn
// radiance into linear values in 0..1, the opponent space in which contrast sensitivity is defined,
// and CIELAB.

function inverse3([a, b, c, d, e, f, g, h, i]) {
  const det = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g);
  return [e * i - f * h, c * h - b * i, b * f - c * e, f * g - d * i, a * i - c * g, c * d - a * f,
          d * h - e * g, b * g - a * h, a * e - b * d].map(x => x / det);
}

// XYZ of Rec. 709 relative to the white D65, by rows, and back.
const FLIP_SPACES = (() => {
  const ofLuminance1 = (x, y) => [x / y, 1, (1 - x - y) / y];
  const white = ofLuminance1(0.31271, 0.32902);
  const [r, g, b] = [ofLuminance1(0.64, 0.33), ofLuminance1(0.30, 0.60), ofLuminance1(0.15, 0.06)];
  const primaries = [r[0], g[0], b[0], r[1], g[1], b[1], r[2], g[2], b[2]];
  const back = inverse3(primaries);
  const scale = [0, 3, 6].map(k => back[k] * white[0] + back[k + 1] * white[1] +
                                  back[k + 2] * white[2]);
  const fromLinear = primaries.map((x, i) => x * scale[i % 3] / white[Math.floor(i / 3)]);
  return {fromLinear, toLinear: inverse3(fromLinear)};
})();

// Writes Yy, Cx and Cz of linear R, G, B at place k.
function putOpponent(red, green, blue, k, y, cx, cz) {
  const m = FLIP_SPACES.fromLinear;
  const X = m[0] * red + m[1] * green + m[2] * blue, Y = m[3] * red + m[4] * green + m[5] * blue;
  const Z = m[6] * red + m[7] * green + m[8] * blue;
  y[k] = 116 * Y - 16;
  cx[k] = 500 * (X - Y);
  cz[k] = 200 * (Y - Z);
}

function cielabCurve(t) {
  const delta = 6 / 29;
  return t > delta * delta * delta ? Math.cbrt(t) : t / (3 * delta * delta) + 4 / 29;
}

// Writes CIELAB of linear R, G, B at place k, with chroma that fades towards black (Hunt effect).
function putHuntLab(red, green, blue, k, lightness, a, b) {
  const m = FLIP_SPACES.fromLinear;
  const x = cielabCurve(m[0] * red + m[1] * green + m[2] * blue);
  const y = cielabCurve(m[3] * red + m[4] * green + m[5] * blue);
  const z = cielabCurve(m[6] * red + m[7] * green + m[8] * blue);
  const l = 116 * y - 16;
  lightness[k] = l;
  a[k] = 0.01 * l * 500 * (x - y);
  b[k] = 0.01 * l * 200 * (y - z);
}

// Replaces filtered Yy, Cx, Cz of pixels from..to by CIELAB of the colour on a screen.
function labOfOpponent(y, cx, cz, from, to) {
  const m = FLIP_SPACES.toLinear;
  for (let k = from; k < to; ++k) {
    const Y = (y[k] + 16) / 116, X = Y + cx[k] / 500, Z = Y - cz[k] / 200;
    const red = clampUnit(m[0] * X + m[1] * Y + m[2] * Z);
    const green = clampUnit(m[3] * X + m[4] * Y + m[5] * Z);
    const blue = clampUnit(m[6] * X + m[7] * Y + m[8] * Z);
    putHuntLab(red, green, blue, k, y, cx, cz);
  }
}

// Narkowicz's fit of ACES (2015): (a r^2 + b r) / (c r^2 + d r + e), 0.6 on the radiance r.
const ACES = {a: 0.6 * 0.6 * 2.51, b: 0.6 * 0.03, c: 0.6 * 0.6 * 2.43, d: 0.6 * 0.59, e: 0.14};

function acesTone(radiance) {
  const r = radiance < 0 ? 0 : radiance, {a, b, c, d, e} = ACES;
  return clampUnit((a * r * r + b * r) / (c * r * r + d * r + e));
}

// Returns the radiance that acesTone() shows as `shown` in 0..1.
function radianceShownAs(shown) {
  const a = ACES.a - shown * ACES.c, b = ACES.b - shown * ACES.d, c = -shown * ACES.e;
  return (-b + Math.sqrt(b * b - 4 * a * c)) / (2 * a);
}

// Displays: {shows: functions from radiance to 0..1, text}; `text` says what was chosen.
function* clippedDisplay() { return {shows: [clampUnit], text: ''}; }

const FLIP_BRIGHTEST_SHOWN = 0.85, FLIP_MOST_EXPOSURES = 64;

// Returns the value that is n-th in order; reorders `values`, in steps.
function* nthValue(values, n) {
  for (let lo = 0, hi = values.length - 1; lo < hi;) {
    const pivot = values[lo + hi >> 1];
    let i = lo - 1, j = hi + 1;
    for (;;) {
      do { ++i; } while (values[i] < pivot);
      do { --j; } while (values[j] > pivot);
      if (i >= j) break;
      const kept = values[i];
      values[i] = values[j];
      values[j] = kept;
    }
    if (n <= j) hi = j; else lo = j + 1;
    yield;
  }
  return values[n];
}

// Returns the median; of an even number of values, the upper middle one.
function* medianOf(values) {
  return yield* nthValue(Float64Array.from(values), Math.floor(values.length / 2));
}

// Returns displays of the exposures that the reference asks for, as chooseFlipExposures() of the
// program: from its brightest pixel to its median at 0.85 of the tone-mapped scale.
function* exposedDisplays({data}) {
  const all = new Float64Array(data.length / 3);
  for (let k = 0; k < all.length; ++k) {
    all[k] = luminance(data[3 * k], data[3 * k + 1], data[3 * k + 2]);
    if (!Number.isFinite(all[k])) return {shows: [], text: 'the reference is not finite'};
  }
  yield;
  const lit = all.filter(y => y > 0);
  yield;
  if (!lit.length) return {shows: [], text: 'the reference has no light'};
  const median = yield* medianOf(all), typical = median > 0 ? median : yield* medianOf(lit);
  const radiance = radianceShownAs(FLIP_BRIGHTEST_SHOWN);
  const start = Math.log2(radiance / lit.reduce((most, y) => Math.max(most, y)));
  const stop = Math.log2(radiance / typical), stops = Math.ceil(stop - start);
  if (stops > FLIP_MOST_EXPOSURES) {
    return {shows: [], text: `the reference spans ${stops} stops, more than ${
        FLIP_MOST_EXPOSURES}`};
  }
  const count = Math.max(2, stops);
  const shows = Array.from({length: count}, (_, i) => {
    const factor = Math.pow(2, start + i / (count - 1) * (stop - start));
    return radiance => acesTone(factor * radiance);
  });
  return {shows, text: `${count} exposures 2^${start.toFixed(2)} to 2^${stop.toFixed(2)}`};
}
