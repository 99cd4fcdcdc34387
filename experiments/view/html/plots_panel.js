// Panel of the errors over age and time and of the passes' times. Drawn a few times a second at
// most, and only while visible.

const PLOT_INTERVAL_MS = 300;

class PlotsPanel {
  constructor(count) {
    this.series = new ErrorSeries(count);
    this.passes = new PassBars();
    this.byAge = new LogPlot('MSE of each frame against frames since the change', 'age',
                             'frames since the change', 'MSE of the frame');
    this.byTime = new LogPlot('MSE of each frame against render time', 'seconds',
                              'render time since the change, s', 'MSE of the frame');
    this.mark = make('p', {class: 'hint', 'data-number': 'epoch'});
    this.element = make('div', {class: 'plots'}, this.byAge.element, this.byTime.element, this.mark,
                        this.passes.element);
    this.drawn = -Infinity;
  }

  add(numbers) {
    const began = this.series.add(numbers);
    this.numbers = numbers;
    if (began || performance.now() - this.drawn > PLOT_INTERVAL_MS) this.show();
  }

  show() {
    if (!this.numbers || !this.element.offsetParent) return;
    this.drawn = performance.now();
    const isNothing = !this.numbers.panes.some(showsMethod);
    this.byAge.element.hidden = this.byTime.element.hidden = this.passes.element.hidden = isNothing;
    const {curves, before} = this.series;
    const points = curves.map(curve => curve.points);
    this.byAge.show(points, before);
    this.byTime.show(points, before);
    const times = this.series.changes;
    setText(this.mark, isNothing ? 'Nothing renders: there are no frames to plot.' : times > 0
        ? `Begun anew by a change (${times} so far); the pale curves are those before it.`
        : 'A change of a setting begins the curves anew.');
    if (!isNothing) this.passes.show(this.numbers.panes);
  }
}
