// The canvas of a viewer: one view, two in one place with a divider, or all images side by side.

const VIEW_GAP = 6;

// The columns for n views of these proportions that make them largest.
function bestColumns(n, width, mostHeight, aspect) {
  let best = 1, bestWidth = 0;
  for (let columns = 1; columns <= n; ++columns) {
    const rows = Math.ceil(n / columns);
    const byWidth = (width - VIEW_GAP * (columns - 1)) / columns;
    const byHeight = (mostHeight - VIEW_GAP * (rows - 1)) / rows * aspect;
    const size = Math.min(byWidth, byHeight);
    // A little larger is not worth a row more.
    if (size > bestWidth * 1.02) [best, bestWidth] = [columns, size];
  }
  return best;
}

// {height, views: [{x, y, width, height, image, isError, clip: [left, right] or absent}]} in CSS
// pixels. Of two views in one place the divider shows the left part of the first.
function layOut(state, images, width) {
  const aspect = images[0].width / images[0].height;
  const mostHeight = Math.max(240, 0.78 * window.innerHeight);
  const isError = i => state.error !== 'none' && i !== state.compare;
  if (state.mode === 'side') {
    const columns = bestColumns(images.length, width, mostHeight * (width < 600 ? 2 : 1), aspect);
    const rows = Math.ceil(images.length / columns);
    const cellWidth = (width - VIEW_GAP * (columns - 1)) / columns;
    const cellHeight = Math.min(cellWidth / aspect, (2 * mostHeight - VIEW_GAP * (rows - 1)) / rows);
    const views = images.map((image, i) => ({
                               x: (i % columns) * (cellWidth + VIEW_GAP),
                               y: Math.floor(i / columns) * (cellHeight + VIEW_GAP),
                               width: cellWidth, height: cellHeight, image: i, isError: isError(i)
                             }));
    return {height: rows * cellHeight + VIEW_GAP * (rows - 1), views};
  }
  const height = Math.min(width / aspect, mostHeight);
  const whole = {x: 0, y: 0, width, height};
  const shown = state.held ? state.compare : state.current;
  if (state.mode === 'wipe') {
    const at = state.wipe * width;
    return {height, views: [
      {...whole, image: state.compare, isError: false, clip: [0, at]},
      {...whole, image: shown, isError: isError(shown), clip: [at, width]}
    ]};
  }
  return {height, views: [{...whole, image: shown, isError: isError(shown)}]};
}

class Stage {
  // `painter` gives the picture of a view and the texts of its pixels.
  constructor(canvas, camera, images, painter) {
    Object.assign(this, {canvas, camera, images, painter, views: []});
  }

  // Places the views for a stage of `width` CSS pixels.
  arrange(state, width) {
    const layout = layOut(state, this.images, width);
    Object.assign(this, {views: layout.views, width, height: layout.height});
    this.camera.adapt(this.views[0].width, this.views[0].height);
  }

  // `pixel` is marked in all views but `overView`, which the pointer is over; null: nowhere.
  draw(pixel, overView) {
    const ratio = window.devicePixelRatio || 1;
    const pixels = [Math.round(this.width * ratio), Math.round(this.height * ratio)];
    this.canvas.style.height = `${this.height}px`;
    if (this.canvas.width !== pixels[0] || this.canvas.height !== pixels[1]) {
      [this.canvas.width, this.canvas.height] = pixels;
    }
    const context = this.canvas.getContext('2d');
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, this.width, this.height);
    this.views.forEach((view, k) => {
      // Views in one place share the pointer.
      const elsewhere = pixel && k !== overView && !view.clip;
      this.drawView(context, view, elsewhere ? pixel : null);
    });
  }

  drawView(context, view, pixel) {
    const {camera} = this, image = this.images[view.image];
    context.save();
    context.beginPath();
    const [left, right] = view.clip || [view.x, view.x + view.width];
    context.rect(left, view.y, right - left, view.height);
    context.clip();
    const shown = shownPixels(camera, view, image.width, image.height);
    const [x0, y0, x1, y1] = shown;
    if (x1 > x0 && y1 > y0) {
      const [dx, dy] = camera.toView(view, x0, y0);
      context.imageSmoothingEnabled = camera.scale * (window.devicePixelRatio || 1) < 1;
      context.imageSmoothingQuality = 'high';
      context.drawImage(this.painter.layer(view), x0, y0, x1 - x0, y1 - y0, dx, dy,
                        (x1 - x0) * camera.scale, (y1 - y0) * camera.scale);
      if (camera.scale >= GRID_FROM) drawGrid(context, camera, view, shown);
      if (camera.scale >= VALUES_FROM) {
        drawValues(context, camera, view, shown, image.width, i => this.painter.texts(view, i),
                   i => this.painter.isLight(view, i));
      }
    }
    drawNonfinite(context, camera, view, image);
    if (pixel) drawPointer(context, camera, view, pixel);
    context.restore();
  }

  // The view and the pixel at a position in CSS pixels of the canvas, or null.
  hit(x, y) {
    for (let k = 0; k < this.views.length; ++k) {
      const view = this.views[k];
      const [left, right] = view.clip || [view.x, view.x + view.width];
      if (x < left || x >= right || y < view.y || y >= view.y + view.height) continue;
      const [px, py] = this.camera.toImage(view, x, y).map(Math.floor);
      const image = this.images[view.image];
      const inside = px >= 0 && py >= 0 && px < image.width && py < image.height;
      return {view: k, pixel: inside ? {x: px, y: py} : null};
    }
    return null;
  }
}
