// Adds the light samples of x1, and the light that its BSDF sample found, to what is resampled of a
// path (core/path_sample/path_record.glsl).

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
  float t = traceRay(segment, RL_RAY_SHADOW, p.rankX1, hit);
  // 0: the two rays disagree by rounding. Trust the path ray, as among opaque surfaces.
  return t > 0.0f ? t : 1.0f;
}

// Names what is selected.
RL_FN void pathChooseLight(RL_INOUT(PathRecord) p, RL_IN(LightSample) light, RL_IN(vec3) F) {
  p.chosen.path = pathOfLight(light, p.film);
  p.chosen.state.F = F;
#ifdef RL_PATH_REPLAYS
  p.chosen.path.base = p.base;
  if (!pathIsSmoothX1(p)) return;
  p.chosen.path.kind = (p.chosen.path.kind & ~RL_PATH_KIND_MASK) | RL_PATH_WEIGHED;
#endif
}

// Two techniques, whose balance-heuristic weights are inside the densities. With an unshadowed
// target light samples are alone: a BSDF sample finds visible points only, and the weight of an
// occluded point at another pixel would lack its share. rng: at a vertex where nothing was
// selected.
RL_FN void pathAddDirect(RL_INOUT(PathRecord) p, float throughAlpha, RL_IN(Rng) rng) {
  vec3 bsdfHitIntegrand = p.bsdfHitIntegrand;
  real bsdfHitWeight = p.bsdfHitWeight;
  if (RL_HAS(RL_FEATURE_ALPHA))
    bsdfHitIntegrand *= throughAlpha * p.bsdfHitCoverage;  // bsdfHitWeight stays
  if (pathHasUnshadowedTarget()) bsdfHitWeight = 0.0f;
  p.estimate +=
      p.lightF * risContributionWeight(p.lightSum, rlLuminance(p.lightF)) +
      bsdfHitIntegrand * risContributionWeight(bsdfHitWeight, rlLuminance(bsdfHitIntegrand));
  float uLight = 0.0f;  // the first candidate is kept unless its weight is zero
#ifdef RL_PATH_REPLAYS
  uLight = rngDraw(rng, RL_DIM_RIS_PREFIX);
#endif
  if (risAccept(p.wSum, p.lightSum, uLight)) pathChooseLight(p, p.light, p.lightF);
  if (risAccept(p.wSum, bsdfHitWeight, rngDraw(rng, RL_DIM_RIS_DIRECT)))
    pathChooseLight(p, p.found, bsdfHitIntegrand);
}
