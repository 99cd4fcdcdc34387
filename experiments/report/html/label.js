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

// Returns the parts of a view's label, the least important ones last. `image.ms`: milliseconds.
function labelParts(viewer, view) {
  const {state, images} = viewer, image = images[view.image];
  // On a live page: the image was rendered before the last change of what it shows, is smaller while
  // the camera moves, or is being rendered.
  const isOld = image.data && image.epoch < image.since;
  const isSmall = image.data && image.width !== viewer.camera.width;
  const note = view.isError && isRestError(state.error)
      ? viewer.painter.rest.note(state.error, view.image, state.compare) : '';
  const error = view.isError ? ` \u2013 ${ERRORS[state.error].title}${note && ` (${note})`}` : '';
  const name = `${view.image < 9 ? `${view.image + 1}  ` : ''}${image.name}${error}${
      isOld ? ' \u2013 before the change' : ''}${
      isSmall ? ` \u2013 ${image.width}\u00d7${image.height}` : ''}${
      image.progress ? ` \u2013 ${image.progress}` : ''}`;
  const ms = image.ms > 0 ? `${shortNumber(image.ms)} ms` : '';
  return [name, isOld ? '' : labelError(viewer, view), ms].filter(Boolean);
}

// Returns the label with as many parts as fit; the first one is in any case.
function fittingLabel(parts, fits) {
  for (let n = parts.length; n > 1; --n) {
    const text = parts.slice(0, n).join('  ');
    if (fits(text)) return text;
  }
  return parts[0];
}
