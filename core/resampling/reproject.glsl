// Donors over time: the pixel of the last frame that showed a surface. The includer has
// gBuffers.visible, gBuffers.visibleBefore and gParams.partners.

// Its slot; RL_INVALID where the last frame did not show it, or something else there.
RL_FN uint reprojectedSlot(uint slot) {
  if (gFrame.frame == 0u) return RL_INVALID;
  VisibleSurface here = visibleRead(gBuffers.visible, gFrame.camera, slot);
  vec2 film;
  if (!visibleFilmBefore(here, film)) return RL_INVALID;
  uint before = slotOfPixel(uvec2(uint(film.x), uint(film.y)));
  VisibleSurface there = visibleRead(gBuffers.visibleBefore, gFrame.previousCamera, before);
  return visibleAlike(here, there, gParams.partners.alike) ? before : RL_INVALID;
}
