// Images of the page: the panes of a scene or the images of files, and the reference behind them.

// Most images that are first shown side by side: each of them has a key.
const MOST_BESIDE = 9;

function imageNames(state, hello) {
  const names = state.panes.map((pane, i) => hello.has_scene
      ? `${PANE_NAMES[i]}: ${paneName(pane, hello)}` : pane.source);
  return hello.has_reference ? [...names, 'reference'] : names;
}

// Returns the images of a state, which have not arrived yet.
function imagesOf(state, hello) {
  const {width, height} = state, names = imageNames(state, hello);
  return names.map((name, i) => ({
    name, role: i < state.panes.length ? 'method' : 'reference', width, height, data: null,
    nonfinite: [], version: 0, overlay: null, marks: null
  }));
}

// Shows other images, as of another table, and keeps the chosen ones by their names.
function replaceImages(viewer, images) {
  const {state} = viewer, last = images.length - 1;
  const found = (i, otherwise) => {
    const at = images.findIndex(one => one.name === viewer.images[i].name);
    return at < 0 ? otherwise : at;
  };
  const chosen = {current: found(state.current, 0), compare: found(state.compare, last),
                  left: state.left < 0 ? -1 : found(state.left, -1)};
  viewer.images.splice(0, viewer.images.length, ...images);
  viewer.painter.forget();
  viewer.list.build();
  viewer.set(chosen);
}
