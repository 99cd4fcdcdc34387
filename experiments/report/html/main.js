// Starts the page: tables and the first viewer at once, other viewers when they come near the
// window.

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
  const viewer = new Viewer(root, data, images);
  if (data.first !== undefined) viewer.set({current: data.first});
  root.viewer = viewer;
  return viewer;
}

document.querySelectorAll('table.results, table.health').forEach(makeSortable);

const viewers = [];
const start = root => openViewer(root).then(viewer => viewers.push(viewer));
const roots = Array.from(document.querySelectorAll('.viewer'));
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
}
