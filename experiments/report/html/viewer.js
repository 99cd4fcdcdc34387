// Viewer: the state of one block's images, its controls and its drawing.

const VIEWER_NOTICE_MS = 8000;

class Viewer {
  // `data` as in the report; `images`: {name, role, width, height, data, nonfinite, version}. On a
  // live page `data` may also have `room()`: height of the stage in CSS pixels, which is then
  // filled; `pointer` (pointer.js); `idle()`: the status line while the pointer is outside;
  // `arranged(images)`: called with the images in view or compared with; `notice(text)`: says it; `link()` returns
  // the address of what is shown.
  constructor(root, data, images) {
    // `pointer`: position in the stage in CSS pixels, or null; `pixel` and `overView`: pixel and
    // view at that position.
    Object.assign(this, {root, data, images, pointer: null, pixel: null, overView: 0});
    const reference = images.findIndex(image => image.role === 'reference');
    const compare = Math.max(0, reference);
    const method = images.findIndex((_, i) => i !== compare);
    this.state = {
      // Right and left of the divider, and what errors are against; left -1: the same as compare.
      current: method < 0 ? 0 : method, left: -1, compare,
      // Compare with the reference: a noisy image alone says little.
      mode: reference >= 0 && method >= 0 ? 'wipe' : 'single', error: 'none', stops: 0,
      tone: 'srgb', channel: 'rgb', log: {}, wipe: 0.5, held: false, opacity: 0.7,
      histogram: false, rectangle: null, insets: []
    };
    // Called after each drawing.
    this.onDrawn = () => {};
    this.painter = new Painter(this.state, images, data.exposure);
    this.painter.onLost = this.painter.rest.onNews = () => this.redraw();
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
    this.list = new ImageList(this.images, this.data.whole, this.camera, {
      choose: i => this.set({current: i}), compare: i => this.set({compare: i}),
      left: i => this.setLeft(i)
    });
    this.rectangle = new RectangleChoice(this);
    this.tools = new ViewerTools(this);
    this.toolbar = new Toolbar(this);
    this.said = make('p', {class: 'notice', role: 'status', hidden: ''});
    this.insets = new Insets(this);
    this.root.replaceChildren(this.toolbar.element, this.said, this.frame, this.status,
                              this.insets.element, this.legend, this.tools.element,
                              this.list.element, this.now);
    this.root.setAttribute('tabindex', 0);
    addPointer(this);
  }

  set(change) {
    Object.assign(this.state, change);
    const {state} = this;
    for (const key of ['current', 'left', 'compare', 'mode', 'error', 'stops', 'tone', 'channel']) {
      this.root.dataset[key] = state[key];
    }
    this.toolbar.show(state, this.painter, this.rectangle.isOn);
    showLegend(this.legend, state, this.painter, this.images);
    const text = this.describe();
    this.canvas.setAttribute('aria-label', text);
    if (this.now.textContent !== text) this.now.textContent = text;
    this.redraw();
  }

  // Replaces pixels or other properties of an image by those in `change`.
  setImage(i, change) {
    const image = this.images[i];
    Object.assign(image, change);
    if ('data' in change) {
      ++image.version;
      this.tools.table.note(i);
    }
    this.redraw();
  }

  // Sets the size at which all images are shown. A rectangle is of pixels that are no more.
  setSize(width, height) {
    if (width === this.camera.width && height === this.camera.height) return;
    this.camera.resize(width, height);
    if (this.state.rectangle) this.rectangle.clear();
    this.redraw();
  }

  // Says something to the reader: on a live page as its other messages, else above the picture.
  notice(text) {
    if (this.data.notice) return this.data.notice(text);
    setText(this.said, text);
    this.said.hidden = false;
    clearTimeout(this.saidTimer);
    this.saidTimer = setTimeout(() => { this.said.hidden = true; }, VIEWER_NOTICE_MS);
  }

  setExposure(exposure) {
    this.painter.exposure = exposure;
    this.set({});
  }

  describe() {
    const {state} = this;
    const against = state.error === 'none'
        ? '' : `, ${ERRORS[state.error].title} against ${this.images[state.compare].name}`;
    const text = i => this.images[i].name + (i === state.compare ? '' : against);
    if (state.mode === 'side') return `all images side by side${against}`;
    if (state.mode !== 'wipe') return text(state.current);
    return `${text(leftImage(state, this.images))} left of the divider, ${
        text(state.current)} right of it`;
  }

  // Schedules a drawing for the next frame; repeated calls are merged.
  redraw() {
    if (this.waiting) return;
    this.waiting = requestAnimationFrame(() => {
      this.waiting = 0;
      this.draw();
    });
  }

  // Draws what waits at once: called within a frame of the browser.
  drawWaiting() {
    if (!this.waiting) return;
    cancelAnimationFrame(this.waiting);
    this.waiting = 0;
    this.draw();
  }

  draw() {
    const width = this.frame.clientWidth;
    if (!width) return;
    this.stage.arrange(this.state, this.room(width));
    const {error, compare, insets} = this.state;
    const inView = this.stage.views.map(view => view.image);
    const isCompared = error !== 'none' || this.state.rectangle || this.state.histogram;
    const used = isCompared ? [...new Set([...inView, compare])] : inView;
    if (this.data.arranged) this.data.arranged(insets.length ? [...this.images.keys()] : used);
    this.painter.rest.want(isRestError(error) ? error : null, compare, inView);
    const hit = this.pointer && this.stage.hit(...this.pointer);
    this.pixel = hit ? hit.pixel : null;
    this.overView = hit ? hit.view : 0;
    this.stage.draw(this.pixel, this.overView);
    this.placeDivider(width);
    this.placeTags();
    this.showStatus();
    this.insets.show();
    this.list.show(this.state, this.painter, this.pixel);
    showLegend(this.legend, this.state, this.painter, this.images);
    this.toolbar.showZoom(this.camera);
    // A touch scrolls the page while the whole image fits into the view.
    const scrolls = this.camera.fitted && !this.rectangle.isOn;
    this.canvas.style.touchAction = scrolls ? 'pan-y' : 'none';
    this.tools.update();
    this.root.dataset.scale = this.camera.scale;
    this.root.dataset.drawn = Number(this.root.dataset.drawn || 0) + 1;
    this.onDrawn();
  }

  room(width) {
    if (this.data.room) return {width, mostHeight: this.data.room(), isFilled: true};
    return {width, mostHeight: Math.max(240, 0.78 * window.innerHeight), isFilled: false};
  }

  placeDivider(width) {
    this.divider.hidden = this.state.mode !== 'wipe';
    this.divider.style.left = `${this.state.wipe * width}px`;
    this.divider.setAttribute('aria-valuenow', Math.round(100 * this.state.wipe));
  }

  placeTags() {
    const tags = this.stage.views.map(view => this.tag(view));
    const key = JSON.stringify(tags);
    if (this.tagKey === key) return;
    this.tagKey = key;
    this.tags.replaceChildren(...tags.map(({parts, short, ...attributes}) => {
      return make('span', {...attributes, title: parts.join('  ')}, parts.join('  '));
    }));
    tags.forEach(({parts, short}, k) => {
      const element = this.tags.children[k];
      element.textContent = fittingLabel(parts, short, text => {
        element.textContent = text;
        return element.scrollWidth <= element.clientWidth;
      });
    });
  }

  tag(view) {
    const current = this.state.mode === 'side' && view.image === this.state.current;
    // Fade the tag if the pointer is near.
    const isNear = this.pointer && Math.abs(this.pointer[1] - view.y) < 48;
    const [left, right] = view.clip || [view.x, view.x + view.width];
    const side = view.clip && left > 0 ? `right:${this.frame.clientWidth - right}px`
                                       : `left:${left}px`;
    return {
      parts: labelParts(this, view), short: shortLabel(this, view),
      class: `tag${current ? ' current' : ''}${isNear ? ' faint' : ''}`,
      style: `top:${view.y}px;max-width:${Math.max(0, right - left)}px;${side}`
    };
  }

  // Coordinates are those of the whole image, even if the file holds a crop.
  showStatus() {
    const {pixel, state, images} = this;
    if (!pixel) {
      setText(this.status, this.data.idle ? this.data.idle()
                                          : 'Point at a pixel to read it. ? shows the keys.');
      return;
    }
    const view = this.stage.views[this.overView] || this.stage.views[0];
    const values = image => {
      if (!image.data) return `   ${image.name}: nothing yet`;
      if (isOldImage(image)) return `   ${image.name}: before the change`;
      const at = 3 * this.camera.indexIn(image, pixel);
      const numbers = Array.from(image.data.subarray(at, at + 3), exactFloat).join(' ');
      return `   ${image.name}: ${numbers}`;
    };
    const image = images[view.image];
    let text = `x ${pixel.x + this.data.x}  y ${pixel.y + this.data.y}${values(image)}`;
    const layer = image.overlay && this.painter.overlayTexts(
        view.image, this.camera.indexIn(image, pixel));
    if (layer?.length) text += `   ${image.overlay.name}: ${layer.join(' ')}`;
    if (view.image !== state.compare) {
      text += values(images[state.compare]);
      if (view.isError) {
        const plane = this.painter.plane(state.error, view.image);
        const value = plane && plane.values[this.camera.indexIn(image, pixel)];
        if (plane) text += `   ${ERRORS[state.error].title}: ${shortNumber(value)}`;
      }
    }
    setText(this.status, text);
  }

  // Returns the position of an event in the stage, in CSS pixels.
  pointerAt(event) {
    const box = this.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  step(by) {
    const n = this.images.length;
    this.set({current: (this.state.current + by + n) % n});
  }

  // Shows an image left of a divider.
  setLeft(i) { this.set({left: i === this.state.compare ? -1 : i, mode: 'wipe'}); }

  // Shows the next image left of the divider that is not right of it.
  stepLeft() {
    const n = this.images.length, now = leftImage(this.state, this.images);
    const step = (now + 1) % n === this.state.current ? 2 : 1;
    this.setLeft((now + step) % n);
  }

  stepError(by) {
    const n = ERROR_ORDER.length;
    this.set({error: ERROR_ORDER[(ERROR_ORDER.indexOf(this.state.error) + by + n) % n]});
  }

  expose(stops) { this.set({stops: Math.min(30, Math.max(-30, this.state.stops + stops))}); }

  toggleLog() {
    const {error, log} = this.state;
    if (!canBeLog(error)) return;
    this.set({log: {...log, [error]: !this.painter.isLog()}});
  }

  toggleTone() { this.set({tone: this.state.tone === 'srgb' ? 'false' : 'srgb'}); }

  // Moves by CSS pixels.
  pan(dx, dy) {
    this.camera.pan(dx, dy);
    this.redraw();
  }

  fit() {
    this.camera.fit();
    this.redraw();
  }

  // Zooms about a position in the stage (CSS pixels), or about the centre. Returns false if nothing
  // moved.
  zoom(factor, x, y) {
    if (this.camera.scale === undefined) this.draw();  // the first drawing places the views
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
