// Colour maps of errors and false colour, and the scales that map values to them.

// Packs R, G, B into a canvas pixel, whose bytes are R, G, B, A: one 32-bit word, assuming the
// little-endian order of every browser.
function colourWord(r, g, b) { return (0xff000000 | b << 16 | g << 8 | r) >>> 0; }

// Makes a map of 256 colours, linear in sRGB between equally spaced anchors; `words`: the colours
// as canvas pixels.
function colourMap(anchors) {
  const rgb = anchors.map(hex => [1, 3, 5].map(at => parseInt(hex.slice(at, at + 2), 16)));
  const table = new Uint8Array(3 * 256);
  for (let i = 0; i < 256; ++i) {
    const at = i / 255 * (rgb.length - 1);
    const k = Math.min(Math.floor(at), rgb.length - 2);
    for (let c = 0; c < 3; ++c) {
      table[3 * i + c] = Math.round(rgb[k][c] + (at - k) * (rgb[k + 1][c] - rgb[k][c]));
    }
  }
  table.words = Uint32Array.from(
      {length: 256}, (_, i) => colourWord(...table.subarray(3 * i, 3 * i + 3)));
  return table;
}

const MAPS = {
  // Lightness rises monotonically: larger is lighter.
  rising: colourMap(
      ['#07070c', '#1c1850', '#4b1d7c', '#8a2679', '#c63a60', '#ec6b3a', '#fbb13f', '#fdf7b8']),
  // Blue below 0, white at 0, orange above.
  diverging: colourMap(['#08306b', '#2f78b7', '#a3c9e2', '#f6f6f6', '#f2b67c', '#d0651c', '#7f2704']),
  spectrum: colourMap(['#17124f', '#2350c4', '#1fa7d1', '#36b56a', '#c9cf3a', '#f0912a', '#cf2a20',
                       '#f7d9d4'])
};

// NaN and infinities have colours that no map has.
const NAN_COLOUR = [255, 0, 255], INF_COLOUR = [0, 255, 0];
const NAN_WORD = colourWord(...NAN_COLOUR), INF_WORD = colourWord(...INF_COLOUR);

function cssOf(table, index) {
  return `rgb(${table[3 * index]},${table[3 * index + 1]},${table[3 * index + 2]})`;
}

function cssGradient(table) {
  const stops = [];
  for (let i = 0; i < 256; i += 15) stops.push(cssOf(table, i));
  return `linear-gradient(to right, ${stops.join(', ')})`;
}

// Maps values to 0 at lo .. 1 at hi, logarithmically or linearly.
function makeScale(lo, hi, log, map) {
  const logLo = Math.log2(lo), logSpan = Math.log2(hi / lo), span = hi - lo;
  return {
    lo, hi, log, map,
    position: value => log ? (value > 0 ? (Math.log2(value) - logLo) / logSpan : -1)
                           : (value - lo) / span,
    // NaN has no index: callers handle it before.
    index(value) {
      const at = this.position(value) * 255;
      return at <= 0 ? 0 : at >= 255 ? 255 : Math.round(at);
    }
  };
}

function luminance(r, g, b) { return 0.2126 * r + 0.7152 * g + 0.0722 * b; }
