// Clearcoat (KHR_materials_clearcoat): an isotropic layer of GGX facets over all other lobes, with
// the index 1.5, a factor, and a normal of its own. It differs from glTF's text in what it leaves
// to the lobes below. The text multiplies them by 1 - F(o), which is not reciprocal. Here
//   Lambert below gets T(o) T(i) over the mean of T, as below the Fresnel layer (bsdfBaseShare);
//   all others get the smaller of T(o) and T(i), exact for mirrors, less than all for wide lobes;
//   light that refracts into a solid passes the coat once: T at the direction outside.
// T = 1 - F at the coat's normal. A lamp below a coat sends its full emission: light sampling knows
// nothing of coats, and the importer says so.

RL_FN bool clearcoatIs(RL_IN(Bsdf) b) {
  return RL_HAS(RL_FEATURE_CLEARCOAT) && (b.lobes & RL_LOBE_ANY_COAT) != 0u;
}

// Alpha of the lobes below: b.alpha is that of the narrowest lobe of all.
RL_FN float clearcoatAlphaBelow(RL_IN(Bsdf) b) { return clearcoatIs(b) ? b.p2.y : b.alpha; }

// Schlick's reflectance, times the factor.
RL_FN float clearcoatFresnel(RL_IN(Bsdf) b, float cosTheta) {
  return b.p0.x * (RL_COAT_F0 + (1.0f - RL_COAT_F0) * fresnelSchlickWeight(cosTheta));
}

// The normal in the frame of the surface's. One that turns its back to wo is mirrored, as
// consistentNormal() does.
RL_FN vec3 clearcoatNormal(RL_IN(Bsdf) b, RL_IN(vec3) woL) {
  float z2 = 1.0f - b.p0.z * b.p0.z - b.p0.w * b.p0.w;
  vec3 n = vec3(b.p0.z, b.p0.w, sqrt(max(z2, 0.0f)));
  float cosO = dot(n, woL);
  return cosO < 0.0f ? n - woL * (2.0f * cosO) : n;
}

// Share of light that passes the coat to a lobe below that is not Lambert, and out again.
RL_FN float clearcoatPasses(RL_IN(Bsdf) b, RL_IN(vec3) woL, RL_IN(vec3) wiL) {
  if (!RL_HAS(RL_FEATURE_CLEARCOAT)) return 1.0f;
  if ((b.lobes & (RL_LOBE_ANY_COAT | RL_LOBE_COAT_BEYOND)) == 0u) return 1.0f;
  vec3 n = clearcoatNormal(b, woL);
  float passesI = 1.0f - clearcoatFresnel(b, abs(dot(n, wiL)));
  if ((b.lobes & RL_LOBE_COAT_BEYOND) != 0u) return wiL.z < 0.0f ? passesI : 1.0f;
  float passesO = 1.0f - clearcoatFresnel(b, abs(dot(n, woL)));
  bool isRefraction =
      wiL.z < 0.0f && (b.lobes & RL_LOBE_ANY_TRANSMISSION) != 0u && (b.lobes & RL_LOBE_THIN) == 0u;
  return isRefraction ? passesO : min(passesO, passesI);
}

// The same for Lambert's reflection. meanBelow: mean of what the Fresnel layer between both lets
// pass; contrast: by how much less that is at grazing angles. The mean of the product of two such
// curves is the product of their means and the covariance of Schlick's weight, 1/66 - 1/441.
RL_FN float clearcoatPassesLambert(RL_IN(Bsdf) b, RL_IN(vec3) woL, RL_IN(vec3) wiL, float meanBelow,
                                   float contrast) {
  if (!clearcoatIs(b)) return 1.0f;
  vec3 n = clearcoatNormal(b, woL);
  float passes = (1.0f - clearcoatFresnel(b, abs(dot(n, woL)))) *
                 (1.0f - clearcoatFresnel(b, abs(dot(n, wiL))));
  float rise = (1.0f - RL_COAT_F0) * b.p0.x;
  float mean = 1.0f - RL_COAT_F0 * b.p0.x - rise * (1.0f / 21.0f);
  float covariance = rise * contrast * (1.0f / 66.0f - 1.0f / 441.0f);
  return passes * rlSafeDivide(meanBelow, meanBelow * mean + covariance);
}

// f |cos_i| of a rough coat.
RL_FN float clearcoatEval(RL_IN(Bsdf) b, RL_IN(vec3) woL, RL_IN(vec3) wiL) {
  vec3 n = clearcoatNormal(b, woL);
  vec3 woC = frameToLocal(n, woL);
  vec3 wiC = frameToLocal(n, wiL);
  if (!(woC.z > 0.0f) || !(wiC.z > 0.0f)) return 0.0f;
  vec3 hC = normalize(woC + wiC);
  float fresnel = clearcoatFresnel(b, clamp(dot(woC, hC), 0.0f, 1.0f));
  return fresnel * ggxReflectionEval(woC, wiC, hC, b.p0.y);
}

RL_FN float clearcoatPdf(RL_IN(Bsdf) b, RL_IN(vec3) woL, RL_IN(vec3) wiL) {
  vec3 n = clearcoatNormal(b, woL);
  vec3 woC = frameToLocal(n, woL);
  vec3 wiC = frameToLocal(n, wiL);
  if (!(woC.z > 0.0f) || !(wiC.z > 0.0f)) return 0.0f;
  return ggxReflectionPdf(woC, normalize(woC + wiC), b.p0.y);
}

// A direction, local to the surface's normal; it may lie below. Of a smooth coat, the mirrored one.
RL_FN vec3 clearcoatDraw(RL_IN(Bsdf) b, RL_IN(vec3) woL, RL_IN(vec2) u) {
  vec3 n = clearcoatNormal(b, woL);
  vec3 woC = frameToLocal(n, woL);
  if (!(woC.z > 0.0f)) return vec3(0.0f, 0.0f, -1.0f);
  vec3 hC = vec3(0.0f, 0.0f, 1.0f);
  if ((b.lobes & RL_LOBE_COAT_DELTA) == 0u) hC = ggxDrawVisibleNormal(woC, b.p0.y, u);
  vec3 wiC = hC * (2.0f * dot(woC, hC)) - woC;
  if (!(wiC.z > 0.0f)) return vec3(0.0f, 0.0f, -1.0f);
  return frameToWorld(n, wiC);
}
