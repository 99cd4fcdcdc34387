// Compensation of multiple scattering between microfacets. Smith's masking drops light that meets
// more than one microfacet: a rough white metal loses up to 69 % of its light. A lobe that is
// symmetric in both directions returns the loss (Kulla & Conty 2017, "Revisiting Physically Based
// Shading at Imageworks", after Kelemen & Szirmay-Kalos 2001):
//   f_ms = F_ms (1 - E(o)) (1 - E(i)) / (pi (1 - E_avg))
//   F_ms = F_avg^2 E_avg / (1 - F_avg (1 - E_avg))
// E is the albedo of the GGX lobe whose microfacets reflect everything. The second line sums over
// the number of bounces; the first bounce is the GGX lobe itself, hence the square (Hill 2018, "A
// Multi-Faceted Exploration", part 2). All terms follow from alpha, f0 and f90.

// Loss 1 - E and Schlick part of E at one direction, and their cosine-weighted means.
RL_FN void multiscatterAlbedo(float alpha, float cosTheta, RL_OUT(vec2) at, RL_OUT(vec2) mean) {
  float last = float(RL_GGX_NODES - 1u);
  float y = sqrt(clamp(alpha, 0.0f, 1.0f)) * last;
  float x = sqrt(clamp(cosTheta, 0.0f, 1.0f)) * last;
  uint row = min(uint(y), RL_GGX_NODES - 2u);
  uint column = min(uint(x), RL_GGX_NODES - 2u);
  float ty = y - float(row);
  float tx = x - float(column);
  uint low = row * (RL_GGX_NODES + 1u);
  uint high = low + RL_GGX_NODES + 1u;
  vec2 a = RL_SCENE_VEC2(gScene.ggxAlbedo, low + column);
  vec2 b = RL_SCENE_VEC2(gScene.ggxAlbedo, low + column + 1u);
  vec2 c = RL_SCENE_VEC2(gScene.ggxAlbedo, high + column);
  vec2 d = RL_SCENE_VEC2(gScene.ggxAlbedo, high + column + 1u);
  at = (a * (1.0f - tx) + b * tx) * (1.0f - ty) + (c * (1.0f - tx) + d * tx) * ty;
  vec2 lowMean = RL_SCENE_VEC2(gScene.ggxAlbedo, low + RL_GGX_NODES);
  vec2 highMean = RL_SCENE_VEC2(gScene.ggxAlbedo, high + RL_GGX_NODES);
  mean = lowMean * (1.0f - ty) + highMean * ty;
}

// Returns whether this BSDF is compensated: only rough reflection of opaque materials. The loss of
// a rough dielectric leaves on both of its sides, which this model does not describe. A film's
// reflectance has no mean to sum with. Facets stretched along the tangent are compensated as if
// they had the smaller alpha, which returns less than they lose.
RL_FN bool multiscatterApplies(RL_IN(Bsdf) b) {
  return RL_HAS(RL_FEATURE_MULTISCATTER) && gFrame.multiscatter != 0u &&
         (b.lobes & RL_LOBE_SPECULAR) != 0u && (b.lobes & RL_LOBE_ANY_TRANSMISSION) == 0u &&
         !thinFilmIs(b);
}

// F_ms, with the cosine-weighted mean of Schlick's formula: F_avg = f0 + (f90 - f0) / 21.
RL_FN vec3 multiscatterFresnel(RL_IN(Bsdf) b, float meanLoss) {
  vec3 average = b.f0 + (vec3(b.f90, b.f90, b.f90) - b.f0) * (1.0f / 21.0f);
  return average * average * (1.0f - meanLoss) / (vec3(1.0f, 1.0f, 1.0f) - average * meanLoss);
}

// Albedo of the GGX lobe with its Fresnel term; `albedo` is a value of the table or its mean.
RL_FN vec3 multiscatterSingle(RL_IN(Bsdf) b, RL_IN(vec2) albedo) {
  return b.f0 * (1.0f - albedo.x - albedo.y) + vec3(b.f90, b.f90, b.f90) * albedo.y;
}

// The compensation lobe times |cos_i|, plus the share that the layer as a whole leaves to the
// Lambert base: as in bsdfBaseShare(), with the albedo of the rough layer in place of F.
RL_FN vec3 multiscatterEval(RL_IN(Bsdf) b, float cosO, float cosI) {
  vec2 atO;
  vec2 atI;
  vec2 mean;
  multiscatterAlbedo(clearcoatAlphaBelow(b), cosO, atO, mean);
  multiscatterAlbedo(clearcoatAlphaBelow(b), cosI, atI, mean);
  vec3 fresnel = multiscatterFresnel(b, mean.x);
  vec3 f = fresnel * (atO.x * atI.x * rlSafeDivide(1.0f, mean.x));
  if ((b.lobes & RL_LOBE_DIFFUSE) != 0u) {
    float enters = 1.0f - min(rlMax3(multiscatterSingle(b, atO) + fresnel * atO.x), 1.0f);
    float leaves = 1.0f - min(rlMax3(multiscatterSingle(b, atI) + fresnel * atI.x), 1.0f);
    float meanLeaves = 1.0f - rlMax3(multiscatterSingle(b, mean) + fresnel * mean.x);
    f += b.diffuse * (enters * leaves * rlSafeDivide(1.0f, meanLeaves));
  }
  return f * (cosI * RL_INV_PI);
}

// Luminances of the albedos for wo: x of the GGX lobe, y of the lobes that are sampled by the
// cosine.
RL_FN vec2 multiscatterLuminances(RL_IN(Bsdf) b, float cosO) {
  vec2 at;
  vec2 mean;
  multiscatterAlbedo(clearcoatAlphaBelow(b), cosO, at, mean);
  vec3 once = multiscatterSingle(b, at);
  vec3 more = multiscatterFresnel(b, mean.x) * at.x;
  float through = 1.0f - min(rlMax3(once + more), 1.0f);
  return vec2(rlLuminance(once), rlLuminance(more) + rlLuminance(b.diffuse) * through);
}
