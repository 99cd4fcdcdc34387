// Mouse, pen and touch on a viewer: wheel, drag, divider, the pixel under the pointer.

// A wheel that scrolls the page goes on scrolling it when a viewer comes under the pointer; after a
// pause of so many milliseconds it zooms.
const WHEEL_PAUSE = 350;
let lastPageScroll = -Infinity;
document.addEventListener('wheel', event => {
  if (!event.defaultPrevented) lastPageScroll = event.timeStamp;
}, {passive: true});

function addPointer(viewer) {
  const {canvas, divider, frame} = viewer;
  const position = event => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  let last = null;

  canvas.addEventListener('wheel', event => {
    if (event.ctrlKey || event.timeStamp - lastPageScroll < WHEEL_PAUSE) return;
    const unit = event.deltaMode === 1 ? 20 : event.deltaMode === 2 ? 400 : 1;
    const moved = viewer.zoom(Math.exp(-event.deltaY * unit * 0.002), ...position(event));
    // At the end of the zoom the page scrolls.
    if (moved || event.deltaY < 0) event.preventDefault();
  }, {passive: false});

  canvas.addEventListener('pointerdown', event => {
    if (event.button !== 0) return;
    viewer.root.focus({preventScroll: true});
    canvas.setPointerCapture(event.pointerId);
    last = [event.clientX, event.clientY];
  });
  canvas.addEventListener('pointermove', event => {
    if (last) {
      viewer.camera.pan(event.clientX - last[0], event.clientY - last[1]);
      last = [event.clientX, event.clientY];
    }
    viewer.pointer = position(event);
    viewer.redraw();
  });
  const end = () => { last = null; };
  canvas.addEventListener('pointerup', end);
  canvas.addEventListener('pointercancel', end);
  canvas.addEventListener('pointerleave', () => {
    viewer.pointer = null;
    viewer.redraw();
  });

  let dragging = false;
  const wipeTo = event => {
    const box = frame.getBoundingClientRect();
    const at = (event.clientX - box.left) / box.width;
    viewer.set({wipe: Math.min(1, Math.max(0, at))});
  };
  divider.addEventListener('pointerdown', event => {
    divider.setPointerCapture(event.pointerId);
    dragging = true;
  });
  divider.addEventListener('pointermove', event => { if (dragging) wipeTo(event); });
  for (const name of ['pointerup', 'pointercancel']) {
    divider.addEventListener(name, () => { dragging = false; });
  }
  divider.addEventListener('keydown', event => {
    const step = {ArrowLeft: -0.02, ArrowRight: 0.02, Home: -1, End: 1}[event.key];
    if (!step) return;
    viewer.set({wipe: Math.min(1, Math.max(0, viewer.state.wipe + step))});
    event.preventDefault();
    event.stopPropagation();
  });
}
