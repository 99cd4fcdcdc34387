// Small plot of curves on logarithmic axes.

const PLOT = {width: 360, height: 190, left: 52, right: 10, top: 8, bottom: 34};

// Returns the ends of an axis around values: 1, 2 or 5 times a power of ten.
function logEnds(values) {
  const lo = Math.min(...values), hi = Math.max(...values);
  const down = value => {
    const power = 10 ** Math.floor(Math.log10(value));
    return power * (value / power >= 5 ? 5 : value / power >= 2 ? 2 : 1);
  };
  const from = down(lo * 1.0001), to = niceAbove(hi);
  return to > from ? [from, to] : [from, from * 10];
}

// Returns the ticks of a logarithmic axis: powers of ten, with 2 and 5 times them if there are few.
function logTicks(lo, hi) {
  const decades = Math.log10(hi / lo), ticks = [];
  const step = Math.max(1, Math.ceil(decades / 5));
  for (let p = Math.floor(Math.log10(lo) - 1e-9); p <= Math.log10(hi) + 1e-9; ++p) {
    for (const digit of decades < 2.2 ? [1, 2, 5] : [1]) {
      const value = digit * 10 ** p;
      if (value >= lo * 0.999 && value <= hi * 1.001 && (digit > 1 || p % step === 0)) {
        ticks.push(Number(value.toPrecision(3)));
      }
    }
  }
  return ticks;
}

class LogPlot {
  // `x`: name of the point's field for the abscissa.
  constructor(title, x, xTitle, yTitle) {
    Object.assign(this, {x, xTitle, yTitle});
    this.picture = svg('svg', {viewBox: `0 0 ${PLOT.width} ${PLOT.height}`, role: 'img',
                               'aria-label': title, class: 'plot'});
    this.element = make('figure', {}, this.picture);
  }

  // `curves` and `before` (the previous epoch, drawn as shadows): a list of points for each pane.
  show(curves, before) {
    const all = [...curves, ...before].flat();
    if (!all.length) {
      this.picture.replaceChildren(svg('text', {x: PLOT.width / 2, y: PLOT.height / 2,
                                                class: 'tick', 'text-anchor': 'middle'},
                                       'no error yet: the reference is on its way'));
      return;
    }
    const {left, right, top, bottom, width, height} = PLOT;
    const [x0, x1] = logEnds(all.map(point => Math.max(1e-4, point[this.x])));
    // An MSE estimate against a noisy reference may be 0 or negative, which has no logarithm: it is
    // drawn on the axis, with a mark.
    const above = all.map(point => point.mse).filter(mse => mse > 0);
    const [y0, y1] = above.length ? logEnds(above) : [1e-6, 1e-5];
    const spanX = width - left - right, spanY = height - top - bottom;
    const atX = v => left + Math.log(Math.max(v, x0) / x0) / Math.log(x1 / x0) * spanX;
    const atY = v => top + (1 - Math.log(Math.max(v, y0) / y0) / Math.log(y1 / y0)) * spanY;
    const parts = [];
    for (const value of logTicks(x0, x1)) {
      parts.push(svg('line', {x1: atX(value), x2: atX(value), y1: top, y2: height - bottom,
                              class: 'grid'}),
                 svg('text', {x: atX(value), y: height - bottom + 14, class: 'tick',
                              'text-anchor': 'middle'}, shortNumber(value)));
    }
    for (const value of logTicks(y0, y1)) {
      parts.push(svg('line', {x1: left, x2: width - right, y1: atY(value), y2: atY(value),
                              class: 'grid'}),
                 svg('text', {x: left - 4, y: atY(value) + 3.5, class: 'tick',
                              'text-anchor': 'end'}, shortNumber(value)));
    }
    parts.push(svg('text', {x: left + spanX / 2, y: height - 4, class: 'axis',
                            'text-anchor': 'middle'}, this.xTitle),
               svg('text', {x: 10, y: top + spanY / 2, class: 'axis', 'text-anchor': 'middle',
                            transform: `rotate(-90 10 ${top + spanY / 2})`}, this.yTitle));
    const path = points => points.map((p, i) => `${i ? 'L' : 'M'}${atX(p[this.x]).toFixed(1)} ${
        atY(p.mse).toFixed(1)}`).join('');
    before.forEach((points, i) => {
      if (points.length) parts.push(svg('path', {d: path(points), class: `curve k${i} shadow`}));
    });
    if (above.length < all.length) {
      parts.push(svg('text', {x: width - right, y: top + 8, class: 'tick', 'text-anchor': 'end'},
                     '\u25bd on the axis: not above 0'));
    }
    curves.forEach((points, i) => {
      if (!points.length) return;
      for (const point of points) {
        if (point.mse > 0) continue;
        const x = atX(point[this.x]), y = height - bottom;
        parts.push(svg('path', {d: `M${x} ${y}l-3 -5h6z`, class: `below k${i}`}));
      }
      const last = points[points.length - 1];
      parts.push(svg('path', {d: path(points), class: `curve k${i}`}),
                 svg('circle', {cx: atX(last[this.x]), cy: atY(last.mse), r: 2.6, class: `f${i}`}),
                 svg('text', {x: Math.min(width - 16, atX(last[this.x]) + 5), y: atY(last.mse) - 4,
                              class: `tick f${i}`}, PANE_NAMES[i]));
    });
    this.picture.replaceChildren(...parts);
  }
}
