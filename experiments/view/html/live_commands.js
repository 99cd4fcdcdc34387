// Commands of a live session. They precede those of every viewer: in camera mode their keys move
// the camera.

// [way, keys, title] of the camera's keys in camera mode.
const FLY_KEYS = [
  ['forward', ['w', 'W'], 'fly forward'], ['back', ['s', 'S'], 'fly back'],
  ['left', ['a', 'A'], 'fly left'], ['right', ['d', 'D'], 'fly right'],
  ['up', ['e', 'E'], 'fly up'], ['down', ['q', 'Q'], 'fly down'],
  ['turn-left', ['ArrowLeft', 'Shift+ArrowLeft'], 'look left'],
  ['turn-right', ['ArrowRight', 'Shift+ArrowRight'], 'look right'],
  ['turn-up', ['ArrowUp', 'Shift+ArrowUp'], 'look up'],
  ['turn-down', ['ArrowDown', 'Shift+ArrowDown'], 'look down']
];

// Rows of the help, keyed by the first command of each.
const FLY_ROWS = {
  forward: ['w, s, a, d, e, q', 'fly forward, back, left, right, up, down; with Shift faster'],
  'turn-left': ['\u2190 \u2192 \u2191 \u2193', 'look around; where dragging orbits (o), orbit']
};

// Commands that repeat while their key is held.
const REPEATED = ['faster', 'slower', 'undo', 'redo'];

// Commands that do nothing if only images of files are shown.
const NEEDS_METHOD = ['restart', 'pause', 'probe', 'find-parameter', 'measure', 'indirect'];


function makeLiveCommands(page) {
  const send = command => () => page.session.send(command);
  const isOn = () => page.camera.isOn;
  // True if the arrow keys turn the camera.
  const isTurning = viewer => !viewer.rectangle.isOn && (isOn() || page.camera.isOrbit);
  const panes = page.hello.has_scene ? page.state.panes : [];
  const session = 'Session', camera = 'Camera', fly = 'Camera mode (c)';
  const commands = [
    ...FLY_KEYS.map(([way, keys, title]) => ({
                      id: `fly-${way}`, keys, group: fly, title,
                      when: way.startsWith('turn') ? isTurning : isOn,
                      row: FLY_ROWS[way] || null,
                      run: () => page.camera.hold(way), release: () => page.camera.release(way)})),
    {id: 'faster', keys: ['+', '='], group: fly, title: 'higher speed of the camera', when: isOn,
     run: () => page.camera.changeSpeed(1)},
    {id: 'slower', keys: ['-'], group: fly, title: 'lower speed of the camera', when: isOn,
     run: () => page.camera.changeSpeed(-1)},

    {id: 'camera-mode', keys: ['c'], group: camera, title: 'camera mode on or off',
     run: () => page.camera.setMode(!isOn())},
    {id: 'orbit', keys: ['o'], group: camera, title: 'dragging orbits, or not',
     run: () => page.camera.setOrbit(!page.camera.isOrbit)},
    {id: 'adaptive', keys: ['C'], group: camera,
     title: 'smaller frames while the camera moves, or whole ones',
     run: () => page.session.send({do: 'adaptive', on: !page.state.adaptive})},
    {id: 'bookmark', keys: ['k'], group: camera, title: 'keep this view as a bookmark',
     run: () => page.bookmarks.add()},
    {id: 'camera-home', keys: ['h'], group: camera, title: 'back to the first camera of the scene',
     run: () => page.moveCamera(page.hello.scene.cameras[0]),
     when: () => page.hello.scene.cameras.length > 0},
    {id: 'record', keys: ['v'], group: camera, title: 'record the camera\'s path, or stop',
     run: () => page.recorder.toggle()},
    {id: 'play', keys: ['V'], group: camera, title: 'play the recorded path, or stop',
     when: () => page.recorder.keyframes.length > 1, run: () => page.recorder.playBack()},

    {id: 'pause', keys: ['p'], group: session, title: 'pause or go on',
     run: () => page.session.send({do: 'pause', on: !page.state.paused})},
    {id: 'restart', keys: ['R'], group: session, title: 'histories begin anew, with the next seed',
     run: send({do: 'restart'})},
    {id: 'undo', keys: ['z', 'Ctrl+z'], group: session, title: 'undo the last change',
     when: () => page.state.can_undo, run: send({do: 'undo'})},
    {id: 'redo', keys: ['Z', 'Ctrl+Shift+z', 'Ctrl+y'], group: session, title: 'redo',
     when: () => page.state.can_redo, run: send({do: 'redo'})},
    {id: 'copy-ab', keys: [], group: session, title: 'copy the method of A to B',
     when: () => panes.length > 1, run: send({do: 'copy', from: 0, to: 1})},
    {id: 'copy-ba', keys: [], group: session, title: 'copy the method of B to A',
     when: () => panes.length > 1, run: send({do: 'copy', from: 1, to: 0})},
    ...panes.flatMap((_, pane) => page.hello.sources.map(value => ({
         id: `show-${pane}-${value}`, keys: [], group: session,
         title: `${PANE_NAMES[pane]} shows ${sourceText(value)}`,
         run: send({do: 'set', pane, key: 'source', value})}))),
    ...makeTableCommands(page),
    ...componentsOf(page).map(value => ({
         id: `component-${value}`, keys: [], group: session,
         title: `light that is shown: ${value}`, run: () => showComponent(page, value)})),
    {id: 'indirect', keys: ['i'], group: session, title: 'indirect light alone, or all light',
     run: () => showComponent(page, componentOf(page).value === 'indirect' ? null : 'indirect')},
    {id: 'probe', keys: ['g'], group: session,
     title: 'probe the pixel under the pointer, or in the middle', run: () => page.probeHere()},
    {id: 'clear-probe', keys: ['G'], group: session, title: 'take the probe\'s marks away',
     run: () => page.probe.clear()},
    {id: 'save', keys: ['Ctrl+s'], group: session, title: 'save the session as TOML',
     run: send({do: 'save'})},
    {id: 'screenshot', keys: ['x'], group: session, title: 'save what is shown as a PNG',
     run: viewer => saveScreenshot(viewer, `${page.hello.scene.name}.png`, pictureWords(page))},
    {id: 'picture', keys: ['X'], group: session,
     title: 'save the chosen image as it was rendered, an EXR', run: () => page.savePicture()},
    {id: 'crop', keys: ['m'], group: session,
     title: 'the insets, the rectangle, or what is shown, as crops for restlab figure', run: () => giveCrop(page)},
    {id: 'measure', keys: ['M'], group: session, title: 'measure the session by restlab run',
     when: () => !page.measurement.isRunning, run: () => page.measure()},
    {id: 'cancel-measure', keys: [], group: session, title: 'end what is measured',
     when: () => page.measurement.isRunning, run: send({do: 'cancel'})},
    {id: 'theme', keys: ['y'], group: session, title: 'light or dark', run: toggleTheme},
    {id: 'find-parameter', keys: ['/'], group: session, title: 'search the parameters',
     run: () => page.searchParameters()},
    ...['methods', 'scene', 'plots', 'probe'].map((id, i) => ({
         id: `tab-${id}`, keys: [`Alt+${i + 1}`], group: session, title: `panel: ${id}`,
         row: i ? null : ['Alt + 1 \u2013 4', 'panels: methods, scene, plots, probe'],
         run: () => page.openTab(id)})),

    {id: 'hold-tab', keys: ['Tab'], group: 'Images', isFocused: true,
     title: 'the same as Space; Escape, then Tab leaves the picture',
     run: viewer => viewer.set({held: true}), release: viewer => viewer.set({held: false})},
    {id: 'leave', keys: ['Escape'], group: 'Images', title: 'leave camera mode, or the picture',
     when: viewer => isOn() || page.camera.isOrbit ||
         (document.activeElement === viewer.root && !viewer.state.rectangle),
     run: viewer => page.leave(viewer)}
  ];
  for (const one of commands) {
    if (!NEEDS_METHOD.includes(one.id) && one.group !== camera) continue;
    const {when} = one;
    one.when = viewer => page.hello.has_scene && (!when || when(viewer));
  }
  return commands.map(
      one => REPEATED.includes(one.id) || one.release ? one : {...one, isOnce: true});
}

const LIVE_POINTER_HELP = [
  ['wheel', 'zoom about the pointer; in camera mode the speed'],
  ['drag', 'move the picture; in camera mode look around'],
  ['Shift + drag', 'choose a rectangle of pixels'],
  ['Alt + drag', 'orbit about the point under the pointer'],
  ['click', 'probe the pixel in all panes']
];
