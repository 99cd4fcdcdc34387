// Starts the page: tables and the first viewer at once, other viewers when they come near the
// window or when the address asks for them.

const roots = Array.from(document.querySelectorAll('.viewer')), viewers = [], opening = new Map();
const address = new ReportAddress();

async function openViewer(root) {
  const data = JSON.parse(document.getElementById(root.dataset.source).textContent);
  root.replaceChildren(make('p', {class: 'status'}, 'Unpacking the images \u2026'));
  const images = [];
  for (const {name, role, mse, ms, pixels} of data.images) {
    let values;
    try {
      const text = document.getElementById(pixels).textContent;
      values = await decodePixels(text, data.width * data.height);
    } catch (error) {
      root.replaceChildren(
          make('p', {class: 'bad'}, `The images cannot be shown: ${name}: ${error.message}`));
      root.dataset.failed = 'true';
      throw error;
    }
    images.push({name, role, mse, ms, width: data.width, height: data.height, data: values,
                 nonfinite: nonfinitePixels(values), version: 1});
  }
  data.link = () => address.write(viewer);
  const viewer = new Viewer(root, data, images);
  if (data.first !== undefined) viewer.set({current: data.first});
  viewer.onDrawn = () => address.note(viewer);
  root.viewer = viewer;
  viewers.push(viewer);
  return viewer;
}

// Opens a viewer once.
function start(root) {
  if (!opening.has(root)) opening.set(root, openViewer(root));
  return opening.get(root);
}

// Shows the view that the address names.
async function showAddress() {
  let wrong = '';
  try {
    const found = readAddress(location.hash, roots);
    if (!found) return;
    const viewer = await start(found.root);
    found.root.scrollIntoView({block: 'center'});
    const fields = applyViewState(found.view, viewer);
    if (fields.length) wrong = `it has no possible value of ${fields.join(', ')}`;
  } catch (error) {
    wrong = error.message;
  }
  if (wrong) (await start(roots[0])).notice(`The address shows no view as it was: ${wrong}.`);
}

document.querySelectorAll('table.results, table.health').forEach(makeSortable);

if (roots.length) {
  // The observer reports nothing before the window's first frame, and a browser that only takes a
  // screenshot of the page may not have one in time.
  start(roots[0]);
  const near = new IntersectionObserver(entries => {
    for (const entry of entries) {
      if (!entry.isIntersecting) continue;
      near.unobserve(entry.target);
      start(entry.target);
    }
  }, {rootMargin: '600px'});
  for (const root of roots.slice(1)) near.observe(root);
  addKeys(viewers, VIEWER_COMMANDS);
  makeHelp(VIEWER_COMMANDS);
  new Palette(VIEWER_COMMANDS, focused => keyTarget(viewers, focused));
  window.addEventListener('hashchange', showAddress);
  showAddress();
}
