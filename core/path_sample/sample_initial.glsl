// The candidate of a path sample, as the pass core/reuse/initial.glsl asks for it.

// specularLight: light that no other pixel could reuse (mirrors, glass), and what the method leaves
// to the path. visibleEmission: that of a lamp which the camera sees.
RL_FN PathReservoir sampleInitial(RL_IN(uvec2) pixel, uint film, RL_OUT(vec3) specularLight,
                                  RL_OUT(vec3) visibleEmission) {
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
  visibleEmission = p.inView;
  return pathResample(p, rngInit(gFrame.seed, pixelIndex, gFrame.frame));
}
