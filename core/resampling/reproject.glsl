// Temporal donors: the pixel of the last frame that showed a surface. The includer has
// gBuffers.visible, gBuffers.visibleBefore and gParams.partners.

// Returns the last frame's slot that shows the surface of a pixel; RL_INVALID if the surface was
// out of view or another one is there.
RL_FN uint reprojectedSlot(uint slot) {
  if (gFrame.frame == 0u) return RL_INVALID;
  VisibleSurface here = visibleRead(gBuffers.visible, gFrame.camera, slot);
  vec2 film;
  if (!visibleFilmBefore(here, film)) return RL_INVALID;
  uint before = slotOfPixel(uvec2(uint(film.x), uint(film.y)));
  VisibleSurface there = visibleRead(gBuffers.visibleBefore, gFrame.previousCamera, before);
  return visibleAlike(here, there, gParams.partners.alike) ? before : RL_INVALID;
}
