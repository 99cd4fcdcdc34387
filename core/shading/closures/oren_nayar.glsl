// Facets that are Lambert (Oren and Nayar 1994): the full model with interreflection, the form of
// Fujii ("A tiny improvement of Oren-Nayar reflectance model", 2012), and one that conserves energy
// (Portsmouth, Kutz and Hill, "EON: A practical energy-preserving rough diffuse BRDF", JCGT 2025).
//   p0: albedo, sigma; p1.x: the model
#ifdef RL_CLOSURE_DECLARED
info.is("rough diffuse surface: facets that are Lambert",
        "Oren and Nayar 1994; Fujii 2012; Portsmouth et al. 2025");
info.color("color", 0.8, "albedo of the facets");
info.number("sigma", 0.5, 0.0, 1.0,
            "full: deviation of the facets' slope angle, radians; else roughness");
info.choice("model", {"full", "fujii", "conserving"},
            "full: 1994, with interreflection; conserving: no energy is lost");
#else

RL_FN void orenNayarLoad(RL_INOUT(Bsdf) b, RL_IN(MaterialPoint) at) {
  b.diffuse = closureColor(at, 0u);
  b.p0 = vec4(b.diffuse, closureNumber(at, 1u));
  b.p1.x = float(closureChoice(at, 2u));
  if (!rlIsBlack(b.diffuse)) b.lobes = RL_LOBE_DIFFUSE | RL_LOBE_ROUGH_DIFFUSE;
}

// Equation 30 of the paper, over albedo / pi: direct light and one interreflection. cosPhi: of the
// angle between the azimuths.
RL_FN vec3 orenNayarFull(RL_IN(vec3) albedo, float sigma, float cosI, float cosO, float cosPhi) {
  float sigma2 = sigma * sigma;
  float thetaI = acos(min(cosI, 1.0f));
  float thetaO = acos(min(cosO, 1.0f));
  float alpha = max(thetaI, thetaO);
  float beta = min(thetaI, thetaO);
  float b = beta * (2.0f * RL_INV_PI);
  float c1 = 1.0f - 0.5f * sigma2 / (sigma2 + 0.33f);
  float c2 = 0.45f * sigma2 / (sigma2 + 0.09f);
  c2 *= cosPhi >= 0.0f ? sin(alpha) : sin(alpha) - b * b * b;
  float ab = 4.0f * alpha * beta * (RL_INV_PI * RL_INV_PI);
  float c3 = 0.125f * sigma2 / (sigma2 + 0.09f) * ab * ab;
  float direct =
      c1 + cosPhi * c2 * tan(beta) + (1.0f - abs(cosPhi)) * c3 * tan(0.5f * (alpha + beta));
  float between = 0.17f * sigma2 / (sigma2 + 0.13f) * (1.0f - cosPhi * b * b);
  return max(vec3(direct, direct, direct) + albedo * between, vec3(0.0f, 0.0f, 0.0f));
}

// Albedo of Fujii's form with a white facet, over its factor A.
RL_FN float orenNayarAlbedo(float cosTheta, float roughness) {
  float c = clamp(cosTheta, 1.0e-4f, 1.0f);
  float s = sqrt(max(0.0f, 1.0f - c * c));
  float g = s * (acos(c) - s * c) + (2.0f / 3.0f) * ((s / c) * (1.0f - s * s * s) - s);
  return 1.0f + roughness * RL_INV_PI * g;
}

RL_FN vec3 orenNayarEval(RL_IN(Bsdf) b, RL_IN(vec3) woL, RL_IN(vec3) wiL, RL_OUT(float) pdf) {
  pdf = 0.0f;
  vec3 albedo = vec3(b.p0);
  float sigma = b.p0.w;
  if (!(wiL.z > 0.0f)) return vec3(0.0f, 0.0f, 0.0f);
  pdf = lambertPdf(wiL);
  uint model = uint(b.p1.x);
  float s = woL.x * wiL.x + woL.y * wiL.y;
  if (model == 0u) {
    float sines = sqrt(max(0.0f, (1.0f - woL.z * woL.z) * (1.0f - wiL.z * wiL.z)));
    float cosPhi = sines > 1.0e-6f ? clamp(s / sines, -1.0f, 1.0f) : 0.0f;
    return albedo * orenNayarFull(albedo, sigma, wiL.z, woL.z, cosPhi) * lambertEval(wiL);
  }
  float t = s > 0.0f ? max(woL.z, wiL.z) : 1.0f;
  float a = 1.0f / (1.0f + (0.5f - 2.0f / 3.0f * RL_INV_PI) * sigma);
  vec3 f = albedo * (a * (1.0f + sigma * s / t));
  if (model == 2u) {
    float mean = a * (1.0f + (2.0f / 3.0f - 28.0f / 15.0f * RL_INV_PI) * sigma);
    float lostO = 1.0f - a * orenNayarAlbedo(woL.z, sigma);
    float lostI = 1.0f - a * orenNayarAlbedo(wiL.z, sigma);
    float between = max(lostO, 0.0f) * max(lostI, 0.0f) / max(1.0f - mean, 1.0e-7f);
    vec3 rest = vec3(1.0f, 1.0f, 1.0f) - albedo * (1.0f - mean);
    f += albedo * albedo * (mean * between) / rest;
  }
  return f * lambertEval(wiL);
}

RL_FN BsdfSample orenNayarSample(RL_IN(Bsdf) b, RL_IN(vec3) woL, float uLobe, RL_IN(vec2) u) {
  BsdfSample s = bsdfSampleNone();
  s.wi = lambertDraw(u);
  s.lobe = RL_LOBE_DIFFUSE;
  return s;
}
#endif
