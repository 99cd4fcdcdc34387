// Page of a live session: a viewer of two panes and the reference, or of images of files, with
// panels beside it.

// Slots of images, as the program has them; a pane has its index.
const REFERENCE_SLOT = 64, LAYER_SLOTS = 128;
// Milliseconds after which a pane that has left the view stops rendering.
const HIDE_DELAY_MS = 700;
// Samples of the reference with which its exposure is that of a converged one, nearly.
const EXPOSED_SPP = 64;

class LivePage {
  constructor() {
    this.early = [];
    this.messages = new Messages();
    this.warnings = new Warnings();
    this.header = new Header(this);
    this.root = make('div', {class: 'viewer', role: 'group', 'aria-label': 'Images'});
    this.badge = make('p', {class: 'camera-badge', role: 'status', hidden: ''});
    this.left = make('main', {class: 'live-left'}, this.root);
    this.side = make('aside', {class: 'live-side', 'aria-label': 'Panels'});
    this.side.addEventListener('refused', ({detail}) => this.messages.error(detail));
    this.handle = new SideHandle(this.side);
    startTheme();
    document.body.className = 'live';
    document.body.append(this.header.element, this.left, this.handle.element, this.side,
                         this.messages.element);
    this.root.append(make('p', {class: 'status'}, 'Waiting for the program \u2026'));
    this.kept = readFragment(location.hash);
    document.addEventListener('visibilitychange', () => this.look());
    const scheme = location.protocol === 'https:' ? 'wss' : 'ws';
    this.session = new Session(`${scheme}://${location.host}/socket${location.search}`, {
      hello: hello => this.greet(hello), state: state => this.show(state),
      numbers: numbers => this.showNumbers(numbers), probe: answer => this.probe?.answer(answer),
      error: message => this.refused(message),
      said: ({text}) => this.messages.notice(text),
      progress: progress => this.showProgress(progress),
      saved: ({name, toml}) => downloadText(name, toml),
      measure: message => {
        this.measurement?.show(message);
        if (this.viewer) this.showCameraMode();
      },
      file: ({name, base64}) => downloadBlob(name, new Blob([bytesOfBase64(base64)])),
      image: head => this.showImage(head), images: () => this.viewer?.drawWaiting(),
      link: state => this.header.showLink(state)
    });
  }

  get state() { return this.session.state; }

  // Tells the program whether the page is visible: it renders nothing for hidden pages.
  // It also tells which panes are in view: others render nothing.
  look() {
    const look = {do: 'look', on: !document.hidden};
    if (this.seen) look.panes = this.seen;
    this.session.socket.send(JSON.stringify(look));
  }

  // A pane that comes into view renders at once. One that leaves it goes on for a moment: a held key
  // shows another image.
  arranged(images) {
    this.inView = images.filter(i => this.viewer.images[i].role !== 'reference').sort();
    const seen = this.seen || this.viewer.images.map((_, i) => i).slice(0, this.state.panes.length);
    this.setSeen([...new Set([...seen, ...this.inView])].sort());
    if (this.seen.length === this.inView.length || this.leaving) return;
    this.leaving = setTimeout(() => {
      this.leaving = null;
      this.setSeen(this.inView);
    }, HIDE_DELAY_MS);
  }

  setSeen(seen) {
    const isNew = !this.seen || this.seen.join() !== seen.join();
    this.seen = seen;
    if (isNew) this.look();
  }

  // Shows how far a long frame is, or that a method is made ready.
  showProgress({pane, frame, fraction}) {
    if (!this.viewer) return;
    const text = pane === null ? 'preparing' : `frame ${frame}: ${Math.floor(100 * fraction)} %`;
    this.viewer.images.forEach((image, i) => {
      const isMeant = image.role !== 'reference' && (pane === null || i === pane);
      const progress = isMeant ? text : pane === null ? null : image.progress;
      if (image.progress !== progress) this.viewer.setImage(i, {progress});
    });
  }

  // Reloads the page if the program now has another scene: nothing shown here would be true.
  greet(hello) {
    if (document.hidden || this.seen) this.look();  // a new connection knows nothing of it
    if (this.hello && this.hello.scene.name !== hello.scene.name) location.reload();
    this.hello = hello;
    this.warnings.greet(hello);
  }

  show(state) {
    if (!this.hello) return;
    const isFirst = !this.viewer, isOfFiles = !this.hello.has_scene;
    const names = imageNames(state, this.hello);
    const areOthers = () => String(names) !== String(this.viewer.images.map(({name}) => name));
    if (!isFirst && !isOfFiles && names.length !== this.viewer.images.length) location.reload();
    this.root.dataset.epoch = state.epoch;
    if (isFirst) {
      this.build(state);
    } else if (isOfFiles && (state.epoch !== this.viewer.data.epoch || areOthers())) {
      replaceImages(this.viewer, imagesOf(state, this.hello));
      this.viewer.setExposure(state.exposure);
      // A link was applied to the images of the table before.
      if (this.wanted && this.wanted.table === state.table) this.applyView(this.wanted.view);
      this.wanted = null;
    }
    this.viewer.data.epoch = state.epoch;
    this.viewer.images.forEach((image, i) => {
      const pane = image.role === 'reference' ? null : state.panes[i];
      image.pictureEpoch = state.picture_epoch;
      image.since = pane ? Math.max(pane.epoch, state.picture_epoch) : state.picture_epoch;
      image.progress = null;
    });
    state.panes.forEach((pane, i) => {
      this.viewer.setImage(i, {name: names[i]});
      const hasLayer = pane.layer && !pane.source;
      if (!hasLayer && this.viewer.images[i].overlay) this.viewer.setImage(i, {overlay: null});
    });
    this.numbers.showNames(names);
    const {camera} = this.viewer;
    if (!isFirst && (camera.width !== state.width || camera.height !== state.height)) {
      this.probe.clear();  // the probed pixel is elsewhere now
    }
    this.viewer.setSize(state.width, state.height);
    this.camera.show(state.camera);
    this.methods.show(state, this.hello);
    this.scene.show(state);
    this.header.show(state);
    this.light.show();
    this.probe.showAge();
    this.viewer.set({});
    if (isFirst) this.begin(state);
    const early = this.early;
    this.early = [];
    for (const head of early) this.showImage(head);
    if (isOfFiles && this.last) this.showNumbers(this.last);
  }

  // Shows the error and resets the controls to the actual state.
  refused({text, command}) {
    this.messages.error(text, command);
    if (!this.viewer) return;
    this.methods.show(this.state, this.hello);
    this.scene.show(this.state);
    this.header.show(this.state);
  }

  build(state) {
    this.commands = [...makeLiveCommands(this), ...VIEWER_COMMANDS];
    const isOfFiles = !this.hello.has_scene, count = isOfFiles ? 0 : state.panes.length;
    const {bounds} = this.hello.scene;
    this.camera = new CameraControl(this, bounds || {lo: [-1, -1, -1], hi: [1, 1, 1]});
    const data = {x: 0, y: 0, whole: true, exposure: this.hello.exposure || 1,
                  room: () => this.viewer.frame.clientHeight, pointer: this.camera,
                  arranged: images => this.arranged(images),
                  idle: () => this.idleText(), link: () => this.link(),
                  notice: text => this.messages.notice(text)};
    this.viewer = this.root.viewer =
        new Viewer(this.root, data, imagesOf(state, this.hello));
    this.viewer.frame.append(this.badge, this.warnings.note);
    this.bookmarks = new Bookmarks(this, this.hello.scene.name);
    this.recorder = new PathRecorder(this);
    this.methods = isOfFiles ? new FilesPanel() : new MethodPanel(this, count);
    this.scene = new ScenePanel(this, this.hello);
    this.numbers = isOfFiles ? new FilesNumbers()
                             : new NumbersPanel(count, this.hello.faults || []);
    this.plots = new PlotsPanel(count);
    this.measurement = new MeasurePanel(this);
    this.probe = new ProbePanel(this, count);
    this.tabs = new Tabs('Panels', [
      ['methods', isOfFiles ? 'Images' : 'Methods', this.methods.element],
      ['scene', 'Scene', this.scene.element],
      ['plots', 'Plots', make('div', {}, this.measurement.element, this.plots.element)],
      ['probe', 'Probe', this.probe.element]
    ]);
    this.tabs.tabs.get('plots').tab.addEventListener('click', () => this.plots.show());
    this.light = new LightChoice(this);
    this.side.append(this.numbers.element, this.light.element, this.tabs.element,
                     this.messages.element);
    this.header.fill();
    addKeys([this.viewer], this.commands);
    makeHelp(this.commands, LIVE_POINTER_HELP);
    this.palette = new Palette(this.commands, () => this.viewer,
                               () => this.methods.searchCommands?.() || []);
    for (const name of ['keydown', 'keyup']) {
      document.addEventListener(name, event => { this.camera.isFast = event.shiftKey; }, true);
    }
    this.viewer.set({mode: this.viewer.images.length > MOST_BESIDE ? 'single' : 'side'});
    this.showCameraMode();
  }

  // Applies the address, then keeps it up to date. A reloaded page keeps the program's settings:
  // the address may lag behind the last change.
  begin(state) {
    const {settings} = this.hello;
    const [navigation] = performance.getEntriesByType('navigation');
    const isReload = navigation && navigation.type === 'reload';
    if (this.kept) this.applyView(this.kept.view);
    else if (location.hash.length > 1) this.refuseAddress();
    if (this.kept && !isReload) {
      this.wanted = this.kept;
      for (const command of commandsTowards(this.kept, state, settings)) this.session.send(command);
    }
    // Apply an address that is pasted later, too.
    // The page may have put its own address there since.
    window.addEventListener('hashchange', ({newURL}) => {
      const kept = readFragment(new URL(newURL).hash);
      if (!kept) {
        this.refuseAddress();
        return;
      }
      this.applyView(kept.view);
      this.wanted = kept;
      for (const command of commandsTowards(kept, this.state, settings)) this.session.send(command);
    });
    setInterval(() => this.link(), FRAGMENT_INTERVAL_MS);
  }

  // Brings the address up to date and returns it.
  link() {
    const text = fragmentOf(stateForAddress(this.state, this.viewer, this.hello.settings));
    if (text !== location.hash) history.replaceState(null, '', text);
    return location.href;
  }

  applyView(view) {
    const wrong = isObject(view) ? applyViewState(view, this.viewer) : ['view'];
    if (this.methods.opacity) this.methods.opacity.value = this.viewer.state.opacity;
    if (!wrong.length) return;
    this.messages.notice(`the address has no possible value of ${wrong.join(', ')}: left as it is`);
  }

  refuseAddress() {
    this.messages.notice('the address is cut off, or no page has made it: nothing was changed');
  }

  showImage(head) {
    if (!this.viewer) return;
    const {images} = this.viewer, {width, height} = head;
    if (!this.hello.has_scene && head.epoch !== this.viewer.data.epoch) {
      // Keeps images that are here before the state that tells of them.
      if (head.epoch > this.viewer.data.epoch) this.early.push(head);
      return;
    }
    if (head.slot >= LAYER_SLOTS) {
      this.showLayer(head.slot - LAYER_SLOTS, head);
      return;
    }
    const i = head.slot === REFERENCE_SLOT ? images.length - 1 : head.slot;
    if (!images[i]) return;
    const data = readPixels(head, images[i].data);
    this.viewer.setImage(i, {data, nonfinite: nonfinitePixels(data), width, height,
                             epoch: head.epoch, frame: head.frame, progress: null});
    this.root.dataset.received = Number(this.root.dataset.received || 0) + 1;
  }

  showLayer(i, head) {
    const image = this.viewer.images[i], pane = this.state.panes[i];
    if (!image || !pane || !pane.layer) return;
    const before = image.overlay || {version: 0};
    const data = readPixels(head, before.data);
    const info = pane.layers.find(layer => layer.name === pane.layer) || {};
    this.viewer.setImage(i, {overlay: {
      data, version: before.version + 1, unit: info.unit || '', name: pane.layer,
      kind: info.is_name ? 'name' : info.kind,
      width: head.width, height: head.height, nonfinite: nonfinitePixels(data)
    }});
  }

  // Sets the exposure of the start once more: it was that of a reference with few samples.
  exposeOnce({reference}) {
    if (this.isExposed || !this.hello.has_scene || !reference || reference.spp < EXPOSED_SPP) return;
    this.isExposed = true;
    const source = exposureSource(this.viewer.images);
    const isOfStart = this.viewer.painter.exposure === this.hello.exposure;
    if (source && isOfStart) this.viewer.setExposure(autoExposure(source));
  }

  showNumbers(numbers) {
    if (!this.viewer) return;
    this.last = numbers;
    // Numbers of another table wait for its state.
    if (!this.hello.has_scene && numbers.epoch !== this.viewer.data.epoch) return;
    this.warnings.follow(numbers);
    this.exposeOnce(numbers);
    numbers.panes.forEach(({mse, ms}, i) => {
      Object.assign(this.viewer.images[i], {mse: mse?.value, ms});
    });
    this.viewer.redraw();
    this.numbers.show(numbers);
    this.plots.add(numbers);
    this.probe.follow(numbers);
    if (!this.viewer.pixel) this.viewer.showStatus();
  }

  idleText() {
    if (!this.hello.has_scene) return 'Images of files.  ?: keys, Ctrl + K: search';
    const frames = this.last ? this.last.panes.map((pane, i) => `${PANE_NAMES[i]} ${
        this.state.panes[i].source || `frame ${pane.frame}`}`).join(', ') : 'no frame yet';
    const paused = this.state && this.state.paused ? 'paused; ' : '';
    return `${paused}${frames}.  Click a pixel to probe it.  c: camera mode, ?: keys, ` +
        'Ctrl + K: search';
  }

  moveCamera({to_world, yfov}) {
    this.camera.matrix = to_world;
    this.camera.pose = poseOf(to_world);
    this.recorder.note(this.camera.pose, yfov, this.camera.targetOf(this.camera.pose));
    this.session.sendNewest('camera', yfov ? {do: 'camera', to_world, yfov}
                                           : {do: 'camera', to_world});
  }

  showCameraMode() {
    setText(this.badge, this.measurement.isRunning
        ? 'measuring: nothing renders here until the run ends or is cancelled'
        : this.camera.describe());
    this.badge.hidden = !this.badge.textContent;
    this.root.dataset.camera = this.camera.isOn ? 'fly' : this.camera.isOrbit ? 'orbit' : 'none';
    this.header.showCamera(this.camera);
  }

  leave(viewer) {
    if (this.camera.isOn || this.camera.isOrbit) {
      this.camera.setMode(false);
      this.camera.setOrbit(false);
    } else {
      viewer.root.blur();
    }
  }

  probeAt(pixel) {
    this.probe.ask(pixel);
    this.openTab('probe');
  }

  probeHere() {
    const {width, height} = this.state;
    const middle = {x: Math.floor(width / 2), y: Math.floor(height / 2)};
    this.probeAt(this.viewer.pixel || this.probe.pixel || middle);
  }

  openTab(id) {
    this.tabs.show(id);
    if (id === 'plots') this.plots.show();
  }

  measure() {
    this.openTab('plots');
    this.measurement.ask();
    this.measurement.element.scrollIntoView({block: 'nearest'});
  }

  // Saves the current image.
  savePicture() {
    const {current} = this.viewer.state;
    const isReference = this.viewer.images[current].role === 'reference';
    this.session.send({do: 'picture', image: isReference ? REFERENCE_SLOT : current});
  }

  searchParameters() {
    this.openTab('methods');
    this.methods.search.focus();
  }
}
