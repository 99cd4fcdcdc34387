// Running numbers of both panes side by side, and the reference they are measured against.

// The reference and images of files have no counts.
const showsMethod = pane => pane.rays !== null;
const OF_FRAMES = ['mse_newest', 'relmse_newest', 'frames', 'ms', 'rays', 'bytes'];

// [key, title, help, text, number or interval of a pane, unit of the number]
const NUMBER_ROWS = [
  ['mse', 'MSE', 'mean squared error of single frames against the reference: mean over the ' +
                 'window of frames; the interval is of eight batches of them', pane => pane.mse],
  ['mse_newest', 'newest', 'the same of the newest frames alone, in which a method does not warm ' +
                           'up any more', pane => pane.mse_newest ?? null],
  ['relmse', 'relMSE', 'the same, relative to the reference squared', pane => pane.relmse],
  ['relmse_newest', 'newest', 'the same of the newest frames alone',
   pane => pane.relmse_newest ?? null],
  ['energy', 'energy', 'mean of the frames over mean of the reference; 1 is right',
   pane => pane.energy],
  ['frames', 'frame / of', 'frames of the history; frames in the window of the numbers above',
   pane => !showsMethod(pane) ? NOTHING
       : `${quantity(pane.frame)} / ${quantity(pane.frames_measured)}${pane.seen ? '' : ', hidden'}`],
  ['ms', 'time', 'of the last frame; while the camera moves frames are smaller',
   pane => pane.moving ? `${milliseconds(pane.ms)} at ${pane.width}\u00d7${pane.height}`
       : pane.ms >= 1000 ? milliseconds(pane.ms) : pane.ms, ' ms'],
  ['rays', 'rays', 'rays of the last frame', pane => withPrefix(pane.rays, '')],
  ['bytes', 'memory', 'bytes that the method keeps', pane => bytesText(pane.bytes)]
];

// Returns the number in what a row shows; null if it shows none.
function numberOf(given) {
  const number = given !== null && typeof given === 'object' ? given.value : given;
  return typeof number === 'number' ? number : null;
}

class NumbersPanel {
  // `faults`: names of the health counts that must be 0; the other counts describe the method.
  constructor(count, faults) {
    this.faults = new Set(faults);
    this.cells = new Map();
    this.titles = new Map();
    this.names = Array.from({length: count}, (_, i) => make('span', {}, PANE_NAMES[i]));
    const heads = this.names.map((name, i) => make(
        'th', {scope: 'col', class: 'num'}, make('span', {class: `dot d${i}`}), name));
    const rows = NUMBER_ROWS.map(([key, title, help]) => {
      const cells = heads.map(() => {
        const value = make('span', {class: 'value'}), interval = make('span', {class: 'ci'});
        return {cell: make('td', {class: 'num', 'data-number': key}, value, interval), value,
                interval};
      });
      this.cells.set(key, cells);
      const head = make('th', {scope: 'row', title: help, 'data-number-of': title}, title);
      this.titles.set(key, head);
      return make('tr', {'data-row': key}, head, ...cells.map(one => one.cell));
    });
    this.health = heads.map(() => make('div', {class: 'health', 'data-number': 'health'}));
    const healthHelp = 'what was counted in the last frame; red: what must not happen';
    rows.push(make('tr', {'data-row': 'health'},
                   make('th', {scope: 'row', title: healthHelp}, 'health'),
                   ...this.health.map(cell => make('td', {}, cell))));
    this.rows = rows;
    this.histories = make('p', {class: 'line-text', 'data-number': 'histories', hidden: ''});
    this.reference = make('p', {class: 'line-text', 'data-number': 'reference'});
    this.transport = make('p', {class: 'line-text', 'data-number': 'transport'});
    this.element = make('section', {class: 'numbers-box', 'aria-label': 'Numbers'},
                        make('table', {class: 'numbers-table'},
                             make('thead', {}, make('tr', {}, make('td', {}), ...heads)),
                             make('tbody', {}, ...rows)),
                        this.histories, this.reference, this.transport);
  }

  // Shows the panes' names, as their pictures have them.
  showNames(names) { this.names.forEach((name, i) => setText(name, names[i])); }

  show(numbers) {
    const panes = numbers.panes, isNothing = !panes.some(showsMethod);
    for (const row of this.rows) {
      row.hidden = isNothing && [...OF_FRAMES, 'health'].includes(row.dataset.row);
    }
    for (const [key, , , of, unit = ''] of NUMBER_ROWS) {
      const values = panes.map(of), known = values.map(numberOf).filter(one => one !== null);
      const aligned = alignedFormat(known, key === 'energy' ? 4 : 3);
      const format = number => aligned(number) + unit;
      this.cells.get(key).forEach((cell, i) => {
        if (i < values.length) this.showCell(cell, values[i], format, showsMethod(panes[i]));
      });
    }
    for (const key of ['mse_newest', 'relmse_newest']) {
      setText(this.titles.get(key), `newest ${numbers.newest_frames}`);
    }
    const old = PANE_NAMES.filter((_, i) => panes[i] && panes[i].old_light);
    this.histories.hidden = !old.length;
    setText(this.histories, `${old.join(' and ')}: the history began before the light was changed; ` +
                                'R begins it anew');
    panes.forEach((pane, i) => this.showHealth(this.health[i], pane));
    const {reference: r, transport: t} = numbers;
    const perSample = r && r.ms_per_sample !== null ? `, ${milliseconds(r.ms_per_sample)}/spp` : '';
    setText(this.reference, !r ? 'no reference' : !r.spp ? 'reference: not yet there'
        : `reference: ${r.spp} spp, own relMSE ${quantity(r.relmse)}${perSample}`);
    const isLoadKnown = typeof numbers.busy === 'number' && !isNothing;
    const isBusy = isLoadKnown && numbers.busy > 2;
    const busy = isLoadKnown ? `; load ${quantity(numbers.busy, 2)}${
        isBusy ? ', times are longer than on a quiet machine' : ''}` : '';
    setText(this.transport, (t ? `images: ${t.width}\u00d7${t.height}, ${t.bits} bits, ${
        quantity(t.mb_per_second)} MB/s` : '') + busy);
    // Warn above a load of 2 only: the viewer itself keeps every thread busy.
    this.transport.classList.toggle('warn', isBusy);
    this.transport.title = 'what goes to all pages; load average of the machine over its threads';
  }

  // `given`: null, a text, a number or one with an interval.
  showCell({cell, value, interval}, given, format, hasFrames) {
    const number = numberOf(given);
    cell.title = number === null ? '' : String(number);
    if (number !== null) {
      const {lo, hi} = given, isKnown = Number.isFinite(lo) && Number.isFinite(hi);
      setText(value, format(number));
      if (isKnown) cell.title = `${number} [${lo}, ${hi}]`;
      if (typeof given === 'object') {
        setText(interval, isKnown ? `${format(lo)} \u2026 ${format(hi)}`
                                  : hasFrames ? 'no interval yet' : '');
      }
    } else if (given === null || given === undefined) {
      setText(value, NOTHING);
      setText(interval, interval.textContent ? '\u00a0' : '');  // keeps the height of the cell
    } else {
      setText(value, given);
    }
  }

  showHealth(cell, pane) {
    const counted = Object.entries(pane.health || {}).filter(([, count]) => count);
    const lines = counted.map(([name, count]) => `${name.replaceAll('_', ' ')} ${quantity(count)}`);
    setText(cell, lines.join(', ') || (showsMethod(pane) ? 'nothing counted' : NOTHING));
    cell.classList.toggle('warn', counted.some(([name]) => this.faults.has(name)));
  }
}

// Bars with the milliseconds of each pass, on one scale.
class PassBars {
  constructor() {
    this.element = make('div', {class: 'passes'});
    this.key = '';
  }

  show(panes) {
    const key = panes.map(pane => (pane.passes || []).map(pass => pass.name).join()).join('|');
    if (key !== this.key) this.build(panes, key);
    const most = Math.max(1e-9, ...panes.flatMap(pane => (pane.passes || []).map(one => one.ms)));
    panes.forEach((pane, p) => (pane.passes || []).forEach(({ms}, k) => {
      const {bar, text} = this.bars[p][k];
      bar.style.width = `${100 * ms / most}%`;
      setText(text, quantity(ms));
    }));
  }

  build(panes, key) {
    this.key = key;
    this.bars = panes.map(() => []);
    this.element.replaceChildren(...panes.map((pane, p) => {
      const rows = (pane.passes || []).map(({name}) => {
        const bar = make('div', {class: `pass-bar b${p}`}), text = make('td', {class: 'num'});
        this.bars[p].push({bar, text});
        return make('tr', {}, make('th', {scope: 'row'}, name),
                    make('td', {class: 'pass-cell'}, bar), text);
      });
      return make('table', {class: 'pass-table'},
                  make('caption', {}, `${PANE_NAMES[p]}: milliseconds a pass`),
                  make('tbody', {}, ...rows));
    }));
  }
}
