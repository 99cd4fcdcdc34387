// What a painter keeps: pictures and errors until an image changes, ranges for longer.

// Of anything with data; report images have none and never change.
function versionOf(source) { return source.version || 0; }

// The last value of each slot; made anew when its key has changed, and then given the old value,
// whose memory it may use. `made` counts.
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

// The range of a scale of images that change many times a second. A range holds while the size that
// it must show lies in (range / 5, range]. It is found anew
//   - when the subject changes, which is what is shown against what,
//   - when the size was outside at eight versions in a row,
//   - at once when it is more than ten times off either end: another picture, not noise.
// So colours do not flicker between frames, and images that do not change have the range of their
// numbers.
const RANGE_PATIENCE = 8, RANGE_JUMP = 10;

class SteadyRange {
  // `find` returns the size, or null where there is nothing yet; called once for each version.
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
    // All zero: any range shows that.
    const fits = size === 0 || size <= range && size > range / 5;
    this.misses = fits ? 0 : this.misses + 1;
    return this.misses >= RANGE_PATIENCE ||
        !fits && (size > RANGE_JUMP * range || size < range / 5 / RANGE_JUMP);
  }
}
