// restir_gi, initial pass: traces the pixel's path and turns what it met (gather.glsl) into one
// reservoir. In a still view the last frame's sample is one of the same pixel: it is merged here.
// What no other pixel could use (mirrors, glass, lights in view) is averaged over time alone.
#include "core/resampling/ris.glsl"
#include "core/resampling/shift.glsl"
#include "core/payload/path_sample.glsl"
#include "core/resampling/mis.glsl"
#include "core/resampling/merge.glsl"
#include "core/resampling/donors.glsl"
#include "integrators/restir_gi/store.glsl"
#include "integrators/restir_gi/over_time.glsl"
#include "integrators/restir_gi/gather.glsl"

// Path rays pass a partly transparent surface by chance, connections are dimmed by it. What the
// ray from x1 has found, it has found with a probability of T, the transmittance up to there: its
// integrand gets T, as every other pixel evaluates it, and its weight 1 / T. The coverage of a
// light that is itself partly transparent is such a factor, too; that of x2 is the same for every
// pixel and stays out.
RL_FN float giThroughAlpha(RL_IN(GiPath) p) {
  if (!RL_HAS(RL_FEATURE_ALPHA)) return 1.0f;
  if (p.isReusable == 0u || !(p.passedX1 < 1.0f)) return 1.0f;
  if (p.hasX2 == 0u && !(p.foundWeight > 0.0f)) return 1.0f;
  Ray segment;
  if (p.hasX2 != 0u) {
    vec3 d = p.x2.posW - p.x1PosW;
    segment.origin = surfaceOffset(p.x1PosW, p.x1NGeoW, p.x1PosError, d);
    segment.tMin = 0.0f;
    segment.dir = surfaceOffset(p.x2.posW, p.x2.normalW, p.x2.posError, -d) - segment.origin;
    segment.tMax = 1.0f;
  } else {
    segment =
        lightShadowRay(p.found, lightConnect(p.found, p.x1PosW), p.x1PosW, p.x1NGeoW, p.x1PosError);
  }
  Hit hit;
  float t = traceRay(segment, RL_RAY_SHADOW, 0u, hit);
  // 0: the two rays disagree by rounding; the path ray is believed, as it is among opaque
  // surfaces.
  return t > 0.0f ? t : 1.0f;
}

// Direct light: two techniques whose balance weights are inside the densities.
RL_FN void giAddDirect(RL_IN(GiPath) p, RL_IN(vec3) foundF, RL_IN(Rng) rng, RL_INOUT(real) wSum,
                       RL_INOUT(vec3) estimate, RL_INOUT(PathReservoir) r) {
  estimate += p.lightF * risContributionWeight(p.lightSum, rlLuminance(p.lightF)) +
              foundF * risContributionWeight(p.foundWeight, rlLuminance(foundF));
  // The first candidate is kept unless its weight is zero.
  if (risAccept(wSum, p.lightSum, 0.0f)) {
    r.path = pathOfLight(p.light, p.film);
    r.state.F = p.lightF;
  }
  if (risAccept(wSum, p.foundWeight, rngDraw(rng, RL_DIM_RIS_DIRECT))) {
    r.path = pathOfLight(p.found, p.film);
    r.state.F = foundF;
  }
}

// Indirect light: x2 and what it sends to x1; a glossy x2 has two kinds of paths, lit by a light
// sample and continued.
RL_FN void giAddIndirect(RL_IN(GiPath) p, float throughAlpha, RL_IN(Rng) rng, RL_INOUT(real) wSum,
                         RL_INOUT(vec3) estimate, RL_INOUT(PathReservoir) r) {
  vec3 zero = vec3(0.0f, 0.0f, 0.0f);
  vec3 fLight = zero;        // at x2, light sample
  vec3 continuation = zero;  // at x2, over pdfX2
  Bsdf b = p.x2.suffix.bsdf;
  vec3 nShadeX2 = p.x2.suffix.nShadeW;
  if (!rlIsBlack(p.lightAtX2)) {
    float pdf;
    vec3 f = bsdfEvalAndPdf(b, p.x2.normalW, nShadeX2, p.woX2, p.lightDirX2, pdf);
    float weight = p.lightPdfX2 > 0.0f ? lightMisWeight(p.lightPdfX2, pdf) : 1.0f;
    fLight = f * p.lightAtX2 * weight;
  }
  if (p.isSuffix != 0u) {
    float weight = p.pdfLightAtX3 > 0.0f ? lightMisWeight(p.pdfX2, p.pdfLightAtX3) : 1.0f;
    continuation = p.weightX2 * (p.rest + p.emittedAtX3 * weight);
  }
  // Of its resampling weight pHat W, W keeps what chance let the ray from x1 pass (giThroughAlpha).
  float inverseX1 = rlSafeDivide(1.0f, p.pdfX1);
  estimate += p.fX1 * (fLight + continuation) * inverseX1;
  bool isLambert = bsdfIsLambert(b);
  for (uint i = 0u; i < 2u; i = i + 1u) {
    bool isLight = i == 0u;
    if (isLambert && !isLight) break;
    vec3 sent = isLambert ? fLight + continuation : isLight ? fLight : continuation;
    real w = rlLuminance(p.fX1 * sent) * inverseX1;
    float u = rngDraw(rng, isLight ? RL_DIM_RIS_INDIRECT : RL_DIM_RIS_SUFFIX);
    if (!risAccept(wSum, w, u)) continue;
    r.path = p.x2;
    r.state.F = p.fX1 * sent * throughAlpha;
    r.path.radiance = sent;
    if (isLambert) continue;
    if (isLight) {
      r.path.kind = RL_PATH_LIGHT;
      r.path.radiance = p.lightAtX2;
      r.path.suffix.wi = p.lightDirX2;
      r.path.suffix.pdfLight = p.lightPdfX2;
    } else {
      r.path.kind = RL_PATH_CONTINUATION;
      r.path.radiance = p.rest;
      r.path.suffix.wi = p.dirX2;
      r.path.suffix.emitted = p.emittedAtX3;
      r.path.suffix.pdfLight = p.pdfLightAtX3;
      r.state.F *= p.pdfX2;
    }
  }
}

RL_FN PathReservoir giReservoir(RL_IN(GiPath) p, RL_IN(Rng) rng) {
  PathReservoir r;
  r.path = pathOfLight(giNoLight(), p.film);
  r.state = giEmptyState();
  if (p.isReusable == 0u) return r;
  float throughAlpha = giThroughAlpha(p);
  vec3 foundF = p.foundF;
  if (RL_HAS(RL_FEATURE_ALPHA)) foundF *= throughAlpha * p.foundCoverage;  // its weight stays
  real wSum = 0.0f;
  vec3 estimate = vec3(0.0f, 0.0f, 0.0f);
  if (walkWants(1u)) giAddDirect(p, foundF, rng, wSum, estimate, r);
  if (walkWants(2u) && p.hasX2 != 0u) giAddIndirect(p, throughAlpha, rng, wSum, estimate, r);
  r.state.W = risContributionWeight(wSum, rlLuminance(r.state.F));
  r.state.residual = estimate - r.state.F * r.state.W;
  return r;
}

// The merge over time of a still view: the shift is the identity, for every surface and path. Both
// are samples of one pixel, with one target: weights by confidence are exact.
RL_FN void giMergeStillView(uint slot, RL_INOUT(PathReservoir) r) {
  ReservoirState donor;
  giReadStateBefore(slot, donor);
  GiOverTime t;
  giBeginOverTime(t, donor, slot);
  t.ours = mergeUnshifted(r.state);
  t.theirs = mergeUnshifted(donor);
  t.ratio = vec3(1.0f, 1.0f, 1.0f);
  uint winner;
  float jacobian;
  reuseMerge(t, 1u, gParams.temporalFlags & ~RL_REUSE_PAIRWISE, r.state, winner, jacobian);
  if (winner != RL_INVALID) giReadPathBefore(slot, r.path);
}

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint slot = pixel.y * gFrame.width + pixel.x;
  uint film = cameraFilmBits(pixel);
  GiPath p = giNoPath(film);
  walkPath(p, pixel, film);
  PathReservoir r = giReservoir(p, rngInit(gFrame.seed, slot, gFrame.frame));
  vec3 estimate = r.state.F * r.state.W + r.state.residual;
  if (!rlIsFinite3(p.ownLight) || !rlIsFinite3(estimate)) {
    RL_HEALTH(RL_HEALTH_NONFINITE);
    p.ownLight = vec3(0.0f, 0.0f, 0.0f);
    r.state = giEmptyState();
  }
  float age = 1.0f;
  if (gParams.temporalReuse != 0u && gFrame.stillFrames != 0u) {
    vec4 own = recordVec4(RL_PAST_QUAD(gBuffers.ownBefore, slot));
    age = giNextAge(own.w);
    float weight = 1.0f / age;
    p.ownLight = vec3(own.x, own.y, own.z) * (1.0f - weight) + p.ownLight * weight;
    giMergeStillView(slot, r);
  }
  giWriteNow(slot, r);
  RL_WRITE_QUAD(gBuffers.own, slot, recordQuad(p.ownLight, floatBitsToUint(age)));
}
