// Address of a report: behind #view= the state of the viewer that was touched last, with the id of
// its block. Other fragments lead to blocks, as links of the page do.

const ADDRESS_FRONT = '#view=', ADDRESS_DELAY_MS = 400;

const blockOf = root => root.closest('.block').id;

function addressOf(viewer) {
  const state = {block: blockOf(viewer.root), ...viewState(viewer)};
  return ADDRESS_FRONT + encodeURIComponent(JSON.stringify(state));
}

// Returns {root, view} of an address, with the container of a viewer; null if it names no view;
// throws an Error that says what is wrong.
function readAddress(hash, roots) {
  if (!hash.startsWith(ADDRESS_FRONT)) return null;
  let view;
  try {
    view = JSON.parse(decodeURIComponent(hash.slice(ADDRESS_FRONT.length)));
  } catch {
    throw new Error('it is cut off, or was not made by a report');
  }
  if (view === null || typeof view !== 'object') throw new Error('it was not made by a report');
  const root = roots.find(one => blockOf(one) === view.block);
  if (!root) throw new Error(`this report has no images in a block '${view.block}'`);
  return {root, view};
}

// Keeps the page's address up to date.
class ReportAddress {
  constructor() { this.kept = new Map(); }

  // Called after each drawing of a viewer. Its state at the first one is not its reader's doing.
  note(viewer) {
    const text = addressOf(viewer), isFirst = !this.kept.has(viewer);
    const isSame = this.kept.get(viewer) === text;
    this.kept.set(viewer, text);
    if (isFirst || isSame) return;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.write(viewer), ADDRESS_DELAY_MS);
  }

  write(viewer) {
    clearTimeout(this.timer);
    history.replaceState(null, '', addressOf(viewer));
    return location.href;
  }
}
