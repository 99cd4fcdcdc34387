// Error maps that take seconds (SSIM, FLIP). They are computed of images at rest, in slices between
// which the page goes on: its policy allows no worker.

// Time without a new version after which an image is at rest, and length of a slice; milliseconds.
const REST_MS = 500, SLICE_MS = 10;
// A reference that goes on converging is taken again after four times as long as the last maps
// took, and no sooner than this.
const LEAST_PAUSE_MS = 2000, PAUSE_FACTOR = 4;
const PROGRESS_MS = 250;

class RestMaps {
  constructor(images) {
    // `held`: the last map of each kind and image. `seen`: for each image its version and since
    // when it has that. `round`: the maps that are computed now, against a copy of one reference.
    Object.assign(this, {images, held: new Map(), seen: new Map(), round: null, made: 0,
                         ended: -Infinity, took: 0});
    // Called when there is something new to draw.
    this.onNews = () => {};
  }

  // Returns the last map of image i against image `compare`: {values, mean, text, serial}, or null.
  // That of another picture or method (epoch) is none.
  map(kind, i, compare) {
    const map = this.held.get(`${kind} ${i}`), image = this.images[i];
    const isOfThese = map && map.compare === compare && map.epoch === image.epoch &&
        map.values.length === image.width * image.height &&
        areComparable(image, this.images[compare]);
    return isOfThese ? map : null;
  }

  // Says what state the map of image i is in; '' if it is of what is shown.
  note(kind, i, compare) {
    const map = this.map(kind, i, compare), {round} = this;
    const isOld = map && map.version !== versionOf(this.images[i]);
    if (map && this.isCurrent(map)) return '';
    const parts = map ? [isOld ? 'of the last rest' : 'of an earlier reference'] : [];
    if (round && round.kind === kind && round.at === i) {
      parts.push(`computing ${Math.round(100 * round.share)} %`);
    } else if (round && round.kind === kind && round.queue.includes(i)) {
      parts.push('computing');
    } else if (!map) {
      parts.push('once the picture rests');
    }
    return parts.join(', ');
  }

  isCurrent(map) {
    return map.version === versionOf(this.images[map.image]) &&
        map.reference === versionOf(this.images[map.compare]);
  }

  // Asks for the maps of a kind, those of the images `first` before others; null: for none. Called
  // with each drawing.
  want(kind, compare, first) {
    const {round} = this, now = performance.now();
    if (round && (round.kind !== kind || round.compare !== compare)) this.stop();
    if (kind === null || this.round) return;
    this.images.forEach((image, i) => this.look(image, i, now));
    const order = [...new Set([...first, ...this.images.keys()])];
    const due = order.map(i => [i, this.dueTime(kind, i, compare)]);
    const queue = due.filter(([, time]) => time <= now).map(([i]) => i);
    if (queue.length) {
      this.begin(kind, compare, queue, now);
      return;
    }
    const next = Math.min(...due.map(([, time]) => time));
    clearTimeout(this.timer);
    if (next < Infinity) this.timer = setTimeout(() => this.onNews(), next - now + 1);
  }

  look(image, i, now) {
    const seen = this.seen.get(i), version = versionOf(image);
    if (!seen || seen.version !== version) this.seen.set(i, {version, since: now});
  }

  // Returns when the next map of image i may begin; Infinity if none is needed.
  dueTime(kind, i, compare) {
    if (i === compare || !areComparable(this.images[i], this.images[compare])) return Infinity;
    const map = this.map(kind, i, compare), rest = this.seen.get(i).since + REST_MS;
    if (!map || map.version !== versionOf(this.images[i])) return rest;
    if (this.isCurrent(map)) return Infinity;
    const pause = this.ended + Math.max(LEAST_PAUSE_MS, PAUSE_FACTOR * this.took);
    return Math.max(rest, Math.min(this.seen.get(compare).since + REST_MS, pause));
  }

  begin(kind, compare, queue, now) {
    const other = this.images[compare];
    const reference = {...other, data: other.data.slice()};  // it may change meanwhile
    const round = {kind, compare, queue, reference, began: now, told: now, at: -1, share: 0};
    this.round = round;
    const work = () => {
      if (this.round !== round) return;
      if (this.work(round)) setTimeout(work, 0); else this.end(round);
    };
    setTimeout(work, 0);
  }

  stop() {
    this.round = null;
    this.onNews();
  }

  end(round) {
    this.ended = performance.now();
    this.took = this.ended - round.began;
    this.stop();
  }

  // Computes for one slice. Returns false if nothing is left to do.
  work(round) {
    for (const end = performance.now() + SLICE_MS; performance.now() < end;) {
      const image = this.images[round.at];
      const isGiven = round.steps && versionOf(image) === round.version &&
          this.isAgainst(image, round);
      if (!isGiven && !this.beginNext(round)) return false;
      const {value, done} = round.steps.next();
      if (done) {
        this.keep(round, value);
      } else if (value !== undefined) {
        round.share = value;
      }
    }
    const now = performance.now();
    if (now - round.told > PROGRESS_MS) {
      round.told = now;
      this.onNews();
    }
    return true;
  }

  // The reference of a round is a copy: the picture may have changed since.
  isAgainst(image, {compare, reference}) {
    return areComparable(image, reference) &&
        this.images[compare].pictureEpoch === reference.pictureEpoch;
  }

  // Takes the next image of the queue that can be compared; returns false if there is none.
  beginNext(round) {
    const {queue, reference} = round;
    round.steps = null;
    round.at = -1;
    while (queue.length && !round.steps) {
      const i = queue.shift(), image = this.images[i];
      if (!this.isAgainst(image, round)) continue;
      const steps = ERRORS[round.kind].steps(image, reference);
      const version = versionOf(image), {epoch} = image;
      Object.assign(round, {at: i, version, epoch, share: 0, steps});
    }
    return round.steps !== null;
  }

  keep(round, {values, mean, text}) {
    const {kind, at, compare, version, epoch, reference} = round;
    this.held.set(`${kind} ${at}`, {values, mean, text, image: at, compare, version, epoch,
                                    reference: versionOf(reference), serial: ++this.made});
    round.steps = null;
    round.at = -1;
    this.onNews();
  }
}
