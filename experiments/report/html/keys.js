// Keyboard control of the viewers, by the table of commands.

// Returns the name of the pressed key, as commands use it: a character that includes Shift, or the
// key's name. Digits are named by their position, since Shift turns them into other characters.
function keyName(event) {
  const digit = /^(?:Digit|Numpad)([1-9])$/.exec(event.code);
  const control = event.ctrlKey || event.metaKey;
  const key = digit ? digit[1] : event.key === ' ' ? 'Space' : event.key;
  let name = control && key.length === 1 ? key.toLowerCase() : key;
  if (event.shiftKey && (digit || control || key.length > 1)) name = `Shift+${name}`;
  if (event.altKey) name = `Alt+${name}`;
  return control ? `Ctrl+${name}` : name;
}

// Returns the height of the visible part of an element.
function shownHeight(element) {
  const box = element.getBoundingClientRect();
  return Math.min(box.bottom, window.innerHeight) - Math.max(box.top, 0);
}

// Returns the viewer with the focus, or else the one that fills most of the window.
function keyTarget(viewers, focused) {
  const holder = viewers.find(viewer => viewer.root.contains(focused));
  if (holder) return holder;
  const shown = viewers.filter(viewer => shownHeight(viewer.root) > 0);
  return shown.sort((a, b) => shownHeight(b.root) - shownHeight(a.root))[0];
}

// True if keys type text in the element.
function isField(element) {
  return Boolean(element.closest('input:not([type=range], [type=checkbox]), textarea, select'));
}

// True if the slider handles the key itself.
function movesSlider(event) {
  return /^(Arrow|Home|End|Page)/.test(event.key) && event.target.closest('input[type=range]');
}

// True if arrow keys scroll a table that is wider than its container.
function scrollsTable(event) {
  const table = event.key.startsWith('Arrow') && event.target.closest('.scroll');
  return table && table.scrollWidth > table.clientWidth;
}

// Returns the command of a key and its viewer, or null.
function commandOfKey(event, viewers, commands) {
  const name = keyName(event);
  const viewer = keyTarget(viewers, event.target);
  const command = commands.find(
      one => one.keys.includes(name) && (one.inFields || !isField(event.target)) &&
          (one.isAnywhere || viewer) &&
          (!one.isFocused || viewer.root === event.target) && (!one.when || one.when(viewer)));
  return command ? {command, viewer} : null;
}

function addKeys(viewers, commands) {
  const held = new Map();  // by event.code
  const release = code => {
    const {command, viewer} = held.get(code);
    held.delete(code);
    command.release(viewer);
  };
  document.addEventListener('keydown', event => {
    // Ignore keys that were already handled or belong to an open dialog.
    if (event.defaultPrevented || document.querySelector('dialog[open]')) return;
    if (scrollsTable(event) || movesSlider(event)) return;
    const found = commandOfKey(event, viewers, commands);
    if (!found) return;
    event.preventDefault();
    const {command, viewer} = found;
    if (event.repeat && command.isOnce) return;
    if (!command.release) {
      command.run(viewer);
    } else if (!held.has(event.code)) {
      held.set(event.code, found);
      command.run(viewer);
    }
  });
  document.addEventListener('keyup', event => { if (held.has(event.code)) release(event.code); });
  window.addEventListener('blur', () => { for (const code of [...held.keys()]) release(code); });
}
