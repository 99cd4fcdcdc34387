// Resamples the candidates of a path (core/path_sample/path_record.glsl) into one reservoir.

// Transmittance T from x1 to the vertex or light that the ray from x1 found. Path rays pass partly
// transparent surfaces at random, connections are attenuated by them. The ray from x1 finds its hit
// with probability T, so its integrand gets the factor T, as every other pixel evaluates it, and
// its weight the factor 1 / T. The coverage of a partly transparent light is such a factor, too.
// The coverage of x2 is the same for every pixel and stays out.
RL_FN float pathAlphaTransmittance(RL_IN(PathRecord) p) {
  if (!RL_HAS(RL_FEATURE_ALPHA)) return 1.0f;
  if (p.isReusable == 0u || !(p.alphaTransmittanceX1 < 1.0f)) return 1.0f;
  if (p.hasX2 == 0u && !(p.bsdfHitWeight > 0.0f)) return 1.0f;
  PathSample met = p.x2;
  if (p.hasX2 == 0u) met = pathOfLight(p.found, p.film);
  Ray segment = pathSegment(pathEnd(met), p.x1PosW, p.x1NGeoW, p.x1PosError);
  Hit hit;
  float t = traceRay(segment, RL_RAY_SHADOW, gFrame.cameraMedia.x, hit);
  // 0: the two rays disagree by rounding. Trust the path ray, as among opaque surfaces.
  return t > 0.0f ? t : 1.0f;
}

// Adds direct light: two techniques whose balance-heuristic weights are inside the densities.
RL_FN void pathAddDirect(RL_IN(PathRecord) p, RL_IN(vec3) bsdfHitIntegrand, RL_IN(Rng) rng,
                         RL_INOUT(real) wSum, RL_INOUT(vec3) estimate, RL_INOUT(PathReservoir) r) {
  estimate +=
      p.lightF * risContributionWeight(p.lightSum, rlLuminance(p.lightF)) +
      bsdfHitIntegrand * risContributionWeight(p.bsdfHitWeight, rlLuminance(bsdfHitIntegrand));
  // The first candidate is kept unless its weight is zero.
  if (risAccept(wSum, p.lightSum, 0.0f)) {
    r.path = pathOfLight(p.light, p.film);
    r.state.F = p.lightF;
  }
  if (risAccept(wSum, p.bsdfHitWeight, rngDraw(rng, RL_DIM_RIS_DIRECT))) {
    r.path = pathOfLight(p.found, p.film);
    r.state.F = bsdfHitIntegrand;
  }
}

// Adds indirect light: x2 and its radiance towards x1. A glossy x2 has three kinds of paths: lit by
// a light sample, continued to an emitter, and continued beyond x3.
RL_FN void pathAddIndirect(RL_IN(PathRecord) p, float throughAlpha, RL_IN(Rng) rng,
                           RL_INOUT(real) wSum, RL_INOUT(vec3) estimate,
                           RL_INOUT(PathReservoir) r) {
  vec3 zero = vec3(0.0f, 0.0f, 0.0f);
  vec3 fLight = zero;        // light sample at x2
  vec3 fEmitter = zero;      // emission at x3, over pdfX2
  vec3 continuation = zero;  // light beyond x3, over pdfX2
  Surface x2 = p.surfaceX2;
  if (!rlIsBlack(p.lightAtX2)) {
    float pdf;
    vec3 f = bsdfEvalAndPdf(x2.bsdf, x2.nGeoW, x2.nShadeW, x2.wo, p.lightDirX2, pdf);
    float weight = p.lightPdfX2 > 0.0f ? lightMisWeight(p.lightPdfX2, pdf) : 1.0f;
    fLight = f * p.lightAtX2 * weight;
  }
  if (p.isSuffix != 0u) {
    float weight = p.pdfLightAtX3 > 0.0f ? lightMisWeight(p.pdfX2, p.pdfLightAtX3) : 1.0f;
    fEmitter = p.weightX2 * p.emittedAtX3 * weight;
    continuation = p.weightX2 * p.suffixRadiance;
  }
  // F has the factor T of pathAlphaTransmittance(), the resampling weight pHat W does not: W
  // carries 1 / T.
  float inverseX1 = rlSafeDivide(1.0f, p.pdfX1);
  vec3 all = fLight + fEmitter + continuation;
  estimate += p.fX1 * all * inverseX1;
  bool isLambert = bsdfIsLambert(x2.bsdf);
  for (uint i = 0u; i < 3u; i = i + 1u) {
    if (isLambert && i > 0u) break;
    vec3 sent = isLambert ? all : i == 0u ? fLight : i == 1u ? fEmitter : continuation;
    real w = rlLuminance(p.fX1 * sent) * inverseX1;
    float u = rngDraw(rng, i == 0u   ? RL_DIM_RIS_INDIRECT
                           : i == 1u ? RL_DIM_RIS_EMITTER
                                     : RL_DIM_RIS_SUFFIX);
    if (!risAccept(wSum, w, u)) continue;
    r.path = p.x2;
    r.state.F = p.fX1 * sent * throughAlpha;
    r.path.radiance = sent;
    if (isLambert) continue;
    uint side = p.x2.kind & RL_PATH_BACK;
    if (i == 0u) {
      r.path.kind = RL_PATH_LIGHT | side;
      r.path.radiance = p.lightAtX2;
      r.path.wi = p.lightDirX2;
      r.path.pdfLight = p.lightPdfX2;
    } else {
      r.path.kind = (i == 1u ? RL_PATH_EMITTER : RL_PATH_CONTINUATION) | side;
      r.path.radiance = i == 1u ? p.emittedAtX3 : p.suffixRadiance;
      r.path.wi = p.dirX2;
      r.path.pdfLight = i == 1u ? p.pdfLightAtX3 : 0.0f;
      r.state.F *= p.pdfX2;
    }
  }
}

RL_FN PathReservoir pathResample(RL_IN(PathRecord) p, RL_IN(Rng) rng) {
  PathReservoir r;
  r.path = pathOfLight(pathNoLight(), p.film);
  r.state = reservoirEmpty();
  if (p.isReusable == 0u) return r;
  float throughAlpha = pathAlphaTransmittance(p);
  vec3 bsdfHitIntegrand = p.bsdfHitIntegrand;
  if (RL_HAS(RL_FEATURE_ALPHA))
    bsdfHitIntegrand *= throughAlpha * p.bsdfHitCoverage;  // bsdfHitWeight stays
  real wSum = 0.0f;
  vec3 estimate = vec3(0.0f, 0.0f, 0.0f);
  if (walkWants(1u)) pathAddDirect(p, bsdfHitIntegrand, rng, wSum, estimate, r);
  if (walkWants(2u) && p.hasX2 != 0u) pathAddIndirect(p, throughAlpha, rng, wSum, estimate, r);
  r.state.W = risContributionWeight(wSum, rlLuminance(r.state.F));
  r.state.residual = estimate - r.state.F * r.state.W;
  return r;
}
