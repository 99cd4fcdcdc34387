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

// Returns the smallest 1, 2 or 5 times a power of ten that is not below `value`.
function niceAbove(value) {
  if (!(value > 0) || !Number.isFinite(value)) return 1;
  const power = Math.pow(10, Math.floor(Math.log10(value)));
  for (const digit of [1, 2, 5, 10]) {
    if (digit * power >= value * 0.999) return Number((digit * power).toPrecision(3));
  }
  return 10 * power;
}
