// What the panes keep of a pixel: path, reservoir, donors, cache slot, as the program tells it.

function probeText(value) {
  if (Array.isArray(value)) return value.map(probeText).join('  ');
  if (value !== null && typeof value === 'object') {
    return Object.entries(value).map(([name, one]) => `${name} ${probeText(one)}`).join(', ');
  }
  return typeof value === 'number' ? quantity(value, 5) : String(value ?? NOTHING);
}

class ProbePanel {
  constructor(page, count) {
    Object.assign(this, {page, count, pixel: null, answers: []});
    const number = name => make('input', {type: 'number', min: 0, step: 1, 'aria-label': name});
    this.x = number('x of the pixel');
    this.y = number('y of the pixel');
    const form = make('form', {class: 'line'}, 'x', this.x, 'y', this.y,
                      make('button', {type: 'submit'}, 'probe'),
                      makeButton('clear', 'take the marks away', () => this.clear()));
    form.addEventListener('submit', event => {
      event.preventDefault();
      this.ask({x: Number(this.x.value), y: Number(this.y.value)});
    });
    this.hint = make('p', {class: 'hint'},
                     'Click a pixel of the picture, or point at one and press g.');
    this.results = make('div', {class: 'scroll'});
    this.commands = make('div', {});
    this.element = make('div', {class: 'probe'}, form, this.hint, this.results, this.commands);
  }

  // Of all panes, so that they compare.
  ask({x, y}) {
    this.pixel = {x, y};
    this.x.value = x;
    this.y.value = y;
    this.answers = [];
    for (let pane = 0; pane < this.count; ++pane) {
      this.page.session.send({do: 'probe', pane, x, y});
    }
  }

  clear() {
    this.pixel = null;
    this.answers = [];
    this.hint.textContent = 'Click a pixel of the picture, or point at one and press g.';
    this.results.replaceChildren();
    this.commands.replaceChildren();
    for (let i = 0; i < this.count; ++i) this.page.viewer.setImage(i, {marks: null});
  }

  answer(message) {
    // One that nobody waits for any more.
    if (!this.pixel || message.x !== this.pixel.x || message.y !== this.pixel.y) return;
    this.answers[message.pane] = message;
    const donors = (message.donors || []).map(([x, y]) => ({x, y, kind: 'donor'}));
    this.page.viewer.setImage(message.pane, {
      marks: [...donors, {x: message.x, y: message.y, kind: 'probe'}]
    });
    this.show();
  }

  show() {
    const there = this.answers.filter(Boolean);
    const names = new Map();
    for (const {values} of there) {
      for (const value of values) if (!names.has(value.name)) names.set(value.name, value);
    }
    const donors = ({donors: list}) => list && list.length ? `, ${list.length} donors` : '';
    this.hint.textContent = there.map(one => `${PANE_NAMES[one.pane]}: frame ${one.frame}, seed ${
        one.seed}${donors(one)}`).join('; ');
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
    this.commands.replaceChildren(...there.filter(one => one.command).map(one => make(
        'p', {class: 'command'}, `${PANE_NAMES[one.pane]} `, make('code', {}, one.command),
        copyButton(() => one.command, 'copy the command that prints the same',
                   text => this.page.messages.notice(text)))));
  }
}
