// Path loop that sums the light found along a path: at each vertex one light sample and one BSDF
// sample, combined by the power heuristic (Veach 1997, chapter 9). The includer defines
// RL_WALK_STATE, a struct with a LightSum `sum`, and onVertex(), and onEnd() where RL_WALK_END is
// defined (core/transport/walk.glsl).

RL_FN void onMiss(RL_INOUT(RL_WALK_STATE) state, RL_IN(Walk) walk, RL_IN(vec3) radiance,
                  float pdfLight) {
  float weight = pdfLight > 0.0f ? lightMisWeight(walk.pdfBsdf, pdfLight) : 1.0f;
  state.sum.radiance += walk.throughput * radiance * weight;
}

RL_FN void onEmission(RL_INOUT(RL_WALK_STATE) state, RL_IN(Walk) walk, RL_IN(Surface) s,
                      RL_IN(Hit) hit, float pdfLight) {
  float weight = pdfLight > 0.0f ? lightMisWeight(walk.pdfBsdf, pdfLight) : 1.0f;
  state.sum.radiance += walk.throughput * s.emission * weight;
}

RL_FN void onMedium(RL_INOUT(RL_WALK_STATE) state, RL_IN(Walk) walk, RL_IN(vec3) transmittance) {}

RL_FN bool onLightSample(RL_INOUT(RL_WALK_STATE) state, RL_IN(Walk) walk, RL_IN(Rng) rng,
                         RL_IN(Surface) s, RL_IN(LightSample) light, RL_IN(LightConnection) c) {
  float pdf;
  vec3 f = bsdfEvalAndPdf(s.bsdf, s.nGeoW, s.nShadeW, s.wo, c.dirW, pdf);
  if (rlIsBlack(f)) return false;
  float weight = c.isDelta ? 1.0f : lightMisWeight(c.pdfSolidAngle, pdf);
  state.sum.unseen = walk.throughput * f * c.emitted * (c.geometry * weight / light.pdf);
  if (RL_HAS(RL_FEATURE_VOLUME))
    state.sum.unseen *= exp(-surfaceSigma(s, walk.sigma, c.dirW) * c.distance);
  return true;
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
