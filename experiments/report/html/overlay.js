// Draws over an enlarged picture: grid, values, marks. All functions take a view (CSS pixels); the
// caller clips to it.

// Sizes of an image pixel from which grid and values are drawn, in CSS pixels.
const GRID_FROM = 14, VALUES_FROM = 56;
const MOST_MARKS = 400;

// Returns the image pixels in a view as [x0, y0, x1, y1], the ends excluded.
function shownPixels(camera, view, width, height) {
  const [left, top] = camera.toImage(view, view.x, view.y);
  const [right, bottom] = camera.toImage(view, view.x + view.width, view.y + view.height);
  return [Math.max(0, Math.floor(left)), Math.max(0, Math.floor(top)),
          Math.min(width, Math.ceil(right)), Math.min(height, Math.ceil(bottom))];
}

function drawGrid(context, camera, view, shown) {
  const [x0, y0, x1, y1] = shown;
  context.beginPath();
  for (let x = x0; x <= x1; ++x) {
    const [at, top] = camera.toView(view, x, y0);
    context.moveTo(at, top);
    context.lineTo(at, camera.toView(view, x, y1)[1]);
  }
  for (let y = y0; y <= y1; ++y) {
    const [left, at] = camera.toView(view, x0, y);
    context.moveTo(left, at);
    context.lineTo(camera.toView(view, x1, y)[0], at);
  }
  context.strokeStyle = 'rgba(128,128,128,0.45)';
  context.lineWidth = 1;
  context.stroke();
}

// `lines(i)`: texts of pixel i; `isLight(i)`: true if its picture is light.
function drawValues(context, camera, view, shown, width, lines, isLight) {
  const [x0, y0, x1, y1] = shown;
  const size = Math.min(15, camera.scale / 5);
  context.font = `${size}px ui-monospace, Menlo, Consolas, 'DejaVu Sans Mono', monospace`;
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  for (let y = y0; y < y1; ++y) {
    for (let x = x0; x < x1; ++x) {
      const texts = lines(y * width + x);
      const [cx, cy] = camera.toView(view, x + 0.5, y + 0.5);
      context.fillStyle = isLight(y * width + x) ? '#000' : '#fff';
      texts.forEach((text, k) => context.fillText(
                        text, cx, cy + (k - (texts.length - 1) / 2) * 1.25 * size));
    }
  }
}

// Draws boxes around non-finite pixels: at least nine CSS pixels wide, to be visible in a picture
// of any size.
function drawNonfinite(context, camera, view, image) {
  const size = Math.max(9, camera.scale + 4);
  let marks = 0;
  for (const i of image.nonfinite) {
    const [x, y] =
        camera.toView(view, i % image.width + 0.5, Math.floor(i / image.width) + 0.5);
    if (x < view.x - size || x > view.x + view.width + size || y < view.y - size ||
        y > view.y + view.height + size) {
      continue;
    }
    if (++marks > MOST_MARKS) break;
    for (const [colour, thick] of [['#fff', 4], ['#f0f', 2]]) {
      context.strokeStyle = colour;
      context.lineWidth = thick;
      context.strokeRect(x - size / 2, y - size / 2, size, size);
    }
  }
}

// Marks the pointer's pixel in the views that the pointer is not over.
function drawPointer(context, camera, view, pixel) {
  const [x, y] = camera.toView(view, pixel.x, pixel.y);
  const size = Math.max(7, camera.scale);
  const left = camera.scale < 7 ? x - (7 - camera.scale) / 2 : x;
  const top = camera.scale < 7 ? y - (7 - camera.scale) / 2 : y;
  for (const [colour, thick] of [['#000', 3], ['#fff', 1]]) {
    context.strokeStyle = colour;
    context.lineWidth = thick;
    context.strokeRect(left, top, size, size);
  }
}

// Strokes in a light colour between dark edges, visible on any picture.
function strokeOnAll(context, thick, colour) {
  for (const [edge, width] of [['#000', thick + 2], [colour, thick]]) {
    context.strokeStyle = edge;
    context.lineWidth = width;
    context.stroke();
  }
}

// Draws a path over the picture, [{name, film: [x, y] or null, reconnected}]: a vertex that a shift
// traces again in blue, one that it keeps in orange, with the segment that leads there. A vertex behind the camera has no film.
function drawPath(context, camera, view, path) {
  const seen = path.map(({film}) => film && camera.toView(view, film[0], film[1]));
  const colourOf = ({reconnected}) => reconnected ? '#f91' : '#3cf';
  path.forEach((vertex, i) => {
    if (i === 0 || !seen[i - 1] || !seen[i]) return;
    context.beginPath();
    context.moveTo(...seen[i - 1]);
    context.lineTo(...seen[i]);
    strokeOnAll(context, 2, colourOf(vertex));
  });
  context.font = '11px sans-serif';
  context.textAlign = 'left';
  context.textBaseline = 'bottom';
  path.forEach((vertex, i) => {
    if (!seen[i]) return;
    const [x, y] = seen[i];
    context.fillStyle = '#000';
    context.fillRect(x - 4, y - 4, 8, 8);
    context.fillText(vertex.name, x + 7, y - 3);
    context.fillStyle = colourOf(vertex);
    context.fillRect(x - 3, y - 3, 6, 6);
    context.fillText(vertex.name, x + 6, y - 4);
  });
}

// Draws rings around pixels, [{x, y, kind: 'donor' | 'probe', state}], and lines from the probe to
// its donors: dashed if the shift was rejected, yellow to the selected one. The probe's ring is
// larger and thicker and is drawn last.
function drawMarks(context, camera, view, marks) {
  const rings = {donor: {radius: 5, thick: 1.5}, probe: {radius: 9, thick: 3}};
  const place = mark => camera.toView(view, mark.x + 0.5, mark.y + 0.5);
  const probe = marks.find(mark => mark.kind === 'probe');
  for (const kind of ['donor', 'probe']) {
    const {radius, thick} = rings[kind];
    const size = Math.max(radius, radius / 9 * camera.scale);
    for (const mark of marks) {
      if (mark.kind !== kind) continue;
      const [x, y] = place(mark);
      const colour = mark.state === 'selected' ? '#fd0' : '#fff';
      context.setLineDash(mark.state === 'rejected' ? [4, 4] : []);
      if (kind === 'donor' && probe) {
        context.beginPath();
        context.moveTo(...place(probe));
        context.lineTo(x, y);
        strokeOnAll(context, thick, colour);
      }
      const isOutside = x < view.x - size || x > view.x + view.width + size ||
          y < view.y - size || y > view.y + view.height + size;
      if (!isOutside) {
        context.beginPath();
        context.arc(x, y, size, 0, 2 * Math.PI);
        strokeOnAll(context, thick, colour);
      }
      context.setLineDash([]);
    }
  }
}
