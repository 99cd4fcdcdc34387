// The light in view of a pixel, as the pass core/reuse/light_edges.glsl samples it: what PathRecord
// gathers as inView. Walks from mirror to mirror, and ends at the first surface that is none.
#define RL_WALK_STATE PathInView

#include "core/path_sample/path_connect.glsl"
#include "core/transport/light_terms.glsl"

RL_FN void onEmission(RL_INOUT(PathInView) p, RL_IN(Walk) walk, RL_IN(Surface) s, RL_IN(Hit) hit,
                      float pdfLight) {
  p.radiance += lightFound(walk, s.emission, pdfLight);
}
RL_FN uint onVertex(RL_INOUT(PathInView) p, RL_IN(Walk) walk, RL_INOUT(Surface) s) {
  return pathIsMirror(s) ? 1u : RL_WALK_ENDS;
}
RL_FN bool onLightSample(RL_INOUT(PathInView) p, RL_IN(Walk) walk, RL_IN(Rng) rng, RL_IN(Surface) s,
                         RL_IN(LightSample) light, RL_IN(LightConnection) c) {
  vec3 unshadowed;
  bool isReflected = lightSampled(walk, s, light, c, unshadowed);
  p.unshadowed = unshadowed;
  return isReflected;
}
RL_FN void onShadowRay(RL_INOUT(PathInView) p, RL_IN(Walk) walk, float transmittance) {
  p.radiance += p.unshadowed * transmittance;
}

// The other events of a walk change nothing. The environment is not light in view: objects before
// the sky are often as bright as the sky, and in a white furnace an image is then exact.
RL_FN void onMiss(RL_INOUT(PathInView) p, RL_IN(Walk) walk, RL_IN(vec3) radiance, float pdfLight) {}
RL_FN void onMedium(RL_INOUT(PathInView) p, RL_IN(Walk) walk, RL_IN(vec3) transmittance) {}
RL_FN void onBsdfSample(RL_INOUT(PathInView) p, RL_IN(Walk) walk, RL_IN(Surface) s,
                        RL_IN(BsdfSample) draw) {}
RL_FN void onRoulette(RL_INOUT(PathInView) p, RL_IN(Walk) walk, float factor) {}

#include "core/transport/walk.glsl"

// Returns one sample of the light in view of a pixel, through a film sample.
RL_FN vec3 sampleLightInView(RL_IN(uvec2) pixel, uint film, RL_IN(Rng) rng) {
  PathInView p;
  p.radiance = vec3(0.0f, 0.0f, 0.0f);
  p.unshadowed = p.radiance;
  walkPathBy(p, rng, pixel, film);
  return p.radiance;
}
