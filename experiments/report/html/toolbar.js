// The buttons above a viewer. Everything here has a key too.
class Toolbar {
  constructor(viewer) {
    const set = change => viewer.set(change);
    this.mode = makeChoice('View', [
      ['single', 'Single', 'one image at a time: flip with 1\u20139, \u2190, \u2192 (s)'],
      ['wipe', 'Wipe', 'two images and a divider to drag (w)'],
      ['side', 'Side by side', 'all images at the same place (b)']
    ], mode => set({mode}));
    this.error = makeChoice('Error view', [
      ['none', 'Image', 'no error view (n: next)'],
      ...Object.entries(ERRORS).map(
          ([kind, info]) => [kind, kind[0].toUpperCase() + kind.slice(1), info.formula])
    ], error => set({error}));
    this.tone = makeChoice('Colours', [
      ['srgb', 'sRGB', 'radiance times exposure, clipped (t)'],
      ['false', 'False colour', 'luminance on a logarithmic scale (t)']
    ], tone => set({tone}));
    this.log = makeButton('log', 'linear or logarithmic error scale (l)', () => viewer.toggleLog());
    this.stops = make('output', {title: 'exposure'});
    this.scale = make('output', {title: 'screen pixels a pixel'});
    const exposure = make('div', {class: 'group', role: 'group', 'aria-label': 'Exposure'},
                          makeButton('\u2212', 'exposure down half a stop (E)',
                                     () => viewer.expose(-0.5)),
                          this.stops,
                          makeButton('+', 'exposure up half a stop (e)', () => viewer.expose(0.5)),
                          makeButton('reset', 'exposure as at first (r)', () => set({stops: 0})));
    const zoom = make('div', {class: 'group', role: 'group', 'aria-label': 'Zoom'},
                      makeButton('\u2212', 'zoom out (\u2212)', () => viewer.zoom(1 / 1.5)),
                      this.scale,
                      makeButton('+', 'zoom in (+)', () => viewer.zoom(1.5)),
                      makeButton('fit', 'fit into the window (f)', () => viewer.fit()),
                      makeButton('1:1', 'one screen pixel a pixel (0)', () => viewer.actualSize()));
    const help = makeButton('?', 'keys (?)', () => viewer.root.dispatchEvent(
                                                 new CustomEvent('help', {bubbles: true})));
    this.error.element.append(this.log);
    this.element = make('div', {class: 'toolbar', role: 'group', 'aria-label': 'Image viewer'},
                        this.mode.element, this.error.element, this.tone.element, exposure, zoom,
                        make('div', {class: 'group'}, help));
  }

  show(state, painter) {
    this.mode.show(state.mode);
    this.error.show(state.error);
    this.tone.show(state.tone);
    const canBeLog = state.error !== 'none' && !ERRORS[state.error].signed;
    this.log.disabled = !canBeLog;
    this.log.setAttribute('aria-pressed', canBeLog && painter.isLog());
    const sign = state.stops < 0 ? '\u2212' : '+';
    this.stops.textContent = `${sign}${Math.abs(state.stops).toFixed(1)} EV`;
  }

  showZoom(camera) {
    const scale = camera.scale * (window.devicePixelRatio || 1);
    this.scale.textContent = `${scale >= 1 ? shortNumber(scale) : scale.toPrecision(2)}\u00d7`;
  }
}
