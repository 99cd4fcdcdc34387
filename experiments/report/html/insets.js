// Insets: enlarged crops below the picture, of every image side by side, with their own errors.
// The state keeps each as [x, y, width, height] in shares of the picture's size: the resolution may
// change.

const MOST_INSETS = 4;
const INSET_COLOURS = ['#ff5a4f', '#39c0ff', '#ffd23f', '#6be675'];
// Largest height of a crop in CSS pixels, and the size of one of a whole picture, as a share of it.
const INSET_HEIGHT = 132, INSET_SHARE = 1 / 8;
// Smallest width of a crop in CSS pixels: its errors have room; a row that is wider scrolls.
const INSET_WIDTH = 84;
// Border of the crops and gap between two insets in one row, as in style.css.
const INSET_BORDER = 3, INSET_GAP = 16;

// Returns the pixels [x, y, width, height] of an inset of a picture; at least one.
function insetPixels([x, y, width, height], picture) {
  const place = (from, size, all) => {
    const first = Math.min(Math.round(from * all), all - 1);
    return [first, Math.max(1, Math.min(Math.round(size * all), all - first))];
  };
  const [left, across] = place(x, width, picture.width);
  const [top, down] = place(y, height, picture.height);
  return [left, top, across, down];
}

// Returns pixels as shares, with digits enough to find the pixels again.
function insetShares([x, y, across, down], {width, height}) {
  return [x / width, y / height, across / width, down / height].map(
      share => Number(share.toPrecision(7)));
}

// Returns the insets among values from elsewhere: four at most, inside the picture.
function validInsets(values) {
  const isShare = value => Number.isFinite(value) && value >= 0 && value <= 1;
  const isInset = value => Array.isArray(value) && value.length === 4 && value.every(isShare) &&
      value[2] > 0 && value[3] > 0;
  return Array.isArray(values) ? values.filter(isInset).slice(0, MOST_INSETS) : [];
}

// Returns the rectangle that a new inset takes: the chosen one; or else the part of the picture that
// a view shows; of a whole picture the surroundings of the pixel under the pointer, or of the middle.
function insetHere(viewer) {
  const {camera, stage, pixel} = viewer, {width, height} = camera, chosen = viewer.state.rectangle;
  if (chosen) {
    const [left, top, right, bottom] = chosen;
    return insetShares([left, top, right - left, bottom - top], camera);
  }
  const [x0, y0, x1, y1] = shownPixels(camera, stage.views[0], width, height);
  if (x1 - x0 < width || y1 - y0 < height) {
    return insetShares([x0, y0, x1 - x0, y1 - y0], camera);
  }
  const {x, y} = pixel || {x: width / 2, y: height / 2};
  const place = (at, all) => {
    const size = Math.ceil(INSET_SHARE * all);
    return [Math.round(Math.min(Math.max(at + 0.5 - size / 2, 0), all - size)), size];
  };
  const [left, across] = place(x, width), [top, down] = place(y, height);
  return insetShares([left, top, across, down], camera);
}

// Draws the frames of the insets into a view.
function drawInsetFrames(context, camera, view, insets) {
  insets.forEach((inset, k) => {
    const [x, y, width, height] = insetPixels(inset, camera);
    const [left, top] = camera.toView(view, x, y);
    context.beginPath();
    context.rect(left, top, width * camera.scale, height * camera.scale);
    strokeOnAll(context, 2, INSET_COLOURS[k]);
  });
}

class Insets {
  constructor(viewer) {
    this.viewer = viewer;
    this.boxes = [];
    this.errors = new SlotCache();
    this.element = make('div', {class: 'insets', role: 'group', 'aria-label': 'Insets',
                                hidden: ''});
  }

  get list() { return this.viewer.state.insets; }

  add() { this.viewer.set({insets: [...this.list, insetHere(this.viewer)]}); }

  remove(k) { this.viewer.set({insets: this.list.filter((_, i) => i !== k)}); }

  // Returns the place of an inset as `restlab figure --crop` takes it.
  text(inset) {
    const {camera, data} = this.viewer, [x, y, width, height] = insetPixels(inset, camera);
    return [x + data.x, y + data.y, width, height].join(',');
  }

  show() {
    const {list, boxes} = this;
    this.element.hidden = !list.length;
    while (boxes.length > list.length) boxes.pop().element.remove();
    while (boxes.length < list.length) boxes.push(this.makeBox(boxes.length));
    list.forEach((inset, k) => this.showBox(boxes[k], inset, k));
  }

  makeBox(k) {
    const place = make('code', {}), canvas = make('canvas', {role: 'img'});
    const close = makeButton('\u00d7', 'take this inset away', () => this.remove(k));
    const captions = make('div', {class: 'inset-captions'});
    const element = make('div', {class: 'inset', role: 'group'},
                         make('p', {class: 'inset-head'}, place, close), canvas, captions);
    element.style.setProperty('--inset', INSET_COLOURS[k]);
    this.element.append(element);
    const {images, painter, camera} = this.viewer;
    const own = new Camera(camera.width, camera.height);
    return {element, place, captions, stage: new Stage(canvas, own, images, painter)};
  }

  showBox({place, captions, stage}, inset, k) {
    const {viewer} = this, {images, state, camera} = viewer;
    const pixels = insetPixels(inset, camera), [x, y, width, height] = pixels, n = images.length;
    // Two in a row, unless their crops would be too small.
    const columns = state.insets.length > 1 && n < 5 ? 2 : 1;
    const across = (this.element.clientWidth - INSET_GAP * (columns - 1)) / columns;
    const room = across - 2 * INSET_BORDER - VIEW_GAP * (n - 1);
    const cell = Math.max(INSET_WIDTH, Math.floor(Math.min(room / n, INSET_HEIGHT * width / height)));
    const scale = cell / width;
    Object.assign(stage.camera, {width: camera.width, height: camera.height, fitted: false, scale,
                                 x: x + width / 2, y: y + height / 2});
    const down = Math.max(8, Math.round(scale * height));
    stage.views = images.map((image, i) => ({
      x: i * (cell + VIEW_GAP), y: 0, width: cell, height: down, image: i,
      isError: isErrorView(state, images, i)
    }));
    Object.assign(stage, {state: {...state, insets: []}, width: n * (cell + VIEW_GAP) - VIEW_GAP,
                          height: down});
    stage.canvas.style.width = `${stage.width}px`;
    stage.draw(viewer.pixel, -1);
    setText(place, this.text(inset));
    const errors = images.map((_, i) => this.errorsOf(k, i, pixels));
    const texts = images.map((image, i) => [image.name, ...insetNumbers(errors[i])]);
    stage.canvas.setAttribute('aria-label', `${this.text(inset)} of ${
        texts.map(words => words.join(' ')).join('; ')}`);
    captions.style.gridTemplateColumns = `repeat(${n}, ${cell}px)`;
    this.showCaptions(captions, texts);
  }

  errorsOf(k, i, pixels) {
    const {images, state, stage} = this.viewer, image = images[i];
    const reference = images[state.compare];
    if (i === state.compare || !stage.hasCameraSize(image) || !areComparable(image, reference)) {
      return null;
    }
    const key = [pixels, state.compare, versionOf(image), image.epoch, versionOf(reference),
                 reference.epoch].join(' ');
    return this.errors.get(`${k} ${i}`, key, () => regionErrors(image, reference, pixels));
  }

  showCaptions(captions, texts) {
    while (captions.children.length > texts.length) captions.lastChild.remove();
    while (captions.children.length < texts.length) {
      captions.append(make('p', {}, make('span', {}), make('span', {class: 'num'}),
                           make('span', {class: 'num'})));
    }
    texts.forEach((words, i) => words.forEach(
                      (text, part) => setText(captions.children[i].children[part], text)));
  }
}

// Returns the lines of a crop's errors.
function insetNumbers(errors) {
  return errors ? [`MSE ${shortNumber(errors.mse)}`, `relMSE ${shortNumber(errors.relmse)}`]
                : ['', ''];
}
