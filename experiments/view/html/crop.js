// Options of `restlab figure` for the chosen rectangle, or for the visible part of the picture.

function figureOptions(viewer) {
  viewer.draw();
  const {camera, stage, state} = viewer;
  return cropOptions(viewer, state.rectangle ||
      shownPixels(camera, stage.views[0], camera.width, camera.height));
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
