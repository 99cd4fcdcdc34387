// Errors of both panes as the frames go by, for plots. One series is of one epoch: another setting
// begins anew, and the series before it stays as a shadow.

// Points nearer than this factor in age are one point: a curve on a logarithmic axis needs no more.
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

  // Of a message of numbers. `seconds` is the time that the pane rendered since the change, as
  // rounds times the last frame's time.
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
      // The newest point is always there; the one before it only where it is far enough.
      if (last && one && last.age < one.age * POINT_SPACING) points.pop();
      points.push(point);
    });
  }
}
