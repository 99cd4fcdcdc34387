// restir_gi, initial pass: traces the pixel's path and turns what it met (gather.glsl) into the
// reservoirs of direct and of indirect light.
#include "core/resampling/ris.glsl"
#include "integrators/restir_gi/store.glsl"
#include "core/caches/cache.glsl"
#include "core/caches/pixel.glsl"
#include "integrators/restir_gi/gather.glsl"

RL_FN ReservoirState giEmptyState() {
  ReservoirState state;
  state.F = vec3(0.0f, 0.0f, 0.0f);
  state.W = 0.0f;
  state.residual = vec3(0.0f, 0.0f, 0.0f);
  state.confidence = 1.0f;
  return state;
}

// Path rays pass a partly transparent surface by chance, connections are dimmed by it. What the
// ray from x1 has found, it has found with a probability of T, the transmittance up to there: its
// integrand gets T, as every other pixel evaluates it, and its weight 1 / T. The coverage of a
// light that is itself partly transparent is such a factor, too; that of x2 is the same for every
// pixel and stays out.
RL_FN float giThroughAlpha(RL_IN(GiPath) p) {
  if (!RL_HAS(RL_FEATURE_ALPHA)) return 1.0f;
  if (p.anchor.isReusable == 0u || !(p.passedX1 < 1.0f)) return 1.0f;
  if (p.hasX2 == 0u && !(p.foundWeight > 0.0f)) return 1.0f;
  Anchor a = p.anchor;
  Ray segment;
  if (p.hasX2 != 0u) {
    vec3 d = p.x2.posW - a.posW;
    segment.origin = surfaceOffset(a.posW, a.nGeoW, a.posError, d);
    segment.tMin = 0.0f;
    segment.dir = surfaceOffset(p.x2.posW, p.x2.nGeoW, p.x2.posError, -d) - segment.origin;
    segment.tMax = 1.0f;
  } else {
    segment = lightShadowRay(p.found, lightConnect(p.found, a.posW), a.posW, a.nGeoW, a.posError);
  }
  Hit hit;
  float t = traceRay(segment, RL_RAY_SHADOW, 0u, hit);
  // 0: the two rays disagree by rounding; the path ray is believed, as it is among opaque
  // surfaces.
  return t > 0.0f ? t : 1.0f;
}

// Direct light: one reservoir of two techniques whose balance weights are inside the densities.
RL_FN LightReservoir giDirectReservoir(RL_IN(GiPath) p, RL_IN(vec3) foundF, RL_IN(Rng) rng) {
  LightReservoir r;
  r.light = p.light;
  r.state = giEmptyState();
  if (p.anchor.isReusable == 0u) return r;
  real lightW = risContributionWeight(p.lightSum, rlLuminance(p.lightF));
  vec3 estimate =
      p.lightF * lightW + foundF * risContributionWeight(p.foundWeight, rlLuminance(foundF));
  real wSum = 0.0f;
  // The first candidate is kept unless its weight is zero.
  if (risAccept(wSum, p.lightSum, 0.0f)) r.state.F = p.lightF;
  if (risAccept(wSum, p.foundWeight, rngDraw(rng, RL_DIM_RIS_DIRECT))) {
    r.light = p.found;
    r.state.F = foundF;
  }
  r.state.W = risContributionWeight(wSum, rlLuminance(r.state.F));
  r.state.residual = estimate - r.state.F * r.state.W;
  return r;
}

// Indirect light: x2 and what it sends to x1, of which a glossy x2 keeps one of two kinds.
RL_FN PathReservoir giIndirectReservoir(RL_IN(GiPath) p, float throughAlpha, RL_IN(Rng) rng) {
  PathReservoir r;
  r.vertex = p.x2;
  r.suffix = p.suffix;
  r.state = giEmptyState();
  if (p.hasX2 == 0u) return r;
  vec3 zero = vec3(0.0f, 0.0f, 0.0f);
  vec3 fLight = zero;        // at x2, light sample
  vec3 continuation = zero;  // at x2, over pdfX2
  if (!rlIsBlack(p.lightAtX2)) {
    float weight = 1.0f;
    if (p.lightPdfX2 > 0.0f) {
      weight = lightMisWeight(
          p.lightPdfX2, bsdfPdf(p.suffix.bsdf, p.x2.nGeoW, p.suffix.nShadeW, p.woX2, p.lightDirX2));
    }
    fLight = bsdfEval(p.suffix.bsdf, p.x2.nGeoW, p.suffix.nShadeW, p.woX2, p.lightDirX2) *
             p.lightAtX2 * weight;
  }
  if (p.isSuffix != 0u) {
    float weight = p.pdfLightAtX3 > 0.0f ? lightMisWeight(p.pdfX2, p.pdfLightAtX3) : 1.0f;
    continuation = p.weightX2 * (p.rest + p.emittedAtX3 * weight);
  }
  float inverseX1 = rlSafeDivide(1.0f, p.pdfX1);
  if (!RL_HAS(RL_FEATURE_GLOSSY) || p.suffix.bsdf.lobes == RL_LOBE_DIFFUSE) {
    r.vertex.radiance = fLight + continuation;
    r.state.F = p.fX1 * r.vertex.radiance;
    r.state.W = rlLuminance(r.state.F) > 0.0f ? inverseX1 : 0.0f;
  } else {
    // Two disjoint kinds of paths: one is selected, the estimate keeps the colours of both.
    vec3 fOfContinuation = p.fX1 * continuation * p.pdfX2;
    real wSum = 0.0f;
    r.state.F = p.fX1 * fLight;
    bool any = risAccept(wSum, rlLuminance(r.state.F) * inverseX1, 0.0f);
    r.vertex.kind = RL_PATH_LIGHT;
    r.vertex.radiance = p.lightAtX2;
    r.suffix.wi = p.lightDirX2;
    r.suffix.pdfLight = p.lightPdfX2;
    real wContinuation = rlLuminance(fOfContinuation) * inverseX1 * rlSafeDivide(1.0f, p.pdfX2);
    if (risAccept(wSum, wContinuation, rngDraw(rng, RL_DIM_RIS_SUFFIX)) || !any) {
      r.vertex.kind = RL_PATH_CONTINUATION;
      r.vertex.radiance = p.rest;
      r.suffix.wi = p.dirX2;
      r.suffix.emitted = p.emittedAtX3;
      r.suffix.pdfLight = p.pdfLightAtX3;
      r.state.F = fOfContinuation;
    }
    r.state.W = risContributionWeight(wSum, rlLuminance(r.state.F));
    vec3 estimate = p.fX1 * (fLight + continuation) * inverseX1;
    r.state.residual = estimate - r.state.F * r.state.W;
  }
  if (RL_HAS(RL_FEATURE_ALPHA)) {
    r.state.F *= throughAlpha;
    r.state.W /= throughAlpha;
  }
  if (!(r.state.W > 0.0f)) {
    r.state.W = 0.0f;
    r.state.F = zero;
    r.state.residual = zero;
  }
  return r;
}

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint slot = cacheSlot(pixel);
  GiPath p = giNoPath();
  walkPath(p, pixel);
  float throughAlpha = giThroughAlpha(p);
  vec3 foundF = p.foundF;
  if (RL_HAS(RL_FEATURE_ALPHA)) foundF *= throughAlpha * p.foundCoverage;  // its weight stays
  Rng rng = rngInit(gFrame.seed, slot, gFrame.frame);
  LightReservoir direct = giDirectReservoir(p, foundF, rng);
  PathReservoir path = giIndirectReservoir(p, throughAlpha, rng);
  bool finite = rlIsFinite3(p.ownLight) &&
                rlIsFinite3(direct.state.F * direct.state.W + direct.state.residual) &&
                rlIsFinite3(path.state.F * path.state.W + path.state.residual);
  if (!finite) {
    RL_HEALTH(RL_HEALTH_NONFINITE);
    p.ownLight = vec3(0.0f, 0.0f, 0.0f);
    direct.state = giEmptyState();
    path.state = giEmptyState();
  }
  gBuffers.ownLight.data[slot] = p.ownLight;
  cacheWriteAnchor(slot, p.anchor);
  if (walkWants(1u)) cacheWriteNow(slot, direct);
  if (walkWants(2u)) cacheWriteNow(slot, path);
}
