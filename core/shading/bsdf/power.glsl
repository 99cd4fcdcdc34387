// Lobes that are a power of a cosine (Phong 1975; Lafortune and Willems 1994).

// A direction about +z with the density of powerPdf().
RL_FN vec3 powerDraw(float power, RL_IN(vec2) u) {
  float fall = rlOneMinusExp(-log(1.0f - u.x) / (power + 1.0f));
  vec2 cs = rlCosSin2Pi(u.y);
  float r = sqrt(fall * (2.0f - fall));
  return vec3(r * cs.x, r * cs.y, 1.0f - fall);
}
// The cosine to a power, and the density of draws. fall: one minus the cosine, which float32 holds
// where a lobe is so narrow that all of its cosines are nearly 1.
RL_FN float powerOf(float fall, float power) {
  return fall < 1.0f ? exp(power * rlLogOneMinus(fall)) : 0.0f;
}
RL_FN float powerPdf(float fall, float power) {
  return (power + 1.0f) * (0.5f * RL_INV_PI) * powerOf(fall, power);
}
// One minus the cosine between two unit vectors.
RL_FN float powerFall(RL_IN(vec3) a, RL_IN(vec3) b) {
  vec3 d = a - b;
  return 0.5f * dot(d, d);
}

// One minus the cosine between wi and the mirrored wo.
RL_FN float powerMirroredFall(RL_IN(vec3) woL, RL_IN(vec3) wiL) {
  return powerFall(wiL, vec3(-woL.x, -woL.y, woL.z));
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
