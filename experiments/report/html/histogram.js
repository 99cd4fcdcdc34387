// Histogram of the current image, or of its errors, with the compared image's beside it. Nothing is
// counted while it is hidden.

const HISTOGRAM_BINS = 128;
// Limit of counted pixels of an image; of a larger one every second, third, ... pixel counts.
const HISTOGRAM_PIXELS = 1 << 19;

// Returns {shown, scale}: the scale of what the display does not clip, and the axis, with some room
// beyond its ends.
function histogramAxis(state, painter, isError) {
  const shown = isError ? painter.errorScale()
      : state.tone === 'false' ? painter.luminanceScale()
      : makeScale(SRGB_LEVELS[1] / painter.factor, 1 / painter.factor, true, null);
  const {log, lo, hi} = shown, room = log ? 8 : 0.125 * (hi - lo);
  const scale = log ? makeScale(lo / room, hi * room, true, null)
                    : makeScale(lo < 0 ? lo - room : lo, hi + room, false, null);
  return {shown, scale};
}

// Counts `n` values. Returns shares of those that are finite: {bins, below, above} the axis,
// {black, white} beyond the ends of the display; and `step`: every how many pixels counted.
function histogramOf(n, valueOf, {shown, scale}) {
  const step = Math.ceil(n / HISTOGRAM_PIXELS), bins = new Float64Array(HISTOGRAM_BINS);
  const found = {bins, below: 0, above: 0, black: 0, white: 0, step};
  let all = 0;
  for (let k = 0; k < n; k += step) {
    const value = valueOf(k);
    if (!Number.isFinite(value)) continue;
    ++all;
    if (value < shown.lo) ++found.black;
    if (value > shown.hi) ++found.white;
    const at = Math.floor(scale.position(value) * HISTOGRAM_BINS);
    if (at < 0) ++found.below;
    else if (at >= HISTOGRAM_BINS) ++found.above;
    else ++bins[at];
  }
  if (!all) return found;
  for (let i = 0; i < HISTOGRAM_BINS; ++i) bins[i] /= all;
  for (const key of ['below', 'above', 'black', 'white']) found[key] /= all;
  return found;
}

// Returns the outline of bins as steps in a box, the largest of all bins `most` as high as it.
function histogramOutline(bins, most, width, height) {
  let path = `M0 ${height}`;
  bins.forEach((share, i) => {
    const y = (height * (1 - share / most)).toFixed(2);
    path += `V${y}H${((i + 1) * width / bins.length).toFixed(2)}`;
  });
  return `${path}V${height}`;
}

class Histogram {
  constructor(viewer) {
    this.viewer = viewer;
    this.due = new AtMost(TOOL_INTERVAL_MS, () => this.update());
    this.element = make('figure', {class: 'histogram', hidden: ''});
  }

  // Counts again if something has changed, at most every TOOL_INTERVAL_MS.
  update() {
    const {state, images, painter} = this.viewer;
    this.element.hidden = !state.histogram;
    if (!state.histogram) {
      this.key = null;
      return;
    }
    const {current, compare, error} = state;
    const isError = error !== 'none' && current !== compare &&
        areComparable(images[current], images[compare]);
    const axis = histogramAxis(state, painter, isError);
    const shown = (isError ? [current] : [...new Set([current, compare])])
                      .filter(i => images[i].data);
    const key = [isError && error, state.channel, axis.shown.lo, axis.shown.hi, axis.shown.log,
                 ...shown.map(i => [i, versionOf(images[i]), images[i].epoch, images[i].name]),
                 isError && versionOf(images[compare])].join('|');
    if (key === this.key || !this.due.isDue()) return;
    const plane = isError ? painter.plane(error, current) : null;
    if (isError && !plane) return;
    this.key = key;
    this.show(shown, plane, axis);
  }

  // `plane`: errors of the current image, or null.
  show(shown, plane, axis) {
    const {state, images} = this.viewer;
    const of = CHANNELS[state.channel].of || luminance;
    this.shown = shown.map(i => {
      const {data, width, height} = images[i];
      return {image: i, ...histogramOf(width * height, plane ? k => plane.values[k]
          : k => of(data[3 * k], data[3 * k + 1], data[3 * k + 2]), axis)};
    });
    this.axis = axis;
    const what = plane ? ERRORS[state.error].title
        : state.channel === 'rgb' ? 'luminance' : CHANNELS[state.channel].title;
    const percent = share => `${Number((100 * share).toPrecision(3))} %`;
    const every = this.shown.length && this.shown[0].step > 1
        ? ` (one pixel in ${this.shown[0].step})` : '';
    const texts = this.shown.flatMap(one => [' ', make(
        'span', {class: 'key'},
        make('span', {class: `swatch h${one.image === state.current ? 0 : 1}`}),
        `${images[one.image].name}: ${percent(one.black)} below, ${percent(one.white)} above`)]);
    this.element.replaceChildren(
        make('figcaption', {class: 'legend-title'}, make('b', {}, what),
             `: share of pixels${every}; the display shows ${shortNumber(axis.shown.lo)} to ${
                 shortNumber(axis.shown.hi)}.`, ...texts),
        this.drawing(axis));
  }

  drawing({shown, scale}) {
    const width = 512, height = 80, most = Math.max(1e-9, ...this.shown.map(
        one => Math.max(...one.bins)));
    const curves = this.shown.map(one => svg('path', {
      d: histogramOutline(one.bins, most, width, height),
      class: one.image === this.viewer.state.current ? 'h0' : 'h1'
    }));
    const marks = [shown.lo, shown.hi].map(end => {
      const x = (scale.position(end) * width).toFixed(2);
      return svg('path', {class: 'end', d: `M${x} 0V${height}`});
    });
    const numbers = make('div', {class: 'numbers'});
    let last = Infinity;
    for (const [, value] of legendTicks(shown).reverse()) {
      if (last - scale.position(value) < 0.13) continue;  // there is no room for its number
      last = scale.position(value);
      const tick = make('span', {}, shortNumber(value));
      tick.style.left = `${100 * last}%`;
      numbers.append(tick);
    }
    return make('div', {class: 'scale'},
                svg('svg', {viewBox: `0 0 ${width} ${height}`, preserveAspectRatio: 'none',
                            'aria-hidden': 'true'}, ...curves, ...marks),
                numbers);
  }
}
