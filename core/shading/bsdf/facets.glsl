// A lobe of microfacets with any distribution, masking and Fresnel term (Cook and Torrance 1982;
// Walter et al. 2007; Heitz 2014), local to the normal and the tangent (x). alpha: along both axes.

// Distribution of normals; its integral over the projected area is 1.
RL_FN float facetsD(RL_IN(vec3) hL, RL_IN(vec2) alpha, uint distribution) {
  float x = hL.x / alpha.x;
  float y = hL.y / alpha.y;
  float slope2 = x * x + y * y;
  float z2 = hL.z * hL.z;
  float scale = RL_INV_PI / (alpha.x * alpha.y);
  if (distribution == RL_FACETS_GGX) {
    float d = slope2 + z2;
    return scale / (d * d);
  }
  if (distribution == RL_FACETS_BECKMANN) return scale * exp(-slope2 / z2) / (z2 * z2);
  // Blinn's power 2 / alpha^2 - 2, different along both axes (Ashikhmin and Shirley 2000).
  float sin2 = hL.x * hL.x + hL.y * hL.y;
  float power = 2.0f * rlSafeDivide(slope2, sin2) - 2.0f;
  return sin2 > 0.0f ? scale * exp(0.5f * power * rlLogOneMinus(sin2)) : scale;
}

// Smith's Lambda. Blinn's facets have that of Beckmann's, in the rational form of Walter et al.: it
// is not their own, and rough ones make energy.
RL_FN float facetsLambda(RL_IN(vec3) wL, RL_IN(vec2) alpha, uint distribution) {
  float x = wL.x * alpha.x;
  float y = wL.y * alpha.y;
  float a2 = (x * x + y * y) / (wL.z * wL.z);  // (alpha tan)^2
  if (distribution == RL_FACETS_GGX) return 0.5f * (sqrt(1.0f + a2) - 1.0f);
  if (!(a2 > 0.390625f)) return 0.0f;
  float a = 1.0f / sqrt(a2);
  return (1.0f - 1.259f * a + 0.396f * a * a) / (3.535f * a + 2.181f * a * a);
}

RL_FN float facetsG(RL_IN(vec3) woL, RL_IN(vec3) wiL, RL_IN(vec3) hL, RL_IN(vec2) alpha,
                    uint distribution, uint masking) {
  if (masking == RL_MASKING_V_CAVITIES) {
    float twice = 2.0f * hL.z / max(dot(woL, hL), 1.0e-6f);
    return min(1.0f, twice * min(woL.z, wiL.z));
  }
  float o = facetsLambda(woL, alpha, distribution);
  float i = facetsLambda(wiL, alpha, distribution);
  if (masking == RL_MASKING_CORRELATED) return 1.0f / (1.0f + o + i);
  return 1.0f / ((1.0f + o) * (1.0f + i));
}

// D G / (4 |cos_o|): the lobe times |cos_i|, without Fresnel. Both directions above.
RL_FN float facetsEval(RL_IN(vec3) woL, RL_IN(vec3) wiL, RL_IN(vec3) hL, RL_IN(vec2) alpha,
                       uint distribution, uint masking) {
  return facetsD(hL, alpha, distribution) * facetsG(woL, wiL, hL, alpha, distribution, masking) /
         (4.0f * woL.z);
}

// A normal: visible ones of GGX (Dupuy and Benyoub 2023), of the others by D |cos_h|.
RL_FN vec3 facetsDraw(RL_IN(vec3) woL, RL_IN(vec2) alpha, uint distribution, RL_IN(vec2) u) {
  vec2 cs = rlCosSin2Pi(u.y);
  if (distribution == RL_FACETS_GGX) {
    vec3 w = normalize(vec3(woL.x * alpha.x, woL.y * alpha.y, woL.z));
    float z = (1.0f - u.x) * (1.0f + w.z) - w.z;
    float r = sqrt(max(0.0f, 1.0f - z * z));
    vec3 h = vec3(r * cs.x, r * cs.y, z) + w;
    return normalize(vec3(h.x * alpha.x, h.y * alpha.y, max(h.z, 0.0f)));
  }
  vec2 axis = vec2(alpha.x * cs.x, alpha.y * cs.y);
  if (distribution == RL_FACETS_BECKMANN) {
    float slope = sqrt(-log(1.0f - u.x));
    return normalize(vec3(axis.x * slope, axis.y * slope, 1.0f));
  }
  float length2 = dot(axis, axis);
  float invLength = 1.0f / sqrt(length2);
  vec2 phi = axis * invLength;
  float ax = phi.x / alpha.x;
  float ay = phi.y / alpha.y;
  float sin2 = rlOneMinusExp(-log(1.0f - u.x) / (ax * ax + ay * ay));
  float r = sqrt(sin2);
  float z = sqrt(1.0f - sin2);
  return vec3(phi.x * r, phi.y * r, z);
}

// Solid-angle density of the reflected direction.
RL_FN float facetsPdf(RL_IN(vec3) woL, RL_IN(vec3) hL, RL_IN(vec2) alpha, uint distribution) {
  float d = facetsD(hL, alpha, distribution);
  if (distribution == RL_FACETS_GGX)
    return d / (4.0f * woL.z * (1.0f + facetsLambda(woL, alpha, distribution)));
  return d * hL.z / max(4.0f * dot(woL, hL), 1.0e-12f);
}

// Unpolarised reflectance of a conductor with index eta + i k, one channel.
RL_FN float fresnelConductorOne(float cosI, float eta, float k) {
  float cos2 = cosI * cosI;
  float sin2 = 1.0f - cos2;
  float t0 = eta * eta - k * k - sin2;
  float a2b2 = sqrt(t0 * t0 + 4.0f * eta * eta * k * k);
  float a = sqrt(max(0.5f * (a2b2 + t0), 0.0f));
  float t1 = a2b2 + cos2;
  float t2 = 2.0f * a * cosI;
  float perpendicular = rlSafeDivide(t1 - t2, t1 + t2);
  float t3 = cos2 * a2b2 + sin2 * sin2;
  float t4 = t2 * sin2;
  return 0.5f * perpendicular * (1.0f + rlSafeDivide(t3 - t4, t3 + t4));
}

// Reflectance at a facet. kind: RL_FRESNEL_*; at: reflectance at normal incidence (Schlick), or the
// index of refraction, with k of a conductor.
RL_FN vec3 facetsFresnel(uint kind, RL_IN(vec3) at, RL_IN(vec3) k, float cosI) {
  if (kind == RL_FRESNEL_SCHLICK)
    return at + (vec3(1.0f, 1.0f, 1.0f) - at) * fresnelSchlickWeight(cosI);
  if (kind == RL_FRESNEL_DIELECTRIC) {
    float f = fresnelDielectric(cosI, at.x);
    return vec3(f, f, f);
  }
  return vec3(fresnelConductorOne(cosI, at.x, k.x), fresnelConductorOne(cosI, at.y, k.y),
              fresnelConductorOne(cosI, at.z, k.z));
}

// A diffuse part beside a lobe of facets, as closures keep them in a Bsdf.
//   p0: albedo of the diffuse part, alpha along the tangent; p1: factor of the lobe, alpha across;
//   p2: `at` of facetsFresnel(), the kinds of D, G and F; p3: k
RL_FN uint facetsKinds(uint distribution, uint masking, uint fresnel) {
  return distribution | (masking << 2u) | (fresnel << 4u);
}

RL_FN vec3 facetLayerFresnel(RL_IN(Bsdf) b, float cosI) {
  return vec3(b.p1) *
         facetsFresnel(uint(b.p2.w) >> 4u, vec3(b.p2), vec3(b.p3), clamp(cosI, 0.0f, 1.0f));
}

// Roughness along both axes (Burley 2012).
RL_FN vec2 facetsAlpha(float alpha, float anisotropic) {
  float aspect = sqrt(1.0f - 0.9f * anisotropic);
  return vec2(min(alpha / aspect, 1.0f), alpha * aspect);
}

// Completes a Bsdf from p0 to p3. Below RL_ALPHA_FLOOR the lobe is a mirror's.
RL_FN void facetLayerLoad(RL_INOUT(Bsdf) b) {
  b.diffuse = vec3(b.p0);
  b.f0 = facetLayerFresnel(b, 1.0f);
  b.f90 = 1.0f;
  bool isDelta = max(b.p0.w, b.p1.w) < RL_ALPHA_FLOOR;
  b.p0.w = max(b.p0.w, RL_ALPHA_FLOOR);
  b.p1.w = max(b.p1.w, RL_ALPHA_FLOOR);
  b.alpha = isDelta ? 0.0f : min(b.p0.w, b.p1.w);
  if (!rlIsBlack(b.diffuse)) b.lobes = b.lobes | RL_LOBE_DIFFUSE;
  if (rlIsBlack(vec3(b.p1))) return;
  b.lobes = b.lobes | (isDelta ? RL_LOBE_SPECULAR_DELTA : RL_LOBE_SPECULAR);
  if (isDelta) RL_HEALTH(RL_HEALTH_DELTA_LOBES);
}

RL_FN float facetLayerShare(RL_IN(Bsdf) b, float cosO) {
  return specularShare(facetLayerFresnel(b, cosO), b.diffuse);
}

RL_FN vec3 facetLayerEval(RL_IN(Bsdf) b, RL_IN(vec3) woL, RL_IN(vec3) wiL, RL_OUT(float) pdf) {
  pdf = 0.0f;
  vec3 f = vec3(0.0f, 0.0f, 0.0f);
  if (!(wiL.z > 0.0f)) return f;
  float share = facetLayerShare(b, woL.z);
  if ((b.lobes & RL_LOBE_DIFFUSE) != 0u) {
    f = b.diffuse * lambertEval(wiL);
    pdf = (1.0f - share) * lambertPdf(wiL);
  }
  if ((b.lobes & RL_LOBE_SPECULAR) == 0u) return f;
  uint kinds = uint(b.p2.w);
  vec2 alpha = vec2(b.p0.w, b.p1.w);
  vec3 hL = normalize(woL + wiL);
  float lobe = facetsEval(woL, wiL, hL, alpha, kinds & 3u, (kinds >> 2u) & 3u);
  pdf += share * facetsPdf(woL, hL, alpha, kinds & 3u);
  return f + facetLayerFresnel(b, dot(woL, hL)) * lobe;
}

RL_FN BsdfSample facetLayerSample(RL_IN(Bsdf) b, RL_IN(vec3) woL, float uLobe, RL_IN(vec2) u) {
  BsdfSample s = bsdfSampleNone();
  float share = facetLayerShare(b, woL.z);
  if (!(uLobe < share)) {
    s.wi = lambertDraw(u);
    if ((b.lobes & RL_LOBE_DIFFUSE) != 0u) s.lobe = RL_LOBE_DIFFUSE;
    return s;
  }
  if ((b.lobes & RL_LOBE_SPECULAR_DELTA) != 0u) {
    s.wi = vec3(-woL.x, -woL.y, woL.z);
    s.pdfSolidAngle = share;
    s.weight = facetLayerFresnel(b, woL.z) * (1.0f / share);
    s.lobe = RL_LOBE_SPECULAR_DELTA;
    return s;
  }
  uint kinds = uint(b.p2.w);
  vec3 hL = facetsDraw(woL, vec2(b.p0.w, b.p1.w), kinds & 3u, u);
  float cosH = dot(woL, hL);
  s.wi = hL * (2.0f * cosH) - woL;
  if (cosH > 0.0f && s.wi.z > 0.0f) s.lobe = RL_LOBE_SPECULAR;
  return s;
}
