// Rectangle of pixels, [x0, y0, x1, y1] with the ends excluded: chosen by a drag or by keys.

// Returns the rectangle with both pixels {x, y}.
function rectangleOf(a, b) {
  return [Math.min(a.x, b.x), Math.min(a.y, b.y), Math.max(a.x, b.x) + 1, Math.max(a.y, b.y) + 1];
}

// True for a rectangle of whole pixels inside an image of this size.
function isRectangleIn(value, width, height) {
  if (!Array.isArray(value) || value.length !== 4 || !value.every(Number.isInteger)) return false;
  const [x0, y0, x1, y1] = value;
  return x0 >= 0 && y0 >= 0 && x0 < x1 && y0 < y1 && x1 <= width && y1 <= height;
}

// Returns the rectangle moved by whole pixels, or with its right and lower side moved; it stays
// inside the image and keeps a pixel at least.
function movedRectangle([x0, y0, x1, y1], [dx, dy], isSize, {width, height}) {
  const clamp = (value, lo, hi) => Math.min(hi, Math.max(lo, value));
  if (isSize) return [x0, y0, clamp(x1 + dx, x0 + 1, width), clamp(y1 + dy, y0 + 1, height)];
  const x = clamp(x0 + dx, 0, width - (x1 - x0)), y = clamp(y0 + dy, 0, height - (y1 - y0));
  return [x, y, x + x1 - x0, y + y1 - y0];
}

// Options of `restlab figure` for these pixels and the exposure that is shown.
function cropOptions(viewer, [x0, y0, x1, y1]) {
  const {data, painter} = viewer;
  return `--crop ${x0 + data.x},${y0 + data.y},${x1 - x0},${y1 - y0} --exposure ${
      Number(painter.factor.toPrecision(6))}`;
}

function drawRectangle(context, camera, view, [x0, y0, x1, y1]) {
  const [left, top] = camera.toView(view, x0, y0), [right, bottom] = camera.toView(view, x1, y1);
  context.beginPath();
  context.rect(left, top, right - left, bottom - top);
  strokeOnAll(context, 1.5, '#fd0');
}

// Choosing of a rectangle in a viewer. While `isOn` the next drag chooses and arrow keys move.
class RectangleChoice {
  constructor(viewer) { Object.assign(this, {viewer, isOn: false}); }

  setOn(isOn) {
    this.isOn = isOn;
    const {viewer} = this;
    viewer.set(isOn && !viewer.state.rectangle ? {rectangle: this.first()} : {});
  }

  // Returns a rectangle about the pixel under the pointer, or about the middle of the view.
  first() {
    const {camera, stage, pixel} = this.viewer, [view] = stage.views;
    const [x, y] = pixel ? [pixel.x, pixel.y]
                         : camera.toImage(view, view.x + view.width / 2, view.y + view.height / 2)
                               .map(Math.floor);
    const size = Math.max(1, Math.floor(Math.min(camera.width, camera.height) / 8));
    return movedRectangle([0, 0, size, size],
                          [x - Math.floor(size / 2), y - Math.floor(size / 2)], false, camera);
  }

  // Begins a drag, as `pointer` of pointer.js; null if this drag chooses no rectangle.
  drag(event, hit) {
    if (!(event.shiftKey || this.isOn) || !hit) return null;
    const {viewer} = this, view = viewer.stage.views[hit.view];
    const pixelAt = ([x, y]) => {
      const {camera} = viewer, [px, py] = camera.toImage(view, x, y).map(Math.floor);
      return {x: Math.min(camera.width - 1, Math.max(0, px)),
              y: Math.min(camera.height - 1, Math.max(0, py))};
    };
    const first = pixelAt(viewer.pointerAt(event));
    return {
      isRectangle: true,
      move: (dx, dy, moved) => {
        this.isOn = false;
        viewer.set({rectangle: rectangleOf(first, pixelAt(viewer.pointerAt(moved)))});
      },
      end: () => { if (viewer.state.rectangle) viewer.tools.reveal(); }
    };
  }

  move(way, isSize) {
    const {state, camera} = this.viewer;
    this.viewer.set({rectangle: movedRectangle(state.rectangle, way, isSize, camera)});
  }

  clear() {
    this.isOn = false;
    this.viewer.set({rectangle: null});
  }
}

// Commands of the rectangle. They precede others: while it is chosen, arrow keys are theirs.
function rectangleCommands() {
  const group = 'Rectangle', isThere = viewer => viewer.state.rectangle !== null;
  const isChosen = viewer => isThere(viewer) && viewer.rectangle.isOn;
  const ways = {Left: [-1, 0], Right: [1, 0], Up: [0, -1], Down: [0, 1]};
  const arrows = (verb, isSize) => Object.entries(ways).map(([name, way], i) => ({
    id: `rectangle-${verb}-${name.toLowerCase()}`,
    keys: [`${isSize ? 'Shift+' : ''}Arrow${name}`], group, when: isChosen,
    title: `${verb} the rectangle by a pixel: ${name.toLowerCase()}`,
    row: i ? null : [`${isSize ? 'Shift + ' : ''}\u2190 \u2192 \u2191 \u2193`,
                     `${verb} the rectangle, after j`],
    run: viewer => viewer.rectangle.move(way, isSize)
  }));
  return [
    {id: 'rectangle', keys: ['j'], group, row: ['j, Shift + drag', 'choose a rectangle of pixels'],
     title: 'choose a rectangle of pixels: by the next drag or by arrows, or end that',
     run: viewer => viewer.rectangle.setOn(!viewer.rectangle.isOn)},
    ...arrows('move', false), ...arrows('size', true),
    {id: 'rectangle-off', keys: ['Escape'], group, title: 'take the rectangle away',
     when: isThere, run: viewer => viewer.rectangle.clear()}
  ];
}
