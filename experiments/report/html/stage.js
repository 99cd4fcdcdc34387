// Canvas of a viewer: one view, two in one place with a divider, or all images side by side.

const VIEW_GAP = 6;

// Returns the number of columns that makes n views of this aspect ratio largest.
function bestColumns(n, width, mostHeight, aspect) {
  let best = 1, bestWidth = 0;
  for (let columns = 1; columns <= n; ++columns) {
    const rows = Math.ceil(n / columns);
    const byWidth = (width - VIEW_GAP * (columns - 1)) / columns;
    const byHeight = (mostHeight - VIEW_GAP * (rows - 1)) / rows * aspect;
    const size = Math.min(byWidth, byHeight);
    // A slightly larger size is not worth another row.
    if (size > bestWidth * 1.02) [best, bestWidth] = [columns, size];
  }
  return best;
}

// True if two images can be compared pixel by pixel. Images of a live page have an epoch: those since
// `pictureEpoch` show the same camera and light.
function areComparable(a, b) {
  const isOfPicture = image => image.epoch >= image.pictureEpoch;
  return Boolean(a.data && b.data) && a.data.length === b.data.length && a.width === b.width &&
      a.height === b.height && (a.epoch === b.epoch || (isOfPicture(a) && isOfPicture(b)));
}

// True if an image is shown by its error: not what it is compared with.
function isErrorView({error, compare}, images, i) {
  return error !== 'none' && i !== compare && areComparable(images[i], images[compare]);
}

// Returns the image left of the divider: what is compared with, unless another one was chosen.
function leftImage({left, compare}, images) { return images[left] ? left : compare; }

// Returns {height, views: [{x, y, width, height, image, isError, clip: [left, right] or absent}]}
// in CSS pixels. With a divider the first view is left of it, the second right of it. `room`:
// {width, mostHeight, isFilled}; `aspect` of the images, width over height.
function layOut(state, images, aspect, room) {
  const {width, mostHeight} = room;
  const isError = i => isErrorView(state, images, i);
  if (state.mode === 'side' && !state.held) {
    // Fit all views into the window, unless it is narrow.
    const sideHeight = mostHeight * (width < 600 && !room.isFilled ? 2 : 1);
    const columns = bestColumns(images.length, width, sideHeight, aspect);
    const rows = Math.ceil(images.length / columns);
    const cellWidth = (width - VIEW_GAP * (columns - 1)) / columns;
    const mostCell = (sideHeight - VIEW_GAP * (rows - 1)) / rows;
    const cellHeight = room.isFilled ? mostCell : Math.min(cellWidth / aspect, mostCell);
    const views = images.map((image, i) => {
      const row = Math.floor(i / columns), isLast = row === rows - 1;
      // If the stage has a fixed size, stretch a shorter last row to leave no gap.
      const n = room.isFilled && isLast ? images.length - columns * row : columns;
      const cell = (width - VIEW_GAP * (n - 1)) / n;
      return {x: (i - columns * row) * (cell + VIEW_GAP), y: row * (cellHeight + VIEW_GAP),
              width: cell, height: cellHeight, image: i, isError: isError(i)};
    });
    return {height: rows * cellHeight + VIEW_GAP * (rows - 1), views};
  }
  const height = room.isFilled ? mostHeight : Math.min(width / aspect, mostHeight);
  const whole = {x: 0, y: 0, width, height};
  const shown = state.held ? state.compare : state.current;
  if (state.mode === 'wipe') {
    const at = state.wipe * width, left = leftImage(state, images);
    return {height, views: [
      {...whole, image: left, isError: isError(left), clip: [0, at]},
      {...whole, image: shown, isError: isError(shown), clip: [at, width]}
    ]};
  }
  return {height, views: [{...whole, image: shown, isError: isError(shown)}]};
}

// Draws a placeholder for an image that has not arrived yet.
function drawWaiting(context, view, x, y, width, height) {
  context.fillStyle = '#55585e';
  context.fillRect(x, y, width, height);
  context.fillStyle = '#fff';
  context.font = '14px system-ui, sans-serif';
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  context.fillText('waiting for the first frame', view.x + view.width / 2,
                   view.y + view.height / 2);
}

class Stage {
  // `painter` provides the picture of a view and the texts of its pixels.
  constructor(canvas, camera, images, painter) {
    Object.assign(this, {canvas, camera, images, painter, views: []});
  }

  // Places the views in the stage; `room` as in layOut().
  arrange(state, room) {
    const {camera} = this;
    const layout = layOut(state, this.images, camera.width / camera.height, room);
    Object.assign(this, {state, views: layout.views, width: room.width, height: layout.height});
    camera.adapt(this.views[0].width, this.views[0].height);
  }

  // Marks `pixel` in all views except `overView`, the one under the pointer; null: no mark.
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
      // Views in one place are both under the pointer.
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
    const shown = shownPixels(camera, view, camera.width, camera.height);
    if (shown[2] > shown[0] && shown[3] > shown[1]) this.drawPicture(context, view, shown);
    drawInsetFrames(context, camera, view, this.state.insets);
    if (image.data && this.hasCameraSize(image)) drawNonfinite(context, camera, view, image);
    if (image.marks) {
      drawMarks(context, camera, view, image.marks);
      drawPath(context, camera, view, image.path || []);
    }
    if (this.state.rectangle) drawRectangle(context, camera, view, this.state.rectangle);
    if (pixel) drawPointer(context, camera, view, pixel);
    context.restore();
  }

  hasCameraSize(image) {
    return image.width === this.camera.width && image.height === this.camera.height;
  }

  // Draws the image pixels `shown` of a view, their overlay, grid, numbers and marks.
  drawPicture(context, view, shown) {
    const {camera, painter} = this, image = this.images[view.image];
    const [x0, y0, x1, y1] = shown, [dx, dy] = camera.toView(view, x0, y0);
    const place = [dx, dy, (x1 - x0) * camera.scale, (y1 - y0) * camera.scale];
    if (!image.data) {
      drawWaiting(context, view, ...place);
      return;
    }
    const draw = (canvas, width, height) => {
      const sx = width / camera.width, sy = height / camera.height;
      context.imageSmoothingEnabled = camera.scale * (window.devicePixelRatio || 1) < sx;
      context.imageSmoothingQuality = 'high';
      context.drawImage(canvas, x0 * sx, y0 * sy, (x1 - x0) * sx, (y1 - y0) * sy, ...place);
    };
    const layer = painter.layer(view);
    if (layer) draw(layer, image.width, image.height);
    const overlay = image.overlay && painter.overlayLayer(view);
    if (overlay) {
      context.globalAlpha = this.state.opacity;
      draw(overlay, overlay.width, overlay.height);
      context.globalAlpha = 1;
    }
    if (camera.scale >= GRID_FROM) drawGrid(context, camera, view, shown);
    if (camera.scale >= VALUES_FROM && this.hasCameraSize(image)) {
      drawValues(context, camera, view, shown, image.width, i => painter.texts(view, i),
                 i => painter.isLight(view, i));
    }
  }

  // Returns the view and the pixel at a canvas position in CSS pixels, or null.
  hit(x, y) {
    for (let k = 0; k < this.views.length; ++k) {
      const view = this.views[k];
      const [left, right] = view.clip || [view.x, view.x + view.width];
      if (x < left || x >= right || y < view.y || y >= view.y + view.height) continue;
      const [px, py] = this.camera.toImage(view, x, y).map(Math.floor);
      const {width, height} = this.camera;
      const inside = px >= 0 && py >= 0 && px < width && py < height;
      return {view: k, pixel: inside ? {x: px, y: py} : null};
    }
    return null;
  }
}
