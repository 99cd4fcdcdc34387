// Options of `restlab figure` for the visible part of the picture.

function figureOptions(viewer) {
  viewer.draw();
  const {camera, painter} = viewer;
  const [x0, y0, x1, y1] = shownPixels(camera, viewer.stage.views[0], camera.width, camera.height);
  return `--crop ${x0},${y0},${x1 - x0},${y1 - y0} --exposure ${
      Number(painter.factor.toPrecision(6))}`;
}

async function giveCrop(page) {
  const text = figureOptions(page.viewer);
  try {
    await navigator.clipboard.writeText(text);
    page.messages.notice(`copied for restlab figure: ${text}`);
  } catch {
    downloadText('crop.txt', `${text}\n`);
    page.messages.notice(`for restlab figure: ${text}`);
  }
}
