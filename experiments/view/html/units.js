// Quantities with prefixes and units, for people.

const NOTHING = '\u2013';

function quantity(value, digits = 3) {
  if (value === null || value === undefined) return NOTHING;
  if (typeof value !== 'number' || !Number.isFinite(value)) return String(value);
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e5)) {
    return value.toExponential(digits - 1).replace('e+', 'e');
  }
  return String(Number(value.toPrecision(digits)));
}

function withPrefix(value, unit, base = 1000) {
  if (value === null || value === undefined) return NOTHING;
  const prefixes = base === 1024 ? ['', 'Ki', 'Mi', 'Gi', 'Ti'] : ['', 'k', 'M', 'G', 'T'];
  let at = 0, scaled = value;
  while (scaled >= base && at < prefixes.length - 1) {
    scaled /= base;
    ++at;
  }
  return `${Number(scaled.toPrecision(3))} ${prefixes[at]}${unit}`;
}

const bytesText = value => withPrefix(value, 'B', 1024);
// Writes a time given in milliseconds; seconds from one second on.
const milliseconds = value => typeof value !== 'number' ? NOTHING
    : value < 1000 ? `${quantity(value)} ms` : `${quantity(value / 1000)} s`;
