// GGX microfacets in local coordinates (z = shading normal), isotropic.
// Walter et al. 2007 (distribution, transmission), Heitz 2014 (height-correlated masking),
// Dupuy & Benyoub 2023 (sampling of visible normals by spherical caps).

// Normal distribution in its float32-stable form: sin^2 from the tangential part, not from 1 -
// cos^2.
RL_FN float ggxD(RL_IN(vec3) hL, float alpha) {
  float sin2 = hL.x * hL.x + hL.y * hL.y;
  float a2 = alpha * alpha;
  float d = hL.z * hL.z * a2 + sin2;
  return a2 * RL_INV_PI / (d * d);
}

RL_FN float ggxLambda(RL_IN(vec3) wL, float alpha) {
  float cos2 = wL.z * wL.z;
  float sin2 = wL.x * wL.x + wL.y * wL.y;
  return 0.5f * (sqrt(1.0f + alpha * alpha * sin2 / cos2) - 1.0f);
}

RL_FN float ggxG1(RL_IN(vec3) wL, float alpha) { return 1.0f / (1.0f + ggxLambda(wL, alpha)); }

// Visible normal for a direction with woL.z > 0.
RL_FN vec3 ggxDrawVisibleNormal(RL_IN(vec3) woL, float alpha, RL_IN(vec2) u) {
  vec3 w = normalize(vec3(woL.x * alpha, woL.y * alpha, woL.z));
  float z = (1.0f - u.x) * (1.0f + w.z) - w.z;
  float r = sqrt(max(0.0f, 1.0f - z * z));
  vec2 cs = rlCosSin2Pi(u.y);
  vec3 h = vec3(r * cs.x, r * cs.y, z) + w;
  return normalize(vec3(h.x * alpha, h.y * alpha, max(h.z, 0.0f)));
}

// Solid-angle density of a visible normal.
RL_FN float ggxPdfVisibleNormal(RL_IN(vec3) woL, RL_IN(vec3) hL, float alpha) {
  return ggxG1(woL, alpha) * max(dot(woL, hL), 0.0f) * ggxD(hL, alpha) / woL.z;
}

// D G / (4 |cos_o|): the reflection lobe times |cos_i|, without Fresnel. Both directions above.
RL_FN float ggxReflectionEval(RL_IN(vec3) woL, RL_IN(vec3) wiL, RL_IN(vec3) hL, float alpha) {
  float g = 1.0f / (1.0f + ggxLambda(woL, alpha) + ggxLambda(wiL, alpha));
  return ggxD(hL, alpha) * g / (4.0f * woL.z);
}

RL_FN float ggxReflectionPdf(RL_IN(vec3) woL, RL_IN(vec3) hL, float alpha) {
  return ggxG1(woL, alpha) * ggxD(hL, alpha) / (4.0f * woL.z);
}
