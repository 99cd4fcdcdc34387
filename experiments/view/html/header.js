// Top line of the page: the scene, the connection and buttons for the whole session.

const LINK_TEXTS = {
  connecting: 'connecting \u2026', connected: 'connected', reconnecting: 'reconnecting \u2026',
  ended: 'the program does not answer: start it again and open its new address',
  replaced: 'another viewer was started here: open the address that it has printed'
};

class Header {
  constructor(page) {
    this.page = page;
    this.title = make('h1', {}, 'restlab view');
    this.link = make('span', {class: 'link', role: 'status', 'data-link': 'connecting'},
                     LINK_TEXTS.connecting);
    this.again = makeButton('connect again', 'try to reach the program again',
                            () => page.session.socket.again());
    this.again.hidden = true;
    this.buttons = make('div', {class: 'header-buttons'});
    this.element = make('header', {class: 'live-header'}, this.title, this.link, this.again,
                        this.buttons);
  }

  // Adds the buttons; called when the commands can run.
  fill() {
    const button = (id, text) => {
      const command = this.page.commands.find(one => one.id === id);
      const element = makeButton(text, commandTitle(id, this.page.commands),
                                 () => command.run(this.page.viewer));
      element.dataset.command = id;
      element.disabled = Boolean(command.when) && !this.page.hello.has_scene &&
          !command.when(this.page.viewer);
      return element;
    };
    const group = (label, ...buttons) => make('div', {class: 'group', role: 'group',
                                                      'aria-label': label}, ...buttons);
    this.undo = button('undo', 'undo');
    this.redo = button('redo', 'redo');
    this.pause = button('pause', 'pause');
    this.cameraMode = button('camera-mode', 'camera');
    this.orbit = button('orbit', 'orbit');
    // Without a scene nothing can be changed; the tables stand in that place.
    const isOfFiles = !this.page.hello.has_scene;
    this.table = this.page.hello.tables.length > 1 ? makeTableChoice(this.page) : null;
    if (this.table) this.table.element.setAttribute('aria-label', 'table of the results');
    this.buttons.replaceChildren(
        ...(this.table ? [this.table.element] : []),
        ...(isOfFiles ? [] : [
          group('Changes', this.undo, this.redo),
          group('Frames', this.pause, button('restart', 'restart')),
          group('Camera', this.cameraMode, this.orbit)
        ]),
        group('Files', button('save', 'save session'), button('measure', 'measure'),
              button('screenshot', 'PNG'), button('picture', 'EXR')),
        group('Page', button('theme', 'light/dark')), this.page.warnings.list.element,
        this.page.messages.log.element);
    const {scene} = this.page.hello;
    this.title.textContent = this.title.title = scene.title || scene.name;
    document.title = `${scene.title || scene.name} \u2013 restlab view`;
  }

  showLink(state) {
    this.link.textContent = LINK_TEXTS[state];
    this.link.dataset.link = state;
    this.again.hidden = state !== 'ended';
  }

  show(state) {
    this.table?.show(state.table);
    this.undo.disabled = !state.can_undo;
    this.redo.disabled = !state.can_redo;
    const {commands} = this.page;
    this.undo.title = `${commandTitle('undo', commands)}${
        state.undo_text ? `: ${state.undo_text}` : ''}`;
    this.redo.title = `${commandTitle('redo', commands)}${
        state.redo_text ? `: ${state.redo_text}` : ''}`;
    this.pause.setAttribute('aria-pressed', state.paused);
    setText(this.pause, state.paused ? 'go on' : 'pause');
  }

  showCamera(camera) {
    this.cameraMode.setAttribute('aria-pressed', camera.isOn);
    this.orbit.setAttribute('aria-pressed', camera.isOrbit);
  }
}
