// The candidate of a path sample, as the pass core/reuse/initial.glsl asks for it.

// specularLight: light that no other pixel could reuse (mirrors, glass), and what the method leaves
// to the path. lightInView: of lamps, and of their images in mirrors.
RL_FN PathReservoir sampleInitial(RL_IN(uvec2) pixel, uint film, RL_OUT(vec3) specularLight,
                                  RL_OUT(vec3) lightInView) {
  uint pixelIndex = pixelIndexOf(pixel);
  PathRecord p = pathRecordEmpty(film);
  p.end = cacheTerminationBegin(pixelIndex);
#ifdef RL_PATH_REPLAYS
  p.key = rngInit(gFrame.seed, pixelIndex, gFrame.frame).key.x;
  walkPathBy(p, rngOfKey(p.key), pixel, film);
#else
  walkPath(p, pixel, film);
#endif
  specularLight = p.unresampledRadiance;
  lightInView = p.inView;
  return pathResample(p, rngInit(gFrame.seed, pixelIndex, gFrame.frame));
}
