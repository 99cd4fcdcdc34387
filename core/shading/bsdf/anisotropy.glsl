// Facets of the base: GGX, the same along both axes, or stretched along the tangent
// (KHR_materials_anisotropy). Without anisotropy the functions of core/shading/bsdf/ggx.glsl run.

// Turns the frame of a normal about it, to the tangent and back.
RL_FN vec3 bsdfToTangent(RL_IN(Bsdf) b, RL_IN(vec3) v) {
  return vec3(b.tangent.x * v.x + b.tangent.y * v.y, b.tangent.x * v.y - b.tangent.y * v.x, v.z);
}
RL_FN vec3 bsdfFromTangent(RL_IN(Bsdf) b, RL_IN(vec3) v) {
  return vec3(b.tangent.x * v.x - b.tangent.y * v.y, b.tangent.x * v.y + b.tangent.y * v.x, v.z);
}

RL_FN bool baseIsStretched(RL_IN(Bsdf) b) {
  return RL_HAS(RL_FEATURE_ANISOTROPY) && (b.lobes & RL_LOBE_ANISOTROPIC) != 0u;
}

// A visible normal of a facet.
RL_FN vec3 baseDraw(RL_IN(Bsdf) b, RL_IN(vec3) woL, RL_IN(vec2) u) {
  if (baseIsStretched(b)) {
    vec2 alpha = vec2(b.p2.x, b.p2.y);
    return bsdfFromTangent(b, facetsDraw(bsdfToTangent(b, woL), alpha, RL_FACETS_GGX, u));
  }
  return ggxDrawVisibleNormal(woL, clearcoatAlphaBelow(b), u);
}

// D G / (4 |cos_o|), as ggxReflectionEval().
RL_FN float baseReflectionEval(RL_IN(Bsdf) b, RL_IN(vec3) woL, RL_IN(vec3) wiL, RL_IN(vec3) hL) {
  if (baseIsStretched(b)) {
    return facetsEval(bsdfToTangent(b, woL), bsdfToTangent(b, wiL), bsdfToTangent(b, hL),
                      vec2(b.p2.x, b.p2.y), RL_FACETS_GGX, RL_MASKING_CORRELATED);
  }
  return ggxReflectionEval(woL, wiL, hL, clearcoatAlphaBelow(b));
}

RL_FN float baseReflectionPdf(RL_IN(Bsdf) b, RL_IN(vec3) woL, RL_IN(vec3) hL) {
  if (baseIsStretched(b)) {
    return facetsPdf(bsdfToTangent(b, woL), bsdfToTangent(b, hL), vec2(b.p2.x, b.p2.y),
                     RL_FACETS_GGX);
  }
  return ggxReflectionPdf(woL, hL, clearcoatAlphaBelow(b));
}

// As transmissionEval() and transmissionPdf() (Walter et al. 2007).
RL_FN float baseTransmissionEval(RL_IN(Bsdf) b, RL_IN(vec3) woL, RL_IN(vec3) wiL, RL_IN(vec3) hL) {
  if (!baseIsStretched(b)) return transmissionEval(woL, wiL, hL, clearcoatAlphaBelow(b), b.eta);
  float dotO = dot(woL, hL);
  float dotI = dot(wiL, hL);
  if (dotO <= 0.0f || dotI >= 0.0f) return 0.0f;
  vec2 alpha = vec2(b.p2.x, b.p2.y);
  float lambdaO = facetsLambda(bsdfToTangent(b, woL), alpha, RL_FACETS_GGX);
  float lambdaI = facetsLambda(bsdfToTangent(b, wiL), alpha, RL_FACETS_GGX);
  float d = dotO + b.eta * dotI;
  float facets = facetsD(bsdfToTangent(b, hL), alpha, RL_FACETS_GGX) / (1.0f + lambdaO + lambdaI);
  return abs(dotO * dotI) * facets / (woL.z * d * d);
}

RL_FN float baseTransmissionPdf(RL_IN(Bsdf) b, RL_IN(vec3) woL, RL_IN(vec3) wiL, RL_IN(vec3) hL) {
  if (!baseIsStretched(b)) return transmissionPdf(woL, wiL, hL, clearcoatAlphaBelow(b), b.eta);
  float dotO = dot(woL, hL);
  float dotI = dot(wiL, hL);
  if (dotO <= 0.0f || dotI >= 0.0f) return 0.0f;
  float d = dotO + b.eta * dotI;
  return baseReflectionPdf(b, woL, hL) * 4.0f * dotO * b.eta * b.eta * abs(dotI) / (d * d);
}
