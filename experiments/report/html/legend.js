// The legend of what is shown: a bar with numbers, or one line.

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

// `painter` as the stage has it, `names` of the images.
function showLegend(element, state, painter, names) {
  const parts = [];
  if (state.error !== 'none') {
    const info = ERRORS[state.error];
    const scale = painter.errorScale();
    parts.push(make('p', {class: 'legend-title'}, make('b', {}, info.title),
                    `: ${info.formula}, d = image \u2212 r, r = ${names[state.compare]}` +
                        (info.signed ? '; blue: darker than r, orange: brighter' : '') +
                        (scale.log ? '; logarithmic' : '')));
    parts.push(legendBar(scale));
  } else if (state.tone === 'false') {
    parts.push(make('p', {class: 'legend-title'}, make('b', {}, 'luminance'),
                    ': 0.2126 R + 0.7152 G + 0.0722 B of linear radiance; logarithmic'));
    parts.push(legendBar(painter.luminanceScale()));
  } else {
    parts.push(make('p', {class: 'legend-title'}, make('b', {}, 'radiance'),
                    ` \u00d7 ${shortNumber(painter.factor)} as sRGB, clipped to 0 and 1`));
  }
  if (painter.images.some(image => image.nonfinite.length)) {
    parts.push(make('p', {class: 'legend-title'}, swatch(NAN_COLOUR, 'NaN'), ' ',
                    swatch(INF_COLOUR, 'infinite'), ' in a box of their own'));
  }
  element.replaceChildren(...parts);
}
