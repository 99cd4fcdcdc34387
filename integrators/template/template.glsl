// template: the smallest integrator that is complete, made to be copied (CONTRIBUTING.md).
//
// Estimator: one path per pixel and frame. Every vertex takes one light sample and goes on in one
// direction drawn from its BSDF, which may meet a light, too. MIS weights: p^b / (p^b + q^b) of the
// two densities (Veach 1997, section 9.2.3; b is the parameter mis_exponent). Bias: none, the
// weights of the techniques that can make a path sum to one, and every path has one.
//
// The walk traces the path (core/transport/walk.glsl); the functions here handle the light that it
// finds.
#define RL_WALK_STATE TemplateState

// MIS weight of a technique with density p against one with density q.
RL_FN float templateMisWeight(float p, float q) {
  return p > 0.0f ? 1.0f / (1.0f + pow(q / p, gParams.misExponent)) : 0.0f;
}

// Adds the light of a ray that left the scene or hit an emitter.
RL_FN void templateAdd(RL_INOUT(TemplateState) state, RL_IN(Walk) walk, RL_IN(vec3) radiance,
                       float pdfLight) {
  float weight = pdfLight > 0.0f ? templateMisWeight(walk.pdfBsdf, pdfLight) : 1.0f;
  state.radiance += walk.throughput * radiance * weight;
}
RL_FN void onMiss(RL_INOUT(TemplateState) state, RL_IN(Walk) walk, RL_IN(vec3) radiance,
                  float pdfLight) {
  templateAdd(state, walk, radiance, pdfLight);
}
RL_FN void onEmission(RL_INOUT(TemplateState) state, RL_IN(Walk) walk, RL_IN(Surface) s,
                      RL_IN(Hit) hit, float pdfLight) {
  templateAdd(state, walk, s.emission, pdfLight);
}

// Light sample of a vertex, then its visibility.
RL_FN bool onLightSample(RL_INOUT(TemplateState) state, RL_IN(Walk) walk, RL_IN(Rng) rng,
                         RL_IN(Surface) s, RL_IN(LightSample) light, RL_IN(LightConnection) c) {
  float pdf;
  vec3 f = bsdfEvalAndPdf(s.bsdf, s.nGeoW, s.nShadeW, s.wo, c.dirW, pdf);
  if (rlIsBlack(f)) return false;
  // No BSDF sample can hit a point light or a directional light.
  float weight = c.isDelta ? 1.0f : templateMisWeight(c.pdfSolidAngle, pdf);
  vec3 arriving = c.emitted * (c.geometry * weight / light.pdf);
  if (RL_HAS(RL_FEATURE_VOLUME)) arriving *= exp(-surfaceSigma(s, walk.sigma, c.dirW) * c.distance);
  state.unseen = walk.throughput * f * arriving;
  return true;
}
RL_FN void onShadowRay(RL_INOUT(TemplateState) state, RL_IN(Walk) walk, float transmittance) {
  state.radiance += state.unseen * transmittance;
}

// Hooks that are not needed here; one light sample per vertex.
RL_FN uint onVertex(RL_INOUT(TemplateState) state, RL_IN(Walk) walk, RL_INOUT(Surface) s) {
  return 1u;
}
RL_FN void onMedium(RL_INOUT(TemplateState) state, RL_IN(Walk) walk, RL_IN(vec3) passed) {}
RL_FN void onBsdfSample(RL_INOUT(TemplateState) state, RL_IN(Walk) walk, RL_IN(Surface) s,
                        RL_IN(BsdfSample) draw) {}
RL_FN void onRoulette(RL_INOUT(TemplateState) state, RL_IN(Walk) walk, float factor) {}

#include "core/transport/walk.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  TemplateState state;
  state.radiance = vec3(0.0f, 0.0f, 0.0f);
  state.unseen = state.radiance;
  walkPath(state, pixel, cameraFilmBits(pixel));
  if (!rlIsFinite3(state.radiance)) {
    RL_HEALTH(RL_HEALTH_NONFINITE);
    state.radiance = vec3(0.0f, 0.0f, 0.0f);
  }
  gBuffers.radiance.data[pixel.y * gFrame.width + pixel.x] = state.radiance;
}
