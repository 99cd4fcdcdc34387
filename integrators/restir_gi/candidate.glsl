// The initial candidate of restir_gi: the path of a film sample, as one reservoir.
#include "integrators/restir_gi/sample.glsl"
#include "core/radiance_cache/termination.glsl"
#include "core/path_sample/path_record.glsl"
#include "core/path_sample/path_resample.glsl"

// specularLight: light that no other pixel could reuse (mirrors, glass). visibleEmission: that of a
// lamp which the camera sees.
RL_FN PathReservoir sampleInitial(RL_IN(uvec2) pixel, uint film, RL_OUT(vec3) specularLight,
                                  RL_OUT(vec3) visibleEmission) {
  uint pixelIndex = pixelIndexOf(pixel);
  PathRecord p = pathRecordEmpty(film);
  p.end = cacheTerminationBegin(pixelIndex);
  walkPath(p, pixel, film);
  specularLight = p.unresampledRadiance;
  visibleEmission = p.inView;
  return pathResample(p, rngInit(gFrame.seed, pixelIndex, gFrame.frame));
}
