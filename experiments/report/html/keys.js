// Keys of the viewers.

// What a key does to a viewer; undefined for a key that is none of theirs.
function keyAction(event) {
  const digit = /^(?:Digit|Numpad)([1-9])$/.exec(event.code);
  if (digit) {
    const i = Number(digit[1]) - 1;
    const change = event.shiftKey ? {compare: i} : {current: i};
    return viewer => { if (i < viewer.images.length) viewer.set(change); };
  }
  switch (event.key) {
    case 'ArrowLeft': return viewer => viewer.step(-1);
    case 'ArrowRight': return viewer => viewer.step(1);
    case 's': return viewer => viewer.set({mode: 'single'});
    case 'w': return viewer => viewer.set({mode: 'wipe'});
    case 'b': return viewer => viewer.set({mode: 'side'});
    case 'n': return viewer => viewer.stepError(1);
    case 'N': return viewer => viewer.stepError(-1);
    case 'l': return viewer => viewer.toggleLog();
    case 'e': return viewer => viewer.expose(0.5);
    case 'E': return viewer => viewer.expose(-0.5);
    case 'r': return viewer => viewer.set({stops: 0});
    case 't': return viewer => viewer.toggleTone();
    case 'f': return viewer => viewer.fit();
    case '0': return viewer => viewer.actualSize();
    case '+': case '=': return viewer => viewer.zoom(1.5);
    case '-': return viewer => viewer.zoom(1 / 1.5);
    default: return undefined;
  }
}

// Height of the part of an element that the window shows.
function shownHeight(element) {
  const box = element.getBoundingClientRect();
  return Math.min(box.bottom, window.innerHeight) - Math.max(box.top, 0);
}

// The viewer with the focus, else the one that fills most of the window.
function keyTarget(viewers, focused) {
  const holder = viewers.find(viewer => viewer.root.contains(focused));
  if (holder) return holder;
  const shown = viewers.filter(viewer => shownHeight(viewer.root) > 0);
  return shown.sort((a, b) => shownHeight(b.root) - shownHeight(a.root))[0];
}

function addKeys(viewers, help) {
  const held = holding => {
    for (const viewer of viewers) {
      if (viewer.state.held && !holding) viewer.set({held: false});
    }
  };
  document.addEventListener('keydown', event => {
    if (event.ctrlKey || event.metaKey || event.altKey || help.open) return;
    if (event.target.closest('input, textarea, select')) return;
    if (event.key === '?') {
      help.showModal();
      event.preventDefault();
      return;
    }
    if (event.key === ' ') {
      const viewer = viewers.find(one => one.root === event.target);
      if (!viewer) return;
      if (!viewer.state.held) viewer.set({held: true});
      event.preventDefault();
      return;
    }
    // Arrows scroll a table that is wider than its place.
    const table = event.key.startsWith('Arrow') && event.target.closest('.scroll');
    if (table && table.scrollWidth > table.clientWidth) return;
    const action = keyAction(event);
    const viewer = action && keyTarget(viewers, event.target);
    if (!viewer) return;
    action(viewer);
    event.preventDefault();
  });
  document.addEventListener('keyup', event => { if (event.key === ' ') held(false); });
  window.addEventListener('blur', () => held(false));
  document.addEventListener('help', () => help.showModal());
}
