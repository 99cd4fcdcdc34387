// Maps of the unit square to the domains that are sampled.

// Cosine-weighted hemisphere about +z; pdf = cos / pi.
RL_FN vec3 warpCosineHemisphere(RL_IN(vec2) u) {
  float r = sqrt(u.x);
  vec2 cs = rlCosSin2Pi(u.y);
  return vec3(r * cs.x, r * cs.y, sqrt(max(0.0f, 1.0f - u.x)));
}

// Uniform barycentric coordinates (weights of the second and third corner).
RL_FN vec2 warpTriangle(RL_IN(vec2) u) {
  float s = sqrt(u.x);
  return vec2(1.0f - s, u.y * s);
}
