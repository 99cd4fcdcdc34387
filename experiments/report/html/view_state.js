// State of a view as an object for an address: what is shown, how bright and which part.

const isOneOf = (...values) => value => values.includes(value);
const isBetween = (lo, hi) => value => typeof value === 'number' && value >= lo && value <= hi;
const isIndexOf = (value, {images}) => Number.isInteger(value) && value in images;

// Test of each field's value, which comes from an address.
const VIEW_FIELDS = {
  mode: isOneOf('single', 'wipe', 'side'), current: isIndexOf, compare: isIndexOf,
  left: (value, viewer) => value === -1 || isIndexOf(value, viewer),
  insets: value => Array.isArray(value) && validInsets(value).length === value.length,
  error: value => ERROR_ORDER.includes(value), stops: isBetween(-30, 30),
  tone: isOneOf('srgb', 'false'), channel: value => CHANNEL_ORDER.includes(value),
  log: value => value !== null && typeof value === 'object' &&
      Object.values(value).every(one => typeof one === 'boolean'),
  wipe: isBetween(0, 1), opacity: isBetween(0, 1),
  histogram: value => typeof value === 'boolean',
  rectangle: (value, {camera}) => value === null ||
      isRectangleIn(value, camera.width, camera.height)
};

function viewState(viewer) {
  const view = Object.fromEntries(Object.keys(VIEW_FIELDS).map(key => [key, viewer.state[key]]));
  view.exposure = Number(viewer.painter.exposure.toPrecision(7));
  const {fitted, x, y, scale} = viewer.camera;
  if (!fitted) view.zoom = [x, y, scale].map(value => Number(value.toPrecision(6)));
  return view;
}

// Shows what the object says. Returns the names of fields whose value cannot be: they are left as
// they are.
function applyViewState(view, viewer) {
  const names = Object.keys(VIEW_FIELDS).filter(key => key in view);
  const wrong = names.filter(key => !VIEW_FIELDS[key](view[key], viewer));
  const right = names.filter(key => !wrong.includes(key));
  viewer.set(Object.fromEntries(right.map(key => [key, view[key]])));
  const {exposure, zoom} = view, {camera} = viewer;
  // The page's own exposure is of the time at which it was opened: the kept one wins.
  if (exposure > 0 && exposure < Infinity) viewer.setExposure(exposure);
  else if (exposure !== undefined) wrong.push('exposure');
  if (zoom === undefined) viewer.fit();
  else if (Array.isArray(zoom) && zoom.length === 3 && zoom.every(Number.isFinite) &&
           zoom[2] > 0 && zoom[2] <= camera.most) {
    const [x, y, scale] = zoom;
    Object.assign(camera, {fitted: false, x, y, scale});
    camera.keepInside();
    viewer.redraw();
  } else {
    wrong.push('zoom');
  }
  return wrong;
}
