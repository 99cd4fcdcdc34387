// Lobes that are a power of a cosine (Phong 1975; Lafortune and Willems 1994).

// A direction about +z with the density of powerPdf().
RL_FN vec3 powerDraw(float power, RL_IN(vec2) u) {
  float z = pow(1.0f - u.x, 1.0f / (power + 1.0f));
  vec2 cs = rlCosSin2Pi(u.y);
  float r = sqrt(max(0.0f, 1.0f - z * z));
  return vec3(r * cs.x, r * cs.y, z);
}
RL_FN float powerOf(float cosTheta, float power) {
  return cosTheta > 0.0f ? pow(min(cosTheta, 1.0f), power) : 0.0f;
}
RL_FN float powerPdf(float cosTheta, float power) {
  return (power + 1.0f) * (0.5f * RL_INV_PI) * powerOf(cosTheta, power);
}

// Cosine between wi and the mirrored wo.
RL_FN float powerMirroredCosine(RL_IN(vec3) woL, RL_IN(vec3) wiL) {
  return woL.z * wiL.z - woL.x * wiL.x - woL.y * wiL.y;
}
// A direction about the mirrored wo.
RL_FN vec3 powerDrawMirrored(RL_IN(vec3) woL, float power, RL_IN(vec2) u) {
  return frameToWorld(vec3(-woL.x, -woL.y, woL.z), powerDraw(power, u));
}

// Alpha of the Beckmann facets that a power stands for: power = 2 / alpha^2 - 2 (Walter et al.
// 2007).
RL_FN float powerAlpha(float power) { return min(sqrt(2.0f / (power + 2.0f)), 1.0f); }

// Probability of drawing from a specular part beside a diffuse one, by their albedos.
RL_FN float specularShare(RL_IN(vec3) specular, RL_IN(vec3) diffuse) {
  float s = rlLuminance(specular);
  float d = rlLuminance(diffuse);
  if (!(d > 0.0f)) return 1.0f;
  if (!(s > 0.0f)) return 0.0f;
  return clamp(s / (s + d), 0.1f, 0.9f);
}
