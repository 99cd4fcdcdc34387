// An old mirror or lacquer: f = color (R_n(wi) . wo)^power. Normalised, by (power + 2) / (2 pi), it
// reflects at most `color` (Lafortune and Willems 1994).
//   p0: colour times the factor, power
#ifdef RL_CLOSURE_DECLARED
info.is("lobe of a power about the mirrored direction", "Phong 1975; Lafortune and Willems 1994");
info.color("color", 1.0, "factor of the lobe");
info.number("power", 7.0, 5.0, 1.0e5,
            "exponent of the cosine to the mirrored direction; raw lobes below 4.3 make energy");
info.choice("model", {"raw", "normalised"}, "normalised: times (power + 2) / (2 pi)");
#else

RL_FN void powerLobeLoad(RL_INOUT(Bsdf) b, RL_IN(MaterialPoint) at) {
  vec3 color = closureColor(at, 0u);
  float power = closureNumber(at, 1u);
  float normal = (power + 2.0f) * (0.5f * RL_INV_PI);  // the raw lobe reflects 1 / normal of it
  b.f0 = closureChoice(at, 2u) == 0u ? color * (1.0f / normal) : color;
  b.p0 = vec4(b.f0 * normal, power);
  b.alpha = powerAlpha(4.0f * power);  // angles to the mirrored direction are twice the facets'
  if (!rlIsBlack(color)) b.lobes = RL_LOBE_SPECULAR;
}

RL_FN vec3 powerLobeEval(RL_IN(Bsdf) b, RL_IN(vec3) woL, RL_IN(vec3) wiL, RL_OUT(float) pdf) {
  pdf = 0.0f;
  if (!(wiL.z > 0.0f)) return vec3(0.0f, 0.0f, 0.0f);
  float fall = powerMirroredFall(woL, wiL);
  pdf = powerPdf(fall, b.p0.w);
  return vec3(b.p0) * (powerOf(fall, b.p0.w) * wiL.z);
}

RL_FN BsdfSample powerLobeSample(RL_IN(Bsdf) b, RL_IN(vec3) woL, float uLobe, RL_IN(vec2) u) {
  BsdfSample s = bsdfSampleNone();
  s.wi = powerDrawMirrored(woL, b.p0.w, u);
  if (s.wi.z > 0.0f) s.lobe = RL_LOBE_SPECULAR;
  return s;
}
#endif
