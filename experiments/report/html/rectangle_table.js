// Table of the numbers of the chosen rectangle, one row per image.
class RectangleTable {
  constructor(viewer) {
    this.viewer = viewer;
    this.due = new AtMost(TOOL_INTERVAL_MS, () => this.update());
    this.series = [];
    this.begun = new WeakMap();
    this.size = make('b', {});
    this.crop = make('code', {});
    this.body = make('tbody', {});
    this.against = make('span', {});
    const heads = NUMBER_KINDS.map(kind => {
      const {title, help} = RECTANGLE_NUMBERS[kind];
      return make('th', {scope: 'col', class: 'num', title: help}, title);
    });
    const copy = makeButton('copy', 'copy the crop for restlab figure', async () => {
      viewer.notice(await copyText(this.crop.textContent)
          ? 'copied' : 'the browser gives no access to the clipboard: select the text and copy it');
    });
    const close = makeButton('\u00d7', commandTitle('rectangle-off'),
                             () => viewer.rectangle.clear());
    this.element = make(
        'figure', {class: 'rectangle', hidden: ''},
        make('figcaption', {class: 'legend-title'}, this.size, ' ', this.against, ' ', this.crop,
             ' ', make('span', {class: 'group'}, copy, close)),
        make('table', {}, make('thead', {}, make('tr', {}, make('th', {scope: 'col'}, 'image'),
                                                 ...heads,
                                                 make('th', {scope: 'col'}, '95 % interval'))),
             this.body));
  }

  // Takes in the pixels of image i; called for each version of it.
  note(i) {
    const {state, images, camera} = this.viewer, image = images[i];
    const {rectangle, compare} = state;
    if (!rectangle || !image.data || image.width !== camera.width) return;
    const reference = i !== compare && areComparable(image, images[compare]) ? images[compare]
                                                                             : null;
    const key = JSON.stringify([rectangle, compare, image.name, image.epoch, Boolean(reference),
                                this.begin(images[compare])]);
    if (!this.series[i]) this.series[i] = new RectangleSeries();
    // A reference is a mean already: its newest picture counts alone.
    const frame = image.role === 'reference' ? undefined : image.frame;
    this.series[i].add(key, image, reference, rectangle, frame);
    this.series[i].version = versionOf(image);
    this.series[i].against = versionOf(images[compare]);
  }

  // Returns the frames of a converging reference when the series began: one that has twice as many
  // begins them anew.
  begin(reference) {
    if (reference.role !== 'reference' || !reference.frame) return 0;
    const {epoch, frame} = reference, held = this.begun.get(reference);
    const isHeld = held && held.epoch === epoch && frame >= held.frame && frame < 2 * held.frame;
    if (!isHeld) this.begun.set(reference, {epoch, frame});
    return this.begun.get(reference).frame;
  }

  // Shows the numbers if something has changed, at most every TOOL_INTERVAL_MS.
  update() {
    const {state, images} = this.viewer, {rectangle} = state;
    this.element.hidden = !rectangle;
    if (!rectangle) {
      this.key = null;
      this.series = [];
      return;
    }
    setText(this.crop, cropOptions(this.viewer, rectangle));
    const subject = `${rectangle} ${state.compare}`;
    const key = `${subject} ${images.map(image => [versionOf(image), image.epoch, image.name])}`;
    if (key === this.key || !this.due.isDue()) return;
    this.key = key;
    images.forEach((image, i) => {
      const series = this.series[i];
      const isNoted = series && this.subject === subject && series.version === versionOf(image) &&
          series.against === versionOf(images[state.compare]);
      if (!isNoted) this.note(i);
    });
    this.subject = subject;
    this.show();
  }

  show() {
    const {state, images} = this.viewer, [x0, y0, x1, y1] = state.rectangle;
    setText(this.size, `${x1 - x0}\u00d7${y1 - y0} pixels`);
    setText(this.against, `against ${images[state.compare].name}`);
    const rows = images.flatMap((image, i) => {
      if (!this.series[i] || !image.data) return [];
      const {text, numbers} = this.series[i].result();
      const cells = NUMBER_KINDS.map(kind => {
        const {value, lo, hi} = numbers[kind];
        const isThere = kind === 'mean' || this.series[i].hasReference;
        const interval = isThere && !Number.isNaN(lo)
            ? `${this.number(kind, lo)} \u2026 ${this.number(kind, hi)}` : '';
        return make('td', {class: 'num', 'data-part': kind},
                    isThere ? this.number(kind, value) : '',
                    make('span', {class: 'ci'}, interval));
      });
      return [make('tr', {}, make('th', {scope: 'row'}, image.name), ...cells,
                   make('td', {class: 'ci'}, text))];
    });
    this.body.replaceChildren(...rows);
  }

  number(kind, value) {
    return kind === 'energy' ? String(Number(value.toPrecision(4))) : shortNumber(value);
  }
}
