// Temporal donors: the pixel of the last frame that showed a surface. The includer has
// gBuffers.visible, gBuffers.visibleBefore and gParams.pairs.

// Returns the last frame's pixel that shows the surface of a pixel; RL_INVALID if the surface was
// out of view or another one is there.
RL_FN uint reprojectedPixelIndex(uint pixelIndex) {
  if (gFrame.frame == 0u) return RL_INVALID;
  GBufferTexel here = visibleRead(gBuffers.visible, gFrame.camera, pixelIndex);
  vec2 film;
  if (!visibleFilmBefore(here, film)) return RL_INVALID;
  uint before = pixelIndexOf(uvec2(uint(film.x), uint(film.y)));
  GBufferTexel there = visibleRead(gBuffers.visibleBefore, gFrame.previousCamera, before);
  return visibleIsSimilar(here, there, gParams.pairs.similarity) ? before : RL_INVALID;
}
