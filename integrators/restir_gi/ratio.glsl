// Reflectance here over that of a donor's surface, for carried estimates.
RL_FN vec3 giRatio(RL_IN(VisibleSurface) donor, uint slot) {
  return reuseReflectanceRatio(donor.reflectance, cacheSurface(slot).reflectance,
                               gParams.maxReflectanceRatio);
}
