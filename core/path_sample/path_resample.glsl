// Resamples the candidates of a path (core/path_sample/path_record.glsl) into one reservoir.

// Adds indirect light: x2 and its radiance towards x1. A glossy x2 has three kinds of paths: lit by
// a light sample, continued to an emitter, and continued beyond x3.
RL_FN void pathAddIndirect(RL_INOUT(PathRecord) p, float throughAlpha, RL_IN(Rng) rng) {
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
  float inverseX1 = p.roulette * rlSafeDivide(1.0f, p.pdfX1);
  vec3 all = fLight + fEmitter + continuation;
  p.estimate += p.fX1 * all * inverseX1;
  bool isLambert = bsdfIsLambert(x2.bsdf);
  for (uint i = 0u; i < 3u; i = i + 1u) {
    if (isLambert && i > 0u) break;
    vec3 sent = isLambert ? all : i == 0u ? fLight : i == 1u ? fEmitter : continuation;
    real w = rlLuminance(p.fX1 * sent) * inverseX1;
    float u = rngDraw(rng, i == 0u   ? RL_DIM_RIS_INDIRECT
                           : i == 1u ? RL_DIM_RIS_EMITTER
                                     : RL_DIM_RIS_SUFFIX);
    if (!risAccept(p.wSum, w, u)) continue;
    p.chosen.path = p.x2;
    p.chosen.path.base = p.base;
    p.chosen.state.F = p.fX1 * sent * throughAlpha;
    p.chosen.path.radiance = sent;
    if (isLambert) continue;
    uint side = p.x2.kind & RL_PATH_BACK;
    if (i == 0u) {
      p.chosen.path.kind = RL_PATH_LIGHT_SAMPLE | side;
      p.chosen.path.radiance = p.lightAtX2;
      p.chosen.path.wi = p.lightDirX2;
      p.chosen.path.pdfLight = p.lightPdfX2;
    } else {
      p.chosen.path.kind = (i == 1u ? RL_PATH_EMITTER : RL_PATH_CONTINUATION) | side;
      p.chosen.path.radiance = i == 1u ? p.emittedAtX3 : p.suffixRadiance;
      p.chosen.path.wi = p.dirX2;
      p.chosen.path.pdfLight = i == 1u ? p.pdfLightAtX3 : 0.0f;
      p.chosen.state.F *= p.pdfX2;
    }
  }
}

// rng: of the pixel and frame.
RL_FN PathReservoir pathResample(RL_INOUT(PathRecord) p, RL_IN(Rng) rng) {
  if (p.isReusable != 0u) {
    float throughAlpha = pathAlphaTransmittance(p);
    Rng ofX1 = rng;
#ifdef RL_PATH_REPLAYS
    ofX1 = rngOfKey(p.key);
    ofX1.vertex = p.base + 1u;
#endif
    pathAddDirect(p, throughAlpha, ofX1);
    if (walkWants(p.base + 2u) && p.hasX2 != 0u) pathAddIndirect(p, throughAlpha, rng);
  }
  PathReservoir r = p.chosen;
  r.path.key = p.key;
  r.state.W = risContributionWeight(p.wSum, rlLuminance(r.state.F));
  r.state.residual = p.estimate - r.state.F * r.state.W;
  return r;
}
