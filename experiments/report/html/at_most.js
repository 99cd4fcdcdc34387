// Limits how often something is done.

class AtMost {
  // `again()` is called once the interval is over, if isDue() was false meanwhile.
  constructor(intervalMs, again) { Object.assign(this, {intervalMs, again, last: -Infinity}); }

  // True if the interval since the last time is over; a new one begins then.
  isDue() {
    const now = performance.now(), rest = this.last + this.intervalMs - now;
    if (rest <= 0) {
      this.last = now;
      return true;
    }
    if (!this.isWaiting) {
      this.isWaiting = true;
      setTimeout(() => {
        this.isWaiting = false;
        this.again();
      }, rest);
    }
    return false;
  }
}
