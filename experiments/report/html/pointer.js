// Mouse, pen and touch on a viewer: wheel, drag, divider, the pixel under the pointer.

// A wheel that scrolls the page goes on scrolling it when a viewer comes under the pointer; after a
// pause of so many milliseconds it zooms.
const WHEEL_PAUSE = 350;
let lastPageScroll = -Infinity;
document.addEventListener('wheel', event => {
  if (!event.defaultPrevented) lastPageScroll = event.timeStamp;
}, {passive: true});

// A press that moves no farther than so many CSS pixels is a click.
const CLICK_RADIUS = 4;

// `viewer.data.pointer`, where there is one, may take a drag or the wheel: drag(event, hit) says
// what does it, {move(dx, dy)}, or null; wheel(event) whether it did; click(hit) ends a press that
// did not move.
function addPointer(viewer) {
  const {canvas, divider, frame} = viewer, own = viewer.data.pointer;
  const position = event => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  let last = null, first = null, drag = null;

  canvas.addEventListener('wheel', event => {
    if (own && own.wheel(event)) {
      event.preventDefault();
      return;
    }
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
    first = last = [event.clientX, event.clientY];
    drag = own ? own.drag(event, viewer.stage.hit(...position(event))) : null;
  });
  canvas.addEventListener('pointermove', event => {
    if (first && Math.hypot(event.clientX - first[0], event.clientY - first[1]) > CLICK_RADIUS) {
      first = null;
    }
    if (last) {
      const by = [event.clientX - last[0], event.clientY - last[1]];
      if (drag) drag.move(...by); else if (!first || !own) viewer.camera.pan(...by);
      last = [event.clientX, event.clientY];
    }
    viewer.pointer = position(event);
    viewer.redraw();
  });
  const end = () => { first = last = drag = null; };
  canvas.addEventListener('pointerup', event => {
    if (first && own) own.click(viewer.stage.hit(...position(event)));
    end();
  });
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
    divider.addEventListener(name, () => {
      dragging = false;
      // Keys are the viewer's again; who comes by Tab moves it by arrows.
      viewer.root.focus({preventScroll: true});
    });
  }
  divider.addEventListener('keydown', event => {
    const step = {ArrowLeft: -0.02, ArrowRight: 0.02, Home: -1, End: 1}[event.key];
    if (!step) return;
    viewer.set({wipe: Math.min(1, Math.max(0, viewer.state.wipe + step))});
    event.preventDefault();
    event.stopPropagation();
  });
}
