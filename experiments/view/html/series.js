// Series of both panes' errors over the frames, for plots. A series holds one epoch: a change of
// settings begins a new one and the previous one stays as a shadow.

// Points closer than this factor in age are merged: a logarithmic axis shows no more.
const POINT_SPACING = 1.02;

class ErrorSeries {
  constructor(count) {
    this.count = count;
    this.epoch = null;
    this.before = [];
    this.reset();
  }

  reset() {
    this.curves = Array.from({length: this.count}, () => ({points: [], seconds: 0, rounds: 0, frames: 0}));
  }

  // Adds a message of numbers. `seconds` estimates the pane's render time since the change: the
  // number of rounds times the last frame's time.
  add(numbers) {
    if (numbers.epoch !== this.epoch) {
      if (this.epoch !== null) this.before = this.curves.map(curve => curve.points);
      this.epoch = numbers.epoch;
      this.reset();
    }
    numbers.panes.forEach((pane, i) => {
      const curve = this.curves[i];
      if (!curve || !(pane.frame > curve.frames)) return;
      curve.seconds += Math.max(0, numbers.age - curve.rounds) * (pane.ms || 0) / 1000;
      curve.rounds = numbers.age;
      curve.frames = pane.frame;
      if (typeof pane.last_mse !== 'number') return;
      const point = {age: Math.max(1, numbers.age), seconds: curve.seconds, mse: pane.last_mse};
      const {points} = curve, last = points[points.length - 1];
      const one = points[points.length - 2];
      // Always keep the newest point; drop the one before it if it is too close to its predecessor.
      if (last && one && last.age < one.age * POINT_SPACING) points.pop();
      points.push(point);
    });
  }
}
