// Converts floats to pixels by tables. The upper bits of a float select the colour of all floats
// that share them. If a table cannot decide, the exact rule is evaluated: the bytes are always
// those of the exact rule.

const ONE_FLOAT = new Float32Array(1), ONE_WORD = new Int32Array(ONE_FLOAT.buffer);
const INF_BITS = 0x7f800000;

// Returns the bits of the nearest float.
function floatBits(value) {
  ONE_FLOAT[0] = value;
  return ONE_WORD[0];
}

// Reinterprets floats as integers; for positive floats both have the same order.
function bitsOf(data) { return new Int32Array(data.buffer, data.byteOffset, data.length); }

// Threshold of linear radiance times exposure from which sRGB rounds to level i of 255 (IEC
// 61966-2-1).
const SRGB_LEVELS = (() => {
  const levels = new Float64Array(257);
  for (let i = 1; i < 256; ++i) {
    const encoded = (i - 0.5) / 255;
    levels[i] = encoded <= 0.04045 ? encoded / 12.92 : Math.pow((encoded + 0.055) / 1.055, 2.4);
  }
  levels[256] = Infinity;
  return levels;
})();

// Encodes radiance times `factor` as sRGB levels. `table`: indexed by the upper 16 bits, the level
// of the smallest float that has them. `last[level]`: the bits of the largest float of a level. The
// level rises at most once within a table entry: levels are further apart than 2^-7 of their value.
class SrgbEncoder {
  constructor(factor) {
    this.last = new Int32Array(256).fill(0x7fffffff);
    for (let level = 0; level < 255; ++level) {
      const next = SRGB_LEVELS[level + 1] / factor;
      const bits = floatBits(next);
      // Bits of the largest float below `next`.
      this.last[level] = ONE_FLOAT[0] < next ? bits : bits - 1;
    }
    // Subnormal floats are too coarse for that; happens at a factor of 1e34 or more.
    this.isCoarse = this.last[0] < 0x00800000;
    this.table = new Uint8Array(32768);
    let level = 0;
    for (let i = 0; i < INF_BITS >>> 16; ++i) {
      while (i << 16 > this.last[level]) ++level;
      this.table[i] = level;
    }
    // Infinities and NaN are marked separately.
    this.table.fill(255, INF_BITS >>> 16);
  }

  // Exact rule: the level of a float.
  level(bits) {
    if (bits < 0) return 0;
    let level = this.table[bits >>> 16];
    while (bits > this.last[level]) ++level;
    return level;
  }

  // Returns the pixel of R, G, B starting at index `at`.
  colour(bits, at) {
    return colourWord(this.level(bits[at]), this.level(bits[at + 1]), this.level(bits[at + 2]));
  }

  fill(data, out) {
    const {table, last} = this, bits = bitsOf(data), n = out.length;
    if (this.isCoarse) {
      for (let k = 0; k < n; ++k) out[k] = this.colour(bits, 3 * k);
      return;
    }
    for (let i = 0, k = 0; k < n; i += 3, ++k) {
      // Branch-free, since noise makes branches unpredictable: negative values become 0; add 1 to
      // the level above `last`.
      const red = bits[i] & ~(bits[i] >> 31);
      const green = bits[i + 1] & ~(bits[i + 1] >> 31);
      const blue = bits[i + 2] & ~(bits[i + 2] >> 31);
      const r = table[red >>> 16], g = table[green >>> 16], b = table[blue >>> 16];
      out[k] = 0xff000000 | b + (last[b] - blue >>> 31) << 16 | g + (last[g] - green >>> 31) << 8 |
          r + (last[r] - red >>> 31);
    }
  }
}

// Exact rule: the pixel of a value on a scale.
function scaledColour(value, scale) {
  if (Number.isNaN(value)) return NAN_WORD;
  return Number.isFinite(value) ? scale.map.words[scale.index(value)] : INF_WORD;
}

// Returns a table indexed by the upper 17 bits of a float: the pixel of all floats that have them,
// or 0 if the exact rule is needed: near the 255 values where the index changes, and for non-finite
// values.
function logColours(scale) {
  const table = new Uint32Array(131072), {words} = scale.map;
  const octaves = Math.log2(scale.hi / scale.lo);
  let done = 0;
  for (let i = 0; i < 255; ++i) {
    const change = scale.lo * Math.pow(2, (i + 0.5) / 255 * octaves);
    const from = Math.max(0, floatBits(change * (1 - 1e-6)) - 1) >>> 15;
    const to = Math.min(INF_BITS, floatBits(change * (1 + 1e-6)) + 1) >>> 15;
    if (from > done) table.fill(words[i], done, from);
    done = Math.max(done, to + 1);
  }
  table.fill(words[255], Math.min(done, INF_BITS >>> 15), INF_BITS >>> 15);
  table.fill(words[0], 65536, 65536 + (INF_BITS >>> 15));
  return table;
}

// Writes the pixel of each value.
function fillScaled(values, scale, out) {
  const n = out.length;
  if (scale.log) {
    const table = logColours(scale), bits = bitsOf(values);
    for (let k = 0; k < n; ++k) out[k] = table[bits[k] >>> 15] || scaledColour(values[k], scale);
    return;
  }
  const {lo} = scale, {words} = scale.map, span = scale.hi - lo;
  for (let k = 0; k < n; ++k) {
    const at = (values[k] - lo) / span * 255;
    // Both comparisons are false for NaN.
    out[k] = at > 0 && at < 255 ? words[Math.round(at)] : scaledColour(values[k], scale);
  }
}

// Writes the pixel of each luminance of R, G, B, by a logarithmic scale.
function fillLuminance(data, scale, out) {
  const table = logColours(scale), n = out.length;
  for (let i = 0, k = 0; k < n; i += 3, ++k) {
    const value = luminance(data[i], data[i + 1], data[i + 2]);
    ONE_FLOAT[0] = value;
    out[k] = table[ONE_WORD[0] >>> 15] || scaledColour(value, scale);
  }
}
