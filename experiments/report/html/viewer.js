// A viewer: the state of one block's images, its controls and its drawing.
class Viewer {
  // `data` as in the file; `images`: {name, role, width, height, data, nonfinite}.
  constructor(root, data, images) {
    // `pointer`: its position in the stage in CSS pixels, or null; `pixel` and `overView`: what is
    // there.
    Object.assign(this, {root, data, images, pointer: null, pixel: null, overView: 0});
    const reference = images.findIndex(image => image.role === 'reference');
    const compare = Math.max(0, reference);
    const method = images.findIndex((_, i) => i !== compare);
    this.state = {
      current: method < 0 ? 0 : method, compare,
      // A noisy image alone says little.
      mode: reference >= 0 && method >= 0 ? 'wipe' : 'single', error: 'none', stops: 0,
      tone: 'srgb', log: {}, wipe: 0.5, held: false
    };
    this.painter = new Painter(this.state, images, data.exposure);
    this.camera = new Camera(images[0].width, images[0].height);
    this.build();
    new ResizeObserver(() => this.redraw()).observe(this.frame);
    this.set({});
  }

  build() {
    this.canvas = make('canvas', {role: 'img'});
    this.divider = make('div', {class: 'divider', role: 'slider', tabindex: 0, hidden: '',
                                'aria-label': 'divider', 'aria-valuemin': 0, 'aria-valuemax': 100});
    this.tags = make('div', {class: 'tags', 'aria-hidden': 'true'});
    this.frame = make('div', {class: 'stage'}, this.canvas, this.tags, this.divider);
    this.stage = new Stage(this.canvas, this.camera, this.images, this.painter);
    this.status = make('p', {class: 'status'});
    this.now = make('p', {class: 'visually-hidden', 'aria-live': 'polite'});
    this.legend = make('div', {class: 'legend'});
    this.list = new ImageList(this.images, this.data.whole, {
      choose: i => this.set({current: i}), compare: i => this.set({compare: i})
    });
    this.toolbar = new Toolbar(this);
    this.root.replaceChildren(this.toolbar.element, this.frame, this.status, this.legend,
                              this.list.element, this.now);
    this.root.setAttribute('tabindex', 0);
    addPointer(this);
  }

  // Changes the state and shows it.
  set(change) {
    Object.assign(this.state, change);
    const {state} = this;
    for (const key of ['current', 'compare', 'mode', 'error', 'stops', 'tone']) {
      this.root.dataset[key] = state[key];
    }
    this.toolbar.show(state, this.painter);
    showLegend(this.legend, state, this.painter, this.images.map(image => image.name));
    const text = this.describe();
    this.canvas.setAttribute('aria-label', text);
    if (this.now.textContent !== text) this.now.textContent = text;
    this.redraw();
  }

  describe() {
    const {state} = this;
    const name = this.images[state.current].name, other = this.images[state.compare].name;
    const error = state.error === 'none' ? '' : `, ${ERRORS[state.error].title} against ${other}`;
    if (state.mode === 'side') return `all images side by side${error}`;
    if (state.mode === 'wipe') return `${other} left of the divider, ${name}${error} right of it`;
    return name + error;
  }

  label(view) {
    const error = view.isError ? ` \u2013 ${ERRORS[this.state.error].title}` : '';
    return `${view.image < 9 ? `${view.image + 1}  ` : ''}${this.images[view.image].name}${error}`;
  }

  // At the next frame, however often it is asked for.
  redraw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.draw();
    });
  }

  draw() {
    const width = this.frame.clientWidth;
    if (!width) return;
    this.stage.arrange(this.state, width);
    const hit = this.pointer && this.stage.hit(...this.pointer);
    this.pixel = hit ? hit.pixel : null;
    this.overView = hit ? hit.view : 0;
    this.stage.draw(this.pixel, this.overView);
    this.placeDivider(width);
    this.placeTags();
    this.showStatus();
    this.list.show(this.state, this.painter, this.pixel);
    this.toolbar.showZoom(this.camera);
    // A finger moves the page until there is something to move in the view.
    this.canvas.style.touchAction = this.camera.fitted ? 'pan-y' : 'none';
    this.root.dataset.scale = this.camera.scale;
    this.root.dataset.drawn = Number(this.root.dataset.drawn || 0) + 1;
  }

  placeDivider(width) {
    this.divider.hidden = this.state.mode !== 'wipe';
    this.divider.style.left = `${this.state.wipe * width}px`;
    this.divider.setAttribute('aria-valuenow', Math.round(100 * this.state.wipe));
  }

  placeTags() {
    const tags = this.stage.views.map(view => {
      const tag = make('span', {}, this.label(view));
      const current = this.state.mode === 'side' && view.image === this.state.current;
      tag.className = current ? 'tag current' : 'tag';
      // Out of the way of what the pointer is at.
      if (this.pointer && Math.abs(this.pointer[1] - view.y) < 48) tag.classList.add('faint');
      const [left, right] = view.clip || [view.x, view.x + view.width];
      const atRight = view.clip && left > 0;
      tag.style.top = `${view.y}px`;
      tag.style.maxWidth = `${Math.max(0, right - left)}px`;
      if (atRight) {
        tag.style.right = `${this.frame.clientWidth - right}px`;
      } else {
        tag.style.left = `${left}px`;
      }
      return tag;
    });
    this.tags.replaceChildren(...tags);
  }

  // Coordinates are those of the whole image, of which the file may hold a part.
  showStatus() {
    const {pixel, state} = this;
    if (!pixel) {
      this.status.textContent = 'Point at a pixel to read it. ? shows the keys.';
      return;
    }
    const view = this.stage.views[this.overView] || this.stage.views[0];
    const at = 3 * (pixel.y * this.images[0].width + pixel.x);
    const values = i => Array.from(this.images[i].data.subarray(at, at + 3), exactFloat).join(' ');
    let text = `x ${pixel.x + this.data.x}  y ${pixel.y + this.data.y}   ` +
        `${this.images[view.image].name}: ${values(view.image)}`;
    if (view.image !== state.compare) {
      text += `   ${this.images[state.compare].name}: ${values(state.compare)}`;
      if (state.error !== 'none') {
        const plane = this.painter.plane(state.error, view.image);
        text += `   ${ERRORS[state.error].title}: ${shortNumber(plane.values[at / 3])}`;
      }
    }
    this.status.textContent = text;
  }

  step(by) {
    const n = this.images.length;
    this.set({current: (this.state.current + by + n) % n});
  }

  stepError(by) {
    const n = ERROR_ORDER.length;
    this.set({error: ERROR_ORDER[(ERROR_ORDER.indexOf(this.state.error) + by + n) % n]});
  }

  expose(stops) { this.set({stops: Math.min(30, Math.max(-30, this.state.stops + stops))}); }

  toggleLog() {
    const {error, log} = this.state;
    if (error === 'none' || ERRORS[error].signed) return;
    this.set({log: {...log, [error]: !this.painter.isLog()}});
  }

  toggleTone() { this.set({tone: this.state.tone === 'srgb' ? 'false' : 'srgb'}); }

  fit() {
    this.camera.fit();
    this.redraw();
  }

  // About a position in the stage (CSS pixels), or the middle of a view. False where nothing moved.
  zoom(factor, x, y) {
    const hit = x === undefined ? null : this.stage.hit(x, y);
    const view = this.stage.views[hit ? hit.view : 0];
    const moved = this.camera.zoom(factor, hit ? x - view.x - view.width / 2 : 0,
                                   hit ? y - view.y - view.height / 2 : 0);
    if (moved) this.redraw();
    return moved;
  }

  actualSize() {
    this.zoom(1 / (window.devicePixelRatio || 1) / this.camera.scale);
  }
}
