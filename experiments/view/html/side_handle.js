// Handle between picture and panels: sets the width of the panels, by drag and by arrow keys.

const SIDE_KEY = 'restlab side width', SIDE_STEP = 16, LEAST_SIDE = 256, MOST_SIDE = 900;

class SideHandle {
  constructor(side) {
    this.side = side;
    this.element = make('div', {class: 'side-handle', role: 'separator', tabindex: 0,
                                'aria-orientation': 'vertical', 'aria-label': 'width of the panels',
                                'aria-valuemin': LEAST_SIDE, 'aria-valuemax': MOST_SIDE,
                                title: 'drag, or arrow keys; Home: as at first'});
    let from = null;
    this.element.addEventListener('pointerdown', event => {
      this.element.setPointerCapture(event.pointerId);
      from = event.clientX + this.width;
      event.preventDefault();
    });
    this.element.addEventListener('pointermove', event => {
      if (from !== null) this.set(from - event.clientX);
    });
    for (const name of ['pointerup', 'pointercancel']) {
      this.element.addEventListener(name, () => { from = null; });
    }
    this.element.addEventListener('dblclick', () => this.set(null));
    this.element.addEventListener('keydown', event => {
      const by = {ArrowLeft: SIDE_STEP, ArrowRight: -SIDE_STEP}[event.key];
      if (by) this.set(this.width + by); else if (event.key === 'Home') this.set(null); else return;
      event.preventDefault();
      event.stopPropagation();
    });
    try {
      const kept = Number(localStorage.getItem(SIDE_KEY));
      if (kept > 0) this.set(kept);
    } catch {
      // Without storage the width is as at first.
    }
  }

  get width() { return this.side.getBoundingClientRect().width; }

  // Sets a width in CSS pixels; null: as at first. The style sheet leaves the picture its room.
  set(width) {
    const style = document.body.style;
    if (width === null) {
      style.removeProperty('--side');
    } else {
      width = Math.round(Math.min(MOST_SIDE, Math.max(LEAST_SIDE, width)));
      style.setProperty('--side', `${width}px`);
    }
    this.element.setAttribute('aria-valuenow', width ?? Math.round(this.width));
    try {
      if (width === null) localStorage.removeItem(SIDE_KEY);
      else localStorage.setItem(SIDE_KEY, width);
    } catch {
      // Without storage it lasts as long as the page.
    }
  }
}
