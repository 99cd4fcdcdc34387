// GGX transmission (Walter et al. 2007, eq. 17 and 21): woL.z > 0 > wiL.z, eta = n beyond / n here.
// Radiance transport: the factor 1/eta^2 of refracted radiance is included.

// The half vector of a refracted pair, on the side of woL.
RL_FN vec3 transmissionHalfVector(RL_IN(vec3) woL, RL_IN(vec3) wiL, float eta) {
  vec3 h = normalize(woL + wiL * eta);
  return h.z < 0.0f ? -h : h;
}

// Refracted direction, or false under total internal reflection.
RL_FN bool transmissionRefract(RL_IN(vec3) wo, RL_IN(vec3) h, float eta, RL_OUT(vec3) wi) {
  float cosI = dot(wo, h);
  float sin2T = (1.0f - cosI * cosI) / (eta * eta);
  wi = vec3(0.0f, 0.0f, -1.0f);
  if (sin2T >= 1.0f) return false;
  float cosT = sqrt(1.0f - sin2T);
  wi = -wo * (1.0f / eta) + h * (cosI / eta - cosT);
  return true;
}

// f |cos_i| without the factor (1 - F) and tint.
RL_FN float transmissionEval(RL_IN(vec3) woL, RL_IN(vec3) wiL, RL_IN(vec3) hL, float alpha,
                             float eta) {
  float dotO = dot(woL, hL);
  float dotI = dot(wiL, hL);
  if (dotO <= 0.0f || dotI >= 0.0f) return 0.0f;
  vec3 wiUp = vec3(wiL.x, wiL.y, -wiL.z);
  float g = 1.0f / (1.0f + ggxLambda(woL, alpha) + ggxLambda(wiUp, alpha));
  float d = dotO + eta * dotI;
  return abs(dotO * dotI) * ggxD(hL, alpha) * g / (woL.z * d * d);
}

RL_FN float transmissionPdf(RL_IN(vec3) woL, RL_IN(vec3) wiL, RL_IN(vec3) hL, float alpha,
                            float eta) {
  float dotO = dot(woL, hL);
  float dotI = dot(wiL, hL);
  if (dotO <= 0.0f || dotI >= 0.0f) return 0.0f;
  float d = dotO + eta * dotI;
  return ggxPdfVisibleNormal(woL, hL, alpha) * eta * eta * abs(dotI) / (d * d);
}
