// Toolbar of a viewer. Every button has a key, too.
class Toolbar {
  constructor(viewer) {
    const set = change => viewer.set(change);
    this.mode = makeChoice('View', [
      ['single', 'Single', commandTitle('single')],
      ['wipe', 'Wipe', commandTitle('wipe')],
      ['side', 'Side by side', commandTitle('side')]
    ], mode => set({mode}));
    this.error = makeList('error view', commandTitle('next-error'), [
      ['none', 'Image', 'radiance'],
      ...Object.entries(ERRORS).map(([kind, info]) => [kind, errorLabel(kind), info.formula])
    ], error => {
      set({error});
      viewer.root.focus({preventScroll: true});  // keys are the viewer's again
    });
    this.tone = makeChoice('Colours', [
      ['srgb', 'sRGB', 'radiance times exposure, clipped (t)'],
      ['false', 'False colour', 'luminance on a logarithmic scale (t)']
    ], tone => set({tone}));
    this.channel = makeList('channel', 'channel of the picture, not of its errors (u)',
                              CHANNEL_ORDER.map(key => [key, CHANNELS[key].name,
                                                        CHANNELS[key].title]),
                              channel => {
                                set({channel});
                                viewer.root.focus({preventScroll: true});
                              });
    this.channel.element.className = 'channel';
    this.log = makeButton('log', commandTitle('log'), () => viewer.toggleLog());
    this.stops = make('output', {title: 'exposure'});
    this.scale = make('output', {title: 'screen pixels a pixel'});
    const button = (text, id) => {
      const {run} = VIEWER_COMMANDS.find(command => command.id === id);
      const made = makeButton(text, commandTitle(id), () => run(viewer));
      made.dataset.command = id;
      return made;
    };
    const exposure = make('div', {class: 'group', role: 'group', 'aria-label': 'Exposure'},
                          button('\u2212', 'darker'), this.stops, button('+', 'brighter'),
                          button('reset', 'exposure-reset'), button('auto', 'auto-exposure'));
    const zoom = make('div', {class: 'group', role: 'group', 'aria-label': 'Zoom'},
                      button('\u2212', 'zoom-out'), this.scale, button('+', 'zoom-in'),
                      button('fit', 'fit'), button('1:1', 'actual'));
    this.histogram = button('histogram', 'histogram');
    this.rectangle = button('rectangle', 'rectangle');
    const tools = make('div', {class: 'group extra', role: 'group', 'aria-label': 'Tools'},
                       this.histogram, this.rectangle, button('link', 'link'));
    const search = button('\u2315', 'palette'), help = button('?', 'help');
    this.tone.element.append(this.channel.element);
    const error = make('div', {class: 'group', role: 'group', 'aria-label': 'Error view'},
                       this.error.element, this.log);
    this.element = make('div', {class: 'toolbar', role: 'group', 'aria-label': 'Image viewer'},
                        this.mode.element, error, this.tone.element, exposure, zoom, tools,
                        make('div', {class: 'group'}, search, help));
  }

  // `isChoosing`: the next drag chooses a rectangle.
  show(state, painter, isChoosing) {
    this.mode.show(state.mode);
    this.error.show(state.error);
    this.tone.show(state.tone);
    this.channel.show(state.channel);
    this.histogram.setAttribute('aria-pressed', state.histogram);
    this.rectangle.setAttribute('aria-pressed', isChoosing);
    this.log.disabled = !canBeLog(state.error);
    this.log.setAttribute('aria-pressed', state.error !== 'none' && painter.isLog());
    const sign = state.stops < 0 ? '\u2212' : '+';
    setText(this.stops, `${sign}${Math.abs(state.stops).toFixed(1)} EV`);
  }

  showZoom(camera) {
    const scale = camera.scale * (window.devicePixelRatio || 1);
    setText(this.scale, `${scale >= 1 ? shortNumber(scale) : scale.toPrecision(2)}\u00d7`);
  }
}
