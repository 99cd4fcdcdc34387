// Fresnel reflectance.

RL_FN float fresnelSchlickWeight(float cosTheta) {
  float m = clamp(1.0f - cosTheta, 0.0f, 1.0f);
  float m2 = m * m;
  return m2 * m2 * m;
}

// Unpolarised dielectric reflectance; eta = n beyond / n on the side of the incident direction.
RL_FN float fresnelDielectric(float cosI, float eta) {
  float sin2T = (1.0f - cosI * cosI) / (eta * eta);
  if (!(sin2T < 1.0f)) return 1.0f;  // total internal reflection
  float cosT = sqrt(1.0f - sin2T);
  float parallel = (eta * cosI - cosT) / (eta * cosI + cosT);
  float perpendicular = (cosI - eta * cosT) / (cosI + eta * cosT);
  return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

// Reflectance of the layer at the angle between direction and microfacet normal, without a film.
// Opaque materials use Schlick's form; transmissive ones the exact dielectric curve, rescaled to go
// from f0 to f90.
RL_FN vec3 fresnelPlain(RL_IN(Bsdf) b, float cosVH) {
  float weight = 0.0f;
  if (RL_HAS(RL_FEATURE_TRANSMISSION) && (b.lobes & RL_LOBE_ANY_TRANSMISSION) != 0u) {
    float r = (1.0f - b.eta) / (1.0f + b.eta);
    float r0 = r * r;
    if (!(r0 < 1.0f)) return vec3(b.f90, b.f90, b.f90);
    weight = (fresnelDielectric(cosVH, b.eta) - r0) / (1.0f - r0);
  } else {
    weight = fresnelSchlickWeight(cosVH);
  }
  return b.f0 + (vec3(b.f90, b.f90, b.f90) - b.f0) * weight;
}
