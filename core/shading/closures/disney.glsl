// Disney's principled model (Burley 2012; masking by the lobe's own alpha, as Burley 2015 has it).
//   p0: base colour, roughness; p1: specular reflectance, alpha along the tangent; p2: colour of
//   the sheen, alpha across; p3: metallic, subsurface, clearcoat, alpha of the clearcoat
#ifdef RL_CLOSURE_DECLARED
info.is("principled: one colour and ten numbers, by eye", "Burley 2012; Burley 2015");
info.color("baseColor", 0.8, "of the diffuse part, and of metal");
info.number("subsurface", 0.0, 0.0, 1.0, "blends the diffuse part to a flatter one");
info.number("metallic", 0.0, 0.0, 1.0, "0: dielectric, 1: metal");
info.number("specular", 0.5, 0.0, 1.0, "reflectance at normal incidence, over 0.08");
info.number("specularTint", 0.0, 0.0, 1.0, "tints it by the base colour");
info.number("roughness", 0.5, 0.0, 1.0, "square root of alpha");
info.number("anisotropic", 0.0, 0.0, 1.0, "stretches highlights along the tangent");
info.number("sheen", 0.0, 0.0, 1.0, "more light at grazing angles, for cloth");
info.number("sheenTint", 0.5, 0.0, 1.0, "tints it by the base colour");
info.number("clearcoat", 0.0, 0.0, 1.0, "strength of a second, isotropic lobe");
info.number("clearcoatGloss", 1.0, 0.0, 1.0, "1: a sharp one");
info.looksAtTangent("anisotropic");
info.breaks({"energy"});
#else

RL_FN float disneyMix(float a, float b, float t) { return a + (b - a) * t; }
RL_FN vec3 disneyMix3(RL_IN(vec3) a, RL_IN(vec3) b, float t) { return a + (b - a) * t; }

RL_FN void disneyLoad(RL_INOUT(Bsdf) b, RL_IN(MaterialPoint) at) {
  vec3 white = vec3(1.0f, 1.0f, 1.0f);
  vec3 base = closureColor(at, 0u);
  float metallic = closureNumber(at, 2u);
  float luminance = rlLuminance(base);
  vec3 tint = luminance > 0.0f ? base * (1.0f / luminance) : white;
  float roughness = closureNumber(at, 5u);
  vec2 alpha = facetsAlpha(roughness * roughness, closureNumber(at, 6u));
  alpha = max(alpha, vec2(RL_ALPHA_FLOOR, RL_ALPHA_FLOOR));
  vec3 dielectric =
      disneyMix3(white, tint, closureNumber(at, 4u)) * (0.08f * closureNumber(at, 3u));
  vec3 sheen = disneyMix3(white, tint, closureNumber(at, 8u)) * closureNumber(at, 7u);
  float clearcoat = closureNumber(at, 9u);
  float gloss = disneyMix(0.1f, 0.001f, closureNumber(at, 10u));
  b.diffuse = base * (1.0f - metallic);
  b.f0 = disneyMix3(dielectric, base, metallic);
  b.f90 = 1.0f;
  b.p0 = vec4(base, roughness);
  b.p1 = vec4(b.f0, alpha.x);
  b.p2 = vec4(sheen, alpha.y);
  b.p3 = vec4(metallic, closureNumber(at, 1u), clearcoat, gloss);
  b.alpha = min(alpha.x, alpha.y);
  if (clearcoat > 0.0f) b.alpha = min(b.alpha, gloss);
  b.lobes = RL_LOBE_SPECULAR;
  if (metallic < 1.0f && !rlIsBlack(base + sheen))
    b.lobes = b.lobes | RL_LOBE_DIFFUSE | RL_LOBE_ROUGH_DIFFUSE;
}

// The diffuse part times pi over the base colour: x, and the sheen's weight: y.
RL_FN vec2 disneyDiffuse(RL_IN(Bsdf) b, float cosO, float cosI, float cosD) {
  float fI = fresnelSchlickWeight(cosI);
  float fO = fresnelSchlickWeight(cosO);
  float grazing = cosD * cosD * b.p0.w;
  float diffuse =
      disneyMix(1.0f, 0.5f + 2.0f * grazing, fI) * disneyMix(1.0f, 0.5f + 2.0f * grazing, fO);
  float ss = disneyMix(1.0f, grazing, fI) * disneyMix(1.0f, grazing, fO);
  float subsurface = 1.25f * (ss * (1.0f / max(cosI + cosO, 1.0e-4f) - 0.5f) + 0.5f);
  return vec2(disneyMix(diffuse, subsurface, b.p3.y), fresnelSchlickWeight(cosD));
}

// Distribution of the clearcoat's normals (GTR with the exponent 1), from the sine: float32 would
// lose it beside the cosine.
RL_FN float disneyClearcoatD(RL_IN(vec3) hL, float alpha) {
  float a2 = alpha * alpha;
  float d = hL.x * hL.x + hL.y * hL.y + a2 * hL.z * hL.z;
  return (a2 - 1.0f) * RL_INV_PI / (log(a2) * d);
}

// Probabilities of drawing the specular lobe and the clearcoat; the rest goes to the cosine.
RL_FN vec2 disneyShares(RL_IN(Bsdf) b, float cosO) {
  float f = fresnelSchlickWeight(cosO);
  float specular = disneyMix(rlLuminance(b.f0), 1.0f, f);
  float clearcoat = 0.25f * b.p3.z * disneyMix(0.04f, 1.0f, f);
  float diffuse = rlLuminance(b.diffuse) + (1.0f - b.p3.x) * rlLuminance(vec3(b.p2)) * f;
  float least = 0.1f * (specular + clearcoat + diffuse);
  specular = max(specular, least);
  if (b.p3.z > 0.0f) clearcoat = max(clearcoat, least);
  diffuse = (b.lobes & RL_LOBE_DIFFUSE) != 0u ? max(diffuse, least) : 0.0f;
  float total = specular + clearcoat + diffuse;
  if (!(total > 0.0f)) return vec2(1.0f, 0.0f);
  return vec2(specular, clearcoat) * (1.0f / total);
}

RL_FN vec3 disneyEval(RL_IN(Bsdf) b, RL_IN(vec3) woL, RL_IN(vec3) wiL, RL_OUT(float) pdf) {
  pdf = 0.0f;
  vec3 f = vec3(0.0f, 0.0f, 0.0f);
  if (!(wiL.z > 0.0f)) return f;
  vec3 hL = normalize(woL + wiL);
  float cosD = clamp(dot(woL, hL), 0.0f, 1.0f);
  float schlick = fresnelSchlickWeight(cosD);
  vec2 alpha = vec2(b.p1.w, b.p2.w);
  vec2 shares = disneyShares(b, woL.z);
  if ((b.lobes & RL_LOBE_DIFFUSE) != 0u) {
    vec2 diffuse = disneyDiffuse(b, woL.z, wiL.z, cosD);
    vec3 sheen = vec3(b.p2) * (diffuse.y * RL_PI);
    f = (vec3(b.p0) * diffuse.x + sheen) * ((1.0f - b.p3.x) * lambertEval(wiL));
    pdf = (1.0f - shares.x - shares.y) * lambertPdf(wiL);
  }
  vec3 fresnel = disneyMix3(vec3(b.p1), vec3(1.0f, 1.0f, 1.0f), schlick);
  f += fresnel * facetsEval(woL, wiL, hL, alpha, RL_FACETS_GGX, RL_MASKING_SMITH);
  pdf += shares.x * facetsPdf(woL, hL, alpha, RL_FACETS_GGX);
  if (b.p3.z > 0.0f) {
    float d = disneyClearcoatD(hL, b.p3.w);
    vec2 masked = vec2(0.25f, 0.25f);
    float g = facetsG(woL, wiL, hL, masked, RL_FACETS_GGX, RL_MASKING_SMITH) / (4.0f * woL.z);
    float clearcoat = 0.25f * b.p3.z * disneyMix(0.04f, 1.0f, schlick) * d * g;
    f += vec3(clearcoat, clearcoat, clearcoat);
    pdf += shares.y * d * hL.z / max(4.0f * cosD, 1.0e-12f);
  }
  return f;
}

RL_FN BsdfSample disneySample(RL_IN(Bsdf) b, RL_IN(vec3) woL, float uLobe, RL_IN(vec2) u) {
  BsdfSample s = bsdfSampleNone();
  vec2 shares = disneyShares(b, woL.z);
  if (!(uLobe < shares.x + shares.y)) {
    s.wi = lambertDraw(u);
    if ((b.lobes & RL_LOBE_DIFFUSE) != 0u) s.lobe = RL_LOBE_DIFFUSE;
    return s;
  }
  vec3 hL = facetsDraw(woL, vec2(b.p1.w, b.p2.w), RL_FACETS_GGX, u);
  if (!(uLobe < shares.x)) {
    float a2 = b.p3.w * b.p3.w;
    float sin2 = clamp((pow(a2, 1.0f - u.x) - a2) / (1.0f - a2), 0.0f, 1.0f);
    vec2 cs = rlCosSin2Pi(u.y);
    float r = sqrt(sin2);
    float z = sqrt(1.0f - sin2);
    hL = vec3(r * cs.x, r * cs.y, z);
  }
  float cosH = dot(woL, hL);
  s.wi = hL * (2.0f * cosH) - woL;
  if (cosH > 0.0f && s.wi.z > 0.0f) s.lobe = RL_LOBE_SPECULAR;
  return s;
}
#endif
