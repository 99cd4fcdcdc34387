// Series of both panes' errors over the frames, for plots. A series holds one epoch of its pane: a
// change of its settings begins a new one and the previous one stays as a shadow.

// Points closer than this factor in age are merged: a logarithmic axis shows no more.
const POINT_SPACING = 1.02;

class ErrorSeries {
  constructor(count) {
    this.count = count;
    this.changes = 0;  // epochs that have ended
    this.before = Array.from({length: count}, () => []);
    this.curves = Array.from({length: count}, () => this.begin(null));
  }

  begin(epoch) { return {epoch, points: [], seconds: 0, rounds: 0, frames: 0}; }

  // Adds a message of numbers; returns whether an epoch has begun. `seconds` estimates the pane's
  // render time since the change: the number of its frames times the last frame's time.
  add(numbers) {
    let hasBegun = false;
    numbers.panes.forEach((pane, i) => {
      if (i >= this.count) return;
      if (this.curves[i].epoch !== pane.epoch) {
        if (this.curves[i].epoch !== null) {
          this.before[i] = this.curves[i].points;
          hasBegun = true;
        }
        this.curves[i] = this.begin(pane.epoch);
      }
      const curve = this.curves[i];
      if (!(pane.frame > curve.frames) || pane.moving) return;
      curve.seconds += Math.max(0, pane.age - curve.rounds) * (pane.ms || 0) / 1000;
      curve.rounds = pane.age;
      curve.frames = pane.frame;
      if (typeof pane.last_mse !== 'number') return;
      const point = {age: Math.max(1, pane.age), seconds: curve.seconds, mse: pane.last_mse};
      const {points} = curve, last = points[points.length - 1];
      const one = points[points.length - 2];
      // Always keep the newest point; drop the one before it if it is too close to its predecessor.
      if (last && one && last.age < one.age * POINT_SPACING) points.pop();
      points.push(point);
    });
    if (hasBegun) ++this.changes;
    return hasBegun;
  }
}
