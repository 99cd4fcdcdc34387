// Options of `restlab figure` for the insets, or for the chosen rectangle, or for the visible part of
// the picture.

function figureOptions(viewer) {
  viewer.draw();
  const {camera, stage, state, insets, painter} = viewer;
  if (!insets.list.length) {
    return cropOptions(viewer, state.rectangle ||
        shownPixels(camera, stage.views[0], camera.width, camera.height));
  }
  return [...insets.list.map(inset => `--crop ${insets.text(inset)}`),
          `--exposure ${Number(painter.factor.toPrecision(6))}`].join(' ');
}

async function giveCrop(page) {
  const text = figureOptions(page.viewer);
  if (await copyText(text)) {
    page.messages.notice(`copied for restlab figure: ${text}`);
  } else {
    downloadText('crop.txt', `${text}\n`);
    page.messages.notice(`for restlab figure: ${text}`);
  }
}
