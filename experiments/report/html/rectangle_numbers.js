// Numbers of a rectangle of an image, and their 95 % intervals.

// Kinds of numbers, in the order of columns.
const RECTANGLE_NUMBERS = {
  mean: {title: 'luminance', help: 'mean of 0.2126 R + 0.7152 G + 0.0722 B'},
  mse: {title: 'MSE', help: 'mean squared error; noise of what is compared with is in it'},
  relmse: {title: 'relMSE', help: 'mean of d\u00b2 / (r\u00b2 + 0.01): the metric relmse_e1e-2'},
  energy: {title: 'energy', help: 'mean over that of what is compared with; 1 is right'}
};
const NUMBER_KINDS = Object.keys(RECTANGLE_NUMBERS);

// 97.5 % point of Student's t; at least 7 degrees of freedom, error below 0.001 (Abramowitz and
// Stegun, 26.7.5).
function studentPoint(freedom) {
  const z = 1.959964, n = freedom;
  return z + (z ** 3 + z) / (4 * n) + (5 * z ** 5 + 16 * z ** 3 + 3 * z) / (96 * n ** 2) +
      (3 * z ** 7 + 19 * z ** 5 + 17 * z ** 3 - 15 * z) / (384 * n ** 3);
}

// Returns sum(above) / sum(below) of blocks, {value, lo, hi}; the ends are NaN below 8 blocks.
function ratioOfBlocks(above, below) {
  const sum = list => list.reduce((all, one) => all + one, 0), n = above.length;
  const whole = sum(below), value = sum(above) / whole;
  if (n < 8) return {value, lo: NaN, hi: NaN};
  const squares = sum(above.map((one, i) => (one - value * below[i]) ** 2));
  const half = studentPoint(n - 1) * Math.sqrt(n / (n - 1) * squares) / Math.abs(whole);
  return {value, lo: value - half, hi: value + half};
}

// Side of square blocks in pixels: the largest of 8, 4, 2, 1 that gives 16 of them.
function blockSideOf(width, height) {
  const count = side => Math.ceil(width / side) * Math.ceil(height / side);
  return [8, 4, 2].find(side => count(side) >= 16) || 1;
}

// Returns for each block of the rectangle the sums of each kind, {above, below}. `reference`: the
// compared image, or null.
function blockSums(image, reference, [x0, y0, x1, y1]) {
  const side = blockSideOf(x1 - x0, y1 - y0), columns = Math.ceil((x1 - x0) / side);
  const count = columns * Math.ceil((y1 - y0) / side);
  const sums = Object.fromEntries(NUMBER_KINDS.map(kind => [
    kind, {above: new Float64Array(count), below: new Float64Array(count)}]));
  const {mean, mse, relmse, energy} = sums, {data, width} = image;
  for (let y = y0; y < y1; ++y) {
    for (let x = x0; x < x1; ++x) {
      const block = Math.floor((y - y0) / side) * columns + Math.floor((x - x0) / side);
      const at = 3 * (y * width + x);
      mean.above[block] += luminance(data[at], data[at + 1], data[at + 2]);
      ++mean.below[block];
      for (let i = at; reference && i < at + 3; ++i) {
        const a = data[i], r = reference.data[i], squared = (a - r) * (a - r);
        mse.above[block] += squared;
        relmse.above[block] += squared / (r * r + 1e-2);
        ++mse.below[block];
        ++relmse.below[block];
        energy.above[block] += a;
        energy.below[block] += r;
      }
    }
  }
  return {side, count, sums};
}

// Numbers of one image, over the frames in which it is shown with one rectangle.
const FRAME_BATCHES = 8, LEAST_FRAMES = 64;
// Most entries that hold frames: beyond, each holds twice as many.
const MOST_ENTRIES = 1024;

class RectangleSeries {
  constructor() { this.key = null; }

  // Adds the image as it is. `key` names all that must not change within a series. `frame`: of the
  // image, undefined for one that has none; the same frame replaces itself.
  add(key, image, reference, rectangle, frame) {
    if (this.key !== key) {
      Object.assign(this, {key, entries: [], perEntry: 1, newest: null, frame: undefined});
    }
    const {side, count, sums} = blockSums(image, reference, rectangle);
    const numbers = NUMBER_KINDS.map(kind => ratioOfBlocks(sums[kind].above, sums[kind].below));
    this.blocks = {side, count, numbers};
    this.hasReference = reference !== null;
    if (this.newest && frame !== undefined && frame !== this.frame) this.keep(this.newest);
    this.frame = frame;
    this.newest = numbers.map(({value}) => value);
  }

  // Adds a frame to the entries: means over `perEntry` frames each, the last one of fewer.
  keep(values) {
    const last = this.entries[this.entries.length - 1];
    if (last && last.n < this.perEntry) {
      ++last.n;
      last.values = last.values.map((value, k) => value + (values[k] - value) / last.n);
      return;
    }
    this.entries.push({n: 1, values});
    if (this.entries.length < MOST_ENTRIES) return;
    const {entries} = this;
    this.perEntry *= 2;
    this.entries = entries.filter((_, i) => i % 2 === 0).map((one, i) => {
      const other = entries[2 * i + 1], n = one.n + other.n;
      return {n, values: one.values.map((value, k) => (one.n * value + other.n * other.values[k]) / n)};
    });
  }

  // Returns {text, numbers: {kind: {value, lo, hi}}}: of the frames if there are several, else of
  // the image's blocks.
  result() {
    const n = this.count, named = numbers => Object.fromEntries(
        NUMBER_KINDS.map((kind, k) => [kind, numbers[k]]));
    if (n < 2) {
      const {side, count, numbers} = this.blocks;
      return {text: `one image: spread over ${count} blocks of ${side}\u00d7${side} pixels`,
              numbers: named(numbers)};
    }
    const text = n < LEAST_FRAMES ? `${n} frames; an interval from ${LEAST_FRAMES} on`
                                  : `${n} frames: ${FRAME_BATCHES} batches of them`;
    return {text, numbers: named(NUMBER_KINDS.map((_, k) => this.overFrames(k)))};
  }

  get count() { return this.entries.reduce((all, {n}) => all + n, 1); }

  overFrames(k) {
    const all = [...this.entries, {n: 1, values: this.newest}];
    const mean = list => list.reduce((sum, {n, values}) => sum + n * values[k], 0) /
        list.reduce((sum, {n}) => sum + n, 0);
    const value = mean(all);
    if (this.count < LEAST_FRAMES) return {value, lo: NaN, hi: NaN};
    const batches = Array.from({length: FRAME_BATCHES}, (_, b) => mean(all.slice(
        Math.floor(b * all.length / FRAME_BATCHES),
        Math.floor((b + 1) * all.length / FRAME_BATCHES))));
    const {lo, hi, value: middle} = ratioOfBlocks(batches, batches.map(() => 1));
    return {value, lo: value + lo - middle, hi: value + hi - middle};
  }
}
