// Formats numbers.

function nonfiniteText(value) {
  return Number.isNaN(value) ? 'NaN' : value > 0 ? '+Inf' : '-Inf';
}

// Returns the shortest decimal that reads back as this 32-bit float.
function exactFloat(value) {
  if (!Number.isFinite(value)) return nonfiniteText(value);
  if (Object.is(value, -0)) return '-0';
  for (let digits = 1; digits < 9; ++digits) {
    const rounded = Number(value.toPrecision(digits));
    if (Math.fround(rounded) === value) return String(rounded);
  }
  return String(Number(value.toPrecision(9)));
}

// Formats with three significant digits.
function shortNumber(value) {
  if (!Number.isFinite(value)) return nonfiniteText(value);
  return String(Number(value.toPrecision(3))).replace('e+', 'e');
}

// Most digits of an aligned number, and of a fixed one after the point.
const MOST_DIGITS = 6, MOST_PLACES = MOST_DIGITS - 1;

// Returns a function that formats numbers which stand together, with the same digits after the
// point, so that they align: enough for `digits` significant ones of the smallest of `values`, but
// six of the largest at most. All have an exponent if the smallest would show less than two.
function alignedFormat(values, digits = 3) {
  const sizes = values.filter(value => Number.isFinite(value) && value !== 0).map(Math.abs);
  const tens = sizes.map(size => Math.floor(Math.log10(size)));
  const least = Math.min(0, ...tens), most = Math.max(...tens);
  const places = Math.max(0, Math.min(digits - 1 - Math.min(...tens, digits - 1),
                                      MOST_PLACES - Math.max(0, most)));
  const hasExponent = sizes.length > 0 &&
      (most >= MOST_PLACES || most < -3 || least + places + 1 < 2 && least < 0);
  return value => {
    if (!Number.isFinite(value)) return nonfiniteText(value);
    return hasExponent ? value.toExponential(digits - 1).replace('e+', 'e')
                       : value.toFixed(places);
  };
}

// Formats numbers that stand below or beside each other; null as `nothing`.
function alignedTexts(values, digits, nothing = '') {
  const known = values.filter(value => value !== null);
  const format = alignedFormat(known, digits);
  return values.map(value => value === null ? nothing : format(value));
}

// Returns the smallest 1, 2 or 5 times a power of ten that is not below `value`.
function niceAbove(value) {
  if (!(value > 0) || !Number.isFinite(value)) return 1;
  const power = Math.pow(10, Math.floor(Math.log10(value)));
  for (const digit of [1, 2, 5, 10]) {
    if (digit * power >= value * 0.999) return Number((digit * power).toPrecision(3));
  }
  return 10 * power;
}
