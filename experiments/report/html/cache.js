// Caches of a painter: pictures and errors until an image changes, ranges for longer.

// Version of anything with data; the images of a report have none and never change.
function versionOf(source) { return source.version || 0; }

// Keeps the last value of each slot. A changed key makes a new value; `make` gets the old one to
// reuse its memory. `made` counts new values.
class SlotCache {
  constructor() {
    this.slots = new Map();
    this.made = 0;
  }

  get(slot, key, make) {
    const held = this.slots.get(slot);
    if (held && held.key === key) return held.value;
    const value = make(held && held.value);
    this.slots.set(slot, {key, value});
    ++this.made;
    return value;
  }

  clear() { this.slots.clear(); }
}

// Range of a scale for images that change many times a second. A range is kept while the size to
// show lies in (range / 5, range]. A new one is chosen
//   - if the subject changes: what is shown and what it is compared with,
//   - if the size was outside for eight versions in a row,
//   - at once if it is more than ten times off either end: another picture, not noise.
// Colours then do not flicker between frames, and images that do not change have the range of their
// numbers.
const RANGE_PATIENCE = 8, RANGE_JUMP = 10;

class SteadyRange {
  // `find` returns the size, or null if there is nothing yet; called once for each version.
  get(subject, version, find) {
    if (this.subject === subject && this.version === version) return this.range;
    const size = find();
    const isNew = this.subject !== subject || !this.range;
    if (size === null) return isNew ? 1 : this.range;
    Object.assign(this, {subject, version});
    if (isNew || this.isOutgrown(size)) {
      this.range = niceAbove(size);
      this.misses = 0;
    }
    return this.range;
  }

  isOutgrown(size) {
    const {range} = this;
    // All values are 0: any range shows that.
    const fits = size === 0 || size <= range && size > range / 5;
    this.misses = fits ? 0 : this.misses + 1;
    return this.misses >= RANGE_PATIENCE ||
        !fits && (size > RANGE_JUMP * range || size < range / 5 / RANGE_JUMP);
  }
}
