// Ray traversal has one signature; each backend supplies the body (Embree on the CPU; a traversal
// of our own or ray queries on the GPU).
//   RL_RAY_PATH    hit.instance is RL_INVALID when nothing was hit; alpha is decided by `alphaKey`:
//                  the decision does not depend on the order in which surfaces are visited.
//                  The return value is 1 when no partly transparent surface was passed, less when
//                  one may have been (those beyond the hit count too, if traversal has met them)
//   RL_RAY_SHADOW  the return value is the transmittance: 0 blocked, 1 free, between through alpha
RL_PROTO(float traceRay(RL_IN(Ray) ray, uint mode, uint alphaKey, RL_OUT(Hit) hit))

// For compilers, which do not see that traversal sets it.
RL_FN Hit traceNoHit() {
  Hit hit;
  hit.instance = RL_INVALID;
  hit.primitive = RL_INVALID;
  hit.bary = vec2(0.0f, 0.0f);
  hit.t = 0.0f;
  return hit;
}

// The decision of a path ray at a partly transparent surface: hash(sample, primitive) against
// alpha.
RL_FN bool traceAlphaAccepts(uint alphaKey, RL_IN(Hit) hit, float alpha) {
  uint bits = rngHash(rngHash(hit.primitive ^ alphaKey) + hit.instance * 0x9e3779b9u);
  return float(bits >> 8u) * 5.9604644775390625e-8f < alpha;
}
