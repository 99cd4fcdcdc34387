// Panel of what the panes keep for a pixel: path, reservoir, donors, cache slot.

function probeText(value) {
  if (Array.isArray(value)) return value.map(probeText).join('  ');
  if (value !== null && typeof value === 'object') {
    return Object.entries(value).map(([name, one]) => `${name} ${probeText(one)}`).join(', ');
  }
  return typeof value === 'number' ? quantity(value, 5) : String(value ?? NOTHING);
}

// Help on the reasons the program gives for a donor's shift.
const SHIFT_HELP = {
  accepted: 'the pixel sees the donor\'s sample',
  empty: 'the donor has no sample',
  background: 'the sample\'s film sample shows no surface in this pixel',
  smooth: 'x1 is smoother than roughness_limit',
  jacobian: 'the Jacobian lies outside of what max_jacobian allows',
  dark: 'the surface or the light sends nothing that way',
  absorbed: 'the camera is inside a body that absorbs',
  replay: 'the replayed prefix came to no vertex of the kind that the path has',
  'connects earlier': 'an earlier pair of vertices connects: the shift would have no inverse',
  pair: 'the two vertices that reconnect are not connectable in this pixel',
  entry: 'entries hold no path of this kind',
  occluded: 'something lies between x1 and the vertex or the light',
  'not kept': 'the frame has written over the donor\'s sample'
};
const REUSE_HELP = {
  canonical: 'the pixel\'s own sample, as it entered the last merge over space',
  space: 'a pixel of this frame', time: 'the last frame', entry: 'an entry of the cache'
};

const isRejected = ({shift}) => !['accepted', 'empty', 'not kept'].includes(shift);
const donorsOf = message => (message.donors || []).filter(({reuse}) => reuse !== 'canonical');

function donorMarks(message) {
  const {x, y} = message;
  return donorsOf(message).filter(one => one.x !== undefined && (one.x !== x || one.y !== y))
      .map(one => ({x: one.x, y: one.y, kind: 'donor',
                    state: one.selected ? 'selected' : isRejected(one) ? 'rejected' : 'accepted'}));
}

function donorTable(message) {
  const heads = [['from', 'pixel of the donor, or its entry'],
                 ['shift', 'accepted, or the test that it failed'],
                 ['confidence', 'with which the donor entered, in samples'],
                 ['MIS', 'resampling MIS weight'],
                 ['share', 'of the sum of resampling weights: the chance of being selected'],
                 ['J', 'Jacobian of the shift']];
  const rows = message.donors.map(one => make(
      'tr', {class: one.selected ? 'selected' : ''},
      make('th', {scope: 'row', title: REUSE_HELP[one.reuse]},
           `${one.reuse} ${one.entry ?? `${one.x},${one.y}`}${one.selected ? ' \u2713' : ''}`),
      make('td', {title: SHIFT_HELP[one.shift] || ''}, one.shift),
      ...[one.confidence, one.mis_weight, one.share, one.jacobian].map(
          number => make('td', {class: 'num'}, number === null ? NOTHING : quantity(number, 3)))));
  return make('table', {class: 'probe-table donors'},
              make('caption', {}, `${PANE_NAMES[message.pane]}: donors, \u2713 selected`),
              make('thead', {}, make('tr', {}, ...heads.map(([name, title]) => make(
                  'th', {scope: 'col', title}, name)))),
              make('tbody', {}, ...rows));
}

function pathTable(message) {
  const rows = message.path.map(one => make(
      'tr', {}, make('th', {scope: 'row', title: one.direction ? 'a direction, without a unit' : ''},
                     one.name),
      ...one.position.map(number => make('td', {class: 'num'}, quantity(number, 4))),
      make('td', {title: one.reconnected
          ? 'a shift keeps this vertex' : 'a shift traces this vertex again from the other pixel'},
           one.reconnected ? 'reconnected' : 'replayed')));
  return make('table', {class: 'probe-table path'},
              make('caption', {}, `${PANE_NAMES[message.pane]}: path of the sample`),
              make('thead', {}, make('tr', {}, ...['vertex', 'x m', 'y m', 'z m', 'by a shift'].map(
                  name => make('th', {scope: 'col'}, name)))),
              make('tbody', {}, ...rows));
}

// Follows frames at most so often; an answer that does not come is no longer waited for after the
// second time.
const PROBE_INTERVAL_MS = 250, PROBE_TIMEOUT_MS = 2000;

class ProbePanel {
  constructor(page, count) {
    Object.assign(this, {page, count, pixel: null, answers: [], asked: [], texts: []});
    this.due = new AtMost(PROBE_INTERVAL_MS, () => this.follow(page.last));
    const number = name => make('input', {type: 'number', min: 0, step: 1, 'aria-label': name});
    this.x = number('x of the pixel');
    this.y = number('y of the pixel');
    const form = make('form', {class: 'line'}, 'x', this.x, 'y', this.y,
                      make('button', {type: 'submit'}, 'probe'),
                      makeButton('clear', 'take the marks away', () => this.clear()));
    this.hold = make('input', {type: 'checkbox', id: 'probe-hold'});
    this.hold.addEventListener('change', () => {
      this.showAge();
      this.follow(page.last);
    });
    form.append(make('label', {for: 'probe-hold', title: 'keep what the probed frame had, while ' +
                                                         'frames go on'}, this.hold, ' hold'));
    form.addEventListener('submit', event => {
      event.preventDefault();
      this.ask({x: Number(this.x.value), y: Number(this.y.value)});
    });
    this.hint = make('p', {class: 'hint'});
    this.invite();
    this.results = make('div', {class: 'scroll'});
    this.donors = make('div', {class: 'scroll'});
    this.commands = make('div', {});
    this.element = make('div', {class: 'probe'}, form, this.hint, this.results, this.donors,
                        this.commands);
  }

  // Probes all panes at once, to compare them. A new pixel is of the newest frame, held or not.
  ask({x, y}) {
    this.pixel = {x, y};
    this.x.value = x;
    this.y.value = y;
    this.answers = [];
    this.unmark();
    this.page.state.panes.forEach(({source}, pane) => {
      if (!source) this.send(pane);
    });
  }

  send(pane) {
    const {x, y} = this.pixel;
    this.asked[pane] = performance.now();
    this.page.session.send({do: 'probe', pane, x, y});
  }

  // Shows a hint while nothing is probed.
  invite() {
    setText(this.hint, this.page.state.panes.every(({source}) => source)
        ? 'Only methods keep something of a pixel, and no pane shows one.'
        : 'Click a pixel of the picture, or point at one and press g.');
  }

  // Probes again while frames go on. `numbers`: the program's newest message.
  follow(numbers) {
    if (!this.pixel || this.hold.checked || !numbers) return;
    const {epoch, panes} = numbers;
    if (epoch !== this.page.state.epoch) return;
    const isWaiting = pane => this.asked[pane] > performance.now() - PROBE_TIMEOUT_MS;
    const old = this.answers.filter(one => one && showsMethod(panes[one.pane]) &&
        panes[one.pane].age > 0 && !panes[one.pane].moving && !isWaiting(one.pane) &&
        (this.isOld(one) || one.frame !== panes[one.pane].frame));
    if (old.length && this.due.isDue()) for (const {pane} of old) this.send(pane);
  }

  clear() {
    this.pixel = null;
    this.answers = [];
    this.invite();
    this.results.replaceChildren();
    this.donors.replaceChildren();
    this.commands.replaceChildren();
    this.unmark();
  }

  unmark() {
    for (let i = 0; i < this.count; ++i) this.page.viewer.setImage(i, {marks: null, path: null});
  }

  answer(message) {
    // Discard an answer for a pixel that is no longer probed.
    if (!this.pixel || message.x !== this.pixel.x || message.y !== this.pixel.y) return;
    this.answers[message.pane] = message;
    this.asked[message.pane] = 0;
    this.page.viewer.setImage(message.pane, {
      marks: [...donorMarks(message), {x: message.x, y: message.y, kind: 'probe'}],
      path: message.path
    });
    this.show();
  }

  // True if the pane or the picture was changed since the answer's frame.
  isOld({pane, epoch}) {
    const {panes, picture_epoch} = this.page.state;
    return epoch < Math.max(panes[pane].epoch, picture_epoch);
  }

  // Says of which frames the values are, and marks those that were probed before the last change.
  showAge() {
    if (!this.answers.some(Boolean)) return this.invite();
    const frame = this.hold.checked ? 'held at frame' : 'frame';
    setText(this.hint, this.texts.map(([one, text]) => `${PANE_NAMES[one.pane]}: ${frame} ${
        one.frame}, ${text}${this.isOld(one) ? ', before the change' : ''}`).join('; '));
    for (const [one] of this.texts)
      if (this.isOld(one)) this.page.viewer.setImage(one.pane, {path: null});
    this.results.classList.toggle('old', this.texts.some(([one]) => this.isOld(one)));
  }

  show() {
    const there = this.answers.filter(Boolean);
    const names = new Map();
    for (const {values} of there) {
      for (const value of values) if (!names.has(value.name)) names.set(value.name, value);
    }
    const donors = message => {
      const {length} = donorsOf(message);
      return length ? `, ${length} donor${length > 1 ? 's' : ''}` : '';
    };
    this.texts = there.map(one => [one, `seed ${one.seed}${donors(one)}`]);
    this.showAge();
    const heads = there.map(one => make('th', {scope: 'col', class: 'num'}, PANE_NAMES[one.pane]));
    const rows = Array.from(names, ([name, info]) => make(
        'tr', {}, make('th', {scope: 'row', title: info.help || ''}, name,
                       make('span', {class: 'unit'}, info.unit ? ` ${info.unit}` : '')),
        ...there.map(({values}) => {
          const found = values.find(value => value.name === name);
          return make('td', {class: 'num'}, found ? probeText(found.value) : NOTHING);
        })));
    this.results.replaceChildren(make(
        'table', {class: 'probe-table'},
        make('thead', {}, make('tr', {}, make('td', {}), ...heads)), make('tbody', {}, ...rows)));
    this.donors.replaceChildren(
        ...there.filter(one => one.donors && one.donors.length).map(donorTable),
        ...there.filter(one => one.path && one.path.length).map(pathTable));
    this.commands.replaceChildren(...there.filter(one => one.command).map(one => make(
        'p', {class: 'command'}, `${PANE_NAMES[one.pane]} `, make('code', {}, one.command),
        copyButton(() => one.command, 'copy the command that prints the same',
                   text => this.page.messages.notice(text)))));
  }
}
