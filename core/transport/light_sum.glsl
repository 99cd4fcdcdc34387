// Path loop that sums the light found along a path: at each vertex one light sample and one BSDF
// sample (core/transport/light_terms.glsl). The includer defines
// RL_WALK_STATE, a struct with a LightSum `sum`, and onVertex(), and onEnd() where RL_WALK_END is
// defined (core/transport/walk.glsl).

#include "core/transport/light_terms.glsl"

RL_FN void onMiss(RL_INOUT(RL_WALK_STATE) state, RL_IN(Walk) walk, RL_IN(vec3) radiance,
                  float pdfLight) {
  state.sum.radiance += lightFound(walk, radiance, pdfLight);
}

RL_FN void onEmission(RL_INOUT(RL_WALK_STATE) state, RL_IN(Walk) walk, RL_IN(Surface) s,
                      RL_IN(Hit) hit, float pdfLight) {
  state.sum.radiance += lightFound(walk, s.emission, pdfLight);
}

RL_FN void onMedium(RL_INOUT(RL_WALK_STATE) state, RL_IN(Walk) walk, RL_IN(vec3) transmittance) {}

RL_FN bool onLightSample(RL_INOUT(RL_WALK_STATE) state, RL_IN(Walk) walk, RL_IN(Rng) rng,
                         RL_IN(Surface) s, RL_IN(LightSample) light, RL_IN(LightConnection) c) {
  vec3 unshadowed;
  bool isReflected = lightSampled(walk, s, light, c, unshadowed);
  state.sum.unseen = unshadowed;
  return isReflected;
}

RL_FN void onShadowRay(RL_INOUT(RL_WALK_STATE) state, RL_IN(Walk) walk, float transmittance) {
  state.sum.radiance += state.sum.unseen * transmittance;
}

RL_FN void onBsdfSample(RL_INOUT(RL_WALK_STATE) state, RL_IN(Walk) walk, RL_IN(Surface) s,
                        RL_IN(BsdfSample) draw) {}

RL_FN void onRoulette(RL_INOUT(RL_WALK_STATE) state, RL_IN(Walk) walk, float factor) {}

#include "core/transport/walk.glsl"

RL_FN LightSum lightSumNone() {
  LightSum s;
  s.radiance = vec3(0.0f, 0.0f, 0.0f);
  s.unseen = vec3(0.0f, 0.0f, 0.0f);
  return s;
}
