// Tools below a viewer's picture, hidden until they are asked for: the histogram and the numbers of
// a rectangle. And the commands of these and of what else a reader does with a picture.

const TOOL_INTERVAL_MS = 250;

class ViewerTools {
  constructor(viewer) {
    this.histogram = new Histogram(viewer);
    this.table = new RectangleTable(viewer);
    this.element = make('div', {class: 'tools'}, this.histogram.element, this.table.element);
  }

  // Scrolls so far that the tools are in the window.
  reveal() { requestAnimationFrame(() => this.element.scrollIntoView({block: 'nearest'})); }

  update() {
    this.histogram.update();
    this.table.update();
  }
}

function nextChannel({channel}, by) {
  const n = CHANNEL_ORDER.length;
  return CHANNEL_ORDER[(CHANNEL_ORDER.indexOf(channel) + by + n) % n];
}

// Sets the exposure by the reference, or by the first image.
function exposeAnew(viewer) {
  const source = exposureSource(viewer.images);
  if (!source) return;
  viewer.set({stops: 0});
  viewer.setExposure(autoExposure(source));
}

async function copyLink(viewer) {
  const isTaken = await copyText(viewer.data.link());
  viewer.notice(isTaken ? 'copied: the address of this view'
                        : 'the address of this view is that of the page: copy it from there');
}

const TOOL_COMMANDS = [
  {id: 'auto-exposure', keys: ['a'], group: 'Errors and colours',
   title: 'exposure of the reference as it is now, or of the first image', run: exposeAnew},
  {id: 'channel', keys: ['u'], group: 'Errors and colours',
   title: 'next channel of the picture: RGB, R, G, B, luminance',
   run: viewer => viewer.set({channel: nextChannel(viewer.state, 1)})},
  {id: 'previous-channel', keys: ['U'], group: 'Errors and colours',
   title: 'previous channel of the picture',
   run: viewer => viewer.set({channel: nextChannel(viewer.state, -1)})},
  {id: 'histogram', keys: ['H'], group: 'View',
   title: 'histogram of what is shown, or none',
   run: viewer => {
     viewer.set({histogram: !viewer.state.histogram});
     if (viewer.state.histogram) viewer.tools.reveal();
   }},
  {id: 'link', keys: ['L'], group: 'View', title: 'copy a link to what is shown', run: copyLink}
];
