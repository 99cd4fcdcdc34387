// Control of a parameter, made from its description: kind, range, choices, default, help.

let controlCount = 0;

// Key of everything that decides the kind of control; the value is left out.
function controlKey(info) {
  return JSON.stringify([info.name, info.range, info.choices, info.help, info.default,
                         info.part]);
}

function isWholeNumber(info) {
  if (info.type) return info.type === 'integer';
  if ('isReal' in info) return !info.isReal;
  return [info.default, info.value, ...(info.range || [])].every(Number.isInteger);
}

// Returns the parts of a name; a line may end between them.
function breakable(name) {
  return name.split(/(?<=[_.])/).flatMap((part, i) => i ? [make('wbr'), part] : [part]);
}

class ParameterControl {
  // `send(value)`; null means the default.
  constructor(info, send) {
    this.id = `parameter-${++controlCount}`;
    // Forces show() to display the answer, even if the value is unchanged.
    this.send = value => {
      this.shown = null;
      this.isAsked = true;
      send(value);
    };
    this.input = this.makeInput(info);
    this.reset = makeButton('\u21ba', `${info.name}: back to the default`, () => this.send(null));
    this.reset.className = 'reset';
    const more = makeButton('i', `about ${info.name}`, () => {
      this.about.hidden = !this.about.hidden;
      more.setAttribute('aria-expanded', !this.about.hidden);
    });
    more.className = 'more';
    more.setAttribute('aria-expanded', 'false');
    this.about = make('p', {class: 'about', hidden: ''}, this.aboutText(info));
    this.unused = make('p', {class: 'why', hidden: ''});
    this.element = make('div', {class: 'parameter', 'data-parameter': info.name},
                        make('label', {for: this.id, title: info.help || ''}, ...breakable(info.name)),
                        more, this.reset, this.input.element, this.unused, this.about);
    this.words = [info.name, info.help, info.part, info.source].join(' ').toLowerCase();
    // Show a value that was held back while the control had the focus, such as a refused one.
    this.element.addEventListener('focusout', () => {
      if (!this.isAsked && this.shown === null) this.show(this.info);
    });
    this.show(info);
  }

  aboutText(info) {
    const unit = info.unit ? ` ${info.unit}` : '';
    const range = info.range ? `From ${info.range[0]} to ${info.range[1]}${unit}. ` : '';
    return `${info.help || ''}. ${range}Default: ${info.default}${unit}.` +
        (info.source ? ` Source: ${info.source}.` : '');
  }

  makeInput(info) {
    const {send, id} = this;
    if (typeof info.default === 'boolean') {
      const box = make('input', {type: 'checkbox', id});
      box.addEventListener('change', () => send(box.checked));
      return {element: box, show: value => { box.checked = value; }, isBusy: false};
    }
    if (info.type === 'colour') return makeColourInput(info, send, id);
    if (info.choices && info.choices.length) return makeSelect(info.choices, send, {id});
    if (info.range) {
      return new NumberInput({name: info.name, lo: info.range[0], hi: info.range[1],
                              isWhole: isWholeNumber(info), id}, send);
    }
    const isNumber = typeof info.default === 'number';
    const field = make('input', {type: isNumber ? 'number' : 'text', step: 'any', id});
    field.addEventListener('change', () => {
      if (isNumber && field.value === '') field.value = this.info.value;
      else send(isNumber ? Number(field.value) : field.value);
    });
    return {element: field, show: value => { field.value = value; },
            get isBusy() { return document.activeElement === field; }};
  }

  // Greys a control without effect and says why; it can still be set.
  showUnused(reason) {
    this.reason = reason ? `no effect: ${reason}` : '';
    this.element.classList.toggle('unused', Boolean(reason));
    this.element.title = this.reason;
    this.unused.hidden = !reason;
    setText(this.unused, this.reason);
  }

  show(info) {
    this.info = info;
    this.isAsked = false;
    this.showUnused(info.unused);
    const key = `${info.value} ${info.is_set}`;
    if (key === this.shown) return;
    this.shown = this.input.isBusy ? null : key;
    this.reset.disabled = !info.is_set;
    this.element.classList.toggle('set', Boolean(info.is_set));
    if (!this.input.isBusy) this.input.show(info.value);
  }
}

// Shows a reason that neighbours share once, below the last of them.
function joinReasons(controls) {
  const shown = [...controls].filter(({element}) => !element.hidden);
  shown.forEach(({element, reason, unused}, i) => {
    const next = shown[i + 1];
    unused.hidden = !reason || Boolean(next) && next.reason === reason &&
                    next.element.parentElement === element.parentElement;
  });
}

// A colour as linear Rec. 709 in text, "0.5" or "[0.7, 0.4, 0.2]", with a picker where its range is
// that of an albedo.
function makeColourInput(info, send, id) {
  const field = make('input', {type: 'text', id, class: 'colour'});
  const picker = make('input', {type: 'color', 'aria-label': 'pick the colour'});
  const toSrgb = v => v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055;
  const toLinear = v => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
  const numbersOf = text => {
    const numbers = String(text).replace(/[[\]\s]/g, '').split(',').map(Number);
    return numbers.length === 1 ? [numbers[0], numbers[0], numbers[0]] : numbers;
  };
  field.addEventListener('change', () => {
    const numbers = field.value.trim().split(/[\s,]+/);
    const isList = numbers.length === 3 && !numbers[0].startsWith('[');
    send(isList ? `[${numbers.join(', ')}]` : field.value);
  });
  picker.addEventListener('change', () => {
    const channels = [1, 3, 5].map(at => toLinear(parseInt(picker.value.slice(at, at + 2), 16) / 255));
    send(`[${channels.map(v => Number(v.toPrecision(4))).join(', ')}]`);
  });
  const show = value => {
    const numbers = numbersOf(value);
    field.value = String(value).replace(/\d+\.\d{7,}(?:e[-+]?\d+)?/gi,
                                        text => Number(Number(text).toPrecision(7)));
    field.title = value;
    picker.hidden = !(info.has_picker && numbers.length === 3 && numbers.every(v => v >= 0 && v <= 1));
    if (picker.hidden) return;
    const hex = v => Math.round(255 * toSrgb(v)).toString(16).padStart(2, '0');
    picker.value = `#${numbers.map(hex).join('')}`;
  };
  return {element: make('span', {class: 'colour'}, field, picker), show,
          get isBusy() { return document.activeElement === field; }};
}

// Makes a select of texts or of {value, text, disabled, title} choices.
function makeSelect(choices, send, attributes = {}) {
  const options = choices.map(choice => {
    const isText = typeof choice !== 'object';
    const {value, text, disabled, title} = isText ? {value: choice, text: choice} : choice;
    return make('option', {value, title, disabled: disabled ? '' : null}, text);
  });
  const element = make('select', attributes, ...options);
  element.addEventListener('change', () => send(element.value));
  const show = value => {
    element.value = value;
    if (element.value === String(value)) return;
    // Add a value that is not on the list: the select must show what is set.
    element.append(make('option', {value}, String(value)));
    element.value = value;
  };
  return {element, show, isBusy: false};
}
