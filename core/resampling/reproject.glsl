// Temporal donors: the pixel of the last frame that showed a surface. The includer has
// gParams.pairs and gbufferPrevious(pixelIndex), the surface that a pixel showed in the last frame.

// Returns the last frame's pixel that shows the surface of a pixel; RL_INVALID if the surface was
// out of view or another one is there.
RL_FN uint reprojectedPixelIndex(RL_IN(GBufferTexel) here) {
  if (isFirstFrame()) return RL_INVALID;
  vec2 film;
  if (!filmPointPrevious(here, film)) return RL_INVALID;
  uint before = pixelIndexOf(uvec2(uint(film.x), uint(film.y)));
  return gbufferIsSimilar(here, gbufferPrevious(before), gParams.pairs.similarity) ? before
                                                                                   : RL_INVALID;
}
