// Legend of a viewer: a bar with numbers, or one line.

function legendTicks(scale) {
  if (!scale.log) {
    return [0, 0.25, 0.5, 0.75, 1].map(at => [at, scale.lo + at * (scale.hi - scale.lo)]);
  }
  const base = scale.hi / scale.lo > 5000 && scale.map === MAPS.rising ? 10 : 4;
  const ticks = [];
  for (let value = scale.hi; value >= scale.lo * 0.999; value /= base) {
    ticks.unshift([scale.position(value), value]);
  }
  return ticks;
}

function legendBar(scale) {
  const bar = make('div', {class: 'bar', role: 'presentation'});
  bar.style.background = cssGradient(scale.map);
  const numbers = make('div', {class: 'numbers'});
  for (const [at, value] of legendTicks(scale)) {
    const tick = make('span', {}, shortNumber(value));
    tick.style.left = `${100 * at}%`;
    numbers.append(tick);
  }
  return make('div', {class: 'scale'}, bar, numbers);
}

function swatch(colour, text) {
  const box = make('span', {class: 'swatch'});
  box.style.background = `rgb(${colour.join(',')})`;
  return make('span', {class: 'key'}, box, text);
}

// True if an image has an error to show.
function isScaleThere(state, images) {
  const reference = images[state.compare];
  return images.some((image, i) => i !== state.compare && areComparable(image, reference));
}

// Returns what an error that is computed at rest was made with, or that it is to be made.
function restText({error, compare}, painter, images) {
  if (!isRestError(error)) return '';
  const maps = images.map((_, i) => painter.rest.map(error, i, compare)).filter(map => map);
  return maps.length ? maps[0].text
                     : 'computed once the picture has been the same for half a second';
}

// Returns the upper end of the scale of the overlay on image i.
function overlayEnd(painter, image, i) {
  const scale = image.overlay && painter.overlayScale ? painter.overlayScale(i) : null;
  return scale ? scale.hi : 0;
}

// Makes the legends of overlays; the painter knows the scale of each.
function overlayLegend(painter, images) {
  const shown = images.map((_, i) => i).filter(i => images[i].overlay);
  return shown.map(i => {
    const {name, unit} = images[i].overlay;
    const scale = painter.overlayScale ? painter.overlayScale(i) : null;
    const title = make('p', {class: 'legend-title'}, make('b', {}, name),
                       `${unit ? ` in ${unit}` : ''}, over ${images[i].name}${
                           painter.overlayText ? painter.overlayText(i) : ''}`);
    return scale ? make('div', {}, title, legendBar(scale)) : title;
  });
}

// `painter` as in stage.js. Leaves the page alone if nothing has changed.
function showLegend(element, state, painter, images) {
  const isError = state.error !== 'none' && isScaleThere(state, images);
  const scale = isError ? painter.errorScale() :
      state.error === 'none' && state.tone === 'false' ? painter.luminanceScale() : null;
  const mapText = isError ? restText(state, painter, images) : '';
  const key = [
    state.error, state.compare, mapText, state.tone, state.channel, painter.factor,
    scale && scale.lo, scale && scale.hi, scale && scale.log,
    images.some(image => image.nonfinite.length),
    ...images.map(image => `${image.name} ${image.overlay ? image.overlay.name : ''}`),
    ...images.map((image, i) => overlayEnd(painter, image, i)),
    ...images.map((image, i) => image.overlay && painter.overlayText ? painter.overlayText(i) : '')
  ].join('|');
  if (element.dataset.key === key) return;
  element.dataset.key = key;
  const parts = [], names = images.map(image => image.name);
  const isOne = ['r', 'g', 'b'].includes(state.channel);
  const what = isOne ? CHANNELS[state.channel].title : 'luminance';
  if (isError) {
    const info = ERRORS[state.error];
    parts.push(make('p', {class: 'legend-title'}, make('b', {}, info.title),
                    `: ${info.formula}${info.steps ? '' : ', d = image \u2212 r'}, r = ${
                        names[state.compare]}` +
                        (info.signed ? '; blue: darker than r, orange: brighter' : '') +
                        (mapText ? `; ${mapText}` : '') + (scale.log ? '; logarithmic' : '')));
    parts.push(legendBar(scale));
  } else if (state.error !== 'none') {
    parts.push(make('p', {class: 'legend-title'}, 'No error yet: an image is on its way.'));
  } else if (state.tone === 'false') {
    parts.push(make('p', {class: 'legend-title'}, make('b', {}, what), isOne ? ''
        : ': 0.2126 R + 0.7152 G + 0.0722 B of linear radiance', '; logarithmic'));
    parts.push(legendBar(scale));
  } else {
    const name = state.channel === 'rgb' ? 'radiance' : what;
    parts.push(make('p', {class: 'legend-title'}, make('b', {}, name),
                    ` \u00d7 ${shortNumber(painter.factor)} as sRGB, clipped to 0 and 1`));
  }
  if (images.some(image => image.nonfinite.length)) {
    parts.push(make('p', {class: 'legend-title'}, swatch(NAN_COLOUR, 'NaN'), ' ',
                    swatch(INF_COLOUR, 'infinite'), ' in a box of their own'));
  }
  parts.push(...overlayLegend(painter, images));
  element.replaceChildren(...parts);
}
