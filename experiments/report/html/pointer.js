// Mouse, pen and touch on a viewer: wheel, drag, divider, the pixel under the pointer.

// Pause in milliseconds after which the wheel zooms: a wheel that is scrolling the page goes on
// scrolling when a viewer moves under the pointer.
const WHEEL_PAUSE = 350;
let lastPageScroll = -Infinity;
document.addEventListener('wheel', event => {
  if (!event.defaultPrevented) lastPageScroll = event.timeStamp;
}, {passive: true});

// Largest movement of a click, in CSS pixels.
const CLICK_RADIUS = 4;

// `viewer.data.pointer`, if set, may take over drag and wheel. drag(event, hit) returns a handler
// {move(dx, dy, event), end() if needed} or null; wheel(event) returns whether it was handled;
// click(hit) is called after a press without movement.
function addPointer(viewer) {
  const {canvas, divider, frame} = viewer, own = viewer.data.pointer;
  const position = event => viewer.pointerAt(event);
  let last = null, first = null, drag = null;

  canvas.addEventListener('wheel', event => {
    if (own && own.wheel(event)) {
      event.preventDefault();
      return;
    }
    if (event.ctrlKey || event.timeStamp - lastPageScroll < WHEEL_PAUSE) return;
    const unit = event.deltaMode === 1 ? 20 : event.deltaMode === 2 ? 400 : 1;
    const moved = viewer.zoom(Math.exp(-event.deltaY * unit * 0.002), ...position(event));
    // At the limit of the zoom, let the page scroll.
    if (moved || event.deltaY < 0) event.preventDefault();
  }, {passive: false});

  canvas.addEventListener('pointerdown', event => {
    if (event.button !== 0) return;
    viewer.root.focus({preventScroll: true});
    canvas.setPointerCapture(event.pointerId);
    first = last = [event.clientX, event.clientY];
    const hit = viewer.stage.hit(...position(event));
    // A camera that is moved keeps Shift, by which it is faster.
    const choice = viewer.rectangle, isFirst = choice.isOn;
    drag = (isFirst && choice.drag(event, hit)) || (own && own.drag(event, hit)) ||
        choice.drag(event, hit);
  });
  canvas.addEventListener('pointermove', event => {
    if (first && Math.hypot(event.clientX - first[0], event.clientY - first[1]) > CLICK_RADIUS) {
      first = null;
    }
    if (last) {
      const by = [event.clientX - last[0], event.clientY - last[1]];
      if (drag) drag.move(...by, event); else if (!first || !own) viewer.camera.pan(...by);
      last = [event.clientX, event.clientY];
    }
    viewer.pointer = position(event);
    viewer.redraw();
  });
  const end = () => {
    if (drag && drag.end) drag.end();
    first = last = drag = null;
  };
  canvas.addEventListener('pointerup', event => {
    if (first && own && !(drag && drag.isRectangle)) own.click(viewer.stage.hit(...position(event)));
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
      // Give the keys back to the viewer; keyboard users reach the divider by Tab.
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
