// Phong's model (1975) as it was written, f |cos_i| = diffuse |cos_i| + specular (R_n(wi) .
// wo)^power, and the modified one (Lafortune and Willems 1994), which is reciprocal and conserves
// energy.
//   p0: diffuse albedo, power; p1: factor of the lobe; p1.w: 1 where the lobe has no cosine
#ifdef RL_CLOSURE_DECLARED
info.is("diffuse and a lobe of a power about the mirrored direction",
        "Phong 1975; Lafortune and Willems 1994");
info.color("diffuse", 0.5, "modified: albedo of the diffuse part; raw: that over pi");
info.color("specular", 0.5, "factor of the lobe; modified: its albedo at normal incidence");
info.number("power", 20.0, 0.0, 1.0e5, "exponent of the cosine to the mirrored direction");
info.choice("model", {"raw", "modified"},
            "raw: as of 1975, breaks laws; modified: normalised, with the cosine");
info.breaks({"energy", "reciprocity"}, "model", "raw");
info.convex({"diffuse", "specular"});
#else

RL_FN void phongLoad(RL_INOUT(Bsdf) b, RL_IN(MaterialPoint) at) {
  bool isRaw = closureChoice(at, 3u) == 0u;
  b.diffuse = closureColor(at, 0u) * (isRaw ? RL_PI : 1.0f);
  vec3 specular = closureColor(at, 1u);
  float power = closureNumber(at, 2u);
  float factor = isRaw ? 1.0f : (power + 2.0f) * (0.5f * RL_INV_PI);
  b.p0 = vec4(b.diffuse, power);
  b.p1 = vec4(specular * factor, isRaw ? 1.0f : 0.0f);
  b.f0 = specular;
  if (isRaw) b.f0 *= 2.0f * RL_PI / (power + 1.0f);
  b.alpha = powerAlpha(4.0f * power);  // angles to the mirrored direction are twice the facets'
  if (!rlIsBlack(b.diffuse)) b.lobes = b.lobes | RL_LOBE_DIFFUSE;
  if (!rlIsBlack(specular)) b.lobes = b.lobes | RL_LOBE_SPECULAR;
}

RL_FN vec3 phongEval(RL_IN(Bsdf) b, RL_IN(vec3) woL, RL_IN(vec3) wiL, RL_OUT(float) pdf) {
  pdf = 0.0f;
  if (!(wiL.z > 0.0f)) return vec3(0.0f, 0.0f, 0.0f);
  float fall = powerMirroredFall(woL, wiL);
  float share = specularShare(b.f0, b.diffuse);
  pdf = share * powerPdf(fall, b.p0.w) + (1.0f - share) * lambertPdf(wiL);
  float cosI = b.p1.w != 0.0f ? 1.0f : wiL.z;
  return vec3(b.p0) * lambertEval(wiL) + vec3(b.p1) * (powerOf(fall, b.p0.w) * cosI);
}

RL_FN BsdfSample phongSample(RL_IN(Bsdf) b, RL_IN(vec3) woL, float uLobe, RL_IN(vec2) u) {
  BsdfSample s = bsdfSampleNone();
  bool isSpecular = uLobe < specularShare(b.f0, b.diffuse);
  s.wi = lambertDraw(u);
  if (isSpecular) s.wi = powerDrawMirrored(woL, b.p0.w, u);
  if (s.wi.z > 0.0f) s.lobe = isSpecular ? RL_LOBE_SPECULAR : RL_LOBE_DIFFUSE;
  return s;
}
#endif
