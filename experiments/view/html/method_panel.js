// Panel of the panes' methods: settings, parameters, the layer over the image. Everything is made
// from the program's descriptions; no method or parameter is known here.

const PANE_NAMES = ['A', 'B'];

// Returns a short name of the pane's method.
function methodName(pane, hello) {
  const info = hello.integrators.find(one => one.name === pane.integrator);
  const isFirstMode = !info || !info.modes.length || info.modes[0].name === pane.mode;
  return pane.integrator + (isFirstMode ? '' : ` ${pane.mode}`) +
      (pane.cache && pane.cache !== 'none' && info && info.uses_cache ? `, ${pane.cache}` : '') +
      (pane.denoiser && pane.denoiser !== 'none' ? ` + ${pane.denoiser}` : '');
}

const sourceText = source => source || 'a method';

// Returns the name of what a pane shows: a method, the reference or an image.
function paneName(pane, hello) { return pane.source || methodName(pane, hello); }

// Returns the choices of a pane's setting; null if there is nothing to choose.
function settingChoices(key, pane, hello) {
  const integrator = hello.integrators.find(one => one.name === pane.integrator);
  const option = (one, why) => ({
    value: one.name, text: one.name, disabled: one.available === false,
    title: one.available === false ? one.why_not : why || one.summary
  });
  if (key === 'mode') {
    const modes = integrator ? integrator.modes : [];
    return modes.map(mode => option(mode, `${mode.bias}: ${mode.why}`));
  }
  const list = hello[`${key}s`] || [];
  if (key === 'cache' && integrator && !integrator.uses_cache) return null;
  return list.map(one => option(one));
}

class PanePanel {
  // `folded`: names of groups that are folded in every pane.
  constructor(index, page, folded) {
    Object.assign(this, {index, page, folded, controls: new Map(), key: ''});
    const {sources} = page.hello;
    this.source = makeSelect(sources.map(value => ({value, text: sourceText(value)})),
                             value => this.send({do: 'set', key: 'source', value}),
                             {'data-setting': 'source'});
    this.noMethod = make('p', {class: 'hint'}, 'Nothing renders here: there is nothing to change.');
    this.settings = make('div', {class: 'setting-group'});
    this.layer = make('div', {class: 'setting-group'});
    this.parameters = make('div', {class: 'parameters'});
    this.ofMethod = make('div', {}, make('div', {class: 'settings'}, this.settings, this.layer),
                         this.parameters);
    this.element = make('section', {'aria-label': `Pane ${PANE_NAMES[index]}`},
                        make('label', {class: 'line'}, make('span', {}, 'shows'),
                             this.source.element),
                        this.noMethod, this.ofMethod);
  }

  send(command) { this.page.session.send({...command, pane: this.index}); }

  show(pane, hello) {
    this.source.show(pane.source);
    this.ofMethod.hidden = Boolean(pane.source);
    this.noMethod.hidden = !pane.source;
    if (!hello.has_scene) return;
    this.showSettings(pane, hello);
    this.showLayer(pane);
    const key = pane.parameters.map(controlKey).join();
    if (key !== this.key) this.build(pane);
    this.key = key;
    for (const info of pane.parameters) this.controls.get(info.name).show(info);
    joinReasons(this.controls.values());
  }

  showSettings(pane, hello) {
    const choices = hello.settings.map(key => [key, settingChoices(key, pane, hello)]);
    const key = JSON.stringify(choices);
    if (key !== this.settings.dataset.key) {
      this.settings.dataset.key = key;
      this.selects = new Map();
      this.settings.replaceChildren(...choices.map(([name, list]) => {
        const select = makeSelect(list || [{value: 'none', text: 'not used'}],
                                  value => this.send({do: 'set', key: name, value}),
                                  {'data-setting': name, disabled: list ? null : ''});
        this.selects.set(name, list ? select : null);
        return make('label', {}, make('span', {}, name), select.element);
      }));
    }
    for (const [name, select] of this.selects) {
      if (!select) continue;
      select.show(pane[name]);
      const unused = (pane.unused || {})[name];
      select.element.parentElement.classList.toggle('unused', Boolean(unused));
      select.element.title = unused ? `no effect: ${unused}` : '';
    }
    const mode = settingChoices('mode', pane, hello).find(one => one.value === pane.mode);
    this.settings.title = mode ? mode.title : '';
  }

  showLayer(pane) {
    const key = JSON.stringify(pane.layers || []);
    if (key !== this.layer.dataset.key) {
      this.layer.dataset.key = key;
      const choices = (pane.layers || []).map(
          one => ({value: one.name, text: one.unit ? `${one.name} (${one.unit})` : one.name,
                   title: one.help}));
      this.layerSelect = makeSelect([{value: '', text: 'none'}, ...choices],
                                    name => this.send({do: 'layer', name}),
                                    {'data-setting': 'layer',
                                     disabled: choices.length ? null : ''});
      this.layer.replaceChildren(make('label', {}, make('span', {}, 'layer over it'),
                                      this.layerSelect.element));
    }
    this.layerSelect.show(pane.layer || '');
  }

  build(pane) {
    this.controls = new Map();
    const parts = new Map();
    for (const info of pane.parameters) {
      const key = `parameter ${this.index} ${info.name}`;
      const control = new ParameterControl(info, value => this.page.session.sendNewest(
          key, {do: 'parameter', pane: this.index, name: info.name, value}));
      this.controls.set(info.name, control);
      const {part, part_help: title} = info;
      if (!parts.has(part)) parts.set(part, [make('summary', {title: title || ''}, part)]);
      parts.get(part).push(control.element);
    }
    this.parameters.replaceChildren(...Array.from(
        parts, ([part, elements]) => this.makeGroup(part, elements)));
    this.filter(this.words || []);
  }

  // Makes a group that can be folded, in all panes at once.
  makeGroup(part, elements) {
    const group = make('details', {class: 'part', 'data-part': part}, ...elements);
    elements[0].addEventListener('click', () => {
      if (group.open) this.folded.add(part);
      else this.folded.delete(part);
    });
    return group;
  }

  // Shows the parameters that contain all words; returns how many.
  filter(words) {
    this.words = words;
    let count = 0;
    for (const {element, words: text} of this.controls.values()) {
      element.hidden = !words.every(word => text.includes(word));
      if (!element.hidden) ++count;
    }
    joinReasons(this.controls.values());
    for (const part of this.parameters.children) {
      part.hidden = !part.querySelector('.parameter:not([hidden])');
      part.open = words.length > 0 || !this.folded.has(part.dataset.part);
    }
    return count;
  }
}

class MethodPanel {
  constructor(page, count) {
    this.page = page;
    const folded = new Set();
    this.panes = Array.from({length: count}, (_, i) => new PanePanel(i, page, folded));
    this.choice = makeChoice('Pane', this.panes.map((_, i) => [
      String(i), `Pane ${PANE_NAMES[i]}`, `settings of pane ${PANE_NAMES[i]}`
    ]), i => this.open(Number(i)));
    const copy = (from, to) => makeButton(
        `${PANE_NAMES[from]} \u2192 ${PANE_NAMES[to]}`,
        `copy the method of ${PANE_NAMES[from]} to ${PANE_NAMES[to]}`,
        () => page.session.send({do: 'copy', from, to}));
    const copies = count < 2 ? [] : [
      make('div', {class: 'group', role: 'group', 'aria-label': 'Copy'}, copy(0, 1), copy(1, 0))
    ];
    this.search = make('input', {type: 'search', placeholder: 'search parameters',
                                 'aria-label': 'Search parameters of all panes'});
    this.count = make('p', {class: 'hint', role: 'status'});
    this.search.addEventListener('input', () => this.filter());
    this.search.addEventListener('keydown', event => {
      if (event.key === 'Escape' && !this.search.value) this.search.blur();
    });
    this.element = make('div', {}, make('div', {class: 'row'}, this.choice.element, ...copies),
                        this.makeOpacity(), this.search, this.count,
                        ...this.panes.map(pane => pane.element));
    this.open(0);
  }

  // Returns commands that show a parameter of a pane, for the palette.
  searchCommands() {
    return this.panes.flatMap((pane, i) => Array.from(pane.controls?.keys() || [], name => ({
      id: `parameter-${i}-${name}`, keys: [], group: 'Parameters',
      title: `${name} of ${PANE_NAMES[i]}`,
      run: () => {
        this.page.openTab('methods');
        this.open(i);
        this.search.value = name;
        this.filter();
        pane.controls.get(name)?.element.querySelector('input, select').focus();
      }
    })));
  }

  // Makes the slider for the opacity of all panes' layers, shown while there is a layer.
  makeOpacity() {
    const {viewer} = this.page;
    this.opacity = make('input', {type: 'range', min: 0, max: 1, step: 0.01,
                                  'data-setting': 'opacity'});
    this.opacity.addEventListener('input',
                                  () => viewer.set({opacity: Number(this.opacity.value)}));
    this.opacityLine = make('label', {class: 'line', hidden: ''},
                            make('span', {}, 'opacity of layers'), this.opacity);
    return this.opacityLine;
  }

  open(index) {
    this.choice.show(String(index));
    this.panes.forEach((pane, i) => {
      pane.element.hidden = i !== index;
      pane.filter(pane.words || []);  // groups that were folded in the other pane
    });
  }

  filter() {
    const words = this.search.value.toLowerCase().split(/\s+/).filter(Boolean);
    const counts = this.panes.map(pane => pane.filter(words));
    this.count.textContent = words.length
        ? counts.map((n, i) => `${PANE_NAMES[i]}: ${n} found`).join(', ') : '';
  }

  show(state, hello) {
    this.opacityLine.hidden = !state.panes.some(pane => pane.layer && !pane.source);
    this.search.hidden = state.panes.every(pane => pane.source);
    this.opacity.value = this.page.viewer.state.opacity;
    state.panes.forEach((pane, i) => { if (this.panes[i]) this.panes[i].show(pane, hello); });
  }
}
