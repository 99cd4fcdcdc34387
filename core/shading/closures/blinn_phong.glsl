// Blinn's lobe about the half vector (1977), diffuse + specular (n . h)^power: as it was written,
// without the cosine, and normalised, so that it reflects at most `specular` (the integral of the
// lobe at normal incidence).
//   p0: diffuse albedo, power; p1: factor of the lobe; p1.w: 1 where the lobe has no cosine
#ifdef RL_CLOSURE_DECLARED
info.is("diffuse and a lobe of a power about the half vector", "Blinn 1977");
info.color("diffuse", 0.5, "normalised: albedo of the diffuse part; raw: that over pi");
info.color("specular", 0.5, "factor of the lobe; normalised: its albedo at normal incidence");
info.number("power", 80.0, 0.0, 1.0e5, "exponent of the cosine between normal and half vector");
info.choice("model", {"raw", "normalised"},
            "raw: as of 1977, breaks laws; normalised: with the cosine");
info.breaks({"energy", "reciprocity"}, "model", "raw");
info.convex({"diffuse", "specular"});
#else

RL_FN void blinnPhongLoad(RL_INOUT(Bsdf) b, RL_IN(MaterialPoint) at) {
  bool isRaw = closureChoice(at, 3u) == 0u;
  b.diffuse = closureColor(at, 0u) * (isRaw ? RL_PI : 1.0f);
  vec3 specular = closureColor(at, 1u);
  float power = closureNumber(at, 2u);
  float integral = 8.0f * RL_PI * (exp2(-0.5f * power) + power) / ((power + 2.0f) * (power + 4.0f));
  b.p0 = vec4(b.diffuse, power);
  b.p1 = vec4(isRaw ? specular : specular * (1.0f / integral), isRaw ? 1.0f : 0.0f);
  b.f0 = specular;
  if (isRaw) b.f0 *= 8.0f * RL_PI / (power + 2.0f);
  b.alpha = powerAlpha(power);
  if (!rlIsBlack(b.diffuse)) b.lobes = b.lobes | RL_LOBE_DIFFUSE;
  if (!rlIsBlack(specular)) b.lobes = b.lobes | RL_LOBE_SPECULAR;
}

RL_FN vec3 blinnPhongEval(RL_IN(Bsdf) b, RL_IN(vec3) woL, RL_IN(vec3) wiL, RL_OUT(float) pdf) {
  pdf = 0.0f;
  if (!(wiL.z > 0.0f)) return vec3(0.0f, 0.0f, 0.0f);
  vec3 hL = normalize(woL + wiL);
  float fall = powerFall(hL, vec3(0.0f, 0.0f, 1.0f));
  float share = specularShare(b.f0, b.diffuse);
  float pdfH = powerPdf(fall, b.p0.w) / max(4.0f * dot(woL, hL), 1.0e-12f);
  pdf = share * pdfH + (1.0f - share) * lambertPdf(wiL);
  float cosI = b.p1.w != 0.0f ? 1.0f : wiL.z;
  return vec3(b.p0) * lambertEval(wiL) + vec3(b.p1) * (powerOf(fall, b.p0.w) * cosI);
}

RL_FN BsdfSample blinnPhongSample(RL_IN(Bsdf) b, RL_IN(vec3) woL, float uLobe, RL_IN(vec2) u) {
  BsdfSample s = bsdfSampleNone();
  bool isSpecular = uLobe < specularShare(b.f0, b.diffuse);
  s.wi = lambertDraw(u);
  if (isSpecular) {
    vec3 hL = powerDraw(b.p0.w, u);
    float cosH = dot(woL, hL);
    if (!(cosH > 0.0f)) return s;
    s.wi = hL * (2.0f * cosH) - woL;
  }
  if (s.wi.z > 0.0f) s.lobe = isSpecular ? RL_LOBE_SPECULAR : RL_LOBE_DIFFUSE;
  return s;
}
#endif
