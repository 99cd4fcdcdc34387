// The initial candidate of restir_gi: the path of a film sample, as one reservoir.
#include "integrators/restir_gi/sample.glsl"
#include "core/radiance_cache/termination.glsl"
#include "core/path_sample/path_record.glsl"
#include "core/path_sample/path_resample.glsl"

// unresampled: light that no other pixel could reuse. inView: light that the camera sees directly.
RL_FN PathReservoir sampleInitial(RL_IN(uvec2) pixel, uint film, RL_OUT(vec3) unresampled,
                                  RL_OUT(vec3) inView) {
  uint pixelIndex = pixelIndexOf(pixel);
  PathRecord p = pathRecordEmpty(film);
  p.end = cacheTerminationBegin(pixelIndex);
  walkPath(p, pixel, film);
  unresampled = p.unresampledRadiance;
  inView = p.inView;
  return pathResample(p, rngInit(gFrame.seed, pixelIndex, gFrame.frame));
}
