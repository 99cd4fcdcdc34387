// Maps the values of a range to positions of a slider.

const SLIDER_STEPS = 1000;

// Ranges over several powers of ten are logarithmic. If the range begins with 0, the logarithm
// begins at a thousandth of the end, or at 1 for whole numbers.
function sliderScale(lo, hi, isWhole) {
  const tidy = value => {
    const rounded = isWhole ? Math.round(value) : Number(value.toPrecision(3));
    return Math.min(hi, Math.max(lo, rounded));
  };
  const isWide = lo >= 0 && hi / Math.max(lo, isWhole ? 1 : hi / 1e4) > 300;
  if (!isWide) {
    return {to: value => (value - lo) / (hi - lo) * SLIDER_STEPS,
            from: at => tidy(lo + at / SLIDER_STEPS * (hi - lo))};
  }
  const least = lo > 0 ? lo : isWhole ? 0.5 : Math.min(1e-3, hi * 1e-3);
  const span = Math.log(hi / least);
  return {
    to: value => value <= least ? 0 : Math.log(value / least) / span * SLIDER_STEPS,
    from: at => at <= 0 ? lo : tidy(least * Math.exp(at / SLIDER_STEPS * span))
  };
}

// Slider and number field of one value. `send(value)` is called for each move.
class NumberInput {
  constructor({name, lo, hi, isWhole, id}, send) {
    this.scale = sliderScale(lo, hi, isWhole);
    this.slider = make('input', {type: 'range', min: 0, max: SLIDER_STEPS, step: 'any',
                                 'aria-label': `${name}, slider`, tabindex: 0});
    this.number = make('input', {type: 'number', id, min: lo, max: hi,
                                 step: isWhole ? 1 : 'any', 'aria-label': name});
    this.element = make('span', {class: 'number-input'}, this.slider, this.number);
    this.slider.addEventListener('input', () => {
      const value = this.scale.from(Number(this.slider.value));
      this.held = this.number.value = value;
      send(value);
    });
    // Arrow keys move by a hundredth of the range; whole numbers by at least 1.
    this.slider.addEventListener('keydown', event => {
      const sign = {ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1}[event.key];
      if (!sign) return;
      event.preventDefault();
      const was = Number(this.number.value);
      const far = this.scale.from(Number(this.slider.value) + sign * SLIDER_STEPS / 100);
      const value = isWhole && Math.abs(far - was) < 1 ? was + sign : far;
      this.show(Math.min(hi, Math.max(lo, value)));
      send(Number(this.number.value));
    });
    this.number.addEventListener('change', () => {
      if (this.number.value === '' || !this.number.checkValidity()) {
        this.refuse(`${name}: must be a${isWhole ? ' whole' : ''} number between ${lo} and ${hi}`);
        return;
      }
      const value = this.held = Number(this.number.value);
      this.slider.value = this.scale.to(value);
      send(value);
    });
  }

  // Says what is wrong, and shows the value that holds.
  refuse(text) {
    const given = this.number.value;
    this.number.value = this.held;
    this.element.dispatchEvent(new CustomEvent('refused', {
      bubbles: true, detail: given ? `${text}, not ${given}` : text
    }));
  }

  show(value) {
    this.held = this.number.value = value;
    this.slider.value = this.scale.to(value);
  }

  get isBusy() {
    return document.activeElement === this.number || this.slider.matches(':active');
  }
}
