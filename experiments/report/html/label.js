// Labels of the views: name, error and time of an image.

// Returns the error of the view's image, by the shown kind if there is one, else the MSE that is
// known of it (`image.mse`); '' if there is none.
function labelError(viewer, view) {
  const {state, images, painter, data} = viewer, image = images[view.image];
  if (state.error === 'none') return image.mse > 0 ? `MSE ${shortNumber(image.mse)}` : '';
  if (view.image === state.compare) return '';
  const plane = painter.plane(state.error, view.image), {metric} = ERRORS[state.error];
  return plane ? `${metric}${data.whole ? '' : ' of the crop'} ${shortNumber(plane.mean)}` : '';
}

// True on a live page if an image was rendered before the last change of what it shows.
function isOldImage({data, epoch, since}) { return Boolean(data) && epoch < since; }

// Returns the parts of a view's label, the least important ones last. `image.ms`: milliseconds.
function labelParts(viewer, view) {
  const {state, images} = viewer, image = images[view.image];
  // On a live page an image may be old, smaller while the camera moves, or being rendered.
  const isOld = isOldImage(image);
  const isSmall = image.data && image.width !== viewer.camera.width;
  const note = view.isError && isRestError(state.error)
      ? viewer.painter.rest.note(state.error, view.image, state.compare) : '';
  const error = view.isError ? ` \u2013 ${ERRORS[state.error].title}${note && ` (${note})`}` : '';
  const name = `${labelName(viewer, view)}${error}${
      isOld ? ' \u2013 before the change' : ''}${
      isSmall ? ` \u2013 ${image.width}\u00d7${image.height}` : ''}${
      image.progress ? ` \u2013 ${image.progress}` : ''}`;
  const ms = image.ms > 0 ? `${shortNumber(image.ms)} ms` : '';
  return [name, isOld ? '' : labelError(viewer, view), ms].filter(Boolean);
}

// Returns the label with as many parts as fit; the first one is in any case. `short`: another first
// part, which leaves more room for the second; '' if there is none.
function fittingLabel(parts, short, fits) {
  for (let n = parts.length; n > 1; --n) {
    const text = parts.slice(0, n).join('  ');
    if (fits(text)) return text;
  }
  const text = `${short}  ${parts[1]}`;
  return short && parts.length > 1 && fits(text) ? text : parts[0];
}

// Returns the key and the name of a view's image.
function labelName({images}, {image: i}) {
  return `${i < 9 ? `${i + 1}  ` : ''}${images[i].name}`;
}

// Returns the label of an error view without the name of the error, which the toolbar has, too.
function shortLabel(viewer, view) {
  return view.isError && !isOldImage(viewer.images[view.image]) ? labelName(viewer, view) : '';
}
