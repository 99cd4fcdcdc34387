// Colours of overlays, by the kind of their numbers:
//   number    a quantity: by a scale; for R, G, B the luminance
//   name      an ID: one colour each, as in the previews of `restlab render --aov`; 0 is black
//   vector    x, y, z as red, green, blue, 0 is the middle of each; vector2: only x and y
//   colour    as sRGB; radiance: times the exposure

const OVERLAY_TEXTS = {
  name: () => ': one colour a number',
  vector: (overlay, range) => `: x, y, z as red, green, blue from ${shortNumber(-range)} to ${
      shortNumber(range)}; grey is 0`,
  vector2: (overlay, range) => `: x and y as red and green from ${shortNumber(-range)} to ${
      shortNumber(range)}; grey is 0`,
  colour: () => ' as sRGB',
  radiance: (overlay, range, factor) => ` \u00d7 ${shortNumber(factor)} as sRGB`
};

// Hash: C. Wellons, "hash prospector", 2018; falseColors() of the program makes the same colours.
function nameColour(value) {
  if (value === 0) return colourWord(0, 0, 0);
  let x = floatBits(value);
  x = Math.imul(x ^ x >>> 16, 0x7feb352d);
  x = Math.imul(x ^ x >>> 15, 0x846ca68b);
  x ^= x >>> 16;
  // Keep the colour away from black.
  const channel = shift => Math.round(51 + 0.8 * (x >>> shift & 255));
  return colourWord(channel(0), channel(8), channel(16));
}

// Colours IDs by the first of R, G, B, which are equal.
function fillNames(data, out) {
  const known = new Map();
  for (let k = 0; k < out.length; ++k) {
    const value = data[3 * k];
    let word = known.get(value);
    if (word === undefined) {
      word = Number.isFinite(value) ? nameColour(value) : nonfiniteColour(data, k);
      known.set(value, word);
    }
    out[k] = word;
  }
}

function fillVectors(data, size, range, out) {
  const level = value => Math.round(255 * Math.min(1, Math.max(0, 0.5 + 0.5 * value / range)));
  for (let k = 0; k < out.length; ++k) {
    const [x, y, z] = [data[3 * k], data[3 * k + 1], size > 2 ? data[3 * k + 2] : 0];
    out[k] = Number.isFinite(x + y + z) ? colourWord(level(x), level(y), level(z))
                                        : nonfiniteColour(data, k);
  }
}

// Returns only the components that the vector has.
function vectorValues(data, size) {
  return size > 2 ? data : data.filter((_, i) => i % 3 < size);
}
