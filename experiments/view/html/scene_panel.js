// Panel of the camera, the size, the settings of all panes, the lights and the materials.

const SIZES = ['320x180', '640x360', '960x540', '1280x720', '1920x1080'];
// Range of a light's factor on its slider; 0 is off.
const LIGHT_RANGE = [0, 1000];

// The command that sets a parameter of a material, as TOML; null: to what the file has.
function materialCommand({name, bases}, key, value) {
  return {do: 'material', name, bases, key, value: value === null ? null : String(value)};
}

class ScenePanel {
  constructor(page, hello) {
    Object.assign(this, {page, hello});
    this.lights = new Map();
    this.settings = new Map();
    if (!hello.has_scene) {
      this.element = make('p', {class: 'hint'}, 'Images of files are shown: there is no camera, ' +
                          'size or light to change.');
      return;
    }
    this.element = make('div', {}, this.makeCamera(), page.bookmarks.element,
                        page.recorder.element, this.makeSize(), this.makeTransport(),
                        this.makeLights(), this.makeMaterials(), this.makeAbout());
  }

  section(title, ...children) {
    return make('fieldset', {}, make('legend', {}, title), ...children);
  }

  makeCamera() {
    const {cameras} = this.hello.scene, {page} = this;
    const select = makeSelect(
        [{value: '', text: 'choose \u2026'},
         ...cameras.map((camera, i) => ({value: i, text: camera.name || `camera ${i}`}))],
        i => {
          if (i !== '') page.moveCamera(cameras[i]);
          select.element.value = '';
        }, {'data-setting': 'camera'});
    this.fov = new NumberInput({name: 'vertical field of view in degrees', lo: 5, hi: 150,
                                isWhole: false},
                               degrees => page.moveCamera({...page.camera.now(),
                                                           yfov: degrees * Math.PI / 180}));
    this.showWhenLeft(this.fov, 'camera');
    return this.section('camera',
                        make('label', {class: 'line'}, make('span', {}, 'of the scene'),
                             select.element),
                        make('div', {class: 'line'}, make('span', {}, 'field of view, degrees'),
                             this.fov.element));
  }

  makeSize() {
    const number = name => make('input', {type: 'number', min: 1, max: 16384, step: 1,
                                          'aria-label': `${name} in pixels`});
    this.width = number('width');
    this.height = number('height');
    const send = (width, height) => this.page.session.send({do: 'resolution', width, height});
    const apply = make('button', {type: 'submit'}, 'apply');
    const form = make('form', {class: 'line'}, this.width, '\u00d7', this.height, apply);
    form.addEventListener('submit', event => {
      event.preventDefault();
      send(Number(this.width.value), Number(this.height.value));
    });
    const preset = makeSelect([{value: '', text: 'sizes \u2026'}, ...SIZES], size => {
      if (size) send(...size.split('x').map(Number));
      preset.element.value = '';
    }, {'aria-label': 'common sizes'});
    form.append(preset.element);
    return this.section('resolution, pixels', form);
  }

  // Makes the place for settings of all panes, in groups.
  makeTransport() {
    this.transport = make('div', {});
    this.groups = new Map();
    return this.transport;
  }

  showTransport(infos) {
    for (const info of infos) {
      const known = this.settings.get(info.name);
      if (known) {
        known.show(info);
        continue;
      }
      const control = new ParameterControl(info, value => this.page.session.sendNewest(
          `transport ${info.name}`, {do: 'transport', name: info.name, value}));
      this.settings.set(info.name, control);
      if (!this.groups.has(info.part)) {
        this.groups.set(info.part, this.section(`${info.part}, of all panes`));
        this.transport.append(this.groups.get(info.part));
      }
      this.groups.get(info.part).append(control.element);
    }
    joinReasons(this.settings.values());
  }

  makeLights() {
    const rows = this.hello.scene.lights.map(({name, kind}) => {
      const input = new NumberInput({name: `factor of ${name}`, lo: LIGHT_RANGE[0],
                                     hi: LIGHT_RANGE[1], isWhole: false},
                                    factor => this.page.session.sendNewest(
                                        `light ${name}`, {do: 'light', name, factor}));
      const reset = makeButton('\u21ba', `${name}: back to 1`,
                               () => this.page.session.send({do: 'light', name, factor: 1}));
      reset.className = 'reset';
      this.lights.set(name, {input, reset});
      this.showWhenLeft(input, `light ${name}`);
      return make('div', {class: 'parameter', 'data-light': name},
                  make('span', {class: 'label', title: kind === 'all' ? 'a factor on those of every light' : kind || ''}, name), reset, input.element);
    });
    return this.section('light, factor on what it shines', ...rows);
  }

  makeMaterials() {
    this.materials = new Map();
    this.materialRows = make('div', {});
    const section = this.section('materials of the scene file', this.materialRows);
    section.hidden = true;
    this.materialSection = section;
    return section;
  }

  showMaterials(materials) {
    this.materialSection.hidden = materials.length === 0;
    for (const material of materials) {
      const {name, bases, kind, parameters} = material, key = `${bases} ${name}`;
      if (!this.materials.has(key)) {
        const details = make('details', {'data-material': name});
        this.materials.set(key, {details});
        this.materialRows.append(details);
      }
      const known = this.materials.get(key);
      if (known.kind !== kind) Object.assign(known, this.makeMaterial(material, known.details));
      for (const info of parameters) known.controls.get(info.name).show(info);
    }
  }

  // Makes the controls of a material's kind.
  makeMaterial({name, bases, kind, parameters}, details) {
    const controls = new Map(parameters.map(info => {
      const send = value => this.page.session.sendNewest(
          `material ${bases} ${name}.${info.name}`,
          materialCommand({name, bases}, info.name, value));
      return [info.name, new ParameterControl(info, send)];
    }));
    const of = bases ? `, of the scene file that it begins with${bases > 1 ? ` (${bases})` : ''}`
                     : '';
    details.replaceChildren(make('summary', {}, `${name}: ${kind}${of}`),
                            ...[...controls.values()].map(control => control.element));
    return {kind, controls};
  }

  makeAbout() {
    const {scene, version, threads} = this.hello;
    const lines = [...(scene.feature_lines || []),
                   `${version ? `version ${version}, ` : ''}${threads} threads`];
    return make('details', {}, make('summary', {}, 'about this scene'),
                ...lines.map(line => make('p', {class: 'hint'}, line)));
  }

  // Resets a refused input when it loses the focus, unless the program's answer is still due.
  showWhenLeft(input, key) {
    input.element.addEventListener('focusout', () => {
      const {session, state} = this.page;
      if (!session.waiting.has(key)) this.show(state);
    });
  }

  show(state) {
    if (!this.hello.has_scene) return;
    const focused = document.activeElement;
    if (focused !== this.width && focused !== this.height) {
      this.width.value = state.width;
      this.height.value = state.height;
    }
    if (!this.fov.isBusy && state.camera.yfov) {
      this.fov.show(Number((state.camera.yfov * 180 / Math.PI).toPrecision(4)));
    }
    this.showTransport(state.transport);
    this.showMaterials(state.materials);
    for (const {name, factor} of state.lights) {
      const light = this.lights.get(name);
      if (!light) continue;
      if (!light.input.isBusy) light.input.show(factor);
      light.reset.disabled = factor === 1;
    }
  }
}
