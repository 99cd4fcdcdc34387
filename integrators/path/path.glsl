// path: the yardstick. One path per pixel and frame; at each vertex one light sample and one BSDF
// sample, combined by the power heuristic (Veach 1997, chapter 9). Unbiased.
#define RL_WALK_STATE PathState

RL_FN void walkEscapes(RL_INOUT(PathState) state, RL_IN(Walk) walk, RL_IN(vec3) radiance,
                       float pdfLight) {
  float weight = pdfLight > 0.0f ? lightMisWeight(walk.pdfBsdf, pdfLight) : 1.0f;
  state.radiance += walk.throughput * radiance * weight;
}

RL_FN void walkEmits(RL_INOUT(PathState) state, RL_IN(Walk) walk, RL_IN(Surface) s, RL_IN(Hit) hit,
                     float pdfLight) {
  float weight = pdfLight > 0.0f ? lightMisWeight(walk.pdfBsdf, pdfLight) : 1.0f;
  state.radiance += walk.throughput * s.emission * weight;
}

RL_FN void walkAbsorbs(RL_INOUT(PathState) state, RL_IN(Walk) walk, RL_IN(vec3) transmittance) {}

RL_FN uint walkArrives(RL_INOUT(PathState) state, RL_IN(Walk) walk, RL_INOUT(Surface) s) {
  return 1u;
}

RL_FN bool walkLights(RL_INOUT(PathState) state, RL_IN(Walk) walk, RL_IN(Rng) rng, RL_IN(Surface) s,
                      RL_IN(LightSample) light, RL_IN(LightConnection) c) {
  float pdf;
  vec3 f = bsdfEvalAndPdf(s.bsdf, s.nGeoW, s.nShadeW, s.wo, c.dirW, pdf);
  if (rlIsBlack(f)) return false;
  float weight = c.isDelta ? 1.0f : lightMisWeight(c.pdfSolidAngle, pdf);
  state.unseen = walk.throughput * f * c.emitted * (c.geometry * weight / light.pdf);
  if (RL_HAS(RL_FEATURE_VOLUME))
    state.unseen *= exp(-surfaceSigma(s, walk.sigma, c.dirW) * c.distance);
  return true;
}

RL_FN void walkSees(RL_INOUT(PathState) state, RL_IN(Walk) walk, float transmittance) {
  state.radiance += state.unseen * transmittance;
}

RL_FN void walkScatters(RL_INOUT(PathState) state, RL_IN(Walk) walk, RL_IN(Surface) s,
                        RL_IN(BsdfDraw) draw) {}

RL_FN void walkSurvives(RL_INOUT(PathState) state, RL_IN(Walk) walk, float factor) {}

#include "core/transport/walk.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixel.y * gFrame.width + pixel.x;
  PathState state;
  state.radiance = vec3(0.0f, 0.0f, 0.0f);
  state.unseen = state.radiance;
  walkPath(state, pixel, cameraFilmBits(pixel));
  if (!rlIsFinite3(state.radiance)) {
    RL_HEALTH(RL_HEALTH_NONFINITE);
    state.radiance = vec3(0.0f, 0.0f, 0.0f);
  }
  gBuffers.radiance.data[pixelIndex] = state.radiance;
}
