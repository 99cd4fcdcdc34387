// Commands of a viewer: one table for keys, toolbar titles, help and palette.
//
// {id, keys, title, group, run(viewer), ...}: `keys` as keyName() returns them. Optional:
// when(viewer): true if the command can do something; release(viewer): called when the key is
// released, the command lasts until then; isFocused: only while the viewer itself has the focus;
// isAnywhere: needs no viewer; inFields: also while text is typed; isOnce: no repeats while the key
// is held; row: [keys, text] of one help line for several commands.

function imageCommands() {
  const commands = [];
  for (let i = 0; i < 9; ++i) {
    const hasImage = viewer => i < viewer.images.length;
    const row = i ? null : ['1 \u2013 9', 'show that image'];
    commands.push({id: `image-${i + 1}`, keys: [`${i + 1}`], group: 'Images', row,
                   title: `show image ${i + 1}`, when: hasImage,
                   run: viewer => viewer.set({current: i})});
  }
  for (let i = 0; i < 9; ++i) {
    const hasImage = viewer => i < viewer.images.length;
    const row = i ? null : ['Shift + 1 \u2013 9',
                            'compare with that image (errors; the left side, unless d chose one)'];
    commands.push({id: `compare-${i + 1}`, keys: [`Shift+${i + 1}`], group: 'Images', row,
                   title: `compare with image ${i + 1}`, when: hasImage,
                   run: viewer => viewer.set({compare: i})});
  }
  return commands;
}

// Commands of the palette that choose an error view by its name.
function errorCommands() {
  return ERROR_ORDER.map(kind => ({
    id: `error-${kind}`, keys: [], group: 'Errors and colours', row: null,
    title: kind === 'none' ? 'no errors: the images' : `errors: ${ERRORS[kind].title}`,
    run: viewer => viewer.set({error: kind})
  }));
}

const PAN_STEP = 60;  // CSS pixels

const VIEWER_COMMANDS = [
  ...rectangleCommands(),
  ...imageCommands(),
  {id: 'previous', keys: ['ArrowLeft'], group: 'Images', title: 'previous image',
   run: viewer => viewer.step(-1)},
  {id: 'next', keys: ['ArrowRight'], group: 'Images', title: 'next image',
   run: viewer => viewer.step(1)},
  {id: 'hold-compare', keys: ['Space'], group: 'Images', isFocused: true,
   title: 'while held, what is compared with; the viewer must have the focus',
   run: viewer => viewer.set({held: true}), release: viewer => viewer.set({held: false})},
  {id: 'next-left', keys: ['d'], group: 'Images', title: 'next image left of the divider',
   when: viewer => viewer.images.length > 2, run: viewer => viewer.stepLeft()},

  {id: 'single', keys: ['s'], group: 'View', title: 'single image',
   run: viewer => viewer.set({mode: 'single'})},
  {id: 'wipe', keys: ['w'], group: 'View', title: 'wipe: two images and a divider to drag',
   run: viewer => viewer.set({mode: 'wipe'})},
  {id: 'side', keys: ['b'], group: 'View', title: 'side by side: all images at the same place',
   run: viewer => viewer.set({mode: 'side'})},
  {id: 'inset', keys: ['I'], group: 'View', when: viewer => viewer.insets.list.length < MOST_INSETS,
   title: 'inset: what is shown, or the surroundings of the pointer, with its own errors',
   run: viewer => viewer.insets.add()},
  {id: 'remove-inset', keys: [], group: 'View', title: 'take the newest inset away',
   when: viewer => viewer.insets.list.length > 0,
   run: viewer => viewer.insets.remove(viewer.insets.list.length - 1)},
  {id: 'fit', keys: ['f'], group: 'View', title: 'fit into the window',
   run: viewer => viewer.fit()},
  {id: 'actual', keys: ['0'], group: 'View', title: 'one screen pixel a pixel',
   run: viewer => viewer.actualSize()},
  ...[['left', 1, 0], ['right', -1, 0], ['up', 0, 1], ['down', 0, -1]].map(([way, dx, dy]) => ({
        id: `pan-${way}`, keys: [`Ctrl+Arrow${way[0].toUpperCase()}${way.slice(1)}`],
        group: 'View', title: `look further ${way} in the picture`,
        row: way === 'left' ? ['Ctrl + arrows', 'move the picture'] : null,
        run: viewer => viewer.pan(PAN_STEP * dx, PAN_STEP * dy)})),
  {id: 'zoom-in', keys: ['+', '='], group: 'View', title: 'zoom in',
   run: viewer => viewer.zoom(1.5)},
  {id: 'zoom-out', keys: ['-'], group: 'View', title: 'zoom out',
   run: viewer => viewer.zoom(1 / 1.5)},

  {id: 'next-error', keys: ['n'], group: 'Errors and colours',
   title: `next error view: none, ${
       ERROR_ORDER.slice(1).map(kind => ERRORS[kind].title.replace(/ error$/, '')).join(', ')}`,
   run: viewer => viewer.stepError(1)},
  {id: 'previous-error', keys: ['N'], group: 'Errors and colours', title: 'previous error view',
   run: viewer => viewer.stepError(-1)},
  ...errorCommands(),
  {id: 'log', keys: ['l'], group: 'Errors and colours', title: 'linear or logarithmic error scale',
   when: viewer => canBeLog(viewer.state.error),
   run: viewer => viewer.toggleLog()},
  {id: 'brighter', keys: ['e'], group: 'Errors and colours',
   title: 'exposure up half a stop; of errors: their range', run: viewer => viewer.expose(0.5)},
  {id: 'darker', keys: ['E'], group: 'Errors and colours', title: 'exposure down half a stop',
   run: viewer => viewer.expose(-0.5)},
  {id: 'exposure-reset', keys: ['r'], group: 'Errors and colours', title: 'exposure as at first',
   run: viewer => viewer.set({stops: 0})},
  {id: 'tone', keys: ['t'], group: 'Errors and colours', title: 'sRGB or false colour',
   run: viewer => viewer.toggleTone()},

  ...TOOL_COMMANDS,

  {id: 'palette', keys: ['Ctrl+k'], group: 'Help', title: 'search all commands', isAnywhere: true,
   inFields: true, run: () => document.dispatchEvent(new CustomEvent('palette'))},
  {id: 'help', keys: ['?'], group: 'Help', title: 'keys; Escape closes them', isAnywhere: true,
   run: () => document.dispatchEvent(new CustomEvent('help'))}
];

const KEY_TEXTS = {ArrowLeft: '\u2190', ArrowRight: '\u2192', ArrowUp: '\u2191',
                   ArrowDown: '\u2193', '-': '\u2212'};

// Formats a key for people: 'Ctrl+Shift+z' is Ctrl + Shift + Z.
function keyText(name) {
  const parts = name === '+' ? [name] : name.split('+');
  const last = parts.pop();
  const isOfModifier = parts.length && last.length === 1;
  return [...parts, KEY_TEXTS[last] || (isOfModifier ? last.toUpperCase() : last)].join(' + ');
}

function keysText(command) {
  return command.keys.map(keyText).join(', ') + (command.release ? ' (held)' : '');
}

// Returns the tooltip of a command's button, with its keys.
function commandTitle(id, commands = VIEWER_COMMANDS) {
  const command = commands.find(one => one.id === id);
  return command.keys.length ? `${command.title} (${keysText(command)})` : command.title;
}
